//! Calls every public entry point of the library with values that the compiler doesn't know, in
//! all three arithmetics. If this links, none of them can panic.
//!
//! Left out are the constructors for `const` scenes (`new` where there is a `try_new`,
//! `Parts::extents`, `Scene::checked`, `OctreeBuffer`), whose panics are compile errors, and text for people
//! (`Display`, `Debug`), where the standard library's own formatting can.
#![no_std]
#![no_main]

mod frame;
mod numbers;
mod scene;
mod unlinkable;

/// Where linking starts from.
#[unsafe(no_mangle)]
pub extern "C" fn probe() {
    scene::fixed();
    scene::single();
    scene::double();
    numbers::formats();
    numbers::numbers();
}

//! Classic ray tracing (Whitted 1980) on microcontrollers: no framebuffer, no heap, no
//! floating-point unit needed.
//!
//! A [`Scene`](scene::Scene) is put together from slices that lie in flash and checked once, in a
//! `const` if it is a `static`. A [`Renderer`](frame::Renderer) traces it row by row, in memory of
//! the caller's: one line into a slice of pixels, bands of bytes for DMA, or, as a [`Picture`], an
//! image that embedded-graphics draws on any display.
//!
//! ```
//! use whitted::frame::{Output, Renderer, Rgb565, Settings};
//! use whitted::math::Fixed;
//! use whitted::scene::{Background, Camera, Light, Material, MaterialSpec, Parts, Scene};
//! use whitted::shape::{Plane, Sphere};
//! use whitted::trace::Work;
//!
//! static SCENE: Scene<Fixed> = Scene::checked(Parts {
//!     spheres: &[Sphere::<Fixed>::new([0.0, 1.0, 4.0], 1.0, 0)],
//!     planes: &[Plane::<Fixed>::new([0.0, 1.0, 0.0], 0.0, 1)],
//!     materials: &[
//!         Material::<Fixed>::new(MaterialSpec {
//!             diffuse: [0.6, 0.1, 0.1],
//!             reflection: [0.3; 3],
//!             ..MaterialSpec::BLACK
//!         }),
//!         Material::<Fixed>::new(MaterialSpec { diffuse: [0.7; 3], ..MaterialSpec::BLACK }),
//!     ],
//!     lights: &[Light::<Fixed>::point([-4.0, 5.0, -3.0], [40.0; 3])],
//!     background: Background::<Fixed>::uniform([0.2, 0.4, 0.8]),
//!     ..Parts::EMPTY
//! });
//!
//! static CAMERA: Camera<Fixed> =
//!     Camera::<Fixed>::look_at([0.0, 1.5, -2.0], [0.0, 1.0, 4.0], [0.0, 1.0, 0.0], 50.0);
//!
//! // Trees of rays up to five deep; less than 1 KiB.
//! let mut work = Work::<Fixed, 5>::new();
//! let settings = Settings::new(64, 48);
//! let mut renderer = Renderer::new(&SCENE, &CAMERA, settings, &mut work, &mut [])?;
//! let mut line = [Rgb565(0); 64];
//! for y in 0..48 {
//!     renderer.line(y, &Output::SRGB, &mut line);
//!     // send the line to a display
//! }
//! # Ok::<(), whitted::frame::FrameError>(())
//! ```
//!
//! **Arithmetic** is a type parameter: [`Fixed`](math::Fixed) for cores without a floating-point
//! unit, `f32` for those with one, `f64` as the reference. The same scene gives the same bits on
//! every target.
//!
//! **Errors** come where input enters: constructors named `try_…` and `Scene::new` say what is
//! wrong, those named `new` are for `const`s, where a mistake doesn't compile. Rendering itself
//! fails only as the display does.
//!
//! **Features**: `defmt` derives `defmt::Format` for the errors. None chooses the arithmetic.
#![no_std]
#![deny(unsafe_code)]

pub mod blob;
mod draw;
pub mod frame;
pub mod gather;
pub mod math;
pub mod octree;
#[cfg(test)]
mod page;
pub mod scene;
pub mod shape;
pub mod tally;
pub mod trace;

pub use draw::{Color, Picture};

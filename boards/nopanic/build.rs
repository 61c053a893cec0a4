//! Nothing starts these programs: they are only linked, from `probe` on, and what that doesn't
//! reach falls away.

fn main() {
    println!("cargo::rustc-link-arg-bins=--entry=probe");
    println!("cargo::rustc-link-arg-bins=--gc-sections");
}

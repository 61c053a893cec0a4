//! Tells the library which multiplier the target has: ARMv6-M cores (Cortex-M0, M0+) have no
//! 32×32→64 multiply, so the fixed-point kernels take two 32-bit products there instead.

fn main() {
    println!("cargo::rustc-check-cfg=cfg(narrow_multiply)");
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("TARGET").is_ok_and(|target| target.starts_with("thumbv6m")) {
        println!("cargo::rustc-cfg=narrow_multiply");
    }
}

//! Tests in each arithmetic.

/// Makes tests of bodies, one for each arithmetic, which a body calls `A`; and of bodies that take what a
/// result may be off, for fixed point the number that stands first.
macro_rules! in_each_arithmetic {
    ($($name:ident: $body:block)*) => {
        $(mod $name {
            use super::*;
            #[test]
            fn fixed() {
                type A = whitted::math::Fixed;
                $body
            }
            #[test]
            fn f32() {
                type A = f32;
                $body
            }
            #[test]
            fn f64() {
                type A = f64;
                $body
            }
        })*
    };
    ($fixed:literal; $($name:ident: |$tol:ident| $body:block)*) => {
        $(mod $name {
            use super::*;
            #[test]
            fn fixed() {
                type A = whitted::math::Fixed;
                let $tol = $fixed;
                $body
            }
            #[test]
            fn f32() {
                type A = f32;
                let $tol = 1e-5;
                $body
            }
            #[test]
            fn f64() {
                type A = f64;
                let $tol = 1e-12;
                $body
            }
        })*
    };
}
pub(crate) use in_each_arithmetic;

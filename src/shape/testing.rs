//! What the shapes' tests share.

use super::{Leaving, Ray, Shape};
use crate::math::{Arithmetic, Fixed};
extern crate std;

/// An arithmetic whose numbers go to `f64` and back.
pub(crate) trait Test: Arithmetic {
    fn length(x: f64) -> Self::Length;
    fn unit(x: f64) -> Self::Unit;
    fn of_length(x: Self::Length) -> f64;
    fn of_unit(x: Self::Unit) -> f64;
}

macro_rules! test_float {
    ($f:ident) => {
        impl Test for $f {
            fn length(x: f64) -> $f {
                x as $f
            }
            fn unit(x: f64) -> $f {
                x as $f
            }
            fn of_length(x: $f) -> f64 {
                x as f64
            }
            fn of_unit(x: $f) -> f64 {
                x as f64
            }
        }
    };
}
test_float!(f32);
test_float!(f64);

impl Test for Fixed {
    fn length(x: f64) -> Self::Length {
        Self::Length::from_bits((x * 65536.0).round() as i32)
    }
    fn unit(x: f64) -> Self::Unit {
        Self::Unit::from_bits((x * 131072.0).round() as i32)
    }
    fn of_length(x: Self::Length) -> f64 {
        x.to_num()
    }
    fn of_unit(x: Self::Unit) -> f64 {
        x.to_num()
    }
}

/// A ray from free space.
pub(crate) fn ray<A: Test>(o: [f64; 3], d: [f64; 3]) -> Ray<A> {
    Ray { origin: o.map(A::length), direction: d.map(A::unit), leaving: Leaving::NOTHING }
}

/// The distance to a shape.
pub(crate) fn distance<A: Test, S: Shape<A>>(shape: &S, ray: &Ray<A>) -> Option<f64> {
    let coarse = A::coarse(&ray.origin, &ray.direction);
    let hit = shape.nearest(ray, &coarse, false, A::FAR)?;
    if hit.distance < A::FAR { Some(A::of_length(hit.distance)) } else { None }
}

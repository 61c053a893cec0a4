//! The core's numbers as `f64`, for reports.

use std::any::Any;

use whitted::math::{Arithmetic, Fixed, Number};

/// The value of any number of any of the three arithmetics; not a number for others.
pub fn to_f64<N: Number>(number: N) -> f64 {
    let any: &dyn Any = &number;
    if let Some(x) = any.downcast_ref::<f64>() {
        return *x;
    }
    if let Some(x) = any.downcast_ref::<f32>() {
        return f64::from(*x);
    }
    if let Some(x) = any.downcast_ref::<<Fixed as Arithmetic>::Length>() {
        return x.to_num();
    }
    if let Some(x) = any.downcast_ref::<<Fixed as Arithmetic>::Unit>() {
        return x.to_num();
    }
    if let Some(x) = any.downcast_ref::<<Fixed as Arithmetic>::Weight>() {
        return x.to_num();
    }
    f64::NAN
}

/// A radiance of any arithmetic: what the tone curve will read, as a number.
pub fn radiance<A: Arithmetic>(radiance: &[A::Radiance; 3]) -> [f64; 3] {
    radiance.map(|channel| f64::from(A::to_q16(channel)) / 65536.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ones() {
        assert_eq!(to_f64(f64::FULL), 1.0);
        assert_eq!(to_f64(f32::FULL), 1.0);
        assert_eq!(to_f64(Fixed::FULL), 1.0);
        assert_eq!(to_f64(Fixed::ONE_UNIT), 1.0);
        assert!(to_f64(Fixed::FAR) > 100.0);
    }
}

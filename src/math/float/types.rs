//! What floating point precomputes and remembers.

use crate::blob::{stored_numbers, within};
use crate::math::Number;
use bytemuck::{AnyBitPattern, Pod};

/// A radius and its reciprocal.
#[derive(Clone, Copy, Debug, PartialEq, AnyBitPattern)]
#[repr(C)]
pub struct FloatRadius<F: Pod> {
    pub(super) r: F,
    pub(super) reciprocal: F,
}

/// η_i/η_t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloatEta<F>(pub(super) F);

/// See [`Arithmetic::Barycentric`](crate::math::Arithmetic::Barycentric): the coefficients of both linear forms, and what each must
/// allow for every unit that a hit is off.
#[derive(Clone, Copy, Debug, PartialEq, AnyBitPattern)]
#[repr(C)]
pub struct FloatBarycentric<F: Pod> {
    pub(super) second: [F; 2],
    pub(super) third: [F; 2],
    pub(super) slack: [F; 2],
    /// How far from the coordinates' origin the triangle reaches: its plane is rounded so.
    pub(super) reach: F,
}

/// See [`Arithmetic::Outline`](crate::math::Arithmetic::Outline): half the sides of the rectangle, and how far from the
/// coordinates' origin the polygon reaches.
#[derive(Clone, Copy, Debug, PartialEq, AnyBitPattern)]
#[repr(C)]
pub struct FloatOutline<F: Pod> {
    pub(super) half: [F; 2],
    pub(super) reach: F,
}

/// See [`Arithmetic::Edge`](crate::math::Arithmetic::Edge): `normal·(x, y) + offset`, not negative inside.
#[derive(Clone, Copy, Debug, PartialEq, AnyBitPattern)]
#[repr(C)]
pub struct FloatEdge<F: Pod> {
    pub(super) normal: [F; 2],
    pub(super) offset: F,
}

/// Whether all are numbers.
fn finite<F: Number>(numbers: &[F]) -> bool {
    within(numbers, f64::MAX)
}

stored_numbers!(for<F: Number> FloatRadius { r, reciprocal } if |x| finite(&[x.r, x.reciprocal]));
stored_numbers!(for<F: Number> FloatBarycentric { second, third, slack, reach }
    if |x| finite(&x.second) && finite(&x.third) && finite(&x.slack) && finite(&[x.reach]));
stored_numbers!(for<F: Number> FloatOutline { half, reach } if |x| finite(&x.half) && finite(&[x.reach]));
stored_numbers!(for<F: Number> FloatEdge { normal, offset } if |x| finite(&x.normal) && finite(&[x.offset]));

/// See [`Arithmetic::Spot`](crate::math::Arithmetic::Spot).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloatSpot<F> {
    pub(super) at: [F; 2],
    pub(super) slack: F,
}

/// See [`Arithmetic::DirectionCone`](crate::math::Arithmetic::DirectionCone): those whose product with the axis is no less than `least`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloatDirectionCone<F> {
    pub(super) axis: [F; 3],
    pub(super) least: F,
}

/// A factor and its reciprocal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloatScale<F> {
    pub(super) factor: F,
    pub(super) reciprocal: F,
}

//! Chords: what a closed convex shape cuts from a whole line.
//!
//! The ends carry signs: an end behind the ray's origin has a negative distance. Shapes without an
//! end in some direction have one at ±[`FAR`](Arithmetic::FAR).

use super::{Meeting, Ray};
use crate::math::Arithmetic;

/// Where a line enters and leaves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chord<A: Arithmetic> {
    pub(crate) entry: Meeting<A>,
    pub(crate) exit: Meeting<A>,
}

/// A closed convex shape.
pub(crate) trait Convex<A: Arithmetic> {
    /// The chord of the line along the ray, if there is one. Where all of it lies behind the
    /// ray's origin there need not be.
    fn chord(&self, ray: &Ray<A>, coarse: &A::Coarse) -> Option<Chord<A>>;
}

impl<A: Arithmetic> Chord<A> {
    /// The whole line.
    pub(crate) fn endless() -> Self {
        let end = |distance| Meeting { distance, detail: A::NO_LENGTH };
        Self { entry: end(-A::FAR), exit: end(A::FAR) }
    }

    /// Between two parallel planes that lie `low` and `high` ahead along their normal, which the
    /// line follows with the speed `slope`; `mark` is the detail at the exit, and its negative at
    /// the entry.
    #[inline(always)]
    pub(crate) fn slab(low: A::Length, high: A::Length, slope: A::Unit, mark: A::Length) -> Self {
        let (near, far, speed) =
            if slope >= A::NO_UNIT { (low, high, slope) } else { (-high, -low, -slope) };
        Self {
            entry: Meeting { distance: signed_ratio::<A>(near, speed), detail: -mark },
            exit: Meeting { distance: signed_ratio::<A>(far, speed), detail: mark },
        }
    }

    /// What both have in common.
    #[inline(always)]
    pub(crate) fn and(self, other: Self) -> Option<Self> {
        let entry =
            if other.entry.distance > self.entry.distance { other.entry } else { self.entry };
        let exit = if other.exit.distance < self.exit.distance { other.exit } else { self.exit };
        if entry.distance < exit.distance { Some(Self { entry, exit }) } else { None }
    }

    /// The nearest end in front of the origin and not beyond `limit`; `inwards`: the far one.
    #[inline(always)]
    pub(crate) fn nearest(&self, inwards: bool, limit: A::Length) -> Option<Meeting<A>> {
        let enters = !inwards && self.entry.distance > A::NO_LENGTH;
        let end = if enters { self.entry } else { self.exit };
        if end.distance > A::NO_LENGTH && end.distance <= limit { Some(end) } else { None }
    }
}

/// `a/b` for b ≥ 0.
#[inline(always)]
pub(crate) fn signed_ratio<A: Arithmetic>(a: A::Length, b: A::Unit) -> A::Length {
    if a < A::NO_LENGTH { -A::ratio(-a, b) } else { A::ratio(a, b) }
}

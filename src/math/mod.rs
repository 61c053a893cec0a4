//! Arithmetic: the one trait that every kernel is written over, and its three instances.
//!
//! A kernel never multiplies two bare numbers. It asks for an operation whose operands and
//! result have stated meanings (a length times a component of a unit vector is a length; the
//! leg of a right triangle comes from its hypotenuse and its other leg), so that an instance
//! can choose the narrowest operands and the exponents that the operation needs. Floating point
//! ignores all that; [`Fixed`] lives on it.
//!
//! | type | meaning | [`Fixed`] | range |
//! |---|---|---|---|
//! | [`Length`](Arithmetic::Length) | a coordinate, a distance | Q16.16 | ±1024 for positions, ±2048 for differences |
//! | [`Unit`](Arithmetic::Unit) | a component of a unit vector | Q17 | −1 to 1 |
//! | [`Weight`](Arithmetic::Weight) | a coefficient, a cosine | Q14 | 0 to 16 |
//! | [`Radiance`](Arithmetic::Radiance) | radiance or irradiance of one channel | Q16.16 | saturates at 1024 a term |

mod constant;
#[cfg(test)]
mod errors;
mod fixed;
mod float;
#[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
mod hardware;
mod hash;
mod log;
mod root;
mod vector;

pub(crate) use constant::sin_cos_degrees;
pub use constant::tan_degrees;
pub(crate) use constant::{
    DENSEST, cross as cross_f64, inverted, sqrt as sqrt_f64, unit_vector as unit_f64,
};
pub use fixed::{
    Fixed, FixedBarycentric, FixedCoarse, FixedDecay, FixedDirectionCone, FixedEdge, FixedEta,
    FixedExponent, FixedIntensity, FixedInverse, FixedOutline, FixedPace, FixedRadius,
    FixedRotation, FixedScale, FixedSpot,
};
pub use float::{
    FloatBarycentric, FloatDirectionCone, FloatEdge, FloatEta, FloatOutline, FloatRadius,
    FloatScale, FloatSpot,
};
pub(crate) use hash::{hash, spread};
pub use root::sqrt_f32;
pub(crate) use root::{normalize as normalize_u32, sqrt_u32};
pub use vector::{add, axis_of, largest, neg, rgb, sub};

pub(crate) use fixed::constructors as fixed_constructors;
pub(crate) use float::{f32_constructors, f64_constructors};

use bytemuck::{AnyBitPattern, Pod};

use crate::blob::Stored;
use core::fmt::Debug;
use core::ops::{Add, Neg, Sub};

/// A triple of channels, red first.
pub type Rgb<T> = [T; 3];

/// What every number here can do by itself: be added, negated and compared. (Conversion to `f64`
/// is for reports; no kernel uses it.)
pub trait Number:
    Copy
    + Debug
    + Default
    + PartialEq
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Neg<Output = Self>
    + Into<f64>
    + Send
    + Sync
    + Pod
    + 'static
{
}

impl<T> Number for T where
    T: Copy
        + Debug
        + Default
        + PartialEq
        + PartialOrd
        + Add<Output = T>
        + Sub<Output = T>
        + Neg<Output = T>
        + Into<f64>
        + Send
        + Sync
        + Pod
        + 'static
{
}

/// The numbers a scene is traced in: [`Fixed`], `f32` or `f64`.
///
/// All operations are total: none panics, whatever the operands, and all are deterministic to
/// the bit on every target. Where an operation states a range, operands outside it give a wrong
/// number, not an undefined one.
pub trait Arithmetic: AnyBitPattern + Debug + Send + Sync + 'static {
    /// Coordinates and distances.
    type Length: Number;
    /// Components of unit vectors.
    type Unit: Number;
    /// Coefficients and cosines.
    type Weight: Number;
    /// Radiance or irradiance of a channel, irradiance divided by π.
    type Radiance: Number;
    /// A radius with what is precomputed from it.
    type Radius: Stored + Debug + Send + Sync;
    /// The square of a length no larger than a radius, in that radius' exponent.
    type Leg2: Copy + PartialOrd;
    /// The reciprocal of a length.
    type Inverse: Copy;
    /// A light's strength, before falloff.
    type Intensity: Stored + Debug + Send + Sync;
    /// Phong's exponent.
    type Exponent: Copy + Debug + Send + Sync;
    /// The quotient of two indices of refraction.
    type Eta: Copy + Debug + Send + Sync;
    /// How fast a medium absorbs light.
    type Decay: Copy + Debug + Send + Sync;
    /// Two linear forms that give the barycentric coordinates of a point in a triangle's plane.
    type Barycentric: Stored + Debug + Send + Sync;
    /// A unit vector as a mesh stores it.
    type Normal: Stored + Pod + Debug + Send + Sync;
    /// The rectangle around a polygon, seen along its plane's dominant axis, and the exponent
    /// that its edges share.
    type Outline: Stored + Debug + Send + Sync;
    /// A half plane: one side of an edge of a polygon.
    type Edge: Stored + Debug + Send + Sync;
    /// A point of a polygon's plane, and what it may be wrong.
    type Spot: Copy;
    /// A ray at low precision, for quick rejection.
    type Coarse: Copy;
    /// The directions in which rays through a point can meet a sphere.
    type DirectionCone: Copy + Debug + Send + Sync;
    /// A component of a camera's view vector, not normalised.
    type Aim: Number;
    /// The reciprocal of a direction's component, for walks.
    type Pace: Copy;
    /// A ray parameter within the octree, in units of its own.
    type Span: Number;
    /// A rotation of space.
    type Rotation: Copy + Debug + Send + Sync;
    /// A factor that lengths are multiplied by, and its reciprocal.
    type Scale: Copy + Debug + Send + Sync;

    /// What the `--arith` option and baked files call this arithmetic.
    const NAME: &'static str;
    /// Whether a hit with a plane is worth a step of Newton's: whether products and quotients are
    /// less exact than positions.
    const REFINE: bool;
    /// A hit at this distance or beyond is a miss.
    const FAR: Self::Length;
    /// The largest distance below [`FAR`](Self::FAR): where planes are met that end nowhere. For
    /// floats, for which `FAR` is as good as endless, that distance itself.
    const HORIZON: Self::Length;
    /// The cone of all directions.
    const EVERY_DIRECTION: Self::DirectionCone;
    /// The cone of none.
    const NO_DIRECTION: Self::DirectionCone;
    /// Zero length.
    const NO_LENGTH: Self::Length;
    /// Zero component.
    const NO_UNIT: Self::Unit;
    /// One, as a component of a unit vector.
    const ONE_UNIT: Self::Unit;
    /// Coefficient 0.
    const NO_WEIGHT: Self::Weight;
    /// Coefficient 1.
    const FULL: Self::Weight;
    /// Intensity 0.
    const NO_INTENSITY: Self::Intensity;
    /// Radiance 0.
    const BLACK: Self::Radiance;
    /// No span.
    const NO_SPAN: Self::Span;
    /// 1/255: a ray that can't change an 8-bit pixel isn't worth sending.
    const CUTOFF: Self::Weight;

    /// `o + t·d`.
    fn along(o: &[Self::Length; 3], t: Self::Length, d: &[Self::Unit; 3]) -> [Self::Length; 3];
    /// `t·u`.
    fn scale(t: Self::Length, u: Self::Unit) -> Self::Length;
    /// `v·d`, the length of `v` along `d`.
    fn project(v: &[Self::Length; 3], d: &[Self::Unit; 3]) -> Self::Length;
    /// `a·b` of two unit vectors.
    fn dot(a: &[Self::Unit; 3], b: &[Self::Unit; 3]) -> Self::Unit;
    /// `a·b` of two components.
    fn product(a: Self::Unit, b: Self::Unit) -> Self::Unit;
    /// `a·b` of two unit vectors, to the precision that shading needs.
    fn cosine(a: &[Self::Unit; 3], b: &[Self::Unit; 3]) -> Self::Weight;
    /// The mirror image `d − 2(d·n)n` of a direction, given `dn = d·n`.
    fn reflect(d: &[Self::Unit; 3], n: &[Self::Unit; 3], dn: Self::Unit) -> [Self::Unit; 3];
    /// Snell's transmitted direction for `n` on the side the ray comes from and
    /// `cos_i = −d·n ≥ 0`; `None` where reflection is total.
    fn refract(
        d: &[Self::Unit; 3],
        n: &[Self::Unit; 3],
        cos_i: Self::Unit,
        eta: &Self::Eta,
    ) -> Option<[Self::Unit; 3]>;
    /// `a/b` for `a ≥ 0`, `b ≥ 0`; at least [`FAR`](Self::FAR) where the quotient is larger than
    /// that or `b` is 0.
    fn ratio(a: Self::Length, b: Self::Unit) -> Self::Length;
    /// The same for a plane without an end: at most [`HORIZON`](Self::HORIZON), for `b > 0`.
    #[inline(always)]
    fn endless_ratio(a: Self::Length, b: Self::Unit) -> Self::Length {
        Self::ratio(a, b)
    }
    /// `a/b` in steps so large that planes beyond the horizon can be told apart.
    #[inline(always)]
    fn beyond_horizon(_a: Self::Length, _b: Self::Unit) -> Self::Length {
        Self::NO_LENGTH
    }
    /// `o + a/b·d`, for patterns on a plane beyond the horizon: in fixed point to 32,768 units, where
    /// coordinates begin again.
    #[inline(always)]
    fn endless_point(
        o: &[Self::Length; 3],
        a: Self::Length,
        b: Self::Unit,
        d: &[Self::Unit; 3],
    ) -> [Self::Length; 3] {
        Self::along(o, Self::ratio(a, b), d)
    }
    /// `a − b` for patterns: `a` may be a coordinate of an [`endless_point`](Self::endless_point), and the
    /// difference begins again where those do.
    #[inline(always)]
    fn endless_difference(a: Self::Length, b: Self::Length) -> Self::Length {
        a - b
    }
    /// `v·d` of such differences, |d| ≤ 1; it begins again likewise.
    #[inline(always)]
    fn endless_project(v: &[Self::Length; 3], d: &[Self::Unit; 3]) -> Self::Length {
        Self::project(v, d)
    }
    /// The unit vector along `v`, its length, and the length's reciprocal. A null vector has no
    /// direction and gives null.
    fn normalize(v: &[Self::Length; 3]) -> ([Self::Unit; 3], Self::Length, Self::Inverse);
    /// The unit vector along `v` and the length of `v`, for vectors no longer than 2 (an
    /// interpolated normal, a component of a direction).
    fn renormalize(v: &[Self::Unit; 3]) -> ([Self::Unit; 3], Self::Unit);
    /// Puts `p` back on the sphere of radius r, given the normal `n` = (p − centre)/r, which is not
    /// quite a unit vector where p is not quite on the sphere; makes it one. Floats, whose
    /// positions are good to a few steps anyway, leave both alone.
    #[inline(always)]
    fn settle(_r: &Self::Radius, _n: &mut [Self::Unit; 3], _p: &mut [Self::Length; 3]) {}
    /// The origin of a ray that leaves the surface at `p`, moved along `n` by what the position
    /// may be wrong. In fixed point that is a few steps and what the distance `t` adds, over which it
    /// was reached.
    fn leave(p: &[Self::Length; 3], n: &[Self::Unit; 3], t: Self::Length) -> [Self::Length; 3];
    /// How far [`leave`](Self::leave) moves the point.
    fn clearance(p: &[Self::Length; 3], t: Self::Length) -> Self::Length;

    /// The radius itself.
    fn radius(r: &Self::Radius) -> Self::Length;
    /// `r² − |c − t·d|²` if that is positive: the square of the half chord that a ray cuts from
    /// a sphere around `c` (relative to the ray's origin), `t = c·d` being where the ray comes
    /// nearest.
    fn leg2(
        r: &Self::Radius,
        c: &[Self::Length; 3],
        t: Self::Length,
        d: &[Self::Unit; 3],
    ) -> Option<Self::Leg2>;
    /// How far beyond `t` the ray is nearest to `c` after all: `d·(c − t·d)`, which is null but for
    /// what d is short of a unit vector and t was rounded. For rays that [`leg2`](Self::leg2) has
    /// found to come within r.
    fn ahead(
        r: &Self::Radius,
        c: &[Self::Length; 3],
        t: Self::Length,
        d: &[Self::Unit; 3],
    ) -> Self::Length;
    /// The root of a squared leg.
    fn leg(r: &Self::Radius, leg2: Self::Leg2) -> Self::Length;
    /// The square of a length whose absolute value is no larger than 2·`r`.
    fn square(r: &Self::Radius, a: Self::Length) -> Self::Leg2;
    /// `a` over the length whose reciprocal is given, for |a| no larger than that length.
    fn share(a: Self::Length, inverse: &Self::Inverse) -> Self::Unit;
    /// `v/r`, for |v| ≤ r: the normal of a sphere.
    fn over(r: &Self::Radius, v: &[Self::Length; 3]) -> [Self::Unit; 3];
    /// `a/r`, for |a| ≤ r.
    fn part(r: &Self::Radius, a: Self::Length) -> Self::Unit;

    /// A ray at low precision.
    fn coarse(o: &[Self::Length; 3], d: &[Self::Unit; 3]) -> Self::Coarse;
    /// Whether the ray may hit the sphere nearer than `limit`: cheap, and never wrong when it
    /// says no. `NEAR` asks in the order that is quickest for spheres near the ray's way, like those that a walk
    /// through a tree finds: few lie beyond `limit`, or behind.
    #[inline(always)]
    fn may_hit<const NEAR: bool>(
        _ray: &Self::Coarse,
        _center: &[Self::Length; 3],
        _r: &Self::Radius,
        _limit: Self::Length,
    ) -> bool {
        true
    }
    /// Whether the line of a ray may come within `r` of the line through `p` along `axis`: cheap, and
    /// never wrong when it says no.
    #[inline(always)]
    fn may_pass(
        _ray: &Self::Coarse,
        _p: &[Self::Length; 3],
        _axis: &[Self::Unit; 3],
        _r: &Self::Radius,
    ) -> bool {
        true
    }

    /// Whether a ray may be within three slabs at once, those across the axes: `near` and `far` are
    /// the ways to their planes along each axis, in the ray's direction, `far` not negative, and
    /// `speed` the direction's components without their signs. Cheap, and never wrong when it says no.
    #[inline(always)]
    fn may_cross(
        _near: &[Self::Length; 3],
        _far: &[Self::Length; 3],
        _speed: &[Self::Unit; 3],
    ) -> bool {
        true
    }

    /// The directions in which rays can meet the sphere of radius `r` around `way` that start at
    /// the coordinates' origin or, `blurred`, lead past it no farther than the direction made by
    /// [`normalize`](Self::normalize) may be wrong. `None` for all directions: near the sphere, or
    /// in it.
    fn direction_cone(
        way: &[Self::Length; 3],
        r: &Self::Radius,
        blurred: bool,
    ) -> Option<Self::DirectionCone>;
    /// The directions in which rays that start on the first sphere, to either side, can meet the second; those
    /// whose hit on the first [is near](Self::is_near). Spheres are centre and radius. `None` for all
    /// directions: the spheres touch, or nearly so.
    fn pair_cone(
        from: &([Self::Length; 3], &Self::Radius),
        to: &([Self::Length; 3], &Self::Radius),
    ) -> Option<Self::DirectionCone>;
    /// Whether a ray that hits a sphere at this distance starts anew near enough to its surface.
    fn is_near(t: Self::Length) -> bool;
    /// Whether a direction lies in the cone: cheap, and never wrong when it says no.
    fn in_cone(cone: &Self::DirectionCone, d: &[Self::Unit; 3]) -> bool;

    /// The weights of a triangle's second and third corner at the point (x, y) of its plane,
    /// both relative to its first corner and seen along the plane's dominant axis; `None`
    /// outside the triangle, which is larger by what a hit may be wrong over the distance `t`
    /// on a plane that the ray nears with the speed `slope` > 0.
    fn barycentric(
        form: &Self::Barycentric,
        x: Self::Length,
        y: Self::Length,
        t: Self::Length,
        slope: Self::Unit,
    ) -> Option<(Self::Weight, Self::Weight)>;
    /// The same weights wherever the point lies, brought into the triangle: neither they nor
    /// the first corner's are negative.
    fn weights(
        form: &Self::Barycentric,
        x: Self::Length,
        y: Self::Length,
    ) -> (Self::Weight, Self::Weight);
    /// A stored unit vector.
    fn unpack(n: &Self::Normal) -> [Self::Unit; 3];
    /// The point (x, y) of a polygon's plane, relative to its outline's centre, if it lies
    /// within the outline; `t` and `slope` as for [`barycentric`](Self::barycentric).
    fn spot(
        outline: &Self::Outline,
        x: Self::Length,
        y: Self::Length,
        t: Self::Length,
        slope: Self::Unit,
    ) -> Option<Self::Spot>;
    /// Whether a point lies beyond an edge by more than it may be wrong.
    fn beyond(edge: &Self::Edge, spot: &Self::Spot) -> bool;
    /// Where the line `w + τ·d`, |w| ≤ 1, enters and leaves the double cone around the line
    /// `s·axis` at the distance (`waist` + `sin`·s)/`cos` from it: the two τ, not ordered, each
    /// clipped to ±2; `None` where it misses. 0 ≤ `waist` ≤ 1, and `sin`² + `cos`² = 1.
    fn cone(
        w: &[Self::Unit; 3],
        d: &[Self::Unit; 3],
        axis: &[Self::Unit; 3],
        sin_cos: [Self::Unit; 2],
        waist: Self::Unit,
    ) -> Option<[Self::Unit; 2]>;
    /// `(1 − b − c)·n[0] + b·n[1] + c·n[2]`, normalised.
    fn blend(n: &[[Self::Unit; 3]; 3], b: Self::Weight, c: Self::Weight) -> [Self::Unit; 3];

    /// `a·b` of coefficients, the product no larger than 16.
    fn weight(a: Self::Weight, b: Self::Weight) -> Self::Weight;
    /// `a/b`, for a light's cone: 0 ≤ a ≤ b.
    fn quotient(a: Self::Weight, b: Self::Weight) -> Self::Weight;
    /// `x`/65536 for |x| ≤ 65536, exactly.
    fn fraction(x: i32) -> Self::Unit;
    /// A component of a unit vector as a coefficient.
    fn weight_of(u: Self::Unit) -> Self::Weight;
    /// `cos^n` for a cosine in 0 to 1.
    fn power(cos: Self::Weight, n: &Self::Exponent) -> Self::Weight;
    /// `r·w`.
    fn dim(r: Self::Radiance, w: Self::Weight) -> Self::Radiance;
    /// `a/b` for radiances, at most 15.99; 0 for b = 0.
    fn relative(a: Self::Radiance, b: Self::Radiance) -> Self::Weight;
    /// `r·part/2³²`, less than r where r isn't 0.
    fn portion(r: Self::Radiance, part: u32) -> Self::Radiance;
    /// `r/w`, for a weighted mean: `w` from 1/64 to 1024, the quotient below 1024.
    fn over_weight(r: Self::Radiance, w: Self::Weight) -> Self::Radiance;
    /// `middle + slope·u`, not below 0, for |slope| ≤ middle.
    fn ramp(middle: Self::Radiance, slope: Self::Radiance, u: Self::Unit) -> Self::Radiance;
    /// `a + b`, saturating, for radiances that aren't negative.
    fn gather(a: Self::Radiance, b: Self::Radiance) -> Self::Radiance;
    /// The step that leads from `a` to `b` in 2^`log2` of them, for radiances that aren't negative.
    /// `log2` is at most 4. Rounded towards 0.
    fn step(a: Self::Radiance, b: Self::Radiance, log2: u32) -> Self::Radiance;
    /// `a` and `n` steps, fewer than [`step`](Self::step) was made for: it lies between the two that
    /// the step leads from and to.
    fn steps(a: Self::Radiance, step: Self::Radiance, n: u16) -> Self::Radiance;
    /// The mean of `count` radiances that sum to `sum`.
    fn mean(sum: Self::Radiance, count: u16) -> Self::Radiance;
    /// The radiance as a number of 1/65536, saturating: what the tone curve reads.
    fn to_q16(r: Self::Radiance) -> i32;
    /// The radiance of a number of 1/65536.
    fn from_q16(bits: i32) -> Self::Radiance;
    /// A component of a unit vector as a number of 1/131072.
    fn to_q17(u: Self::Unit) -> i32;
    /// `a/b` as a number of 1/65536, for `a ≥ 0` and `b ≥ 0`; saturating at 2³¹ − 1, also for b = 0.
    fn ratio_q16(a: Self::Length, b: Self::Length) -> u32;
    /// Intensity times the square of an inverse length, saturating at 1024.
    fn falloff(intensity: &Self::Intensity, inverse: &Self::Inverse) -> Self::Radiance;
    /// `i·w`, for a coefficient of at most 4.
    fn dim_intensity(i: &Self::Intensity, w: Self::Weight) -> Self::Intensity;
    /// `i·r²`: the intensity whose irradiance over the distance `r` is `i`.
    fn spread_intensity(i: &Self::Intensity, r: Self::Length) -> Self::Intensity;
    /// Intensity without falloff.
    fn constant(intensity: &Self::Intensity) -> Self::Radiance;
    /// `floor(x·per)` modulo 2: which cell of a pattern a coordinate lies in.
    fn odd(x: Self::Length, per: Self::Length) -> bool;
    /// `floor(x·per·2¹⁶)` modulo 2³²: a texture coordinate.
    fn cells(x: Self::Length, per: Self::Length) -> i32;
    /// The quotient of the indices as a coefficient.
    fn eta_weight(eta: &Self::Eta) -> Self::Weight;
    /// `exp(−rate·t)` for t ≥ 0; in fixed point within 6·10⁻⁵ and 3·10⁻⁸ for every unit of t.
    fn decay(rate: &Self::Decay, t: Self::Length) -> Self::Weight;
    /// The coefficient of a number of 1/16384, which is 0 to 2¹⁸.
    fn weight_q14(bits: i32) -> Self::Weight;
    /// A coefficient as a number of 1/16384, towards 0.
    fn to_q14(w: Self::Weight) -> i32;
    /// The length of a number of 1/65536.
    fn length_q16(bits: i32) -> Self::Length;
    /// The component of a number of 1/131072.
    fn unit_q17(bits: i32) -> Self::Unit;

    /// `base + step·(n + fraction/256)`, `fraction` in 0 to 255.
    fn aim(base: Self::Aim, step: Self::Aim, n: i32, fraction: i32) -> Self::Aim;
    /// `a/n`; `a` for n = 0.
    fn aim_over(a: Self::Aim, n: u32) -> Self::Aim;
    /// A camera's vectors forward, right and down, all halved as often as sums of them need to be in range
    /// for a picture of this size: not at all, but for angles of view or pictures that are very wide.
    fn fitted(vectors: [[Self::Aim; 3]; 3], width: u16, height: u16) -> [[Self::Aim; 3]; 3];
    /// How large a camera's view vector is, for [`sight`](Self::sight).
    fn rise(v: &[Self::Aim; 3]) -> u8;
    /// The unit vector along a camera's view vector. It takes fewer steps for one as large as `rise` says.
    fn sight(v: &[Self::Aim; 3], rise: u8) -> [Self::Unit; 3];

    /// What a ray of the speed `d ≥ 0` takes for a length along an axis.
    fn pace(d: Self::Unit) -> Self::Pace;
    /// What it takes for `a ≥ 0`; at least [`FAR`](Self::FAR) where that is larger, and too little by any
    /// amount where the speed is below 9·2⁻¹⁷.
    fn takes(a: Self::Length, pace: &Self::Pace) -> Self::Length;
    /// For one axis of an octree's grid: what it takes for `left` and for a cell's side, no less than
    /// `left` but for what a position may be wrong. In fixed point the side is below 2¹⁴·2^`unit` steps.
    fn spans(
        left: Self::Length,
        cell: Self::Length,
        pace: &Self::Pace,
        unit: u8,
    ) -> (Self::Span, Self::Span);
    /// How many whole cells of an octree's grid lie before `o`, which lies before the end of cell `last`:
    /// exactly in fixed point, and 0 where it is negative. `per` is what the arithmetic's constructors make
    /// of a cell's side.
    fn cells_before(o: Self::Length, per: Self::Span, last: u32, unit: u8) -> u32;
    /// The length of `n` cells, for up to 8.
    fn cells_long(cell: Self::Length, n: u32) -> Self::Length;
    /// A distance as a span, rounded up so that an end is never early.
    fn span(t: Self::Length, unit: u8) -> Self::Span;
    /// A span and `n` times another, for up to 7: no more than adding that as often gives.
    fn spans_on(first: Self::Span, s: Self::Span, n: u32) -> Self::Span;
    /// Where a span `s` begins that ends at `end`, or up to 2⁻¹⁹·s earlier.
    fn span_before(end: Self::Span, s: Self::Span) -> Self::Span;
    /// `R·v`; in fixed point within two steps, for |v| ≤ 2048.
    fn rotate(r: &Self::Rotation, v: &[Self::Length; 3]) -> [Self::Length; 3];
    /// `Rᵀ·v`, the way back.
    fn rotate_back(r: &Self::Rotation, v: &[Self::Length; 3]) -> [Self::Length; 3];
    /// `R·d` of a unit vector; in fixed point within a step.
    fn turn(r: &Self::Rotation, d: &[Self::Unit; 3]) -> [Self::Unit; 3];
    /// `Rᵀ·d`, the way back.
    fn turn_back(r: &Self::Rotation, d: &[Self::Unit; 3]) -> [Self::Unit; 3];
    /// `s·a`, rounded to nearest; in fixed point clipped to ±2048.
    fn magnify(s: &Self::Scale, a: Self::Length) -> Self::Length;
    /// `a/s`, likewise.
    fn reduce(s: &Self::Scale, a: Self::Length) -> Self::Length;

    /// A span over 2^`times`, for 0 to 31.
    fn halved(s: Self::Span, times: u32) -> Self::Span;
    /// 2^`log2_side` of [`Fixed`]'s smallest steps, or of units otherwise.
    fn side(log2_side: i8) -> Self::Length;
}

/// Writes the items once for each arithmetic: within them `A` is the arithmetic, `make` the
/// module that takes its numbers from `f64` (const fns; a const fn can't call trait methods).
macro_rules! for_each_arithmetic {
    ($($items:tt)*) => {
        const _: () = {
            type A = $crate::math::Fixed;
            #[allow(unused_imports)]
            use $crate::math::fixed_constructors as make;
            $($items)*
        };
        const _: () = {
            type A = f32;
            #[allow(unused_imports)]
            use $crate::math::f32_constructors as make;
            $($items)*
        };
        const _: () = {
            type A = f64;
            #[allow(unused_imports)]
            use $crate::math::f64_constructors as make;
            $($items)*
        };
    };
}
pub(crate) use for_each_arithmetic;

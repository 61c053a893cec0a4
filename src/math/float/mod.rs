//! Floating point: `f32` for cores with a unit for it, `f64` as the reference on a PC.
//!
//! Every operation is the plain formula, in one order, without fused operations, so that all
//! IEEE targets give the same bits.

mod constructors;
mod types;

use super::{Arithmetic, root};
pub use types::{
    FloatBarycentric, FloatDirectionCone, FloatEdge, FloatEta, FloatOutline, FloatRadius,
    FloatScale, FloatSpot,
};

/// Within this distance rays that hit a sphere start anew near enough to its surface for `pair_cone`.
const NEAR: u16 = 256;

macro_rules! float {
    ($f:ident, $bits:literal, $constructors:ident, sqrt: $sqrt:path, pow: $pow:path, exp: $exp:path, eps: $eps:literal, slow: $slow:literal) => {
        impl Arithmetic for $f {
            type Length = $f;
            type Unit = $f;
            type Weight = $f;
            type Radiance = $f;
            type Radius = FloatRadius<$f>;
            type Leg2 = $f;
            type Inverse = $f;
            type Intensity = $f;
            type Exponent = $f;
            type Eta = FloatEta<$f>;
            type Decay = $f;
            type Barycentric = FloatBarycentric<$f>;
            type Normal = [$f; 3];
            type Outline = FloatOutline<$f>;
            type Edge = FloatEdge<$f>;
            type Spot = FloatSpot<$f>;
            type Coarse = ();
            type DirectionCone = FloatDirectionCone<$f>;
            type Aim = $f;
            type Pace = $f;
            type Span = $f;
            type Rotation = [[$f; 3]; 3];
            type Scale = FloatScale<$f>;

            const NAME: &'static str = stringify!($f);
            const REFINE: bool = false;
            const FAR: $f = 1e9;
            const HORIZON: $f = 1e9;
            const EVERY_DIRECTION: FloatDirectionCone<$f> =
                FloatDirectionCone { axis: [0.0; 3], least: -1.0 };
            const NO_DIRECTION: FloatDirectionCone<$f> =
                FloatDirectionCone { axis: [0.0; 3], least: 1.0 };
            const NO_LENGTH: $f = 0.0;
            const NO_UNIT: $f = 0.0;
            const ONE_UNIT: $f = 1.0;
            const NO_WEIGHT: $f = 0.0;
            const FULL: $f = 1.0;
            const NO_INTENSITY: $f = 0.0;
            const BLACK: $f = 0.0;
            const NO_SPAN: $f = 0.0;
            const CUTOFF: $f = 1.0 / 255.0;

            #[inline(always)]
            fn along(o: &[$f; 3], t: $f, d: &[$f; 3]) -> [$f; 3] {
                [o[0] + t * d[0], o[1] + t * d[1], o[2] + t * d[2]]
            }

            #[inline(always)]
            fn scale(t: $f, u: $f) -> $f {
                t * u
            }

            #[inline(always)]
            fn project(v: &[$f; 3], d: &[$f; 3]) -> $f {
                v[0] * d[0] + v[1] * d[1] + v[2] * d[2]
            }

            #[inline(always)]
            fn dot(a: &[$f; 3], b: &[$f; 3]) -> $f {
                a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
            }

            #[inline(always)]
            fn product(a: $f, b: $f) -> $f {
                a * b
            }

            #[inline(always)]
            fn cosine(a: &[$f; 3], b: &[$f; 3]) -> $f {
                Self::dot(a, b)
            }

            #[inline(always)]
            fn reflect(d: &[$f; 3], n: &[$f; 3], dn: $f) -> [$f; 3] {
                let k = 2.0 * dn;
                [d[0] - k * n[0], d[1] - k * n[1], d[2] - k * n[2]]
            }

            #[inline(always)]
            fn refract(d: &[$f; 3], n: &[$f; 3], cos_i: $f, eta: &FloatEta<$f>) -> Option<[$f; 3]> {
                let e = eta.0;
                let cos2_t = 1.0 - e * e * (1.0 - cos_i * cos_i);
                if cos2_t <= 0.0 {
                    return None;
                }
                let k = e * cos_i - $sqrt(cos2_t);
                Some([e * d[0] + k * n[0], e * d[1] + k * n[1], e * d[2] + k * n[2]])
            }

            #[inline(always)]
            fn ratio(a: $f, b: $f) -> $f {
                if b > 0.0 { a / b } else { Self::FAR }
            }

            #[inline(always)]
            fn normalize(v: &[$f; 3]) -> ([$f; 3], $f, $f) {
                let length = $sqrt(Self::project(v, v));
                let inverse = if length > 0.0 { 1.0 / length } else { 0.0 };
                ([v[0] * inverse, v[1] * inverse, v[2] * inverse], length, inverse)
            }

            #[inline(always)]
            fn renormalize(v: &[$f; 3]) -> ([$f; 3], $f) {
                let (unit, length, _) = Self::normalize(v);
                (unit, length)
            }

            #[inline(always)]
            fn leave(p: &[$f; 3], n: &[$f; 3], t: $f) -> [$f; 3] {
                Self::along(p, Self::clearance(p, t), n)
            }

            #[inline(always)]
            fn clearance(p: &[$f; 3], t: $f) -> $f {
                // Eight times the rounding of the numbers that went into the position.
                let size = p[0].abs() + p[1].abs() + p[2].abs() + t;
                size * (8.0 * $eps)
            }

            #[inline(always)]
            fn radius(r: &FloatRadius<$f>) -> $f {
                r.r
            }

            #[inline(always)]
            fn leg2(r: &FloatRadius<$f>, c: &[$f; 3], t: $f, d: &[$f; 3]) -> Option<$f> {
                let f = [c[0] - t * d[0], c[1] - t * d[1], c[2] - t * d[2]];
                let leg2 = r.r * r.r - Self::project(&f, &f);
                if leg2 > 0.0 { Some(leg2) } else { None }
            }

            #[inline(always)]
            fn ahead(_: &FloatRadius<$f>, c: &[$f; 3], t: $f, d: &[$f; 3]) -> $f {
                Self::project(c, d) - t * Self::dot(d, d)
            }

            #[inline(always)]
            fn leg(_: &FloatRadius<$f>, leg2: $f) -> $f {
                $sqrt(leg2)
            }

            #[inline(always)]
            fn square(_: &FloatRadius<$f>, a: $f) -> $f {
                a * a
            }

            #[inline(always)]
            fn share(a: $f, inverse: &$f) -> $f {
                a * *inverse
            }

            #[inline(always)]
            fn over(r: &FloatRadius<$f>, v: &[$f; 3]) -> [$f; 3] {
                [v[0] * r.reciprocal, v[1] * r.reciprocal, v[2] * r.reciprocal]
            }

            #[inline(always)]
            fn part(r: &FloatRadius<$f>, a: $f) -> $f {
                a * r.reciprocal
            }

            #[inline(always)]
            fn coarse(_: &[$f; 3], _: &[$f; 3]) {}

            fn direction_cone(
                way: &[$f; 3],
                r: &FloatRadius<$f>,
                _: bool,
            ) -> Option<FloatDirectionCone<$f>> {
                // A line in direction d through the origin passes the point v at
                // √(|v|² − (d·v)²). Far more is allowed for than rounding takes, be the way past the
                // origin a thousand times as long as that to the sphere.
                let square = Self::project(way, way);
                let reach = r.r * 1.001 + $sqrt(square) * (8192.0 * $eps);
                let rest = square - reach * reach;
                if rest > 0.0 {
                    Some(FloatDirectionCone { axis: *way, least: $sqrt(rest) * 0.9999 })
                } else {
                    None
                }
            }

            fn pair_cone(
                (from, r): &([$f; 3], &FloatRadius<$f>),
                (to, s): &([$f; 3], &FloatRadius<$f>),
            ) -> Option<FloatDirectionCone<$f>> {
                // A ray from anywhere on the first sphere meets the second only where one from its
                // centre meets a sphere as large as both. Where it starts is off the first by what the
                // numbers that went into it are rounded, and by `clearance`, eight times that.
                let sum = |v: &[$f; 3]| v[0].abs() + v[1].abs() + v[2].abs();
                let size = sum(from) + sum(to) + r.r + s.r + NEAR as $f;
                let way = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
                let reach = r.r + s.r + size * (64.0 * $eps);
                Self::direction_cone(&way, &FloatRadius { r: reach, ..**r }, false)
            }

            #[inline(always)]
            fn is_near(t: $f) -> bool {
                t <= NEAR as $f
            }

            #[inline(always)]
            fn in_cone(cone: &FloatDirectionCone<$f>, d: &[$f; 3]) -> bool {
                Self::dot(&cone.axis, d) >= cone.least
            }

            #[inline(always)]
            fn barycentric(
                form: &FloatBarycentric<$f>,
                x: $f,
                y: $f,
                t: $f,
                slope: $f,
            ) -> Option<($f, $f)> {
                let off = (t + form.reach) * (8.0 * $eps) / slope;
                // At a glance the hit is anywhere, but the triangle is no larger than that.
                let most = |x: $f| if x < 0.03125 { x } else { 0.03125 };
                let b = form.second[0] * x + form.second[1] * y;
                let slack_b = most(off * form.slack[0]);
                if b < -slack_b {
                    return None;
                }
                let c = form.third[0] * x + form.third[1] * y;
                let slack_c = most(off * form.slack[1]);
                if c < -slack_c || b + c > 1.0 + (slack_b + slack_c) {
                    return None;
                }
                Some((b, c))
            }

            #[inline(always)]
            fn weights(form: &FloatBarycentric<$f>, x: $f, y: $f) -> ($f, $f) {
                let clamp = |x: $f, most: $f| {
                    if x > most {
                        most
                    } else if x > 0.0 {
                        x
                    } else {
                        0.0
                    }
                };
                let b = clamp(form.second[0] * x + form.second[1] * y, 1.0);
                (b, clamp(form.third[0] * x + form.third[1] * y, 1.0 - b))
            }

            #[inline(always)]
            fn unpack(n: &[$f; 3]) -> [$f; 3] {
                *n
            }

            #[inline(always)]
            fn spot(
                outline: &FloatOutline<$f>,
                x: $f,
                y: $f,
                t: $f,
                slope: $f,
            ) -> Option<FloatSpot<$f>> {
                let off = (t + outline.reach) * (8.0 * $eps) / slope;
                let most = (outline.half[0] + outline.half[1]) * 0.03125;
                let slack = if off < most { off } else { most };
                let beyond = |x: $f, half: $f| x > half + slack || -x > half + slack;
                if beyond(x, outline.half[0]) || beyond(y, outline.half[1]) {
                    return None;
                }
                // The edges' normals are unit vectors: both coordinates may be off.
                Some(FloatSpot { at: [x, y], slack: slack + slack })
            }

            #[inline(always)]
            fn beyond(edge: &FloatEdge<$f>, spot: &FloatSpot<$f>) -> bool {
                edge.normal[0] * spot.at[0] + edge.normal[1] * spot.at[1] + edge.offset
                    < -spot.slack
            }

            #[inline(always)]
            fn cone(
                w: &[$f; 3],
                d: &[$f; 3],
                axis: &[$f; 3],
                sin_cos: [$f; 2],
                waist: $f,
            ) -> Option<[$f; 2]> {
                let [sin, cos] = sin_cos;
                let (s, da) = (Self::dot(w, axis), Self::dot(d, axis));
                let wp = Self::along(w, -s, axis);
                let dp = Self::along(d, -da, axis);
                let (rs, rd) = (waist + sin * s, sin * da);
                let cos2 = cos * cos;
                let a = cos2 * Self::dot(&dp, &dp) - rd * rd;
                let b = cos2 * Self::dot(&wp, &dp) - rs * rd;
                let c = cos2 * Self::dot(&wp, &wp) - rs * rs;
                let square = b * b - a * c;
                if square < 0.0 {
                    return None;
                }
                let h = $sqrt(square);
                let over = |x: $f, y: $f| {
                    let q = x / y;
                    if q < -2.0 {
                        -2.0
                    } else if q < 2.0 {
                        q
                    } else {
                        2.0
                    }
                };
                // Of the two roots one is free of cancellation, and gives the other.
                Some(if b >= 0.0 {
                    [over(-b - h, a), over(c, -b - h)]
                } else {
                    [over(c, h - b), over(h - b, a)]
                })
            }

            #[inline(always)]
            fn blend(n: &[[$f; 3]; 3], b: $f, c: $f) -> [$f; 3] {
                let a = 1.0 - b - c;
                let f = |i: usize| a * n[0][i] + b * n[1][i] + c * n[2][i];
                Self::renormalize(&[f(0), f(1), f(2)]).0
            }

            #[inline(always)]
            fn weight(a: $f, b: $f) -> $f {
                a * b
            }

            #[inline(always)]
            fn quotient(a: $f, b: $f) -> $f {
                if b > 0.0 { a / b } else { 0.0 }
            }

            #[inline(always)]
            fn fraction(x: i32) -> $f {
                x as $f * (1.0 / 65536.0)
            }

            #[inline(always)]
            fn weight_of(u: $f) -> $f {
                u
            }

            #[inline(always)]
            fn power(cos: $f, n: &$f) -> $f {
                // Whole exponents, the usual ones, by squaring: exact to a few steps, quick, and
                // without libm.
                let whole = *n as u32;
                if whole as $f == *n && whole <= 4096 {
                    let (mut square, mut n, mut power) = (cos, whole, 1.0);
                    while n != 0 {
                        if n & 1 != 0 {
                            power *= square;
                        }
                        square *= square;
                        n >>= 1;
                    }
                    power
                } else {
                    $pow(cos, *n)
                }
            }

            #[inline(always)]
            fn dim(r: $f, w: $f) -> $f {
                r * w
            }

            #[inline(always)]
            fn relative(a: $f, b: $f) -> $f {
                let most = 15.99;
                let ratio = if b > 0.0 { a / b } else { 0.0 };
                if ratio < most { ratio } else { most }
            }

            #[inline(always)]
            fn portion(r: $f, part: u32) -> $f {
                // As many bits as any float has, so that the part stays below 1.
                r * ((part >> 8) as $f * (1.0 / 16777216.0))
            }

            #[inline(always)]
            fn over_weight(r: $f, w: $f) -> $f {
                if w > 0.0 { r / w } else { 0.0 }
            }

            #[inline(always)]
            fn ramp(middle: $f, slope: $f, u: $f) -> $f {
                let sum = middle + slope * u;
                if sum < 0.0 { 0.0 } else { sum }
            }

            #[inline(always)]
            fn gather(a: $f, b: $f) -> $f {
                a + b
            }

            #[inline(always)]
            fn step(a: $f, b: $f, log2: u32) -> $f {
                (b - a) * (1.0 / (1u32.wrapping_shl(log2)) as $f)
            }

            #[inline(always)]
            fn steps(a: $f, step: $f, n: u16) -> $f {
                a + step * $f::from(n)
            }

            #[inline(always)]
            fn mean(sum: $f, count: u16) -> $f {
                sum * (1.0 / count as $f)
            }

            #[inline(always)]
            fn to_q16(r: $f) -> i32 {
                // `as` saturates, and takes no number for 0.
                (r * 65536.0 + 0.5) as i32
            }

            #[inline(always)]
            fn from_q16(bits: i32) -> $f {
                bits as $f * (1.0 / 65536.0)
            }

            #[inline(always)]
            fn to_q17(u: $f) -> i32 {
                (u * 131072.0) as i32
            }

            #[inline(always)]
            fn ratio_q16(a: $f, b: $f) -> u32 {
                let q = if b > 0.0 { (a / b * 65536.0) as u32 } else { u32::MAX };
                if q > i32::MAX as u32 { i32::MAX as u32 } else { q }
            }

            #[inline(always)]
            fn falloff(intensity: &$f, inverse: &$f) -> $f {
                Self::constant(&(*intensity * (*inverse * *inverse)))
            }

            #[inline(always)]
            fn dim_intensity(i: &$f, w: $f) -> $f {
                *i * w
            }

            #[inline(always)]
            fn spread_intensity(i: &$f, r: $f) -> $f {
                *i * (r * r)
            }

            #[inline(always)]
            fn constant(intensity: &$f) -> $f {
                if *intensity > 1024.0 { 1024.0 } else { *intensity }
            }

            #[inline(always)]
            fn odd(x: $f, per: $f) -> bool {
                let cell = x * per;
                let whole = cell as i32;
                let floor = whole.wrapping_sub((whole as $f > cell) as i32);
                floor & 1 != 0
            }

            #[inline(always)]
            fn cells(x: $f, per: $f) -> i32 {
                let steps = x * per * 65536.0;
                let whole = steps as i64;
                whole.wrapping_sub((whole as $f > steps) as i64) as i32
            }

            #[inline(always)]
            fn eta_weight(eta: &FloatEta<$f>) -> $f {
                eta.0
            }

            #[inline(always)]
            fn decay(rate: &$f, t: $f) -> $f {
                $exp(-(*rate * t))
            }

            #[inline(always)]
            fn weight_q14(bits: i32) -> $f {
                bits as $f * (1.0 / 16384.0)
            }

            #[inline(always)]
            fn to_q14(w: $f) -> i32 {
                (w * 16384.0) as i32
            }

            #[inline(always)]
            fn length_q16(bits: i32) -> $f {
                bits as $f * (1.0 / 65536.0)
            }

            #[inline(always)]
            fn unit_q17(bits: i32) -> $f {
                bits as $f * (1.0 / 131072.0)
            }

            #[inline(always)]
            fn aim(base: $f, step: $f, n: i32, fraction: i32) -> $f {
                base + step * (n as $f + fraction as $f * (1.0 / 256.0))
            }

            #[inline(always)]
            fn aim_over(a: $f, n: u32) -> $f {
                if n == 0 { a } else { a / n as $f }
            }

            fn fitted(vectors: [[$f; 3]; 3], _: u16, _: u16) -> [[$f; 3]; 3] {
                vectors
            }

            fn rise(_: &[$f; 3]) -> u8 {
                0
            }

            #[inline(always)]
            fn sight(v: &[$f; 3], _: u8) -> [$f; 3] {
                Self::normalize(v).0
            }

            #[inline(always)]
            fn pace(d: $f) -> $f {
                if d < $slow { $slow } else { d }
            }

            #[inline(always)]
            fn takes(a: $f, pace: &$f) -> $f {
                Self::ratio(a, *pace)
            }

            #[inline(always)]
            fn spans(left: $f, cell: $f, pace: &$f, _: u8) -> ($f, $f) {
                (left / *pace, cell / *pace)
            }

            #[inline(always)]
            fn cells_before(o: $f, per: $f, last: u32, _: u8) -> u32 {
                // Saturating: below 0 there are none.
                let n = (o * per) as u32;
                if n > last { last } else { n }
            }

            #[inline(always)]
            fn cells_long(cell: $f, n: u32) -> $f {
                cell * n as $f
            }

            #[inline(always)]
            fn span(t: $f, _: u8) -> $f {
                // The rounding of the quotients behind the spans.
                t + t * (4.0 * $eps)
            }

            #[inline(always)]
            fn spans_on(first: $f, s: $f, n: u32) -> $f {
                // Seven sums may be rounded down, a product and a sum up.
                let sum = first + s * n as $f;
                sum - sum.abs() * (16.0 * $eps)
            }

            #[inline(always)]
            fn span_before(end: $f, s: $f) -> $f {
                // The walk has rounded what it added, and what is taken off again is rounded, too: by
                // less than 2⁻²⁰ of a cell.
                end - s - Self::halved(s, 19)
            }

            #[inline(always)]
            fn rotate(r: &[[$f; 3]; 3], v: &[$f; 3]) -> [$f; 3] {
                [Self::dot(&r[0], v), Self::dot(&r[1], v), Self::dot(&r[2], v)]
            }

            #[inline(always)]
            fn rotate_back(r: &[[$f; 3]; 3], v: &[$f; 3]) -> [$f; 3] {
                let f = |i: usize| r[0][i] * v[0] + r[1][i] * v[1] + r[2][i] * v[2];
                [f(0), f(1), f(2)]
            }

            #[inline(always)]
            fn turn(r: &[[$f; 3]; 3], d: &[$f; 3]) -> [$f; 3] {
                Self::rotate(r, d)
            }

            #[inline(always)]
            fn turn_back(r: &[[$f; 3]; 3], d: &[$f; 3]) -> [$f; 3] {
                Self::rotate_back(r, d)
            }

            #[inline(always)]
            fn magnify(s: &FloatScale<$f>, a: $f) -> $f {
                a * s.factor
            }

            #[inline(always)]
            fn reduce(s: &FloatScale<$f>, a: $f) -> $f {
                a * s.reciprocal
            }

            #[inline(always)]
            fn halved(s: $f, times: u32) -> $f {
                s * constructors::$constructors::power_of_two(-(times as i8))
            }

            #[inline(always)]
            fn side(log2_side: i8) -> $f {
                constructors::$constructors::power_of_two(log2_side)
            }
        }
    };
}

float!(f32, 32, f32, sqrt: root::sqrt_f32, pow: libm::powf, exp: libm::expf, eps: 5.9604645e-8, slow: 9.536_743e-7);
float!(f64, 64, f64, sqrt: libm::sqrt, pow: libm::pow, exp: libm::exp, eps: 1.1102230246251565e-16, slow: 1e-12);

pub(crate) use constructors::{f32 as f32_constructors, f64 as f64_constructors};

//! An area light as a point sees it, and the points of it that shadow rays go to.
//!
//! Places on the unit square are integers, 65536 being 1, and so are the maps from there: all
//! arithmetics send their rays to the same places.

use crate::math::{Arithmetic, add, neg, sub};
use crate::scene::{AreaLight, FanCorner, Form};

/// A light seen from a point x.
pub(super) struct Seen<'l, A: Arithmetic> {
    area: Image<'l, A>,
    origin: [A::Length; 3],
    /// Of the front.
    pub(super) normal: [A::Unit; 3],
    /// From x to the light's centre.
    pub(super) way: [A::Length; 3],
    pub(super) distance: A::Length,
    /// The part of [`AreaLight::intensity`] that this much of the area has.
    pub(super) share: A::Weight,
    /// A·max L_e/(r²·e), before the cosine.
    demand: A::Radiance,
    /// cos θ_y of the centre.
    cosine: A::Weight,
}

/// The map from the unit square.
enum Image<'l, A: Arithmetic> {
    Rectangle(&'l [[A::Length; 3]; 2]),
    Triangle(&'l [[A::Length; 3]; 2]),
    Polygon(&'l [FanCorner<A>]),
    Disc([[A::Length; 3]; 2]),
}

impl<'l, A: Arithmetic> Seen<'l, A> {
    /// The light from x; `None` behind it, or within a sphere.
    pub(super) fn from(
        light: &'l AreaLight<A>,
        corners: &'l [FanCorner<A>],
        x: &[A::Length; 3],
    ) -> Option<Self> {
        let way = sub(&light.center, x);
        let (direction, distance, inverse) = A::normalize(&way);
        let demand = A::falloff(&light.demand, &inverse);
        let demand = if demand < light.most_demand { demand } else { light.most_demand };
        if let Form::Sphere { radius } = &light.form {
            let r = A::radius(radius);
            if distance <= r {
                return None;
            }
            // The disc of the circle of tangency; sine is R/d.
            let sine = A::share(r, &inverse);
            let back = A::scale(r, sine);
            let half =
                A::leg2(radius, &[back, A::NO_LENGTH, A::NO_LENGTH], A::NO_LENGTH, &direction)?;
            let half = A::leg(radius, half);
            let axes = across::<A>(&direction).map(|axis| axis.map(|u| A::scale(half, u)));
            let square = A::weight_of(A::product(sine, sine));
            return Some(Self {
                area: Image::Disc(axes),
                origin: A::along(&light.center, -back, &direction),
                normal: neg(&direction),
                way,
                distance,
                share: if square < A::FULL { A::FULL - square } else { A::NO_WEIGHT },
                demand,
                cosine: A::FULL,
            });
        }
        if A::project(&sub(x, &light.origin), &light.normal) <= A::NO_LENGTH {
            return None;
        }
        let area = match &light.form {
            Form::Rectangle { edges } => Image::Rectangle(edges),
            Form::Triangle { edges } => Image::Triangle(edges),
            Form::Disc { axes } => Image::Disc(*axes),
            Form::Polygon { first, count } => {
                let first = *first as usize;
                Image::Polygon(corners.get(first..first.wrapping_add(usize::from(*count)))?)
            }
            Form::Sphere { .. } => return None,
        };
        Some(Self {
            area,
            origin: light.origin,
            normal: light.normal,
            way,
            distance,
            share: A::FULL,
            demand,
            cosine: -A::cosine(&direction, &light.normal),
        })
    }

    /// How many shadow rays x sends to the light, before they are rounded up to a grid.
    pub(super) fn samples(&self, light: &AreaLight<A>) -> u16 {
        let cosine = if self.cosine > A::NO_WEIGHT { self.cosine } else { A::NO_WEIGHT };
        let demand = A::to_q16(A::dim(self.demand, cosine)) as u32;
        let count = demand.saturating_add(0xffff) >> 16;
        let [least, most] = light.samples.map(u32::from);
        (if count < least {
            least
        } else if count > most {
            most
        } else {
            count
        }) as u16
    }

    /// The irradiance at x over π, normal to `normal`, as if all came from the centre, r being no
    /// less than half the diameter. A cosine counts as a sixteenth at least: another part of the
    /// light may have a larger one.
    pub(super) fn irradiance(&self, light: &AreaLight<A>, normal: &[A::Unit; 3]) -> A::Radiance {
        let (direction, _, inverse) = A::normalize(&self.way);
        let irradiance = A::falloff(&light.intensity, &inverse);
        let irradiance = if irradiance < light.most { irradiance } else { light.most };
        let least = A::weight_of(A::fraction(4096));
        let at_least = |cosine: A::Weight| if cosine > least { cosine } else { least };
        let cosine = at_least(A::cosine(normal, &direction));
        A::dim(irradiance, A::weight(cosine, at_least(self.cosine)))
    }

    /// The light's point for the middle (s, t) of a cell of the unit square, whose sides are `step`.
    pub(super) fn middle(
        &self,
        light: &AreaLight<A>,
        s: u32,
        t: u32,
        step: [u32; 2],
    ) -> [A::Length; 3] {
        match (&light.form, &self.area) {
            (Form::Disc { .. }, Image::Disc(axes)) => self.at(axes, disc_middle(s, t, step)),
            _ => self.point(s, t),
        }
    }

    /// The light's point for a place (s, t) of the unit square.
    pub(super) fn point(&self, s: u32, t: u32) -> [A::Length; 3] {
        match &self.area {
            Image::Rectangle(edges) => self.at(edges, (s as i32, t as i32)),
            Image::Triangle(edges) => self.at(edges, triangle(s, t)),
            Image::Disc(axes) => self.at(axes, disc(s, t)),
            Image::Polygon(fan) => match fan_at(fan, s) {
                Some((edges, s)) => self.at(&edges, triangle(s, t)),
                None => self.origin,
            },
        }
    }

    /// The point so far along both edges, in Q16.
    fn at(&self, [a, b]: &[[A::Length; 3]; 2], (x, y): (i32, i32)) -> [A::Length; 3] {
        let (x, y) = (A::fraction(x), A::fraction(y));
        let p = add(&self.origin, &a.map(|a| A::scale(a, x)));
        add(&p, &b.map(|b| A::scale(b, y)))
    }

    /// Where a shadow ray towards a point at `distance` ends: on the sphere, if the light is one.
    pub(super) fn end(
        &self,
        light: &AreaLight<A>,
        direction: &[A::Unit; 3],
        distance: A::Length,
    ) -> A::Length {
        let Form::Sphere { radius } = &light.form else { return distance };
        let nearest = A::project(&self.way, direction);
        match A::leg2(radius, &self.way, nearest, direction) {
            Some(leg2) => nearest - A::leg(radius, leg2),
            // Past its rim by a rounding.
            None => nearest,
        }
    }
}

/// A point of a flat light for a place of the unit square.
pub(crate) fn point_of_light<A: Arithmetic>(
    light: &AreaLight<A>,
    corners: &[FanCorner<A>],
    s: u32,
    t: u32,
) -> Option<[A::Length; 3]> {
    // As it is seen from before its centre.
    let from = A::along(&light.center, light.half, &light.normal);
    Seen::from(light, corners, &from).map(|seen| seen.point(s, t))
}

/// Two unit vectors at right angles to a third and to each other.
fn across<A: Arithmetic>(w: &[A::Unit; 3]) -> [[A::Unit; 3]; 2] {
    // From the axis that w is farthest from: e − (e·w)·w.
    let size = |x: A::Unit| if x < A::NO_UNIT { -x } else { x };
    let least = if size(w[0]) <= size(w[1]) && size(w[0]) <= size(w[2]) {
        0
    } else if size(w[1]) <= size(w[2]) {
        1
    } else {
        2
    };
    let mut u = [A::NO_UNIT; 3];
    for (i, u) in u.iter_mut().enumerate() {
        let e = if i == least { A::ONE_UNIT } else { A::NO_UNIT };
        *u = e - A::product(w[least], w[i]);
    }
    let (u, _) = A::renormalize(&u);
    let cross = |i: usize, j: usize| A::product(w[i], u[j]) - A::product(w[j], u[i]);
    [u, [cross(1, 2), cross(2, 0), cross(0, 1)]]
}

/// From the unit square to the triangle x, y ≥ 0, x + y ≤ 1 (Heitz 2019).
fn triangle(s: u32, t: u32) -> (i32, i32) {
    let (s, t) = (s as i32, t as i32);
    if t > s {
        let s = s >> 1;
        (s, t - s)
    } else {
        let t = t >> 1;
        (s - t, t)
    }
}

/// The edges of the fan's triangle that `s` lies in, and where in its width.
fn fan_at<A: Arithmetic>(fan: &[FanCorner<A>], s: u32) -> Option<([[A::Length; 3]; 2], u32)> {
    let mut before = 0;
    let mut i = 0usize;
    loop {
        let (this, next) = (fan.get(i)?, fan.get(i.wrapping_add(1))?);
        // The last triangle takes what rounding leaves.
        if s < this.until || i.wrapping_add(2) >= fan.len() {
            let width = this.until.wrapping_sub(before);
            let place = (s.wrapping_sub(before) << 15).checked_div(width).unwrap_or(0) << 1;
            return Some(([this.edge, next.edge], place));
        }
        before = this.until;
        i = i.wrapping_add(1);
    }
}

/// From the unit square to the unit disc (Shirley and Chiu 1997): the square's rings become the
/// disc's, and along a ring the angle goes evenly, φ = π/4·(b/a) from the nearer axis.
fn disc(s: u32, t: u32) -> (i32, i32) {
    let (far, near, steep) = on_ring(s, t);
    along_ring(far, far, near, steep)
}

/// The same for the middle of a cell with the sides `step`, at the cell's mean radius: a cell between
/// the radii m − d and m + d has its mean at m + d²/3m. At m the light would seem too near to its axis:
/// with 64 cells its irradiance, half its diameter away, is 1.3 % too large, and here 0.2 % too small.
fn disc_middle(s: u32, t: u32, step: [u32; 2]) -> (i32, i32) {
    let (far, near, steep) = on_ring(s, t);
    // d is as long on the disc's radius as a whole step on the square's side, at most ½.
    let wide = (if steep { step[1] } else { step[0] }) as i32;
    let out = wide.wrapping_mul(wide).checked_div(far.wrapping_mul(3)).unwrap_or(0);
    along_ring(far.wrapping_add(out), far, near, steep)
}

/// A place of the square as that on one of its rings: the larger coordinate from the middle, the
/// smaller one, and whether the larger one is t's.
fn on_ring(s: u32, t: u32) -> (i32, i32, bool) {
    let (a, b) = ((s << 1) as i32 - 65536, (t << 1) as i32 - 65536);
    let steep = a.unsigned_abs() < b.unsigned_abs();
    let (far, near) = if steep { (b, a) } else { (a, b) };
    (far, near, steep)
}

/// The point of the disc at the radius `radius` on the ring of `far`.
fn along_ring(radius: i32, far: i32, near: i32, steep: bool) -> (i32, i32) {
    let q_q14 = (near << 14).checked_div(far).unwrap_or(0);
    let (sin, cos) = sin_cos_eighth(q_q14);
    let along = |part: i32| (radius >> 1).wrapping_mul(part >> 1) >> 14;
    if steep { (along(sin), along(cos)) } else { (along(cos), along(sin)) }
}

/// Sine and cosine of π/4·q in Q16, q in Q14 from −1 to 1: four terms of Taylor's series, off by
/// at most 4e-6 and what the steps round.
fn sin_cos_eighth(q: i32) -> (i32, i32) {
    let square = q.wrapping_mul(q) >> 14;
    let times = |x: i32| square.wrapping_mul(x) >> 14;
    let sin = 51472 - times(5292 - times(163 - times(2)));
    let cos = 65536 - times(20213 - times(1039 - times(21)));
    (q.wrapping_mul(sin) >> 14, cos)
}

#[cfg(test)]
mod tests {
    use super::*;
    extern crate std;

    #[test]
    fn sines_and_cosines() {
        for q in -16384..=16384 {
            let angle = f64::from(q) / 16384.0 * core::f64::consts::FRAC_PI_4;
            let (s, c) = sin_cos_eighth(q);
            assert!((f64::from(s) / 65536.0 - angle.sin()).abs() < 5e-5, "{q}");
            assert!((f64::from(c) / 65536.0 - angle.cos()).abs() < 5e-5, "{q}");
        }
    }

    /// The images of equal cells have equal areas: as many of many places land in each of some
    /// equal parts of the image.
    #[test]
    fn maps_keep_areas() {
        const N: u32 = 512;
        let (mut rings, mut eighths, mut corners) = ([0u32; 4], [0u32; 8], [0u32; 4]);
        for j in 0..N {
            for i in 0..N {
                let (s, t) = (i * 128 + 64, j * 128 + 64);
                let (x, y) = disc(s, t);
                let (x, y) = (f64::from(x) / 65536.0, f64::from(y) / 65536.0);
                let r2 = x * x + y * y;
                assert!(r2 <= 1.0);
                rings[((r2 * 4.0) as usize).min(3)] += 1;
                let turn = (y.atan2(x) / core::f64::consts::TAU).rem_euclid(1.0);
                eighths[((turn * 8.0) as usize).min(7)] += 1;
                let (x, y) = triangle(s, t);
                assert!(x >= 0 && y >= 0 && x + y <= 65536);
                // the four triangles between the middles of the sides
                let half = 32768;
                corners[match (x >= half, y >= half, x + y < half) {
                    (true, ..) => 0,
                    (_, true, _) => 1,
                    (.., true) => 2,
                    _ => 3,
                }] += 1;
            }
        }
        let even = |counts: &[u32]| {
            let mean = f64::from(N * N) / counts.len() as f64;
            counts.iter().all(|&c| (f64::from(c) / mean - 1.0).abs() < 0.01)
        };
        assert!(
            even(&rings) && even(&eighths) && even(&corners),
            "{rings:?} {eighths:?} {corners:?}"
        );
    }

    #[test]
    fn fans_give_each_triangle_its_part() {
        // two triangles of areas 1 and 3
        const CORNERS: [[f64; 3]; 4] =
            [[0.0; 3], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [-4.0, 1.0, 0.0]];
        let fan: [FanCorner<f64>; 3] = AreaLight::<f64>::fan(&CORNERS);
        let at = |s| fan_at(&fan, s).map(|(edges, s)| (edges[0][0], edges[1][0], s));
        assert_eq!(at(0), Some((2.0, 2.0, 0)));
        assert_eq!(at(8192), Some((2.0, 2.0, 32768)));
        assert_eq!(at(16384), Some((2.0, -4.0, 0)));
        assert_eq!(at(40960), Some((2.0, -4.0, 32768)));
        assert_eq!(at(65535).map(|(a, b, s)| (a, b, s > 65500)), Some((2.0, -4.0, true)));
    }

    #[test]
    fn frames_are_at_right_angles() {
        for w in [[0.6, 0.8, 0.0], [0.0, 0.0, 1.0], [-0.48, 0.6, -0.64]] {
            let [u, v] = across::<f64>(&w);
            for (a, b, dot) in [(u, v, 0.0), (u, w, 0.0), (v, w, 0.0), (u, u, 1.0), (v, v, 1.0)] {
                assert!((f64::dot(&a, &b) - dot).abs() < 1e-12);
            }
        }
    }

    /// n = ⌈A·max L_e·cos θ_y/(r²·e)⌉ within the bounds, r no less than half the diameter: by f64,
    /// but for quotients so near to a whole number that rounding may take them over it.
    macro_rules! counts {
        ($name:ident, $a:ty, $wrong:expr) => {
            #[test]
            fn $name() {
                use crate::scene::{Area, AreaLightSpec};
                type A = $a;
                const CORNERS: [[f64; 3]; 4] =
                    [[0.6, 2.0, 0.0], [0.2, 2.0, 0.6], [-0.6, 2.0, 0.0], [-0.2, 2.0, -0.6]];
                let fan: [FanCorner<A>; 3] = AreaLight::<A>::fan(&CORNERS);
                let (u, v) = ([1.5, 0.0, 0.0], [0.0, 0.0, 2.0]);
                let down = [0.0, -1.0, 0.0];
                let triangle = [[0.0, 2.0, 0.0], [1.2, 2.0, 0.0], [0.0, 2.0, 0.9]];
                // the area, its middle, its area and half its diameter
                let middle = [0.0, 2.0, 0.0];
                let forms = [
                    (Area::Rectangle { corner: [-0.75, 2.0, -1.0], u, v }, middle, 3.0, 1.25),
                    (Area::Triangle { corners: triangle }, [0.4, 2.0, 0.3], 0.54, 0.75),
                    (Area::Polygon { corners: &CORNERS, first: 0 }, middle, 0.72, 0.4f64.sqrt()),
                    (
                        Area::Disc { center: middle, normal: down, radius: 0.5 },
                        middle,
                        core::f64::consts::PI / 4.0,
                        0.5,
                    ),
                    (
                        Area::Sphere { center: middle, radius: 0.5 },
                        middle,
                        core::f64::consts::PI / 4.0,
                        0.5,
                    ),
                ];
                let mut met = [0; 3];
                for (area, center, size, half) in forms {
                    let flat = !matches!(area, Area::Sphere { .. });
                    for (radiance, error) in [([0.2, 1.0, 0.5], 0.005), ([30.0, 2.0, 1.0], 0.08)] {
                        let samples = [4, 100];
                        let spec = AreaLightSpec { area, radiance, error, samples, body: None };
                        let light = AreaLight::<A>::new(spec);
                        let brightest = radiance.into_iter().fold(0.0, f64::max);
                        for i in 0..1000u32 {
                            let bits = crate::math::hash(i);
                            let part = |shift: u32| f64::from(bits >> shift & 1023) / 1023.0;
                            let height = 0.01 + 5.0 * part(0) * part(0);
                            let (a, b) = (part(10) * 8.0 - 4.0, part(20) * 8.0 - 4.0);
                            let x = [center[0] + a, 2.0 - height, center[2] + b];
                            let at = x.map(|x| A::length_q16((x * 65536.0).round() as i32));
                            let Some(seen) = Seen::from(&light, &fan, &at) else {
                                assert!(!flat && a * a + b * b + height * height < 0.26);
                                continue;
                            };
                            let r = (a * a + b * b + height * height).sqrt();
                            let cosine = if flat { height / r } else { 1.0 };
                            let n = size * brightest * cosine / (r.max(half) * r.max(half) * error);
                            // a cosine is off by 2⁻¹⁴ and more beside small numbers
                            let off = n * $wrong * (1.0 + 1.0 / cosine);
                            let bounded = |n: f64| n.ceil().clamp(4.0, 100.0) as u16;
                            let got = seen.samples(&light);
                            assert!(
                                (bounded(n - off)..=bounded(n + off)).contains(&got),
                                "{area:?} from {x:?}: {got} for {n}"
                            );
                            met[usize::from(got > 4) + usize::from(got == 100)] += 1;
                        }
                    }
                }
                assert!(met.iter().all(|&n| n > 250), "{met:?}");
            }
        };
    }
    counts!(counts_in_fixed, crate::math::Fixed, 2e-4);
    counts!(counts_in_f32, f32, 1e-6);
    counts!(counts_in_f64, f64, 1e-12);
}

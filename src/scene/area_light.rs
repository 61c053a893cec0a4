//! Area lights: a rectangle, triangle, convex polygon, disc or sphere that shines from its front.
//!
//! A light is cut into sub-areas of equal size, and a shadow ray goes to a point y of each. With n
//! of them the radiance that a surface of albedo k_d sends back is
//! `k_d · Σ (L_e/π)·V·G·A/n`, G = cos θ_x · cos θ_y / r² (Whitted 1980 has points alone; the sum is
//! the rendering equation's, Kajiya 1986, for one bounce).
//!
//! **Sub-areas.** All but the sphere are images of the unit square under a map that keeps areas, so
//! that a grid on the square is a grid of equal areas on the light: a parallelogram by its edges;
//! a triangle by Heitz' map ("A low-distortion map between triangle and square", 2019); a polygon
//! as a fan of triangles beside each other along one axis, each as wide as its part of the area; a
//! disc by Shirley and Chiu's concentric map (1997), where a ray to a cell's middle goes to the mean
//! radius of the cell.
//!
//! **The sphere** of radius R around c, seen from the distance d, looks exactly like the disc that
//! its circle of tangency bounds: around c − (R²/d)·w, w being the direction from x to c, across w,
//! of radius R·√(1 − R²/d²). Its radiance is the same in all directions, so that disc is sampled.
//! The shadow ray ends on the sphere.
//!
//! **How many.** n = ⌈A · max L_e · cos θ_y / (r² · e)⌉ within a least and a most number: about as
//! many as leave each ray an irradiance of e. r and θ_y are those of the light's centre, r not below
//! half its diagonal. A light that any part of x's surroundings can see gets the least number.

use crate::math::{Arithmetic, Rgb, cross_f64, for_each_arithmetic, sqrt_f64};
use crate::shape::{ShapeError, ok_or_panic, point, some_or, unit_vector};

/// Where an area light shines from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Area<'s> {
    /// A parallelogram, a rectangle as a rule, around `corner`, `corner + u`, `corner + u + v`,
    /// `corner + v`: counter-clockwise seen from its front.
    Rectangle {
        /// One corner.
        corner: [f64; 3],
        /// The edge to the next corner.
        u: [f64; 3],
        /// The edge to the last one.
        v: [f64; 3],
    },
    /// A triangle, counter-clockwise seen from its front.
    Triangle {
        /// Its corners.
        corners: [[f64; 3]; 3],
    },
    /// A convex polygon, counter-clockwise seen from its front; its corners, from
    /// [`AreaLight::fan`], start at `first` of the scene's
    /// [`light_corners`](super::Parts::light_corners).
    Polygon {
        /// Its corners, 3 to 255.
        corners: &'s [[f64; 3]],
        /// Where its fan starts.
        first: u32,
    },
    /// A disc.
    Disc {
        /// Its middle.
        center: [f64; 3],
        /// Towards its front, of any length.
        normal: [f64; 3],
        /// Its radius.
        radius: f64,
    },
    /// A sphere.
    Sphere {
        /// Its middle.
        center: [f64; 3],
        /// Its radius.
        radius: f64,
    },
}

/// An area light as its author writes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AreaLightSpec<'s> {
    /// Where it shines from.
    pub area: Area<'s>,
    /// L_e: the radiance of its front, the same in all directions.
    pub radiance: Rgb<f64>,
    /// e: the irradiance that a shadow ray may stand for, larger than 0. With an albedo of 1 it
    /// changes a pixel by e/π.
    pub error: f64,
    /// The least and the most shadow rays from a point to this light, 1 to
    /// [`MOST_SAMPLES`](AreaLight::MOST_SAMPLES); rounded up to a grid.
    pub samples: [u16; 2],
    /// The number of the shape that shows the light to the camera and along specular rays: the same
    /// area, of a material with this emission. The light's own shadow rays pass it.
    pub body: Option<u32>,
}

impl AreaLightSpec<'_> {
    /// What a light has that doesn't say: a ray changes a white surface by 0.025/π, two 255ths.
    pub const ERROR: f64 = 0.025;
    /// The least and the most shadow rays of a light that doesn't say.
    pub const SAMPLES: [u16; 2] = [4, 64];
}

/// A point of a polygon's fan of triangles.
#[derive(Clone, Copy, Debug)]
pub struct FanCorner<A: Arithmetic> {
    /// From the polygon's first corner.
    pub(crate) edge: [A::Length; 3],
    /// The part of the area up to the triangle between this corner and the next, in 1/65536.
    pub(crate) until: u32,
}

impl<A: Arithmetic> FanCorner<A> {
    /// A corner of nothing: what the memory for a blob's fans is made of.
    pub const NONE: Self = Self { edge: [A::NO_LENGTH; 3], until: 0 };
}

/// An area light, precomputed.
#[derive(Clone, Copy, Debug)]
pub struct AreaLight<A: Arithmetic> {
    pub(crate) form: Form<A>,
    /// Where its edges start: a corner, or the middle.
    pub(crate) origin: [A::Length; 3],
    pub(crate) center: [A::Length; 3],
    /// Of the front; nothing for a sphere.
    pub(crate) normal: [A::Unit; 3],
    /// Half its largest diameter.
    pub(crate) half: A::Length,
    /// The largest channel of L_e·A/π (for a sphere, of the disc of its radius).
    pub(crate) intensity: A::Intensity,
    /// The channels, relative to the largest.
    pub(crate) color: Rgb<A::Weight>,
    /// A·max L_e/e: what decides the number of rays; and the same over the square of half the
    /// diameter.
    pub(crate) demand: A::Intensity,
    pub(crate) most_demand: A::Radiance,
    /// The intensity over the square of half the diameter.
    pub(crate) most: A::Radiance,
    pub(crate) samples: [u16; 2],
    /// How much longer a cell would be one way than the other, were the grid a square; Q8.
    pub(crate) aspect: u16,
    /// `u32::MAX` for none.
    pub(crate) body: u32,
}

/// The area as an image of the unit square.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Form<A: Arithmetic> {
    Rectangle {
        edges: [[A::Length; 3]; 2],
    },
    Triangle {
        edges: [[A::Length; 3]; 2],
    },
    /// The fan's corners.
    Polygon {
        first: u32,
        count: u16,
    },
    Disc {
        axes: [[A::Length; 3]; 2],
    },
    Sphere {
        radius: A::Radius,
    },
}

impl<A: Arithmetic> AreaLight<A> {
    /// More shadow rays than this no light takes.
    pub const MOST_SAMPLES: u16 = 1024;

    /// The number of the shape that shows the light, if it is visible.
    #[inline(always)]
    pub const fn body(&self) -> Option<u32> {
        if self.body == u32::MAX { None } else { Some(self.body) }
    }

    /// The corners of its fan: the first and how many.
    pub(crate) const fn fan_range(&self) -> (u32, u16) {
        match self.form {
            Form::Polygon { first, count } => (first, count),
            _ => (0, 0),
        }
    }
}

type Axes<A> = [[<A as Arithmetic>::Length; 3]; 2];

const fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

const fn plus(a: [f64; 3], b: [f64; 3], part: f64) -> [f64; 3] {
    [a[0] + b[0] * part, a[1] + b[1] * part, a[2] + b[2] * part]
}

const fn length(v: [f64; 3]) -> f64 {
    sqrt_f64(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
}

const fn max(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Twice the area of the polygon along its normal, from Newell's sum over the fan.
const fn doubled_area(corners: &[[f64; 3]]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    let mut i = 2;
    while i < corners.len() {
        let n = cross_f64(minus(corners[i - 1], corners[0]), minus(corners[i], corners[0]));
        sum = plus(sum, n, 1.0);
        i += 1;
    }
    sum
}

/// What a form is but for its numbers' format.
struct Measure {
    origin: [f64; 3],
    center: [f64; 3],
    /// Of any length.
    normal: [f64; 3],
    area: f64,
    half: f64,
    aspect: f64,
}

impl Measure {
    /// Of a convex polygon; `None` where it has no area.
    const fn polygon(corners: &[[f64; 3]]) -> Option<Self> {
        if corners.len() < 3 || corners.len() > 255 {
            return None;
        }
        let normal = doubled_area(corners);
        let area = length(normal) / 2.0;
        let mut diameter = 0.0;
        let mut center = corners[0];
        let mut i = 0;
        while i < corners.len() {
            let mut j = 0;
            while j < i {
                diameter = max(diameter, length(minus(corners[i], corners[j])));
                j += 1;
            }
            if i >= 2 {
                let (a, b) = (minus(corners[i - 1], corners[0]), minus(corners[i], corners[0]));
                let n = cross_f64(a, b);
                // a triangle that turns the other way makes the polygon concave
                let part =
                    (n[0] * normal[0] + n[1] * normal[1] + n[2] * normal[2]) / (4.0 * area * area);
                if !(part > -1e-6) {
                    return None;
                }
                center = plus(center, plus(a, b, 1.0), part / 3.0);
            }
            i += 1;
        }
        // flatter than a millionth it is a line
        if !(area > diameter * diameter * 1e-6) {
            return None;
        }
        let origin = corners[0];
        Some(Self { origin, center, normal, area, half: diameter / 2.0, aspect: 1.0 })
    }
}

for_each_arithmetic! {
    /// Two vectors of the radius' length across the normal, at right angles.
    const fn axes(normal: [f64; 3], radius: f64) -> Option<Axes<A>> {
        let Some(n) = crate::math::unit_f64(normal) else { return None };
        // From the axis that the normal is farthest from.
        let square = [n[0] * n[0], n[1] * n[1], n[2] * n[2]];
        let from = if square[0] <= square[1] && square[0] <= square[2] {
            [1.0, 0.0, 0.0]
        } else if square[1] <= square[2] {
            [0.0, 1.0, 0.0]
        } else {
            [0.0, 0.0, 1.0]
        };
        let Some(u) = crate::math::unit_f64(cross_f64(from, n)) else { return None };
        let v = cross_f64(n, u);
        let mut axes = [[<A as Arithmetic>::NO_LENGTH; 3]; 2];
        let mut i = 0;
        while i < 3 {
            let (Some(a), Some(b)) = (make::length(u[i] * radius), make::length(v[i] * radius))
            else {
                return None;
            };
            (axes[0][i], axes[1][i]) = (a, b);
            i += 1;
        }
        Some(axes)
    }

    /// The weakest of a number and the largest radiance, which is where sums saturate.
    const fn clipped(x: f64) -> Option<<A as Arithmetic>::Radiance> {
        make::radiance(if x > 1024.0 { 1024.0 } else { x })
    }

    impl AreaLight<A> {
        /// An area light, for scenes in `const`s.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(spec: AreaLightSpec<'_>) -> Self {
            ok_or_panic!(Self::try_new(&spec))
        }

        /// An area light.
        ///
        /// # Errors
        /// A coordinate or radius out of range; corners on a line, not convex, fewer than 3 or more
        /// than 255; a null normal; a negative radiance or one above 1e9; an error that isn't
        /// positive; numbers of shadow rays that aren't 1 to 1024 in their order.
        pub const fn try_new(spec: &AreaLightSpec<'_>) -> Result<Self, ShapeError> {
            let [least, most] = spec.samples;
            if least == 0 || least > most || most > Self::MOST_SAMPLES {
                return Err(ShapeError::Samples);
            }
            let (form, measure) = match spec.area {
                Area::Rectangle { corner, u, v } => {
                    let corners =
                        [corner, plus(corner, u, 1.0), plus(plus(corner, u, 1.0), v, 1.0),
                         plus(corner, v, 1.0)];
                    let measure = some_or!(Measure::polygon(&corners), Degenerate);
                    let edges = [point!(make, u), point!(make, v)];
                    let aspect = length(u) / length(v);
                    (Form::Rectangle { edges }, Measure { aspect, ..measure })
                }
                Area::Triangle { corners } => {
                    let measure = some_or!(Measure::polygon(&corners), Degenerate);
                    let edges = [
                        point!(make, minus(corners[1], corners[0])),
                        point!(make, minus(corners[2], corners[0])),
                    ];
                    (Form::Triangle { edges }, measure)
                }
                Area::Polygon { corners, first } => {
                    let measure = some_or!(Measure::polygon(corners), Polygon);
                    // As wide as it has triangles.
                    let aspect = corners.len() as f64 - 2.0;
                    let form = Form::Polygon { first, count: corners.len() as u16 - 1 };
                    (form, Measure { aspect, ..measure })
                }
                Area::Disc { center, normal, radius } => {
                    if !(radius > 0.0) {
                        return Err(ShapeError::Size);
                    }
                    let measure = Measure {
                        origin: center,
                        center,
                        normal,
                        area: core::f64::consts::PI * radius * radius,
                        half: radius,
                        aspect: 1.0,
                    };
                    (Form::Disc { axes: some_or!(axes(normal, radius), Direction) }, measure)
                }
                Area::Sphere { center, radius } => {
                    let measure = Measure {
                        origin: center,
                        center,
                        normal: [0.0, 0.0, 1.0],
                        area: core::f64::consts::PI * radius * radius,
                        half: radius,
                        aspect: 1.0,
                    };
                    (Form::Sphere { radius: some_or!(make::radius(radius), Size) }, measure)
                }
            };
            let max = max(max(spec.radiance[0], spec.radiance[1]), spec.radiance[2]);
            let scale = if max > 0.0 { 1.0 / max } else { 0.0 };
            if !(max <= 1e9) || !(spec.error > 0.0) {
                return Err(ShapeError::Coefficient);
            }
            let demand = measure.area * max / spec.error;
            // More than this asks for more rays than anyone can send.
            let demand = if demand > 1e12 { 1e12 } else { demand };
            let aspect = measure.aspect * 256.0;
            let aspect = if aspect > 4096.0 { 4096.0 } else { aspect };
            let intensity = max * measure.area * core::f64::consts::FRAC_1_PI;
            Ok(Self {
                form,
                origin: point!(make, measure.origin),
                center: point!(make, measure.center),
                normal: unit_vector!(make, measure.normal),
                half: some_or!(make::length(measure.half), Coordinate),
                intensity: some_or!(make::intensity(intensity), Coefficient),
                color: [
                    some_or!(make::weight(spec.radiance[0] * scale), Coefficient),
                    some_or!(make::weight(spec.radiance[1] * scale), Coefficient),
                    some_or!(make::weight(spec.radiance[2] * scale), Coefficient),
                ],
                demand: some_or!(make::intensity(demand), Coefficient),
                most_demand: some_or!(
                    clipped(demand / (measure.half * measure.half)), Coefficient
                ),
                most: some_or!(
                    clipped(intensity / (measure.half * measure.half)), Coefficient
                ),
                samples: spec.samples,
                aspect: if aspect < 16.0 { 16 } else { aspect as u16 },
                body: match spec.body {
                    Some(shape) => shape,
                    None => u32::MAX,
                },
            })
        }

        /// The fan of a polygon of `N + 1` corners, for scenes in `const`s.
        ///
        /// # Panics
        /// Where [`try_fan`](Self::try_fan) has an error.
        pub const fn fan<const N: usize>(corners: &[[f64; 3]]) -> [FanCorner<A>; N] {
            assert!(corners.len() == N + 1, "a fan has one corner less than its polygon");
            let mut fan = [ok_or_panic!(Self::try_fan(corners, 0)); N];
            let mut i = 1;
            while i < N {
                fan[i] = ok_or_panic!(Self::try_fan(corners, i));
                i += 1;
            }
            fan
        }

        /// Corner `i` of a polygon's fan, of which there is one less than corners.
        ///
        /// # Errors
        /// No such corner; corners out of range or on a line.
        pub const fn try_fan(corners: &[[f64; 3]], i: usize) -> Result<FanCorner<A>, ShapeError> {
            if corners.len() < 3 || i + 1 >= corners.len() {
                return Err(ShapeError::Polygon);
            }
            let all = length(doubled_area(corners));
            // up to the triangle that starts with this corner
            let mut until = 0.0;
            let mut j = 0;
            while j <= i && j + 2 < corners.len() {
                let a = minus(corners[j + 1], corners[0]);
                let b = minus(corners[j + 2], corners[0]);
                until += length(cross_f64(a, b));
                j += 1;
            }
            if !(all > 0.0) {
                return Err(ShapeError::Degenerate);
            }
            let until = until / all * 65536.0 + 0.5;
            Ok(FanCorner {
                edge: point!(make, minus(corners[i + 1], corners[0])),
                until: if until < 65536.0 { until as u32 } else { 65536 },
            })
        }
    }
}

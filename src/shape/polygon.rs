//! Polygon: convex, of 3 to 255 corners.
//!
//! The plane is a triangle's, written along its dominant axis. The point is inside if it lies on
//! the inner side of every edge, each a linear form of the point's two other coordinates; a
//! rectangle around all corners turns most rays away first. As a triangle, a polygon is larger
//! than it is by what a hit may be off.
//!
//! The edges of all polygons of a scene lie in one slice, and a polygon knows which are its own.

use bytemuck::AnyBitPattern;

use super::projection::{Projection, abs, cycled, dominant, dot, minus, reach, uncycled};
use super::{MaterialId, Meeting, Ray, Shape, ShapeError, Surface};
use super::{ok_or_panic, rounded_point, some_or};
use crate::blob::{Stored, stored};
use crate::math::{Arithmetic, cross_f64, for_each_arithmetic, sqrt_f64};
use crate::octree::Extent;

/// Corners may lie off the plane, and inside of their neighbours' line, by this part of the
/// polygon's size: what remains of coordinates written with four digits.
const TOLERANCE: f64 = 1e-3;

/// A convex polygon; its edges lie elsewhere. From its front the corners go counter-clockwise.
#[derive(Clone, Copy, Debug, AnyBitPattern)]
#[repr(C)]
pub struct Polygon<A: Arithmetic> {
    plane: Projection<A>,
    /// The middle of the rectangle around the corners, without the plane's dominant axis.
    center: [A::Length; 2],
    outline: A::Outline,
    first_edge: u32,
    edge_count: u8,
    axis: u8,
    material: MaterialId,
}

stored!(Polygon { plane: nested, center: lengths, outline: nested, first_edge: whole, edge_count: whole, axis: whole, material: whole } if *axis < 3 && *edge_count >= 3);

/// An edge of a [`Polygon`].
#[derive(Clone, Copy, Debug, AnyBitPattern)]
#[repr(transparent)]
pub struct PolygonEdge<A: Arithmetic>(A::Edge);

impl<A: Arithmetic> Stored for PolygonEdge<A> {
    fn store(&self, to: &mut [u8]) {
        self.0.store(to);
    }

    fn is_sound(&self) -> bool {
        self.0.is_sound()
    }
}

/// A polygon and its edges: the shape that rays meet.
#[derive(Clone, Copy, Debug)]
pub struct PolygonView<'a, A: Arithmetic> {
    polygon: &'a Polygon<A>,
    edges: &'a [PolygonEdge<A>],
}

for_each_arithmetic! {
    impl Polygon<A> {
        /// A polygon, for scenes in `const`s; its edges, from [`edges`](Self::edges), start at
        /// `first_edge` of the scene's.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(corners: &[[f64; 3]], first_edge: u32, material: u16) -> Self {
            ok_or_panic!(Self::try_new(corners, first_edge, material))
        }

        /// A polygon.
        ///
        /// # Errors
        /// Corners out of range, on a line, not convex or not in a plane, by a thousandth of the
        /// polygon's size; fewer than three or more than 255.
        pub const fn try_new(
            corners: &[[f64; 3]],
            first_edge: u32,
            material: u16,
        ) -> Result<Self, ShapeError> {
            if material >= MaterialId::LIMIT {
                return Err(ShapeError::Material);
            }
            let mut polygon = match Self::outlined(corners) {
                Ok(polygon) => polygon,
                Err(error) => return Err(error),
            };
            if let Err(error) = polygon.check(corners) {
                return Err(error);
            }
            polygon.first_edge = first_edge;
            polygon.material = MaterialId::new(material);
            Ok(polygon)
        }

        /// All edges of the polygon of these corners, for scenes in `const`s.
        ///
        /// # Panics
        /// Where [`try_edge`](Self::try_edge) has an error.
        pub const fn edges<const N: usize>(corners: &[[f64; 3]; N]) -> [PolygonEdge<A>; N] {
            let polygon = ok_or_panic!(Self::outlined(corners));
            let mut edges = [ok_or_panic!(polygon.edge(corners, 0)); N];
            let mut i = 1;
            while i < N {
                edges[i] = ok_or_panic!(polygon.edge(corners, i));
                i += 1;
            }
            edges
        }

        /// The edge from corner `i` to the next one.
        ///
        /// # Errors
        /// No such corner; corners out of range or on a line.
        pub const fn try_edge(
            corners: &[[f64; 3]],
            i: usize,
        ) -> Result<PolygonEdge<A>, ShapeError> {
            match Self::outlined(corners) {
                Ok(polygon) => polygon.edge(corners, i),
                Err(error) => Err(error),
            }
        }

        const fn corner(corners: &[[f64; 3]], i: usize) -> Result<[f64; 3], ShapeError> {
            if i >= corners.len() {
                return Err(ShapeError::Polygon);
            }
            Ok(rounded_point!(make, corners[i]))
        }

        /// All but the polygon's place in the scene.
        const fn outlined(corners: &[[f64; 3]]) -> Result<Self, ShapeError> {
            let count = corners.len();
            if count < 3 || count > 255 {
                return Err(ShapeError::Polygon);
            }
            let first = match Self::corner(corners, 0) {
                Ok(p) => p,
                Err(error) => return Err(error),
            };
            // Twice the area, along the axes (Newell's method), and the mean of the corners.
            let (mut normal, mut sum, mut most, mut size2) = ([0.0; 3], [0.0; 3], 0.0, 0.0);
            let (mut min, mut max) = (first, first);
            let mut last = [0.0; 3];
            let mut i = 0;
            while i < count {
                let p = match Self::corner(corners, i) {
                    Ok(p) => p,
                    Err(error) => return Err(error),
                };
                most = reach(p, most);
                let p = minus(p, first);
                let n = cross_f64(last, p);
                let mut j = 0;
                while j < 3 {
                    normal[j] += n[j];
                    sum[j] += p[j];
                    let x = p[j] + first[j];
                    min[j] = if x < min[j] { x } else { min[j] };
                    max[j] = if x > max[j] { x } else { max[j] };
                    j += 1;
                }
                let d = dot(p, p);
                size2 = if d > size2 { d } else { size2 };
                last = p;
                i += 1;
            }
            let area = sqrt_f64(dot(normal, normal));
            if area <= size2 * 1e-6 {
                return Err(ShapeError::Degenerate);
            }
            let part = 1.0 / count as f64;
            let middle = [
                first[0] + sum[0] * part,
                first[1] + sum[1] * part,
                first[2] + sum[2] * part,
            ];
            let mut i = 0;
            while i < count {
                let p = match Self::corner(corners, i) {
                    Ok(p) => p,
                    Err(error) => return Err(error),
                };
                let off = abs(dot(minus(p, middle), normal));
                if off > TOLERANCE * sqrt_f64(size2) * area + SLACK_OF_ROUNDING * area {
                    return Err(ShapeError::Polygon);
                }
                i += 1;
            }
            let axis = dominant(normal);
            let plane = some_or!(Projection::<A>::new(normal, middle), Degenerate);
            let (min, max) = (cycled(&min, axis), cycled(&max, axis));
            let center = [
                some_or!(make::length((min[1] + max[1]) * 0.5), Coordinate),
                some_or!(make::length((min[2] + max[2]) * 0.5), Coordinate),
            ];
            // the middle is rounded: the farther side counts
            let half = [
                max[1] - make::from_length(center[0]),
                make::from_length(center[0]) - min[1],
                max[2] - make::from_length(center[1]),
                make::from_length(center[1]) - min[2],
            ];
            let half = [
                if half[0] > half[1] { half[0] } else { half[1] },
                if half[2] > half[3] { half[2] } else { half[3] },
            ];
            Ok(Self {
                plane,
                center,
                outline: make::outline(half, most),
                first_edge: 0,
                edge_count: count as u8,
                axis,
                material: MaterialId::new(0),
            })
        }

        /// Corner `i` relative to the middle, in the projection.
        const fn flat(&self, corners: &[[f64; 3]], i: usize) -> Result<[f64; 2], ShapeError> {
            match Self::corner(corners, i) {
                Ok(p) => {
                    let p = cycled(&p, self.axis);
                    let c = [make::from_length(self.center[0]), make::from_length(self.center[1])];
                    Ok([p[1] - c[0], p[2] - c[1]])
                }
                Err(error) => Err(error),
            }
        }

        /// An edge's start, and the vector across it that points inside.
        const fn side(
            &self,
            corners: &[[f64; 3]],
            i: usize,
        ) -> Result<([f64; 2], [f64; 2]), ShapeError> {
            let next = if i + 1 < corners.len() { i + 1 } else { 0 };
            match (self.flat(corners, i), self.flat(corners, next)) {
                (Ok(a), Ok(b)) => {
                    let s = if make::from_unit(self.plane.facing()) < 0.0 { -1.0 } else { 1.0 };
                    Ok((a, [s * (a[1] - b[1]), s * (b[0] - a[0])]))
                }
                (Err(error), _) | (_, Err(error)) => Err(error),
            }
        }

        const fn edge(
            &self,
            corners: &[[f64; 3]],
            i: usize,
        ) -> Result<PolygonEdge<A>, ShapeError> {
            match self.side(corners, i) {
                Ok((start, inward)) => Ok(PolygonEdge(make::edge(inward, start, &self.outline))),
                Err(error) => Err(error),
            }
        }

        /// Whether every corner lies inside of every edge.
        const fn check(&self, corners: &[[f64; 3]]) -> Result<(), ShapeError> {
            let half = make::half(&self.outline);
            let limit = TOLERANCE * (half[0] + half[1]) + SLACK_OF_ROUNDING;
            let mut all = [[0.0; 2]; 255];
            let mut i = 0;
            // There are no more corners than that; said once more so that no panic is left.
            while i < corners.len() && i < all.len() {
                all[i] = match self.flat(corners, i) {
                    Ok(p) => p,
                    Err(error) => return Err(error),
                };
                i += 1;
            }
            let mut i = 0;
            while i < corners.len() {
                let (start, inward) = match self.side(corners, i) {
                    Ok(side) => side,
                    Err(error) => return Err(error),
                };
                let length = sqrt_f64(inward[0] * inward[0] + inward[1] * inward[1]);
                let least = -limit * length;
                let mut j = 0;
                while j < corners.len() && j < all.len() {
                    let (x, y) = (all[j][0] - start[0], all[j][1] - start[1]);
                    if inward[0] * x + inward[1] * y < least {
                        return Err(ShapeError::Polygon);
                    }
                    j += 1;
                }
                i += 1;
            }
            Ok(())
        }

        /// A box around it: the stored rectangle, and what the plane covers over that. Who has the
        /// corners asks [`extent_of`](Self::extent_of).
        pub const fn extent(&self, log2_step: i8) -> Extent {
            let (half, tilt) = (make::half(&self.outline), self.plane.tilt());
            let c = [make::from_length(self.center[0]), make::from_length(self.center[1])];
            let middle = [self.plane.over(c[0], c[1]), c[0], c[1]];
            let half = [abs(tilt[0]) * half[0] + abs(tilt[1]) * half[1], half[0], half[1]];
            let (middle, half) = (uncycled(&middle, self.axis), uncycled(&half, self.axis));
            let (mut min, mut max) = ([0; 3], [0; 3]);
            let mut i = 0;
            while i < 3 {
                min[i] = make::grid(middle[i] - half[i], log2_step);
                max[i] = make::grid(middle[i] + half[i], log2_step);
                i += 1;
            }
            Extent::Box { min, max }
        }

        /// The smallest box around the polygon of these corners.
        pub const fn extent_of(corners: &[[f64; 3]], log2_step: i8) -> Extent {
            let (mut min, mut max) = ([i32::MAX; 3], [i32::MIN; 3]);
            let mut i = 0;
            while i < corners.len() {
                let mut j = 0;
                while j < 3 {
                    let x = make::grid(corners[i][j], log2_step);
                    min[j] = if x < min[j] { x } else { min[j] };
                    max[j] = if x > max[j] { x } else { max[j] };
                    j += 1;
                }
                i += 1;
            }
            Extent::Box { min, max }
        }
    }
}

/// Corners rounded to fixed point's 2⁻¹⁶ are off a line or a plane by a step or two: a polygon of
/// a hundredth of a unit has no better corners.
const SLACK_OF_ROUNDING: f64 = 1.0 / 32768.0;

impl<A: Arithmetic> Polygon<A> {
    /// The polygon with its own edges out of the scene's. Where they are not all there, no ray
    /// will meet it.
    #[inline(always)]
    pub fn view<'a>(&'a self, edges: &'a [PolygonEdge<A>]) -> PolygonView<'a, A> {
        let first = self.first_edge as usize;
        let own = edges.get(first..first.saturating_add(self.edge_count as usize));
        PolygonView { polygon: self, edges: own.unwrap_or(&[]) }
    }

    /// The index of its first edge in the scene's.
    pub const fn first_edge(&self) -> u32 {
        self.first_edge
    }

    /// How many edges it has.
    pub const fn edge_count(&self) -> u8 {
        self.edge_count
    }
}

impl<A: Arithmetic> Polygon<A> {
    pub(crate) const fn material_id(&self) -> MaterialId {
        self.material
    }
}

impl<A: Arithmetic> Shape<A> for PolygonView<'_, A> {
    const FLAT: bool = true;

    #[inline(always)]
    fn nearest(
        &self,
        ray: &Ray<A>,
        _: &A::Coarse,
        _: bool,
        limit: A::Length,
    ) -> Option<Meeting<A>> {
        let polygon = self.polygon;
        let hit = polygon.plane.crossing(polygon.axis, ray, limit)?;
        let (x, y) = (hit.point[0] - polygon.center[0], hit.point[1] - polygon.center[1]);
        let spot = A::spot(&polygon.outline, x, y, hit.distance, hit.slope)?;
        if self.edges.is_empty() || self.edges.iter().any(|edge| A::beyond(&edge.0, &spot)) {
            return None;
        }
        Some(hit.meeting())
    }

    #[inline(always)]
    fn surface(&self, ray: &Ray<A>, _: &Meeting<A>, _: &mut [A::Length; 3]) -> Surface<A> {
        self.polygon.plane.surface(self.polygon.axis, ray)
    }

    #[inline(always)]
    fn material(&self) -> MaterialId {
        self.polygon.material
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;
    use crate::shape::testing::{distance, ray};

    const SQUARE: [[f64; 3]; 4] =
        [[-1.0, -1.0, 2.0], [1.0, -1.0, 2.0], [1.0, 1.0, 2.0], [-1.0, 1.0, 2.0]];
    static EDGES: [PolygonEdge<Fixed>; 4] = Polygon::<Fixed>::edges(&SQUARE);
    static POLYGON: Polygon<Fixed> = Polygon::<Fixed>::new(&SQUARE, 0, 1);

    #[test]
    fn sizes() {
        assert_eq!(size_of::<Polygon<Fixed>>(), 40);
        assert_eq!(size_of::<PolygonEdge<Fixed>>(), 6);
    }

    #[test]
    fn a_square_in_a_static() {
        let at = |x: f64, y: f64, z: f64| {
            distance(&POLYGON.view(&EDGES), &ray([x, y, 0.0], [0.0, 0.0, z]))
        };
        assert_eq!(at(0.5, -0.9, 1.0), Some(2.0));
        assert_eq!(at(1.1, 0.0, 1.0), None);
        assert_eq!(at(0.0, 0.0, -1.0), None);
        assert_eq!(distance(&POLYGON.view(&EDGES[1..]), &ray([0.0; 3], [0.0, 0.0, 1.0])), None);
    }

    /// A point of the unit circle for each number (the rational parametrisation).
    const ROUND: [[f64; 3]; 255] = {
        let mut corners = [[0.0; 3]; 255];
        let mut i = 0;
        while i < 255 {
            let quarter = i / 64;
            let t = (i % 64) as f64 / 64.0;
            let (x, y) = ((1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t));
            corners[i] = match quarter {
                0 => [x, y, 3.0],
                1 => [-y, x, 3.0],
                2 => [-x, -y, 3.0],
                _ => [y, -x, 3.0],
            };
            i += 1;
        }
        corners
    };
    static MANY: Polygon<Fixed> = Polygon::<Fixed>::new(&ROUND, 4, 1);

    #[test]
    fn two_hundred_and_fifty_five_corners_in_a_static() {
        let edges = const { Polygon::<Fixed>::edges(&ROUND) };
        let mut all = [edges[0]; 259];
        all[4..].copy_from_slice(&edges);
        let at = |x, y| distance(&MANY.view(&all), &ray([x, y, 0.0], [0.0, 0.0, 1.0]));
        assert_eq!(at(0.7, 0.7), Some(3.0));
        assert_eq!(at(0.72, 0.72), None);
        assert_eq!((MANY.first_edge(), MANY.edge_count()), (4, 255));
    }

    #[test]
    fn what_is_no_polygon() {
        let make = |c: &[[f64; 3]]| Polygon::<f64>::try_new(c, 0, 0).err();
        assert_eq!(make(&SQUARE), None);
        assert_eq!(make(&SQUARE[..2]), Some(ShapeError::Polygon));
        let mut bent = SQUARE;
        bent[2][2] = 2.5;
        assert_eq!(make(&bent), Some(ShapeError::Polygon));
        let mut dent = SQUARE;
        dent[2] = [-0.5, -0.5, 2.0];
        assert_eq!(make(&dent), Some(ShapeError::Polygon));
        let star = [0, 2, 4, 1, 3].map(|i| {
            let a = f64::from(i) * core::f64::consts::TAU / 5.0;
            [libm::cos(a), libm::sin(a), 0.0]
        });
        assert_eq!(make(&star), Some(ShapeError::Polygon));
        let line = [0.0, 1.0, 2.0, 3.0].map(|x| [x, x, x]);
        assert_eq!(make(&line), Some(ShapeError::Degenerate));
        assert_eq!(Polygon::<f64>::try_edge(&SQUARE, 4).err(), Some(ShapeError::Polygon));
    }
}

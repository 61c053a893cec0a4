//! Groups: an object of many shapes, in a space and with a tree of its own.

use super::{SceneError, Shapes};
use crate::math::{Arithmetic, for_each_arithmetic, sqrt_f64};
use crate::octree::{Extent, bounds};

/// An object of many shapes inside a bounding sphere, to be placed in a scene by an
/// [`Instance`](super::Instance), as often as wanted. A group holds no other groups and no planes.
///
/// Its shapes name the scene's materials. Patterns lie in the group's space, and move with it.
#[derive(Clone, Copy, Debug)]
pub struct Group<'a, A: Arithmetic> {
    pub(crate) shapes: Shapes<'a, A>,
    pub(crate) count: u32,
    /// Of the bounding sphere.
    pub(crate) center: [A::Length; 3],
    pub(crate) radius: A::Radius,
    /// The number of materials that the scene must have at least.
    pub(crate) materials: u16,
    pub(crate) uses: u64,
}

/// `$one` for each shape, with `$extent` bound to where it lies.
macro_rules! each {
    ($shapes:expr, $step:expr, $extent:ident => $one:expr) => {
        each!(@ $shapes, $step, $extent => $one; spheres triangles smooth_triangles polygons
            cuboids discs cylinders cones solids)
    };
    (@ $shapes:expr, $step:expr, $extent:ident => $one:expr; $($kind:ident)*) => {
        $(
            let mut i = 0;
            while i < $shapes.$kind.len() {
                let $extent = $shapes.$kind[i].extent($step);
                $one
                i += 1;
            }
        )*
    };
}

for_each_arithmetic! {
    impl<'a> Group<'a, A> {
        /// One without shapes: what a pool is made of before groups are put there.
        pub const NONE: Self = Self {
            shapes: Shapes::EMPTY,
            count: 0,
            center: [A::NO_LENGTH; 3],
            radius: match make::radius(1.0) {
                Some(radius) => radius,
                None => panic!("1 is a radius"),
            },
            materials: 0,
            uses: 0,
        };

        /// A group, for scenes in `static`s.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(shapes: Shapes<'a, A>) -> Self {
            match Self::try_new(shapes) {
                Ok(group) => group,
                Err(error) => panic!("{}", error.message()),
            }
        }

        /// A group of these shapes.
        ///
        /// # Errors
        /// Polygons without edges, a tree over other shapes; no shapes; shapes that together are
        /// too large for a bounding sphere (in fixed point, of a radius of 500).
        pub const fn try_new(shapes: Shapes<'a, A>) -> Result<Self, SceneError> {
            let materials = shapes.materials();
            if let Err(error) = shapes.check(materials) {
                return Err(error);
            }
            let count = shapes.bounded();
            if count == 0 {
                return Err(SceneError::Group);
            }
            // Whole steps of one unit first, to see how fine they may be.
            let mut step = 0;
            let (mut min, mut max) = around(&shapes, step);
            let mut farthest = 1;
            let mut i = 0;
            while i < 3 {
                farthest = larger(farthest, larger(max[i], min[i].saturating_neg()));
                i += 1;
            }
            while farthest >> 25 >> step != 0 {
                step += 1;
            }
            while step <= 0 && step > -25 && (farthest as i64) << -step < 1 << 25 {
                step -= 1;
            }
            (min, max) = around(&shapes, step);
            let one = make::from_length(make::from_grid(1 << 16, step)) / 65536.0;
            let mut middle = [0.0; 3];
            let mut i = 0;
            while i < 3 {
                middle[i] = (min[i] as f64 + max[i] as f64) * 0.5;
                i += 1;
            }
            let mut radius2 = 0.0;
            each!(shapes, step, extent => {
                let far = reach2(&extent, &middle);
                if far > radius2 {
                    radius2 = far;
                }
            });
            // A little larger, for what rounding does to extents and rays.
            let radius = (sqrt_f64(radius2) * (1.0 + 1.0 / 4096.0) + 16.0) * one;
            let (Some(x), Some(y), Some(z), Some(radius)) = (
                make::length(middle[0] * one),
                make::length(middle[1] * one),
                make::length(middle[2] * one),
                make::radius(radius),
            ) else {
                return Err(SceneError::Group);
            };
            let uses = shapes.uses();
            let materials = materials as u16;
            Ok(Self { shapes, count, center: [x, y, z], radius, materials, uses })
        }
    }

    /// The box around all shapes, in steps.
    const fn around(shapes: &Shapes<'_, A>, step: i8) -> ([i32; 3], [i32; 3]) {
        let (mut min, mut max) = ([i32::MAX; 3], [i32::MIN; 3]);
        each!(shapes, step, extent => {
            let (low, high) = bounds(&extent);
            let mut axis = 0;
            while axis < 3 {
                if low[axis] < min[axis] {
                    min[axis] = low[axis];
                }
                if high[axis] > max[axis] {
                    max[axis] = high[axis];
                }
                axis += 1;
            }
        });
        (min, max)
    }
}

impl<'a, A: Arithmetic> Group<'a, A> {
    /// The shapes.
    pub const fn shapes(&self) -> &Shapes<'a, A> {
        &self.shapes
    }

    /// What the group uses, of what is about shapes (see [`uses`](super::uses)).
    pub const fn uses(&self) -> u64 {
        self.uses
    }
}

const fn larger(a: i32, b: i32) -> i32 {
    if a > b { a } else { b }
}

/// The squared distance of the extent's farthest point from the middle.
const fn reach2(extent: &Extent, middle: &[f64; 3]) -> f64 {
    match extent {
        Extent::Sphere { center, radius } => {
            let reach = sqrt_f64(distance2(center, middle)) + *radius as f64;
            reach * reach
        }
        Extent::Triangle { corners } => {
            let mut far = 0.0;
            let mut i = 0;
            while i < 3 {
                let d = distance2(&corners[i], middle);
                far = if d > far { d } else { far };
                i += 1;
            }
            far
        }
        Extent::Round { ends, radii, .. } => {
            // The sphere around a circle is not much larger.
            let a = sqrt_f64(distance2(&ends[0], middle)) + radii[0] as f64;
            let b = sqrt_f64(distance2(&ends[1], middle)) + radii[1] as f64;
            if a > b { a * a } else { b * b }
        }
        Extent::Box { min, max } => {
            let mut far = 0.0;
            let mut i = 0;
            while i < 3 {
                let (a, b) = (middle[i] - min[i] as f64, max[i] as f64 - middle[i]);
                let d = if a > b { a } else { b };
                far += d * d;
                i += 1;
            }
            far
        }
    }
}

const fn distance2(p: &[i32; 3], q: &[f64; 3]) -> f64 {
    let d = [p[0] as f64 - q[0], p[1] as f64 - q[1], p[2] as f64 - q[2]];
    d[0] * d[0] + d[1] * d[1] + d[2] * d[2]
}

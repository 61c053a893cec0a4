//! Which of a cell's eight octants a shape meets, in whole numbers.
//!
//! Each octant is enlarged by a margin on all sides. Spheres are hollow: an octant all inside
//! one doesn't meet it. Triangles by separating axes (Akenine-Möller, "Fast 3D Triangle-Box
//! Overlap Testing", Journal of Graphics Tools 6, 2001). All three tests are exact, so a shape
//! that meets a cell meets one of its octants.
//!
//! Cones and cylinders have a file of their own.
//!
//! Coordinates are below 2²⁸ and sides below 2³⁰: differences fit an `i32`, three squares or
//! two products of differences an `i64`; a triangle's plane alone needs an `i128`.

use super::Extent;

/// A cell about to be cut: the octants have the side `half`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    pub(super) min: [i32; 3],
    pub(super) half: i32,
    pub(super) margin: i32,
}

/// For each axis the octants of the lower half; the others are its complement.
const LOWER: [u8; 3] = [0x55, 0x33, 0x0f];

impl Cell {
    /// The octants that the extent meets, a bit each.
    pub(super) const fn octants(&self, extent: &Extent) -> u8 {
        self.octants_of(extent, 0xff)
    }

    /// Those of the octants `of`, a bit each, that the extent meets.
    pub(super) const fn octants_of(&self, extent: &Extent, of: u8) -> u8 {
        match extent {
            Extent::Box { min, max } => self.by_box(min, max) & of,
            Extent::Sphere { center, radius } => self.by_sphere(center, *radius, of),
            Extent::Round { .. } => self.by_round(extent, of),
            Extent::Triangle { corners } => self.by_triangle(corners, of),
        }
    }

    /// The octant's ends on an axis, the margin included.
    const fn ends(&self, axis: usize, upper: bool) -> (i32, i32) {
        let low = self.min[axis] + if upper { self.half } else { 0 };
        (low - self.margin, low + self.half + self.margin)
    }

    pub(super) const fn by_box(&self, min: &[i32; 3], max: &[i32; 3]) -> u8 {
        let mut octants = 0xff;
        let mut axis = 0;
        while axis < 3 {
            let (low, high) = self.ends(axis, false);
            if max[axis] < low || min[axis] > high {
                octants &= !LOWER[axis];
            }
            let (low, high) = self.ends(axis, true);
            if max[axis] < low || min[axis] > high {
                octants &= LOWER[axis];
            }
            axis += 1;
        }
        octants
    }

    const fn by_sphere(&self, center: &[i32; 3], radius: i32, of: u8) -> u8 {
        let (min, max) = bounds(&Extent::Sphere { center: *center, radius });
        let mut octants = self.by_box(&min, &max) & of;
        if octants == 0 {
            return 0;
        }
        // By axis and half: the squared distances of the nearest and of the farthest point.
        let mut near = [[0; 2]; 3];
        let mut far = [[0; 2]; 3];
        let mut axis = 0;
        while axis < 3 {
            let mut upper = 0;
            while upper < 2 {
                let (low, high) = self.ends(axis, upper == 1);
                let (a, b) = ((center[axis] - low) as i64, (high - center[axis]) as i64);
                near[axis][upper] = if a < 0 {
                    a * a
                } else if b < 0 {
                    b * b
                } else {
                    0
                };
                far[axis][upper] = if a > b { a * a } else { b * b };
                upper += 1;
            }
            axis += 1;
        }
        let square = radius as i64 * radius as i64;
        let mut i = 0;
        while i < 8 {
            let (x, y, z) = (i & 1, i >> 1 & 1, i >> 2);
            if near[0][x] + near[1][y] + near[2][z] > square
                || far[0][x] + far[1][y] + far[2][z] < square
            {
                octants &= !(1 << i);
            }
            i += 1;
        }
        octants
    }

    const fn by_triangle(&self, corners: &[[i32; 3]; 3], of: u8) -> u8 {
        let (min, max) = bounds(&Extent::Triangle { corners: *corners });
        let mut octants = self.by_box(&min, &max) & of;
        let mut i = 0;
        while i < 8 {
            if octants >> i & 1 != 0 && !self.octant_meets(i, corners) {
                octants &= !(1 << i);
            }
            i += 1;
        }
        octants
    }

    /// Whether none of the plane and the nine products of edges separates triangle and octant
    /// (their boxes are known to meet).
    const fn octant_meets(&self, octant: usize, corners: &[[i32; 3]; 3]) -> bool {
        let half = (self.half / 2 + self.margin) as i64;
        let mut v = [[0i64; 3]; 3];
        let mut axis = 0;
        while axis < 3 {
            let upper = octant as i32 >> axis & 1;
            let middle = self.min[axis] + upper * self.half + self.half / 2;
            let mut corner = 0;
            while corner < 3 {
                v[corner][axis] = (corners[corner][axis] - middle) as i64;
                corner += 1;
            }
            axis += 1;
        }
        let mut edge = 0;
        while edge < 3 {
            let from = v[edge];
            let to = v[(edge + 1) % 3];
            let e = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
            // The edge's ends have one projection, the third corner another.
            let third = v[(edge + 2) % 3];
            let mut axis = 0;
            while axis < 3 {
                let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
                let a = e[j] * from[k] - e[k] * from[j];
                let b = e[j] * third[k] - e[k] * third[j];
                let reach = half * (e[j].abs() + e[k].abs());
                if (a > reach && b > reach) || (a < -reach && b < -reach) {
                    return false;
                }
                axis += 1;
            }
            edge += 1;
        }
        let e = [v[1][0] - v[0][0], v[1][1] - v[0][1], v[1][2] - v[0][2]];
        let f = [v[2][0] - v[0][0], v[2][1] - v[0][1], v[2][2] - v[0][2]];
        let (mut height, mut reach) = (0i128, 0i128);
        let mut axis = 0;
        while axis < 3 {
            let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
            let n = (e[j] * f[k] - e[k] * f[j]) as i128;
            height += n * v[0][axis] as i128;
            reach += n.abs() * half as i128;
            axis += 1;
        }
        height.abs() <= reach
    }
}

/// The box around an extent.
pub(crate) const fn bounds(extent: &Extent) -> ([i32; 3], [i32; 3]) {
    match extent {
        Extent::Box { min, max } => (*min, *max),
        Extent::Sphere { center: c, radius: r } => {
            // Groups are bounded before anything says that their shapes fit a grid.
            let (mut min, mut max) = (*c, *c);
            let mut axis = 0;
            while axis < 3 {
                min[axis] = min[axis].saturating_sub(*r);
                max[axis] = max[axis].saturating_add(*r);
                axis += 1;
            }
            (min, max)
        }
        Extent::Round { ends, radii, .. } => super::round::bounds(ends, radii),
        Extent::Triangle { corners } => {
            let (mut min, mut max) = (corners[0], corners[0]);
            let mut corner = 1;
            while corner < 3 {
                let mut axis = 0;
                while axis < 3 {
                    let x = corners[corner][axis];
                    if x < min[axis] {
                        min[axis] = x;
                    }
                    if x > max[axis] {
                        max[axis] = x;
                    }
                    axis += 1;
                }
                corner += 1;
            }
            (min, max)
        }
    }
}

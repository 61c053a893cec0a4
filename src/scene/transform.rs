//! Where an object stands: a rotation, a uniform scale and a translation.

use crate::math::{sin_cos_degrees, unit_f64};

/// A rigid transform and a uniform scale, in plain numbers: p goes to
/// `rotation`·(`scale`·p) + `position`.
///
/// Made step by step, each after the one before, in `const`s too:
///
/// ```
/// use whitted::scene::Transform;
///
/// const LEANS: Transform =
///     Transform::IDENTITY.scaled(0.5).rotated([0.0, 0.0, 1.0], 20.0).moved([3.0, 0.0, 1.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// The rows of the rotation's matrix: each of unit length, at right angles, without a
    /// reflection.
    pub rotation: [[f64; 3]; 3],
    /// The scale, larger than 0.
    pub scale: f64,
    /// Where the origin comes to.
    pub position: [f64; 3],
}

impl Transform {
    /// Everything stays where it is.
    pub const IDENTITY: Self = Self {
        rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        scale: 1.0,
        position: [0.0; 3],
    };

    /// Moved by a vector.
    #[must_use]
    pub const fn moved(mut self, by: [f64; 3]) -> Self {
        let mut i = 0;
        while i < 3 {
            self.position[i] += by[i];
            i += 1;
        }
        self
    }

    /// Scaled about the origin.
    #[must_use]
    pub const fn scaled(mut self, by: f64) -> Self {
        self.scale *= by;
        let p = self.position;
        self.position = [p[0] * by, p[1] * by, p[2] * by];
        self
    }

    /// Rotated about a line through the origin, counter-clockwise for those whom the axis points
    /// at, by degrees (Rodrigues 1840). A null axis, or an angle beyond a million degrees, gives
    /// what no instance takes.
    #[must_use]
    pub const fn rotated(self, axis: [f64; 3], angle: f64) -> Self {
        let a = match unit_f64(axis) {
            Some(a) => a,
            None => [f64::NAN; 3],
        };
        let (sin, cos) = sin_cos_degrees(angle);
        let across = [[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]];
        let mut turn = [[0.0; 3]; 3];
        let mut i = 0;
        while i < 9 {
            let (row, column) = (i / 3, i % 3);
            let diagonal = if row == column { cos } else { 0.0 };
            turn[row][column] =
                diagonal + sin * across[row][column] + (1.0 - cos) * a[row] * a[column];
            i += 1;
        }
        self.turned(&turn)
    }

    /// Rotated about the origin by a matrix, given by its rows.
    #[must_use]
    pub const fn turned(mut self, by: &[[f64; 3]; 3]) -> Self {
        let old = self.rotation;
        let mut i = 0;
        while i < 9 {
            let (row, column) = (i / 3, i % 3);
            self.rotation[row][column] = by[row][0] * old[0][column]
                + by[row][1] * old[1][column]
                + by[row][2] * old[2][column];
            i += 1;
        }
        self.position = product(by, &self.position);
        self
    }

    /// Where a point comes to.
    pub const fn apply(&self, p: [f64; 3]) -> [f64; 3] {
        let s = self.scale;
        let p = product(&self.rotation, &[p[0] * s, p[1] * s, p[2] * s]);
        [p[0] + self.position[0], p[1] + self.position[1], p[2] + self.position[2]]
    }

    /// Whether the rotation is one, to a millionth.
    pub(crate) const fn is_rigid(&self) -> bool {
        let r = &self.rotation;
        let mut i = 0;
        while i < 9 {
            let (a, b) = (&r[i / 3], &r[i % 3]);
            let want = if i / 3 == i % 3 { 1.0 } else { 0.0 };
            let off = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] - want;
            // also false for what is no number
            if !(off > -1e-6 && off < 1e-6) {
                return false;
            }
            i += 1;
        }
        let c = crate::math::cross_f64(r[0], r[1]);
        c[0] * r[2][0] + c[1] * r[2][1] + c[2] * r[2][2] > 0.0
    }

    /// Whether nothing is turned.
    pub(crate) const fn is_upright(&self) -> bool {
        let r = &self.rotation;
        let mut i = 0;
        while i < 9 {
            let want = if i / 3 == i % 3 { 1.0 } else { 0.0 };
            if r[i / 3][i % 3] != want {
                return false;
            }
            i += 1;
        }
        true
    }
}

const fn product(m: &[[f64; 3]; 3], v: &[f64; 3]) -> [f64; 3] {
    [
        m[0][0] * v[0] + m[0][1] * v[1] + m[0][2] * v[2],
        m[1][0] * v[0] + m[1][1] * v[1] + m[1][2] * v[2],
        m[2][0] * v[0] + m[2][1] * v[1] + m[2][2] * v[2],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: [f64; 3], b: [f64; 3]) -> bool {
        (0..3).all(|i| (a[i] - b[i]).abs() < 1e-12)
    }

    #[test]
    fn one_after_the_other() {
        let t = Transform::IDENTITY.moved([1.0, 0.0, 0.0]).rotated([0.0, 0.0, 3.0], 90.0);
        assert!(near(t.apply([0.0; 3]), [0.0, 1.0, 0.0]));
        assert!(near(t.scaled(2.0).apply([1.0, 0.0, 0.0]), [0.0, 4.0, 0.0]));
        let t = Transform::IDENTITY.rotated([1.0, 1.0, 1.0], 120.0);
        assert!(near(t.apply([1.0, 2.0, 3.0]), [3.0, 1.0, 2.0]));
        assert!(t.is_rigid() && !t.is_upright() && Transform::IDENTITY.is_upright());
    }

    #[test]
    fn what_is_no_rotation() {
        assert!(!Transform::IDENTITY.rotated([0.0; 3], 10.0).is_rigid());
        let mut mirror = Transform::IDENTITY;
        mirror.rotation[0][0] = -1.0;
        assert!(!mirror.is_rigid());
    }
}

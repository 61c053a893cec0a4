//! Texture coordinates of triangles.

use bytemuck::AnyBitPattern;

use crate::blob::{Stored, put};
use crate::shape::ShapeError;

/// The texture coordinates (u, v) of a triangle's three corners, u to the right and v upwards, the
/// whole picture from 0 to 1: twelve bytes, in steps of 1/4096 between −8 and 8. (What a mesh has
/// beyond that is brought there by taking the same whole number from all three corners.)
#[derive(Clone, Copy, Debug, PartialEq, Eq, AnyBitPattern)]
#[repr(C)]
pub struct TriangleUv {
    corners_q12: [[i16; 2]; 3],
}

impl Stored for TriangleUv {
    fn store(&self, to: &mut [u8]) {
        put(&self.corners_q12, to, 0);
    }

    fn is_sound(&self) -> bool {
        true
    }
}

impl TriangleUv {
    /// The coordinates of the corners in a triangle's order, for scenes in `const`s.
    ///
    /// # Panics
    /// Where [`try_new`](Self::try_new) has an error.
    pub const fn new(corners: [[f64; 2]; 3]) -> Self {
        match Self::try_new(corners) {
            Ok(uv) => uv,
            Err(error) => panic!("{}", error.message()),
        }
    }

    /// The coordinates of the corners in a triangle's order.
    ///
    /// # Errors
    /// A coordinate that is no number or not between −8 and 8.
    pub const fn try_new(corners: [[f64; 2]; 3]) -> Result<Self, ShapeError> {
        let mut corners_q12 = [[0; 2]; 3];
        let mut i = 0;
        while i < 6 {
            let x = corners[i / 2][i % 2] * 4096.0;
            if !(x >= -32768.0 && x <= 32767.0) {
                return Err(ShapeError::Coordinate);
            }
            corners_q12[i / 2][i % 2] = (if x < 0.0 { x - 0.5 } else { x + 0.5 }) as i16;
            i += 1;
        }
        Ok(Self { corners_q12 })
    }

    /// The coordinates in 2⁻¹⁶, given the weights of the second and the third corner in 2⁻¹⁴.
    pub(crate) fn at(&self, second_q14: i32, third_q14: i32) -> [i32; 2] {
        let [a, b, c] = &self.corners_q12;
        let mix = |i: usize| {
            let (a, b, c) = (i32::from(a[i]), i32::from(b[i]), i32::from(c[i]));
            // Of 64 bits: two corners can be 2¹⁶ steps apart.
            let more =
                i64::from(b - a) * i64::from(second_q14) + i64::from(c - a) * i64::from(third_q14);
            (a << 4).wrapping_add((more >> 10) as i32)
        };
        [mix(0), mix(1)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_and_middles() {
        let uv = TriangleUv::new([[0.0, 0.0], [7.99, -8.0], [-8.0, 1.0]]);
        assert_eq!(uv.at(0, 0), [0, 0]);
        assert_eq!(uv.at(1 << 14, 0), [(7.99f64 * 4096.0 + 0.5) as i32 * 16, -8 << 16]);
        assert_eq!(uv.at(0, 1 << 14), [-8 << 16, 1 << 16]);
        assert_eq!(uv.at(0, 1 << 13), [-4 << 16, 1 << 15]);
        assert_eq!(size_of::<TriangleUv>(), 12);
        assert_eq!(TriangleUv::try_new([[8.0; 2]; 3]), Err(ShapeError::Coordinate));
        assert_eq!(TriangleUv::try_new([[f64::NAN; 2]; 3]), Err(ShapeError::Coordinate));
    }
}

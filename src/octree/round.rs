//! Which octants a cone, frustum or cylinder meets, nearly.
//!
//! It is the convex hull of two circles. Along a direction n it reaches to the farther of
//! n·end + r·|n⊥|, n⊥ being the part of n across the axis; an octant that lies wholly beyond that,
//! or before the other side's, is missed (the separating axis theorem). Any direction proves it, and
//! need not be exact as long as the reach along it is: here the axis, the three directions across
//! the axis and a side of the cell, and the wall's normal towards the octant. What no
//! direction proves is listed: a little more than would be needed, never less.
//!
//! Directions have fifteen bits and differences of positions 29, so products fit an `i64`.

use super::Extent;
use super::overlap::{Cell, bounds as bounds_of};

/// Fifteen bits and a sign.
const DIRECTION_BITS: u32 = 15;

type Wide = [i64; 3];

/// `a/b`, 0 for b = 0: no panic is left in the program.
const fn over(a: i64, b: i64) -> i64 {
    match a.checked_div(b) {
        Some(quotient) => quotient,
        None => 0,
    }
}

const fn dot(a: &Wide, b: &Wide) -> i64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

const fn minus(a: &[i32; 3], b: &[i32; 3]) -> Wide {
    [a[0] as i64 - b[0] as i64, a[1] as i64 - b[1] as i64, a[2] as i64 - b[2] as i64]
}

/// √x, rounded up; 0 for what is negative.
const fn root_up(x: i64) -> i64 {
    if x <= 0 {
        return 0;
    }
    let x = x as u64;
    let root = x.isqrt();
    (if root * root < x { root + 1 } else { root }) as i64
}

/// A vector brought to as many bits as a direction has, rounded towards 0; a null vector stays.
const fn direction(v: &Wide) -> Wide {
    let all = v[0].unsigned_abs() | v[1].unsigned_abs() | v[2].unsigned_abs();
    let bits = 64 - all.leading_zeros();
    let mut n = [0; 3];
    let mut i = 0;
    while i < 3 {
        n[i] = if bits > DIRECTION_BITS {
            over(v[i], 1 << ((bits - DIRECTION_BITS) & 63))
        } else {
            v[i] << ((DIRECTION_BITS - bits) & 63)
        };
        i += 1;
    }
    n
}

/// The box around both circles: along each axis a circle across n reaches r·√(1 − n²).
pub(super) const fn bounds(ends: &[[i32; 3]; 2], radii: &[i32; 2]) -> ([i32; 3], [i32; 3]) {
    let n = direction(&minus(&ends[1], &ends[0]));
    let square = dot(&n, &n);
    let length = if square > 0 { (square as u64).isqrt() as i64 } else { 1 };
    let (mut min, mut max) = ([i32::MAX; 3], [i32::MIN; 3]);
    let mut i = 0;
    while i < 6 {
        let (end, axis) = (i / 3, i % 3);
        // A direction is a step wrong, and its length half a step.
        let across = root_up(square - n[axis] * n[axis]) + 2;
        let reach = over(radii[end] as i64 * across, length) + 1;
        let reach = if reach < radii[end] as i64 { reach as i32 } else { radii[end] };
        let end = ends[end][axis];
        let (low, high) = (end.saturating_sub(reach), end.saturating_add(reach));
        min[axis] = if low < min[axis] { low } else { min[axis] };
        max[axis] = if high > max[axis] { high } else { max[axis] };
        i += 1;
    }
    (min, max)
}

/// Two circles around the ends of an axis.
struct Round<'e> {
    ends: &'e [[i32; 3]; 2],
    radii: &'e [i32; 2],
    axis: Wide,
}

impl Cell {
    /// The octants that the wall, or what it encloses, may meet.
    pub(super) const fn by_round(&self, extent: &Extent, of: u8) -> u8 {
        let Extent::Round { ends, radii, hollow } = extent else { return 0 };
        let (min, max) = bounds_of(extent);
        let mut octants = self.by_box(&min, &max) & of;
        if octants == 0 {
            return 0;
        }
        let axis = direction(&minus(&ends[1], &ends[0]));
        let round = Round { ends, radii, axis };
        let mut i = 0;
        while i < 8 {
            if octants >> i & 1 != 0 && !self.meets_round(i, &round, *hollow) {
                octants &= !(1 << i);
            }
            i += 1;
        }
        octants
    }

    const fn meets_round(&self, octant: usize, round: &Round<'_>, hollow: bool) -> bool {
        let half = (self.half / 2 + self.margin) as i64;
        let mut middle = self.min;
        let mut i = 0;
        while i < 3 {
            middle[i] += (octant as i32 >> i & 1) * self.half + self.half / 2;
            i += 1;
        }
        let a = &round.axis;
        // Along the axis a circle is as thick as the axis is inexact.
        if round.is_beyond(a, 2, &middle, half) {
            return false;
        }
        let sides = [[0, a[2], -a[1]], [-a[2], 0, a[0]], [a[1], -a[0], 0]];
        let mut i = 0;
        while i < 3 {
            let n = direction(&sides[i]);
            if round.is_beyond(&n, root_up(dot(&n, &n)), &middle, half) {
                return false;
            }
            i += 1;
        }
        // The way from the axis to the octant's point that is nearest to where the axis comes
        // nearest to its middle, and the wall's normal there.
        let square = dot(a, a);
        if square == 0 {
            return true;
        }
        let from = minus(&middle, &round.ends[0]);
        let along = dot(&from, a);
        let mut way = [0; 3];
        let mut i = 0;
        while i < 3 {
            let on = over(along * a[i], square);
            let (low, high) = (from[i] - half, from[i] + half);
            way[i] = if on < low {
                low
            } else if on > high {
                high
            } else {
                on
            };
            i += 1;
        }
        let (along, mut off) = (dot(&way, a), [0; 3]);
        let mut i = 0;
        while i < 3 {
            off[i] = way[i] - over(along * a[i], square);
            i += 1;
        }
        let off = direction(&off);
        let across = root_up(dot(&off, &off));
        if round.is_beyond(&off, across, &middle, half) {
            return false;
        }
        let slope = round.radii[0] as i64 - round.radii[1] as i64;
        if slope != 0 && across > 0 {
            let axis = minus(&round.ends[1], &round.ends[0]);
            let length = root_up(dot(&axis, &axis) >> 8) << 4;
            let rise = over(slope * across, length);
            let (mut n, unit) = ([0; 3], root_up(square));
            let mut i = 0;
            while i < 3 {
                n[i] = off[i] + over(a[i] * rise, unit);
                i += 1;
            }
            // What the axis is inexact by adds to the part across it.
            let across = across + 3 + over(2 * rise.abs(), unit);
            if round.is_beyond(&n, across, &middle, half) {
                return false;
            }
        }
        !(hollow && round.encloses(&middle, half))
    }
}

impl Round<'_> {
    /// Whether a cube around `middle` lies beyond along `n`, whose part across the axis is no
    /// longer than `across`.
    const fn is_beyond(&self, n: &Wide, across: i64, middle: &[i32; 3], half: i64) -> bool {
        let cube = half * (n[0].abs() + n[1].abs() + n[2].abs());
        let (mut beyond, mut before) = (true, true);
        let mut i = 0;
        while i < 2 {
            let at = dot(n, &minus(&self.ends[i], middle));
            let reach = cube + self.radii[i] as i64 * across;
            beyond = beyond && at > reach;
            before = before && at < -reach;
            i += 1;
        }
        beyond || before
    }

    /// Whether a cube around `middle` lies within the wall, however far that goes on: all its
    /// corners within the smaller of the two circles' radii from the axis.
    const fn encloses(&self, middle: &[i32; 3], half: i64) -> bool {
        let r = (if self.radii[0] < self.radii[1] { self.radii[0] } else { self.radii[1] }) as i64;
        if r <= half {
            return false;
        }
        let axis = minus(&self.ends[1], &self.ends[0]);
        let length2 = dot(&axis, &axis) as i128;
        let from = minus(middle, &self.ends[0]);
        let mut corner = 0;
        while corner < 8 {
            let mut p = from;
            let mut i = 0;
            while i < 3 {
                p[i] += if corner >> i & 1 != 0 { half } else { -half };
                i += 1;
            }
            let mut square = 0i128;
            let mut i = 0;
            while i < 3 {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                let c = (p[j] * axis[k] - p[k] * axis[j]) as i128;
                square += c * c;
                i += 1;
            }
            if square >= r as i128 * r as i128 * length2 {
                return false;
            }
            corner += 1;
        }
        true
    }
}

//! Halton's sequence ("On the efficiency of certain quasi-random sequences of points", 1960): the
//! digits of a number in a base, mirrored at the point, spread evenly over 0 to 1.

use core::num::NonZeroU32;

/// A base for each dimension.
const BASES: [NonZeroU32; 12] = {
    const PRIMES: [u32; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
    let mut bases = [NonZeroU32::MIN; 12];
    let mut i = 0;
    while i < 12 {
        if let Some(prime) = NonZeroU32::new(PRIMES[i]) {
            bases[i] = prime;
        }
        i += 1;
    }
    bases
};

/// Coordinate `dimension` of point `index`, in Q16, below 1.
pub(super) fn halton_q16(index: u32, dimension: usize) -> u32 {
    let base = BASES.get(dimension).copied().unwrap_or(NonZeroU32::MIN.saturating_add(1));
    let (mut left, mut place, mut sum) = (index, u32::MAX, 0u32);
    while left != 0 && place != 0 {
        place /= base;
        sum = sum.wrapping_add(place.wrapping_mul(left % base));
        left /= base;
    }
    sum >> 16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_mirrored() {
        let first = |dimension| [1, 2, 3, 4].map(|i| (halton_q16(i, dimension) + 8) >> 4 << 4);
        assert_eq!(first(0), [0x8000, 0x4000, 0xc000, 0x2000]);
        // 1/3, 2/3, 1/9, 4/9
        let thirds = [65536 / 3, 131072 / 3, 65536 / 9, 4 * 65536 / 9];
        assert!(first(1).iter().zip(thirds).all(|(a, b)| a.abs_diff(b) < 20));
        assert!((0..5000).all(|i| halton_q16(i, 11) < 65536));
    }
}

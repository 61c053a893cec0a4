//! Regions: which combinations of operands make up a solid.
//!
//! A point lies inside some of the operands and outside the others: one of 2⁸ combinations. A
//! region is the table of those that belong to the solid, which any union, intersection and
//! difference of any depth comes down to; nothing is left to evaluate along a ray but a look into
//! the table.

/// Which combinations of up to eight operands belong to a solid.
///
/// ```
/// use whitted::shape::Region;
///
/// // The first without the second and the third.
/// const DRILLED: Region = Region::of(0).minus(Region::of(1).or(Region::of(2)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region([u32; Self::WORDS]);

impl Region {
    /// How many operands there may be.
    pub const OPERANDS: usize = 8;
    const WORDS: usize = (1 << Self::OPERANDS) / 32;

    /// Nothing.
    pub const NOTHING: Self = Self([0; Self::WORDS]);

    /// The inside of an operand, by its place among the solid's; nothing from
    /// [`OPERANDS`](Self::OPERANDS) on.
    pub const fn of(operand: usize) -> Self {
        // Bit m is set if m has the operand's bit.
        const WITHIN_A_WORD: [u32; 5] =
            [0xaaaa_aaaa, 0xcccc_cccc, 0xf0f0_f0f0, 0xff00_ff00, 0xffff_0000];
        let mut words = [0; Self::WORDS];
        let mut i = 0;
        while i < Self::WORDS && operand < Self::OPERANDS {
            words[i] = if operand < WITHIN_A_WORD.len() {
                WITHIN_A_WORD[operand]
            } else if i >> (operand - WITHIN_A_WORD.len()) & 1 != 0 {
                u32::MAX
            } else {
                0
            };
            i += 1;
        }
        Self(words)
    }

    /// The table, for a blob: bit m of all words is set if points inside of just the operands
    /// whose bits m has are in the region.
    pub(crate) const fn words(&self) -> &[u32; 8] {
        &self.0
    }

    /// Of such a table.
    pub(crate) const fn of_words(words: [u32; 8]) -> Self {
        Self(words)
    }

    /// What is in either: the union.
    #[must_use]
    pub const fn or(mut self, other: Self) -> Self {
        let mut i = 0;
        while i < Self::WORDS {
            self.0[i] |= other.0[i];
            i += 1;
        }
        self
    }

    /// What is in both: the intersection.
    #[must_use]
    pub const fn and(mut self, other: Self) -> Self {
        let mut i = 0;
        while i < Self::WORDS {
            self.0[i] &= other.0[i];
            i += 1;
        }
        self
    }

    /// What is in this one alone: the difference.
    #[must_use]
    pub const fn minus(mut self, other: Self) -> Self {
        let mut i = 0;
        while i < Self::WORDS {
            self.0[i] &= !other.0[i];
            i += 1;
        }
        self
    }

    /// Whether nothing is in it.
    pub const fn is_nothing(&self) -> bool {
        let mut i = 0;
        while i < Self::WORDS {
            if self.0[i] != 0 {
                return false;
            }
            i += 1;
        }
        true
    }

    /// Whether a point inside just these operands, a bit each, belongs to the solid.
    #[inline(always)]
    pub const fn holds(&self, operands: u8) -> bool {
        self.0[(operands >> 5) as usize % Self::WORDS] >> (operands & 31) & 1 != 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_the_words_say() {
        let solid = Region::of(0).or(Region::of(6)).minus(Region::of(2)).and(Region::of(7));
        for m in 0..=255u8 {
            let has = |k: u8| m >> k & 1 != 0;
            assert_eq!(solid.holds(m), (has(0) || has(6)) && !has(2) && has(7), "{m}");
        }
        assert!(Region::of(8).is_nothing() && Region::of(1).minus(Region::of(1)).is_nothing());
    }
}

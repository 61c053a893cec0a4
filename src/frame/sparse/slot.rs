//! What is remembered of a ray: its display values, and a word that says how it differs from others.
//!
//! Three channels are handled at once. Display values are 16 bits each, red and green in one word, blue
//! in another; the mean of two halves of a word is what they share and half of what they don't. The word
//! that is compared has the upper eight bits of each channel, in lanes of ten: with a bit set above
//! the lanes of one word, another can be subtracted, and what is left of that bit says which
//! was larger.

/// A 1 in each lane.
const ONES: u32 = 1 | 1 << 10 | 1 << 20;
/// The bit above a lane's eight and the one that follows.
const GUARDS: u32 = ONES << 9;
/// A lane's eight bits.
const LANES: u32 = ONES * 255;
/// Of the word that is compared: a ray has been sent, and has become more than [`FEW_RAYS`].
const KNOWN: u32 = 1 << 30;
const COSTLY: u32 = 1 << 31;
/// More rays than these, of all kinds, are many.
pub(in crate::frame) const FEW_RAYS: u32 = 5;

/// Display values: red, and green in the upper half; blue, and above it what the sampler notes.
pub(super) type Values = [u32; 2];

/// Three channels as they are remembered.
#[inline(always)]
pub(super) fn pack([r, g, b]: [u16; 3]) -> Values {
    [u32::from(r) | u32::from(g) << 16, u32::from(b)]
}

/// And back.
#[inline(always)]
pub(super) fn unpack([rg, b]: Values) -> [u16; 3] {
    [rg as u16, (rg >> 16) as u16, b as u16]
}

/// The middle between two.
#[inline(always)]
pub(super) fn mean([a, b]: Values, [c, d]: Values) -> Values {
    let rg = (a & c).wrapping_add((a ^ c) >> 1 & 0x7fff_7fff);
    [rg, (b & 0xffff).wrapping_add(d & 0xffff) >> 1]
}

/// The word of a ray that is compared.
#[inline(always)]
pub(super) fn lanes([rg, b]: Values, costly: bool) -> u32 {
    let colors = rg >> 8 & 255 | rg >> 14 & 255 << 10 | (b & 0xff00) << 12;
    colors | KNOWN | if costly { COSTLY } else { 0 }
}

/// That of the middle between two, where no ray has been sent.
#[inline(always)]
pub(super) fn between(a: u32, b: u32) -> u32 {
    (a & LANES).wrapping_add(b & LANES) >> 1 & LANES | a & b & COSTLY
}

/// Whether a ray has been sent.
#[inline(always)]
pub(super) fn is_known(lanes: u32) -> bool {
    lanes & KNOWN != 0
}

/// Whether rays have been sent for three of four.
#[inline(always)]
pub(super) fn are_three_known([a, b, c, d]: [u32; 4]) -> bool {
    is_known(a & b & (c | d) | c & d & (a | b))
}

/// By how much channels may differ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Set above the lanes, and the threshold in each.
    usual: u32,
    /// The same where all took many rays.
    costly: u32,
}

impl Limits {
    pub(super) const fn new(threshold: u8) -> Self {
        // A lane holds no more than 255 below the bit above it; nothing differs by more.
        let more = threshold.saturating_add(threshold >> 1);
        Self { usual: GUARDS + ONES * threshold as u32, costly: GUARDS + ONES * more as u32 }
    }

    /// Whether any two of four differ.
    #[inline(always)]
    pub(super) fn differ(&self, [a, b, c, d]: [u32; 4]) -> bool {
        let limit = if a & b & c & d & COSTLY == 0 { self.usual } else { self.costly };
        // A lane's upper bit stays where the second is no more than the limit above the first.
        let (p, q) = (a.wrapping_add(limit), b.wrapping_add(limit));
        let (r, s) = (c.wrapping_add(limit), d.wrapping_add(limit));
        let within = p.wrapping_sub(b)
            & p.wrapping_sub(c)
            & p.wrapping_sub(d)
            & q.wrapping_sub(a)
            & q.wrapping_sub(c)
            & q.wrapping_sub(d)
            & r.wrapping_sub(a)
            & r.wrapping_sub(b)
            & r.wrapping_sub(d)
            & s.wrapping_sub(a)
            & s.wrapping_sub(b)
            & s.wrapping_sub(c);
        !within & GUARDS != 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    extern crate std;
    use std::vec::Vec;

    fn ramp() -> Vec<[u16; 3]> {
        let mut random = 1u32;
        let mut next = || {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (random >> 16) as u16
        };
        let mut all: Vec<_> = (0..60).map(|_| [next(), next(), next()]).collect();
        all.extend((0..60).map(|_| [next() >> 4, 0x8000 + (next() >> 3), 0xffff - (next() >> 5)]));
        all.extend([[0; 3], [65535; 3], [65535, 0, 65535], [0, 65535, 0]]);
        all
    }

    #[test]
    fn means_are_those_of_the_channels() {
        for a in ramp() {
            assert_eq!(unpack(pack(a)), a);
            for b in ramp() {
                let mean = unpack(mean(pack(a), pack(b)));
                let lanes = between(lanes(pack(a), true), lanes(pack(b), false));
                assert!(!is_known(lanes) && lanes & COSTLY == 0);
                for i in 0..3 {
                    let sum = u32::from(a[i]) + u32::from(b[i]);
                    assert_eq!(u32::from(mean[i]), sum / 2);
                    let eight = u32::from(a[i] >> 8) + u32::from(b[i] >> 8);
                    assert_eq!(lanes >> (10 * i) & 1023, eight / 2);
                }
            }
        }
    }

    #[test]
    fn four_differ_if_a_channel_does_by_more_than_the_threshold() {
        let all = ramp();
        for (threshold, costly) in [(0, 0), (1, 1), (19, 28), (127, 190), (200, 255), (255, 255)] {
            let limits = Limits::new(threshold);
            for i in 0..2000 {
                let four =
                    [i, i * 7 + 3, i * 13 + 5, i * 31 + 8].map(|i: usize| all[i % all.len()]);
                let most = |limit: u8| {
                    (0..3).any(|i| {
                        let channel = four.map(|rgb| rgb[i] >> 8);
                        let (low, high) =
                            (channel.iter().min().unwrap(), channel.iter().max().unwrap());
                        high - low > u16::from(limit)
                    })
                };
                let words = |costly| four.map(|rgb| lanes(pack(rgb), costly));
                assert_eq!(limits.differ(words(false)), most(threshold), "{threshold} {four:?}");
                assert_eq!(limits.differ(words(true)), most(costly), "{threshold} {four:?}");
                let [a, b, c, _] = words(true);
                assert_eq!(limits.differ([a, b, c, words(false)[3]]), most(threshold));
            }
        }
    }
}

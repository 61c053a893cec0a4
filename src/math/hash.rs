//! Numbers that look random and are the same on every machine.

/// A 32-bit hash whose every output bit depends on every input bit (Wellons, "Prospecting for
/// hash functions", 2018: `lowbias32`).
#[inline(always)]
pub(crate) fn hash(x: u32) -> u32 {
    let x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    let x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

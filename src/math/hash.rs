//! Numbers that look random and are the same on every machine.

/// A 32-bit hash whose every output bit depends on every input bit (Wellons, "Prospecting for
/// hash functions", 2018: `lowbias32`).
#[inline(always)]
pub(crate) fn hash(x: u32) -> u32 {
    let x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    let x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// One number of two, for values that are far from random, as a pixel's coordinates are.
#[inline(always)]
pub(crate) fn spread(a: u32, b: u32) -> u32 {
    // Odd factors without pattern (2³² over the golden ratio; from xxHash, Collet 2012).
    a.wrapping_mul(0x9e37_79b9).wrapping_add(b.wrapping_mul(0x85eb_ca77))
}

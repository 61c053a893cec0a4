//! FNV-1a (Fowler, Noll, Vo), 64 bits: one multiplication a byte, no table, and a single wrong
//! bit anywhere in a picture changes it.

/// A running checksum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Checksum(u64);

impl Checksum {
    /// The checksum of no bytes: FNV's offset basis.
    pub const EMPTY: Self = Self(0xCBF2_9CE4_8422_2325);

    /// FNV's prime, 2⁴⁰ + 2⁸ + 0xB3.
    const PRIME: u64 = 0x0000_0100_0000_01B3;

    /// Adds bytes.
    pub fn add(&mut self, bytes: impl IntoIterator<Item = u8>) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(Self::PRIME);
        }
    }

    /// The value so far.
    #[must_use]
    pub fn value(self) -> u64 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::Checksum;

    /// From the authors' list of test vectors.
    #[test]
    fn published_values() {
        for (bytes, value) in [
            ("", 0xCBF2_9CE4_8422_2325),
            ("a", 0xAF63_DC4C_8601_EC8C),
            ("foobar", 0x8594_4171_F739_67E8),
        ] {
            let mut sum = Checksum::EMPTY;
            sum.add(bytes.bytes());
            assert_eq!(sum.value(), value, "{bytes:?}");
        }
    }
}

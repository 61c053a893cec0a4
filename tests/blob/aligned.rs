//! Memory for blobs.

use whitted::blob::seal;

/// Bytes that start where a blob's must.
pub(super) struct Aligned(Vec<u64>, usize);

impl Aligned {
    pub(super) fn of(bytes: &[u8]) -> Self {
        let mut words = vec![0u64; bytes.len().div_ceil(8)];
        for (word, chunk) in words.iter_mut().zip(bytes.chunks(8)) {
            let mut eight = [0; 8];
            eight[..chunk.len()].copy_from_slice(chunk);
            *word = u64::from_ne_bytes(eight);
        }
        Self(words, bytes.len())
    }

    pub(super) fn bytes(&self) -> &[u8] {
        &bytemuck::cast_slice(&self.0)[..self.1]
    }

    pub(super) fn set(&mut self, at: usize, value: u8) {
        bytemuck::cast_slice_mut::<u64, u8>(&mut self.0)[at] = value;
    }

    pub(super) fn seal(&mut self) {
        seal(&mut bytemuck::cast_slice_mut::<u64, u8>(&mut self.0)[..self.1]);
    }
}

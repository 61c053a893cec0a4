//! Numbers that look random and are the same every time.

/// xorshift64*, so that a failure can be repeated.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    pub fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    pub fn below(&mut self, n: u64) -> u64 {
        (self.next() >> 33) % n
    }

    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.next() >> 11) as f64 / (1u64 << 53) as f64)
    }

    pub fn point(&mut self, r: f64) -> [f64; 3] {
        [self.within(-r, r), self.within(-r, r), self.within(-r, r)]
    }

    /// A unit vector, all directions alike.
    pub fn direction(&mut self) -> [f64; 3] {
        loop {
            let v = self.point(1.0);
            let l = v.iter().map(|x| x * x).sum::<f64>().sqrt();
            if l > 0.1 && l <= 1.0 {
                return v.map(|x| x / l);
            }
        }
    }
}

//! Points in space, as far as reading and placing a scene needs them.

/// A point or a vector.
pub type Point = [f64; 3];

/// A value for each channel, red first, linear.
pub type Rgb = [f64; 3];

/// `a + b`.
pub fn add(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// `a − b`.
pub fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// `a·s`.
pub fn scaled(a: Point, s: f64) -> Point {
    [a[0] * s, a[1] * s, a[2] * s]
}

/// The scalar product.
pub fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The vector product.
pub fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// |a|.
pub fn length(a: Point) -> f64 {
    dot(a, a).sqrt()
}

/// The unit vector along `a`; `None` where `a` is null or not finite.
pub fn normalized(a: Point) -> Option<Point> {
    let l = length(a);
    (l > 0.0 && l.is_finite()).then(|| scaled(a, 1.0 / l))
}

/// A box along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The corner with the smallest coordinates.
    pub low: Point,
    /// The corner with the largest ones.
    pub high: Point,
}

impl Bounds {
    /// The box around points; `None` where there are none.
    pub fn around(points: &[Point]) -> Option<Self> {
        points.iter().map(|&p| Self { low: p, high: p }).reduce(Self::union)
    }

    /// The box around both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        let with = |pick: fn(f64, f64) -> f64, a: Point, b: Point| {
            [pick(a[0], b[0]), pick(a[1], b[1]), pick(a[2], b[2])]
        };
        Self {
            low: with(f64::min, self.low, other.low),
            high: with(f64::max, self.high, other.high),
        }
    }

    /// The box that both have in common, if they meet.
    #[must_use]
    pub fn intersection(self, other: Self) -> Self {
        let with = |pick: fn(f64, f64) -> f64, a: Point, b: Point| {
            [pick(a[0], b[0]), pick(a[1], b[1]), pick(a[2], b[2])]
        };
        Self {
            low: with(f64::max, self.low, other.low),
            high: with(f64::min, self.high, other.high),
        }
    }

    /// Its middle.
    pub fn center(&self) -> Point {
        scaled(add(self.low, self.high), 0.5)
    }

    /// The largest of its three sides.
    pub fn side(&self) -> f64 {
        let d = sub(self.high, self.low);
        d[0].max(d[1]).max(d[2])
    }
}

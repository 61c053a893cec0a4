//! Vectors are arrays of three; what they need beyond the arithmetic stands here.

use super::{Number, Rgb};

/// `a + b`.
#[inline(always)]
pub fn add<T: Number>(a: &[T; 3], b: &[T; 3]) -> [T; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// `a − b`.
#[inline(always)]
pub fn sub<T: Number>(a: &[T; 3], b: &[T; 3]) -> [T; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// `−a`.
#[inline(always)]
pub fn neg<T: Number>(a: &[T; 3]) -> [T; 3] {
    [-a[0], -a[1], -a[2]]
}

/// The component of `v` along an axis: 0 is x, 1 is y, anything else z.
#[inline(always)]
pub fn axis_of<T: Copy>(v: &[T; 3], axis: u8) -> T {
    match axis {
        0 => v[0],
        1 => v[1],
        _ => v[2],
    }
}

/// The largest channel.
#[inline(always)]
pub fn largest<T: Number>(c: &Rgb<T>) -> T {
    let m = if c[0] > c[1] { c[0] } else { c[1] };
    if c[2] > m { c[2] } else { m }
}

/// `f` of each channel of two triples.
#[inline(always)]
pub fn rgb<T: Copy, U: Copy, V>(a: &Rgb<T>, b: &Rgb<U>, f: impl Fn(T, U) -> V) -> Rgb<V> {
    [f(a[0], b[0]), f(a[1], b[1]), f(a[2], b[2])]
}

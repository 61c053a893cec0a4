use core::fmt;

/// Why a shape, light, material or camera can't be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ShapeError {
    /// A coordinate is not a number, or beyond ±1024 in fixed point and ±10⁸ in floating point.
    Coordinate,
    /// A radius or size is not positive, below 1/4096 in fixed point, or too large.
    Size,
    /// A direction, normal or axis is null or not a number.
    Direction,
    /// The corners lie on a line or a point.
    Degenerate,
    /// A polygon is not convex, not plane, or has fewer than three corners or more than 255.
    Polygon,
    /// A coefficient is negative, not a number, or larger than its range.
    Coefficient,
    /// A solid has more than eight operands, or none, or neither an inside nor an end.
    Operands,
    /// The material's index is 32768 or more.
    Material,
    /// An image's size, palette and bytes don't fit together.
    Image,
    /// The shadow rays to an area light are none, more than 1024, or at least more than at most.
    Samples,
}

impl ShapeError {
    /// What is wrong, in words: for `const` panics and logs.
    pub const fn message(self) -> &'static str {
        match self {
            Self::Coordinate => "a coordinate is not a number or out of range",
            Self::Size => "a radius or size is not positive or out of range",
            Self::Direction => "a direction is null or not a number",
            Self::Degenerate => "the corners lie on a line",
            Self::Polygon => "a polygon must be convex, plane, and of 3 to 255 corners",
            Self::Coefficient => "a coefficient is negative, not a number, or out of range",
            Self::Operands => "a solid needs one to eight operands, an inside and an end",
            Self::Material => "a material's index is 32768 or more",
            Self::Image => "an image's size, palette and bytes don't fit together",
            Self::Samples => "an area light takes 1 to 1024 shadow rays, at least as many at most",
        }
    }
}

impl fmt::Display for ShapeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.message())
    }
}

impl core::error::Error for ShapeError {}

/// `value` or the error: `?` for const fns.
macro_rules! some_or {
    ($value:expr, $error:ident) => {
        match $value {
            Some(value) => value,
            None => return Err($crate::shape::ShapeError::$error),
        }
    };
}
pub(crate) use some_or;

/// The value or a panic with the error's words, for constructors in `const` context.
macro_rules! ok_or_panic {
    ($result:expr) => {
        match $result {
            Ok(value) => value,
            Err(error) => panic!("{}", error.message()),
        }
    };
}
pub(crate) use ok_or_panic;

/// Three coordinates from `f64`.
macro_rules! point {
    ($make:ident, $v:expr) => {{
        let v = $v;
        [
            $crate::shape::some_or!($make::length(v[0]), Coordinate),
            $crate::shape::some_or!($make::length(v[1]), Coordinate),
            $crate::shape::some_or!($make::length(v[2]), Coordinate),
        ]
    }};
}
pub(crate) use point;

/// Three coordinates as the arithmetic rounds them, in `f64` again.
macro_rules! rounded_point {
    ($make:ident, $v:expr) => {{
        let v = $crate::shape::point!($make, $v);
        [$make::from_length(v[0]), $make::from_length(v[1]), $make::from_length(v[2])]
    }};
}
pub(crate) use rounded_point;

/// The unit vector along an `f64` vector.
macro_rules! unit_vector {
    ($make:ident, $v:expr) => {{
        let v = $crate::shape::some_or!($crate::math::unit_f64($v), Direction);
        [
            $crate::shape::some_or!($make::unit(v[0]), Direction),
            $crate::shape::some_or!($make::unit(v[1]), Direction),
            $crate::shape::some_or!($make::unit(v[2]), Direction),
        ]
    }};
}
pub(crate) use unit_vector;

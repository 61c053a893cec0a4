//! Values that lie in a blob as they lie in memory.
//!
//! Every pattern of bits is a value of these types ([`AnyBitPattern`]), so that slices of bytes
//! can be slices of shapes without being copied; whether a value is one that a constructor could
//! have made is asked once, by [`Stored::is_sound`]. What they look like in memory is C's rule,
//! little-endian, padding zero.

use bytemuck::{AnyBitPattern, Pod};

use crate::math::{Arithmetic, Number};

/// A value that can be read in place.
pub trait Stored: AnyBitPattern {
    /// Writes the value as it lies in memory into as many bytes, which are zero.
    fn store(&self, to: &mut [u8]);
    /// Whether the value is within the ranges that constructors keep.
    fn is_sound(&self) -> bool;
}

/// Writes plain numbers at a place; beyond the end nothing is written.
pub(crate) fn put<T: Pod>(value: &T, to: &mut [u8], at: usize) {
    put_with(to, at, size_of::<T>(), |part| {
        let bytes = bytemuck::bytes_of(value);
        part.iter_mut().zip(bytes).for_each(|(to, from)| *to = *from);
    });
}

/// Writes a nested value at a place.
pub(crate) fn put_nested<T: Stored>(value: &T, to: &mut [u8], at: usize) {
    put_with(to, at, size_of::<T>(), |part| value.store(part));
}

fn put_with(to: &mut [u8], at: usize, size: usize, write: impl FnOnce(&mut [u8])) {
    if let Some(part) = to.get_mut(at..).and_then(|rest| rest.get_mut(..size)) {
        write(part);
    }
}

/// No number is larger than this, either way, nor none at all.
pub(crate) fn within<N: Number>(numbers: &[N], most: f64) -> bool {
    // A comparison with what is no number is false.
    numbers.iter().all(|&x| {
        let x: f64 = x.into();
        x >= -most && x <= most
    })
}

/// Lengths: coordinates, and sums of few of them.
pub(crate) fn lengths<A: Arithmetic>(numbers: &[A::Length]) -> bool {
    let far: f64 = A::FAR.into();
    within(numbers, 4.0 * far)
}

/// Components of unit vectors, and what rounding adds.
pub(crate) fn units<A: Arithmetic>(numbers: &[A::Unit]) -> bool {
    within(numbers, 1.001)
}

/// Implements [`Stored`] for a shape: each field with what it holds. All fields must be named.
///
/// `length`, `lengths`, `unit`, `units`: numbers, alone or in an array; `whole`: whatever bits;
/// `nested`: another such type. After `if` stands what must hold besides.
macro_rules! stored {
    ($type:ident { $($field:ident: $kind:ident),* $(,)? } $(if $sound:expr)?) => {
        impl<A: $crate::math::Arithmetic> $crate::blob::Stored for $type<A> {
            fn store(&self, to: &mut [u8]) {
                let Self { $($field),* } = self;
                $(stored!(@put $kind, $field, to, core::mem::offset_of!(Self, $field));)*
            }

            fn is_sound(&self) -> bool {
                #[allow(unused_variables)]
                let Self { $($field),* } = self;
                true $(&& stored!(@sound $kind, $field))* $(&& $sound)?
            }
        }
    };
    (@put nested, $field:ident, $to:ident, $at:expr) => {
        $crate::blob::stored::put_nested($field, $to, $at)
    };
    (@put $kind:ident, $field:ident, $to:ident, $at:expr) => {
        $crate::blob::stored::put($field, $to, $at)
    };
    (@sound nested, $field:ident) => { $crate::blob::Stored::is_sound($field) };
    (@sound whole, $field:ident) => { true };
    (@sound length, $field:ident) => {
        $crate::blob::stored::lengths::<A>(core::slice::from_ref($field))
    };
    (@sound lengths, $field:ident) => { $crate::blob::stored::lengths::<A>($field) };
    (@sound unit, $field:ident) => {
        $crate::blob::stored::units::<A>(core::slice::from_ref($field))
    };
    (@sound normals, $field:ident) => {
        $field.iter().all($crate::blob::Stored::is_sound)
    };
    (@sound units, $field:ident) => { $crate::blob::stored::units::<A>($field) };
}
pub(crate) use stored;

/// The same for the precomputed numbers of an arithmetic, which have plain fields.
macro_rules! stored_numbers {
    (for<$f:ident: $bound:ident> $type:ident { $($rest:tt)* } if |$s:ident| $sound:expr) => {
        impl<$f: $bound> $crate::blob::Stored for $type<$f> {
            stored_numbers!(@methods { $($rest)* } |$s| $sound);
        }
    };
    ($type:ident { $($rest:tt)* } if |$s:ident| $sound:expr) => {
        impl $crate::blob::Stored for $type {
            stored_numbers!(@methods { $($rest)* } |$s| $sound);
        }
    };
    (@methods { $($field:ident),* $(,)? } |$s:ident| $sound:expr) => {
        fn store(&self, to: &mut [u8]) {
            let Self { $($field),* } = self;
            $($crate::blob::stored::put($field, to, core::mem::offset_of!(Self, $field));)*
        }

        fn is_sound(&self) -> bool {
            let $s = self;
            $sound
        }
    };
}
pub(crate) use stored_numbers;

impl Stored for u32 {
    fn store(&self, to: &mut [u8]) {
        put(self, to, 0);
    }

    fn is_sound(&self) -> bool {
        true
    }
}

impl Stored for u8 {
    fn store(&self, to: &mut [u8]) {
        put(self, to, 0);
    }

    fn is_sound(&self) -> bool {
        true
    }
}

/// Intensities, which in floating point are a number alone.
macro_rules! intensities {
    ($($type:ty),*) => {
        $(
            impl Stored for $type {
                fn store(&self, to: &mut [u8]) {
                    put(self, to, 0);
                }

                fn is_sound(&self) -> bool {
                    *self >= 0.0 && *self <= 1e12
                }
            }
        )*
    };
}

intensities!(f32, f64);

/// A mesh's normal, whose components are numbers of their own.
macro_rules! normals {
    ($($type:ty: |$x:ident| $sound:expr),*) => {
        $(
            impl Stored for [$type; 3] {
                fn store(&self, to: &mut [u8]) {
                    put(self, to, 0);
                }

                fn is_sound(&self) -> bool {
                    self.iter().all(|&$x| $sound)
                }
            }
        )*
    };
}

normals!(
    i16: |x| (-16384..=16384).contains(&x),
    f32: |x| (-1.001..=1.001).contains(&x),
    f64: |x| (-1.001..=1.001).contains(&x)
);

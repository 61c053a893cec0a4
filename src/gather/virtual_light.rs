//! Instant radiosity: diffuse interreflection from virtual lights.
//!
//! Keller, "Instant radiosity", SIGGRAPH 1997: paths from the lights leave, at each diffuse surface
//! they meet, a virtual light that stands for what the surface sends on. Of N paths from a point
//! light of intensity I (over π), each virtual light at y adds to E/π at x
//!
//! (4·I/N)·Πk_d·cos θ_x·cos θ_y/r²,
//!
//! Πk_d being the albedos along the path, that at y included, and r no less than a given distance:
//! without that limit bright spots grow in corners (with it corners are a little too dark). A path
//! stops at a mirror or glass, so the light has gone L(D)*DE.
//!
//! **Interleaved** (Keller and Heidrich, "Interleaved sampling", 2001): the pixels of a tile of n×n
//! take turns with the n×n parts of the lights, each n² times as bright. The parts follow each
//! other in the sequence, so that each is spread evenly.

use bytemuck::AnyBitPattern;

use super::record::square;
use crate::blob::stored;
use crate::math::{Arithmetic, Rgb, for_each_arithmetic};
use crate::shape::{ShapeError, ok_or_panic, point, some_or};

/// A virtual light as a baker writes it, in plain numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VirtualLightSpec {
    /// Where.
    pub position: [f64; 3],
    /// The unit normal of the surface there, on the side that it sends light to.
    pub normal: [f64; 3],
    /// Sixteen times what it adds over a distance of 1, in the largest channel before the albedos.
    pub intensity: f64,
    /// The part of that in each channel with the albedos along the path, 0 to 1. A light whose
    /// channels are all 0 shines on nothing.
    pub color: Rgb<f64>,
}

/// A virtual light; 28 bytes in fixed point, and in `f32`; 40 in `f64`.
#[derive(Clone, Copy, Debug, AnyBitPattern)]
#[repr(C)]
pub struct VirtualLight<A: Arithmetic> {
    pub(crate) position: [A::Length; 3],
    /// Sixteen times what it adds, see above, in the largest channel before the albedos.
    pub(crate) intensity: A::Intensity,
    pub(crate) normal_q14: [i16; 3],
    /// The channels with the albedos along the path.
    pub(crate) color_q15: [u16; 3],
}

stored!(VirtualLight {
    position: lengths, intensity: nested, normal_q14: whole, color_q15: whole,
} if color_q15.iter().all(|&c| c <= 33096)
    && square(normal_q14, 1.0 / 16384.0, if *color_q15 == [0; 3] { 0.0 } else { 0.98 }, 1.02));

const _: () = assert!(size_of::<VirtualLight<crate::math::Fixed>>() == 28);
const _: () = assert!(size_of::<VirtualLight<f32>>() == 28);

impl<A: Arithmetic> VirtualLight<A> {
    /// One that doesn't shine: what a pool is made of before lights are laid.
    pub const NONE: Self = Self {
        position: [A::NO_LENGTH; 3],
        intensity: A::NO_INTENSITY,
        normal_q14: [0; 3],
        color_q15: [0; 3],
    };

    pub(crate) fn normal(&self) -> [A::Unit; 3] {
        let n = &self.normal_q14;
        let f = |i: usize| A::fraction(i32::from(n[i]) << 2);
        [f(0), f(1), f(2)]
    }

    pub(crate) fn color(&self) -> Rgb<A::Weight> {
        self.color_q15.map(|c| A::weight_of(A::fraction(i32::from(c) << 1)))
    }

    /// Whether it shines at all.
    pub(crate) fn is_dark(&self) -> bool {
        self.color_q15 == [0; 3]
    }
}

/// How virtual lights are laid and used, in plain numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VirtualLightsSpec {
    /// How many virtual lights a path leaves, 1 to 4: how many times light is passed on.
    pub bounces: u8,
    /// n: 1, 2 or 4.
    pub tile: u8,
    /// r is taken for at least this.
    pub nearest: f64,
    /// The middle of a ball that the scene lies in: where the paths of directional lights come from.
    pub center: [f64; 3],
    /// Its radius; 0 leaves directional lights out.
    pub radius: f64,
}

impl VirtualLightsSpec {
    /// One bounce, all lights for every pixel, without directional lights.
    pub const DEFAULT: Self =
        Self { bounces: 1, tile: 1, nearest: 0.25, center: [0.0; 3], radius: 0.0 };
}

/// How virtual lights are laid and used.
#[derive(Clone, Copy, Debug)]
pub struct VirtualLightsSettings<A: Arithmetic> {
    pub(super) bounces: u8,
    pub(super) log2_tile: u8,
    pub(super) nearest: A::Length,
    pub(super) center: [A::Length; 3],
    pub(super) radius: A::Length,
}

/// Virtual lights, and how they are used. Read-only: they are laid before a picture is rendered, or
/// on the host, and then stay.
///
/// A point asks every light of its part, by a shadow ray where it and the light face each other.
#[derive(Clone, Copy, Debug)]
pub struct VirtualLights<'a, A: Arithmetic> {
    lights: &'a [VirtualLight<A>],
    log2_tile: u8,
    nearest: A::Length,
}

impl<'a, A: Arithmetic> VirtualLights<'a, A> {
    /// The lights with what the settings say of their use.
    pub const fn new(lights: &'a [VirtualLight<A>], settings: &VirtualLightsSettings<A>) -> Self {
        let VirtualLightsSettings { log2_tile, nearest, .. } = *settings;
        Self { lights, log2_tile, nearest }
    }

    /// All of them; those that shine on nothing are dark.
    pub fn lights(&self) -> &'a [VirtualLight<A>] {
        self.lights
    }

    /// r is no less than this.
    pub(crate) fn nearest(&self) -> A::Length {
        self.nearest
    }

    /// Those of a pixel, by its place in a tile of 4×4 (x in the low two bits).
    pub(crate) fn part(&self, place: u8) -> &'a [VirtualLight<A>] {
        let mask = (1u8 << self.log2_tile).wrapping_sub(1);
        let part = usize::from(place & mask | (place >> 2 & mask) << self.log2_tile);
        let length = self.lights.len() >> (2 * self.log2_tile);
        let first = part.wrapping_mul(length);
        self.lights.get(first..first.wrapping_add(length)).unwrap_or(&[])
    }

    /// The irradiance from the sum over a part of the lights.
    pub(crate) fn scaled(&self, sum: A::Radiance) -> A::Radiance {
        A::mean(sum, 16 >> (2 * self.log2_tile))
    }
}

for_each_arithmetic! {
    impl VirtualLight<A> {
        /// A virtual light, for `static`s.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(spec: VirtualLightSpec) -> Self {
            ok_or_panic!(Self::try_new(&spec))
        }

        /// A virtual light.
        ///
        /// # Errors
        /// A position or intensity out of range; for one that shines a normal that isn't a unit
        /// vector; a colour that isn't within 0 and 1.
        pub const fn try_new(spec: &VirtualLightSpec) -> Result<Self, ShapeError> {
            let mut square = 0.0;
            let mut normal_q14 = [0; 3];
            let mut color_q15 = [0; 3];
            let mut dark = true;
            let mut i = 0;
            while i < 3 {
                let (n, c) = (spec.normal[i], spec.color[i]);
                square += n * n;
                // `as` keeps within i16
                normal_q14[i] = (n * 16384.0 + if n < 0.0 { -0.5 } else { 0.5 }) as i16;
                if !(c >= 0.0 && c <= 1.01) {
                    return Err(ShapeError::Coefficient);
                }
                color_q15[i] = (c * 32768.0 + 0.5) as u16;
                dark = dark && color_q15[i] == 0;
                i += 1;
            }
            // A dark one may point nowhere.
            let least = if dark { -1.0 } else { 0.99 };
            if !(square > least && square < 1.01) {
                return Err(ShapeError::Direction);
            }
            Ok(Self {
                position: point!(make, spec.position),
                intensity: some_or!(make::intensity(spec.intensity), Coefficient),
                normal_q14,
                color_q15,
            })
        }

        /// In plain numbers, which make the same light again (but for one so faint that it can't
        /// be seen, of less than 10⁻⁹).
        pub const fn spec(&self) -> VirtualLightSpec {
            let (mut position, mut normal, mut color) = ([0.0; 3], [0.0; 3], [0.0; 3]);
            let mut i = 0;
            while i < 3 {
                position[i] = make::from_length(self.position[i]);
                normal[i] = self.normal_q14[i] as f64 / 16384.0;
                color[i] = self.color_q15[i] as f64 / 32768.0;
                i += 1;
            }
            let intensity = make::from_intensity(&self.intensity);
            VirtualLightSpec { position, normal, intensity, color }
        }
    }

    impl VirtualLightsSettings<A> {
        /// The settings, for `const`s.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(spec: VirtualLightsSpec) -> Self {
            ok_or_panic!(Self::try_new(&spec))
        }

        /// The settings.
        ///
        /// # Errors
        /// A number that is out of its range.
        pub const fn try_new(spec: &VirtualLightsSpec) -> Result<Self, ShapeError> {
            let log2_tile = match spec.tile {
                1 => 0,
                2 => 1,
                4 => 2,
                _ => return Err(ShapeError::Coefficient),
            };
            if spec.bounces == 0 || spec.bounces > 4 {
                return Err(ShapeError::Coefficient);
            }
            if !(spec.nearest > 0.0 && spec.radius >= 0.0) {
                return Err(ShapeError::Size);
            }
            Ok(Self {
                bounces: spec.bounces,
                log2_tile,
                nearest: some_or!(make::length(spec.nearest), Size),
                center: point!(make, spec.center),
                radius: some_or!(make::length(spec.radius), Size),
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;

    #[test]
    fn specs_come_back() {
        let spec = VirtualLightSpec {
            position: [1.5, -2.25, 3.0],
            normal: [0.0, 0.6, 0.8],
            intensity: 1234.5678,
            color: [0.5, 0.25, 1.0],
        };
        macro_rules! comes_back {
            ($a:ty) => {
                for intensity in [0.0, 1e-5, 0.3, 1234.5678, 9e11] {
                    let light = VirtualLight::<$a>::new(VirtualLightSpec { intensity, ..spec });
                    assert_eq!(VirtualLight::<$a>::new(light.spec()).spec(), light.spec());
                    let back = light.spec().intensity;
                    assert!((back - intensity).abs() <= intensity / 32000.0, "{back}");
                }
                let dark = VirtualLight::<$a>::NONE.spec();
                assert!(VirtualLight::<$a>::new(dark).is_dark());
                let bad = |spec| VirtualLight::<$a>::try_new(&spec).is_err();
                assert!(bad(VirtualLightSpec { normal: [1.0; 3], ..spec }));
                assert!(bad(VirtualLightSpec { normal: [0.0; 3], ..spec }));
                assert!(bad(VirtualLightSpec { color: [2.0; 3], ..spec }));
                assert!(bad(VirtualLightSpec { intensity: -1.0, ..spec }));
                assert!(bad(VirtualLightSpec { position: [f64::NAN; 3], ..spec }));
            };
        }
        comes_back!(Fixed);
        comes_back!(f32);
        comes_back!(f64);
    }
}

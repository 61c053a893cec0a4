//! Materials, lights, cameras and surroundings as a blob holds them: the numbers that their
//! constructors take, as `f64`, one after the other. They are few, so they are made anew on the
//! chip, by the same checked constructors as everywhere.

use crate::scene::{Falloff, LightSpec, MaterialSpec, PatternSpec, Shadow};

/// Which lights a point asks, in plain numbers: what [`Selection`](crate::scene::Selection) is made
/// from.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum SelectionSpec {
    /// All.
    #[default]
    All,
    /// Those that would add at least this to some channel.
    Above(f64),
    /// So many, chosen at random.
    Choose(u8),
}

/// What a scene is seen from: what [`Camera::try_look_at`](crate::scene::Camera) takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraSpec {
    /// The pinhole.
    pub eye: [f64; 3],
    /// The point in the middle of the picture.
    pub at: [f64; 3],
    /// Up in the picture.
    pub up: [f64; 3],
    /// The tangent of half the vertical angle from edge to edge.
    pub tangent: f64,
}

/// What a ray that hits nothing sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BackgroundSpec {
    /// The same everywhere.
    Uniform([f64; 3]),
    /// From `bottom` opposite to `up` to `top` along it.
    Gradient {
        /// The vertical.
        up: [f64; 3],
        /// The radiance straight below.
        bottom: [f64; 3],
        /// The radiance straight above.
        top: [f64; 3],
    },
}

/// The rules and surroundings of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SettingSpec {
    /// The camera.
    pub camera: CameraSpec,
    /// E_amb divided by π.
    pub ambient: [f64; 3],
    /// What rays see that hit nothing.
    pub background: BackgroundSpec,
    /// See [`Rules`](crate::scene::Rules).
    pub specular_cosine: bool,
    /// See [`Rules`](crate::scene::Rules).
    pub highlight_cosine: bool,
    /// See [`Rules`](crate::scene::Rules).
    pub transmitters_reflect: bool,
    /// See [`Rules`](crate::scene::Rules).
    pub lossy: bool,
    /// See [`Rules`](crate::scene::Rules).
    pub cutoff: f64,
    /// The depth that the scene asks for.
    pub depth: u8,
    /// Which lights a point asks.
    pub selection: SelectionSpec,
    /// See [`Parts::light_jitter`](crate::scene::Parts::light_jitter).
    pub light_jitter: Option<u16>,
}

/// Bytes that go out.
pub(super) struct Writer<'w>(pub(super) &'w mut dyn FnMut(&[u8]));

/// Bytes that come in: each step gives `None` beyond the end.
pub(super) struct Reader<'r>(pub(super) &'r [u8]);

impl Writer<'_> {
    pub(super) fn byte(&mut self, value: u8) {
        (self.0)(&[value]);
    }

    pub(super) fn number(&mut self, value: f64) {
        (self.0)(&value.to_le_bytes());
    }

    pub(super) fn numbers(&mut self, values: &[f64; 3]) {
        values.iter().for_each(|&x| self.number(x));
    }

    pub(super) fn whole(&mut self, value: u16) {
        (self.0)(&value.to_le_bytes());
    }

    pub(super) fn long(&mut self, value: u32) {
        (self.0)(&value.to_le_bytes());
    }

    /// 0, or 1 and the number.
    pub(super) fn maybe(&mut self, value: Option<u16>) {
        self.byte(value.is_some().into());
        if let Some(value) = value {
            self.whole(value);
        }
    }
}

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (first, rest) = self.0.split_first_chunk::<N>()?;
        self.0 = rest;
        Some(*first)
    }

    pub(super) fn byte(&mut self) -> Option<u8> {
        self.take::<1>().map(|[byte]| byte)
    }

    /// 0 or 1.
    pub(super) fn switch(&mut self) -> Option<bool> {
        match self.byte()? {
            0 => Some(false),
            1 => Some(true),
            _ => None,
        }
    }

    pub(super) fn number(&mut self) -> Option<f64> {
        self.take().map(f64::from_le_bytes)
    }

    pub(super) fn numbers(&mut self) -> Option<[f64; 3]> {
        Some([self.number()?, self.number()?, self.number()?])
    }

    pub(super) fn whole(&mut self) -> Option<u16> {
        self.take().map(u16::from_le_bytes)
    }

    pub(super) fn long(&mut self) -> Option<u32> {
        self.take().map(u32::from_le_bytes)
    }

    pub(super) fn maybe(&mut self) -> Option<Option<u16>> {
        Some(if self.switch()? { Some(self.whole()?) } else { None })
    }

    /// What is left: less than a word, all zero.
    pub(super) fn is_over(&self) -> bool {
        self.0.len() < super::ALIGNMENT && self.0.iter().all(|&byte| byte == 0)
    }
}

/// A part of a blob's end.
pub(super) trait Spec: Sized {
    fn write(&self, to: &mut Writer<'_>);
    /// `None` for a kind that isn't known, or beyond the end.
    fn read(from: &mut Reader<'_>) -> Option<Self>;
}

impl Spec for SettingSpec {
    fn write(&self, to: &mut Writer<'_>) {
        let Self { camera, ambient, background, cutoff, depth, .. } = self;
        let CameraSpec { eye, at, up, tangent } = camera;
        [eye, at, up, ambient].into_iter().for_each(|v| to.numbers(v));
        to.number(*tangent);
        to.number(*cutoff);
        to.byte(*depth);
        let switches =
            [self.specular_cosine, self.highlight_cosine, self.transmitters_reflect, self.lossy];
        switches.into_iter().for_each(|switch| to.byte(switch.into()));
        match background {
            BackgroundSpec::Uniform(color) => {
                to.byte(0);
                to.numbers(color);
            }
            BackgroundSpec::Gradient { up, bottom, top } => {
                to.byte(1);
                [up, bottom, top].into_iter().for_each(|v| to.numbers(v));
            }
        }
        match self.selection {
            SelectionSpec::All => to.byte(0),
            SelectionSpec::Above(radiance) => {
                to.byte(1);
                to.number(radiance);
            }
            SelectionSpec::Choose(count) => {
                to.byte(2);
                to.byte(count);
            }
        }
        to.maybe(self.light_jitter);
    }

    fn read(from: &mut Reader<'_>) -> Option<Self> {
        let (eye, at, up) = (from.numbers()?, from.numbers()?, from.numbers()?);
        let ambient = from.numbers()?;
        let camera = CameraSpec { eye, at, up, tangent: from.number()? };
        let cutoff = from.number()?;
        let depth = from.byte()?;
        let [specular_cosine, highlight_cosine, transmitters_reflect, lossy] =
            [from.switch()?, from.switch()?, from.switch()?, from.switch()?];
        let background = match from.byte()? {
            0 => BackgroundSpec::Uniform(from.numbers()?),
            1 => BackgroundSpec::Gradient {
                up: from.numbers()?,
                bottom: from.numbers()?,
                top: from.numbers()?,
            },
            _ => return None,
        };
        let selection = match from.byte()? {
            0 => SelectionSpec::All,
            1 => SelectionSpec::Above(from.number()?),
            2 => SelectionSpec::Choose(from.byte()?),
            _ => return None,
        };
        Some(Self {
            selection,
            light_jitter: from.maybe()?,
            camera,
            ambient,
            background,
            specular_cosine,
            highlight_cosine,
            transmitters_reflect,
            lossy,
            cutoff,
            depth,
        })
    }
}

impl Spec for MaterialSpec {
    fn write(&self, to: &mut Writer<'_>) {
        let Self {
            ambient,
            diffuse,
            specular,
            shininess,
            reflection,
            transmission,
            index_front,
            index_behind,
            emission,
            shadow,
            pattern,
            fresnel,
            texture,
            bump,
            absorption,
        } = self;
        let colors = [ambient, diffuse, specular, reflection, transmission, emission];
        colors.into_iter().for_each(|v| to.numbers(v));
        [shininess, index_front, index_behind].into_iter().for_each(|&x| to.number(x));
        to.byte(match shadow {
            Shadow::Opaque => 0,
            Shadow::Filtered => 1,
            Shadow::None => 2,
        });
        to.byte((*fresnel).into());
        match pattern {
            None => to.byte(0),
            Some(PatternSpec { cell, offset, other }) => {
                to.byte(1);
                to.numbers(cell);
                to.numbers(offset);
                to.whole(*other);
            }
        }
        [texture, bump, absorption].into_iter().for_each(|&index| to.maybe(index));
    }

    fn read(from: &mut Reader<'_>) -> Option<Self> {
        Some(Self {
            ambient: from.numbers()?,
            diffuse: from.numbers()?,
            specular: from.numbers()?,
            reflection: from.numbers()?,
            transmission: from.numbers()?,
            emission: from.numbers()?,
            shininess: from.number()?,
            index_front: from.number()?,
            index_behind: from.number()?,
            shadow: match from.byte()? {
                0 => Shadow::Opaque,
                1 => Shadow::Filtered,
                2 => Shadow::None,
                _ => return None,
            },
            fresnel: from.switch()?,
            pattern: match from.byte()? {
                0 => None,
                1 => Some(PatternSpec {
                    cell: from.numbers()?,
                    offset: from.numbers()?,
                    other: from.whole()?,
                }),
                _ => return None,
            },
            texture: from.maybe()?,
            bump: from.maybe()?,
            absorption: from.maybe()?,
        })
    }
}

impl Spec for Falloff {
    fn write(&self, to: &mut Writer<'_>) {
        to.byte(match self {
            Self::InverseSquare => 0,
            Self::None => 1,
        });
    }

    fn read(from: &mut Reader<'_>) -> Option<Self> {
        match from.byte()? {
            0 => Some(Self::InverseSquare),
            1 => Some(Self::None),
            _ => None,
        }
    }
}

impl Spec for LightSpec {
    fn write(&self, to: &mut Writer<'_>) {
        match self {
            Self::Point { position, intensity, falloff } => {
                to.byte(0);
                to.numbers(position);
                to.numbers(intensity);
                falloff.write(to);
            }
            Self::Directional { direction, intensity } => {
                to.byte(1);
                to.numbers(direction);
                to.numbers(intensity);
            }
            Self::Spot { position, direction, intensity, falloff, cos_inner, cos_outer } => {
                to.byte(2);
                [position, direction, intensity].into_iter().for_each(|v| to.numbers(v));
                falloff.write(to);
                to.number(*cos_inner);
                to.number(*cos_outer);
            }
        }
    }

    fn read(from: &mut Reader<'_>) -> Option<Self> {
        Some(match from.byte()? {
            0 => Self::Point {
                position: from.numbers()?,
                intensity: from.numbers()?,
                falloff: Falloff::read(from)?,
            },
            1 => Self::Directional { direction: from.numbers()?, intensity: from.numbers()? },
            2 => Self::Spot {
                position: from.numbers()?,
                direction: from.numbers()?,
                intensity: from.numbers()?,
                falloff: Falloff::read(from)?,
                cos_inner: from.number()?,
                cos_outer: from.number()?,
            },
            _ => return None,
        })
    }
}

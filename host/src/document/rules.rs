//! What the classic programs differ in; a scene says which it means.

use whitted::frame::Sampling;

use super::Falloff;
use whitted::trace::Terms;

/// The switches of the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rules {
    /// Mirrored and transmitted radiance is multiplied by the cosine between normal and ray.
    pub specular_cosine: bool,
    /// Phong's highlight is multiplied by the cosine between normal and light.
    pub highlight_cosine: bool,
    /// What lights do that don't say.
    pub falloff: Falloff,
    /// A transmitting surface sends a reflection ray even where it reflects nothing (SPD).
    pub transmitters_reflect: bool,
    /// At total reflection the mirror ray carries k_sg alone, without k_tg.
    pub lossy_total_reflection: bool,
    /// A ray is sent only if it can add more than this to a channel.
    pub cutoff: f64,
    /// The largest depth; the ray from the eye has depth 1.
    pub depth: u8,
    /// The seed by which shadow rays to area lights are moved at random, if they are.
    pub light_jitter: Option<u16>,
    /// Which lights a point asks.
    pub lights: LightSelection,
    /// Which terms of radiance a picture shows.
    pub terms: Terms,
    /// Where in a pixel rays go, unless the command says.
    pub sampling: Sampling,
}

/// Which lights a point asks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightSelection {
    /// All.
    All,
    /// Those that would add this much to a channel of the pixel, were nothing in their way.
    Threshold(f64),
    /// So many, chosen at random by what they would add.
    Choose(u8),
}

impl Rules {
    /// The deepest a scene may ask for.
    pub const DEEPEST: u8 = 64;

    /// The form of the slides, the default of our own format.
    pub const SLIDES: Self = Self {
        specular_cosine: true,
        highlight_cosine: true,
        falloff: Falloff::InverseSquare,
        transmitters_reflect: false,
        lossy_total_reflection: false,
        cutoff: 1.0 / 255.0,
        depth: 5,
        light_jitter: Some(0),
        lights: LightSelection::All,
        terms: Terms::ALL,
        sampling: Sampling::Center,
    };

    /// What a file in Neutral File Format means.
    pub const NFF: Self = Self {
        specular_cosine: false,
        highlight_cosine: false,
        falloff: Falloff::None,
        transmitters_reflect: true,
        lossy_total_reflection: false,
        cutoff: 0.0,
        depth: 5,
        light_jitter: Some(0),
        lights: LightSelection::All,
        terms: Terms::ALL,
        sampling: Sampling::Center,
    };
}

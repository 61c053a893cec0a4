//! What the blob of these tests is made from.

use whitted::blob::{AbsorptionSpec, BackgroundSpec, CameraSpec, SelectionSpec, SettingSpec};
use whitted::gather::RecordSpec;
use whitted::scene::{
    Area, AreaLightSpec, Falloff, Filter, Image, LightSpec, Mapping, MaterialSpec, Pattern,
    PatternSpec, Shadow, Texels, TextureSpec, Wrap,
};

pub(super) const CORNERS: [[f64; 3]; 4] =
    [[-2.0, 0.0, 3.0], [-1.0, 0.0, 3.0], [-1.0, 1.0, 3.0], [-2.0, 1.0, 3.0]];
pub(super) const TRIANGLE: [[f64; 3]; 3] = [[1.0, 0.0, 3.0], [2.0, 0.0, 3.0], [1.5, 1.0, 3.5]];

pub(super) const MATERIALS: [MaterialSpec; 3] = [
    MaterialSpec {
        diffuse: [0.7, 0.3, 0.2],
        specular: [0.4; 3],
        shininess: 20.0,
        reflection: [0.3; 3],
        texture: Some(0),
        bump: Some(2),
        ..MaterialSpec::BLACK
    },
    MaterialSpec {
        transmission: [0.8, 0.9, 0.8],
        absorption: Some(0),
        index_behind: 1.5,
        shadow: Shadow::Filtered,
        ..MaterialSpec::BLACK
    },
    MaterialSpec {
        diffuse: [0.6; 3],
        ambient: [0.5; 3],
        texture: Some(1),
        pattern: Some(PatternSpec { cell: [0.5, 0.0, 0.5], offset: [0.1, 0.0, 0.0], other: 0 }),
        ..MaterialSpec::BLACK
    },
];

pub(super) const LIGHTS: [LightSpec; 3] = [
    LightSpec::Point {
        position: [-3.0, 4.0, 0.0],
        intensity: [9.0, 8.0, 7.0],
        falloff: Falloff::InverseSquare,
    },
    LightSpec::Directional { direction: [1.0, -2.0, 1.0], intensity: [0.4; 3] },
    LightSpec::Spot {
        position: [0.0, 5.0, 3.0],
        direction: [0.0, -1.0, 0.0],
        intensity: [1.0; 3],
        falloff: Falloff::None,
        cos_inner: 0.95,
        cos_outer: 0.9,
    },
];

pub(super) const ABSORPTIONS: [AbsorptionSpec; 1] = [[[0.0; 3], [0.5, 0.1, 0.3]]];

pub(super) const PICTURE: Image<'static> = Image::new(
    3,
    2,
    Texels::Indexed { bits: 2, palette: &[[200, 30, 30], [240, 240, 220], [20, 40, 90]] },
    &[0b0001_1000, 0b0110_0000],
);

pub(super) const TEXTURES: [TextureSpec<'static>; 3] = [
    TextureSpec { mapping: Mapping::Uv, ..TextureSpec::of(Pattern::Image(PICTURE)) },
    TextureSpec {
        size: [0.5, 0.5, 0.0],
        ..TextureSpec::of(Pattern::Image(
            PICTURE.with_filter(Filter::Bilinear).with_wrap(Wrap::Clamp),
        ))
    },
    TextureSpec {
        size: [0.3; 3],
        height: 0.05,
        ..TextureSpec::of(Pattern::Marble { octaves: 2, turbulence: 0.5 })
    },
];

pub(super) const LAMP: [[f64; 3]; 4] =
    [[-1.0, 4.0, 2.0], [0.0, 4.0, 2.0], [0.3, 4.0, 3.0], [-1.0, 4.0, 3.0]];

pub(super) const AREA_LIGHTS: [AreaLightSpec<'static>; 2] = [
    AreaLightSpec {
        area: Area::Polygon { corners: &LAMP, first: 0 },
        radiance: [2.0, 2.0, 1.5],
        error: 0.5,
        samples: [1, 2],
        body: None,
    },
    AreaLightSpec {
        area: Area::Sphere { center: [2.0, 3.0, 1.0], radius: 0.2 },
        radiance: [5.0, 6.0, 7.0],
        error: 0.5,
        samples: [1, 2],
        body: Some(1),
    },
];

pub(super) const RECORDS: [RecordSpec; 2] = [
    RecordSpec {
        position: [0.0, 0.0, 3.0],
        normal: [0.0, 1.0, 0.0],
        reach: 2.0,
        irradiance: [0.2, 0.3, 0.4],
        translation: [0.5, 0.0, -0.25],
        rotation: [0.1, 0.0, 0.2],
    },
    RecordSpec {
        position: [0.0, 0.5, 2.5],
        normal: [0.0, 0.0, -1.0],
        reach: 1.5,
        irradiance: [0.1, 0.05, 0.0],
        translation: [0.0; 3],
        rotation: [0.0; 3],
    },
];

pub(super) const UV: [[f64; 2]; 3] = [[0.0, 0.0], [2.0, 0.0], [1.0, 1.5]];
pub(super) const ERROR: f64 = 0.4;

pub(super) const SETTING: SettingSpec = SettingSpec {
    camera: CameraSpec {
        eye: [0.2, 1.5, -4.0],
        at: [0.0, 0.6, 3.0],
        up: [0.0, 1.0, 0.0],
        tangent: 0.5,
    },
    ambient: [0.1, 0.1, 0.2],
    background: BackgroundSpec::Gradient {
        up: [0.0, 1.0, 0.0],
        bottom: [0.5; 3],
        top: [0.1, 0.2, 0.6],
    },
    specular_cosine: false,
    highlight_cosine: true,
    transmitters_reflect: true,
    lossy: false,
    cutoff: 1.0 / 255.0,
    depth: 4,
    selection: SelectionSpec::Above(0.001),
    light_jitter: Some(7),
};

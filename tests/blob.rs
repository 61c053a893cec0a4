//! Blobs: what was baked is what is read, and hostile bytes are refused or harmless.

use whitted::blob::{
    ALIGNMENT, AbsorptionSpec, BackgroundSpec, Blob, BlobError, CameraSpec, Content, Room,
    SelectionSpec, SettingSpec, seal,
};
use whitted::frame::{Output, Renderer, Rgb888, Settings};
use whitted::gather::{Indirect, IrradianceCache, Record, RecordSpec};
use whitted::math::Fixed;
use whitted::octree::{Built, Cube, Extent, Limits, build_into};
use whitted::scene::{
    Absorption, Area, AreaLight, AreaLightSpec, Camera, Falloff, FanCorner, Filter, Image, Light,
    LightSpec, Mapping, Material, MaterialSpec, Parts, Pattern, PatternSpec, Scene, Selection,
    Shadow, Shapes, Texels, Texture, TextureSpec, TriangleUv, Wrap,
};
use whitted::shape::{
    Cone, Cuboid, Cylinder, Disc, Plane, Polygon, PolygonEdge, SmoothTriangle, Sphere, Triangle,
};
use whitted::trace::Work;

const CORNERS: [[f64; 3]; 4] =
    [[-2.0, 0.0, 3.0], [-1.0, 0.0, 3.0], [-1.0, 1.0, 3.0], [-2.0, 1.0, 3.0]];
const TRIANGLE: [[f64; 3]; 3] = [[1.0, 0.0, 3.0], [2.0, 0.0, 3.0], [1.5, 1.0, 3.5]];

const MATERIALS: [MaterialSpec; 3] = [
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

const LIGHTS: [LightSpec; 3] = [
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

const ABSORPTIONS: [AbsorptionSpec; 1] = [[[0.0; 3], [0.5, 0.1, 0.3]]];

const PICTURE: Image<'static> = Image::new(
    3,
    2,
    Texels::Indexed { bits: 2, palette: &[[200, 30, 30], [240, 240, 220], [20, 40, 90]] },
    &[0b0001_1000, 0b0110_0000],
);

const TEXTURES: [TextureSpec<'static>; 3] = [
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

const LAMP: [[f64; 3]; 4] = [[-1.0, 4.0, 2.0], [0.0, 4.0, 2.0], [0.3, 4.0, 3.0], [-1.0, 4.0, 3.0]];

const AREA_LIGHTS: [AreaLightSpec<'static>; 2] = [
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

const RECORDS: [RecordSpec; 2] = [
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

const UV: [[f64; 2]; 3] = [[0.0, 0.0], [2.0, 0.0], [1.0, 1.5]];
const ERROR: f64 = 0.4;

const SETTING: SettingSpec = SettingSpec {
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

/// Bytes that start where a blob's must.
struct Aligned(Vec<u64>, usize);

impl Aligned {
    fn of(bytes: &[u8]) -> Self {
        let mut words = vec![0u64; bytes.len().div_ceil(8)];
        for (word, chunk) in words.iter_mut().zip(bytes.chunks(8)) {
            let mut eight = [0; 8];
            eight[..chunk.len()].copy_from_slice(chunk);
            *word = u64::from_ne_bytes(eight);
        }
        Self(words, bytes.len())
    }

    fn bytes(&self) -> &[u8] {
        &bytemuck::cast_slice(&self.0)[..self.1]
    }

    fn set(&mut self, at: usize, value: u8) {
        bytemuck::cast_slice_mut::<u64, u8>(&mut self.0)[at] = value;
    }

    fn seal(&mut self) {
        seal(&mut bytemuck::cast_slice_mut::<u64, u8>(&mut self.0)[..self.1]);
    }
}

macro_rules! arithmetic {
    ($module:ident, $a:ty, |$value:ident, $right:ident| $tried:expr) => {
        mod $module {
            use super::*;

            type A = $a;

            struct Kinds {
                spheres: Vec<Sphere<A>>,
                triangles: Vec<Triangle<A>>,
                smooth: Vec<SmoothTriangle<A>>,
                polygons: Vec<Polygon<A>>,
                edges: Vec<PolygonEdge<A>>,
                cuboids: Vec<Cuboid<A>>,
                discs: Vec<Disc<A>>,
                cylinders: Vec<Cylinder<A>>,
                cones: Vec<Cone<A>>,
                planes: Vec<Plane<A>>,
                uvs: Vec<TriangleUv>,
                records: Vec<Record<A>>,
                words: Vec<u32>,
                cube: Cube,
            }

            const STEP: i8 = -16;

            fn kinds() -> Kinds {
                let normals = [[-0.2, 0.0, -1.0], [0.2, 0.0, -1.0], [0.0, 0.3, -1.0]];
                let up = [0.0, 1.0, 0.0];
                let mut kinds = Kinds {
                    spheres: vec![
                        Sphere::<A>::new([0.0, 0.6, 3.0], 0.6, 1),
                        Sphere::<A>::new([0.8, 0.3, 2.0], -0.3, 0),
                    ],
                    triangles: vec![Triangle::<A>::new(TRIANGLE, 0)],
                    smooth: vec![SmoothTriangle::<A>::new(
                        TRIANGLE.map(|c| [c[0], c[1] + 1.0, c[2]]),
                        normals,
                        0,
                    )],
                    polygons: vec![Polygon::<A>::new(&CORNERS, 0, 0)],
                    edges: Polygon::<A>::edges(&CORNERS).to_vec(),
                    cuboids: vec![Cuboid::<A>::new([-1.0, 0.0, 4.0], [-0.5, 0.5, 4.5], 0)],
                    discs: vec![Disc::<A>::new([0.0, 0.01, 3.0], up, 1.0, 2)],
                    cylinders: vec![Cylinder::<A>::new([1.0, 0.0, 5.0], [1.0, 1.0, 5.0], 0.2, 0)],
                    cones: vec![Cone::<A>::new([-1.5, 1.0, 4.0], 0.3, [-1.5, 2.0, 4.0], 0.0, 0)],
                    planes: vec![Plane::<A>::new(up, -0.01, 2)],
                    uvs: vec![TriangleUv::new(UV); 2],
                    records: RECORDS.map(|spec| Record::<A>::new(spec)).to_vec(),
                    words: vec![0; 4096],
                    cube: Cube { origin: [0; 3], log2_side: 0 },
                };
                let extents: [Extent; 9] = Parts::<A> {
                    spheres: &kinds.spheres,
                    triangles: &kinds.triangles,
                    smooth_triangles: &kinds.smooth,
                    polygons: &kinds.polygons,
                    cuboids: &kinds.cuboids,
                    discs: &kinds.discs,
                    cylinders: &kinds.cylinders,
                    cones: &kinds.cones,
                    ..Parts::EMPTY
                }
                .extents(STEP);
                let mut scratch = vec![0; 4096];
                let limits = Limits { levels: 3, ..Limits::DEFAULT };
                let Built { words, cube, .. } =
                    build_into(&extents, &mut kinds.words, &mut scratch, limits).unwrap();
                kinds.words.truncate(words);
                kinds.cube = cube;
                kinds
            }

            fn content(kinds: &Kinds) -> Content<'_, A> {
                Content {
                    shapes: Shapes {
                        spheres: &kinds.spheres,
                        triangles: &kinds.triangles,
                        smooth_triangles: &kinds.smooth,
                        polygons: &kinds.polygons,
                        edges: &kinds.edges,
                        cuboids: &kinds.cuboids,
                        discs: &kinds.discs,
                        cylinders: &kinds.cylinders,
                        cones: &kinds.cones,
                        uvs: &kinds.uvs,
                        ..Shapes::EMPTY
                    },
                    planes: &kinds.planes,
                    tree: Some((&kinds.words, kinds.cube, STEP)),
                    materials: &MATERIALS,
                    lights: &LIGHTS,
                    absorptions: &ABSORPTIONS,
                    textures: &TEXTURES,
                    area_lights: &AREA_LIGHTS,
                    cache: Some((&kinds.records, ERROR)),
                    setting: SETTING,
                    uses: 0,
                }
            }

            fn written(content: &Content<'_, A>) -> Aligned {
                let mut bytes = Vec::new();
                content.write(&mut |part| bytes.extend_from_slice(part));
                seal(&mut bytes);
                Aligned::of(&bytes)
            }

            fn render(scene: &Scene<'_, A>, camera: &Camera<A>, side: u16) -> Vec<Rgb888> {
                let settings = Settings { depth: SETTING.depth, ..Settings::new(side, side) };
                let mut work = Work::<A, 8>::new();
                let mut samples = [];
                let mut renderer =
                    Renderer::new(scene, camera, settings, &mut work, &mut samples).unwrap();
                let mut picture = Vec::new();
                for y in 0..side {
                    let mut line = vec![Rgb888::default(); side.into()];
                    renderer.line(y, &Output::SRGB, &mut line);
                    picture.extend(line);
                }
                picture
            }

            /// Opens a blob and renders what is in it.
            fn shown(bytes: &[u8], side: u16) -> Result<Vec<Rgb888>, BlobError> {
                let blob = Blob::<A>::open(bytes)?;
                let mut materials = [Material::<A>::new(MaterialSpec::BLACK); 4];
                let mut lights = [Light::<A>::point([0.0; 3], [0.0; 3]); 4];
                let camera = blob.camera()?;
                let light = AreaLight::<A>::new(AREA_LIGHTS[1]);
                let texture = Texture::<A>::new(TextureSpec::of(Pattern::Checker));
                let room = Room {
                    materials: &mut materials,
                    lights: &mut lights,
                    area_lights: &mut [light; 2],
                    fans: &mut [FanCorner::NONE; 3],
                    textures: &mut [texture; 3],
                    absorptions: &mut [Absorption::<A>::new([0.0; 3], [0.0; 3])],
                };
                Ok(render(&blob.scene_in(room)?, &camera, side))
            }

            #[test]
            fn what_was_written_is_what_is_read() {
                let kinds = kinds();
                let content = content(&kinds);
                let blob = written(&content);
                assert!(blob.bytes().len() % ALIGNMENT == 0);
                let materials = MATERIALS.map(|spec| Material::<A>::new(spec));
                let lights = LIGHTS.map(|spec| Light::<A>::new(spec));
                use whitted::octree::Octree;
                use whitted::scene::{Ambient, Background, Rules};
                let tree = Octree::<A>::try_new(&kinds.words, 9, &kinds.cube, STEP).unwrap();
                let textures = TEXTURES.map(|spec| Texture::<A>::new(spec));
                let absorptions = ABSORPTIONS.map(|[a, b]| Absorption::<A>::new(a, b));
                let fan = AreaLight::<A>::fan::<3>(&LAMP);
                let area_lights = AREA_LIGHTS.map(|spec| AreaLight::<A>::new(spec));
                let scene = Scene::<A>::new(Parts {
                    uvs: &kinds.uvs,
                    textures: &textures,
                    absorptions: &absorptions,
                    area_lights: &area_lights,
                    light_corners: &fan,
                    light_jitter: SETTING.light_jitter,
                    selection: Selection::<A>::above(0.001),
                    indirect: Indirect::Cache(IrradianceCache::<A>::new(&kinds.records, ERROR)),
                    spheres: &kinds.spheres,
                    triangles: &kinds.triangles,
                    smooth_triangles: &kinds.smooth,
                    polygons: &kinds.polygons,
                    edges: &kinds.edges,
                    cuboids: &kinds.cuboids,
                    discs: &kinds.discs,
                    cylinders: &kinds.cylinders,
                    cones: &kinds.cones,
                    planes: &kinds.planes,
                    tree: Some(tree),
                    materials: &materials,
                    lights: &lights,
                    ambient: Ambient::<A>::new(SETTING.ambient),
                    background: Background::<A>::gradient(
                        [0.0, 1.0, 0.0],
                        [0.5; 3],
                        [0.1, 0.2, 0.6],
                    ),
                    rules: Rules {
                        specular_cosine: false,
                        transmitters_reflect: true,
                        ..Rules::COURSE
                    },
                    ..Parts::EMPTY
                })
                .unwrap();
                let CameraSpec { eye, at, up, tangent } = SETTING.camera;
                let camera = Camera::<A>::try_look_at(eye, at, up, tangent).unwrap();
                assert_eq!(shown(blob.bytes(), 48), Ok(render(&scene, &camera, 48)));
            }

            #[test]
            fn every_change_of_a_byte_and_every_truncation_is_noticed() {
                let kinds = kinds();
                let mut blob = written(&content(&kinds));
                let length = blob.bytes().len();
                for end in 0..length {
                    assert!(matches!(
                        Blob::<A>::open(&blob.bytes()[..end]).map(drop),
                        Err(BlobError::Length { .. })
                    ));
                }
                for at in 0..length {
                    let right = blob.bytes()[at];
                    // The sum finds any change of a byte: one of each bit shows that it is asked.
                    for bit in 0..8 {
                        blob.set(at, right ^ 1 << bit);
                        assert!(Blob::<A>::open(blob.bytes()).is_err(), "{at}");
                    }
                    blob.set(at, right);
                }
            }

            /// The same with the checksum made right again: what an enemy would do.
            #[test]
            fn every_change_of_a_byte_is_refused_or_harmless() {
                let kinds = kinds();
                let mut blob = written(&content(&kinds));
                let (mut refused, mut shows) = (0, 0);
                for at in 0..blob.bytes().len() {
                    let right = blob.bytes()[at];
                    for value in (0..=255).filter(|v| *v != right) {
                        let ($value, $right) = (value, right);
                        if !$tried {
                            continue;
                        }
                        blob.set(at, value);
                        blob.seal();
                        match shown(blob.bytes(), 2) {
                            Ok(_) => shows += 1,
                            Err(_) => refused += 1,
                        }
                    }
                    blob.set(at, right);
                }
                assert!(refused > 1_000 && shows > 0, "{refused} {shows}");
            }

            #[test]
            fn what_is_wrong_is_said() {
                let kinds = kinds();
                let content = content(&kinds);
                let says = |change: &dyn Fn(&mut Aligned)| {
                    let mut blob = written(&content);
                    change(&mut blob);
                    blob.seal();
                    shown(blob.bytes(), 1).unwrap_err()
                };
                assert_eq!(says(&|b| b.set(0, 0)), BlobError::Magic);
                assert_eq!(says(&|b| b.set(8, 9)), BlobError::Version { found: 9 });
                assert_eq!(says(&|b| b.set(10, 3)), BlobError::Arithmetic { found: 3 });
                assert_eq!(says(&|b| b.set(20, 3)), BlobError::Layout);
                assert_eq!(says(&|b| b.set(51, 0x7f)), BlobError::Parts);
                let few = Content { materials: &MATERIALS[..2], ..content };
                assert!(matches!(shown(written(&few).bytes(), 1), Err(BlobError::Scene(_))));
                let many = Content { lights: &[LIGHTS[0]; 5], ..content };
                let room = BlobError::Room { materials: 3, lights: 5 };
                assert_eq!(shown(written(&many).bytes(), 1), Err(room));
                let none = Blob::<A>::open(written(&content).bytes()).map(|blob| {
                    let mut materials = [Material::<A>::new(MaterialSpec::BLACK); 4];
                    let mut lights = [Light::<A>::point([0.0; 3], [0.0; 3]); 4];
                    let scene: Result<Scene<'_, A>, _> = blob.scene(&mut materials, &mut lights);
                    scene.map(drop)
                });
                let wanted =
                    BlobError::RoomBesides { area_lights: 2, fans: 3, textures: 3, absorptions: 1 };
                assert_eq!(none, Ok(Err(wanted)));
                let few = Content { textures: &TEXTURES[..2], ..content };
                assert!(matches!(shown(written(&few).bytes(), 1), Err(BlobError::Scene(_))));
                let steep = TextureSpec { height: f64::NAN, ..TEXTURES[2] };
                let bad = Content { textures: &[TEXTURES[0], TEXTURES[1], steep], ..content };
                assert!(matches!(shown(written(&bad).bytes(), 1), Err(BlobError::Value(_))));
                let bad = Content { absorptions: &[[[-1.0; 3]; 2]], ..content };
                assert!(matches!(shown(written(&bad).bytes(), 1), Err(BlobError::Value(_))));
                let bad = Content { cache: Some((&kinds.records, 7.0)), ..content };
                assert!(matches!(shown(written(&bad).bytes(), 1), Err(BlobError::Value(_))));
                let bad = Content { cache: Some((&[Record::NONE], ERROR)), ..content };
                assert!(matches!(shown(written(&bad).bytes(), 1), Err(BlobError::Shape { .. })));
                let dark = MaterialSpec { reflection: [2.0; 3], ..MATERIALS[0] };
                let bad = Content { materials: &[dark; 3], ..content };
                assert!(matches!(shown(written(&bad).bytes(), 1), Err(BlobError::Value(_))));
                let mut shifted = written(&content).bytes().to_vec();
                shifted.insert(0, 0);
                let shifted = Aligned::of(&shifted);
                let error = shown(&shifted.bytes()[1..], 1);
                assert_eq!(error, Err(BlobError::Alignment));
            }
        }
    };
}

arithmetic!(fixed, Fixed, |_value, _right| true);
// Here a bit at a time: the layout is the same.
arithmetic!(single, f32, |value, right| u8::count_ones(value ^ right) == 1);

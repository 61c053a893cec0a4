//! Blobs: what was baked is what is read, and hostile bytes are refused or harmless.

use whitted::blob::{
    ALIGNMENT, BackgroundSpec, Blob, BlobError, CameraSpec, Content, SettingSpec, seal,
};
use whitted::frame::{Output, Renderer, Rgb888, Settings};
use whitted::math::Fixed;
use whitted::octree::{Built, Cube, Extent, Limits, build_into};
use whitted::scene::{
    Camera, Falloff, Light, LightSpec, Material, MaterialSpec, Parts, PatternSpec, Scene, Shadow,
    Shapes,
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
        ..MaterialSpec::BLACK
    },
    MaterialSpec {
        transmission: [0.8, 0.9, 0.8],
        index_behind: 1.5,
        shadow: Shadow::Filtered,
        ..MaterialSpec::BLACK
    },
    MaterialSpec {
        diffuse: [0.6; 3],
        ambient: [0.5; 3],
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
                        ..Shapes::EMPTY
                    },
                    planes: &kinds.planes,
                    tree: Some((&kinds.words, kinds.cube, STEP)),
                    materials: &MATERIALS,
                    lights: &LIGHTS,
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
                Ok(render(&blob.scene(&mut materials, &mut lights)?, &camera, side))
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
                let scene = Scene::<A>::new(Parts {
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

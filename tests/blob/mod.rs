//! Blobs: what was baked is what is read, and hostile bytes are refused or harmless.

mod aligned;
mod specs;

use aligned::Aligned;
use specs::*;
use whitted::blob::{
    ALIGNMENT, Blob, BlobError, CameraSpec, Content, GroupContent, InstanceSpec, Room,
    SelectionSpec, SettingSpec, seal,
};
use whitted::frame::{Output, Renderer, Rgb888, Settings};
use whitted::gather::{
    Indirect, IrradianceCache, Record, VirtualLight, VirtualLightSpec, VirtualLights,
    VirtualLightsSettings, VirtualLightsSpec,
};
use whitted::math::Fixed;
use whitted::octree::{Built, Cube, Extent, Limits, Octree, build_into};
use whitted::scene::{
    Absorption, Ambient, AreaLight, Background, Camera, FanCorner, Group, Instance, Light,
    Material, MaterialSpec, Parts, Pattern, Rules, Scene, Selection, Shapes, Texture, TextureSpec,
    Transform, TriangleUv,
};
use whitted::shape::{
    Cone, Cuboid, Cylinder, Disc, Operand, Plane, Polygon, PolygonEdge, Region, SmoothTriangle,
    Solid, Sphere, Triangle,
};
use whitted::trace::Work;

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
                    groups: &[],
                    instances: &[],
                    virtual_lights: None,
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
                    solids: &mut [Solid::NONE; 2],
                    operands: &mut [Operand::NONE; 7],
                    groups: &mut [Group::<A>::NONE; 2],
                    instances: &mut [Instance::<A>::NONE; 3],
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

            /// Groups, instances, solids and virtual lights: what the other blob has none of.
            struct Grouped {
                spheres: Vec<Sphere<A>>,
                cones: Vec<Cone<A>>,
                polygons: Vec<Polygon<A>>,
                edges: Vec<PolygonEdge<A>>,
                planes: Vec<Plane<A>>,
                /// The first is a group's, the second the scene's.
                solids: [[Solid<A>; 1]; 2],
                operands: [Vec<Operand<A>>; 2],
                words: Vec<u32>,
                cube: Cube,
                lights: Vec<VirtualLight<A>>,
            }

            fn grouped() -> Grouped {
                let ball = |x, y, r, m| Sphere::<A>::new([x, y, 0.0], r, m);
                let operands = [
                    vec![
                        Operand::Cuboid(Cuboid::<A>::new([-0.4; 3], [0.4; 3], 0)),
                        Operand::Sphere(ball(0.0, 0.0, 0.5, 2)),
                        Operand::Cylinder(Cylinder::<A>::new(
                            [0.0, -1.0, 0.0],
                            [0.0, 1.0, 0.0],
                            0.2,
                            2,
                        )),
                    ],
                    vec![
                        Operand::Cone(Cone::<A>::new(
                            [1.6, 0.0, 3.0],
                            0.6,
                            [1.6, 1.5, 3.0],
                            0.2,
                            0,
                        )),
                        Operand::HalfSpace(Plane::<A>::new([1.0, 1.0, 0.0], 2.0, 2)),
                        Operand::Sphere(Sphere::<A>::new([1.6, 1.5, 3.0], 0.4, 0)),
                    ],
                ];
                let [a, b, c] = [0, 1, 2].map(Region::of);
                let solids = [
                    [Solid::<A>::new(a.and(b).minus(c), &operands[0], 0, 3)],
                    [Solid::<A>::new(a.and(b).or(c), &operands[1], 0, 3)],
                ];
                let lower = CORNERS.map(|[x, y, z]| [x + 1.5, y - 1.0, z - 3.0]);
                let mut made = Grouped {
                    spheres: vec![ball(0.9, 0.2, 0.2, 0), ball(-1.4, 0.5, 0.3, 1)],
                    cones: vec![Cone::<A>::new([0.5, 0.5, 0.0], 0.2, [0.5, 1.0, 0.0], 0.0, 0)],
                    polygons: vec![Polygon::<A>::new(&lower, 0, 0)],
                    edges: Polygon::<A>::edges(&lower).to_vec(),
                    planes: vec![Plane::<A>::new([0.0, 1.0, 0.0], -0.5, 2)],
                    solids,
                    operands,
                    words: vec![0; 1024],
                    cube: Cube { origin: [0; 3], log2_side: 0 },
                    lights: vec![VirtualLight::NONE; 4],
                };
                for (i, place) in made.lights.iter_mut().enumerate().skip(1) {
                    *place = VirtualLight::<A>::new(VirtualLightSpec {
                        position: [i as f64 - 2.0, 2.5, 3.0],
                        normal: [0.0, -0.6, 0.8],
                        intensity: 40.0,
                        color: [1.0, 0.7, 0.4],
                    });
                }
                let parts = Parts::<A> {
                    spheres: &made.spheres[..1],
                    polygons: &made.polygons,
                    cones: &made.cones,
                    solids: &made.solids[0],
                    ..Parts::EMPTY
                };
                let extents: [Extent; 4] = parts.extents(STEP);
                let mut scratch = vec![0; 1024];
                let limits = Limits { levels: 2, ..Limits::DEFAULT };
                let Built { words, cube, .. } =
                    build_into(&extents, &mut made.words, &mut scratch, limits).unwrap();
                made.words.truncate(words);
                made.cube = cube;
                made
            }

            /// Of the group with a tree, the one without, and the scene.
            fn grouped_shapes(of: &Grouped) -> [Shapes<'_, A>; 3] {
                [
                    Shapes {
                        spheres: &of.spheres[..1],
                        polygons: &of.polygons,
                        edges: &of.edges,
                        cones: &of.cones,
                        solids: &of.solids[0],
                        operands: &of.operands[0],
                        ..Shapes::EMPTY
                    },
                    Shapes { spheres: &of.spheres[1..], ..Shapes::EMPTY },
                    Shapes {
                        polygons: &of.polygons,
                        edges: &of.edges,
                        solids: &of.solids[1],
                        operands: &of.operands[1],
                        ..Shapes::EMPTY
                    },
                ]
            }

            fn instances() -> [InstanceSpec; 3] {
                let there = Transform::IDENTITY.rotated([1.0, 2.0, 0.5], 40.0);
                [
                    InstanceSpec {
                        group: 0,
                        transform: there.moved([-0.4, 1.0, 3.0]),
                        material: None,
                    },
                    InstanceSpec {
                        group: 1,
                        transform: Transform::IDENTITY.moved([1.0, 0.5, 2.0]),
                        material: None,
                    },
                    InstanceSpec {
                        group: 0,
                        transform: there.scaled(0.5).moved([-1.5, 0.5, 2.5]),
                        material: Some(2),
                    },
                ]
            }

            const USE: VirtualLightsSpec =
                VirtualLightsSpec { tile: 2, nearest: 0.5, ..VirtualLightsSpec::DEFAULT };
            const PLAIN: [MaterialSpec; 3] = [
                MaterialSpec {
                    diffuse: [0.7, 0.3, 0.2],
                    reflection: [0.3; 3],
                    ..MaterialSpec::BLACK
                },
                MaterialSpec { diffuse: [0.2, 0.6, 0.3], ..MaterialSpec::BLACK },
                MaterialSpec { diffuse: [0.6; 3], ..MaterialSpec::BLACK },
            ];

            /// Passes a content on that borrows what is made for it.
            fn with_groups<T>(of: &Grouped, then: impl FnOnce(&Content<'_, A>) -> T) -> T {
                let [first, second, own] = grouped_shapes(of);
                then(&Content {
                    shapes: own,
                    groups: &[
                        GroupContent { shapes: first, tree: Some((&of.words, of.cube, STEP)) },
                        GroupContent { shapes: second, tree: None },
                    ],
                    instances: &instances(),
                    planes: &of.planes,
                    tree: None,
                    materials: &PLAIN,
                    lights: &LIGHTS[..1],
                    absorptions: &[],
                    textures: &[],
                    area_lights: &[],
                    cache: None,
                    virtual_lights: Some((&of.lights, USE)),
                    setting: SettingSpec { selection: SelectionSpec::All, ..SETTING },
                    uses: 0,
                })
            }

            #[test]
            fn groups_solids_and_virtual_lights_are_read_as_they_were_written() {
                let of = grouped();
                let blob = with_groups(&of, written);
                let [mut first, second, own] = grouped_shapes(&of);
                first.tree = Some(Octree::<A>::try_new(&of.words, 4, &of.cube, STEP).unwrap());
                let groups = [Group::<A>::new(first), Group::<A>::new(second)];
                let placed = instances().map(|spec| {
                    let instance =
                        Instance::<A>::new(&groups[usize::from(spec.group)], spec.transform);
                    spec.material.map_or(instance, |m| instance.with_material(m))
                });
                let settings = VirtualLightsSettings::<A>::new(USE);
                let materials = PLAIN.map(|spec| Material::<A>::new(spec));
                let lights = [Light::<A>::new(LIGHTS[0])];
                let scene = Scene::<A>::new(Parts {
                    polygons: own.polygons,
                    edges: own.edges,
                    solids: own.solids,
                    operands: own.operands,
                    instances: &placed,
                    planes: &of.planes,
                    materials: &materials,
                    lights: &lights,
                    light_jitter: SETTING.light_jitter,
                    indirect: Indirect::VirtualLights(VirtualLights::new(&of.lights, &settings)),
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
            fn what_is_wrong_with_groups_is_said() {
                let of = grouped();
                let said = |change: &dyn Fn(&mut Content<'_, A>)| {
                    with_groups(&of, |content| {
                        let mut content = *content;
                        change(&mut content);
                        shown(written(&content).bytes(), 1).unwrap_err()
                    })
                };
                // No such group; a turn that is none; a material that isn't there.
                let change = |to: InstanceSpec| {
                    let to: &[_] = Box::leak(Box::new([to]));
                    said(&|c| c.instances = to)
                };
                let one = instances()[0];
                assert_eq!(change(InstanceSpec { group: 2, ..one }), BlobError::Parts);
                let bent = Transform { rotation: [[1.0; 3]; 3], ..one.transform };
                let bent = InstanceSpec { transform: bent, ..one };
                assert!(matches!(change(bent), BlobError::Value(_)));
                let bare = InstanceSpec { material: Some(3), ..one };
                assert!(matches!(change(bare), BlobError::Scene(_)));
                let many = said(&|c| {
                    c.instances =
                        &[InstanceSpec { group: 1, transform: Transform::IDENTITY, material: None };
                            4]
                });
                let wanted =
                    BlobError::RoomForGroups { solids: 2, operands: 6, groups: 2, instances: 4 };
                assert_eq!(many, wanted);
                let few =
                    said(&|c| c.groups = &[GroupContent { shapes: Shapes::EMPTY, tree: None }; 2]);
                assert!(matches!(few, BlobError::Scene(_)), "{few}");
                assert_eq!(said(&|c| c.shapes.solids = &[Solid::NONE]), BlobError::Solid);
                let tile = VirtualLightsSpec { tile: 3, ..USE };
                let wrong = said(&|c| c.virtual_lights = Some((&[], tile)));
                assert!(matches!(wrong, BlobError::Value(_)));
                assert_eq!(said(&|c| c.cache = Some((&[], ERROR))), BlobError::Parts);
                // Without room for groups, and with a scene of a type that has none.
                let blob = with_groups(&of, written);
                let blob = Blob::<A>::open(blob.bytes()).unwrap();
                let mut materials = [Material::<A>::new(MaterialSpec::BLACK); 4];
                let mut lights = [Light::<A>::point([0.0; 3], [0.0; 3]); 4];
                let scene: Result<Scene<'_, A>, _> = blob.scene(&mut materials, &mut lights);
                assert!(matches!(scene.map(drop), Err(BlobError::RoomForGroups { .. })));
                let scene = blob
                    .scene::<{ whitted::scene::uses::VIRTUAL_LIGHTS }>(&mut materials, &mut lights);
                assert!(matches!(scene.map(drop), Err(BlobError::Scene(_))));
            }

            #[test]
            fn every_change_of_a_byte_and_every_truncation_is_noticed() {
                is_noticed(written(&content(&kinds())));
                is_noticed(with_groups(&grouped(), written));
            }

            fn is_noticed(mut blob: Aligned) {
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
                is_refused_or_harmless(written(&content(&kinds())), |_| true);
            }

            /// What the other blob has none of: every bit, and the smallest and the largest byte.
            #[test]
            fn every_change_of_a_bit_of_groups_is_refused_or_harmless() {
                let few = |[value, right]: [u8; 2]| {
                    u8::count_ones(value ^ right) == 1 || value == 0 || value == 255
                };
                is_refused_or_harmless(with_groups(&grouped(), written), few);
            }

            #[test]
            #[ignore = "takes a minute: for whoever changes what blobs hold of groups"]
            fn every_change_of_a_byte_of_groups_is_refused_or_harmless() {
                is_refused_or_harmless(with_groups(&grouped(), written), |_| true);
            }

            fn is_refused_or_harmless(mut blob: Aligned, tried: impl Fn([u8; 2]) -> bool) {
                let (mut refused, mut shows) = (0, 0);
                for at in 0..blob.bytes().len() {
                    let right = blob.bytes()[at];
                    for value in (0..=255).filter(|v| *v != right) {
                        let ($value, $right) = (value, right);
                        if !$tried || !tried([value, right]) {
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

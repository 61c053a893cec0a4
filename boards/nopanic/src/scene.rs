//! A scene of everything, made from run-time values, read from a blob and written to one.

use core::hint::black_box as any;

use whitted::blob::{self, Blob, Content, GroupContent, InstanceSpec, Room};
use whitted::gather::{Draft, Gatherer, Gathering, GatheringSpec, Indirect, IrradianceCache};
use whitted::gather::{Record, RecordSpec, VirtualLight, VirtualLights};
use whitted::gather::{VirtualLightsSettings, VirtualLightsSpec};
use whitted::math::Fixed;
use whitted::octree::{self, Limits, Octree};
use whitted::scene::{self, Absorption, Filter, Mapping, Pattern, Texels, Texture, TextureSpec};
use whitted::scene::{Ambient, Area, AreaLight, AreaLightSpec, Background, Camera, Falloff};
use whitted::scene::{FanCorner, Group, Instance, Light, LightSpec, Selection};
use whitted::scene::{Material, Shapes, Transform};
use whitted::scene::{MaterialSpec, Parts, PatternSpec, Rules, Scene, Shadow};
use whitted::scene::{TriangleUv, Wrap};
use whitted::shape::{Cone, Cuboid, Cylinder, Disc, Operand, Plane, Polygon, Region};
use whitted::shape::{SmoothTriangle, Solid, Sphere, Triangle};
use whitted::tally::Counts;
use whitted::trace::Work;

use crate::frame;

/// A scene of everything, made from run-time values in one arithmetic, and rendered in every way.
macro_rules! arithmetic {
    ($name:ident, $a:ty, $tally:ty) => {
        #[inline(never)]
        pub(crate) fn $name() -> Option<()> {
            let spec = MaterialSpec {
                ambient: any([0.1; 3]),
                diffuse: any([0.5; 3]),
                specular: any([0.5; 3]),
                shininess: any(32.0),
                reflection: any([0.2; 3]),
                transmission: any([0.2; 3]),
                index_front: any(1.0),
                index_behind: any(1.5),
                emission: any([0.1; 3]),
                shadow: any(Shadow::Filtered),
                pattern: any(Some(PatternSpec { cell: [1.0; 3], offset: [0.5; 3], other: 1 })),
                texture: any(Some(0)),
                bump: any(Some(1)),
                fresnel: any(true),
                absorption: any(Some(0)),
            };
            let materials = any([Material::<$a>::try_new(&spec).ok()?; 2]);
            let spheres = any([Sphere::<$a>::try_new(any([0.0; 3]), any(1.0), any(0)).ok()?; 2]);
            let planes = any([Plane::<$a>::try_new(any([0.0; 3]), any(1.0), any(0)).ok()?; 2]);
            let corners = any([[0.0; 3], [1.0; 3], [2.0; 3]]);
            let triangles = any([Triangle::<$a>::try_new(corners, any(0)).ok()?; 2]);
            let smooth =
                any([SmoothTriangle::<$a>::try_new(corners, any(corners), any(0)).ok()?; 2]);
            let polygons = any([Polygon::<$a>::try_new(any(&corners), any(0), any(0)).ok()?; 2]);
            any((polygons[0].first_edge(), polygons[0].edge_count()));
            let edges = any([Polygon::<$a>::try_edge(any(&corners), any(0)).ok()?; 6]);
            let cuboids =
                any([Cuboid::<$a>::try_new(any([0.0; 3]), any([1.0; 3]), any(0)).ok()?; 2]);
            let discs =
                any([Disc::<$a>::try_new(any([0.0; 3]), any([1.0; 3]), any(1.0), any(0)).ok()?; 2]);
            let (base, apex) = (any([0.0; 3]), any([1.0; 3]));
            let cylinders = any([Cylinder::<$a>::try_new(base, apex, any(1.0), any(0)).ok()?; 2]);
            let cones = any([Cone::<$a>::try_new(base, any(1.0), apex, any(2.0), any(0)).ok()?; 2]);
            let cylinders = [cylinders[0], any(cylinders[1].with_caps())];
            let cones = [cones[0], any(cones[1].with_caps())];
            let operands = any([
                Operand::Sphere(spheres[0]),
                Operand::Cuboid(cuboids[0]),
                Operand::Cylinder(cylinders[0]),
                Operand::Cone(cones[0]),
                Operand::HalfSpace(planes[0]),
            ]);
            let region = any(Region::of(any(0))).or(any(Region::of(1))).and(any(Region::of(2)));
            let region = any(region.minus(any(Region::NOTHING)));
            any((region.is_nothing(), region.holds(any(7))));
            let solid = Solid::<$a>::try_new(region, any(&operands), any(0), any(5));
            if let Err(error) = &solid {
                any(error.message());
            }
            let solids = any([solid.ok()?]);
            any((solids[0].first_operand(), solids[0].operand_count()));
            any(Triangle::<$a>::extent_of(corners, any(-16)));
            any(Polygon::<$a>::extent_of(any(&corners), any(-16)));
            let (position, direction, intensity) = (any([1.0; 3]), any([1.0; 3]), any([9.0; 3]));
            let falloff = any(Falloff::InverseSquare);
            let (cos_inner, cos_outer) = (any(0.9), any(0.8));
            let point = LightSpec::Point { position, intensity, falloff };
            let directional = LightSpec::Directional { direction, intensity };
            let spot =
                LightSpec::Spot { position, direction, intensity, falloff, cos_inner, cos_outer };
            let lights = any([
                Light::<$a>::try_new(&point).ok()?,
                Light::<$a>::try_new(&directional).ok()?,
                Light::<$a>::try_new(&spot).ok()?,
            ]);
            any(lights[0].direction());
            let spec = |area| AreaLightSpec {
                area,
                radiance: any([9.0; 3]),
                error: any(0.1),
                samples: any([2, 9]),
                body: any(Some(1)),
            };
            let lamp = any(spec(any(Area::Polygon { corners: any(&[[1.0; 3]; 4]), first: 0 })));
            let image =
                scene::Image::try_new(any(9), any(9), any(Texels::Rgb565), any(&[0; 162])).ok()?;
            let image = image.with_filter(any(Filter::Bilinear)).with_wrap(any(Wrap::Clamp));
            any(image.size());
            let texture = TextureSpec {
                mapping: any(Mapping::Spherical),
                other: any(Some(1)),
                height: any(0.5),
                ..TextureSpec::of(any(Pattern::Image(image)))
            };
            let textures = any([Texture::<$a>::try_new(&any(texture)).ok()?; 2]);
            let uvs = any([TriangleUv::try_new(any([[0.5; 2]; 3])).ok()?; 4]);
            let absorptions =
                any([Absorption::<$a>::try_new(any([0.5; 3]), any([0.1; 3])).ok()?; 1]);
            let (corner, edge) = (any([1.0; 3]), any([1.0; 3]));
            let area_lights = any([
                AreaLight::<$a>::try_new(&spec(Area::Rectangle { corner, u: edge, v: edge }))
                    .ok()?,
                AreaLight::<$a>::try_new(&spec(Area::Triangle { corners })).ok()?,
                AreaLight::<$a>::try_new(&spec(Area::Polygon {
                    corners: any(&corners),
                    first: any(0),
                }))
                .ok()?,
                AreaLight::<$a>::try_new(&spec(Area::Disc {
                    center: corner,
                    normal: edge,
                    radius: any(1.0),
                }))
                .ok()?,
                AreaLight::<$a>::try_new(&spec(Area::Sphere { center: corner, radius: any(1.0) }))
                    .ok()?,
            ]);
            any(area_lights[0].body());
            let fan = any([AreaLight::<$a>::try_fan(any(&corners), any(0)).ok()?; 2]);
            any(Background::<$a>::try_uniform(any([0.1; 3])).ok()?);
            let background =
                Background::<$a>::try_gradient(any([0.0; 3]), any([0.1; 3]), any([0.1; 3]));
            let shapes = any(Shapes {
                spheres: &spheres,
                triangles: &triangles,
                smooth_triangles: &smooth,
                polygons: &polygons,
                edges: &edges,
                uvs: &uvs,
                cuboids: &cuboids,
                discs: &discs,
                cylinders: &cylinders,
                cones: &cones,
                solids: &solids,
                operands: &operands,
                tree: None,
            });
            let group = Group::<$a>::try_new(shapes);
            if let Err(error) = &group {
                any(error.message());
            }
            let group = any(group.ok()?);
            any((group.uses(), group.shapes().bounded()));
            let turned = any(Transform::IDENTITY).scaled(any(2.0)).rotated(any([1.0; 3]), any(9.0));
            let turned = turned.moved(any([1.0; 3])).turned(&any(Transform::IDENTITY).rotation);
            any(turned.apply(any([1.0; 3])));
            let instance = Instance::<$a>::try_new(&group, &turned);
            let instance = any(instance.ok()?).with_material(any(1));
            let instances = [any(instance.at(any(instance.position())))];
            any(instance.group().uses());
            let parts = Parts {
                instances: any(&instances),
                spheres: any(&spheres),
                triangles: any(&triangles),
                smooth_triangles: any(&smooth),
                polygons: any(&polygons),
                edges: any(&edges),
                uvs: any(&uvs),
                cuboids: any(&cuboids),
                discs: any(&discs),
                cylinders: any(&cylinders),
                cones: any(&cones),
                solids: any(&solids),
                operands: any(&operands),
                planes: any(&planes),
                tree: any(None),
                materials: any(&materials),
                textures: any(&textures),
                absorptions: any(&absorptions),
                lights: any(&lights),
                area_lights: any(&area_lights),
                light_corners: any(&fan),
                light_jitter: any(Some(3)),
                selection: any(Selection::<$a>::try_above(any(0.1)).ok()?),
                ambient: Ambient::<$a>::try_new(any([0.1; 3])).ok()?,
                indirect: any(Indirect::None),
                background: any(background.ok()?),
                rules: any(Rules::COURSE),
            };
            // A tree over the shapes as they are now, in memory of the caller's.
            let step = any(-16);
            let extents = any([
                spheres[0].extent(step),
                triangles[0].extent(step),
                smooth[0].extent(step),
                polygons[0].extent(step),
                cuboids[0].extent(step),
                discs[0].extent(step),
                cylinders[0].extent(step),
                cones[0].extent(step),
                solids[0].extent(step),
            ]);
            any(parts.bounded());
            let (mut words, mut scratch) = (any([0; 80]), any([0; 80]));
            let built =
                octree::build_into(&extents, &mut words, &mut scratch, any(Limits::DEFAULT));
            if let Err(error) = &built {
                any(error.message());
            }
            let cube = any(built.ok()?).cube;
            let tree = Octree::<$a>::try_new(any(&words), any(9), &cube, any(-16));
            if let Err(error) = &tree {
                any(error.message());
            }
            let scene = Scene::new(any(Parts { tree: any(tree.ok()), ..parts }));
            if let Err(error) = &scene {
                any(error.message());
            }
            let scene = any(scene.ok()?);
            any(scene.parts());
            let scene = any(scene.with_instances(any(&instances)).ok()?);
            any(spheres[0].at(any(spheres[1].center())).radius());

            let camera =
                Camera::<$a>::try_look_at(any([0.0; 3]), any([1.0; 3]), any([0.0; 3]), any(1.0));
            let camera = any(camera.ok()?);
            let record = RecordSpec {
                position: any([0.0; 3]),
                normal: any([0.0, 1.0, 0.0]),
                reach: any(1.0),
                irradiance: any([1.0; 3]),
                translation: any([0.5; 3]),
                rotation: any([0.5; 3]),
            };
            let mut pool = any([Record::<$a>::try_new(&record).ok()?; 8]);
            any(pool[0].position());
            let gathering = GatheringSpec {
                error: any(0.25),
                rings: any(5),
                sectors: any(13),
                nearest: any(0.25),
                farthest: any(4.0),
                bounces: any(2),
                depth: any(3),
                coarse: any(8),
                fine: any(2),
                seed: any(1),
            };
            let gathering = any(Gathering::<$a>::try_new(&gathering).ok()?);
            any((gathering.rays(), gathering.bounces(), gathering.depth()));
            let (mut memory, mut counts) = (any(Work::<$a, 5>::new()), <$tally>::default());
            let gatherer = Gatherer::new(&scene, gathering, &mut memory, &mut counts);
            let mut drafts = any([Draft::<$a>::NONE; 8]);
            let size = (any(60), any(60));
            let filled = gatherer.ok()?.fill(&camera, size, &mut pool, &mut drafts).ok()?;
            any((filled.is_full(), filled.records().len()));
            let cache = IrradianceCache::<$a>::try_new(any(filled.records()), any(0.25)).ok()?;
            let spec = VirtualLightsSpec {
                bounces: any(2),
                tile: any(2),
                nearest: any(0.5),
                center: any([0.0; 3]),
                radius: any(9.0),
            };
            let settings = any(VirtualLightsSettings::<$a>::try_new(&spec).ok()?);
            let mut pool = any([VirtualLight::<$a>::NONE; 16]);
            pool[0] = any(VirtualLight::<$a>::try_new(&any(pool[1].spec())).ok()?);
            let laid = VirtualLights::lay(&scene, &settings, &mut pool, &mut memory, &mut counts);
            let laid = any(VirtualLights::new(any(laid.lights()), &settings));
            let indirect = any([Indirect::Cache(cache), Indirect::VirtualLights(laid)]);
            any(indirect[0].uses());
            let scene = any(scene.with_indirect(any(indirect[1])).ok()?);
            let camera = Camera::<$a>::try_from_vectors(
                any([0.0; 3]),
                any([1.0; 3]),
                any([0.0; 3]),
                any([1.0; 3]),
            );
            frame::render(&scene, &any(camera.ok()?), <$tally>::default());

            let blob = Blob::<$a>::open(any(&[0; 1000]));
            if let Err(error) = &blob {
                any(error);
            }
            let blob = any(blob.ok()?);
            any((blob.counts(), blob.uses(), blob.depth(), blob.setting()));
            any(blob.camera().ok()?);
            let (mut materials, mut lights) = (any(materials), any(lights));
            let scene: Scene<'_, $a> = blob.scene(any(&mut materials), any(&mut lights)).ok()?;
            any(scene.parts());
            let (mut materials, mut lights) = (any(materials), any(lights));
            let mut textures = any([Texture::<$a>::try_new(&any(texture)).ok()?; 2]);
            let mut areas = any([AreaLight::<$a>::try_new(&lamp).ok()?; 2]);
            let (mut fans, mut media) = (any([FanCorner::NONE; 8]), any(absorptions));
            let (mut pool_solids, mut pool_operands) = ([Solid::NONE; 4], [Operand::NONE; 8]);
            let mut pool_groups = [Group::<$a>::NONE; 2];
            let mut pool_instances = [Instance::<$a>::NONE; 2];
            let scene: Scene<'_, $a> = blob
                .scene_in(any(Room {
                    materials: any(&mut materials),
                    lights: any(&mut lights),
                    area_lights: any(&mut areas),
                    fans: any(&mut fans),
                    textures: any(&mut textures),
                    absorptions: any(&mut media),
                    solids: any(&mut pool_solids),
                    operands: any(&mut pool_operands),
                    groups: any(&mut pool_groups),
                    instances: any(&mut pool_instances),
                }))
                .ok()?;
            any(scene.parts());
            let (specs, kinds) = (any([MaterialSpec::BLACK]), any([point, spot]));
            let (surfaces, lamps) = ([texture; 2], [lamp; 2]);
            let placed =
                [InstanceSpec { group: any(0), transform: turned, material: any(Some(0)) }];
            let grouped = [GroupContent { shapes, tree: any(None) }];
            let content = Content {
                shapes,
                groups: any(&grouped),
                instances: any(&placed),
                planes: any(&planes),
                tree: Some((any(&words), cube, any(-16))),
                materials: &specs,
                lights: &kinds,
                absorptions: any(&[[[0.0; 3]; 2]]),
                textures: any(&surfaces),
                area_lights: any(&lamps),
                cache: any(Some((filled.records(), 0.2))),
                virtual_lights: any(Some((laid.lights(), any(VirtualLightsSpec::DEFAULT)))),
                setting: *blob.setting(),
                uses: any(7),
            };
            let mut bytes = any([0; 64]);
            content.write(&mut |part| {
                any(part);
            });
            blob::seal(any(&mut bytes));
            Some(())
        }
    };
}

arithmetic!(fixed, Fixed, Counts);
arithmetic!(single, f32, ());
arithmetic!(double, f64, ());

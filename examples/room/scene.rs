//! A room lit by a lamp with an area, in statics: a wooden floor, a mirror, two tables that are one
//! group placed twice, and room for what its walls send each other. x left, y up, z forward.

use super::A;
use whitted::gather::{Gathering, GatheringSpec};
use whitted::scene::{
    Ambient, Area, AreaLight, AreaLightSpec, Camera, Group, Instance, Material, MaterialSpec,
    Parts, Pattern, Scene, Shapes, Texture, TextureSpec, Transform, uses,
};
use whitted::shape::{Cuboid, Plane, Polygon, Sphere};

/// The lamp, flush with the ceiling, seen from below.
const LAMP: [[f64; 3]; 4] =
    [[-0.6, 2.58, 1.4], [0.6, 2.58, 1.4], [0.6, 2.58, 2.6], [-0.6, 2.58, 2.6]];
const RADIANCE: [f64; 3] = [5.0, 4.7, 4.2];

static TABLE: Group<'static, A> = Group::<A>::new(Shapes {
    cuboids: &[
        Cuboid::<A>::new([-0.5, 0.56, -0.35], [0.5, 0.62, 0.35], WOOD),
        Cuboid::<A>::new([-0.46, 0.0, -0.31], [-0.4, 0.56, -0.25], WOOD),
        Cuboid::<A>::new([0.4, 0.0, -0.31], [0.46, 0.56, -0.25], WOOD),
        Cuboid::<A>::new([-0.46, 0.0, 0.25], [-0.4, 0.56, 0.31], WOOD),
        Cuboid::<A>::new([0.4, 0.0, 0.25], [0.46, 0.56, 0.31], WOOD),
    ],
    ..Shapes::EMPTY
});

const WHITE: u16 = 0;
const RED: u16 = 1;
const GREEN: u16 = 2;
const FLOOR: u16 = 3;
const MIRROR: u16 = 4;
const GLOW: u16 = 5;
const WOOD: u16 = 6;

const fn dull(diffuse: [f64; 3]) -> MaterialSpec {
    MaterialSpec { diffuse, ambient: diffuse, ..MaterialSpec::BLACK }
}

const PARTS: Parts<'static, A> = Parts {
    spheres: &[Sphere::<A>::new([0.8, 0.45, 3.0], 0.45, MIRROR)],
    polygons: &[Polygon::<A>::new(&LAMP, 0, GLOW)],
    edges: &Polygon::<A>::edges::<4>(&LAMP),
    instances: &[
        Instance::<A>::new(
            &TABLE,
            Transform::IDENTITY.rotated([0.0, 1.0, 0.0], 20.0).moved([-0.9, 0.0, 2.2]),
        ),
        Instance::<A>::new(&TABLE, Transform::IDENTITY.scaled(0.6).moved([0.7, 0.0, 1.6])),
    ],
    planes: &[
        Plane::<A>::new([0.0, 1.0, 0.0], 0.0, FLOOR),
        Plane::<A>::new([0.0, -1.0, 0.0], -2.6, WHITE),
        Plane::<A>::new([1.0, 0.0, 0.0], -1.8, RED),
        Plane::<A>::new([-1.0, 0.0, 0.0], -1.8, GREEN),
        Plane::<A>::new([0.0, 0.0, -1.0], -4.0, WHITE),
        Plane::<A>::new([0.0, 0.0, 1.0], -1.6, WHITE),
    ],
    materials: &[
        Material::<A>::new(dull([0.75; 3])),
        Material::<A>::new(dull([0.7, 0.12, 0.1])),
        Material::<A>::new(dull([0.15, 0.55, 0.2])),
        Material::<A>::new(MaterialSpec { texture: Some(0), ..dull([1.0; 3]) }),
        Material::<A>::new(MaterialSpec { reflection: [0.85; 3], ..dull([0.05; 3]) }),
        Material::<A>::new(MaterialSpec { emission: RADIANCE, ..MaterialSpec::BLACK }),
        Material::<A>::new(dull([0.55, 0.38, 0.2])),
    ],
    textures: &[Texture::<A>::new(TextureSpec {
        right: [0.0, 0.0, 1.0],
        up: [1.0, 0.0, 0.0],
        size: [1.2, 0.25, 0.0],
        colors: [[0.62, 0.42, 0.24], [0.3, 0.18, 0.1]],
        ..TextureSpec::of(Pattern::Brick { mortar: 0.06 })
    })],
    area_lights: &[AreaLight::<A>::new(AreaLightSpec {
        area: Area::Rectangle { corner: LAMP[0], u: [1.2, 0.0, 0.0], v: [0.0, 0.0, 1.2] },
        radiance: RADIANCE,
        error: AreaLightSpec::ERROR,
        samples: [4, 16],
        body: Some(1),
    })],
    light_jitter: Some(1),
    ambient: Ambient::<A>::new([0.0; 3]),
    ..Parts::EMPTY
};

/// The room, with the code for an irradiance cache.
pub(crate) static SCENE: Scene<'static, A, { PARTS.uses() | uses::IRRADIANCE_CACHE }> =
    Scene::tailored(PARTS);

/// How the cache is filled: two bounces, coarsely.
pub(crate) static GATHERING: Gathering<A> = Gathering::<A>::new(GatheringSpec {
    error: 0.4,
    bounces: 2,
    coarse: 16,
    ..GatheringSpec::DEFAULT
});

/// From beside the wall behind.
pub(crate) static CAMERA: Camera<A> =
    Camera::<A>::look_at([0.0, 1.3, -1.4], [0.0, 1.05, 2.0], [0.0, 1.0, 0.0], 62.0);

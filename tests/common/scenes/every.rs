//! One of every shape, light and sort of material, with an octree that the compiler builds.

use super::A;
use whitted::gather::Indirect;
use whitted::octree::{Octree, OctreeBuffer};
use whitted::scene::{
    Ambient, Background, Camera, Falloff, Light, LightSpec, Material, MaterialSpec, Parts,
    PatternSpec, Rules, Scene, Shadow,
};
use whitted::shape::{
    Cone, Cuboid, Cylinder, Disc, Plane, Polygon, PolygonEdge, SmoothTriangle, Sphere, Triangle,
};

/// The scene's bounded shapes.
pub const BOUNDED: usize = 17;

/// The grid of the tree: ±128 units.
const LOG2_STEP: i8 = -20;

const FLOOR: u16 = 0;
const DARK: u16 = 1;
const MIRROR: u16 = 2;
const GLASS: u16 = 3;
const RED: u16 = 4;
const GREEN: u16 = 5;
const BLUE: u16 = 6;
const PANE: u16 = 7;

static HEXAGON: [[f64; 3]; 6] = [
    [3.0, 1.3, 2.2],
    [2.5, 2.2, 2.3],
    [1.5, 2.2, 2.5],
    [1.0, 1.3, 2.6],
    [1.5, 0.4, 2.5],
    [2.5, 0.4, 2.3],
];
static PANE_CORNERS: [[f64; 3]; 4] =
    [[-2.7, 0.0, 0.4], [-1.4, 0.0, 0.0], [-1.4, 1.9, 0.0], [-2.7, 1.9, 0.4]];

static EDGES: [PolygonEdge<A>; 10] = {
    let [a, b, c, d, e, f] = Polygon::<A>::edges(&HEXAGON);
    let [g, h, i, j] = Polygon::<A>::edges(&PANE_CORNERS);
    [a, b, c, d, e, f, g, h, i, j]
};

/// Two facets of a bent sheet, with the normals of the sheet.
const SHEET: [[[f64; 3]; 3]; 2] = [
    [[0.7, 0.0, -1.2], [1.9, 0.0, -0.9], [1.3, 1.4, -0.5]],
    [[0.7, 0.0, -1.2], [1.3, 1.4, -0.5], [0.1, 1.4, -0.8]],
];
const BENT: [[[f64; 3]; 3]; 2] = [
    [[-0.2, 0.4, -1.0], [0.6, 0.4, -1.0], [0.3, 0.7, -1.0]],
    [[-0.2, 0.4, -1.0], [0.3, 0.7, -1.0], [-0.4, 0.8, -1.0]],
];

pub const PARTS: Parts<A> = Parts {
    spheres: &[
        Sphere::<A>::new([-3.4, 0.9, -0.6], 0.9, MIRROR),
        Sphere::<A>::new([-0.9, 0.6, -1.8], 0.6, GLASS),
        Sphere::<A>::new([2.9, 0.35, -2.0], 0.35, RED),
        // a bowl: the inside of it alone
        Sphere::<A>::new([5.2, 1.6, 0.8], -0.8, BLUE),
    ],
    triangles: &[
        Triangle::<A>::new([[2.6, 0.0, -0.9], [4.2, 0.0, -0.3], [3.4, 1.5, -0.2]], GREEN),
        Triangle::<A>::new([[4.2, 0.0, -0.3], [4.8, 0.0, 0.9], [3.4, 1.5, -0.2]], RED),
    ],
    smooth_triangles: &[
        SmoothTriangle::<A>::new(SHEET[0], BENT[0], BLUE),
        SmoothTriangle::<A>::new(SHEET[1], BENT[1], BLUE),
    ],
    polygons: &[Polygon::<A>::new(&HEXAGON, 0, MIRROR), Polygon::<A>::new(&PANE_CORNERS, 6, PANE)],
    edges: &EDGES,
    cuboids: &[
        Cuboid::<A>::new([-0.7, 0.0, 1.6], [0.6, 1.2, 2.8], RED),
        Cuboid::<A>::new([-0.4, 1.2, 1.9], [0.3, 1.6, 2.5], FLOOR),
    ],
    discs: &[
        Disc::<A>::new([4.2, 1.6, 2.8], [-0.5, 0.1, -1.0], 0.9, GREEN),
        Disc::<A>::new([-4.4, 1.8, 2.0], [0.0, 1.0, 0.0], 0.7, DARK),
    ],
    cylinders: &[
        Cylinder::<A>::new([-4.4, 0.0, 2.0], [-4.4, 1.8, 2.0], 0.7, GREEN),
        Cylinder::<A>::new([0.2, 0.2, -2.4], [1.4, 0.3, -2.8], -0.2, BLUE),
    ],
    cones: &[Cone::<A>::new([-2.4, 0.0, 2.4], 0.9, [-2.3, 2.1, 2.5], 0.2, RED)],
    solids: &[],
    operands: &[],
    instances: &[],
    planes: &[Plane::<A>::new([0.0, 1.0, 0.0], 0.0, FLOOR)],
    tree: None,
    materials: &MATERIALS,
    textures: &[],
    uvs: &[],
    absorptions: &[],
    lights: &[
        Light::<A>::point([-4.0, 6.0, -5.0], [36.0, 33.0, 28.0]),
        Light::<A>::new(LightSpec::Directional {
            direction: [-0.6, -1.0, 0.4],
            intensity: [0.10, 0.12, 0.18],
        }),
        Light::<A>::new(LightSpec::Spot {
            position: [5.0, 5.0, -4.0],
            direction: [-3.0, -4.5, 4.0],
            intensity: [0.5, 0.45, 0.3],
            falloff: Falloff::None,
            cos_inner: 0.97,
            cos_outer: 0.88,
        }),
    ],
    ambient: Ambient::<A>::new([0.15, 0.15, 0.18]),
    indirect: Indirect::None,
    background: Background::<A>::gradient([0.0, 1.0, 0.0], [0.75, 0.7, 0.6], [0.1, 0.25, 0.6]),
    rules: Rules { specular_cosine: false, ..Rules::COURSE },
    ..Parts::EMPTY
};

pub static TREE: OctreeBuffer<256> = OctreeBuffer::build(&PARTS.extents::<BOUNDED>(LOG2_STEP));

pub static SCENE: Scene<A> =
    Scene::checked(Parts { tree: Some(Octree::<A>::of(&TREE, LOG2_STEP)), ..PARTS });

pub static CAMERA: Camera<A> =
    Camera::<A>::look_at([0.37, 2.9, -8.6], [0.24, 1.05, 0.3], [0.0, 1.0, 0.0], 38.0);

static MATERIALS: [Material<A>; 8] = [
    Material::<A>::new(MaterialSpec {
        pattern: Some(PatternSpec {
            cell: [1.1, 0.0, 1.1],
            offset: [0.13, 0.0, 0.21],
            other: DARK,
        }),
        ..matt(0.75, 0.72, 0.66)
    }),
    Material::<A>::new(matt(0.14, 0.16, 0.2)),
    Material::<A>::new(MaterialSpec {
        reflection: [0.8, 0.82, 0.85],
        specular: [0.6; 3],
        shininess: 120.0,
        ..matt(0.05, 0.05, 0.05)
    }),
    Material::<A>::new(MaterialSpec {
        reflection: [0.1; 3],
        transmission: [0.86, 0.93, 0.9],
        index_behind: 1.5,
        shadow: Shadow::Filtered,
        specular: [0.8; 3],
        shininess: 200.0,
        ..MaterialSpec::BLACK
    }),
    shiny(0.7, 0.12, 0.08),
    shiny(0.1, 0.5, 0.2),
    shiny(0.1, 0.2, 0.6),
    Material::<A>::new(MaterialSpec {
        transmission: [0.9, 0.6, 0.3],
        shadow: Shadow::Filtered,
        ..matt(0.05, 0.04, 0.03)
    }),
];

const fn matt(r: f64, g: f64, b: f64) -> MaterialSpec {
    MaterialSpec { ambient: [r, g, b], diffuse: [r, g, b], ..MaterialSpec::BLACK }
}

const fn shiny(r: f64, g: f64, b: f64) -> Material<A> {
    Material::<A>::new(MaterialSpec { specular: [0.4; 3], shininess: 30.0, ..matt(r, g, b) })
}

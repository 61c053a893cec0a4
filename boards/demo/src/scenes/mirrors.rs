//! Two half-silvered panes that face each other, a glass ball between them: every hit of a pane
//! sends two rays, one of which hits the other pane, so that trees of rays grow as deep as they may.

use super::A;
use whitted::scene::{Background, Camera, Falloff, Light, LightSpec, Material, MaterialSpec};
use whitted::scene::{Parts, PatternSpec, Rules, Scene};
use whitted::shape::{Plane, Polygon, Sphere};

pub(super) static SCENE: Scene<A, { PARTS.uses() }> = Scene::tailored(PARTS);

pub(super) const PARTS: Parts<A> = Parts {
    spheres: &[Sphere::<A>::new([0.3, 1.0, 0.5], 0.6, 0)],
    polygons: &[Polygon::<A>::new(&LEFT, 0, 1), Polygon::<A>::new(&RIGHT, 4, 1)],
    edges: &EDGES,
    planes: &[Plane::<A>::new([0.0, 1.0, 0.0], 0.0, 2)],
    materials: &[
        Material::<A>::new(MaterialSpec {
            specular: [0.5; 3],
            shininess: 40.0,
            reflection: [0.3; 3],
            transmission: [0.7; 3],
            index_behind: 1.5,
            ..MaterialSpec::BLACK
        }),
        Material::<A>::new(MaterialSpec {
            diffuse: [0.05, 0.06, 0.07],
            reflection: [0.7; 3],
            transmission: [0.3; 3],
            ..MaterialSpec::BLACK
        }),
        Material::<A>::new(MaterialSpec {
            diffuse: [0.6; 3],
            pattern: Some(PatternSpec { cell: [0.5, 0.0, 0.5], offset: [0.0; 3], other: 3 }),
            ..MaterialSpec::BLACK
        }),
        Material::<A>::new(MaterialSpec { diffuse: [0.1, 0.1, 0.3], ..MaterialSpec::BLACK }),
    ],
    lights: &[Light::<A>::new(LightSpec::Point {
        position: [0.0, 4.0, -1.0],
        intensity: [1.0; 3],
        falloff: Falloff::None,
    })],
    background: Background::<A>::gradient([0.0, 1.0, 0.0], [0.5; 3], [0.2, 0.4, 0.9]),
    rules: Rules::WHITTED,
    ..Parts::EMPTY
};

pub(super) static CAMERA: Camera<A> =
    Camera::<A>::look_at([-1.5, 1.2, -1.5], [2.0, 1.0, -0.6], [0.0, 1.0, 0.0], 60.0);

const LEFT: [[f64; 3]; 4] =
    [[-2.0, 0.0, -9.0], [-2.0, 0.0, 9.0], [-2.0, 3.0, 9.0], [-2.0, 3.0, -9.0]];
const RIGHT: [[f64; 3]; 4] = [[2.0, 0.0, -9.0], [2.0, 3.0, -9.0], [2.0, 3.0, 9.0], [2.0, 0.0, 9.0]];

const EDGES: [whitted::shape::PolygonEdge<A>; 8] = {
    let [a, b, c, d] = Polygon::<A>::edges(&LEFT);
    let [e, f, g, h] = Polygon::<A>::edges(&RIGHT);
    [a, b, c, d, e, f, g, h]
};

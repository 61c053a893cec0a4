//! Lights that can be seen: shapes that shine stand for them, in the scene and in mirrors.

use super::{DOWN, Point, SIXTY_FOUR, UP, spec};
use crate::arithmetics::in_each_arithmetic;
use crate::common::{radiance, toward};
use whitted::scene::{
    Area, AreaLight, AreaLightSpec, FanCorner, Light, Material, MaterialSpec, Parts, Rules, Scene,
    Shadow,
};
use whitted::shape::{Disc, Plane, Polygon, Sphere};

in_each_arithmetic! {
    // the emission of a body is seen from its front by the camera and in a mirror, unlit
    emission: {
        let materials = [
            Material::<A>::new(MaterialSpec { emission: [2.0, 1.0, 0.5], ..MaterialSpec::BLACK }),
            Material::<A>::new(MaterialSpec { reflection: [0.5; 3], ..MaterialSpec::BLACK }),
        ];
        let spheres = [
            Sphere::<A>::new([5.0, 0.0, 0.0], 1.0, 0),
            Sphere::<A>::new([-5.0, 0.0, 0.0], -1.0, 0),
        ];
        let discs = [Disc::<A>::new([0.0, 2.0, 0.0], DOWN, 1.0, 0)];
        let planes = [Plane::<A>::new(UP, -2.0, 1)];
        let parts = Parts::<A> {
            spheres: &spheres,
            discs: &discs,
            planes: &planes,
            materials: &materials,
            rules: Rules::WHITTED,
            ..Parts::EMPTY
        };
        let scene = Scene::<A>::checked(parts);
        let see = |from, to| {
            let (eye, way) = toward(from, to);
            radiance(&scene, 3, eye, way)
        };
        let near = |got: Point, exact: Point| {
            (0..3).all(|i| (got[i] - exact[i]).abs() < 1e-3)
        };
        assert!(near(see([0.0; 3], [0.0, 2.0, 0.0]), [2.0, 1.0, 0.5]));
        assert_eq!(see([0.0, 4.0, 0.0], [0.0, 2.0, 0.0]), [0.0; 3]);
        assert!(near(see([0.0; 3], [5.0, 0.0, 0.0]), [2.0, 1.0, 0.5]));
        assert!(near(see([0.0; 3], [-5.0, 0.0, 0.0]), [2.0, 1.0, 0.5]));
        assert!(near(see([0.3, 0.0, 0.0], [0.3, -2.0, 0.0]), [1.0, 0.5, 0.25]));
    }
}

/// The parts of a floor, the four kinds of light above it with or without a body, and a glass pane
/// far below that makes shadow rays look for more than the first thing in their way.
macro_rules! with_bodies {
    ($a:ident, $bodies:expr, $filtered:expr, $x:expr) => {{
        const CORNERS: [Point; 5] = [
            [2.6, 1.0, 0.0],
            [2.2, 1.0, 0.6],
            [1.5, 1.0, 0.35],
            [1.5, 1.0, -0.35],
            [2.2, 1.0, -0.6],
        ];
        let bodies: bool = $bodies;
        let plain = MaterialSpec { diffuse: [1.0; 3], ..MaterialSpec::BLACK };
        let shadow = if $filtered { Shadow::Filtered } else { Shadow::Opaque };
        let materials = [
            Material::<$a>::new(MaterialSpec { shadow, ..plain }),
            Material::<$a>::new(MaterialSpec { emission: [1.0; 3], ..MaterialSpec::BLACK }),
        ];
        let spheres = [Sphere::<$a>::new([-2.0, 1.2, 0.0], 0.5, 1)];
        let polygons = [Polygon::<$a>::new(&CORNERS, 0, 1)];
        let discs = [Disc::<$a>::new([0.0, 1.5, 2.0], [0.1, -1.0, -0.2], 0.5, 1)];
        let edges = Polygon::<$a>::edges(&CORNERS);
        let fan: [FanCorner<$a>; 4] = AreaLight::<$a>::fan(&CORNERS);
        let with = |area, body| {
            let body = bodies.then_some(body);
            AreaLight::<$a>::new(AreaLightSpec { body, ..spec(area, SIXTY_FOUR) })
        };
        let lights = [
            with(Area::Sphere { center: [-2.0, 1.2, 0.0], radius: 0.5 }, 0),
            with(Area::Polygon { corners: &CORNERS, first: 0 }, 1),
            with(Area::Disc { center: [0.0, 1.5, 2.0], normal: [0.1, -1.0, -0.2], radius: 0.5 }, 2),
        ];
        let planes = [Plane::<$a>::new(UP, 0.0, 0)];
        let mut parts = Parts::<$a> {
            planes: &planes,
            materials: &materials,
            area_lights: &lights,
            light_corners: &fan,
            light_jitter: Some(5),
            ..Parts::EMPTY
        };
        if bodies {
            parts = Parts {
                spheres: &spheres,
                polygons: &polygons,
                edges: &edges,
                discs: &discs,
                ..parts
            };
        }
        let scene = Scene::<$a>::checked(parts);
        let x: Point = $x;
        radiance(&scene, 1, [x[0], 0.4, x[2]], DOWN)[0]
    }};
}

in_each_arithmetic! {
    // a light's body doesn't stand in the way of its own light, however grazing; but it does in
    // another's
    no_light_is_in_its_own_way: {
        let same = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-3;
        for filtered in [false, true] {
            for i in 0..12 {
                for j in 0..9 {
                    let x = [f64::from(i) * 0.31 - 1.7, 0.0, f64::from(j) * 0.29 - 1.2];
                    let dark = with_bodies!(A, true, filtered, x);
                    let light = with_bodies!(A, false, filtered, x);
                    assert!(same(dark, light), "{x:?}, {filtered}: {dark} {light}");
                }
            }
            // from far outside the one body hides the other's light
            let x = [-10.0, 0.0, -8.0];
            let (dark, light) =
                (with_bodies!(A, true, filtered, x), with_bodies!(A, false, filtered, x));
            assert!(dark < light * 0.999, "{dark} {light}");
        }
    }
}

in_each_arithmetic! {
    // a mirror shows a light that can be seen: no highlight stands for it there. It does on what
    // doesn't mirror, of a light that can't be seen, and of another light
    no_highlight_of_what_is_mirrored: {
        let disc = Area::Disc { center: [0.0, 1.0, 0.0], normal: DOWN, radius: 0.3 };
        let shown = |specular: f64, reflection: f64, body: Option<u32>, other: bool| {
            let polished = MaterialSpec {
                diffuse: [0.25; 3],
                specular: [specular; 3],
                shininess: 10.0,
                reflection: [reflection; 3],
                ..MaterialSpec::BLACK
            };
            let glow = MaterialSpec { emission: [1.0; 3], ..MaterialSpec::BLACK };
            let lights = [AreaLight::<A>::new(AreaLightSpec { body, ..spec(disc, SIXTY_FOUR) })];
            let points = [Light::<A>::point([0.5, 1.0, 0.0], [0.5; 3])];
            let planes = [Plane::<A>::new(UP, 0.0, 0)];
            let discs = [Disc::<A>::new([0.0, 1.0, 0.0], DOWN, 0.3, 1)];
            let materials = [Material::<A>::new(polished), Material::<A>::new(glow)];
            let scene = Scene::<A>::checked(Parts {
                planes: &planes,
                discs: &discs,
                materials: &materials,
                lights: if other { &points } else { &[] },
                area_lights: &lights,
                ..Parts::EMPTY
            });
            // the rays of a depth of 1 mirror nothing
            radiance(&scene, 1, [0.0, 0.5, 0.0], DOWN)[0]
        };
        for reflection in [0.0, 0.5] {
            for body in [None, Some(0)] {
                let mirrored = reflection > 0.0 && body.is_some();
                let matt = shown(0.0, reflection, body, false);
                let glossy = shown(0.5, reflection, body, false);
                assert!(matt > 0.01);
                assert_eq!(glossy == matt, mirrored, "{reflection} {body:?}: {glossy} {matt}");
                // the point light's own highlight is there in any case
                let of_point = shown(0.5, reflection, body, true) - shown(0.0, reflection, body, true);
                assert!(of_point - (glossy - matt) > 0.01, "{reflection} {body:?}: {of_point}");
            }
        }
    }
}

//! Endless planes where fixed point's positions end: what is seen, and what is lit, beyond 1024 units.

use crate::arithmetics::in_each_arithmetic;
use crate::common::radiance;
use whitted::scene::{
    Background, Falloff, Light, LightSpec, Material, MaterialSpec, Parts, Rules, Scene, Shadow,
};
use whitted::shape::{Plane, Sphere};

const UP: [f64; 3] = [0.0, 1.0, 0.0];

/// Materials that glow in one channel each, and a mirror.
macro_rules! materials {
    ($a:ty) => {
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
            .map(|emission| Material::<$a>::new(MaterialSpec { emission, ..MaterialSpec::BLACK }))
            .into_iter()
            .chain([Material::<$a>::new(MaterialSpec {
                reflection: [1.0; 3],
                ..MaterialSpec::BLACK
            })])
            .collect::<Vec<_>>()
    };
}

in_each_arithmetic! {
    // The floors are met 2,000 and 3,000 units away, the sphere at 900, the sky nowhere.
    the_nearer_of_two_far_planes: {
        let planes = |first: f64, second: f64| {
            [Plane::<A>::new(UP, first, 0), Plane::<A>::new(UP, second, 1)]
        };
        let materials = materials!(A);
        let spheres = [Sphere::<A>::new([0.0, -0.9, 900.0], 0.5, 2)];
        let seen = |planes: &[Plane<A>], spheres: &[Sphere<A>], down: f64| {
            let parts = Parts::<A> { planes, materials: &materials, spheres, ..Parts::EMPTY };
            radiance(&Scene::<A>::checked(parts), 1, [0.0; 3], [0.0, -down, 1.0])
        };
        assert_eq!(seen(&planes(-2.0, -3.0), &[], 0.001), [1.0, 0.0, 0.0]);
        assert_eq!(seen(&planes(-3.0, -2.0), &[], 0.001), [0.0, 1.0, 0.0]);
        assert_eq!(seen(&planes(-3.0, -2.0), &spheres, 0.001), [0.0, 0.0, 1.0]);
        // One within the range, the other beyond it; and nothing above the horizon.
        assert_eq!(seen(&planes(-3.0, -1.0), &[], 0.002), [0.0, 1.0, 0.0]);
        assert_eq!(seen(&planes(-1.0, -2.0), &[], -0.0001), [0.0; 3]);
    }

    // Down to a floor 4,000 units away, and up from there past everything.
    mirrors_to_the_sky: {
        let parts = Parts::<A> {
            planes: &[Plane::<A>::new(UP, -2.0, 3)],
            materials: &materials!(A),
            background: Background::<A>::uniform([0.25, 0.5, 0.75]),
            rules: Rules::WHITTED,
            ..Parts::EMPTY
        };
        let got = radiance(&Scene::<A>::checked(parts), 3, [0.0; 3], [0.0, -0.0005, 1.0]);
        assert_eq!(got, [0.25, 0.5, 0.75]);
    }

    // A point 1,000 units away; the light stands 2,000 units from there, below or above a ceiling that
    // the shadow ray would meet 300 units behind it or before it.
    a_plane_beyond_the_light_casts_no_shadow: {
        let materials = [Material::<A>::new(MaterialSpec {
            diffuse: [1.0; 3],
            ..MaterialSpec::BLACK
        })];
        let glass = [materials[0], Material::<A>::new(MaterialSpec {
            transmission: [0.5; 3],
            shadow: Shadow::Filtered,
            ..MaterialSpec::BLACK
        })];
        let lit = |ceiling: f64, glassy: bool| {
            let material = u16::from(glassy);
            let planes = [Plane::<A>::new(UP, 0.0, 0), Plane::<A>::new(UP, ceiling, material)];
            let parts = Parts::<A> {
                planes: &planes,
                materials: if glassy { &glass } else { &materials },
                lights: &[Light::<A>::new(LightSpec::Point {
                    position: [0.0, 400.0, -1000.0],
                    intensity: [1.0; 3],
                    falloff: Falloff::None,
                })],
                ..Parts::EMPTY
            };
            radiance(&Scene::<A>::checked(parts), 1, [0.0, 10.0, 970.0], [0.0, -0.3, 0.95])[0]
        };
        let open = lit(900.0, false);
        assert!((open - 0.1966).abs() < 0.001, "{open}");
        assert_eq!(lit(460.0, false), open);
        assert_eq!(lit(460.0, true), open);
        assert_eq!(lit(340.0, false), 0.0);
        let through = lit(340.0, true);
        assert!((through - open / 2.0).abs() < 0.001, "{through}");
    }

    // The light comes from a thousandth below the level: the floor is in its way 2,000 units off.
    the_sun_below_the_horizon: {
        let materials = [Material::<A>::new(MaterialSpec {
            diffuse: [1.0; 3],
            ..MaterialSpec::BLACK
        })];
        let lit = |up: f64| {
            let parts = Parts::<A> {
                spheres: &[Sphere::<A>::new([0.0, 2.0, 0.0], 1.0, 0)],
                planes: &[Plane::<A>::new(UP, 0.0, 0)],
                materials: &materials,
                lights: &[Light::<A>::new(LightSpec::Directional {
                    direction: [0.0, -up, 1.0],
                    intensity: [1.0; 3],
                })],
                ..Parts::EMPTY
            };
            radiance(&Scene::<A>::checked(parts), 1, [0.0, 2.0, -5.0], [0.0, 0.0, 1.0])[0]
        };
        assert_eq!(lit(-0.001), 0.0);
        assert!(lit(0.001) > 0.99);
    }
}

//! Facts about the shading model, each computed by hand, in all three arithmetics.

use crate::arithmetics::in_each_arithmetic;
use crate::common::{close, radiance, toward};
use whitted::scene::{
    Ambient, Background, Falloff, Light, LightSpec, Material, MaterialSpec, Parts, PatternSpec,
    Rules, Scene, Shadow,
};
use whitted::shape::{Plane, Sphere};

const DOWN: [f64; 3] = [0.0, -1.0, 0.0];

in_each_arithmetic! { 4e-4;
    // E = I/r²·cos at a height of 2 and 1.5 to the side: r² = 6.25, cos = 0.8
    lambert: |tol| {
        let parts = Parts::<A> {
            planes: &[Plane::<A>::new([0.0, 1.0, 0.0], 0.0, 0)],
            materials: &[Material::<A>::new(MaterialSpec {
                diffuse: [0.5, 0.25, 1.0],
                ..MaterialSpec::BLACK
            })],
            lights: &[Light::<A>::point([1.5, 2.0, 0.0], [10.0, 5.0, 1.0])],
            ..Parts::EMPTY
        };
        let scene = Scene::<A>::checked(parts);
        let got = radiance(&scene, 5, [0.0, 3.0, 0.0], DOWN);
        let e = 0.8 / 6.25;
        close::<A>(got, [5.0 * e, 1.25 * e, e], tol);
    }

    // The mirror direction of the light is (−0.6, 0.8): seen at (0.6, 0.8) from the normal its
    // cosine with the view straight down is 0.8
    phong: |tol| {
        let lights = [Light::<A>::new(LightSpec::Directional {
            direction: [0.6, -0.8, 0.0],
            intensity: [1.0; 3],
        })];
        let materials = [Material::<A>::new(MaterialSpec {
            diffuse: [0.2; 3],
            specular: [0.5, 1.0, 2.0],
            shininess: 10.0,
            ..MaterialSpec::BLACK
        })];
        let parts = Parts {
            planes: &[Plane::<A>::new([0.0, 1.0, 0.0], 0.0, 0)],
            materials: &materials,
            lights: &lights,
            ..Parts::EMPTY
        };
        let lobe = 0.8f64.powi(10);
        let exact = |k: f64| (0.2 + k * lobe) * 0.8;
        let got = radiance(&Scene::<A>::checked(parts), 5, [0.0, 3.0, 0.0], DOWN);
        close::<A>(got, [exact(0.5), exact(1.0), exact(2.0)], tol);
        // Whitted's highlight has no cosine of its own
        let parts = Parts { rules: Rules::WHITTED, ..parts };
        let exact = |k: f64| 0.2 * 0.8 + k * lobe;
        let got = radiance(&Scene::<A>::checked(parts), 5, [0.0, 3.0, 0.0], DOWN);
        close::<A>(got, [exact(0.5), exact(1.0), exact(2.0)], tol);
    }

    // Light from below a two-sided sheet doesn't light its upper side, light from above does
    two_sides: |tol| {
        let light = |y| Light::<A>::new(LightSpec::Point {
            position: [0.0, y, 0.0],
            intensity: [0.5; 3],
            falloff: Falloff::None,
        });
        let lights = [light(1.0), light(-1.0)];
        let parts = Parts::<A> {
            planes: &[Plane::<A>::new([0.0, -1.0, 0.0], 0.0, 0)],
            materials: &[Material::<A>::new(MaterialSpec {
                diffuse: [1.0; 3],
                ..MaterialSpec::BLACK
            })],
            lights: &lights,
            ..Parts::EMPTY
        };
        let scene = Scene::<A>::checked(parts);
        close::<A>(radiance(&scene, 5, [0.0, 3.0, 0.0], DOWN), [0.5; 3], tol);
        close::<A>(radiance(&scene, 5, [0.0, -3.0, 0.0], [0.0, 1.0, 0.0]), [0.5; 3], tol);
    }

    // k_amb·E_amb, and a background along both ends of a gradient
    ambient_and_background: |tol| {
        let parts = Parts::<A> {
            planes: &[Plane::<A>::new([0.0, 1.0, 0.0], 0.0, 0)],
            materials: &[Material::<A>::new(MaterialSpec {
                ambient: [0.5, 0.25, 0.125],
                ..MaterialSpec::BLACK
            })],
            ambient: Ambient::<A>::new([0.5, 2.0, 4.0]),
            background: Background::<A>::gradient([0.0, 2.0, 0.0], [0.0; 3], [1.0, 0.5, 3.0]),
            ..Parts::EMPTY
        };
        let scene = Scene::<A>::checked(parts);
        close::<A>(radiance(&scene, 5, [0.0, 3.0, 0.0], DOWN), [0.25, 0.5, 0.5], tol);
        close::<A>(radiance(&scene, 5, [0.0, 3.0, 0.0], [0.0, 1.0, 0.0]), [1.0, 0.5, 3.0], tol);
        close::<A>(radiance(&scene, 5, [0.0, 3.0, 0.0], [1.0, 0.0, 0.0]), [0.5, 0.25, 1.5], tol);
    }

    // A mirror at 60°: the specular cosine is ½, and depth 1 sends no ray
    mirror: |tol| {
        let materials = [Material::<A>::new(MaterialSpec {
            reflection: [0.8, 0.4, 0.2],
            ..MaterialSpec::BLACK
        })];
        let parts = Parts {
            planes: &[Plane::<A>::new([0.0, 1.0, 0.0], 0.0, 0)],
            materials: &materials,
            background: Background::<A>::uniform([1.0, 0.5, 0.25]),
            ..Parts::EMPTY
        };
        let d = [0.75f64.sqrt(), -0.5, 0.0];
        let scene = Scene::<A>::checked(parts);
        close::<A>(radiance(&scene, 5, [0.0, 1.0, 0.0], d), [0.4, 0.1, 0.025], tol);
        close::<A>(radiance(&scene, 1, [0.0, 1.0, 0.0], d), [0.0; 3], tol);
        let scene = Scene::<A>::checked(Parts { rules: Rules::WHITTED, ..parts });
        close::<A>(radiance(&scene, 5, [0.0, 1.0, 0.0], d), [0.8, 0.2, 0.05], tol);
    }

    // Two parallel mirrors: each generation multiplies by 0.5 until the depth ends it; the
    // cut-off ends it earlier
    depth_and_cutoff: |tol| {
        let materials = [Material::<A>::new(MaterialSpec {
            ambient: [1.0; 3],
            reflection: [0.5; 3],
            ..MaterialSpec::BLACK
        })];
        let planes = [
            Plane::<A>::new([0.0, 1.0, 0.0], 0.0, 0),
            Plane::<A>::new([0.0, 1.0, 0.0], 4.0, 0),
        ];
        let parts = Parts {
            planes: &planes,
            materials: &materials,
            ambient: Ambient::<A>::new([1.0; 3]),
            rules: Rules::NFF,
            ..Parts::EMPTY
        };
        let scene = Scene::<A>::checked(parts);
        for depth in 1..=8u8 {
            let exact = 2.0 - 0.5f64.powi(i32::from(depth) - 1);
            close::<A>(radiance(&scene, depth, [0.0, 1.0, 0.0], DOWN), [exact; 3], tol);
        }
        // 2⁻⁷ ≥ 1/255 > 2⁻⁸: all eight generations pass; 1/100 stops after 2⁻⁶
        let cutoff = crate::common::weight::<A>(0.01);
        let scene = Scene::<A>::checked(Parts { rules: Rules { cutoff, ..parts.rules }, ..parts });
        close::<A>(radiance(&scene, 8, [0.0, 1.0, 0.0], DOWN), [2.0 - 0.5f64.powi(6); 3], tol);
    }

    // A ray through the middle of a glass ball goes straight: two surfaces, k_tg each
    glass: |tol| {
        let parts = Parts::<A> {
            spheres: &[Sphere::<A>::new([0.0, 0.0, 3.0], 1.0, 0)],
            materials: &[Material::<A>::new(MaterialSpec {
                transmission: [0.9, 0.5, 0.1],
                index_behind: 1.5,
                ..MaterialSpec::BLACK
            })],
            background: Background::<A>::gradient([0.0, 0.0, 1.0], [0.0; 3], [1.0; 3]),
            ..Parts::EMPTY
        };
        let scene = Scene::<A>::checked(parts);
        let got = radiance(&scene, 5, [0.0; 3], [0.0, 0.0, 1.0]);
        close::<A>(got, [0.81, 0.25, 0.01], 2.0 * tol);
    }

    // Total reflection inside: the mirror ray carries k_sg + k_tg, or k_sg alone if lossy
    total_reflection: |tol| {
        let materials = [Material::<A>::new(MaterialSpec {
            reflection: [0.25; 3],
            transmission: [0.5; 3],
            index_behind: 1.5,
            ..MaterialSpec::BLACK
        })];
        let parts = Parts {
            // glass below y = 0; the critical angle is 41.8°, the ray meets it at 60°
            planes: &[Plane::<A>::new([0.0, 1.0, 0.0], 0.0, 0)],
            materials: &materials,
            background: Background::<A>::uniform([1.0; 3]),
            rules: Rules::WHITTED,
            ..Parts::EMPTY
        };
        let d = [0.75f64.sqrt(), 0.5, 0.0];
        let scene = Scene::<A>::checked(parts);
        close::<A>(radiance(&scene, 5, [0.0, -1.0, 0.0], d), [0.75; 3], tol);
        let lossy = Rules { lossy: true, ..parts.rules };
        let scene = Scene::<A>::checked(Parts { rules: lossy, ..parts });
        close::<A>(radiance(&scene, 5, [0.0, -1.0, 0.0], d), [0.25; 3], tol);
    }

    // Water (1.33) inside glass (1.5): at 40° in the glass it is 46.3° in the water
    water_in_glass: |tol| {
        let parts = Parts::<A> {
            planes: &[Plane::<A>::new([0.0, 1.0, 0.0], 0.0, 0)],
            materials: &[Material::<A>::new(MaterialSpec {
                transmission: [1.0; 3],
                index_front: 1.5,
                index_behind: 1.33,
                ..MaterialSpec::BLACK
            })],
            // what comes back tells the vertical component of the transmitted direction
            background: Background::<A>::gradient(DOWN, [0.0; 3], [1.0; 3]),
            rules: Rules::WHITTED,
            ..Parts::EMPTY
        };
        let scene = Scene::<A>::checked(parts);
        let angle = 40f64.to_radians();
        let got = radiance(&scene, 5, [0.0, 1.0, 0.0], [angle.sin(), -angle.cos(), 0.0]);
        let cos_t = (1.0 - (1.5 / 1.33 * angle.sin()).powi(2)).sqrt();
        assert!((cos_t.acos().to_degrees() - 46.3).abs() < 0.2);
        close::<A>(got, [(1.0 + cos_t) / 2.0; 3], tol);
    }

    // A ball between a lit plane and its light: opaque, filtered (two surfaces), none
    shadows: |tol| {
        for (shadow, share) in [
            (Shadow::Opaque, [0.0; 3]),
            (Shadow::Filtered, [0.25, 0.01, 1.0]),
            (Shadow::None, [1.0; 3]),
        ] {
            let ball = Material::<A>::new(MaterialSpec {
                transmission: [0.5, 0.1, 1.0],
                index_behind: 1.5,
                shadow,
                ..MaterialSpec::BLACK
            });
            let floor = Material::<A>::new(MaterialSpec {
                diffuse: [1.0; 3],
                ..MaterialSpec::BLACK
            });
            let materials = [ball, floor];
            let lights = [Light::<A>::new(LightSpec::Point {
                position: [0.0, 10.0, 0.0],
                intensity: [1.0; 3],
                falloff: Falloff::None,
            })];
            let parts = Parts::<A> {
                spheres: &[Sphere::<A>::new([0.0, 3.0, 0.0], 1.0, 0)],
                planes: &[Plane::<A>::new([0.0, 1.0, 0.0], 0.0, 1)],
                materials: &materials,
                lights: &lights,
                ..Parts::EMPTY
            };
            let scene = Scene::<A>::checked(parts);
            // from the side, towards the point under the ball
            let (eye, d) = toward([2.0, 1.0, 0.0], [0.0, 0.0, 0.0]);
            close::<A>(radiance(&scene, 5, eye, d), share, 2.0 * tol);
        }
    }

    // Cells of 2 along x and z, y ignored; −0.5 lies in an odd cell of x
    checker: |tol| {
        let materials = [
            Material::<A>::new(MaterialSpec {
                ambient: [1.0; 3],
                pattern: Some(PatternSpec { cell: [2.0, 0.0, 2.0], offset: [0.0; 3], other: 1 }),
                ..MaterialSpec::BLACK
            }),
            Material::<A>::new(MaterialSpec { ambient: [0.25; 3], ..MaterialSpec::BLACK }),
        ];
        let parts = Parts::<A> {
            planes: &[Plane::<A>::new([0.0, 1.0, 0.0], 0.0, 0)],
            materials: &materials,
            ambient: Ambient::<A>::new([1.0; 3]),
            ..Parts::EMPTY
        };
        let scene = Scene::<A>::checked(parts);
        for (x, z, value) in [(0.5, 0.5, 1.0), (-0.5, 0.5, 0.25), (-0.5, -1.5, 1.0), (2.5, 0.5, 0.25), (2.5, 2.5, 1.0)] {
            close::<A>(radiance(&scene, 5, [x, 3.0, z], DOWN), [value; 3], tol);
        }
    }

    // Full light within the inner cone, half of it halfway between the cosines, none outside
    spot: |tol| {
        let spot = |falloff| LightSpec::Spot {
            position: [0.0, 4.0, 0.0],
            direction: DOWN,
            intensity: [16.0; 3],
            falloff,
            cos_inner: 0.9,
            cos_outer: 0.7,
        };
        let lights = [Light::<A>::new(spot(Falloff::None))];
        let parts = Parts::<A> {
            planes: &[Plane::<A>::new([0.0, 1.0, 0.0], 0.0, 0)],
            materials: &[Material::<A>::new(MaterialSpec {
                diffuse: [1.0; 3],
                ..MaterialSpec::BLACK
            })],
            lights: &lights,
            ..Parts::EMPTY
        };
        let scene = Scene::<A>::checked(parts);
        let at = |cos: f64| 4.0 * (1.0 / cos / cos - 1.0).sqrt();
        for (cos, share) in [(1.0, 1.0), (0.95, 1.0), (0.8, 0.5), (0.75, 0.15625), (0.65, 0.0)] {
            let got = radiance(&scene, 5, [at(cos), 3.0, 0.0], DOWN);
            close::<A>(got, [16.0 * cos * share; 3], 16.0 * 2.0 * tol);
        }
    }
}

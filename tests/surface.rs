//! Facts about surface detail, each by hand, in all three arithmetics: textures, bumps, Fresnel's
//! weights, absorption.

use crate::arithmetics::in_each_arithmetic;
use crate::common::{close, radiance};
use whitted::math::{Arithmetic, Fixed};
use whitted::scene::{
    Absorption, Ambient, Background, Filter, Image, Light, LightSpec, Mapping, Material,
    MaterialSpec, Parts, Pattern, Rules, Scene, SceneError, Shadow, Texels, Texture, TextureSpec,
    TriangleUv, Wrap,
};
use whitted::shape::{Cuboid, Plane, Sphere, Triangle};

const UP: [f64; 3] = [0.0, 1.0, 0.0];
const DOWN: [f64; 3] = [0.0, -1.0, 0.0];
/// White under all light there is.
pub(super) const WHITE: MaterialSpec =
    MaterialSpec { ambient: [1.0; 3], diffuse: [1.0; 3], ..MaterialSpec::BLACK };
/// Lets all through without bending it.
const CLEAR: MaterialSpec = MaterialSpec { transmission: [1.0; 3], ..MaterialSpec::BLACK };
const GLASS: MaterialSpec = MaterialSpec {
    reflection: [1.0; 3],
    transmission: [1.0; 3],
    index_behind: 1.5,
    fresnel: true,
    ..MaterialSpec::BLACK
};
const TEXELS: Texels<'_> =
    Texels::Indexed { bits: 2, palette: &[[0; 3], [255, 0, 0], [255; 3], [0, 0, 255]] };
/// Above: red, white, blue; below: black, red, white.
pub(super) const FLAG: Image<'_> = Image::new(3, 2, TEXELS, &[0b0110_1100, 0b0001_1000]);

in_each_arithmetic! { 6e-4;
    // exp(−a·d) of three rates over a slab of 2, seen against white.
    a_slab: |tol| {
        let parts = Parts::<A> {
            cuboids: &[Cuboid::<A>::new([-1.0, -1.0, 2.0], [1.0, 1.0, 4.0], 0)],
            materials: &[Material::<A>::new(MaterialSpec { absorption: Some(0), ..CLEAR })],
            absorptions: &[Absorption::<A>::new([0.0; 3], [0.1, 0.5, 2.0])],
            background: Background::<A>::uniform([1.0; 3]),
            rules: Rules { cutoff: A::NO_WEIGHT, ..Rules::WHITTED },
            ..Parts::EMPTY
        };
        let scene = Scene::<A>::checked(parts);
        let got = radiance::<A>(&scene, 4, [0.3, 0.2, 0.0], [0.0, 0.0, 1.0]);
        close::<A>(got, [0.1f64, 0.5, 2.0].map(|a| (-2.0 * a).exp()), tol);
        // What starts inside has half the way.
        let got = radiance::<A>(&scene, 4, [0.3, 0.2, 3.0], [0.0, 0.0, 1.0]);
        close::<A>(got, [0.1f64, 0.5, 2.0].map(|a| (-a).exp()), tol);
    }

    // A core of a second medium: before its surface lies the first.
    a_body_within_a_body: |tol| {
        let parts = Parts::<A> {
            cuboids: &[
                Cuboid::<A>::new([-1.0, -1.0, 2.0], [1.0, 1.0, 6.0], 0),
                Cuboid::<A>::new([-0.9, -0.9, 3.0], [0.9, 0.9, 4.5], 1),
            ],
            materials: &[
                Material::<A>::new(MaterialSpec { absorption: Some(0), ..CLEAR }),
                Material::<A>::new(MaterialSpec { absorption: Some(1), ..CLEAR }),
            ],
            absorptions: &[
                Absorption::<A>::new([0.0; 3], [0.2, 0.0, 0.4]),
                Absorption::<A>::new([0.2, 0.0, 0.4], [0.0, 0.3, 0.1]),
            ],
            background: Background::<A>::uniform([1.0; 3]),
            rules: Rules { cutoff: A::NO_WEIGHT, ..Rules::WHITTED },
            ..Parts::EMPTY
        };
        let scene = Scene::<A>::checked(parts);
        let got = radiance::<A>(&scene, 6, [0.3, 0.2, 0.0], [0.0, 0.0, 1.0]);
        let exact = [0.2 * 2.5, 0.3 * 1.5, 0.4 * 2.5 + 0.1 * 1.5].map(|x: f64| (-x).exp());
        close::<A>(got, exact, tol);
    }

    // A light straight above a pane of thickness 0.5: what gets through is dimmed once.
    a_filtered_shadow: |tol| {
        let pane = MaterialSpec {
            transmission: [0.9; 3],
            shadow: Shadow::Filtered,
            absorption: Some(0),
            ..CLEAR
        };
        let parts = Parts::<A> {
            cuboids: &[Cuboid::<A>::new([-1.0, 1.0, -1.0], [1.0, 1.5, 1.0], 1)],
            planes: &[Plane::<A>::new(UP, 0.0, 0)],
            materials: &[Material::<A>::new(WHITE), Material::<A>::new(pane)],
            absorptions: &[Absorption::<A>::new([0.0; 3], [0.5, 1.0, 0.0])],
            lights: &[Light::<A>::new(LightSpec::Directional {
                direction: DOWN,
                intensity: [0.5; 3],
            })],
            ..Parts::EMPTY
        };
        let scene = Scene::<A>::checked(parts);
        let got = radiance::<A>(&scene, 1, [0.5, 0.5, 0.0], DOWN);
        let pane = 0.5 * 0.9 * 0.9;
        close::<A>(got, [pane * (-0.25f64).exp(), pane * (-0.5f64).exp(), pane], tol);
    }

    // A surface of glass with white above and black below: what it reflects of it.
    fresnels_weights: |tol| {
        let parts = Parts::<A> {
            planes: &[Plane::<A>::new(UP, 0.0, 0)],
            materials: &[Material::<A>::new(GLASS)],
            background: Background::<A>::gradient(UP, [0.0; 3], [1.0; 3]),
            rules: Rules { cutoff: A::NO_WEIGHT, ..Rules::WHITTED },
            ..Parts::EMPTY
        };
        let scene = Scene::<A>::checked(parts);
        for degrees in [0.0f64, 30.0, 56.31, 70.0, 85.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let cos_t = (1.0 - sin * sin / 2.25).sqrt();
            let s = (cos - 1.5 * cos_t) / (cos + 1.5 * cos_t);
            let p = (1.5 * cos - cos_t) / (1.5 * cos + cos_t);
            let f = 0.5 * (s * s + p * p);
            // The sky towards (sin, cos) and (sin/1.5, −cos_t).
            let exact = f * (1.0 + cos) / 2.0 + (1.0 - f) * (1.0 - cos_t) / 2.0;
            let got = radiance::<A>(&scene, 3, [0.0, 1.0, 0.0], [sin, -cos, 0.0]);
            close::<A>(got, [exact; 3], 2.0 * tol);
            if degrees == 0.0 {
                close::<A>(got, [0.04; 3], 2.0 * tol);
            }
        }
    }

    // What isn't reflected is let through: a white world stays white, from both sides, and beyond the
    // angle of total reflection (41.8 degrees).
    nothing_is_lost: |tol| {
        let parts = Parts::<A> {
            planes: &[Plane::<A>::new(UP, 0.0, 0)],
            materials: &[Material::<A>::new(GLASS)],
            background: Background::<A>::uniform([1.0; 3]),
            rules: Rules { cutoff: A::NO_WEIGHT, ..Rules::WHITTED },
            ..Parts::EMPTY
        };
        let scene = Scene::<A>::checked(parts);
        for degrees in [0.0f64, 20.0, 41.0, 42.5, 60.0, 80.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let got = radiance::<A>(&scene, 3, [0.0, 1.0, 0.0], [sin, -cos, 0.0]);
            close::<A>(got, [1.0; 3], tol);
            let got = radiance::<A>(&scene, 3, [0.0, -1.0, 0.0], [sin, cos, 0.0]);
            close::<A>(got, [1.0; 3], tol);
        }
    }

    // A picture of 3×2 on a square of 3×2: each pixel where it belongs, upright from the front.
    a_picture: |tol| {
        let spec =
            TextureSpec { size: [3.0, 2.0, 0.0], ..TextureSpec::of(Pattern::Image(FLAG)) };
        let parts = Parts::<A> {
            planes: &[Plane::<A>::new([0.0, 0.0, 1.0], 0.0, 0)],
            materials: &[Material::<A>::new(MaterialSpec { texture: Some(0), ..WHITE })],
            textures: &[Texture::<A>::new(spec)],
            ambient: Ambient::<A>::new([0.5; 3]),
            ..Parts::EMPTY
        };
        let scene = Scene::<A>::checked(parts);
        let at = |x, y| radiance::<A>(&scene, 1, [x, y, 2.0], [0.0, 0.0, -1.0]);
        let (red, blue) = ([0.5, 0.0, 0.0], [0.0, 0.0, 0.5]);
        // The brightest is 65535/65536.
        let tol = tol + 1e-5;
        close::<A>(at(0.5, 1.5), red, tol);
        close::<A>(at(1.5, 1.5), [0.5; 3], tol);
        close::<A>(at(2.5, 1.5), blue, tol);
        close::<A>(at(0.5, 0.5), [0.0; 3], tol);
        close::<A>(at(1.5, 0.5), red, tol);
        close::<A>(at(5.5, -1.5), [0.5; 3], tol);
    }

    // The same by the coordinates of a triangle, of which another stands before it in the list.
    a_picture_on_a_mesh: |tol| {
        let far = [[90.0, 0.0, 0.0], [91.0, 0.0, 0.0], [90.0, 1.0, 0.0]];
        let near = [[0.0, 0.0, 0.0], [6.0, 0.0, 0.0], [0.0, 6.0, 0.0]];
        let texture = TextureSpec {
            mapping: Mapping::Uv,
            ..TextureSpec::of(Pattern::Image(FLAG.with_filter(Filter::Bilinear)))
        };
        let parts = Parts::<A> {
            spheres: &[Sphere::<A>::new([90.0; 3], 1.0, 0)],
            triangles: &[Triangle::<A>::new(far, 0), Triangle::<A>::new(near, 0)],
            uvs: &[
                TriangleUv::new([[0.0; 2]; 3]),
                TriangleUv::new([[0.0, 0.0], [2.0, 0.0], [0.0, 3.0]]),
            ],
            materials: &[Material::<A>::new(MaterialSpec { texture: Some(0), ..WHITE })],
            textures: &[Texture::<A>::new(texture)],
            ambient: Ambient::<A>::new([1.0; 3]),
            ..Parts::EMPTY
        };
        let scene = Scene::<A>::checked(parts);
        let at = |x, y| radiance::<A>(&scene, 1, [x, y, 2.0], [0.0, 0.0, -1.0]);
        // u = x/3 and v = y/2: the pixels' centres, and halfway between the two white ones' neighbours.
        let tol = f64::max(tol, 1e-4) * 8.0;
        close::<A>(at(0.5, 1.5), [1.0, 0.0, 0.0], tol);
        close::<A>(at(1.5, 1.5), [1.0; 3], tol);
        close::<A>(at(1.0, 1.5), [1.0, 0.5, 0.5], tol);
        close::<A>(at(3.5, 0.5), [0.0; 3], tol);
    }

    // Where the pattern is ½ and more the other material shows, with the colours of its own texture.
    another_material: |tol| {
        let stripes = TextureSpec {
            other: Some(1),
            ..TextureSpec::of(Pattern::Stripes { width: 0.25 })
        };
        let tint = TextureSpec {
            colors: [[0.5; 3], [1.0; 3]],
            ..TextureSpec::of(Pattern::Checker)
        };
        let other = MaterialSpec { ambient: [0.0, 1.0, 0.0], texture: Some(1), ..WHITE };
        let parts = Parts::<A> {
            planes: &[Plane::<A>::new([0.0, 0.0, 1.0], 0.25, 0)],
            materials: &[
                Material::<A>::new(MaterialSpec { texture: Some(0), ..WHITE }),
                Material::<A>::new(other),
            ],
            textures: &[Texture::<A>::new(stripes), Texture::<A>::new(tint)],
            ambient: Ambient::<A>::new([1.0; 3]),
            ..Parts::EMPTY
        };
        let scene = Scene::<A>::checked(parts);
        let at = |x| radiance::<A>(&scene, 1, [x, 0.5, 2.0], [0.0, 0.0, -1.0]);
        close::<A>(at(0.1), [1.0; 3], tol);
        close::<A>(at(0.6), [0.0, 0.5, 0.0], tol);
        close::<A>(at(1.1), [1.0; 3], tol);
        close::<A>(at(1.6), [0.0, 1.0, 0.0], tol);
    }

    // A ramp of slope ½ in a floor: lit from above it gets cos = 1/√1.25, mirrors to where twice the
    // angle goes, and sees no light from below.
    a_bump: |tol| {
        let ramp = TextureSpec {
            height: 0.5,
            ..TextureSpec::of(Pattern::Gradient { wrap: Wrap::Repeat })
        };
        let bumped = MaterialSpec { bump: Some(0), reflection: [1.0; 3], ..WHITE };
        let parts = Parts::<A> {
            planes: &[Plane::<A>::new(UP, 0.0, 0)],
            materials: &[Material::<A>::new(MaterialSpec { ambient: [0.0; 3], ..bumped })],
            textures: &[Texture::<A>::new(ramp)],
            lights: &[
                Light::<A>::new(LightSpec::Directional { direction: DOWN, intensity: [0.25; 3] }),
                // 11.3 degrees below the horizon, on the side that the slope faces
                Light::<A>::new(LightSpec::Directional {
                    direction: [1.0, 0.2, 0.0],
                    intensity: [9.0; 3],
                }),
            ],
            background: Background::<A>::gradient(UP, [0.0; 3], [1.0; 3]),
            rules: Rules { specular_cosine: false, ..Rules::COURSE },
            ..Parts::EMPTY
        };
        let scene = Scene::<A>::checked(parts);
        let got = radiance::<A>(&scene, 2, [0.3, 1.0, 0.0], DOWN);
        let cos = 1.0 / 1.25f64.sqrt();
        // cos 2θ = 2cos² − 1 upwards: the sky there
        let sky = (1.0 + 2.0 * cos * cos - 1.0) / 2.0;
        close::<A>(got, [0.25 * cos + sky; 3], 2.0 * tol + 2e-4);
        // Seen at a grazing angle the bent mirror would look into the floor: dropped.
        let got = radiance::<A>(&scene, 2, [0.3 - 4.0, 1.0, 0.0], [4.0, -1.0, 0.0]);
        assert!(got.iter().all(|x| x.is_finite()));
    }

    what_is_not_there: |tol| {
        let _: f64 = tol;
        let of = |spec: MaterialSpec| {
            let materials = [Material::<A>::new(spec)];
            let textures = [Texture::<A>::new(TextureSpec {
                other: Some(7),
                ..TextureSpec::of(Pattern::Checker)
            })];
            let textures = if spec.fresnel { &textures[..] } else { &[] };
            let parts = Parts { materials: &materials, textures, ..Parts::EMPTY };
            Scene::<A>::new(parts).map(|_| ()).unwrap_err()
        };
        let error = of(MaterialSpec { texture: Some(0), ..WHITE });
        assert_eq!(error, SceneError::Texture { index: 0 });
        assert_eq!(error.to_string(), "a material names texture 0, which isn't there");
        let error = of(MaterialSpec { bump: Some(3), ..WHITE });
        assert_eq!(error, SceneError::Texture { index: 3 });
        let error = of(MaterialSpec { absorption: Some(2), ..WHITE });
        assert_eq!(error, SceneError::Absorption { index: 2 });
        assert_eq!(error.to_string(), "a material names absorption 2, which isn't there");
        // A texture that shows another material.
        let error = of(MaterialSpec { fresnel: true, ..WHITE });
        assert_eq!(error, SceneError::Material { index: 7 });
    }
}

/// What materials and their detail cost in flash. Of a plain material's bytes seven are for what it
/// doesn't have: three indices into other lists and a switch.
#[test]
fn bytes_in_flash() {
    assert_eq!(size_of::<Material<Fixed>>(), 140);
    assert!(size_of::<Material<f32>>() <= 140);
    assert_eq!(size_of::<Absorption<Fixed>>(), 24);
    assert_eq!(size_of::<TriangleUv>(), 12);
}

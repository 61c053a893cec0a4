use super::*;
use crate::math::Fixed;
use proptest::prelude::*;
extern crate std;
use std::f64::consts::TAU;

type Length = <Fixed as Arithmetic>::Length;

/// What a texture of grey does in each arithmetic: fixed, single, double.
fn values(spec: TextureSpec<'_>, p: [f64; 3], uv: [f64; 2]) -> [f64; 3] {
    let uv = uv.map(|x| (x * 65536.0) as i32);
    let fixed = Texture::<Fixed>::new(spec).color(&p.map(Length::from_num), uv)[0];
    let single = Texture::<f32>::new(spec).color(&p.map(|x| x as f32), uv)[0];
    [fixed.to_num(), single.into(), Texture::<f64>::new(spec).color(&p, uv)[0]]
}

fn all(spec: TextureSpec<'_>, p: [f64; 3], uv: [f64; 2], expected: f64) {
    for value in values(spec, p, uv) {
        assert!((value - expected).abs() < 4e-3, "{p:?} {uv:?}: {value}, not {expected}");
    }
}

/// From black to white over one cell: shows the first coordinate.
const RAMP: TextureSpec<'_> = TextureSpec {
    colors: [[0.0; 3], [1.0; 3]],
    ..TextureSpec::of(Pattern::Gradient { wrap: Wrap::Repeat })
};

#[test]
fn planar_coordinates() {
    let spec = TextureSpec { origin: [1.0, 2.0, 3.0], size: [4.0, 0.0, 0.0], ..RAMP };
    all(spec, [2.0, 9.0, 9.0], [0.0; 2], 0.25);
    all(spec, [-0.5, 9.0, 9.0], [0.0; 2], 0.625);
    // Turned: the first axis goes up, what of it lies along the second doesn't count.
    let spec = TextureSpec { right: [1.0, 1.0, 0.0], up: [1.0, 0.0, 0.0], ..spec };
    all(spec, [7.0, 3.0, 9.0], [0.0; 2], 0.25);
    // In a slanted direction.
    let spec = TextureSpec { right: [0.6, 0.0, 0.8], ..RAMP };
    all(spec, [0.3, 5.0, 0.4], [0.0; 2], 0.5);
    // The second and the third axis.
    let checker =
        TextureSpec { colors: [[0.25; 3], [1.0; 3]], ..TextureSpec::of(Pattern::Checker) };
    all(checker, [0.5, 0.5, 0.5], [0.0; 2], 0.25);
    all(checker, [0.5, -0.5, 0.5], [0.0; 2], 1.0);
    all(checker, [0.5, -0.5, 1.5], [0.0; 2], 0.25);
    let floor = TextureSpec { size: [1.0, 0.0, 1.0], ..checker };
    all(floor, [0.5, -0.5, 1.5], [0.0; 2], 1.0);
}

/// A floor goes on beyond the range, where coordinates begin again after 65,536 units: a whole number of
/// cells of a power of two.
#[test]
fn beyond_the_range() {
    let spec = TextureSpec { origin: [1000.5, 2.0, -900.25], size: [4.0, 0.0, 4.0], ..RAMP };
    for x in [-32_767.0, -20_001.5, 1_500.25, 16_390.75, 31_999.0, 32_767.5] {
        for turn in [0.0, 2.5] {
            let spec = TextureSpec { right: [turn, 0.0, -1.0], ..spec };
            let p = [x, 2.0, 0.25 - x];
            let exact = Texture::<f64>::new(spec).color(&p, [0; 2])[0];
            let fixed = Texture::<Fixed>::new(spec).color(&p.map(Length::from_num), [0; 2])[0];
            // An axis is known to 2⁻¹⁸; a ramp's end is its beginning.
            let off = (fixed.to_num::<f64>() - exact).rem_euclid(1.0);
            let most = if turn == 0.0 { 1e-3 } else { 0.1 };
            assert!(off.min(1.0 - off) <= most, "{x} {turn}: {fixed}, not {exact}");
        }
    }
    // Around an axis, however far.
    let around =
        TextureSpec { mapping: Mapping::Cylindrical, origin: [0.0; 3], size: [1.0; 3], ..RAMP };
    for far in [3.0, 900.0, 15_000.0, 16_500.0, 32_000.0] {
        all(around, [far, 0.0, -far], [0.0; 2], 0.125);
        all(around, [-far, 0.0, 0.25 * far], [0.0; 2], 0.5 + 0.25f64.atan() / TAU);
    }
}

#[test]
fn around_a_sphere_and_a_cylinder() {
    let origin = [1.0, 1.0, 1.0];
    let sphere = TextureSpec { mapping: Mapping::Spherical, origin, ..RAMP };
    // Seen from the tip of y: from x over −z.
    all(sphere, [1.0, 1.0, 0.0], [0.0; 2], 0.25);
    all(sphere, [-1.0, 1.0, 0.999], [0.0; 2], 0.5);
    all(sphere, [1.0, 1.0, 6.0], [0.0; 2], 0.75);
    let cylinder = TextureSpec { mapping: Mapping::Cylindrical, ..sphere };
    all(cylinder, [1.0, 9.0, 0.0], [0.0; 2], 0.25);
    // Stripes of latitude: the second axis takes the first's place by a checker without the first.
    let spec = TextureSpec {
        size: [0.0, 0.5, 0.0],
        colors: [[0.0; 3], [1.0; 3]],
        ..TextureSpec::of(Pattern::Checker)
    };
    let zones = TextureSpec { mapping: Mapping::Spherical, ..spec };
    all(zones, [3.0, -0.1, 0.0], [0.0; 2], 0.0);
    all(zones, [3.0, 0.1, 0.0], [0.0; 2], 1.0);
    let rings = TextureSpec { mapping: Mapping::Cylindrical, ..spec };
    all(rings, [3.0, 0.4, 0.0], [0.0; 2], 0.0);
    all(rings, [3.0, 0.6, 0.0], [0.0; 2], 1.0);
}

#[test]
fn pictures_by_a_meshs_coordinates() {
    let image = Image::new(
        2,
        2,
        Texels::Indexed { bits: 8, palette: &[[0; 3], [255; 3], [188; 3]] },
        &[0, 1, 2, 0],
    );
    let spec = TextureSpec { mapping: Mapping::Uv, ..TextureSpec::of(Pattern::Image(image)) };
    let grey = ((188.0f64 / 255.0 + 0.055) / 1.055).powf(2.4);
    all(spec, [9.0; 3], [0.25, 0.25], grey);
    all(spec, [9.0; 3], [0.75, 0.25], 0.0);
    all(spec, [9.0; 3], [0.75, 0.75], 1.0);
    all(spec, [9.0; 3], [-0.25, 3.75], 1.0);
}

#[test]
fn a_gradient_of_the_height() {
    // A ramp of 0.25 over 2 units.
    let wrap = Wrap::Repeat;
    let spec =
        TextureSpec { size: [2.0; 3], height: 0.25, ..TextureSpec::of(Pattern::Gradient { wrap }) };
    let [x, y, z] = Texture::<f64>::new(spec).gradient(&[0.7, 0.2, 0.1]);
    assert!((x - 0.125).abs() < 1e-4 && y == 0.0 && z == 0.0, "{x} {y} {z}");
    let got = Texture::<Fixed>::new(spec).gradient(&[0.7, 0.2, 0.1].map(Length::from_num));
    assert!((got[0].to_num::<f64>() - 0.125).abs() < 1e-4);
    // A step is as steep as it may be, and downwards where the ramp begins anew.
    let [x, _, _] = Texture::<f64>::new(TextureSpec { height: 8.0, ..spec }).gradient(&[1.99; 3]);
    assert_eq!(x, -1.0);
}

#[test]
fn what_is_refused() {
    fn refuses(spec: TextureSpec<'_>, error: ShapeError) {
        assert_eq!(Texture::<Fixed>::try_new(&spec).unwrap_err(), error, "{spec:?}");
        assert_eq!(Texture::<f64>::try_new(&spec).unwrap_err(), error, "{spec:?}");
    }
    let of = TextureSpec::of;
    for pattern in [
        Pattern::Stripes { width: 1.1 },
        Pattern::Stripes { width: f64::NAN },
        Pattern::Noise { octaves: 0 },
        Pattern::Noise { octaves: 9 },
        Pattern::Marble { octaves: 1, turbulence: 17.0 },
        Pattern::Wood { octaves: 1, turbulence: -1.0 },
        Pattern::Brick { mortar: 1.5 },
    ] {
        refuses(of(pattern), ShapeError::Coefficient);
    }
    let size = [-1.0, 1.0, 1.0];
    refuses(TextureSpec { size, ..RAMP }, ShapeError::Size);
    refuses(TextureSpec { up: [0.0; 3], ..RAMP }, ShapeError::Direction);
    refuses(TextureSpec { up: [2.0, 0.0, 0.0], ..RAMP }, ShapeError::Direction);
    refuses(TextureSpec { origin: [f64::NAN; 3], ..RAMP }, ShapeError::Coordinate);
    refuses(TextureSpec { colors: [[-1.0; 3]; 2], ..RAMP }, ShapeError::Coefficient);
    refuses(TextureSpec { height: 4.1, ..RAMP }, ShapeError::Coefficient);
    refuses(TextureSpec { height: f64::NAN, ..RAMP }, ShapeError::Coefficient);
    let sphere = TextureSpec { mapping: Mapping::Spherical, ..RAMP };
    refuses(TextureSpec { height: 0.1, ..sphere }, ShapeError::Coefficient);
    let mesh = TextureSpec { mapping: Mapping::Uv, ..RAMP };
    refuses(TextureSpec { other: Some(0), ..mesh }, ShapeError::Coefficient);
    refuses(TextureSpec { other: Some(u16::MAX), ..RAMP }, ShapeError::Material);
    let tiny = TextureSpec { size: [0.0001; 3], ..RAMP };
    assert_eq!(Texture::<Fixed>::try_new(&tiny).unwrap_err(), ShapeError::Size);
}

#[test]
fn bytes() {
    // In flash, one for each texture that is used.
    assert!(size_of::<Texture<'_, Fixed>>() <= 160, "{}", size_of::<Texture<'_, Fixed>>());
}

proptest! {
    /// A coordinate of cells of side s at x is wrong by half a step of the cells per unit, x·2⁻¹⁷, by a
    /// few steps of the position, 2⁻¹⁶/s each, and by what an axis is short of a unit vector, x·2⁻¹⁶/s.
    #[test]
    fn fixed_against_f64(
        p in prop::array::uniform3(-100.0f64..100.0),
        right in prop::array::uniform3(-1.0f64..1.0),
        size in 0.1f64..20.0,
    ) {
        prop_assume!(right[0].hypot(right[2]) > 0.1);
        let p = p.map(|x| Length::from_num(x).to_num::<f64>());
        let spec = TextureSpec { right, size: [size; 3], ..RAMP };
        let [fixed, single, double] = values(spec, p, [0.0; 2]);
        let bound = 200.0 / 131072.0 + (4.0 + 400.0) / 65536.0 / size + 1e-4;
        for value in [fixed, single] {
            let off = (value - double).rem_euclid(1.0);
            prop_assert!(off.min(1.0 - off) < bound, "{fixed} {single} {double}");
        }
    }

    #[test]
    fn longitudes_in_fixed_point(angle in 0.0..TAU, y in -1.0..1.0f64, r in 0.5..100.0f64) {
        let p = [r * angle.cos(), r * y, -r * angle.sin()];
        let spec = TextureSpec { mapping: Mapping::Spherical, ..RAMP };
        for value in values(spec, p, [0.0; 2]) {
            let off = (value - angle / TAU).rem_euclid(1.0);
            // Fifteen bits of the direction.
            prop_assert!(off.min(1.0 - off) < 2e-4, "{value} {}", angle / TAU);
        }
    }

    #[test]
    fn noise_has_a_gradient(p in prop::array::uniform3(-50.0f64..50.0)) {
        let noise = Pattern::Noise { octaves: 2 };
        let spec = TextureSpec { size: [2.0; 3], height: 0.3, ..TextureSpec::of(noise) };
        let texture = Texture::<f64>::new(spec);
        let height = |p: &[f64; 3]| 0.3 * (1.0 - texture.color(p, [0; 2])[0]);
        let got = texture.gradient(&p);
        for i in 0..3 {
            let mut q = p;
            q[i] += 0.25;
            let slope = (height(&q) - height(&p)) / 0.25;
            prop_assert!((got[i] - slope).abs() < 2e-3, "{} {slope}", got[i]);
        }
    }
}

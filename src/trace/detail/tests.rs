use super::*;
use crate::math::Fixed;
use crate::scene::{Pattern, Texture, TextureSpec, Wrap};
use proptest::prelude::*;
extern crate std;

type Weight = <Fixed as Arithmetic>::Weight;
type Unit = <Fixed as Arithmetic>::Unit;

/// Fresnel's formulas as books print them, for indices before and behind.
fn exact(cos_i: f64, before: f64, behind: f64) -> Option<(f64, f64)> {
    let sin_t = before / behind * (1.0 - cos_i * cos_i).sqrt();
    if sin_t >= 1.0 {
        return None;
    }
    let cos_t = (1.0 - sin_t * sin_t).sqrt();
    let s = (before * cos_i - behind * cos_t) / (before * cos_i + behind * cos_t);
    let p = (behind * cos_i - before * cos_t) / (behind * cos_i + before * cos_t);
    Some((0.5 * (s * s + p * p), cos_t))
}

#[test]
fn four_percent_of_what_falls_straight_on_glass() {
    let f = reflectance::<f64>([1.0, 1.0], 1.0 / 1.5);
    assert!((f - 0.04).abs() < 1e-15);
    // The same from inside; and nothing where there is no difference.
    assert!((reflectance::<f64>([1.0, 1.0], 1.5) - 0.04).abs() < 1e-15);
    assert_eq!(reflectance::<f64>([0.7, 0.7], 1.0), 0.0);
    // All of what grazes.
    assert_eq!(reflectance::<f64>([0.0, 0.745], 1.0 / 1.5), 1.0);
    assert_eq!(reflectance::<f64>([0.745, 0.0], 1.5), 1.0);
    assert_eq!(reflectance::<f64>([0.0, 0.0], 1.0), 1.0);
}

#[test]
fn brewsters_angle() {
    // Where tan θ = n only one polarisation is left: ½·((n² − 1)/(n² + 1))².
    let n = 1.5f64;
    let cos_i = 1.0 / (1.0 + n * n).sqrt();
    let cos_t = n * cos_i;
    let half = 0.5 * ((n * n - 1.0) / (n * n + 1.0)).powi(2);
    assert!((reflectance::<f64>([cos_i, cos_t], 1.0 / n) - half).abs() < 1e-15);
}

proptest! {
    #[test]
    fn fresnel_against_the_formula(cos_i in 0.0..=1.0f64, before in 1.0..2.0f64, behind in 1.0..2.0f64) {
        let Some((f, cos_t)) = exact(cos_i, before, behind) else { return Ok(()) };
        let eta = before / behind;
        prop_assert!((reflectance::<f64>([cos_i, cos_t], eta) - f).abs() < 1e-12);
        let single = [cos_i as f32, cos_t as f32];
        prop_assert!((f64::from(reflectance::<f32>(single, eta as f32)) - f).abs() < 1e-4);
        // Cosines of 14 bits: a quotient of small ones is wrong by 2⁻¹⁴ over their sum, twice.
        let fixed = [Weight::from_num(cos_i), Weight::from_num(cos_t)];
        let got = reflectance::<Fixed>(fixed, Weight::from_num(eta)).to_num::<f64>();
        let sum = cos_i.min(eta * cos_i) + cos_t.min(eta * cos_t);
        prop_assert!((got - f).abs() < 3e-4 + 6e-4 / sum.max(1e-3), "{got} {f}");
        // What isn't reflected is let through: nothing is made or lost.
        prop_assert!((0.0..=1.0).contains(&got));
    }

    /// Bumps leave the normal a unit vector, on the side that the ray comes from.
    #[test]
    fn bent_normals(
        n in prop::array::uniform3(-1.0f64..1.0),
        d in prop::array::uniform3(-1.0f64..1.0),
        p in prop::array::uniform3(-20.0f64..20.0),
        height in -2.0..2.0f64,
        behind: bool,
    ) {
        let unit = |v: [f64; 3]| {
            let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
            v.map(|x| x / length)
        };
        let (n, d) = (unit(n), unit(d));
        let cosine = -(n[0] * d[0] + n[1] * d[1] + n[2] * d[2]);
        prop_assume!(cosine > 1e-3);
        let noise = Pattern::Noise { octaves: 2 };
        let spec = TextureSpec { height, ..TextureSpec::of(noise) };
        let surface =
            Surface { geometric: n, normal: n, cosine, behind, smooth: false, part: 0 };
        let got = bent::<f64>(Texture::<f64>::new(spec).gradient(&p), surface, d);
        let length = got.normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        prop_assert!((length - 1.0).abs() < 1e-12);
        prop_assert!(got.cosine > 0.0 && got.geometric == n && got.behind == behind);

        let fixed = |v: [f64; 3]| v.map(Unit::from_num);
        let surface = Surface::<Fixed> {
            geometric: fixed(n),
            normal: fixed(n),
            cosine: Unit::from_num(cosine),
            behind,
            smooth: false,
            part: 0,
        };
        let p = p.map(<Fixed as Arithmetic>::Length::from_num);
        let other = bent::<Fixed>(Texture::<Fixed>::new(spec).gradient(&p), surface, fixed(d));
        let normal = other.normal.map(|x| x.to_num::<f64>());
        let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        prop_assert!((length - 1.0).abs() < 1e-4, "{length}");
        prop_assert!(other.cosine > Unit::ZERO);
        // They differ where one kept the surface as it was, and by what the texture's coordinates do.
        if got.smooth == other.smooth {
            for i in 0..3 {
                prop_assert!((normal[i] - got.normal[i]).abs() < 4e-3, "{normal:?} {:?}", got.normal);
            }
        }
    }
}

#[test]
fn a_ramp_bends_the_normal_by_its_slope() {
    let wrap = Wrap::Repeat;
    let spec = TextureSpec { height: 0.5, ..TextureSpec::of(Pattern::Gradient { wrap }) };
    let gradient = Texture::<f64>::new(spec).gradient(&[0.2; 3]);
    let n = [0.0, 1.0, 0.0];
    let surface =
        Surface { geometric: n, normal: n, cosine: 1.0, behind: false, smooth: false, part: 0 };
    let down = [0.0, -1.0, 0.0];
    // Upwards along x by a half: the normal leans back by as much.
    let l = 1.25f64.sqrt();
    let lean = bent::<f64>(gradient, surface, down).normal;
    assert!((lean[0] + 0.5 / l).abs() < 1e-3 && (lean[1] - 1.0 / l).abs() < 1e-3, "{lean:?}");
    let lean = bent::<f64>(gradient, Surface { behind: true, ..surface }, down).normal;
    assert!((lean[0] - 0.5 / l).abs() < 1e-3, "{lean:?}");
}

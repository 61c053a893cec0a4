//! What every operation may be wrong, from both sides: of many thousand samples none is worse than
//! what `docs/precision.md` states, and the worst comes near it.
//!
//! An error is `steps` of the result's last place (of fixed point) and `parts` of 2⁻²⁴ of a size: that of
//! the largest operand or of the exact result, as the row says.

extern crate std;

use std::format;
use std::string::String;
use std::vec::Vec;

/// A bound: steps of the last place, and parts of 2⁻²⁴ of the size.
#[derive(Clone, Copy)]
struct Bound(f64, f64);

/// An operation, what its error is measured against, and its bounds in fixed point and in `f32`.
struct Row(&'static str, &'static str, Bound, Bound);

/// The worst found is no less than this part of a bound.
const NEAR: f64 = 0.5;
const SAMPLES: u32 = 20_000;

/// Lengths, units, coefficients and radiances: 16, 17, 14 and 16 bits behind the point.
const LENGTH: f64 = 1.0 / 65536.0;
const UNIT: f64 = 1.0 / 131072.0;
const WEIGHT: f64 = 1.0 / 16384.0;
const RADIANCE: f64 = 1.0 / 65536.0;

const ROWS: [Row; 39] = [
    Row("along", "o, t·d", Bound(1.0, 0.0), Bound(0.0, 2.7)),
    Row("scale", "t·u", Bound(1.0, 0.0), Bound(0.0, 1.0)),
    Row("project", "length of v", Bound(1.0, 0.0), Bound(0.0, 2.1)),
    Row("dot", "1", Bound(1.0, 0.0), Bound(0.0, 1.7)),
    Row("product", "a·b", Bound(1.0, 0.0), Bound(0.0, 1.0)),
    Row("cosine", "1", Bound(2.0, 0.0), Bound(0.0, 1.7)),
    Row("reflect", "1", Bound(1.0, 0.0), Bound(0.0, 1.6)),
    Row("refract", "1", Bound(25.0, 0.0), Bound(0.0, 4.1)),
    Row("ratio", "a/b", Bound(1.0, 71.0), Bound(0.0, 1.0)),
    Row("normalize: direction", "1", Bound(5.1, 0.0), Bound(0.0, 2.6)),
    Row("normalize: length", "length of v", Bound(0.75, 1400.0), Bound(0.0, 2.0)),
    Row("share", "1", Bound(7.1, 0.0), Bound(0.0, 2.6)),
    Row("renormalize", "1", Bound(3.0, 0.0), Bound(0.0, 2.8)),
    Row("leg of a square", "r", Bound(1.0, 1400.0), Bound(0.0, 0.0)),
    Row("over", "1", Bound(97.0, 0.0), Bound(0.0, 2.0)),
    Row("part", "1", Bound(97.0, 0.0), Bound(0.0, 2.0)),
    Row("weights", "1", Bound(2.2, 0.0), Bound(0.0, 1.2)),
    Row("blend", "1", Bound(6.3, 0.0), Bound(0.0, 2.7)),
    Row("weight", "a·b", Bound(1.0, 0.0), Bound(0.0, 1.0)),
    Row("quotient", "a/b", Bound(1.0, 0.0), Bound(0.0, 1.0)),
    Row("weight_of", "u", Bound(1.0, 0.0), Bound(0.0, 0.0)),
    Row("power", "1", Bound(22.0, 0.0), Bound(0.0, 49.0)),
    Row("dim", "r·w", Bound(1.5, 0.0), Bound(0.0, 1.0)),
    Row("relative", "a/b", Bound(1.0, 0.0), Bound(0.0, 1.0)),
    Row("portion", "r", Bound(1.0, 0.0), Bound(0.0, 2.0)),
    Row("over_weight", "r/w", Bound(1.0, 16.0), Bound(0.0, 1.0)),
    Row("ramp", "middle", Bound(1.0, 0.0), Bound(0.0, 2.5)),
    Row("steps", "a, b", Bound(16.0, 0.0), Bound(0.0, 2.1)),
    Row("mean", "sum/count", Bound(1.0, 0.0), Bound(0.0, 2.0)),
    Row("falloff", "i/r²", Bound(1.0, 3400.0), Bound(0.0, 5.5)),
    Row("dim_intensity", "i·w", Bound(0.0, 1500.0), Bound(0.0, 2.0)),
    Row("spread_intensity", "i·r²", Bound(0.0, 2900.0), Bound(0.0, 2.7)),
    Row("constant", "i", Bound(1.0, 530.0), Bound(0.0, 1.0)),
    Row("decay", "1", Bound(1.0, 0.0), Bound(0.0, 1.1)),
    Row("ratio_q16", "a/b", Bound(1.0, 16.0), Bound(2.0, 0.0)),
    Row("sight", "1", Bound(3.2, 0.0), Bound(0.0, 2.6)),
    Row("rotate", "length of v", Bound(1.6, 0.0), Bound(0.0, 3.0)),
    Row("turn", "1", Bound(0.75, 0.0), Bound(0.0, 2.1)),
    Row("magnify", "s·a", Bound(0.6, 0.0), Bound(0.0, 2.0)),
];

/// What one sample says: the result, the exact one, the size, and a step of the result.
struct Sample {
    got: f64,
    exact: f64,
    size: f64,
    step: f64,
}

fn sample(got: impl Into<f64>, exact: f64, size: f64, step: f64) -> Sample {
    Sample { got: got.into(), exact, size, step }
}

/// Numbers at random, always the same (splitmix64: Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// As often in each octave.
    fn octaves(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.log2(), high.log2()).exp2()
    }

    fn point(&mut self, far: f64) -> [f64; 3] {
        [0; 3].map(|_| self.between(-far, far))
    }

    fn direction(&mut self) -> [f64; 3] {
        loop {
            let v = self.point(1.0);
            let length = norm(v);
            if length > 0.1 && length < 1.0 {
                return v.map(|x| x / length);
            }
        }
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn norm(v: [f64; 3]) -> f64 {
    dot(v, v).sqrt()
}

/// Errors of an operation, against a bound.
fn worst(bound: Bound, mut next: impl FnMut(&mut Random) -> Sample) -> (f64, f64, f64) {
    let mut random = Random(1);
    let (mut part, mut steps, mut relative) = (0.0f64, 0.0f64, 0.0f64);
    for _ in 0..SAMPLES {
        let Sample { got, exact, size, step } = next(&mut random);
        let error = (got - exact).abs();
        let allowed = bound.0 * step + bound.1 * size * 0.5f64.powi(24);
        // What is exact is as near as can be.
        part = part.max(if allowed > 0.0 { error / allowed } else { 1.0 + error });
        steps = steps.max(error / step);
        relative = relative.max(error / size * 2f64.powi(24));
    }
    (part, steps, relative)
}

macro_rules! operations {
    ($arithmetic:ident, $type:ty, $make:ident) => {
        mod $arithmetic {
            use super::{LENGTH, RADIANCE, Random, Sample, UNIT, WEIGHT, dot, norm, sample};
            use crate::math::{Arithmetic, $make as make};

            type A = $type;
            type Length = <A as Arithmetic>::Length;
            type Unit = <A as Arithmetic>::Unit;

            fn length(x: f64) -> (Length, f64) {
                let made = make::length(x).unwrap();
                (made, made.into())
            }
            fn lengths(v: [f64; 3]) -> ([Length; 3], [f64; 3]) {
                let made = v.map(|x| length(x).0);
                (made, made.map(Into::into))
            }
            fn unit(x: f64) -> (Unit, f64) {
                let made = make::unit(x).unwrap();
                (made, made.into())
            }
            fn units(v: [f64; 3]) -> ([Unit; 3], [f64; 3]) {
                let made = v.map(|x| unit(x).0);
                (made, made.map(Into::into))
            }
            fn weight(x: f64) -> (<A as Arithmetic>::Weight, f64) {
                let made = make::weight(x).unwrap();
                (made, made.into())
            }
            fn radiance(x: f64) -> (<A as Arithmetic>::Radiance, f64) {
                let made = make::radiance(x).unwrap();
                (made, made.into())
            }

            /// The matrix of a rotation about an axis (Rodrigues 1840).
            fn turning(r: &mut Random) -> [[f64; 3]; 3] {
                let ([x, y, z], angle) = (r.direction(), r.between(0.0, 6.0));
                let (s, c) = angle.sin_cos();
                let k = 1.0 - c;
                [
                    [c + x * x * k, x * y * k - z * s, x * z * k + y * s],
                    [y * x * k + z * s, c + y * y * k, y * z * k - x * s],
                    [z * x * k - y * s, z * y * k + x * s, c + z * z * k],
                ]
            }

            pub(super) fn measured(name: &str, r: &mut Random) -> Sample {
                match name {
                    "along" => {
                        let ((o, of), (t, tf)) =
                            (lengths(r.point(500.0)), length(r.between(0.0, 500.0)));
                        let (d, df) = units(r.direction());
                        sample(
                            A::along(&o, t, &d)[0],
                            of[0] + tf * df[0],
                            of[0].abs().max((tf * df[0]).abs()),
                            LENGTH,
                        )
                    }
                    "scale" => {
                        let ((t, tf), (u, uf)) =
                            (length(r.between(-500.0, 500.0)), unit(r.between(-1.0, 1.0)));
                        sample(A::scale(t, u), tf * uf, (tf * uf).abs(), LENGTH)
                    }
                    "project" => {
                        let ((v, vf), (d, df)) = (lengths(r.point(500.0)), units(r.direction()));
                        sample(A::project(&v, &d), dot(vf, df), norm(vf), LENGTH)
                    }
                    "dot" | "cosine" => {
                        let ((a, af), (b, bf)) = (units(r.direction()), units(r.direction()));
                        if name == "dot" {
                            sample(A::dot(&a, &b), dot(af, bf), 1.0, UNIT)
                        } else {
                            sample(A::cosine(&a, &b), dot(af, bf), 1.0, WEIGHT)
                        }
                    }
                    "product" => {
                        let ((a, af), (b, bf)) =
                            (unit(r.between(-1.0, 1.0)), unit(r.between(-1.0, 1.0)));
                        sample(A::product(a, b), af * bf, (af * bf).abs(), UNIT)
                    }
                    "reflect" => {
                        let ((d, df), (n, nf)) = (units(r.direction()), units(r.direction()));
                        let dn = A::dot(&d, &n);
                        let dnf: f64 = dn.into();
                        sample(A::reflect(&d, &n, dn)[0], df[0] - 2.0 * dnf * nf[0], 1.0, UNIT)
                    }
                    "refract" => loop {
                        let ((d, df), (n, nf)) = (units(r.direction()), units(r.direction()));
                        let eta = r.between(0.5, 2.0);
                        let cos = -A::dot(&d, &n);
                        let cosf: f64 = cos.into();
                        let square = 1.0 - eta * eta * (1.0 - cosf * cosf);
                        // Nearer to the critical angle a root has no bound.
                        if cosf > 0.05 && square > 0.1 {
                            let made = A::refract(&d, &n, cos, &make::eta(eta).unwrap()).unwrap();
                            let exact = eta * df[0] + (eta * cosf - square.sqrt()) * nf[0];
                            break sample(made[0], exact, 1.0, UNIT);
                        }
                    },
                    "ratio" => {
                        let ((a, af), (b, bf)) =
                            (length(r.octaves(0.01, 100.0)), unit(r.octaves(0.1, 1.0)));
                        sample(A::ratio(a, b), af / bf, af / bf, LENGTH)
                    }
                    "normalize: direction" | "normalize: length" | "share" => {
                        let far = r.octaves(0.1, 500.0);
                        let v = r.direction().map(|x| x * far);
                        let (v, vf) = lengths(v);
                        let (d, l, inverse) = A::normalize(&v);
                        match name {
                            "normalize: direction" => sample(d[0], vf[0] / norm(vf), 1.0, UNIT),
                            "normalize: length" => sample(l, norm(vf), norm(vf), LENGTH),
                            _ => sample(A::share(v[0], &inverse), vf[0] / norm(vf), 1.0, UNIT),
                        }
                    }
                    "renormalize" => {
                        let long = r.between(0.1, 1.0);
                        let (v, vf) = units(r.direction().map(|x| x * long));
                        sample(A::renormalize(&v).0[0], vf[0] / norm(vf), 1.0, UNIT)
                    }
                    "leg of a square" => {
                        let radius = make::radius(r.octaves(0.01, 400.0)).unwrap();
                        let rf: f64 = A::radius(&radius).into();
                        let (a, af) = length(r.between(0.25 * rf, rf));
                        sample(A::leg(&radius, A::square(&radius, a)), af, rf, LENGTH)
                    }
                    "over" | "part" => {
                        let radius = make::radius(r.octaves(0.01, 400.0)).unwrap();
                        let rf: f64 = A::radius(&radius).into();
                        let (v, vf) = lengths(r.direction().map(|x| x * rf));
                        let got = if name == "over" {
                            A::over(&radius, &v)[0]
                        } else {
                            A::part(&radius, v[0])
                        };
                        sample(got, vf[0] / rf, 1.0, UNIT)
                    }
                    "weights" => {
                        let side = r.octaves(0.5, 50.0);
                        let (b, c) = ([side, 0.0], [0.25 * side, side]);
                        let form = make::barycentric(b, c, 0.0).unwrap();
                        let (wb, wc) = (r.between(0.0, 0.5), r.between(0.0, 0.5));
                        let (x, xf) = length(wb * b[0] + wc * c[0]);
                        let (y, yf) = length(wb * b[1] + wc * c[1]);
                        let exact = (xf * c[1] - yf * c[0]) / (b[0] * c[1] - b[1] * c[0]);
                        sample(A::weights(&form, x, y).0, exact.clamp(0.0, 1.0), 1.0, WEIGHT)
                    }
                    "blend" => {
                        let n = r.direction();
                        let mut near = || {
                            let off = r.direction();
                            let v = [0, 1, 2].map(|i| n[i] + 0.3 * off[i]);
                            units(v.map(|x| x / norm(v)))
                        };
                        let ((n0, f0), (n1, f1), (n2, f2)) = (near(), near(), near());
                        let ((b, bf), (c, cf)) =
                            (weight(r.between(0.0, 0.5)), weight(r.between(0.0, 0.5)));
                        let v =
                            [0, 1, 2].map(|i| (1.0 - bf - cf) * f0[i] + bf * f1[i] + cf * f2[i]);
                        sample(A::blend(&[n0, n1, n2], b, c)[0], v[0] / norm(v), 1.0, UNIT)
                    }
                    "weight" => {
                        let ((a, af), (b, bf)) =
                            (weight(r.between(0.0, 4.0)), weight(r.between(0.0, 1.0)));
                        sample(A::weight(a, b), af * bf, af * bf, WEIGHT)
                    }
                    "quotient" => {
                        let (b, bf) = weight(r.octaves(0.01, 1.0));
                        let (a, af) = weight(r.between(0.0, bf));
                        sample(A::quotient(a, b), af / bf, af / bf, WEIGHT)
                    }
                    "weight_of" => {
                        let (u, uf) = unit(r.between(-1.0, 1.0));
                        sample(A::weight_of(u), uf, uf.abs(), WEIGHT)
                    }
                    "power" => {
                        let n = r.octaves(1.0, 200.0).round();
                        let (c, cf) = weight(r.between(0.5, 1.0));
                        sample(A::power(c, &make::exponent(n).unwrap()), cf.powf(n), 1.0, WEIGHT)
                    }
                    "dim" => {
                        let ((a, af), (w, wf)) =
                            (radiance(r.octaves(0.01, 100.0)), weight(r.between(0.0, 1.0)));
                        sample(A::dim(a, w), af * wf, af * wf, RADIANCE)
                    }
                    "relative" => {
                        let (b, bf) = radiance(r.octaves(0.1, 100.0));
                        let (a, af) = radiance(bf * r.between(0.1, 10.0));
                        sample(A::relative(a, b), af / bf, af / bf, WEIGHT)
                    }
                    "portion" => {
                        let ((a, af), part) =
                            (radiance(r.octaves(0.01, 100.0)), (r.bits() >> 32) as u32);
                        sample(
                            A::portion(a, part),
                            af * f64::from(part) / 2f64.powi(32),
                            af,
                            RADIANCE,
                        )
                    }
                    "over_weight" => {
                        let ((a, af), (w, wf)) =
                            (radiance(r.octaves(0.1, 100.0)), weight(r.octaves(1.0, 7.0)));
                        sample(A::over_weight(a, w), af / wf, af / wf, RADIANCE)
                    }
                    "ramp" => {
                        let (middle, mf) = radiance(r.octaves(0.1, 100.0));
                        let (slope, sf) = radiance(mf * r.between(0.0, 1.0));
                        let (u, uf) = unit(r.between(-1.0, 1.0));
                        sample(A::ramp(middle, slope, u), mf + sf * uf, mf, RADIANCE)
                    }
                    "steps" => {
                        let ((a, af), (b, bf)) =
                            (radiance(r.octaves(0.01, 10.0)), radiance(r.octaves(0.01, 10.0)));
                        let n = (r.bits() & 15) as u16;
                        let got = A::steps(a, A::step(a, b, 4), n);
                        sample(got, af + (bf - af) / 16.0 * f64::from(n), af.max(bf), RADIANCE)
                    }
                    "mean" => {
                        let (sum, sf) = radiance(r.octaves(0.1, 100.0));
                        let count = 1 + (r.bits() & 63) as u16;
                        sample(
                            A::mean(sum, count),
                            sf / f64::from(count),
                            sf / f64::from(count),
                            RADIANCE,
                        )
                    }
                    "falloff" => {
                        let i = r.octaves(0.1, 100.0);
                        let far = r.octaves(1.0, 100.0);
                        let (v, vf) = lengths(r.direction().map(|x| x * far));
                        let exact = i / dot(vf, vf);
                        sample(
                            A::falloff(&make::intensity(i).unwrap(), &A::normalize(&v).2),
                            exact,
                            exact,
                            RADIANCE,
                        )
                    }
                    "dim_intensity" => {
                        let (i, (w, wf)) = (r.octaves(0.1, 100.0), weight(r.between(0.1, 4.0)));
                        let got = A::dim_intensity(&make::intensity(i).unwrap(), w);
                        sample(make::from_intensity(&got), i * wf, i * wf, RADIANCE)
                    }
                    "spread_intensity" => {
                        let (i, (l, lf)) = (r.octaves(0.1, 100.0), length(r.octaves(0.1, 100.0)));
                        let got = A::spread_intensity(&make::intensity(i).unwrap(), l);
                        sample(make::from_intensity(&got), i * lf * lf, i * lf * lf, RADIANCE)
                    }
                    "constant" => {
                        let i = r.octaves(0.01, 100.0);
                        sample(A::constant(&make::intensity(i).unwrap()), i, i, RADIANCE)
                    }
                    "decay" => {
                        let (rate, (t, tf)) = (r.octaves(0.01, 10.0), length(r.octaves(0.1, 10.0)));
                        sample(
                            A::decay(&make::decay(rate).unwrap(), t),
                            (-rate * tf).exp(),
                            1.0,
                            WEIGHT,
                        )
                    }
                    "ratio_q16" => {
                        let ((a, af), (b, bf)) =
                            (length(r.octaves(0.1, 100.0)), length(r.octaves(0.1, 100.0)));
                        sample(f64::from(A::ratio_q16(a, b)) / 65536.0, af / bf, af / bf, LENGTH)
                    }
                    "sight" => {
                        let long = r.between(0.5, 3.0);
                        let v = r.direction().map(|x| make::aim(x * long).unwrap());
                        let vf = v.map(Into::<f64>::into);
                        sample(A::sight(&v, A::rise(&v))[0], vf[0] / norm(vf), 1.0, UNIT)
                    }
                    "rotate" | "turn" => {
                        let matrix = turning(r);
                        let rotation = make::rotation(&matrix);
                        if name == "rotate" {
                            let (v, vf) = lengths(r.point(500.0));
                            sample(
                                A::rotate(&rotation, &v)[0],
                                dot(matrix[0], vf),
                                norm(vf),
                                LENGTH,
                            )
                        } else {
                            let (v, vf) = units(r.direction());
                            sample(A::turn(&rotation, &v)[0], dot(matrix[0], vf), 1.0, UNIT)
                        }
                    }
                    "magnify" => {
                        let (s, (a, af)) =
                            (r.octaves(0.01, 10.0), length(r.between(-100.0, 100.0)));
                        sample(
                            A::magnify(&make::scale(s).unwrap(), a),
                            s * af,
                            (s * af).abs(),
                            LENGTH,
                        )
                    }
                    _ => panic!("{name}"),
                }
            }
        }
    };
}
operations!(fixed, crate::math::Fixed, fixed_constructors);
operations!(single, f32, f32_constructors);

#[test]
fn bounds_hold_and_are_near() {
    let mut flaws = Vec::new();
    for &Row(name, _, fixed, single) in &ROWS {
        for (arithmetic, bound, (part, steps, relative)) in [
            ("fixed", fixed, worst(fixed, |r| fixed::measured(name, r))),
            ("f32", single, worst(single, |r| single::measured(name, r))),
        ] {
            if !(NEAR..=1.0).contains(&part) {
                flaws.push(format!(
                    "{name}, {arithmetic}: {part:.3} of {} steps and {} parts; {steps:.2} or {relative:.2}",
                    bound.0, bound.1
                ));
            }
        }
    }
    assert!(flaws.is_empty(), "\n{}", flaws.join("\n"));
}

/// The table of the page, of the numbers here.
#[test]
fn the_page_states_them() {
    let bound = |bound: Bound| match bound {
        Bound(0.0, 0.0) => String::from("exact"),
        Bound(1.0, 0.0) => String::from("1 step"),
        Bound(steps, 0.0) => format!("{steps} steps"),
        Bound(0.0, parts) => format!("{parts}·2⁻²⁴"),
        Bound(1.0, parts) => format!("1 step and {parts}·2⁻²⁴"),
        Bound(steps, parts) => format!("{steps} steps and {parts}·2⁻²⁴"),
    };
    let mut table = String::from("| operation | of | fixed | `f32` |\n|---|---|---|---|\n");
    for &Row(name, of, fixed, single) in &ROWS {
        table += &format!("| `{name}` | {of} | {} | {} |\n", bound(fixed), bound(single));
    }
    crate::page::states(&table);
}

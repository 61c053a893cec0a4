//! Each operation of [`Fixed`] against `f64`, with its error stated.
use super::{constructors as make, *};
use crate::blob::Stored;
use proptest::prelude::*;
extern crate std;
use std::prelude::v1::*;

const LSB: f64 = 1.0 / 65536.0;

fn len(v: [I16F16; 3]) -> [f64; 3] {
    v.map(|x| x.to_num())
}

fn direction_of(v: [f64; 3]) -> ([Unit; 3], [f64; 3]) {
    let n = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt().max(1e-9);
    let d = v.map(|x| make::unit(x / n).unwrap());
    (d, d.map(|x| x.to_num()))
}

fn lengths_of(v: [f64; 3]) -> [I16F16; 3] {
    v.map(|x| make::length(x).unwrap())
}

fn any(range: f64) -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(-range..range)
}

/// A direction that is not null.
fn toward() -> impl Strategy<Value = [f64; 3]> {
    any(1.0).prop_filter("a direction", |v| v.iter().map(|x| x * x).sum::<f64>() > 1e-4)
}

proptest! {
    /// Radii are from 2⁻¹² to 500. What is stored beside them is their own: that of a sphere twice as
    /// large, or half as large, is none.
    #[test]
    fn radii_are_sound(log in -12.0f64..=8.965) {
        let radius = make::radius(log.exp2()).unwrap();
        prop_assert!(radius.is_sound(), "{radius:?}");
        let more = FixedRadius { missing: radius.missing + 1, ..radius };
        prop_assert!(!more.is_sound(), "{more:?}");
        if let Some(missing) = radius.missing.checked_sub(1) {
            let less = FixedRadius { missing, ..radius };
            prop_assert!(!less.is_sound(), "{less:?}");
        }
    }

    #[test]
    fn along_rounds_once(o in any(500.0), t in 0.0..500.0f64, v in toward()) {
        let (d, df) = direction_of(v);
        let t = make::length(t).unwrap();
        let p = len(Fixed::along(&lengths_of(o), t, &d));
        for i in 0..3 {
            let exact = o[i] + t.to_num::<f64>() * df[i];
            prop_assert!((p[i] - exact).abs() <= 1.6 * LSB);
        }
    }

    #[test]
    fn directions_to_16_bits_and_lengths_to_13(v in any(1000.0), scale in -9i32..=0) {
        let v = v.map(|x| x * 2f64.powi(scale));
        let fixed = lengths_of(v);
        let v = len(fixed);
        let exact = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
        prop_assume!(exact > 0.01);
        let (u, length, inverse) = Fixed::normalize(&fixed);
        let bound = 0.5f64.powi(15);
        prop_assert!((length.to_num::<f64>() - exact).abs() <= 4.0 * exact * bound + 2.0 * LSB);
        for i in 0..3 {
            prop_assert!((u[i].to_num::<f64>() - v[i] / exact).abs() < bound + 1.5 / 131072.0);
        }
        let e = f64::from(inverse.mantissa_q15) / 32768.0 * 2f64.powi(inverse.exponent);
        prop_assert!((e * exact - 1.0).abs() < 2.0 * bound);
    }

    #[test]
    fn ratio_to_17_bits(a in 0.0..1000.0f64, b in 0.0..1.0f64) {
        let (a, b) = (make::length(a).unwrap(), make::unit(b).unwrap());
        let got = Fixed::ratio(a, b);
        let exact = a.to_num::<f64>() / b.to_num::<f64>();
        if exact >= 1024.0 || b.to_bits() == 0 {
            prop_assert!(got >= I16F16::from_num(1023.9));
        } else {
            let error = (got.to_num::<f64>() - exact).abs();
            prop_assert!(error <= exact * 0.5f64.powi(16) + 1.5 * LSB, "{a}/{b}: {got}");
        }
    }

    #[test]
    fn mirrors(v in toward(), w in toward()) {
        let ((d, df), (n, nf)) = (direction_of(v), direction_of(w));
        let dn: f64 = (0..3).map(|i| df[i] * nf[i]).sum();
        let r = Fixed::reflect(&d, &n, Fixed::dot(&d, &n));
        for i in 0..3 {
            prop_assert!((r[i].to_num::<f64>() - (df[i] - 2.0 * dn * nf[i])).abs() < 4.0 / 131072.0);
        }
    }

    #[test]
    fn snell(v in toward(), w in toward(), eta in 0.3..3.0f64) {
        let ((d, df), (n, mut nf)) = (direction_of(v), direction_of(w));
        let mut dn: f64 = (0..3).map(|i| df[i] * nf[i]).sum();
        let n = if dn > 0.0 { dn = -dn; nf = nf.map(|x| -x); n.map(|x| -x) } else { n };
        let cos2 = 1.0 - eta * eta * (1.0 - dn * dn);
        let cos_i = -Fixed::dot(&d, &n);
        prop_assume!(cos_i.to_bits() >= 0);
        match Fixed::refract(&d, &n, cos_i, &make::eta(eta).unwrap()) {
            None => prop_assert!(cos2 < 1e-3),
            Some(t) => {
                prop_assert!(cos2 > -1e-3);
                // The root's error grows as the angle nears the critical one.
                let bound = 3e-4 / cos2.max(1e-3).sqrt() * eta;
                let k = -eta * dn - cos2.max(0.0).sqrt();
                for i in 0..3 {
                    let exact = eta * df[i] + k * nf[i];
                    prop_assert!((t[i].to_num::<f64>() - exact).abs() < bound, "{} {exact}", t[i]);
                }
            }
        }
    }

    #[test]
    fn half_chords(r in 0.01..200.0f64, c in any(300.0), v in toward()) {
        let (d, df) = direction_of(v);
        let radius = make::radius(r).unwrap();
        let r = Fixed::radius(&radius).to_num::<f64>();
        let c = lengths_of(c);
        let cf = len(c);
        let t = Fixed::project(&c, &d);
        let tf = t.to_num::<f64>();
        let f2: f64 = (0..3).map(|i| (cf[i] - tf * df[i]).powi(2)).sum();
        let exact = r * r - f2;
        let step = r.max(1.0) * 0.5f64.powi(15);
        match Fixed::leg2(&radius, &c, t, &d) {
            None => prop_assert!(exact < 6.0 * r * step + 1e-9),
            Some(q) => {
                prop_assert!(exact > -6.0 * r * step);
                let leg = Fixed::leg(&radius, q).to_num::<f64>();
                prop_assert!((leg * leg - exact).abs() < 12.0 * r * step, "{leg} {exact}");
            }
        }
    }

    #[test]
    fn normals_to_15_bits(r in 0.01..500.0f64, v in toward()) {
        let radius = make::radius(r).unwrap();
        let (_, df) = direction_of(v);
        let p = df.map(|x| I16F16::from_num(x * r));
        let n = Fixed::over(&radius, &p);
        for i in 0..3 {
            let exact = p[i].to_num::<f64>() / r;
            prop_assert!((n[i].to_num::<f64>() - exact).abs() < 0.5f64.powi(15) + LSB / r);
        }
    }

    #[test]
    fn coarse_never_loses_a_hit(r in 0.01..500.0f64, o in any(500.0), c in any(500.0), v in toward()) {
        let radius = make::radius(r).unwrap();
        let (o, center) = (lengths_of(o), lengths_of(c));
        // half of the rays go for the sphere
        let aim = [0, 1, 2].map(|i| if v[0] > 0.0 { c[i] - o[i].to_num::<f64>() + v[i] * r } else { v[i] });
        let (d, _) = direction_of(aim);
        let rel = [0, 1, 2].map(|i| center[i] - o[i]);
        let t = Fixed::project(&rel, &d);
        if let Some(q) = Fixed::leg2(&radius, &rel, t, &d) {
            let far = t + Fixed::leg(&radius, q);
            if far > I16F16::ZERO && far < Fixed::FAR {
                let coarse = Fixed::coarse(&o, &d);
                prop_assert!(Fixed::may_hit::<false>(&coarse, &center, &radius, far));
                prop_assert!(Fixed::may_hit::<true>(&coarse, &center, &radius, far));
            }
        }
    }

    #[test]
    fn coarse_never_loses_a_line(r in 0.001..300.0f64, o in any(500.0), p in any(500.0), v in toward(), w in toward(),
                                 angle in 0.0..6.3f64, part in 0.0..1.0f64, s in -400.0..400.0f64) {
        // Through a point within r of the axis.
        let radius = make::radius(r).unwrap();
        let (axis, a) = direction_of(v);
        let (_, b) = direction_of(w);
        let dot: f64 = (0..3).map(|i| a[i] * b[i]).sum();
        let across = [0, 1, 2].map(|i| b[i] - dot * a[i]);
        let length = across.iter().map(|x| x * x).sum::<f64>().sqrt();
        prop_assume!(length > 0.01);
        let u = across.map(|x| x / length);
        let n = [0, 1, 2].map(|i| a[(i + 1) % 3] * u[(i + 2) % 3] - a[(i + 2) % 3] * u[(i + 1) % 3]);
        let (sin, cos) = angle.sin_cos();
        let to = [0, 1, 2].map(|i| p[i] + s * a[i] + r * part * (cos * u[i] + sin * n[i]));
        let aim = [0, 1, 2].map(|i| to[i] - o[i]);
        let distance = aim.iter().map(|x| x * x).sum::<f64>().sqrt();
        prop_assume!(distance > 0.01);
        let (d, _) = direction_of(aim);
        let (o, p) = (lengths_of(o), lengths_of(p));
        // The direction's rounding leads past the point by so much.
        prop_assume!(r * (1.0 - part) > distance / 60000.0 + 4.0 * LSB);
        prop_assert!(Fixed::may_pass(&Fixed::coarse(&o, &d), &p, &axis, &radius));
    }

    #[test]
    fn corners_and_inside(b in prop::array::uniform2(-50.0..50.0f64), c in prop::array::uniform2(-50.0..50.0f64),
                          u in -0.5..1.5f64, v in -0.5..1.5f64) {
        let det = (b[0] * c[1] - b[1] * c[0]).abs();
        let size = b.iter().chain(&c).fold(0f64, |a, x| a.max(x.abs()));
        prop_assume!(det > 0.02 * size * size && size > 0.05);
        let form = make::barycentric(b, c, 50.0).unwrap();
        let p = |i: usize| I16F16::from_num(u * b[i] + v * c[i]);
        let clear = 0.03;
        let got = Fixed::barycentric(&form, p(0), p(1), I16F16::from_num(5), Unit::ONE);
        let margin = u.min(v).min(1.0 - u - v);
        if margin > clear { prop_assert!(got.is_some()); }
        if margin < -clear { prop_assert!(got.is_none()); }
        if let Some((bw, cw)) = got {
            prop_assert!((bw.to_num::<f64>() - u).abs() < clear / 2.0, "{bw} {u}");
            prop_assert!((cw.to_num::<f64>() - v).abs() < clear / 2.0);
        }
    }

    #[test]
    fn steps_stay_between(a in 0.0..1000.0f64, b in 0.0..1000.0f64, log2 in 0u32..=4) {
        let (a, b) = (I16F16::from_num(a), I16F16::from_num(b));
        let step = <Fixed as Arithmetic>::step(a, b, log2);
        prop_assert_eq!(Fixed::steps(a, step, 0), a);
        for n in 0..=1u16 << log2 {
            let between = Fixed::steps(a, step, n);
            prop_assert!((a.min(b)..=a.max(b)).contains(&between));
            let part = f64::from(n) / f64::from(1u32 << log2);
            let exact = a.to_num::<f64>() * (1.0 - part) + b.to_num::<f64>() * part;
            // each step may be a bit short
            prop_assert!((between.to_num::<f64>() - exact).abs() * 65536.0 <= f64::from(n));
        }
    }

    #[test]
    fn dimming(r in 0.0..1000.0f64, w in 0.0..15.9f64) {
        let (r, w) = (make::radiance(r).unwrap(), make::weight(w).unwrap());
        let exact = r.to_num::<f64>() * w.to_num::<f64>();
        prop_assert!((Fixed::dim(r, w).to_num::<f64>() - exact).abs() <= 2.0 * LSB);
    }

    #[test]
    fn light_falls_off(intensity in 1e-3..1e6f64, distance in 0.05..900.0f64) {
        let i = make::intensity(intensity).unwrap();
        let v = lengths_of([distance * 0.6, 0.0, distance * 0.8]);
        let got = Fixed::falloff(&i, &Fixed::normalize(&v).2).to_num::<f64>();
        let exact = (intensity / distance / distance).min(1024.0);
        prop_assert!((got - exact).abs() <= exact * 6e-4 + 2.0 * LSB, "{got} {exact}");
        let got = Fixed::constant(&i).to_num::<f64>();
        prop_assert!((got - intensity.min(1024.0)).abs() <= intensity.min(1024.0) * 1e-4 + LSB);
    }

    #[test]
    fn relations_and_portions(a in 0.0..1000.0f64, b in 0.01..1000.0f64, part: u32) {
        let (a, b) = (make::radiance(a).unwrap(), make::radiance(b).unwrap());
        let exact = (a.to_num::<f64>() / b.to_num::<f64>()).min(15.99);
        let got = Fixed::relative(a, b).to_num::<f64>();
        prop_assert!((got - exact).abs() < 1.0 / 16384.0, "{got} {exact}");
        let exact = a.to_num::<f64>() * f64::from(part) / 4294967296.0;
        let got = Fixed::portion(a, part).to_num::<f64>();
        prop_assert!(got <= exact && exact - got < LSB);
    }

    #[test]
    fn shares(a in -1.0..1.0f64, distance in 0.02..900.0f64) {
        let v = lengths_of([distance * 0.6, 0.0, distance * 0.8]);
        let inverse = Fixed::normalize(&v).2;
        let a = make::length(a * distance).unwrap();
        let exact = a.to_num::<f64>() / distance;
        let got = Fixed::share(a, &inverse).to_num::<f64>();
        prop_assert!((got - exact).abs() < 2e-4 + 2.0 * LSB / distance, "{got} {exact}");
    }

    #[test]
    fn cells(x in -500.0..500.0f64, side in 0.05..20.0f64) {
        let (x, per) = (make::length(x).unwrap(), make::length(1.0 / side).unwrap());
        let cell = x.to_num::<f64>() * per.to_num::<f64>();
        prop_assert_eq!(Fixed::odd(x, per), cell.floor().rem_euclid(2.0) == 1.0);
    }

    #[test]
    fn spans_to_14_bits(left in 0.0..1.0f64, d in 0.0002..1.0f64, m in 128i32..256, unit in 0u8..12) {
        let cell = m << (6 + unit);
        let left = (left * f64::from(cell)) as i32;
        let d = make::unit(d).unwrap();
        let (exit, whole) = Fixed::spans(I16F16::from_bits(left), I16F16::from_bits(cell), &Fixed::pace(d), unit);
        for (found, way) in [(exit, left), (whole, cell)] {
            let exact = f64::from(way) / f64::from(1 << unit) / d.to_num::<f64>();
            let wrong = exact * 2e-5 + 1.0 + 1.0 / d.to_num::<f64>();
            prop_assert!((f64::from(found) - exact).abs() <= wrong, "{found} {exact}");
        }
    }

    #[test]
    fn whole_cells(o in -3.0..9.0f64, near in -4i32..4, m in 128u8..=255, unit in 0u8..14) {
        let cell = i32::from(m) << (6 + unit);
        let per = make::per_cell(m, 6 + unit, 0);
        for o in [(o * f64::from(cell)) as i32, o as i32 * cell + near] {
            let found = Fixed::cells_before(I16F16::from_bits(o), per, 7, unit);
            let exact = if o < 0 { 0 } else { (o / cell) as u32 };
            // Beyond the last cell nobody asks.
            if exact < 8 {
                prop_assert_eq!(found, exact);
            }
        }
    }

    #[test]
    fn how_large_a_view_vector_is_changes_no_bit(
        v in prop::array::uniform3(-(1i32 << 30)..=(1 << 30)), down in 0u32..30, other in 0u8..32,
    ) {
        let v = v.map(|x| Aim::from_bits(x >> down));
        let own = Fixed::sight(&v, Fixed::rise(&v));
        prop_assert_eq!(own, Fixed::sight(&v, other));
    }
}

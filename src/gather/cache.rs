//! The irradiance cache: diffuse interreflection from few records, interpolated.
//!
//! Ward, Rubinstein, Clear, "A ray tracing solution for diffuse interreflection", 1988: the
//! irradiance that other surfaces send changes slowly, so it is computed at few points and
//! interpolated. A record with the harmonic mean R of the distances to what its hemisphere sees
//! may be wrong, at a point x with the normal N, by about
//!
//! ε = |x − xᵢ|/R + √(1 − N·Nᵢ),
//!
//! and is used where ε is below a limit a. (√(1 − N·Nᵢ) = |N − Nᵢ|/√2, which doesn't cancel.) The
//! weights are (1 − ε/a)² rather than Ward's 1/ε: they vanish at the border, so that no edge shows
//! there (like those of Tabellion and Lamorlette, "An approximate global illumination system for
//! computer generated films", 2004). Gradients (Ward and Heckbert, "Irradiance gradients", 1992)
//! extrapolate: Eᵢ·(1 + (Nᵢ × N)·∇ᵣ + (x − xᵢ)·∇ₜ).

use super::hemisphere::cross;
use super::order::{near, on_the_way};
use super::record::{PackedRgb, Record};
use crate::math::{Arithmetic, Rgb, for_each_arithmetic, rgb, sub};
use crate::shape::{ShapeError, ok_or_panic, some_or};

/// How much farther a record counts when a picture is rendered than when the cache is filled: so
/// far that neighbours overlap.
pub(crate) const OVERLAP: f64 = 1.5;

/// Irradiance records, and how they are interpolated. Read-only: whoever asks, in whatever order,
/// gets the same.
///
/// A point asks those that may reach it: [`Gatherer`](super::Gatherer) leaves records in an order in which
/// they are found by halving, without any memory but some on the stack. Records in another order, as they
/// may stand in a `static` or a blob, are asked one by one, to the same result for that order. One that
/// reaches the point takes some hundred instructions; there are about half a dozen. Where none does, the
/// one of the least error counts.
#[derive(Clone, Copy, Debug)]
pub struct IrradianceCache<'a, A: Arithmetic> {
    records: &'a [Record<A>],
    /// How many of them, from the first, are in the order of `order.rs`.
    arranged: usize,
    /// 1/(√2·a), a being the limit of the error with the overlap in it.
    sharpness: A::Weight,
    full: bool,
}

/// What a record says at a point.
struct Said<A: Arithmetic> {
    /// 8·(1 − ε/a)² + 1/16.
    weight: A::Weight,
    /// 1 and what the gradients add.
    factor: A::Weight,
}

impl<'a, A: Arithmetic> IrradianceCache<'a, A> {
    pub(crate) fn of(
        records: &'a [Record<A>],
        arranged: usize,
        sharpness: A::Weight,
        full: bool,
    ) -> Self {
        Self { records, arranged, sharpness, full }
    }

    /// How many records, from the first, are found by halving.
    #[cfg(test)]
    pub(super) fn arranged(&self) -> usize {
        self.arranged
    }

    /// The records in order, and the others.
    #[inline(always)]
    fn parts(&self) -> (&'a [Record<A>], &'a [Record<A>]) {
        self.records.split_at_checked(self.arranged).unwrap_or((&[], self.records))
    }

    /// Shows `each` what may reach a point, in the order of the records, until it has seen enough.
    #[inline(always)]
    fn near(&self, p: &[A::Length; 3], mut each: impl FnMut(&Record<A>) -> bool) {
        let (arranged, others) = self.parts();
        let mut enough = false;
        near(
            arranged,
            p,
            |first| first.reach,
            |record| {
                enough = each(record);
                enough
            },
        );
        for record in others {
            if enough {
                return;
            }
            enough = each(record);
        }
    }

    /// The records.
    pub fn records(&self) -> &'a [Record<A>] {
        self.records
    }

    /// Whether the pool was full before every point that was to be covered was: where nothing is
    /// within reach, the record of the least error counts.
    pub fn is_full(&self) -> bool {
        self.full
    }

    /// Whether a record's error at a point is below the limit without the overlap.
    pub(crate) fn covers(&self, p: &[A::Length; 3], normal: &[A::Unit; 3]) -> bool {
        // ε/a below 2/3: a weight above 8/9 + 1/16
        let enough = A::weight_of(A::fraction(62_350));
        let mut covered = false;
        self.near(p, |record| {
            covered = self.ask(record, p, normal).is_some_and(|said| said.weight > enough);
            covered
        });
        covered
    }

    #[inline(always)]
    fn ask(
        &self,
        record: &Record<A>,
        p: &[A::Length; 3],
        normal: &[A::Unit; 3],
    ) -> Option<Said<A>> {
        let v = sub(p, &record.position);
        let reach = record.reach;
        if v[0] >= reach || v[1] >= reach || v[2] >= reach {
            return None;
        }
        let back = -reach;
        if v[0] <= back || v[1] <= back || v[2] <= back {
            return None;
        }
        self.weigh(record, &v, normal)
    }

    /// What a record says that isn't farther along any axis than its reach.
    #[inline(never)]
    fn weigh(
        &self,
        record: &Record<A>,
        v: &[A::Length; 3],
        normal: &[A::Unit; 3],
    ) -> Option<Said<A>> {
        let own = record.normal();
        // 60° at most, so that the cross product and the weights stay in their range.
        if A::dot(normal, &own) < A::fraction(0x8000) {
            return None;
        }
        let (_, _, inverse) = A::normalize(&[record.reach, A::NO_LENGTH, A::NO_LENGTH]);
        let t = v.map(|v| A::share(v, &inverse));
        let (_, away) = A::renormalize(&t);
        let mut error = A::weight_of(away);
        if error >= A::FULL {
            return None;
        }
        // On the same flat wall nothing bends: no more to reckon with, to the same bits.
        let bent = own != *normal;
        if bent {
            let (_, bend) = A::renormalize(&sub(normal, &own));
            error = error + A::weight(A::weight_of(bend), self.sharpness);
            if error >= A::FULL {
                return None;
            }
        }
        // What lies behind the record sees something else.
        let before = A::dot(&t, normal);
        let before = before + if bent { A::dot(&t, &own) } else { before };
        if before < A::fraction(-0x2000) {
            return None;
        }
        let small = |g: &[i8; 3], one: i32| {
            let f = |i: usize| A::fraction(i32::from(g[i]).wrapping_mul(one));
            [f(0), f(1), f(2)]
        };
        // 65536/127, 65536/126: the rotation counts twice
        let slope = A::dot(&t, &small(&record.translation_q7, 516));
        let mut change = A::weight_of(slope);
        if bent {
            let turn = A::dot(&cross::<A>(&own, normal), &small(&record.rotation_q6, 520));
            change = change + A::weight_of(turn + turn);
        }
        let most = A::weight_of(A::fraction(0xe000));
        let change = if change > most { most } else { change };
        let change = if change < -most { -most } else { change };
        let weight = A::weight(A::FULL - error, A::FULL - error);
        let weight = weight + weight;
        let weight = weight + weight;
        let floor = A::weight_of(A::fraction(0x1000));
        Some(Said { weight: weight + weight + floor, factor: A::FULL + change })
    }

    /// The irradiance divided by π at a point with a normal.
    #[inline(never)]
    pub(crate) fn irradiance(&self, p: [A::Length; 3], normal: [A::Unit; 3]) -> Rgb<A::Radiance> {
        let mut sum = [A::BLACK; 3];
        let mut total = A::NO_WEIGHT;
        self.near(&p, |record| {
            if let Some(said) = self.ask(record, &p, &normal) {
                let factor = A::weight(said.weight, said.factor);
                let part = record.irradiance().map(|e| A::dim(e, factor));
                sum = rgb(&sum, &part, A::gather);
                total = total + said.weight;
            }
            false
        });
        if total > A::NO_WEIGHT {
            return sum.map(|sum| A::over_weight(sum, total));
        }
        self.least(&p, &normal)
    }

    /// The irradiance of the record that is likely to be the least wrong: the nearest, along the
    /// axes, of those whose normal is within 45°; of the others if there is none.
    #[inline(never)]
    fn least(&self, p: &[A::Length; 3], normal: &[A::Unit; 3]) -> Rgb<A::Radiance> {
        let mut best: Option<Least<A>> = None;
        let abs = |x: A::Length| if x < A::NO_LENGTH { -x } else { x };
        let measured = |record: &Record<A>| {
            let v = sub(p, &record.position);
            let turned = A::dot(normal, &record.normal()) < A::fraction(46_341);
            let irradiance = record.irradiance;
            Least { turned, away: abs(v[0]) + abs(v[1]) + abs(v[2]), irradiance }
        };
        let (arranged, others) = self.parts();
        // No farther than one that is good enough; anywhere, if none of those on the way is.
        let mut bound = None;
        on_the_way(arranged, p, |record| {
            let of = measured(record);
            if !of.turned && bound.is_none_or(|bound| of.away < bound) {
                bound = Some(of.away);
            }
        });
        let mut ask = |record: &Record<A>| {
            let of = measured(record);
            if best.is_none_or(|best| (of.turned, of.away) < (best.turned, best.away)) {
                best = Some(of);
            }
            false
        };
        match bound {
            Some(bound) => near(arranged, p, |_| bound, &mut ask),
            None => arranged.iter().for_each(|record| _ = ask(record)),
        }
        others.iter().for_each(|record| _ = ask(record));
        best.map_or([A::BLACK; 3], |best| best.irradiance.q16().map(A::from_q16))
    }
}

/// How wrong a record may be where none reaches.
#[derive(Clone, Copy)]
struct Least<A: Arithmetic> {
    turned: bool,
    away: A::Length,
    irradiance: PackedRgb,
}

for_each_arithmetic! {
    impl<'a> IrradianceCache<'a, A> {
        /// A cache of records, for `static`s; `error` is the limit a that it was filled with. Records as
        /// a filled cache [has](Self::records) them are found quickly.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(records: &'a [Record<A>], error: f64) -> Self {
            ok_or_panic!(Self::try_new(records, error))
        }

        /// A cache of records.
        ///
        /// # Errors
        /// A limit that isn't within 0.05 and 1.
        pub const fn try_new(records: &'a [Record<A>], error: f64) -> Result<Self, ShapeError> {
            if !(error >= 0.05 && error <= 1.0) {
                return Err(ShapeError::Coefficient);
            }
            let sharpness = 1.0 / (core::f64::consts::SQRT_2 * OVERLAP * error);
            let sharpness = some_or!(make::weight(sharpness), Coefficient);
            let arranged = if Record::<A>::are_arranged(records) { records.len() } else { 0 };
            Ok(Self { records, arranged, sharpness, full: false })
        }
    }
}

//! Filling an irradiance cache: a pass of its own, in a fixed order.
//!
//! 1. The camera's rays, coarse ones first, look for diffuse points that no record covers, also in
//!    mirrors and behind glass; each gets a record. With several bounces the rays that these
//!    records gather look likewise, so that there are records where the light comes from.
//! 2. What a record gathers is the mean over its hemisphere of the radiance that each ray finds:
//!    what the surface that is hit emits (if it isn't listed as a light), sends on of the lights,
//!    and mirrors. In the first pass k_amb·E_amb is added there; in each further pass, every record
//!    gathers again, and k_d times what the records of the pass before say is added instead.
//!
//! After the last pass the records don't change, so that bands, clips, order and threads can't
//! change a bit of the picture. When the pool is full no more are added.

use super::gradient::{Gradients, Seen, along, length};
use super::hemisphere::{MAX_RINGS, raised, tangents};
use super::order::arrange;
use super::record::PackedRgb;
use super::{Gathering, Indirect, IrradianceCache, Record};
use crate::math::{Arithmetic, hash, rgb, spread};
use crate::scene::uses::{self, has};
use crate::scene::{Camera, Scene, View};
use crate::shape::{Leaving, Ray};
use crate::tally::{RayKind, Tally};
use crate::trace::{Tracer, Work};
use core::fmt;

/// Why a cache can't be filled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum FillError {
    /// Several bounces need as many drafts as the pool holds records.
    Drafts {
        /// How many.
        needed: usize,
    },
    /// The depth is beyond what the working memory was made for.
    Depth {
        /// What there is memory for.
        max: u8,
    },
    /// The scene is tailored to have no cache.
    Tailored,
}

impl fmt::Display for FillError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Drafts { needed } => write!(f, "several bounces need {needed} drafts"),
            Self::Depth { max } => {
                write!(f, "gathering rays go deeper than the memory's {max}")
            }
            Self::Tailored => f.write_str("the scene is tailored to have no irradiance cache"),
        }
    }
}

impl core::error::Error for FillError {}

/// A specular path isn't followed farther than this in search of a diffuse surface.
const MAX_SPECULAR: u8 = 8;

/// Fills irradiance caches.
#[derive(Debug)]
pub struct Gatherer<'a, 'w, A: Arithmetic, const MAX_DEPTH: usize, T, const USES: u64> {
    scene: &'a Scene<'a, A, USES>,
    gathering: Gathering<A>,
    work: &'w mut Work<A, MAX_DEPTH>,
    tally: &'w mut T,
}

/// A record that is being made, and where its rays start: what several bounces need besides the
/// pool. 52 bytes in fixed point and `f32`.
#[derive(Clone, Copy, Debug)]
pub struct Draft<A: Arithmetic> {
    record: Record<A>,
    origin: [A::Length; 3],
    leaving: Leaving,
}

const _: () = assert!(size_of::<Draft<crate::math::Fixed>>() == 52);

impl<A: Arithmetic> Draft<A> {
    /// None yet: what the memory is initialised with.
    pub const NONE: Self =
        Self { record: Record::NONE, origin: [A::NO_LENGTH; 3], leaving: Leaving::NOTHING };
}

/// Where a record's rays start.
#[derive(Clone, Copy)]
pub(super) struct Place<A: Arithmetic> {
    pub(super) position: [A::Length; 3],
    pub(super) normal: [A::Unit; 3],
    pub(super) origin: [A::Length; 3],
    pub(super) leaving: Leaving,
}

/// The records so far.
struct Pool<'p, 's, A: Arithmetic> {
    records: &'p mut [Record<A>],
    drafts: &'s mut [Draft<A>],
    len: usize,
    /// How many are in an order in which they are found quickly.
    arranged: usize,
    full: bool,
}

impl<A: Arithmetic> Pool<'_, '_, A> {
    fn cache(&self, gathering: &Gathering<A>) -> IrradianceCache<'_, A> {
        let records = self.records.get(..self.len).unwrap_or(&[]);
        IrradianceCache::of(records, self.arranged, gathering.sharpness, self.full)
    }

    /// Puts all in that order. Drafts stay in the order in which they were made, and with them the
    /// directions of their rays.
    fn arrange(&mut self) {
        self.arranged = arrange(self.records.get_mut(..self.len).unwrap_or(&mut []));
    }

    fn push(&mut self, record: Record<A>, place: &Place<A>) {
        if let Some(to) = self.records.get_mut(self.len) {
            *to = record;
            if let Some(draft) = self.drafts.get_mut(self.len) {
                *draft = Draft { record, origin: place.origin, leaving: place.leaving };
            }
            self.len += 1;
        }
        // New ones lie behind and are asked one by one, until they are half as many as the others and
        // a few: so putting them in order is done seldom.
        if self.len.wrapping_sub(self.arranged) > self.arranged / 2 + 32 {
            self.arrange();
        }
    }
}

impl<'a, 'w, A: Arithmetic, const MAX_DEPTH: usize, T: Tally, const USES: u64>
    Gatherer<'a, 'w, A, MAX_DEPTH, T, USES>
{
    /// What gathers in a scene; a cache or virtual lights that it has already are left out.
    ///
    /// # Errors
    /// A depth that the memory isn't made for, a scene that is tailored to have no cache.
    pub fn new(
        scene: &'a Scene<'a, A, USES>,
        gathering: Gathering<A>,
        work: &'w mut Work<A, MAX_DEPTH>,
        tally: &'w mut T,
    ) -> Result<Self, FillError> {
        if usize::from(gathering.depth) > MAX_DEPTH {
            let max = if MAX_DEPTH > 255 { 255 } else { MAX_DEPTH as u8 };
            return Err(FillError::Depth { max });
        }
        if !has(USES, uses::IRRADIANCE_CACHE) {
            return Err(FillError::Tailored);
        }
        Ok(Self { scene, gathering, work, tally })
    }

    /// Fills a pool for the pictures that a camera takes at `width`×`height` pixels. There are as
    /// many drafts as the pool holds records where there are several bounces, and none otherwise;
    /// what either holds doesn't matter.
    ///
    /// # Errors
    /// Too few drafts.
    pub fn fill<'p>(
        &mut self,
        camera: &Camera<A>,
        (width, height): (u16, u16),
        pool: &'p mut [Record<A>],
        drafts: &mut [Draft<A>],
    ) -> Result<IrradianceCache<'p, A>, FillError> {
        let bounces = self.gathering.bounces;
        if bounces > 1 && drafts.len() < pool.len() {
            return Err(FillError::Drafts { needed: pool.len() });
        }
        let mut pool = Pool { records: pool, drafts, len: 0, arranged: 0, full: false };
        let view = View::new(camera, width, height);
        let mut step = u16::from(self.gathering.coarse);
        let fine = u16::from(self.gathering.fine).max(1);
        while step >= fine && !pool.full {
            for y in (step / 2..height).step_by(usize::from(step)) {
                let row = view.row(y, 128);
                for x in (step / 2..width).step_by(usize::from(step)) {
                    self.look(RayKind::Primary, view.ray(&row, x, 128), &mut pool);
                }
            }
            step /= 2;
        }
        if bounces > 1 {
            self.spread(&mut pool);
        }
        pool.arrange();
        for _ in 1..bounces {
            self.again(&mut pool);
        }
        let Pool { records, len, arranged, full, .. } = pool;
        let records = records.get(..len).unwrap_or(&[]);
        Ok(IrradianceCache::of(records, arranged, self.gathering.sharpness, full))
    }

    /// Follows a ray to diffuse surfaces, and gives them records where there are none.
    fn look(&mut self, kind: RayKind, ray: Ray<A>, pool: &mut Pool<'_, '_, A>) {
        // The camera sees past a light that isn't visible; light from surface to surface doesn't.
        let tracer = match kind {
            RayKind::Primary => Tracer::new(self.scene, 1),
            _ => Tracer::gathering(self.scene, 1),
        };
        let mut way = Some((kind, ray));
        for _ in 0..MAX_SPECULAR {
            let Some((kind, ray)) = way else { return };
            let Some(site) = tracer.site(kind, ray, self.work, self.tally) else { return };
            let (position, normal) = (site.position, site.surface.normal);
            if site.is_diffuse() && !pool.cache(&self.gathering).covers(&position, &normal) {
                if pool.len >= pool.records.len() {
                    pool.full = true;
                    return;
                }
                let Ray { origin, leaving, .. } = site.outside;
                let place = Place { position, normal, origin, leaving };
                let scene = self.scene.lit_by(Indirect::None);
                let record = self.gather(&scene, &place, pool.len);
                pool.push(record, &place);
            }
            way = site.next;
        }
    }

    /// Lets the rays of each record look, also of those that this adds.
    fn spread(&mut self, pool: &mut Pool<'_, '_, A>) {
        let strata = self.gathering.strata;
        let mut index = 0;
        while index < pool.len && !pool.full {
            let Some(draft) = pool.drafts.get(index) else { return };
            let Draft { origin, leaving, .. } = *draft;
            let normal = draft.record.normal();
            let frame = tangents::<A>(&normal);
            let seed = self.seed(index);
            for sector in 0..strata.sectors {
                for ring in 0..strata.rings {
                    let up = strata.direction(ring, sector, seed);
                    let direction = raised::<A>(up, &frame, &normal);
                    self.look(RayKind::Ambient, Ray { origin, direction, leaving }, pool);
                }
            }
            index += 1;
        }
    }

    /// Lets every record gather again what the others say.
    fn again(&mut self, pool: &mut Pool<'_, '_, A>) {
        for index in 0..pool.len {
            let Some(&Draft { record, origin, leaving }) = pool.drafts.get(index) else { return };
            let (position, normal) = (record.position, record.normal());
            let place = Place { position, normal, origin, leaving };
            let scene = self.scene.lit_by(Indirect::Cache(pool.cache(&self.gathering)));
            let record = self.gather(&scene, &place, index);
            if let Some(draft) = pool.drafts.get_mut(index) {
                draft.record = record;
            }
        }
        for (to, from) in pool.records.iter_mut().zip(&*pool.drafts).take(pool.len) {
            *to = from.record;
        }
        pool.arrange();
    }

    fn seed(&self, index: usize) -> u32 {
        hash(u32::from(self.gathering.seed) << 16 ^ index as u32)
    }

    /// The record at a place.
    pub(super) fn gather(
        &mut self,
        scene: &Scene<'_, A, USES>,
        place: &Place<A>,
        index: usize,
    ) -> Record<A> {
        let Gathering { strata, nearest, farthest, .. } = self.gathering;
        let Place { position, normal, origin, leaving } = *place;
        let tracer = Tracer::gathering(scene, self.gathering.depth);
        let frame = tangents::<A>(&normal);
        let seed = self.seed(index);
        let most_near = A::ratio_q16(farthest, nearest).saturating_mul(4);
        let mut sum = [A::BLACK; 3];
        let mut gradients = Gradients::new(strata);
        // Σ farthest/r
        let mut near_q16 = 0u64;
        for sector in 0..strata.sectors {
            let mut seen = [Seen::default(); MAX_RINGS];
            for (ring, seen) in (0..strata.rings).zip(&mut seen) {
                let up = strata.direction(ring, sector, seed);
                let direction = raised::<A>(up, &frame, &normal);
                let ray = Ray { origin, direction, leaving };
                let key = hash(spread(seed, sector << 8 | ring));
                let (radiance, distance) = tracer.with_key(key).gather(ray, self.work, self.tally);
                sum = rgb(&sum, &radiance, A::gather);
                let [r, g, b] = radiance.map(|c| A::to_q16(c) >> 2);
                let near = A::ratio_q16(farthest, distance).min(most_near);
                near_q16 = near_q16.wrapping_add(u64::from(near));
                *seen =
                    Seen { radiance_q16: r.wrapping_add(g + g).wrapping_add(b), near_q16: near };
            }
            gradients.sector(sector, seen);
        }
        let irradiance = sum.map(|sum| A::mean(sum, strata.count() as u16)).map(A::to_q16);
        let [r, g, b] = irradiance.map(|c| c >> 2);
        let [translation, rotation] = gradients.relative(r.wrapping_add(g + g).wrapping_add(b));

        // R = farthest/(mean of farthest/r), no longer than the way on which the gradient would
        // add or take all there is
        let count = u64::from(strata.count());
        let mean_q16 = near_q16.checked_div(count).unwrap_or(0).min(1 << 28) as i32;
        let over = |q16: i32| A::ratio(farthest, A::fraction(q16));
        let clamp = |r: A::Length| {
            let r = if r > farthest { farthest } else { r };
            if r < nearest { nearest } else { r }
        };
        let slope_q16 = length(&translation);
        let harmonic = over(mean_q16);
        let steep = over(slope_q16);
        let radius = clamp(if steep < harmonic { steep } else { harmonic });
        let reach = A::scale(radius, self.gathering.half_limit);
        let reach = reach + reach;

        // The gradients along the axes, the translational one for the reach instead of `farthest`.
        let part_q16 = A::ratio_q16(reach, farthest) as i32;
        let shorter = |x: i32| (i64::from(x).wrapping_mul(i64::from(part_q16)) >> 16) as i32;
        Record {
            position,
            reach,
            irradiance: PackedRgb::new(irradiance),
            normal_q14: normal.map(|n| (A::to_q17(n) >> 3) as i16),
            translation_q7: along::<A>(&frame, translation.map(shorter), 1 << 16),
            rotation_q6: along::<A>(&frame, rotation, 1 << 17),
        }
    }
}

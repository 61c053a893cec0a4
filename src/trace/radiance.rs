//! The radiance along a ray: Whitted's tree of rays, without recursion.
//!
//! A ray's hit adds its own terms to the pixel, weighted by the product of the coefficients
//! down the tree, and sends at most two rays. One is followed at once, the other waits on a
//! stack; since a waiting ray is as deep as its sibling, no more than MAX_DEPTH − 1 ever wait.

use super::area::front_before;
use super::detail::{self, bumped, painted};
use super::direct::{Shading, direct};
use super::indirect::{Spot, indirect};
use super::meet::{Place, surface_at};
use super::nearest::{Hit, nearest};
use super::sight::{Ahead, Vantage, knows_all, may_be_few};
use super::terms::Terms;
use super::tracer::{Start, Tracer};
use super::work::Work;
use crate::math::{Arithmetic, Rgb, largest, neg, rgb};
use crate::scene::uses::{self, grey, has, has_indirect, splits_shading};
use crate::scene::{Scene, SceneRef};
use crate::shape::{Leaving, Meeting, Ray};
use crate::tally::{RayKind, Tally, Term};

/// A ray with its place in the tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Path<A: Arithmetic> {
    ray: Ray<A>,
    /// The product of the coefficients down the tree.
    weight: Rgb<A::Weight>,
    depth: u8,
    /// Where the ray comes from.
    vantage: Vantage,
}

impl<A: Arithmetic> Path<A> {
    pub(super) const NONE: Self = Self {
        ray: Ray {
            origin: [A::NO_LENGTH; 3],
            direction: [A::NO_UNIT; 3],
            leaving: Leaving::NOTHING,
        },
        weight: [A::NO_WEIGHT; 3],
        depth: 0,
        vantage: Vantage::ANYWHERE,
    };

    /// The same, of a scene that uses no more than its type says: what is always the same needn't
    /// be carried along.
    #[inline(always)]
    fn tailored<const USES: u64>(mut self) -> Self {
        self.weight = grey::<A, USES>(&self.weight);
        if !has(USES, uses::SOLIDS) {
            self.ray.leaving.part = 0;
        }
        self
    }
}

/// From the key of a ray to that of the next: odd, so that all differ.
const RAY_STEP: u32 = 0xc2b2_ae3d;

impl<'s, A, S, const USES: u64> Tracer<S>
where
    A: Arithmetic,
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    #[inline(always)]
    fn gathers(&self) -> bool {
        has(USES, uses::IRRADIANCE_CACHE) && self.gathering
    }

    /// Where a ray ends that gathers irradiance and finds the front of an area light that nobody
    /// sees before anything else.
    #[inline(always)]
    fn ends_at_light(&self, ray: &Ray<A>, found: &Option<Hit<A>>) -> Option<A::Length> {
        if !self.gathers() {
            return None;
        }
        front_before(&self.scene, ray, found.map_or(A::FAR, |hit| hit.distance))
    }

    /// The background's radiance in a direction, if it counts.
    #[inline(always)]
    fn background(&self, direction: &[A::Unit; 3]) -> Rgb<A::Radiance> {
        if has(USES, uses::TERMS) && !self.terms.has(Terms::BACKGROUND) {
            [A::BLACK; 3]
        } else {
            self.scene.parts.background.radiance::<USES>(direction)
        }
    }

    /// The radiance along a ray, and, for one that gathers, the distance to what it hits.
    #[inline(always)]
    pub(super) fn follow<T: Tally, const MAX_DEPTH: usize>(
        &self,
        ray: Ray<A>,
        start: Start,
        work: &mut Work<A, MAX_DEPTH>,
        tally: &mut T,
    ) -> (Rgb<A::Radiance>, A::Length) {
        let (seen, clear) = match start {
            Start::Anywhere => (false, false),
            Start::Eye { clear } => (true, clear),
        };
        let mut kind = if self.gathers() { RayKind::Ambient } else { RayKind::Primary };
        let vantage = if may_be_few::<USES>() && seen { Vantage::EYE } else { Vantage::ANYWHERE };
        let mut path = Path { ray, weight: [A::FULL; 3], depth: 1, vantage };
        let mut first = A::FAR;
        let mut sum = [A::BLACK; 3];
        let mut waiting = 0usize;
        // A number for each ray of the tree, in the order in which they are traced.
        let mut key = self.key;
        tally.ray(kind, path.depth, &path.ray, &path.weight);
        // A search of its own for the first ray: a good part of the tracing is done by then.
        let sight = Ahead { sight: work.sights.from(path.vantage), clear };
        let mut found =
            nearest(self.scene, &path.ray, A::FAR, sight, &mut work.scratch.walk, tally);
        if found.is_none() {
            if let Some(distance) = self.ends_at_light(&path.ray, &found) {
                return (sum, distance);
            }
            let radiance = self.background(&path.ray.direction);
            tally.term::<A>(Term::Background, &radiance);
            return (radiance, first);
        }
        loop {
            if uses::has_random(USES) {
                key = key.wrapping_add(RAY_STEP);
            }
            let next = if let Some(distance) = self.ends_at_light(&path.ray, &found) {
                if kind == RayKind::Ambient {
                    first = distance;
                }
                None
            } else {
                match found {
                    None => {
                        let background = self.background(&path.ray.direction);
                        let weight = grey::<A, USES>(&path.weight);
                        let radiance = rgb(&background, &weight, A::dim);
                        tally.term::<A>(Term::Background, &radiance);
                        sum = rgb(&sum, &radiance, A::gather);
                        None
                    }
                    Some(hit) => {
                        tally.hit::<A>(kind, hit.shape, hit.distance);
                        if has(USES, uses::IRRADIANCE_CACHE) && kind == RayKind::Ambient {
                            first = hit.distance;
                        }
                        let key = (key, seen);
                        self.shade_hit(&mut path, &hit, key, &mut sum, work, &mut waiting, tally)
                    }
                }
            };
            kind = match next {
                Some(kind) => kind,
                None if waiting == 0 => return (sum, first),
                None => {
                    waiting -= 1;
                    match work.waiting.get(waiting) {
                        Some(next) => path = next.tailored::<USES>(),
                        None => return (sum, first),
                    }
                    RayKind::Transmission
                }
            };
            tally.ray(kind, path.depth, &path.ray, &path.weight);
            let sight = Ahead { sight: work.sights.from(path.vantage), clear: false };
            found = nearest(self.scene, &path.ray, A::FAR, sight, &mut work.scratch.walk, tally);
        }
    }

    /// The same, in line if the compiler thinks so.
    #[inline]
    pub(super) fn follow_by_call<const SITE: u8, T: Tally, const MAX_DEPTH: usize>(
        &self,
        ray: Ray<A>,
        start: Start,
        work: &mut Work<A, MAX_DEPTH>,
        tally: &mut T,
    ) -> (Rgb<A::Radiance>, A::Length) {
        self.follow(ray, start, work, tally)
    }

    /// Shades a hit, see [`shade`](Self::shade). Where spheres and planes have a copy of the shading each, most is
    /// known of a plane before.
    #[inline(always)]
    #[allow(clippy::too_many_arguments, reason = "in line, none is passed")]
    fn shade_hit<T: Tally, const MAX_DEPTH: usize>(
        &self,
        path: &mut Path<A>,
        hit: &Hit<A>,
        from: (u32, bool),
        sum: &mut Rgb<A::Radiance>,
        work: &mut Work<A, MAX_DEPTH>,
        waiting: &mut usize,
        tally: &mut T,
    ) -> Option<RayKind> {
        let scene = self.scene;
        let mut p = A::along(&path.ray.origin, hit.distance, &path.ray.direction);
        let meeting = Meeting { distance: hit.distance, detail: hit.detail };
        if !splits_shading(USES) {
            let place = surface_at(&scene, hit.shape, &path.ray, &meeting, &mut p)?;
            return self.shade(path, hit, (place, p), from, sum, work, waiting, tally);
        }
        if let Some(sphere) = scene.shapes.spheres.get(hit.shape as usize) {
            let place = Place::on_sphere(sphere, &path.ray, &meeting, &mut p);
            self.shade(path, hit, (place, p), from, sum, work, waiting, tally)
        } else {
            let plane =
                scene.parts.planes.get(hit.shape.wrapping_sub(scene.first_plane) as usize)?;
            let place = Place::on_plane::<USES>(plane, &path.ray, &meeting, &mut p);
            self.shade(path, hit, (place, p), from, sum, work, waiting, tally)
        }
    }

    /// Adds the terms of a hit; turns `path` into the next ray to follow, if there is one, and says
    /// of which kind it is. Of two, the one that passes through has to wait.
    #[inline(always)]
    #[allow(clippy::too_many_arguments, reason = "in line, none is passed")]
    fn shade<T: Tally, const MAX_DEPTH: usize>(
        &self,
        path: &mut Path<A>,
        hit: &Hit<A>,
        (place, p): (Place<A>, [A::Length; 3]),
        (key, seen): (u32, bool),
        sum: &mut Rgb<A::Radiance>,
        work: &mut Work<A, MAX_DEPTH>,
        waiting: &mut usize,
        tally: &mut T,
    ) -> Option<RayKind> {
        let scene = self.scene;
        let (mut surface, mut mirror) = (place.surface, place.mirror);
        let material = scene.material_at(place.material, &place.local)?;

        // A textured material is one made for the point, so that nothing below need know.
        let made;
        let mut material = material;
        if has(USES, uses::TEXTURES)
            && let Some(texture) = material.texture()
        {
            made = painted(&scene, *material, texture, hit.shape, place.local);
            material = &made;
        }
        let is_bumped = has(USES, uses::BUMPS) && material.bump().is_some();
        if is_bumped && let Some(texture) = material.bump() {
            let direction = path.ray.direction;
            surface = bumped(&scene, texture, surface, hit.shape, place.local, direction);
            mirror = A::reflect(&path.ray.direction, &surface.normal, -surface.cosine);
        }
        if has(USES, uses::ABSORPTION)
            && let Some(absorption) = material.absorption()
        {
            let way = hit.distance;
            path.weight = detail::absorbed(&scene, absorption, surface.behind, way, path.weight);
        }

        let (some, whole) = (has(USES, uses::TERMS) && self.terms != Terms::ALL, material);
        let masked;
        let material = if some {
            masked = self.terms.of(whole);
            &masked
        } else {
            whole
        };

        if has(USES, uses::EMISSION)
            && material.emits
            && (!surface.behind || place.material.inside_only())
            && !(self.gathers() && scene.is_light(hit.shape))
        {
            let radiance = rgb(&material.emission, &path.weight, A::dim);
            tally.term::<A>(Term::Emission, &radiance);
            *sum = rgb(sum, &radiance, A::gather);
        }

        let outside = Ray {
            origin: place.outside,
            direction: mirror,
            leaving: Leaving::back(hit.shape, &surface),
        };
        let (share, irradiance, term) = if has_indirect(USES)
            && let Some(irradiance) = indirect(
                scene,
                Spot {
                    ray: outside,
                    normal: surface.normal,
                    p,
                    depth: path.depth,
                    turn: self.turn,
                },
                &mut work.scratch,
                tally,
            ) {
            let left_out = some && !self.terms.has(Terms::INDIRECT);
            let share = if left_out { [A::NO_WEIGHT; 3] } else { whole.diffuse };
            (share, irradiance, Term::Indirect)
        } else {
            (material.ambient, scene.parts.ambient.0, Term::Ambient)
        };
        let above = grey::<A, USES>(&path.weight);
        let radiance = rgb(&rgb(&share, &above, A::weight), &irradiance, |w, e| A::dim(e, w));
        tally.term::<A>(term, &radiance);
        *sum = rgb(sum, &radiance, A::gather);

        let shading = Shading {
            surface: &surface,
            material,
            mirror: &mirror,
            shadow: outside,
            weight: &path.weight,
            depth: path.depth,
            highlights: !self.gathers(),
            key,
            sights: seen.then_some(&work.sights),
        };
        direct(scene, shading, sum, &mut work.scratch, tally);

        if path.depth >= self.depth {
            return None;
        }
        // A sphere's surface is where rays come from that leave it; what the first plane mirrors of what the eye
        // sees comes from the eye's image.
        let known = seen && knows_all::<USES>();
        let on_sphere = (hit.shape as usize) < scene.shapes.spheres.len();
        let sphere = if known && on_sphere && A::is_near(hit.distance) {
            Vantage::sphere(hit.shape)
        } else {
            Vantage::ANYWHERE
        };
        let image = known && hit.shape == scene.first_plane && path.depth == 1 && !is_bumped;
        let mirrored = if image { Vantage::IMAGE } else { sphere };
        let rules = &scene.parts.rules;
        path.depth += 1;
        let mut reflected = grey::<A, USES>(&material.reflection);
        let passed = grey::<A, USES>(&material.transmission);
        let mut next = None;
        let glass = has(USES, uses::TRANSMISSION) && material.transmits;
        let fresnel = has(USES, uses::FRESNEL) && material.fresnel;
        if glass || fresnel {
            let eta = if surface.behind { &material.eta[1] } else { &material.eta[0] };
            let direction = &path.ray.direction;
            match A::refract(direction, &surface.normal, surface.cosine, eta) {
                Some(direction) => {
                    let mut weight = rgb(&passed, &above, A::weight);
                    if fresnel {
                        let cosine = -A::cosine(&surface.normal, &direction);
                        let cosines = [A::weight_of(surface.cosine), positive::<A>(cosine)];
                        let share = detail::reflectance::<A>(cosines, A::eta_weight(eta));
                        reflected = reflected.map(|k| A::weight(k, share));
                        weight = weight.map(|w| A::weight(w, A::FULL - share));
                    }
                    if has(USES, uses::SPECULAR_COSINE) && rules.specular_cosine {
                        let cosine = -A::cosine(&surface.normal, &direction);
                        weight = weight.map(|w| A::weight(w, positive::<A>(cosine)));
                    }
                    if glass && largest(&weight) >= rules.cutoff {
                        path.ray = Ray {
                            origin: A::leave(&p, &neg(&surface.geometric), hit.distance),
                            direction,
                            leaving: Leaving::through(hit.shape, &surface),
                        };
                        path.weight = weight;
                        path.vantage = sphere;
                        next = Some(RayKind::Transmission);
                    }
                }
                // Nothing gets through: the mirror ray carries both, unless the scene says not. By
                // Fresnel's formula it already carries all of its own.
                None if !rules.lossy && !fresnel => {
                    reflected = rgb(&reflected, &passed, |a, b| a + b);
                }
                None => {}
            }
        }
        if (has(USES, uses::REFLECTION) && material.reflects)
            || (glass && largest(&reflected) > A::NO_WEIGHT)
            || (glass && has(USES, uses::TRANSMITTERS_REFLECT) && rules.transmitters_reflect)
        {
            let mut weight = rgb(&reflected, &above, A::weight);
            if has(USES, uses::SPECULAR_COSINE) && rules.specular_cosine {
                let cosine = A::weight_of(surface.cosine);
                weight = weight.map(|w| A::weight(w, cosine));
            }
            // An interpolated normal can mirror a ray into the surface.
            let outwards = !surface.smooth || A::dot(&mirror, &surface.geometric) > A::NO_UNIT;
            if largest(&weight) >= rules.cutoff && outwards {
                if next.is_some()
                    && let Some(place) = work.waiting.get_mut(*waiting)
                {
                    *place = *path;
                    *waiting += 1;
                }
                path.ray = outside;
                path.weight = weight;
                path.vantage = mirrored;
                next = Some(RayKind::Reflection);
            }
        }
        next
    }
}

#[inline(always)]
fn positive<A: Arithmetic>(w: A::Weight) -> A::Weight {
    if w < A::NO_WEIGHT { A::NO_WEIGHT } else { w }
}

//! Who traces: a scene, and what is the same for all rays of a picture.

use super::call_site;
use super::nearest::{Hit, nearest};
use super::sight::{Ahead, are_few, knows_all, pass_all};
use super::terms::Terms;
use super::work::Work;
use crate::math::{Arithmetic, Rgb};
use crate::scene::{Row, Scene, SceneRef, View};
use crate::shape::Ray;
use crate::tally::Tally;

/// Where a ray starts that is to be followed.
#[derive(Clone, Copy)]
pub(super) enum Start {
    /// Nothing is known.
    Anywhere,
    /// At the eye that the memory has looked from.
    Eye {
        /// The ray meets no sphere.
        clear: bool,
    },
}

/// Traces rays in a scene, to a depth that its memory was made for.
#[derive(Clone, Copy, Debug)]
pub struct Tracer<S> {
    pub(super) scene: S,
    pub(super) depth: u8,
    /// What is traced is gathered: light that arrives by way of a diffuse surface alone.
    pub(super) gathering: bool,
    pub(super) key: u32,
    pub(super) terms: Terms,
    /// Whose turn it is among virtual lights.
    pub(super) turn: u8,
}

impl<'s, A, S, const USES: u64> Tracer<S>
where
    A: Arithmetic,
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    /// A tracer for trees `depth` deep; at least 1, the camera's ray alone.
    #[inline(always)]
    pub fn new(scene: S, depth: u8) -> Self {
        Self { scene, depth, key: 0, turn: 0, gathering: false, terms: Terms::ALL }
    }

    /// A tracer for rays that gather irradiance: what they see of the lights is counted elsewhere.
    #[inline(always)]
    pub(crate) fn gathering(scene: S, depth: u8) -> Self {
        Self { gathering: true, ..Self::new(scene, depth) }
    }

    /// The same for a camera's ray of this [`Row::key`](crate::scene::Row::key): where what is
    /// random about the ray comes from.
    #[inline(always)]
    #[must_use]
    pub fn with_key(self, key: u32) -> Self {
        Self { key, ..self }
    }

    /// The same for a pixel at this [`Row::in_tile`](crate::scene::Row::in_tile): whose turn it is
    /// among virtual lights.
    #[inline(always)]
    #[must_use]
    pub fn with_turn(self, turn: u8) -> Self {
        Self { turn, ..self }
    }

    /// The same, adding up these terms alone; all, if the scene is tailored without
    /// [`uses::TERMS`](crate::scene::uses::TERMS).
    #[inline(always)]
    #[must_use]
    pub fn with_terms(self, terms: Terms) -> Self {
        Self { terms, ..self }
    }

    /// The place of the pixel whose rays follow: see [`with_turn`](Self::with_turn).
    #[inline(always)]
    pub(crate) fn set_turn(&mut self, turn: u8) {
        self.turn = turn;
    }

    #[inline(always)]
    pub(crate) fn set_key(&mut self, key: u32) {
        self.key = key;
    }

    /// The nearest hit along a ray, for tools that show more than radiance.
    pub fn nearest<T: Tally, const MAX_DEPTH: usize>(
        &self,
        ray: &Ray<A>,
        work: &mut Work<A, MAX_DEPTH>,
        tally: &mut T,
    ) -> Option<Hit<A>> {
        nearest(self.scene, ray, A::FAR, Ahead::ANYTHING, &mut work.scratch.walk, tally)
    }

    /// Whether no ray of a row meets a sphere, as far as that is worth knowing: where they are few, and known to
    /// stand in no tree.
    #[inline(always)]
    pub(crate) fn is_clear(&self, view: View<A>, row: Row<A>, width: u16) -> bool {
        knows_all::<USES>()
            && are_few(&self.scene)
            && pass_all(self.scene.shapes.spheres, view, row, width)
    }

    /// The radiance that comes back along a camera's ray. A tree deeper than the memory was
    /// made for is cut.
    #[inline(always)]
    pub fn radiance<T: Tally, const MAX_DEPTH: usize>(
        &self,
        ray: Ray<A>,
        work: &mut Work<A, MAX_DEPTH>,
        tally: &mut T,
    ) -> Rgb<A::Radiance> {
        self.follow_by_call::<{ call_site::ANY }, _, _>(ray, Start::Anywhere, work, tally).0
    }

    /// The same for a ray from the eye that `work` has [looked](Work::look) from, in this scene, at a
    /// [call site](call_site) of the caller's. `clear`: it is known to meet no sphere.
    #[inline(always)]
    pub(crate) fn seen<const SITE: u8, T: Tally, const MAX_DEPTH: usize>(
        &self,
        ray: Ray<A>,
        clear: bool,
        work: &mut Work<A, MAX_DEPTH>,
        tally: &mut T,
    ) -> Rgb<A::Radiance> {
        let start = Start::Eye { clear };
        if call_site::is_in_line::<SITE>() {
            self.follow(ray, start, work, tally).0
        } else {
            self.follow_by_call::<SITE, _, _>(ray, start, work, tally).0
        }
    }

    /// The radiance that a ray which gathers irradiance finds, and how far away.
    #[inline(always)]
    pub(crate) fn gather<T: Tally, const MAX_DEPTH: usize>(
        &self,
        ray: Ray<A>,
        work: &mut Work<A, MAX_DEPTH>,
        tally: &mut T,
    ) -> (Rgb<A::Radiance>, A::Length) {
        self.follow_by_call::<{ call_site::ANY }, _, _>(ray, Start::Anywhere, work, tally)
    }
}

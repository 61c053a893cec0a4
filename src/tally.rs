//! Counting and watching rays: a type parameter of the tracer, free when unused.

use crate::math::{Arithmetic, Rgb};
use crate::shape::Ray;

/// What a ray was sent for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// From the camera.
    Primary,
    /// Along the mirror direction.
    Reflection,
    /// Through a surface, by Snell's law.
    Transmission,
    /// Towards a light.
    Shadow,
    /// To gather irradiance.
    Ambient,
}

/// Which term of the radiance a contribution belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Term {
    /// The background, seen by a ray that hits nothing.
    Background,
    /// L_e of the surface.
    Emission,
    /// k_amb·E_amb.
    Ambient,
    /// k_d·E, the irradiance E coming from other surfaces: an irradiance cache, virtual lights.
    Indirect,
    /// Light `light` of the scene, diffuse and highlight; area lights are numbered after the
    /// others.
    Direct {
        /// Its index.
        light: u16,
    },
}

/// What the tracer reports. Every method does nothing unless overridden, and costs nothing then.
///
/// A tally that stands before another, as the samplers' does, hands every report on: a method added
/// here is added to `frame/sample.rs` too.
pub trait Tally: Sized {
    /// A tally of this type, if it counts nothing: the tracer then reports to that, and not to the renderer's.
    const NOTHING: Option<Self> = None;

    /// A ray is traced; `weight` is the product of the coefficients down the tree, and the
    /// camera's ray has depth 1.
    #[inline(always)]
    fn ray<A: Arithmetic>(
        &mut self,
        _kind: RayKind,
        _depth: u8,
        _ray: &Ray<A>,
        _weight: &Rgb<A::Weight>,
    ) {
    }

    /// The ray reported last hit the shape of this number after `distance`.
    #[inline(always)]
    fn hit<A: Arithmetic>(&mut self, _kind: RayKind, _shape: u32, _distance: A::Length) {}

    /// A contribution to the pixel, the weight down the tree included.
    #[inline(always)]
    fn term<A: Arithmetic>(&mut self, _term: Term, _radiance: &Rgb<A::Radiance>) {}

    /// Nothing of light `light`, which the surface faces, arrives at the hit of a ray of this depth.
    #[inline(always)]
    fn shadowed(&mut self, _light: u16, _depth: u8) {}

    /// A node of the octree is visited.
    #[inline(always)]
    fn node(&mut self) {}

    /// A shape is tested.
    #[inline(always)]
    fn test(&mut self) {}
}

impl Tally for () {
    const NOTHING: Option<Self> = Some(());
}

/// Counts by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Rays from the camera.
    pub primary: u64,
    /// Mirror rays.
    pub reflection: u64,
    /// Transmitted rays.
    pub transmission: u64,
    /// Rays towards lights.
    pub shadow: u64,
    /// Rays that gather irradiance.
    pub ambient: u64,
    /// Camera rays that hit something.
    pub primary_hits: u64,
    /// Shadow rays that were blocked.
    pub shadow_hits: u64,
    /// Nodes of the octree visited.
    pub nodes: u64,
    /// Shapes tested.
    pub tests: u64,
}

impl Counts {
    /// All rays.
    pub fn rays(&self) -> u64 {
        self.primary + self.reflection + self.transmission + self.shadow + self.ambient
    }
}

/// Counts all rays together, for deadlines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCount(pub u32);

impl Tally for RayCount {
    #[inline(always)]
    fn ray<A: Arithmetic>(&mut self, _: RayKind, _: u8, _: &Ray<A>, _: &Rgb<A::Weight>) {
        self.0 = self.0.wrapping_add(1);
    }
}

impl core::ops::AddAssign for Counts {
    fn add_assign(&mut self, other: Self) {
        self.primary += other.primary;
        self.reflection += other.reflection;
        self.transmission += other.transmission;
        self.shadow += other.shadow;
        self.ambient += other.ambient;
        self.primary_hits += other.primary_hits;
        self.shadow_hits += other.shadow_hits;
        self.nodes += other.nodes;
        self.tests += other.tests;
    }
}

impl Tally for Counts {
    #[inline(always)]
    fn ray<A: Arithmetic>(&mut self, kind: RayKind, _: u8, _: &Ray<A>, _: &Rgb<A::Weight>) {
        match kind {
            RayKind::Primary => self.primary += 1,
            RayKind::Reflection => self.reflection += 1,
            RayKind::Transmission => self.transmission += 1,
            RayKind::Shadow => self.shadow += 1,
            RayKind::Ambient => self.ambient += 1,
        }
    }

    #[inline(always)]
    fn hit<A: Arithmetic>(&mut self, kind: RayKind, _: u32, _: A::Length) {
        match kind {
            RayKind::Primary => self.primary_hits += 1,
            RayKind::Shadow => self.shadow_hits += 1,
            _ => {}
        }
    }

    #[inline(always)]
    fn node(&mut self) {
        self.nodes += 1;
    }

    #[inline(always)]
    fn test(&mut self) {
        self.tests += 1;
    }
}

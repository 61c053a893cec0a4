//! The scenes, once for each arithmetic.
//!
//! A scene's file is written over a type `A` that the module above it names, because a `static`
//! can't be generic. Each scene has a type of its own, which says what of the library it uses: a
//! firmware holds the code for that and no more.

#![allow(clippy::duplicate_mod, reason = "each arithmetic needs the scenes anew")]

mod fixed;
#[path = "f32.rs"]
mod float;

use whitted::frame::{Output, Sampling};
use whitted::math::{Arithmetic, Fixed};
use whitted::scene::{Camera, Scene};

use crate::job::SceneName;

/// A scene, and how it is to be seen.
pub struct Shot<A: Arithmetic, const USES: u64> {
    /// The scene.
    pub scene: &'static Scene<'static, A, USES>,
    /// Where from.
    pub camera: &'static Camera<A>,
    /// How deep the tree of rays may be.
    pub depth: u8,
    /// How radiance becomes pixels.
    pub output: Output,
}

/// What is to be done with a scene of any type: a closure that is generic.
pub trait View<A: Arithmetic> {
    /// What comes of it.
    type Output;

    /// Does it. To be inlined into [`view_parts`](Self::view_parts).
    fn view<const USES: u64>(self, shot: Shot<A, USES>) -> Self::Output;

    /// The same, given the shot's parts one by one: the compiler then sees that they are always the
    /// same statics, as they are in a firmware that draws but one scene, and reads them where they
    /// are used, so long as nothing else in the image traces the scene. Not inlined, so that the stack
    /// it takes is its own.
    #[inline(never)]
    fn view_parts<const USES: u64>(
        self,
        scene: &'static Scene<'static, A, USES>,
        camera: &'static Camera<A>,
        depth: u8,
        output: Output,
    ) -> Self::Output
    where
        Self: Sized,
    {
        self.view(Shot { scene, camera, depth, output })
    }
}

/// An arithmetic that the scenes are there in.
pub trait Shots: Arithmetic {
    /// Does something with the scene of a name.
    fn shot<V: View<Self>>(name: SceneName, view: V) -> V::Output;

    /// Does something with the limit scene, in a type that all samplings are compiled for; but for the
    /// sparse, where there is a type for that.
    fn sampled<V: View<Self>>(view: V) -> V::Output;

    /// The same, in a type that sparse sampling alone is compiled for where there is flash to spare.
    fn sparse<V: View<Self>>(view: V) -> V::Output;

    /// Does something with two mirrors that face each other, eight generations deep.
    fn mirrors<V: View<Self>>(view: V) -> V::Output;
}

/// What pictures of jobs may be sampled by.
const SAMPLINGS: u64 = Sampling::Corners.uses()
    | Sampling::Grid { side: 1 }.uses()
    | Sampling::ADAPTIVE.uses()
    | if SPARSE_APART { 0 } else { Sampling::SPARSE.uses() };

/// Whether sparse sampling has a type of its own: a copy of the tracer is ten thousand bytes.
const SPARSE_APART: bool = cfg!(any(feature = "counted", not(target_os = "none")));

impl Shots for Fixed {
    #[inline(always)]
    fn shot<V: View<Self>>(name: SceneName, view: V) -> V::Output {
        fixed::shot(name, view)
    }

    fn sampled<V: View<Self>>(view: V) -> V::Output {
        fixed::sampled(view)
    }

    fn sparse<V: View<Self>>(view: V) -> V::Output {
        fixed::sparse(view)
    }

    fn mirrors<V: View<Self>>(view: V) -> V::Output {
        fixed::mirrors(view)
    }
}

impl Shots for f32 {
    #[inline(always)]
    fn shot<V: View<Self>>(name: SceneName, view: V) -> V::Output {
        float::shot(name, view)
    }

    fn sampled<V: View<Self>>(view: V) -> V::Output {
        float::sampled(view)
    }

    fn sparse<V: View<Self>>(view: V) -> V::Output {
        float::sparse(view)
    }

    fn mirrors<V: View<Self>>(view: V) -> V::Output {
        float::mirrors(view)
    }
}

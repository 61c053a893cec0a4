//! The scenes, once for each arithmetic.
//!
//! A scene's file is written over a type `A` that the module above it names, because a `static`
//! can't be generic. Each scene has a type of its own, which says what of the library it uses: a
//! firmware holds the code for that and no more.

#![allow(clippy::duplicate_mod, reason = "each arithmetic needs the scenes anew")]

/// A type for each scene, so that the compiler knows it wherever it is traced.
macro_rules! scene_types {
    ($($name:ident = $module:ident;)*) => { $(
        whitted::scene_type! {
            struct $name: Scene<'static, A, { $module::PARTS.uses() }> = $module::SCENE;
        }
    )* };
}

mod fixed;
#[path = "f32.rs"]
mod float;

use whitted::frame::{Output, Sampling};
use whitted::math::{Arithmetic, Fixed};
use whitted::scene::{Camera, Scene, SceneRef};

use crate::job::SceneName;

/// A scene, and how it is to be seen.
pub struct Shot<A: Arithmetic, S> {
    /// The scene.
    pub scene: S,
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
    fn view<S, const USES: u64>(self, shot: Shot<A, S>) -> Self::Output
    where
        S: SceneRef<Target = Scene<'static, A, USES>>;

    /// The same, given the shot's parts one by one: the compiler then sees that the camera is always the
    /// same static, and reads it where it is used. Not inlined, so that the stack it takes is its own.
    /// On a PC all scenes are drawn by one copy of the tracer, so that nobody waits for many of them.
    #[inline(never)]
    fn view_parts<S, const USES: u64>(
        self,
        scene: S,
        camera: &'static Camera<A>,
        depth: u8,
        output: Output,
    ) -> Self::Output
    where
        Self: Sized,
        S: SceneRef<Target = Scene<'static, A, USES>>,
    {
        if cfg!(target_os = "none") {
            self.view(Shot { scene, camera, depth, output })
        } else {
            self.view_general(Shot { scene: &scene.general(), camera, depth, output })
        }
    }

    /// The same of a scene of whatever type.
    #[inline(never)]
    fn view_general(self, shot: Shot<A, &Scene<'static, A>>) -> Self::Output
    where
        Self: Sized,
    {
        self.view(shot)
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
pub const SPARSE_APART: bool = cfg!(any(feature = "sparse", not(target_os = "none")));

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

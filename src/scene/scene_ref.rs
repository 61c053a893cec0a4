//! How a scene is handed over: by reference, or as a type that stands for one `static`.

use super::{Scene, Shapes};
use crate::math::Arithmetic;
use core::ops::Deref;

/// What leads to a scene: `S: SceneRef<Target = Scene<'s, A, USES>>`.
///
/// A reference to a [`Scene`](super::Scene) does. So does a type made by [`scene_type!`](crate::scene_type), and
/// wherever rays are traced the compiler then knows which scene it is, and reads its numbers where they
/// are used: code that draws has fewer loads, and nothing is tested that the scene doesn't have. Of a
/// reference it knows that in code alone that it puts in line with the place where the reference was taken.
///
/// What this is implemented for leads to the same scene each time.
pub trait SceneRef: Copy + Deref {}

impl<S: Copy + Deref> SceneRef for S {}

/// Whether it is a type that stands for one scene: it has no size. What is out of line is compiled for each; for a
/// reference it is shared with the groups'.
pub(crate) const fn is_known<S>() -> bool {
    size_of::<S>() == 0
}

/// What leads to a scene's shapes, as a reference to those of a group does.
#[derive(Clone, Copy)]
pub(crate) struct ShapesOf<S>(pub(crate) S);

impl<'s, A, S, const USES: u64> Deref for ShapesOf<S>
where
    A: Arithmetic,
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    type Target = Shapes<'s, A>;

    #[inline(always)]
    fn deref(&self) -> &Shapes<'s, A> {
        &self.0.shapes
    }
}

/// Makes a type that stands for a scene in a `static`.
///
/// ```
/// use whitted::frame::{Renderer, Settings};
/// use whitted::math::Fixed;
/// use whitted::scene::{Camera, Parts, Scene};
/// use whitted::shape::Sphere;
/// use whitted::trace::Work;
///
/// const PARTS: Parts<'static, Fixed> = Parts {
///     spheres: &[Sphere::<Fixed>::new([0.0, 1.0, 4.0], 1.0, 0)],
///     materials: &[whitted::scene::Material::<Fixed>::new(whitted::scene::MaterialSpec::BLACK)],
///     ..Parts::EMPTY
/// };
/// static SCENE: Scene<Fixed, { PARTS.uses() }> = Scene::tailored(PARTS);
///
/// whitted::scene_type! {
///     /// A ball.
///     pub struct Ball: Scene<'static, Fixed, { PARTS.uses() }> = SCENE;
/// }
///
/// let camera = Camera::<Fixed>::look_at([0.0; 3], [0.0, 1.0, 4.0], [0.0, 1.0, 0.0], 60.0);
/// let mut work = Work::<Fixed, 1>::new();
/// let settings = Settings { depth: 1, ..Settings::new(80, 60) };
/// assert!(Renderer::new(Ball, &camera, settings, &mut work, &mut []).is_ok());
/// ```
#[macro_export]
macro_rules! scene_type {
    ($(#[$attribute:meta])* $visibility:vis struct $name:ident: $scene:ty = $place:path;) => {
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug)]
        $visibility struct $name;

        impl ::core::ops::Deref for $name {
            type Target = $scene;

            #[inline(always)]
            fn deref(&self) -> &$scene {
                &$place
            }
        }
    };
}

//! Fixed point. The scenes that are there to be counted.

#[path = "../../../boards/demo/src/scenes/gfxcat.rs"]
mod gfxcat;
#[path = "../../../boards/demo/src/scenes/spheres64.rs"]
mod spheres64;

use crate::common::scenes::Tailored;

type A = whitted::math::Fixed;

pub(crate) fn tailored(view: &mut impl Tailored<A>) {
    view.scene("gfxcat", &gfxcat::SCENE, &gfxcat::CAMERA);
    view.scene("spheres64", &spheres64::SCENE, &spheres64::CAMERA);
}

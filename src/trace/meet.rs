//! A ray and one shape, found by its number.
//!
//! Spheres and planes are tested in line, since the smallest scenes are made of them; the other
//! kinds here, once, out of line: their code is shared, and the short loops keep the registers.

use crate::math::Arithmetic;
use crate::scene::uses::{self, has};
use crate::scene::{Scene, Shapes, with_shape};
use crate::shape::{MaterialId, Meeting, Ray, Shape, Surface};

/// Where a ray meets a shape, unless it is one that the ray leaves and can't meet again.
#[inline(always)]
pub(super) fn meet<A: Arithmetic, S: Shape<A>>(
    shape: &S,
    id: u32,
    ray: &Ray<A>,
    coarse: &A::Coarse,
    limit: A::Length,
) -> Option<Meeting<A>> {
    let left = id == ray.leaving.shape;
    if left && (S::FLAT || S::CONVEX && !ray.leaving.inwards) {
        return None;
    }
    shape.nearest(ray, coarse, left, limit)
}

/// The same for the bounded shape of any number.
#[inline(never)]
pub(super) fn meet_any<A: Arithmetic, const USES: u64>(
    shapes: &Shapes<'_, A>,
    id: u32,
    ray: &Ray<A>,
    coarse: &A::Coarse,
    limit: A::Length,
) -> Option<Meeting<A>> {
    with_shape!(USES, shapes, id, shape => meet(shape, id, ray, coarse, limit), None)
}

/// The surface and material where the ray met the shape of this number; puts `p` back on it.
#[inline(always)]
pub(super) fn surface_at<A: Arithmetic, const USES: u64>(
    scene: &Scene<'_, A, USES>,
    id: u32,
    ray: &Ray<A>,
    meeting: &Meeting<A>,
    p: &mut [A::Length; 3],
) -> Option<(Surface<A>, MaterialId)> {
    let (parts, shapes) = (&scene.parts, &scene.shapes);
    if let Some(sphere) = shapes.spheres.get(id as usize) {
        Some((sphere.surface(ray, meeting, p), sphere.material()))
    } else if has(USES, uses::PLANES)
        && let Some(plane) = parts.planes.get(id.wrapping_sub(scene.bounded) as usize)
    {
        Some((plane.surface(ray, meeting, p), plane.material()))
    } else {
        let (surface, material, point) =
            surface_of_other::<A, USES>(shapes, id, *ray, *meeting, *p)?;
        *p = point;
        Some((surface, material))
    }
}

/// By value: what a reference is taken of can't stay in registers.
#[inline(never)]
fn surface_of_other<A: Arithmetic, const USES: u64>(
    shapes: &Shapes<'_, A>,
    id: u32,
    ray: Ray<A>,
    meeting: Meeting<A>,
    mut p: [A::Length; 3],
) -> Option<(Surface<A>, MaterialId, [A::Length; 3])> {
    with_shape!(USES, shapes, id, shape => {
        let surface = shape.surface(&ray, &meeting, &mut p);
        Some((surface, shape.material_at(&meeting), p))
    }, None)
}

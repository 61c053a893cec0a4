//! A ray and one shape, found by its number.
//!
//! Spheres and planes are tested in line, since the smallest scenes are made of them; the other
//! kinds here, once, out of line: their code is shared, and the short loops keep the registers.

use crate::math::Arithmetic;
use crate::scene::uses::{self, has, has_others};
use crate::scene::{Scene, Shapes, with_shape};
use crate::shape::{MaterialId, Meeting, Plane, Ray, Shape, Sphere, Surface};

/// Where a ray meets a shape, unless it is one that the ray leaves and can't meet again.
#[inline(always)]
pub(super) fn meet<A: Arithmetic, S: Shape<A>>(
    shape: &S,
    id: u32,
    ray: &Ray<A>,
    coarse: &A::Coarse,
    limit: A::Length,
) -> Option<Meeting<A>> {
    shape.nearest_from(ray, coarse, id == ray.leaving.shape, limit)
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

/// Where a ray met a shape.
pub(super) struct Place<A: Arithmetic> {
    pub(super) surface: Surface<A>,
    pub(super) material: MaterialId,
    /// The point in the space where patterns lie: that of the scene, or of the group.
    pub(super) local: [A::Length; 3],
    /// The mirror image of the ray about the shading normal.
    pub(super) mirror: [A::Unit; 3],
    /// Where rays start that go back from the surface.
    pub(super) outside: [A::Length; 3],
}

impl<A: Arithmetic> Place<A> {
    #[inline(always)]
    fn new(
        Found { surface, material, local }: Found<A>,
        (ray, meeting, p): (&Ray<A>, &Meeting<A>, &[A::Length; 3]),
    ) -> Self {
        let mirror = A::reflect(&ray.direction, &surface.normal, -surface.cosine);
        let outside = A::leave(p, &surface.geometric, meeting.distance);
        Self { surface, material, local, mirror, outside }
    }

    /// On a sphere; puts `p` back on it.
    #[inline(always)]
    pub(super) fn on_sphere(
        sphere: &Sphere<A>,
        ray: &Ray<A>,
        meeting: &Meeting<A>,
        p: &mut [A::Length; 3],
    ) -> Self {
        let surface = sphere.surface(ray, meeting, p);
        let found = Found { surface, material: sphere.material(), local: *p };
        Self::new(found, (ray, meeting, p))
    }

    /// On a plane; puts `p` back on it.
    #[inline(always)]
    pub(super) fn on_plane<const USES: u64>(
        plane: &Plane<A>,
        ray: &Ray<A>,
        meeting: &Meeting<A>,
        p: &mut [A::Length; 3],
    ) -> Self {
        let local = plane.settle::<USES>(ray, meeting.distance, p);
        let surface = plane.surface_seen::<USES>(ray);
        let (mirror, outside) = plane.back::<USES>(ray, &surface, p, meeting.distance);
        Self { surface, material: plane.material(), local, mirror, outside }
    }
}

/// The surface and material where the ray met the shape of this number; puts `p` back on it.
#[inline(always)]
pub(super) fn surface_at<A: Arithmetic, const USES: u64>(
    scene: &Scene<'_, A, USES>,
    id: u32,
    ray: &Ray<A>,
    meeting: &Meeting<A>,
    p: &mut [A::Length; 3],
) -> Option<Place<A>> {
    let (parts, shapes) = (&scene.parts, &scene.shapes);
    if let Some(sphere) = shapes.spheres.get(id as usize) {
        Some(Place::on_sphere(sphere, ray, meeting, p))
    } else if has(USES, uses::PLANES)
        && let Some(plane) = parts.planes.get(id.wrapping_sub(scene.first_plane) as usize)
    {
        Some(Place::on_plane::<USES>(plane, ray, meeting, p))
    } else if has(USES, uses::INSTANCES) && id >= scene.bounded {
        let (found, point) = surface_in_instance(scene, id, *ray, *meeting)?;
        *p = point;
        Some(Place::new(found, (ray, meeting, p)))
    } else if has_others(USES) {
        let found = surface_of_other::<A, USES>(shapes, id, *ray, *meeting, *p)?;
        *p = found.local;
        Some(Place::new(found, (ray, meeting, p)))
    } else {
        None
    }
}

/// What is found by a call: the surface, its material, and the point in the space of the shape.
struct Found<A: Arithmetic> {
    surface: Surface<A>,
    material: MaterialId,
    local: [A::Length; 3],
}

/// The same in an instance, with the point in the scene.
#[inline(never)]
fn surface_in_instance<A: Arithmetic, const USES: u64>(
    scene: &Scene<'_, A, USES>,
    id: u32,
    ray: Ray<A>,
    meeting: Meeting<A>,
) -> Option<(Found<A>, [A::Length; 3])> {
    let mut first = scene.bounded;
    for instance in scene.parts.instances {
        let count = instance.group().count;
        let index = id.wrapping_sub(first);
        if index >= count {
            first = first.wrapping_add(count);
            continue;
        }
        let coarse = A::coarse(&ray.origin, &ray.direction);
        let inside = instance.enter(first, &ray, &coarse, A::FAR)?;
        let ray = &inside.ray;
        let distance = instance.distance_inside(&inside, meeting.distance);
        let local = A::along(&ray.origin, distance, &ray.direction);
        let meeting = Meeting { distance, ..meeting };
        let shapes = &instance.group().shapes;
        let Found { surface, material, local } =
            surface_of_other::<A, USES>(shapes, index, *ray, meeting, local)?;
        let surface = instance.turn(surface);
        let material = instance.material().unwrap_or(material);
        return Some((Found { surface, material, local }, instance.outwards(&local)));
    }
    None
}

/// By value: what a reference is taken of can't stay in registers.
#[inline(never)]
fn surface_of_other<A: Arithmetic, const USES: u64>(
    shapes: &Shapes<'_, A>,
    id: u32,
    ray: Ray<A>,
    meeting: Meeting<A>,
    mut p: [A::Length; 3],
) -> Option<Found<A>> {
    with_shape!(USES, shapes, id, shape => {
        let surface = shape.surface(&ray, &meeting, &mut p);
        Some(Found { surface, material: shape.material_at(&meeting), local: p })
    }, None)
}

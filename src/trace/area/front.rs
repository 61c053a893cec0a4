//! Where a ray that carries light from surface to surface meets a light that nobody sees.
//!
//! What arrives at a point from the directions of an area light is L_e, and the direct term has
//! counted it. So what lies behind the light must not count there too, be it the sky that a light in
//! a window stands for: rays that gather irradiance end on a light's front and bring back nothing,
//! as they do on the body of a light that can be seen. Seen from behind a light isn't there.

use crate::math::{Arithmetic, sub};
use crate::scene::uses::{self, has};
use crate::scene::{AreaLight, FanCorner, Form, Scene};
use crate::shape::Ray;

/// How far along a ray the first front of an invisible area light lies, if nearer than `limit`.
#[inline(always)]
pub(in crate::trace) fn front_before<A: Arithmetic, const USES: u64>(
    scene: &Scene<'_, A, USES>,
    ray: &Ray<A>,
    limit: A::Length,
) -> Option<A::Length> {
    if !has(USES, uses::AREA_LIGHTS) || scene.parts.area_lights.is_empty() {
        return None;
    }
    first_front(scene.parts.area_lights, scene.parts.light_corners, *ray, limit)
}

#[inline(never)]
fn first_front<A: Arithmetic>(
    lights: &[AreaLight<A>],
    corners: &[FanCorner<A>],
    ray: Ray<A>,
    limit: A::Length,
) -> Option<A::Length> {
    let mut first = None;
    let mut nearest = limit;
    for light in lights {
        if light.body().is_none()
            && let Some(distance) = front(light, corners, &ray)
            && distance < nearest
        {
            nearest = distance;
            first = Some(distance);
        }
    }
    first
}

/// How far along a ray a light's front lies.
fn front<A: Arithmetic>(
    light: &AreaLight<A>,
    corners: &[FanCorner<A>],
    ray: &Ray<A>,
) -> Option<A::Length> {
    let Ray { origin, direction, .. } = ray;
    if let Form::Sphere { radius } = &light.form {
        let way = sub(&light.center, origin);
        let middle = A::project(&way, direction);
        if middle <= A::NO_LENGTH {
            return None;
        }
        let leg2 = A::leg2(radius, &way, middle, direction)?;
        let distance = middle - A::leg(radius, leg2);
        return if distance > A::NO_LENGTH { Some(distance) } else { None };
    }
    let height = A::project(&sub(origin, &light.origin), &light.normal);
    let speed = -A::dot(direction, &light.normal);
    if height <= A::NO_LENGTH || speed <= A::NO_UNIT {
        return None;
    }
    // A light on a wall lies before it, by what positions may be wrong.
    let height = height - A::clearance(&light.origin, height);
    if height <= A::NO_LENGTH {
        return None;
    }
    let distance = A::ratio(height, speed);
    if distance >= A::FAR {
        return None;
    }
    let p = sub(&A::along(origin, distance, direction), &light.origin);
    let within = match &light.form {
        Form::Rectangle { edges: [u, v] } => {
            let far = [u[0] + v[0], u[1] + v[1], u[2] + v[2]];
            within::<A>(&p, &light.normal, [u, &far, v].into_iter())
        }
        Form::Triangle { edges: [u, v] } => within::<A>(&p, &light.normal, [u, v].into_iter()),
        Form::Polygon { first, count } => {
            let first = *first as usize;
            let fan = corners.get(first..first.wrapping_add(usize::from(*count)))?;
            within::<A>(&p, &light.normal, fan.iter().map(|corner| &corner.edge))
        }
        Form::Disc { .. } => A::normalize(&p).1 <= light.half,
        Form::Sphere { .. } => false,
    };
    within.then_some(distance)
}

/// Whether a point lies in the convex polygon of the coordinates' origin and these corners,
/// counter-clockwise around the normal.
fn within<'c, A: Arithmetic>(
    p: &[A::Length; 3],
    normal: &[A::Unit; 3],
    corners: impl Iterator<Item = &'c [A::Length; 3]>,
) -> bool {
    let start = [A::NO_LENGTH; 3];
    let left_of = |from: &[A::Length; 3], to: &[A::Length; 3]| {
        let (along, ..) = A::normalize(&sub(to, from));
        let cross =
            |i: usize, j: usize| A::product(normal[i], along[j]) - A::product(normal[j], along[i]);
        let inwards = [cross(1, 2), cross(2, 0), cross(0, 1)];
        A::project(&sub(p, from), &inwards) >= A::NO_LENGTH
    };
    let mut from = start;
    for to in corners {
        if !left_of(&from, to) {
            return false;
        }
        from = *to;
    }
    left_of(&from, &start)
}

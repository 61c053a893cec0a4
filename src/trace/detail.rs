//! What few materials have: textures, bumps, absorption, Fresnel's weights. All of it out of line and by
//! value, so that what has none of it keeps its numbers in registers.

use crate::math::{Arithmetic, Rgb, add, neg, sub};
use crate::scene::uses::{self, has};
use crate::scene::{Instance, Material, Scene, Shapes};
use crate::shape::Surface;

/// The material as a texture colours it at the point of a shape.
#[inline(never)]
pub(super) fn painted<A: Arithmetic, const USES: u64>(
    scene: &Scene<'_, A, USES>,
    material: Material<A>,
    texture: u16,
    shape: u32,
    p: [A::Length; 3],
) -> Material<A> {
    match scene.parts.textures.get(usize::from(texture)) {
        Some(texture) if texture.other().is_none() => {
            let uv = if texture.wants_uv() { coordinates(scene, shape, &p) } else { [0; 2] };
            material.times(&texture.color(&p, uv))
        }
        _ => material,
    }
}

/// The list that a shape is in, its number there, and the instance that placed it.
#[inline(always)]
fn list_of<'s, 'a, A: Arithmetic, const USES: u64>(
    scene: &'s Scene<'a, A, USES>,
    shape: u32,
) -> (&'s Shapes<'a, A>, u32, Option<&'s Instance<'a, A>>) {
    if has(USES, uses::INSTANCES) && shape >= scene.bounded {
        let mut index = shape.wrapping_sub(scene.bounded);
        for instance in scene.parts.instances {
            let group = instance.group();
            if index < group.count {
                return (&group.shapes, index, Some(instance));
            }
            index = index.wrapping_sub(group.count);
        }
    }
    (&scene.shapes, shape, None)
}

/// The texture coordinates at the point of a triangle, in 2⁻¹⁶.
fn coordinates<A: Arithmetic, const USES: u64>(
    scene: &Scene<'_, A, USES>,
    shape: u32,
    p: &[A::Length; 3],
) -> [i32; 2] {
    let (shapes, index, _) = list_of(scene, shape);
    let index = (index as usize).wrapping_sub(shapes.spheres.len());
    let weights = if let Some(triangle) = shapes.triangles.get(index) {
        triangle.weights(p)
    } else {
        match shapes.smooth_triangles.get(index.wrapping_sub(shapes.triangles.len())) {
            Some(triangle) => triangle.weights(p),
            None => return [0; 2],
        }
    };
    let (second, third) = (A::to_q14(weights.0), A::to_q14(weights.1));
    shapes.uvs.get(index).map_or([0; 2], |uv| uv.at(second, third))
}

/// The surface with its shading normal bent by the height of a texture (Blinn, "Simulation of wrinkled
/// surfaces", 1978): the normal less the part of the height's gradient that lies along the surface.
/// Where that would face away from the ray, the surface stays as it is.
#[inline(never)]
pub(super) fn bumped<A: Arithmetic, const USES: u64>(
    scene: &Scene<'_, A, USES>,
    texture: u16,
    surface: Surface<A>,
    shape: u32,
    p: [A::Length; 3],
    direction: [A::Unit; 3],
) -> Surface<A> {
    let Some(texture) = scene.parts.textures.get(usize::from(texture)) else { return surface };
    let gradient = texture.gradient(&p);
    let gradient = match list_of(scene, shape) {
        (_, _, Some(instance)) => instance.turn_vector(&gradient),
        _ => gradient,
    };
    bent(gradient, surface, direction)
}

fn bent<A: Arithmetic>(
    gradient: [A::Unit; 3],
    surface: Surface<A>,
    direction: [A::Unit; 3],
) -> Surface<A> {
    // What rises in front is a hollow from behind.
    let gradient = if surface.behind { neg(&gradient) } else { gradient };
    let n = &surface.normal;
    let across = A::dot(&gradient, n);
    // Of length 2 at most, since the gradient's is √3.
    let bent = sub(&add(n, &n.map(|x| A::product(across, x))), &gradient);
    let (normal, _) = A::renormalize(&bent);
    let cosine = -A::dot(&direction, &normal);
    if cosine > A::NO_UNIT { Surface { normal, cosine, smooth: true, ..surface } } else { surface }
}

/// What is left of a weight after the way to a surface.
#[inline(never)]
pub(super) fn absorbed<A: Arithmetic, const USES: u64>(
    scene: &Scene<'_, A, USES>,
    absorption: u16,
    behind: bool,
    way: A::Length,
    weight: Rgb<A::Weight>,
) -> Rgb<A::Weight> {
    match scene.parts.absorptions.get(usize::from(absorption)) {
        Some(absorption) => absorption.after(behind, way, &weight),
        None => weight,
    }
}

/// The part of unpolarised light that a dielectric reflects (Fresnel 1823), for the cosines of the
/// incident and the transmitted ray and `eta` = η_i/η_t: the mean of both polarisations' squares
///
/// r_s = (η·cos θ_i − cos θ_t)/(η·cos θ_i + cos θ_t), r_p = (cos θ_i − η·cos θ_t)/(cos θ_i + η·cos θ_t).
#[inline(never)]
pub(super) fn reflectance<A: Arithmetic>(cosines: [A::Weight; 2], eta: A::Weight) -> A::Weight {
    let [i, t] = cosines;
    let r = |a: A::Weight, b: A::Weight| {
        let difference = if a > b { a - b } else { b - a };
        let sum = a + b;
        let r = if sum > A::NO_WEIGHT { A::quotient(difference, sum) } else { A::FULL };
        A::weight(r, r)
    };
    let both = r(A::weight(eta, i), t) + r(i, A::weight(eta, t));
    A::weight(both, A::weight_q14(1 << 13))
}

#[cfg(test)]
mod tests;

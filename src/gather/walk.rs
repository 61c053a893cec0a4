//! Laying virtual lights: paths from the lights, by Halton's sequence.
//!
//! Path i starts at light i modulo their number: a point light sends it anywhere, a spot into its
//! cone, an area light from a point of its front with the cosine, a directional light from a disc
//! before the scene. Where it meets a diffuse surface it leaves a virtual light and goes on with
//! the cosine, as often as the settings say. What a path doesn't use of the pool stays dark.

use super::halton::halton_q16;
use super::hemisphere::{cosine_q15, lifted, part_q16, raised, root_q16, sine_q15, tangents};
use super::{VirtualLight, VirtualLights, VirtualLightsSettings};
use crate::math::{Arithmetic, Rgb, neg, rgb, sub};
use crate::scene::{Falloff, Form, Light, Scene, Source};
use crate::shape::{Leaving, Ray};
use crate::tally::{RayKind, Tally};
use crate::trace::{Tracer, Work, point_of_light};

/// A path as it leaves a light.
struct Start<A: Arithmetic> {
    ray: Ray<A>,
    /// What the path carries, before it is divided by the number of paths.
    intensity: A::Intensity,
    color: Rgb<A::Weight>,
    /// The light doesn't fall off, though paths spread.
    steady: bool,
}

/// A coefficient of at most 1 in Q16.
fn weight_q16<A: Arithmetic>(w: A::Weight) -> i32 {
    A::to_q16(A::dim(A::from_q16(0x1_0000), w))
}

fn weight<A: Arithmetic>(q16: u32) -> A::Weight {
    A::weight_of(A::fraction(q16 as i32))
}

/// A number between 0 and 1 that gets no coarser as it gets smaller: over a power of two first.
fn over<A: Arithmetic>(intensity: &A::Intensity, count: u32) -> A::Intensity {
    let log2 = 31 - count.max(1).leading_zeros();
    let near = A::dim_intensity(intensity, weight::<A>(part_q16(1 << log2, count)));
    let mut over = near;
    for _ in 0..log2 {
        over = A::dim_intensity(&over, weight::<A>(0x8000));
    }
    over
}

fn times4<A: Arithmetic>(intensity: &A::Intensity) -> A::Intensity {
    let two = A::FULL + A::FULL;
    A::dim_intensity(intensity, two + two)
}

impl<'p, A: Arithmetic> VirtualLights<'p, A> {
    /// Lays as many virtual lights as the pool holds (each part of the tile gets as many whole
    /// paths) in a scene; what the pool holds doesn't matter.
    pub fn lay<T: Tally, const MAX_DEPTH: usize, const USES: u64>(
        scene: &Scene<'_, A, USES>,
        settings: &VirtualLightsSettings<A>,
        pool: &'p mut [VirtualLight<A>],
        work: &mut Work<A, MAX_DEPTH>,
        tally: &mut T,
    ) -> Self {
        for light in pool.iter_mut() {
            *light = VirtualLight::NONE;
        }
        let bounces = usize::from(settings.bounces);
        let parts = 1usize << (2 * settings.log2_tile);
        let paths = pool.len().checked_div(bounces).unwrap_or(0) / parts * parts;
        let parts = scene.parts();
        let emitters = (parts.lights.len() + parts.area_lights.len()) as u32;
        let tracer = Tracer::gathering(scene, 1);
        for (number, path) in (0u32..).zip(pool.chunks_mut(bounces.max(1)).take(paths)) {
            let Some(index) = number.checked_div(emitters) else { break };
            let emitter = number.wrapping_sub(index.wrapping_mul(emitters));
            // How many paths this light has.
            let count = (paths as u32)
                .wrapping_sub(emitter)
                .wrapping_add(emitters)
                .wrapping_sub(1)
                .checked_div(emitters)
                .unwrap_or(1);
            let at = |dimension: usize| halton_q16(index.wrapping_add(1), dimension);
            let Some(start) = start(scene, settings, emitter as usize, at) else { continue };
            let Start { mut ray, intensity, mut color, steady } = start;
            let sixteen = times4::<A>(&times4::<A>(&intensity));
            let mut intensity = over::<A>(&sixteen, count);
            let mut kind = RayKind::Ambient;
            for (bounce, light) in path.iter_mut().enumerate() {
                let Some(site) = tracer.site(kind, ray, work, tally) else { break };
                if bounce == 0 && steady {
                    let way = sub(&site.position, &ray.origin);
                    intensity = A::spread_intensity(&intensity, A::normalize(&way).1);
                }
                if !site.is_diffuse() {
                    break;
                }
                color = rgb(&color, &site.diffuse, A::weight);
                let Ray { origin, leaving, .. } = site.outside;
                let normal = site.surface.normal;
                *light = VirtualLight {
                    position: origin,
                    intensity,
                    normal_q14: normal.map(|n| (A::to_q17(n) >> 3) as i16),
                    color_q15: color.map(|c| (weight_q16::<A>(c) >> 1).clamp(0, 0xffff) as u16),
                };
                let up = lifted(at(4 + 2 * bounce), at(5 + 2 * bounce));
                let direction = raised::<A>(up, &tangents::<A>(&normal), &normal);
                ray = Ray { origin, direction, leaving };
                kind = RayKind::Ambient;
            }
        }
        let used = paths.wrapping_mul(bounces);
        Self::new(pool.get(..used).unwrap_or(&[]), settings)
    }
}

/// The ray of a path from a light.
fn start<A: Arithmetic, const USES: u64>(
    scene: &Scene<'_, A, USES>,
    settings: &VirtualLightsSettings<A>,
    emitter: usize,
    at: impl Fn(usize) -> u32,
) -> Option<Start<A>> {
    let parts = scene.parts();
    if let Some(light) = parts.lights.get(emitter) {
        return of_light(light, settings, at);
    }
    let light = parts.area_lights.get(emitter.wrapping_sub(parts.lights.len()))?;
    let (origin, normal, intensity) = match &light.form {
        Form::Sphere { radius } => {
            let normal = sphere::<A>(at(2), at(3));
            let origin = A::along(&light.center, A::radius(radius), &normal);
            // Its intensity is that of the disc it is seen as, a quarter of it.
            (origin, normal, times4::<A>(&light.intensity))
        }
        _ => {
            let origin = point_of_light(light, parts.light_corners, at(2), at(3))?;
            (origin, light.normal, light.intensity)
        }
    };
    let direction = raised::<A>(lifted(at(0), at(1)), &tangents::<A>(&normal), &normal);
    let leaving = match light.body() {
        Some(shape) => Leaving { shape, ..Leaving::NOTHING },
        None => Leaving::NOTHING,
    };
    let ray = Ray { origin: A::leave(&origin, &normal, A::NO_LENGTH), direction, leaving };
    Some(Start { ray, intensity, color: light.color, steady: false })
}

fn of_light<A: Arithmetic>(
    light: &Light<A>,
    settings: &VirtualLightsSettings<A>,
    at: impl Fn(usize) -> u32,
) -> Option<Start<A>> {
    let steady = light.falloff == Falloff::None;
    let leaving = Leaving::NOTHING;
    let intensity = light.intensity;
    match light.source {
        Source::Point { position: origin } => {
            let direction = sphere::<A>(at(0), at(1));
            let intensity = times4::<A>(&intensity);
            let ray = Ray { origin, direction, leaving };
            Some(Start { ray, intensity, color: light.color, steady })
        }
        Source::Spot { position: origin, axis, cos_outer, .. } => {
            let axis = neg(&axis);
            // Even over the cone: the cosine is, from 1 to that of the border.
            let cap = 0x1_0000u32.saturating_sub(weight_q16::<A>(cos_outer) as u32);
            let down = (at(0) >> 1).wrapping_mul(cap >> 1) >> 14;
            let direction = raised::<A>(
                around(0x1_0000u32.saturating_sub(down) as i32, at(1)),
                &tangents::<A>(&axis),
                &axis,
            );
            // The cone's part of the sphere, (1 − cos)/2, of 4.
            let cap = weight::<A>(cap);
            let intensity = A::dim_intensity(&intensity, cap + cap);
            let intensity = match light.fade(&neg(&direction))? {
                Some(share) => A::dim_intensity(&intensity, share),
                None => intensity,
            };
            let ray = Ray { origin, direction, leaving };
            Some(Start { ray, intensity, color: light.color, steady })
        }
        Source::Directional { direction } => {
            if settings.radius <= A::NO_LENGTH {
                return None;
            }
            // A place of the disc that the ball is seen as, twice its radius before its middle.
            let radius = settings.radius;
            let [x, y, _] = lifted(at(0), at(1));
            let [t, b] = tangents::<A>(&direction);
            let origin = A::along(&settings.center, radius + radius, &direction);
            let origin = A::along(&origin, A::scale(radius, A::fraction(x)), &t);
            let origin = A::along(&origin, A::scale(radius, A::fraction(y)), &b);
            let intensity = A::spread_intensity(&intensity, radius);
            let ray = Ray { origin, direction: neg(&direction), leaving };
            Some(Start { ray, intensity, color: light.color, steady: false })
        }
    }
}

/// The components in Q16 of a direction at an angle of this cosine to the normal.
fn around(cosine_q16: i32, turn_q16: u32) -> [i32; 3] {
    let cosine = if cosine_q16 < 0 { -cosine_q16 } else { cosine_q16 };
    // 1 − c² = (1 − c)(1 + c), which doesn't cancel
    let (less, more) = ((0x1_0000 - cosine) as u32, (0x1_0000 + cosine) as u32);
    let sine = root_q16((less >> 1).wrapping_mul(more >> 2) >> 13) as i32;
    let along = |c: i32| (sine >> 1).wrapping_mul(c) >> 14;
    [along(cosine_q15(turn_q16)), along(sine_q15(turn_q16)), cosine_q16]
}

/// A direction of all, even over the sphere.
fn sphere<A: Arithmetic>(u_q16: u32, turn_q16: u32) -> [A::Unit; 3] {
    let z = 0x1_0000 - 2 * u_q16 as i32;
    A::renormalize(&around(z, turn_q16).map(A::fraction)).0
}

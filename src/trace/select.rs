//! Direct light of the lights that a point asks, where it doesn't ask all. (Which and why:
//! `scene/selection.rs`.)

use super::area::{self, Point};
use super::direct::factor;
use super::visible::visible;
use super::work::Scratch;
use crate::math::{Arithmetic, Rgb, hash, largest, rgb, spread};
use crate::scene::uses::{self, has};
use crate::scene::{AreaLight, Incident, Light, Scene, SceneRef, Selection};
use crate::tally::{RayKind, Tally, Term};

/// A light of either sort.
#[derive(Clone, Copy)]
enum Source<'l, A: Arithmetic> {
    Point(&'l Light<A>),
    Area(&'l AreaLight<A>),
}

/// All lights with their numbers.
fn sources<'l, A: Arithmetic, const USES: u64>(
    scene: &'l Scene<'_, A, USES>,
) -> impl Iterator<Item = (u16, Source<'l, A>)> {
    let areas: &[AreaLight<A>] =
        if has(USES, uses::AREA_LIGHTS) { scene.parts.area_lights } else { &[] };
    let points = scene.parts.lights.iter().map(Source::Point);
    (0u16..).zip(points.chain(areas.iter().map(Source::Area)))
}

/// What the point sends back along the ray of the lights it asks.
#[inline(never)]
pub(super) fn selected<'s, A: Arithmetic, T: Tally, S, const USES: u64>(
    scene: S,
    at: Point<'_, A>,
    scratch: &mut Scratch<A>,
    tally: &mut T,
) -> Rgb<A::Radiance>
where
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    let mut sum = [A::BLACK; 3];
    match scene.parts.selection {
        Selection::Above(threshold) => {
            for (number, source) in sources(&scene) {
                let expected = expected(&scene, source, &at);
                if expected > A::BLACK && expected >= threshold {
                    let radiance = given(scene, source, number, &at, scratch, tally);
                    tally.term::<A>(Term::Direct { light: number }, &radiance);
                    sum = rgb(&sum, &radiance, A::gather);
                }
            }
        }
        Selection::All | Selection::Choose(0) => {}
        Selection::Choose(count) => {
            let mut all = A::BLACK;
            for (_, source) in sources(&scene) {
                all = A::gather(all, expected(&scene, source, &at));
            }
            let seed = u32::from(scene.parts.light_jitter.unwrap_or(0)) << 16 | 0xffff;
            let mut choice = Choice::new(hash(spread(at.key, seed)), count);
            let mut target = choice.target::<A>(all);
            let mut up_to = A::BLACK;
            for (number, source) in sources(&scene) {
                let expected = expected(&scene, source, &at);
                up_to = A::gather(up_to, expected);
                let mut times = 0u8;
                while choice.made < count && target < up_to {
                    times += 1;
                    choice.made += 1;
                    target = choice.target::<A>(all);
                }
                if times == 0 {
                    continue;
                }
                let radiance = given(scene, source, number, &at, scratch, tally);
                // Over the probability expected/all, and over the number of choices.
                let share = radiance.map(|radiance| {
                    A::mean(A::dim(all, A::relative(radiance, expected)), u16::from(count))
                });
                let mut radiance = [A::BLACK; 3];
                for _ in 0..times {
                    radiance = rgb(&radiance, &share, A::gather);
                }
                tally.term::<A>(Term::Direct { light: number }, &radiance);
                sum = rgb(&sum, &radiance, A::gather);
            }
        }
    }
    sum
}

/// The choices of a point, in the order of the lights: one from each of `count` equal parts of the
/// sum of what they would give.
struct Choice {
    seed: u32,
    count: u8,
    made: u8,
}

impl Choice {
    fn new(seed: u32, count: u8) -> Self {
        Self { seed, count, made: 0 }
    }

    /// Where in the sum of all the next choice lies.
    fn target<A: Arithmetic>(&self, all: A::Radiance) -> A::Radiance {
        let part = u32::MAX.checked_div(u32::from(self.count)).unwrap_or(0);
        let random = hash(self.seed.wrapping_add(u32::from(self.made)));
        let within = (u64::from(part).wrapping_mul(u64::from(random)) >> 32) as u32;
        A::portion(all, part.wrapping_mul(u32::from(self.made)).wrapping_add(within))
    }
}

/// What a light would add to the largest channel, were nothing in its way.
fn expected<A: Arithmetic, const USES: u64>(
    scene: &Scene<'_, A, USES>,
    source: Source<'_, A>,
    at: &Point<'_, A>,
) -> A::Radiance {
    match source {
        Source::Point(light) => match unshadowed(scene, light, at) {
            Some((_, radiance)) => largest(&radiance),
            None => A::BLACK,
        },
        Source::Area(light) => area::expected(scene, light, at),
    }
}

/// A point light's ray, and what it adds if nothing is in the way.
fn unshadowed<A: Arithmetic, const USES: u64>(
    scene: &Scene<'_, A, USES>,
    light: &Light<A>,
    at: &Point<'_, A>,
) -> Option<(Incident<A>, Rgb<A::Radiance>)> {
    let incident = light.at::<USES>(&at.shadow.origin)?;
    let cosine = A::cosine(&at.surface.normal, &incident.direction);
    if cosine <= A::NO_WEIGHT {
        return None;
    }
    let rules = &scene.parts.rules;
    let factor = factor::<A, USES>(
        rules,
        at.material,
        at.highlights.then_some(&at.mirror),
        cosine,
        &incident.direction,
    );
    let factor = rgb(&factor, &light.color, A::weight);
    let factor = rgb(&factor, &at.weight, A::weight);
    let radiance = factor.map(|f| A::dim(incident.irradiance, f));
    Some((incident, radiance))
}

/// What a light does give.
fn given<'s, A: Arithmetic, T: Tally, S, const USES: u64>(
    scene: S,
    source: Source<'_, A>,
    number: u16,
    at: &Point<'_, A>,
    scratch: &mut Scratch<A>,
    tally: &mut T,
) -> Rgb<A::Radiance>
where
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    let black = [A::BLACK; 3];
    match source {
        Source::Area(light) => {
            area::area(scene, light, number, at, scratch, tally).unwrap_or(black)
        }
        Source::Point(light) => {
            let Some((incident, radiance)) = unshadowed(&scene, light, at) else { return black };
            let mut ray = at.shadow;
            ray.direction = incident.direction;
            tally.ray(RayKind::Shadow, at.depth, &ray, &at.weight);
            match visible(scene, &ray, incident.distance, number, None, scratch, tally) {
                None => {
                    tally.shadowed(number, at.depth);
                    black
                }
                Some(share) => rgb(&radiance, &share, |radiance, share| {
                    if share == A::FULL { radiance } else { A::dim(radiance, share) }
                }),
            }
        }
    }
}

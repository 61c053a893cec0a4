//! Terms of radiance: the pictures of each add up to the whole.

use crate::common::scenes::{Shot, Shots};
use whitted::frame::{FrameError, Renderer, Settings};
use whitted::math::Fixed;
use whitted::scene::{Parts, Scene, uses};
use whitted::trace::{Terms, Work};

const WIDTH: u16 = 40;
const HEIGHT: u16 = 30;

fn picture<A: Shots>(shot: &Shot<A>, terms: Terms) -> Vec<[f64; 3]> {
    let settings = Settings { depth: shot.depth, terms, ..Settings::new(WIDTH, HEIGHT) };
    let mut work = Work::<A, 5>::new();
    let mut renderer =
        Renderer::new(shot.scene, shot.camera, settings, &mut work, &mut []).expect("settings");
    renderer.scan(0..WIDTH, 0..HEIGHT).map(|(_, _, radiance)| radiance.map(Into::into)).collect()
}

/// Each with mirrors and glass.
fn add_up<A: Shots>(tolerance: f64) {
    let through = Terms::REFLECTION.with(Terms::TRANSMISSION);
    let ends =
        [Terms::EMISSION, Terms::AMBIENT, Terms::DIRECT, Terms::HIGHLIGHT, Terms::BACKGROUND];
    for shot in A::SHOTS {
        let whole = picture(shot, Terms::ALL);
        let mut sum = vec![[0.0; 3]; whole.len()];
        for term in ends {
            for (sum, part) in sum.iter_mut().zip(picture(shot, term.with(through))) {
                (0..3).for_each(|i| sum[i] += part[i]);
            }
        }
        for (i, (sum, whole)) in sum.iter().zip(&whole).enumerate() {
            for c in 0..3 {
                let off = (sum[c] - whole[c]).abs();
                assert!(
                    off <= tolerance * (1.0 + whole[c]),
                    "{}, {}, pixel {i}: {sum:?} for {whole:?}",
                    shot.name,
                    A::NAME
                );
            }
        }
        // Without any that ends a path there is nothing.
        assert!(picture(shot, through).iter().all(|p| *p == [0.0; 3]), "{}", shot.name);
    }
}

#[test]
fn the_terms_of_a_picture_add_up() {
    add_up::<f64>(1e-12);
    add_up::<f32>(1e-5);
    // A weighted term is rounded down to 1/65536, and Q14 weights are.
    add_up::<Fixed>(1e-3);
}

#[test]
fn a_tailored_scene_says_whether_terms_can_be_left_out() {
    const PARTS: Parts<Fixed> = Parts::EMPTY;
    let shot = &Fixed::SHOTS[0];
    let settings = Settings { terms: Terms::DIRECT, ..Settings::new(4, 4) };
    let mut work = Work::<Fixed, 5>::new();
    let scene = Scene::<Fixed, { PARTS.uses() }>::tailored(PARTS);
    let refused = Renderer::new(&scene, shot.camera, settings, &mut work, &mut []).err();
    assert_eq!(refused, Some(FrameError::Tailored));
    let scene = Scene::<Fixed, { PARTS.uses() | uses::TERMS }>::tailored(PARTS);
    assert!(Renderer::new(&scene, shot.camera, settings, &mut work, &mut []).is_ok());
}

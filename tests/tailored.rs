//! Scenes whose types say what they use: the same bits as with all the code there is, and no scene
//! that uses more than its type says.

use crate::common::scenes::{Shot, Shots, Tailored, double, fixed, single};
use whitted::frame::{Renderer, Settings};
use whitted::math::{Arithmetic, Fixed, Rgb};
use whitted::scene::{Camera, Scene, SceneError};
use whitted::tally::Counts;
use whitted::trace::Work;

/// The picture's radiances, and what was counted.
fn picture<A: Arithmetic, const USES: u64>(
    scene: &Scene<'_, A, USES>,
    camera: &Camera<A>,
) -> (Vec<Rgb<A::Radiance>>, Counts) {
    let settings = Settings::new(60, 45);
    let mut work = Work::<A, 5>::new();
    let mut renderer =
        Renderer::with_tally(scene, camera, settings, &mut work, &mut [], Counts::default())
            .expect("settings");
    let radiances = renderer.scan(0..60, 0..45).map(|(_, _, radiance)| radiance).collect();
    (radiances, *renderer.tally())
}

struct SameBits(usize);

impl<A: Arithmetic> Tailored<A> for SameBits {
    fn scene<const USES: u64>(
        &mut self,
        name: &str,
        scene: &'static Scene<'static, A, USES>,
        camera: &'static Camera<A>,
    ) {
        let (here, counts) = picture(scene, camera);
        let (there, all) = picture(&scene.general(), camera);
        assert!(here == there, "{name} in {}", A::NAME);
        assert_eq!(counts, all, "{name} in {}", A::NAME);
        self.0 += 1;
    }
}

#[test]
fn same_bits() {
    let mut scenes = SameBits(0);
    fixed::tailored(&mut scenes);
    single::tailored(&mut scenes);
    double::tailored(&mut scenes);
    assert_eq!(scenes.0, 18);
}

/// What the renderer knows of rays from the eye and to the lights changes no bit.
struct Unseen;

impl<A: Arithmetic> Tailored<A> for Unseen {
    fn scene<const USES: u64>(
        &mut self,
        name: &str,
        scene: &'static Scene<'static, A, USES>,
        camera: &'static Camera<A>,
    ) {
        let settings = Settings::new(60, 45);
        let mut work = Work::<A, 5>::new();
        // Counted, as above: one copy of the tracer does for both.
        let mut renderer =
            Renderer::with_tally(scene, camera, settings, &mut work, &mut [], Counts::default())
                .expect("settings");
        let seen: Vec<_> = renderer.scan(0..60, 0..45).collect();
        for (x, y, radiance) in seen {
            let ray = renderer.ray(x, y);
            assert!(renderer.radiance(&ray) == radiance, "{name} in {} at {x}, {y}", A::NAME);
        }
    }
}

#[test]
fn any_ray_has_the_same_bits() {
    fixed::tailored(&mut Unseen);
    single::tailored(&mut Unseen);
    double::tailored(&mut Unseen);
}

#[test]
fn nothing_is_left_of_the_scene_before() {
    let draw = |shot: &Shot<Fixed>, work: &mut Work<Fixed, 5>| {
        let settings = Settings { depth: shot.depth, ..Settings::new(24, 18) };
        let mut renderer =
            Renderer::new(shot.scene, shot.camera, settings, work, &mut []).expect("settings");
        renderer.scan(0..24, 0..18).collect::<Vec<_>>()
    };
    for first in Fixed::SHOTS {
        let mut work = Work::new();
        draw(first, &mut work);
        for second in Fixed::SHOTS {
            let fresh = draw(second, &mut Work::new());
            assert!(draw(second, &mut work) == fresh, "{} after {}", second.name, first.name);
            draw(first, &mut work);
        }
    }
}

/// Refuses a scene without any one of the bits that it needs, and takes it with more.
struct Refused;

/// The missing bits if the scene is held to `USES`.
fn missing<A: Arithmetic, const USES: u64>(
    scene: &Scene<'static, A, { whitted::scene::uses::ALL }>,
) -> u64 {
    match Scene::<'static, A, USES>::try_tailored(*scene.parts()) {
        Ok(_) => 0,
        Err(SceneError::Uses { missing }) => missing,
        Err(other) => panic!("{other}"),
    }
}

impl<A: Arithmetic> Tailored<A> for Refused {
    fn scene<const USES: u64>(
        &mut self,
        name: &str,
        scene: &'static Scene<'static, A, USES>,
        _: &'static Camera<A>,
    ) {
        let all = Scene::checked(*scene.parts());
        assert_eq!(missing::<A, USES>(&all), 0, "{name}");
        assert_eq!(missing::<A, 0>(&all), USES, "{name}");
        assert_eq!(missing::<A, 0x5555_5555_5555_5555>(&all), USES & !0x5555_5555_5555_5555);
        assert_eq!(missing::<A, 0xaaaa_aaaa_aaaa_aaaa>(&all), USES & !0xaaaa_aaaa_aaaa_aaaa);
    }
}

#[test]
fn a_scene_that_uses_more_than_its_type_says_is_refused() {
    fixed::tailored(&mut Refused);
    single::tailored(&mut Refused);
    double::tailored(&mut Refused);
}

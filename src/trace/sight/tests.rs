//! No sphere is missed.

use super::*;
use crate::math::{Fixed, neg};
use crate::scene::Camera;
use crate::shape::testing::Test;
use crate::shape::{Leaving, Plane, Ray, Sphere};
use crate::trace::meet::Place;
use proptest::array::{uniform2, uniform3};
use proptest::prelude::*;
extern crate std;

fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    (length > 1e-3).then(|| v.map(|x| x / length))
}

/// Whether a ray that meets the sphere is in its cone: one that starts at the point, and one
/// that ends there, coming from `back` away.
fn is_found<A: Test>(sphere: &Sphere<A>, point: [f64; 3], d: [f64; 3], back: f64) {
    let from = point.map(A::length);
    let start = Ray::<A> { origin: from, direction: d.map(A::unit), leaving: Leaving::NOTHING };
    let way = sub(&sphere.center(), &from);
    let meets = sphere.meet_likely::<{ uses::ALL }>(&start, false, A::FAR).is_some();
    if let Some(cone) = A::direction_cone(&way, sphere.bound(), false) {
        assert!(!meets || A::in_cone(&cone, &start.direction), "from {point:?} along {d:?}");
    }
    let origin = [0, 1, 2].map(|i| A::length(point[i] + d[i] * back));
    let (direction, distance, _) = A::normalize(&sub(&from, &origin));
    let end = Ray::<A> { origin, direction, leaving: Leaving::NOTHING };
    let blocked = sphere.blocks_likely::<{ uses::ALL }>(&end, false, distance);
    if let Some(cone) = A::direction_cone(&sub(&from, &sphere.center()), sphere.bound(), true) {
        assert!(!blocked || A::in_cone(&cone, &direction), "to {point:?} along {d:?}");
    }
}

/// A unit vector at an angle of this sine to the one along `towards`; `aside` says on which side.
fn at_an_angle(towards: [f64; 3], aside: [f64; 3], sine: f64) -> Option<[f64; 3]> {
    let t = unit(towards)?;
    let along = (0..3).map(|i| aside[i] * t[i]).sum::<f64>();
    let s = unit([0, 1, 2].map(|i| aside[i] - along * t[i]))?;
    let cosine = (1.0 - sine * sine).sqrt();
    Some([0, 1, 2].map(|i| t[i] * cosine + s[i] * sine))
}

/// Whether a ray that leaves the first sphere and meets the second, or just doesn't, is in the cone of the pair,
/// after a ray from `eye` along `d` has met the first.
fn is_found_from<A: Test>(
    [from, to]: [&Sphere<A>; 2],
    (eye, d): ([f64; 3], [f64; 3]),
    aside: [f64; 3],
    part: f64,
) {
    let ray = Ray::<A> {
        origin: eye.map(A::length),
        direction: d.map(A::unit),
        leaving: Leaving::NOTHING,
    };
    let Some(meeting) = from.meet_likely::<{ uses::ALL }>(&ray, false, A::FAR) else { return };
    let pair = [from, to].map(|sphere| (sphere.center(), sphere.bound()));
    let Some(cone) = A::pair_cone(&pair[0], &pair[1]) else { return };
    if !A::is_near(meeting.distance) {
        return;
    }
    let mut p = A::along(&ray.origin, meeting.distance, &ray.direction);
    let place = Place::on_sphere(from, &ray, &meeting, &mut p);
    let within = A::leave(&p, &neg(&place.surface.geometric), meeting.distance);
    for origin in [place.outside, within] {
        let way = sub(&to.center(), &origin).map(A::of_length);
        let length = way.iter().map(|x| x * x).sum::<f64>().sqrt();
        let sine = (A::of_length(to.radius()) / length * part).min(1.0);
        let Some(d) = at_an_angle(way, aside, sine) else { return };
        let leaving = Leaving::NOTHING;
        let ray = Ray::<A> { origin, direction: d.map(A::unit), leaving };
        let meets = to.meet_likely::<{ uses::ALL }>(&ray, false, A::FAR).is_some();
        assert!(!meets || A::in_cone(&cone, &ray.direction), "from {origin:?} along {d:?}");
    }
}

/// Whether what a plane mirrors of a ray is in the cone that is seen from the eye's image, where it meets the
/// sphere.
fn is_found_mirrored<A: Test>(sphere: &Sphere<A>, plane: &Plane<A>, eye: [f64; 3], d: [f64; 3]) {
    let origin = eye.map(A::length);
    let ray = Ray::<A> { origin, direction: d.map(A::unit), leaving: Leaving::NOTHING };
    let Some(meeting) = plane.meet::<{ uses::ALL }>(&ray, A::FAR) else { return };
    let mut p = A::along(&ray.origin, meeting.distance, &ray.direction);
    let place = Place::on_plane::<{ uses::ALL }>(plane, &ray, &meeting, &mut p);
    let way = sub(&sphere.center(), &plane.image(&origin));
    if !ends_before_horizon::<A>(&way, sphere.radius()) {
        return;
    }
    let Some(cone) = A::direction_cone(&way, sphere.bound(), true) else { return };
    let leaving = Leaving::NOTHING;
    let ray = Ray::<A> { origin: place.outside, direction: place.mirror, leaving };
    let meets = sphere.meet_likely::<{ uses::ALL }>(&ray, false, A::FAR).is_some();
    assert!(!meets || A::in_cone(&cone, &ray.direction), "from {eye:?} along {d:?}");
}

/// Whether no ray of a row that passes the sphere meets it.
fn is_clear<A: Test>(camera: &Camera<A>, sphere: Sphere<A>, y: u16) {
    let (view, width) = (View::new(camera, 40, 30), 40);
    let row = view.row(y, 128);
    if pass_all(&[sphere], view, row, width) {
        for x in 0..=width {
            for fraction in [0, 85, 171] {
                let ray = view.ray(&row, x, fraction);
                let meeting = sphere.meet_likely::<{ uses::ALL }>(&ray, false, A::FAR);
                assert!(meeting.is_none(), "row {y}, {x} and {fraction}/256");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]
    #[test]
    fn no_sphere_is_missed(
        center in uniform3(-200.0f64..200.0),
        log_r in -6.0f64..6.0,
        log_way in -3.0f64..6.0,
        towards in uniform3(-1.0f64..1.0),
        aside in uniform3(-1.0f64..1.0),
        part in 0.9f64..1.1,
        log_back in -3.0f64..8.0,
    ) {
        // Points anywhere around it, and directions that just meet it or just don't.
        let (r, way, back) = (log_r.exp2(), log_r.exp2() + log_way.exp2(), log_back.exp2());
        let Some(t) = unit(towards) else { return Ok(()) };
        let Some(d) = at_an_angle(t, aside, (r / way * part).min(1.0)) else { return Ok(()) };
        let point = [0, 1, 2].map(|i| center[i] - t[i] * way);
        is_found::<Fixed>(&Sphere::<Fixed>::new(center, r, 0), point, d, back);
        is_found::<f32>(&Sphere::<f32>::new(center, r, 0), point, d, back);
        is_found::<f64>(&Sphere::<f64>::new(center, r, 0), point, d, back);
    }

    #[test]
    fn no_sphere_is_missed_from_another(
        center in uniform3(-200.0f64..200.0),
        log_r in uniform2(-6.0f64..6.0),
        log_apart in -6.0f64..6.0,
        log_way in -3.0f64..9.0,
        ways in uniform3(uniform3(-1.0f64..1.0)),
        aside in uniform3(-1.0f64..1.0),
        parts in uniform2(0.9f64..1.1),
    ) {
        // An eye anywhere, a sphere that it sees, and another anywhere around that one.
        let r = log_r.map(f64::exp2);
        let (Some(t), Some(s)) = (unit(ways[0]), unit(ways[1])) else { return Ok(()) };
        let (apart, way) = (r[0] + r[1] + log_apart.exp2(), r[0] + log_way.exp2());
        let other = [0, 1, 2].map(|i| center[i] + t[i] * apart);
        let eye = [0, 1, 2].map(|i| center[i] - s[i] * way);
        let sine = (r[0] / way * (1.1 - parts[0] * 0.999).abs() * 5.0).min(1.0);
        let Some(d) = at_an_angle(s, ways[2], sine) else { return Ok(()) };
        if other.iter().chain(&eye).any(|x| x.abs() > 1000.0) {
            return Ok(());
        }
        macro_rules! check {
            ($a:ty) => {
                let pair = [(center, r[0]), (other, r[1])].map(|(c, r)| Sphere::<$a>::new(c, r, 0));
                is_found_from::<$a>([&pair[0], &pair[1]], (eye, d), aside, parts[1]);
            };
        }
        check!(Fixed);
        check!(f32);
        check!(f64);
    }

    #[test]
    fn no_sphere_is_missed_in_a_row(
        center in uniform3(-50.0f64..50.0),
        log_r in -6.0f64..6.0,
        eye in uniform3(-50.0f64..50.0),
        forward in uniform3(-1.0f64..1.0),
        up in uniform3(-1.0f64..1.0),
        log_angle in 0.0f64..7.0,
        y in 0u16..30,
    ) {
        let at = [0, 1, 2].map(|i| eye[i] + forward[i]);
        let tangent = (log_angle.exp2().to_radians() * 0.5).tan();
        macro_rules! check {
            ($a:ty) => {
                if let Ok(camera) = Camera::<$a>::try_look_at(eye, at, up, tangent) {
                    is_clear(&camera, Sphere::<$a>::new(center, log_r.exp2(), 0), y);
                }
            };
        }
        check!(Fixed);
        check!(f32);
        check!(f64);
    }

    #[test]
    fn no_sphere_is_missed_in_a_mirror(
        center in prop_oneof![uniform3(-200.0f64..200.0), uniform3(-800.0f64..800.0)],
        log_r in -6.0f64..6.0,
        eye in uniform3(-200.0f64..200.0),
        normal in prop_oneof![Just([0.0, 1.0, 0.0]), uniform3(-1.0f64..1.0)],
        offset in -50.0f64..50.0,
        aside in uniform3(-1.0f64..1.0),
        part in 0.9f64..1.1,
    ) {
        // A ray that meets the sphere, or just doesn't, once the plane has mirrored it.
        let (r, Some(n)) = (log_r.exp2(), unit(normal)) else { return Ok(()) };
        let height = (0..3).map(|i| eye[i] * n[i]).sum::<f64>() - offset;
        let image = [0, 1, 2].map(|i| eye[i] - 2.0 * height * n[i]);
        let way = [0, 1, 2].map(|i| center[i] - image[i]);
        let length = way.iter().map(|x| x * x).sum::<f64>().sqrt();
        let Some(d) = at_an_angle(way, aside, (r / length * part).min(1.0)) else { return Ok(()) };
        let dn = (0..3).map(|i| d[i] * n[i]).sum::<f64>();
        let d = [0, 1, 2].map(|i| d[i] - 2.0 * dn * n[i]);
        macro_rules! check {
            ($a:ty) => {
                let (sphere, plane) = (Sphere::<$a>::new(center, r, 0), Plane::<$a>::new(normal, offset, 0));
                is_found_mirrored::<$a>(&sphere, &plane, eye, d);
            };
        }
        check!(Fixed);
        check!(f32);
        check!(f64);
    }
}

#[test]
fn rows_are_clear_above_and_below() {
    let camera = Camera::<Fixed>::look_at([0.0; 3], [0.0, 0.0, 5.0], [0.0, 1.0, 0.0], 60.0);
    let view = View::new(&camera, 40, 30);
    let sphere = [Sphere::<Fixed>::new([0.0, 0.0, 5.0], 1.0, 0)];
    let clear = |y| pass_all(&sphere, view, view.row(y, 128), 40);
    // The sphere's tangent of 0.204 is that of 5.3 rows, of 15.
    for y in 0..30 {
        assert_eq!(clear(y), !(10..20).contains(&y), "row {y}");
    }
}

#[test]
fn most_directions_are_out() {
    let sphere = Sphere::<Fixed>::new([0.0, 0.0, 5.0], 1.0, 0);
    let cone = |point: [f64; 3], towards| {
        let point = point.map(Fixed::length);
        let way = sub(&sphere.center(), &point);
        Fixed::direction_cone(&way, sphere.bound(), towards)
    };
    assert!(cone([0.0, 0.0, 4.5], false).is_none());
    let cone = cone([0.0; 3], false).expect("outside");
    let meets = |angle: f64| {
        let d = [0.0, angle.to_radians().sin(), angle.to_radians().cos()];
        Fixed::in_cone(&cone, &d.map(Fixed::unit))
    };
    // asin(1/5) is 11.54 degrees, and a few steps for rounding are half a degree.
    assert!(meets(0.0) && meets(11.5) && !meets(12.5) && !meets(90.0) && !meets(180.0));
}

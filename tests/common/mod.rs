//! What several tests need: tests in each arithmetic, single rays from plain numbers, and numbers back.
#![allow(dead_code, unreachable_pub)]

pub mod make;
pub mod random;
pub mod scenes;

use whitted::frame::{Renderer, Settings};
use whitted::math::Arithmetic;
use whitted::scene::{Camera, Scene};
use whitted::shape::{Leaving, Ray};
use whitted::trace::Work;

/// Numbers of an arithmetic from `f64`, through its public operations alone.
pub trait FromF64: Arithmetic {
    fn length(x: f64) -> Self::Length;
    fn unit(x: f64) -> Self::Unit;
    fn coefficient(x: f64) -> Self::Weight;
    fn camera() -> Camera<Self>;
}

macro_rules! float {
    ($f:ident) => {
        impl FromF64 for $f {
            fn length(x: f64) -> $f {
                x as $f
            }
            fn unit(x: f64) -> $f {
                x as $f
            }
            fn coefficient(x: f64) -> $f {
                x as $f
            }
            fn camera() -> Camera<$f> {
                Camera::<$f>::look_at([0.0; 3], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0], 60.0)
            }
        }
    };
}
float!(f32);
float!(f64);

impl FromF64 for whitted::math::Fixed {
    fn length(x: f64) -> Self::Length {
        Self::Length::from_num(x)
    }
    fn unit(x: f64) -> Self::Unit {
        Self::Unit::from_bits((x * 131072.0).round() as i32)
    }
    fn coefficient(x: f64) -> Self::Weight {
        Self::Weight::from_bits((x * 16384.0).round() as i32)
    }
    fn camera() -> Camera<Self> {
        Camera::<Self>::look_at([0.0; 3], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0], 60.0)
    }
}

pub fn weight<A: FromF64>(x: f64) -> A::Weight {
    A::coefficient(x)
}

pub fn ray<A: FromF64>(origin: [f64; 3], direction: [f64; 3]) -> Ray<A> {
    let n = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
    Ray {
        origin: origin.map(A::length),
        direction: direction.map(|x| A::unit(x / n)),
        leaving: Leaving::NOTHING,
    }
}

/// The radiance along a ray.
pub fn radiance<A: FromF64>(
    scene: &Scene<'_, A>,
    depth: u8,
    origin: [f64; 3],
    direction: [f64; 3],
) -> [f64; 3] {
    let mut work = Work::<A, 8>::new();
    let settings = Settings { depth, ..Settings::new(1, 1) };
    let mut renderer =
        Renderer::new(scene, &A::camera(), settings, &mut work, &mut []).expect("settings");
    renderer.radiance(&ray(origin, direction)).map(Into::into)
}

/// An origin and the direction from there to a point.
pub fn toward(eye: [f64; 3], at: [f64; 3]) -> ([f64; 3], [f64; 3]) {
    (eye, [0, 1, 2].map(|i| at[i] - eye[i]))
}

pub fn close<A: Arithmetic>(got: [f64; 3], exact: [f64; 3], tol: f64) {
    for i in 0..3 {
        assert!((got[i] - exact[i]).abs() <= tol, "{}: {got:?} for {exact:?}", A::NAME);
    }
}

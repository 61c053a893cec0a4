//! Making the core's parts in an arithmetic that isn't known yet.
//!
//! The core's constructors are const fns of each arithmetic, and a const fn can't be a trait's.
//! Here they are, as a trait.

use whitted::math::{Arithmetic, Fixed};
use whitted::scene::{
    Ambient, Background, Camera, Light, LightSpec, Material, MaterialSpec, Parts, Scene, SceneError,
};
use whitted::shape::{Plane, ShapeError, Sphere};

type Point = [f64; 3];

/// An arithmetic whose scenes can be made at run time.
pub trait Construct: Arithmetic {
    /// A scene has to be placed into the arithmetic's range first.
    const NARROW: bool;

    /// See [`Sphere`].
    fn sphere(center: Point, radius: f64, material: u16) -> Result<Sphere<Self>, ShapeError>;
    /// See [`Plane`].
    fn plane(normal: Point, offset: f64, material: u16) -> Result<Plane<Self>, ShapeError>;
    /// See [`Material`].
    fn material(spec: &MaterialSpec) -> Result<Material<Self>, ShapeError>;
    /// See [`Light`].
    fn light(spec: &LightSpec) -> Result<Light<Self>, ShapeError>;
    /// See [`Camera`]; `tangent` is that of half the vertical angle from edge to edge.
    fn camera(eye: Point, at: Point, up: Point, tangent: f64) -> Result<Camera<Self>, ShapeError>;
    /// One radiance everywhere.
    fn uniform(color: Point) -> Result<Background<Self>, ShapeError>;
    /// A gradient along `up`.
    fn gradient(up: Point, bottom: Point, top: Point) -> Result<Background<Self>, ShapeError>;
    /// The ambient irradiance.
    fn ambient(color: Point) -> Result<Ambient<Self>, ShapeError>;
    /// A coefficient.
    fn cutoff(value: f64) -> Self::Weight;
    /// See [`Scene::new`].
    fn scene(parts: Parts<'_, Self>) -> Result<Scene<'_, Self>, SceneError>;
}

macro_rules! construct {
    ($arithmetic:ty, narrow: $narrow:expr, weight: $weight:expr) => {
        impl Construct for $arithmetic {
            const NARROW: bool = $narrow;

            fn sphere(center: Point, r: f64, material: u16) -> Result<Sphere<Self>, ShapeError> {
                Sphere::<Self>::try_new(center, r, material)
            }

            fn plane(normal: Point, offset: f64, material: u16) -> Result<Plane<Self>, ShapeError> {
                Plane::<Self>::try_new(normal, offset, material)
            }

            fn material(spec: &MaterialSpec) -> Result<Material<Self>, ShapeError> {
                Material::<Self>::try_new(spec)
            }

            fn light(spec: &LightSpec) -> Result<Light<Self>, ShapeError> {
                Light::<Self>::try_new(spec)
            }

            fn camera(
                eye: Point,
                at: Point,
                up: Point,
                tangent: f64,
            ) -> Result<Camera<Self>, ShapeError> {
                Camera::<Self>::try_look_at(eye, at, up, tangent)
            }

            fn uniform(color: Point) -> Result<Background<Self>, ShapeError> {
                Background::<Self>::try_uniform(color)
            }

            fn gradient(
                up: Point,
                bottom: Point,
                top: Point,
            ) -> Result<Background<Self>, ShapeError> {
                Background::<Self>::try_gradient(up, bottom, top)
            }

            fn ambient(color: Point) -> Result<Ambient<Self>, ShapeError> {
                Ambient::<Self>::try_new(color)
            }

            fn cutoff(value: f64) -> Self::Weight {
                $weight(value)
            }

            fn scene(parts: Parts<'_, Self>) -> Result<Scene<'_, Self>, SceneError> {
                Scene::new(parts)
            }
        }
    };
}

construct!(Fixed, narrow: true, weight: <Fixed as Arithmetic>::Weight::saturating_from_num);
construct!(f32, narrow: false, weight: |value: f64| value as f32);
construct!(f64, narrow: false, weight: |value: f64| value);

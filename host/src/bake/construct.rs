//! Making the core's parts in an arithmetic that isn't known yet.
//!
//! The core's constructors are const fns of each arithmetic, and a const fn can't be a trait's.
//! Here they are, as a trait.

use whitted::gather::{
    Gathering, GatheringSpec, Record, RecordSpec, VirtualLight, VirtualLightSpec,
    VirtualLightsSettings, VirtualLightsSpec,
};
use whitted::math::{Arithmetic, Fixed};
use whitted::octree::{Cube, Extent, Limits, Octree, TreeError};
use whitted::scene::{
    Absorption, Ambient, AreaLight, AreaLightSpec, Background, Camera, FanCorner, Group, Instance,
    Light, LightSpec, Material, MaterialSpec, Parts, Rules, Scene, SceneError, Selection, Shapes,
    Texture, TextureSpec, Transform,
};
use whitted::shape::{
    Cone, Cuboid, Cylinder, Disc, Operand, Plane, Polygon, PolygonEdge, Region, ShapeError,
    SmoothTriangle, Solid, Sphere, Triangle,
};

type Point = [f64; 3];
type Made<T> = Result<T, ShapeError>;

macro_rules! construct {
    (
        $(
            $(#[$about:meta])*
            fn $name:ident$(<$life:lifetime>)?($($argument:ident: $type:ty),*) -> $made:ty
                = |$A:ident| $make:expr;
        )*
    ) => {
        /// An arithmetic whose scenes can be made at run time: the core's constructors.
        ///
        /// # Errors
        /// Each function has the errors of the constructor that it stands for.
        pub trait Construct: Arithmetic {
            /// A scene has to be placed into the arithmetic's range first.
            const NARROW: bool;
            /// How far octrees go.
            const LIMITS: Limits;

            /// The rules of [`Rules::COURSE`] with another cut-off, 0 to 1.
            fn rules_with_cutoff(cutoff: f64) -> Rules<Self>;
            $(
                $(#[$about])*
                #[allow(clippy::missing_errors_doc)]
                fn $name$(<$life>)?($($argument: $type),*) -> $made;
            )*
        }

        construct!(@for Fixed, true, Limits::DEFAULT;
            $(fn $name$(<$life>)?($($argument: $type),*) -> $made = |$A| $make;)*);
        construct!(@for f32, false, FLOAT_LIMITS;
            $(fn $name$(<$life>)?($($argument: $type),*) -> $made = |$A| $make;)*);
        construct!(@for f64, false, FLOAT_LIMITS;
            $(fn $name$(<$life>)?($($argument: $type),*) -> $made = |$A| $make;)*);
    };
    (@for $a:ty, $narrow:expr, $limits:expr;
        $(fn $name:ident$(<$life:lifetime>)?($($argument:ident: $type:ty),*) -> $made:ty
            = |$A:ident| $make:expr;)*
    ) => {
        impl Construct for $a {
            const NARROW: bool = $narrow;
            const LIMITS: Limits = $limits;

            fn rules_with_cutoff(cutoff: f64) -> Rules<Self> {
                Rules::<$a>::with_cutoff(cutoff)
            }
            $(
                fn $name$(<$life>)?($($argument: $type),*) -> $made {
                    type $A = $a;
                    $make
                }
            )*
        }
    };
}

/// Floats walk without rounding worth the name, so trees can be deeper and margins smaller.
const FLOAT_LIMITS: Limits = Limits { levels: 12, leaf: 2, precision: 16 };

construct! {
    /// See [`Sphere`].
    fn new_sphere(center: Point, radius: f64, material: u16) -> Made<Sphere<Self>>
        = |A| Sphere::<A>::try_new(center, radius, material);
    /// See [`Triangle`].
    fn new_triangle(corners: [Point; 3], material: u16) -> Made<Triangle<Self>>
        = |A| Triangle::<A>::try_new(corners, material);
    /// See [`SmoothTriangle`].
    fn new_smooth_triangle(
        corners: [Point; 3], normals: [Point; 3], material: u16
    ) -> Made<SmoothTriangle<Self>>
        = |A| SmoothTriangle::<A>::try_new(corners, normals, material);
    /// See [`Polygon`].
    fn new_polygon(corners: &[Point], first_edge: u32, material: u16) -> Made<Polygon<Self>>
        = |A| Polygon::<A>::try_new(corners, first_edge, material);
    /// See [`Polygon`].
    fn new_polygon_edge(corners: &[Point], i: usize) -> Made<PolygonEdge<Self>>
        = |A| Polygon::<A>::try_edge(corners, i);
    /// See [`Cuboid`].
    fn new_cuboid(min: Point, max: Point, material: u16) -> Made<Cuboid<Self>>
        = |A| Cuboid::<A>::try_new(min, max, material);
    /// See [`Disc`].
    fn new_disc(center: Point, normal: Point, radius: f64, material: u16) -> Made<Disc<Self>>
        = |A| Disc::<A>::try_new(center, normal, radius, material);
    /// See [`Cylinder`].
    fn new_cylinder(base: Point, apex: Point, radius: f64, material: u16) -> Made<Cylinder<Self>>
        = |A| Cylinder::<A>::try_new(base, apex, radius, material);
    /// See [`Cone`].
    fn new_cone(base: Point, r: f64, apex: Point, apex_r: f64, material: u16) -> Made<Cone<Self>>
        = |A| Cone::<A>::try_new(base, r, apex, apex_r, material);
    /// See [`Solid`].
    fn new_solid(
        region: Region, operands: &[Operand<Self>], first: u32, count: u8
    ) -> Made<Solid<Self>>
        = |A| Solid::<A>::try_new(region, operands, first, count);
    /// See [`Plane`].
    fn new_plane(normal: Point, offset: f64, material: u16) -> Made<Plane<Self>>
        = |A| Plane::<A>::try_new(normal, offset, material);

    /// See [`Gathering`].
    fn new_gathering(spec: &GatheringSpec) -> Made<Gathering<Self>>
        = |A| Gathering::<A>::try_new(spec);
    /// See [`VirtualLightsSettings`].
    fn new_virtual_lights(spec: &VirtualLightsSpec) -> Made<VirtualLightsSettings<Self>>
        = |A| VirtualLightsSettings::<A>::try_new(spec);

    /// See [`Record`].
    fn new_record(spec: &RecordSpec) -> Made<Record<Self>>
        = |A| Record::<A>::try_new(spec);
    /// See [`VirtualLight`].
    fn new_virtual_light(spec: &VirtualLightSpec) -> Made<VirtualLight<Self>>
        = |A| VirtualLight::<A>::try_new(spec);
    /// See [`VirtualLight`].
    fn virtual_light_spec(light: &VirtualLight<Self>) -> VirtualLightSpec
        = |A| { let light: &VirtualLight<A> = light; light.spec() };

    /// Where a sphere lies.
    fn sphere_extent(shape: &Sphere<Self>, log2_step: i8) -> Extent
        = |A| { let shape: &Sphere<A> = shape; shape.extent(log2_step) };
    /// Where a triangle lies.
    fn triangle_extent(corners: [Point; 3], log2_step: i8) -> Extent
        = |A| Triangle::<A>::extent_of(corners, log2_step);
    /// Where a polygon lies.
    fn polygon_extent(corners: &[Point], log2_step: i8) -> Extent
        = |A| Polygon::<A>::extent_of(corners, log2_step);
    /// Where a box lies.
    fn cuboid_extent(shape: &Cuboid<Self>, log2_step: i8) -> Extent
        = |A| { let shape: &Cuboid<A> = shape; shape.extent(log2_step) };
    /// Where a disc lies.
    fn disc_extent(shape: &Disc<Self>, log2_step: i8) -> Extent
        = |A| { let shape: &Disc<A> = shape; shape.extent(log2_step) };
    /// Where a cylinder lies.
    fn cylinder_extent(shape: &Cylinder<Self>, log2_step: i8) -> Extent
        = |A| { let shape: &Cylinder<A> = shape; shape.extent(log2_step) };
    /// Where a cone lies.
    fn cone_extent(shape: &Cone<Self>, log2_step: i8) -> Extent
        = |A| { let shape: &Cone<A> = shape; shape.extent(log2_step) };
    /// Where a solid lies.
    fn solid_extent(shape: &Solid<Self>, log2_step: i8) -> Extent
        = |A| { let shape: &Solid<A> = shape; shape.extent(log2_step) };
    /// See [`Octree`].
    fn new_octree<'t>(
        words: &'t [u32], shapes: usize, cube: &Cube, log2_step: i8
    ) -> Result<Octree<'t, Self>, TreeError>
        = |A| Octree::<A>::try_new(words, shapes, cube, log2_step);

    /// See [`Material`].
    fn new_material(spec: &MaterialSpec) -> Made<Material<Self>>
        = |A| Material::<A>::try_new(spec);
    /// See [`Texture`].
    fn new_texture(spec: &TextureSpec<'static>) -> Made<Texture<'static, Self>>
        = |A| Texture::<A>::try_new(spec);
    /// See [`Absorption`].
    fn new_absorption(front: Point, behind: Point) -> Made<Absorption<Self>>
        = |A| Absorption::<A>::try_new(front, behind);
    /// See [`Light`].
    fn new_light(spec: &LightSpec) -> Made<Light<Self>>
        = |A| Light::<A>::try_new(spec);
    /// See [`AreaLight`].
    fn new_area_light(spec: &AreaLightSpec<'_>) -> Made<AreaLight<Self>>
        = |A| AreaLight::<A>::try_new(spec);
    /// See [`Selection`].
    fn new_threshold(radiance: f64) -> Made<Selection<Self>>
        = |A| Selection::<A>::try_above(radiance);
    /// See [`AreaLight::fan`].
    fn new_fan_corner(corners: &[Point], i: usize) -> Made<FanCorner<Self>>
        = |A| AreaLight::<A>::try_fan(corners, i);
    /// See [`Camera`]; `tangent` is that of half the vertical angle from edge to edge.
    fn new_camera(eye: Point, at: Point, up: Point, tangent: f64) -> Made<Camera<Self>>
        = |A| Camera::<A>::try_look_at(eye, at, up, tangent);
    /// One radiance everywhere.
    fn new_uniform(color: Point) -> Made<Background<Self>>
        = |A| Background::<A>::try_uniform(color);
    /// A gradient along `up`.
    fn new_gradient(up: Point, bottom: Point, top: Point) -> Made<Background<Self>>
        = |A| Background::<A>::try_gradient(up, bottom, top);
    /// The ambient irradiance.
    fn new_ambient(color: Point) -> Made<Ambient<Self>>
        = |A| Ambient::<A>::try_new(color);
    /// See [`Group`].
    fn new_group<'s>(shapes: Shapes<'s, Self>) -> Result<Group<'s, Self>, SceneError>
        = |A| Group::<A>::try_new(shapes);
    /// See [`Instance`].
    fn new_instance<'s>(
        group: &'s Group<'s, Self>, transform: &Transform
    ) -> Made<Instance<'s, Self>>
        = |A| Instance::<A>::try_new(group, transform);
    /// See [`Scene::new`].
    fn new_scene<'s>(parts: Parts<'s, Self>) -> Result<Scene<'s, Self>, SceneError>
        = |A| Scene::<A>::new(parts);
}

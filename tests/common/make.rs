//! Scenes made at run time, in any arithmetic.
//!
//! The library's constructors are const fns of each arithmetic, and a const fn can't be a
//! trait's: here they are, as a trait.

use super::FromF64;
use super::random::Random;
use whitted::math::{Fixed, Rgb};
use whitted::octree::{BuildError, Built, Cube, Extent, Limits, Octree, TreeError, build_into};
use whitted::scene::{
    Ambient, AreaLight, AreaLightSpec, Background, Camera, FanCorner, Light, LightSpec, Material,
    MaterialSpec, Parts,
};
use whitted::shape::{
    Cone, Cuboid, Cylinder, Disc, Plane, Polygon, PolygonEdge, ShapeError, SmoothTriangle, Sphere,
    Triangle,
};

type Point = [f64; 3];

/// A shape in plain numbers.
#[derive(Clone, Debug, PartialEq)]
pub enum Body {
    Sphere(Point, f64),
    Triangle([Point; 3]),
    Smooth([Point; 3], [Point; 3]),
    Polygon(Vec<Point>),
    Cuboid(Point, Point),
    Disc(Point, Point, f64),
    Cylinder(Point, Point, f64),
    Cone(Point, f64, Point, f64),
    Plane(Point, f64),
}

/// The shapes of a scene by kind, and the memory of their tree.
#[derive(Clone, Debug)]
pub struct Shapes<A: FromF64> {
    pub spheres: Vec<Sphere<A>>,
    pub triangles: Vec<Triangle<A>>,
    pub smooth_triangles: Vec<SmoothTriangle<A>>,
    pub polygons: Vec<Polygon<A>>,
    pub edges: Vec<PolygonEdge<A>>,
    pub cuboids: Vec<Cuboid<A>>,
    pub discs: Vec<Disc<A>>,
    pub cylinders: Vec<Cylinder<A>>,
    pub cones: Vec<Cone<A>>,
    pub planes: Vec<Plane<A>>,
    words: Vec<u32>,
    cube: Option<Cube>,
    log2_step: i8,
}

impl<A: Make> Shapes<A> {
    /// The shapes that the arithmetic can make; the others are left out.
    pub fn of(bodies: &[(Body, u16)], log2_step: i8) -> Self {
        let mut shapes = Self {
            spheres: Vec::new(),
            triangles: Vec::new(),
            smooth_triangles: Vec::new(),
            polygons: Vec::new(),
            edges: Vec::new(),
            cuboids: Vec::new(),
            discs: Vec::new(),
            cylinders: Vec::new(),
            cones: Vec::new(),
            planes: Vec::new(),
            words: Vec::new(),
            cube: None,
            log2_step,
        };
        for (body, material) in bodies {
            let _ = A::add(&mut shapes, body, *material);
        }
        shapes
    }

    /// Builds the tree, at run time.
    pub fn grow(&mut self, limits: Limits) -> Built {
        self.try_grow(limits).expect("a tree")
    }

    /// The same where it may not be possible.
    pub fn try_grow(&mut self, limits: Limits) -> Result<Built, BuildError> {
        let extents = A::extents(self);
        let (mut words, mut scratch) = (vec![0; 1 << 17], vec![0; 1 << 17]);
        let built = build_into(&extents, &mut words, &mut scratch, limits)?;
        words.truncate(built.words);
        self.words = words;
        self.cube = Some(built.cube);
        Ok(built)
    }

    /// How many there are besides planes.
    pub fn bounded(&self) -> usize {
        self.parts().bounded() as usize
    }

    /// The parts, with the tree if it has been built; all but shapes is empty.
    pub fn parts(&self) -> Parts<'_, A> {
        let mut parts = Parts {
            spheres: &self.spheres,
            triangles: &self.triangles,
            smooth_triangles: &self.smooth_triangles,
            polygons: &self.polygons,
            edges: &self.edges,
            cuboids: &self.cuboids,
            discs: &self.discs,
            cylinders: &self.cylinders,
            cones: &self.cones,
            planes: &self.planes,
            ..Parts::EMPTY
        };
        if let Some(cube) = &self.cube {
            let count = parts.bounded() as usize;
            let tree = A::octree(&self.words, count, cube, self.log2_step);
            parts.tree = Some(tree.expect("a tree that was just built"));
        }
        parts
    }
}

/// An arithmetic's constructors.
pub trait Make: FromF64 {
    fn add(shapes: &mut Shapes<Self>, body: &Body, material: u16) -> Result<(), ShapeError>;
    fn extents(shapes: &Shapes<Self>) -> Vec<Extent>;
    fn octree<'a>(
        words: &'a [u32],
        shapes: usize,
        cube: &Cube,
        log2_step: i8,
    ) -> Result<Octree<'a, Self>, TreeError>;
    fn material(spec: &MaterialSpec) -> Result<Material<Self>, ShapeError>;
    fn light(spec: &LightSpec) -> Result<Light<Self>, ShapeError>;
    fn area_light(spec: &AreaLightSpec<'_>) -> Result<AreaLight<Self>, ShapeError>;
    fn fan_corner(corners: &[Point], i: usize) -> Result<FanCorner<Self>, ShapeError>;
    fn uniform(radiance: Rgb<f64>) -> Result<Background<Self>, ShapeError>;
    fn gradient(up: Point, bottom: Rgb<f64>, top: Rgb<f64>)
    -> Result<Background<Self>, ShapeError>;
    fn ambient(irradiance: Rgb<f64>) -> Result<Ambient<Self>, ShapeError>;
    fn look_at(eye: Point, at: Point, up: Point, tangent: f64) -> Result<Camera<Self>, ShapeError>;
    fn vectors(e: Point, f: Point, r: Point, d: Point) -> Result<Camera<Self>, ShapeError>;
}

macro_rules! make {
    ($($a:ident),*) => {$(
        impl Make for $a {
            fn add(s: &mut Shapes<$a>, body: &Body, m: u16) -> Result<(), ShapeError> {
                match body {
                    Body::Sphere(c, r) => s.spheres.push(Sphere::<$a>::try_new(*c, *r, m)?),
                    Body::Triangle(c) => s.triangles.push(Triangle::<$a>::try_new(*c, m)?),
                    Body::Smooth(c, n) => {
                        s.smooth_triangles.push(SmoothTriangle::<$a>::try_new(*c, *n, m)?);
                    }
                    Body::Polygon(c) => {
                        let first = s.edges.len() as u32;
                        s.polygons.push(Polygon::<$a>::try_new(c, first, m)?);
                        for i in 0..c.len() {
                            let edge = Polygon::<$a>::try_edge(c, i);
                            s.edges.push(edge.expect("an edge of a good polygon"));
                        }
                    }
                    Body::Cuboid(a, b) => s.cuboids.push(Cuboid::<$a>::try_new(*a, *b, m)?),
                    Body::Disc(c, n, r) => s.discs.push(Disc::<$a>::try_new(*c, *n, *r, m)?),
                    Body::Cylinder(b, a, r) => {
                        s.cylinders.push(Cylinder::<$a>::try_new(*b, *a, *r, m)?);
                    }
                    Body::Cone(b, r, a, q) => {
                        s.cones.push(Cone::<$a>::try_new(*b, *r, *a, *q, m)?);
                    }
                    Body::Plane(n, o) => s.planes.push(Plane::<$a>::try_new(*n, *o, m)?),
                }
                Ok(())
            }

            fn extents(s: &Shapes<$a>) -> Vec<Extent> {
                let step = s.log2_step;
                let mut all: Vec<Extent> = s.spheres.iter().map(|x| x.extent(step)).collect();
                all.extend(s.triangles.iter().map(|x| x.extent(step)));
                all.extend(s.smooth_triangles.iter().map(|x| x.extent(step)));
                all.extend(s.polygons.iter().map(|x| x.extent(step)));
                all.extend(s.cuboids.iter().map(|x| x.extent(step)));
                all.extend(s.discs.iter().map(|x| x.extent(step)));
                all.extend(s.cylinders.iter().map(|x| x.extent(step)));
                all.extend(s.cones.iter().map(|x| x.extent(step)));
                all
            }

            fn octree<'a>(
                words: &'a [u32],
                shapes: usize,
                cube: &Cube,
                log2_step: i8,
            ) -> Result<Octree<'a, $a>, TreeError> {
                Octree::<$a>::try_new(words, shapes, cube, log2_step)
            }

            fn material(spec: &MaterialSpec) -> Result<Material<$a>, ShapeError> {
                Material::<$a>::try_new(spec)
            }

            fn light(spec: &LightSpec) -> Result<Light<$a>, ShapeError> {
                Light::<$a>::try_new(spec)
            }

            fn area_light(spec: &AreaLightSpec<'_>) -> Result<AreaLight<$a>, ShapeError> {
                AreaLight::<$a>::try_new(spec)
            }

            fn fan_corner(corners: &[Point], i: usize) -> Result<FanCorner<$a>, ShapeError> {
                AreaLight::<$a>::try_fan(corners, i)
            }

            fn uniform(radiance: Rgb<f64>) -> Result<Background<$a>, ShapeError> {
                Background::<$a>::try_uniform(radiance)
            }

            fn gradient(
                up: Point,
                bottom: Rgb<f64>,
                top: Rgb<f64>,
            ) -> Result<Background<$a>, ShapeError> {
                Background::<$a>::try_gradient(up, bottom, top)
            }

            fn ambient(irradiance: Rgb<f64>) -> Result<Ambient<$a>, ShapeError> {
                Ambient::<$a>::try_new(irradiance)
            }

            fn look_at(
                eye: Point,
                at: Point,
                up: Point,
                tangent: f64,
            ) -> Result<Camera<$a>, ShapeError> {
                Camera::<$a>::try_look_at(eye, at, up, tangent)
            }

            fn vectors(e: Point, f: Point, r: Point, d: Point) -> Result<Camera<$a>, ShapeError> {
                Camera::<$a>::try_from_vectors(e, f, r, d)
            }
        }
    )*};
}
make!(Fixed, f32, f64);

fn add(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// A shape of any bounded kind (0 to 7) somewhere near `p`, of about the size `r`.
pub fn body(random: &mut Random, kind: u64, p: Point, r: f64) -> Body {
    let near = |random: &mut Random| add(p, random.point(r));
    match kind {
        0 => Body::Sphere(p, r),
        1 => Body::Triangle([near(random), near(random), near(random)]),
        2 => {
            let c = [near(random), near(random), near(random)];
            let (u, v) =
                ([0, 1, 2].map(|i| c[1][i] - c[0][i]), [0, 1, 2].map(|i| c[2][i] - c[0][i]));
            let n =
                [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            let l = n.iter().map(|x| x * x).sum::<f64>().sqrt().max(1e-9);
            let n = n.map(|x| x / l);
            let mut bent = || add(n, random.point(0.3));
            Body::Smooth(c, [bent(), bent(), bent()])
        }
        3 => {
            // on a circle around p, in the plane of two directions at right angles
            let n = random.direction();
            let least = (0..3).min_by(|&a, &b| n[a].abs().total_cmp(&n[b].abs())).unwrap_or(0);
            let mut u = n.map(|x| -x * n[least]);
            u[least] += 1.0;
            let l = u.iter().map(|x| x * x).sum::<f64>().sqrt();
            let u = u.map(|x| x / l);
            let v =
                [n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]];
            let count = 3 + random.below(6);
            let corner = |i: u64| {
                let (s, c) = (std::f64::consts::TAU * i as f64 / count as f64).sin_cos();
                [0, 1, 2].map(|j| p[j] + r * (c * u[j] + s * v[j]))
            };
            Body::Polygon((0..count).map(corner).collect())
        }
        4 => {
            let mut size = || random.within(0.1, 1.0) * r;
            let h = [size(), size(), size()];
            Body::Cuboid([0, 1, 2].map(|i| p[i] - h[i]), [0, 1, 2].map(|i| p[i] + h[i]))
        }
        5 => Body::Disc(p, random.direction(), r),
        6 => Body::Cylinder(p, near(random), r * random.within(0.1, 0.8)),
        _ => {
            let r0 = r * random.within(0.2, 0.9);
            let r1 = if random.below(3) == 0 { 0.0 } else { r * random.within(0.1, 0.9) };
            Body::Cone(p, r0, near(random), r1)
        }
    }
}

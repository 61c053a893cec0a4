//! The shapes of a scene by kinds, as the core numbers them, and the octree over them.

use whitted::octree::{BuildError, Built, Cube, Extent, Limits, Octree, build_into};
use whitted::scene::{Parts, TriangleUv};
use whitted::shape::{
    Cone, Cuboid, Cylinder, Disc, Operand, Plane, Polygon, PolygonEdge, Region, ShapeError,
    SmoothTriangle, Solid, Sphere, Triangle,
};

use super::Construct;
use crate::document::{Body, Bounds, Made, Shape, dot, normalized};
use crate::error::{Flaw, Problem};
use std::path::Path;

/// Below this a list is quicker than a tree.
const LEAST_FOR_A_TREE: usize = 10;

/// So many levels a tree for flash may have less than rays would like: each costs a fifth more
/// work, and the next one would cost twice as much.
const FEWER_LEVELS: usize = 3;

/// What the octree should save.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Thrift {
    /// Time: as many cells as make rays cheaper.
    Time,
    /// Flash: up to three levels less, where the tree would take more than two thirds of what the
    /// shapes take. The picture is the same.
    Flash,
}

/// The shapes of one kind, where they lie, and their places in the document.
#[derive(Debug)]
pub(super) struct Kind<T> {
    pub(super) shapes: Vec<T>,
    extents: Vec<Extent>,
    origins: Vec<usize>,
}

impl<T> Default for Kind<T> {
    fn default() -> Self {
        Self { shapes: Vec::new(), extents: Vec::new(), origins: Vec::new() }
    }
}

impl<T> Kind<T> {
    fn add(&mut self, shape: T, extent: Option<Extent>, origin: usize) {
        self.shapes.push(shape);
        self.extents.extend(extent);
        self.origins.push(origin);
    }
}

/// An octree's memory.
#[derive(Debug)]
struct Tree {
    words: Vec<u32>,
    cube: Cube,
    levels: u8,
}

/// All shapes of a scene, and the tree over them.
#[derive(Debug)]
pub(super) struct Shapes<A: Construct> {
    spheres: Kind<Sphere<A>>,
    triangles: Kind<Triangle<A>>,
    smooth_triangles: Kind<SmoothTriangle<A>>,
    polygons: Kind<Polygon<A>>,
    edges: Vec<PolygonEdge<A>>,
    /// The flat triangles', then the smooth ones'; empty if none has any.
    uvs: Vec<TriangleUv>,
    smooth_uvs: Vec<TriangleUv>,
    cuboids: Kind<Cuboid<A>>,
    discs: Kind<Disc<A>>,
    cylinders: Kind<Cylinder<A>>,
    cones: Kind<Cone<A>>,
    solids: Kind<Solid<A>>,
    operands: Vec<Operand<A>>,
    planes: Kind<Plane<A>>,
    log2_step: i8,
    tree: Option<Tree>,
}

/// Evaluates `$one` for each kind that a tree is over, in the order of the core's numbers.
macro_rules! bounded {
    ($self:expr, $kind:ident => $one:expr) => {{
        {
            let $kind = &$self.spheres;
            $one
        }
        {
            let $kind = &$self.triangles;
            $one
        }
        {
            let $kind = &$self.smooth_triangles;
            $one
        }
        {
            let $kind = &$self.polygons;
            $one
        }
        {
            let $kind = &$self.cuboids;
            $one
        }
        {
            let $kind = &$self.discs;
            $one
        }
        {
            let $kind = &$self.cylinders;
            $one
        }
        {
            let $kind = &$self.cones;
            $one
        }
        {
            let $kind = &$self.solids;
            $one
        }
    }};
}

impl<A: Construct> Shapes<A> {
    /// Makes shapes that have been placed and lie within the bounds, and the tree; `file` names
    /// the file that one came from.
    pub(super) fn new<'f>(
        all: &[Shape],
        bounds: Option<Bounds>,
        file: impl Fn(usize) -> Option<&'f Path>,
        thrift: Thrift,
    ) -> Result<Self, Flaw> {
        let mut shapes = Self {
            spheres: Kind::default(),
            triangles: Kind::default(),
            smooth_triangles: Kind::default(),
            polygons: Kind::default(),
            edges: Vec::new(),
            uvs: Vec::new(),
            smooth_uvs: Vec::new(),
            cuboids: Kind::default(),
            discs: Kind::default(),
            cylinders: Kind::default(),
            cones: Kind::default(),
            solids: Kind::default(),
            operands: Vec::new(),
            planes: Kind::default(),
            log2_step: step(bounds),
            tree: None,
        };
        for (index, shape) in all.iter().enumerate() {
            let from = file(index);
            let refuse =
                |e| super::refused::<A>(shape.body.name(), e, Some(shape.line)).within(from);
            let material = u16::try_from(shape.material).map_err(|_| refuse(ShapeError::Material));
            shapes.add(&shape.body, material?, index).map_err(refuse)?;
            shapes.add_uv(shape).map_err(refuse)?;
        }
        let smooth = std::mem::take(&mut shapes.smooth_uvs);
        shapes.uvs.extend(smooth);
        if all.iter().all(|shape| shape.uv.is_none()) {
            shapes.uvs.clear();
        }
        shapes.grow(thrift)?;
        Ok(shapes)
    }

    fn add(&mut self, body: &Body, material: u16, index: usize) -> Result<(), ShapeError> {
        let step = self.log2_step;
        match body {
            Body::Sphere { center, radius } => {
                let made = A::new_sphere(*center, *radius, material)?;
                self.spheres.add(made, Some(A::sphere_extent(&made, step)), index);
            }
            Body::Plane { point, normal } => {
                let offset = normalized(*normal).map_or(0.0, |n| dot(n, *point));
                self.planes.add(A::new_plane(*normal, offset, material)?, None, index);
            }
            Body::Disc { center, normal, radius } => {
                let made = A::new_disc(*center, *normal, *radius, material)?;
                self.discs.add(made, Some(A::disc_extent(&made, step)), index);
            }
            Body::Box { low, high } => {
                let made = A::new_cuboid(*low, *high, material)?;
                self.cuboids.add(made, Some(A::cuboid_extent(&made, step)), index);
            }
            Body::Triangle { corners } => {
                let made = A::new_triangle(*corners, material)?;
                self.triangles.add(made, Some(A::triangle_extent(*corners, step)), index);
            }
            Body::SmoothTriangle { corners, normals } => {
                let made = A::new_smooth_triangle(*corners, *normals, material)?;
                self.smooth_triangles.add(made, Some(A::triangle_extent(*corners, step)), index);
            }
            Body::Polygon { corners } => {
                let made = A::new_polygon(corners, self.edges.len() as u32, material)?;
                let edges = (0..corners.len()).map(|i| A::new_polygon_edge(corners, i));
                let edges = edges.collect::<Result<Vec<_>, _>>()?;
                self.edges.extend(edges);
                self.polygons.add(made, Some(A::polygon_extent(corners, step)), index);
            }
            Body::Cylinder { base, apex, radius, capped } => {
                let made = A::new_cylinder(*base, *apex, *radius, material)?;
                let made = if *capped { made.with_caps() } else { made };
                self.cylinders.add(made, Some(A::cylinder_extent(&made, step)), index);
            }
            Body::Cone { base, base_radius, apex, apex_radius, capped } => {
                let made = A::new_cone(*base, *base_radius, *apex, *apex_radius, material)?;
                let made = if *capped { made.with_caps() } else { made };
                self.cones.add(made, Some(A::cone_extent(&made, step)), index);
            }
            Body::Solid(solid) => {
                let first = self.operands.len() as u32;
                for shape in &solid.operands {
                    self.operands.push(operand(shape)?);
                }
                let count = u8::try_from(solid.operands.len()).unwrap_or(u8::MAX);
                let made = A::new_solid(region(&solid.made), &self.operands, first, count)?;
                self.solids.add(made, Some(A::solid_extent(&made, step)), index);
            }
        }
        Ok(())
    }

    /// A triangle's texture coordinates, (0, 0) if it has none.
    fn add_uv(&mut self, shape: &Shape) -> Result<(), ShapeError> {
        let uvs = match shape.body {
            Body::Triangle { .. } => &mut self.uvs,
            Body::SmoothTriangle { .. } => &mut self.smooth_uvs,
            _ => return Ok(()),
        };
        uvs.push(TriangleUv::try_new(shape.uv.unwrap_or_default())?);
        Ok(())
    }

    /// Builds the tree.
    fn grow(&mut self, thrift: Thrift) -> Result<(), Flaw> {
        let mut extents = Vec::new();
        bounded!(self, kind => extents.extend_from_slice(&kind.extents));
        if extents.len() < LEAST_FOR_A_TREE {
            return Ok(());
        }
        let mut limits = A::LIMITS;
        let mut tree = build(&extents, limits)?;
        if thrift == Thrift::Flash {
            let mut shapes = size_of_val(self.edges.as_slice());
            bounded!(self, kind => shapes += size_of_val(kind.shapes.as_slice()));
            for _ in 0..FEWER_LEVELS {
                if 3 * size_of_val(tree.words.as_slice()) <= 2 * shapes || tree.levels == 0 {
                    break;
                }
                limits.levels = tree.levels - 1;
                tree = build(&extents, limits)?;
            }
        }
        self.tree = Some(tree);
        Ok(())
    }

    /// The shapes and the tree, as the core wants them; the rest is empty.
    pub(super) fn parts(&self) -> Result<Parts<'_, A>, Flaw> {
        let tree = |t| {
            let t: &Tree = t;
            let shapes = self.bounded() as usize;
            let tree: Result<Octree<'_, A>, _> =
                A::new_octree(&t.words, shapes, &t.cube, self.log2_step);
            tree.map_err(|error| unfit(&error))
        };
        Ok(Parts {
            spheres: &self.spheres.shapes,
            triangles: &self.triangles.shapes,
            smooth_triangles: &self.smooth_triangles.shapes,
            polygons: &self.polygons.shapes,
            edges: &self.edges,
            uvs: &self.uvs,
            cuboids: &self.cuboids.shapes,
            discs: &self.discs.shapes,
            cylinders: &self.cylinders.shapes,
            cones: &self.cones.shapes,
            solids: &self.solids.shapes,
            operands: &self.operands,
            planes: &self.planes.shapes,
            tree: self.tree.as_ref().map(tree).transpose()?,
            ..Parts::EMPTY
        })
    }

    /// How many there are besides planes.
    pub(super) fn bounded(&self) -> u32 {
        let mut count = 0;
        bounded!(self, kind => count += kind.shapes.len());
        count as u32
    }

    /// The document's index of the plane that is the `n`th.
    pub(super) fn plane_origin(&self, n: u32) -> Option<usize> {
        self.planes.origins.get(n as usize).copied()
    }

    /// The document's index of the bounded shape of this number; how far it lies beyond the last
    /// one, if it does.
    pub(super) fn origin(&self, shape: u32) -> Result<usize, u32> {
        let mut left = shape as usize;
        bounded!(self, kind => {
            if let Some(&origin) = kind.origins.get(left) {
                return Ok(origin);
            }
            left -= kind.origins.len();
        });
        Err(left as u32)
    }

    /// The tree's words, its cube, and the step of its grid, if there is a tree.
    pub(super) fn words(&self) -> Option<(&[u32], Cube, i8)> {
        self.tree.as_ref().map(|tree| (tree.words.as_slice(), tree.cube, self.log2_step))
    }

    /// The number of the shape of this index in the document.
    pub(super) fn number(&self, index: usize) -> Option<u32> {
        (0..self.bounded()).find(|&number| self.origin(number) == Ok(index))
    }

    /// Words and levels of the tree, if there is one.
    pub(super) fn tree(&self) -> Option<(usize, u8)> {
        self.tree.as_ref().map(|tree| (tree.words.len(), tree.levels))
    }
}

/// Builds a tree, in as much memory as it takes.
fn build(extents: &[Extent], limits: Limits) -> Result<Tree, Flaw> {
    let mut room = 8 * extents.len();
    loop {
        let (mut words, mut scratch) = (vec![0; room], vec![0; room]);
        match build_into(extents, &mut words, &mut scratch, limits) {
            Ok(Built { words: used, cube, levels, .. }) => {
                words.truncate(used);
                return Ok(Tree { words, cube, levels });
            }
            // More than this no tree needs that is worth having.
            Err(BuildError::Words | BuildError::Scratch) if room < 4096 * extents.len() => {
                room *= 2;
            }
            Err(error) => return Err(unfit(&error)),
        }
    }
}

fn operand<A: Construct>(shape: &Shape) -> Result<Operand<A>, ShapeError> {
    let material = u16::try_from(shape.material).map_err(|_| ShapeError::Material)?;
    Ok(match &shape.body {
        Body::Sphere { center, radius } => {
            Operand::Sphere(A::new_sphere(*center, radius.abs(), material)?)
        }
        Body::Box { low, high } => Operand::Cuboid(A::new_cuboid(*low, *high, material)?),
        Body::Cylinder { base, apex, radius, .. } => {
            Operand::Cylinder(A::new_cylinder(*base, *apex, radius.abs(), material)?)
        }
        Body::Cone { base, base_radius, apex, apex_radius, .. } => {
            let (r, q) = (base_radius.abs(), apex_radius.abs());
            Operand::Cone(A::new_cone(*base, r, *apex, q, material)?)
        }
        Body::Plane { point, normal } => {
            let offset = normalized(*normal).map_or(0.0, |n| dot(n, *point));
            Operand::HalfSpace(A::new_plane(*normal, offset, material)?)
        }
        _ => return Err(ShapeError::Operands),
    })
}

fn region(made: &Made) -> Region {
    let all = |parts: &[Made], with: fn(Region, Region) -> Region| {
        parts.iter().map(region).reduce(with).unwrap_or(Region::NOTHING)
    };
    match made {
        Made::Of(index) => Region::of(*index),
        Made::Union(parts) => all(parts, Region::or),
        Made::Intersection(parts) => all(parts, Region::and),
        Made::Difference(parts) => all(parts, Region::minus),
    }
}

fn unfit(error: &dyn std::error::Error) -> Flaw {
    let (what, why) = ("the octree".to_string(), error.to_string());
    Problem::Unrepresentable { what, why }.anywhere()
}

/// The grid that floating-point octrees are built on: its farthest coordinate is 2²⁵ to 2²⁶.
fn step(bounds: Option<Bounds>) -> i8 {
    let Some(bounds) = bounds else { return -26 };
    let coordinates = bounds.low.into_iter().chain(bounds.high);
    let farthest = coordinates.map(f64::abs).fold(f64::MIN_POSITIVE, f64::max);
    (farthest.log2().ceil() as i32 - 26).clamp(-80, 60) as i8
}

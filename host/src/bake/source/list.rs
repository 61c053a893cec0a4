//! The shapes of a scene or of a group as Rust source: a static list for each kind, and the tree
//! over them.

use std::fmt::{self, Write as _};

use super::write_list;
use crate::bake::Construct;
use crate::bake::shapes::Shapes;
use crate::document::{Body, Made, Point, Shape, dot, normalized};

/// Lists of values as source, each of a kind of shape.
#[derive(Default)]
struct Lists {
    spheres: Vec<String>,
    triangles: Vec<String>,
    smooth_triangles: Vec<String>,
    polygons: Vec<String>,
    edges: Vec<String>,
    uvs: Vec<String>,
    smooth_uvs: Vec<String>,
    cuboids: Vec<String>,
    discs: Vec<String>,
    cylinders: Vec<String>,
    cones: Vec<String>,
    solids: Vec<String>,
    operands: Vec<String>,
    planes: Vec<String>,
    /// What the lists name: the corners and edges of each polygon.
    before: String,
}

/// Writes the lists of `all`, whose names start with `prefix`, and the tree over those that have
/// an end; gives the fields of `Parts` (of `Shapes`, for a group) with what stands in them.
pub(super) fn write<A: Construct>(
    to: &mut String,
    prefix: &str,
    all: &[Shape],
    shapes: &Shapes<A>,
) -> Result<Vec<(&'static str, String)>, fmt::Error> {
    let mut lists = Lists::default();
    for shape in all {
        lists.add(prefix, shape)?;
    }
    let smooth = std::mem::take(&mut lists.smooth_uvs);
    lists.uvs.extend(smooth);
    if all.iter().all(|shape| shape.uv.is_none()) {
        lists.uvs.clear();
    }
    to.push_str(&lists.before);
    let kinds = [
        ("spheres", "shape::Sphere<A>", lists.spheres),
        ("triangles", "shape::Triangle<A>", lists.triangles),
        ("smooth_triangles", "shape::SmoothTriangle<A>", lists.smooth_triangles),
        ("polygons", "shape::Polygon<A>", lists.polygons),
        ("edges", "shape::PolygonEdge<A>", lists.edges),
        ("uvs", "scene::TriangleUv", lists.uvs),
        ("cuboids", "shape::Cuboid<A>", lists.cuboids),
        ("discs", "shape::Disc<A>", lists.discs),
        ("cylinders", "shape::Cylinder<A>", lists.cylinders),
        ("cones", "shape::Cone<A>", lists.cones),
        ("operands", "shape::Operand<A>", lists.operands),
        ("solids", "shape::Solid<A>", lists.solids),
        ("planes", "shape::Plane<A>", lists.planes),
    ];
    let mut written = Vec::new();
    for (field, kind, values) in kinds {
        if !values.is_empty() {
            let name = format!("{prefix}{}", field.to_uppercase());
            write_list(to, &name, &format!("whitted::{kind}"), &values)?;
            written.push((field, format!("&{name}")));
        }
    }
    if let Some((words, cube, step)) = shapes.words() {
        let list: Vec<String> = words.iter().map(|word| format!("{word:#x}")).collect();
        write_list(to, &format!("{prefix}WORDS"), "u32", &list)?;
        write!(
            to,
            "#[allow(long_running_const_eval)]\n\
             const {prefix}TREE: whitted::octree::Octree<'static, A> = {{\n    \
             let cube = whitted::octree::Cube {{ origin: {:?}, log2_side: {} }};\n    \
             match whitted::octree::Octree::<A>::try_new(&{prefix}WORDS, {}, &cube, {step}) {{\n        \
             Ok(tree) => tree,\n        Err(_) => panic!(\"the octree\"),\n    }}\n}};\n\n",
            cube.origin,
            cube.log2_side,
            shapes.bounded(),
        )?;
        written.push(("tree", format!("Some({prefix}TREE)")));
    }
    Ok(written)
}

impl Lists {
    fn add(&mut self, prefix: &str, shape: &Shape) -> fmt::Result {
        let made = |kind: &str, arguments: String| new(kind, &arguments, shape.material);
        let uv = || format!("whitted::scene::TriangleUv::new({:?})", shape.uv.unwrap_or_default());
        match &shape.body {
            Body::Sphere { center, radius } => {
                self.spheres.push(made("Sphere", format!("{center:?}, {radius:?}")));
            }
            Body::Triangle { corners } => {
                self.triangles.push(made("Triangle", format!("{corners:?}")));
                self.uvs.push(uv());
            }
            Body::SmoothTriangle { corners, normals } => {
                let arguments = format!("{corners:?}, {normals:?}");
                self.smooth_triangles.push(made("SmoothTriangle", arguments));
                self.smooth_uvs.push(uv());
            }
            Body::Polygon { corners } => {
                let (n, count) = (self.polygons.len(), corners.len());
                write!(
                    self.before,
                    "const {prefix}CORNERS_{n}: [[f64; 3]; {count}] = {corners:?};\n\
                     const {prefix}EDGES_{n}: [whitted::shape::PolygonEdge<A>; {count}] =\n    \
                     whitted::shape::Polygon::<A>::edges(&{prefix}CORNERS_{n});\n"
                )?;
                let first = self.edges.len();
                self.edges.extend((0..count).map(|i| format!("{prefix}EDGES_{n}[{i}]")));
                self.polygons.push(made("Polygon", format!("&{prefix}CORNERS_{n}, {first}")));
            }
            Body::Box { low, high } => {
                self.cuboids.push(made("Cuboid", format!("{low:?}, {high:?}")));
            }
            Body::Disc { center, normal, radius } => {
                self.discs.push(made("Disc", format!("{center:?}, {normal:?}, {radius:?}")));
            }
            Body::Cylinder { base, apex, radius, capped } => {
                let made = made("Cylinder", format!("{base:?}, {apex:?}, {radius:?}"));
                self.cylinders.push(made + caps(*capped));
            }
            Body::Cone { base, base_radius, apex, apex_radius, capped } => {
                let arguments = format!("{base:?}, {base_radius:?}, {apex:?}, {apex_radius:?}");
                self.cones.push(made("Cone", arguments) + caps(*capped));
            }
            Body::Solid(solid) => {
                let (first, count) = (self.operands.len(), solid.operands.len());
                self.operands.extend(solid.operands.iter().filter_map(operand));
                self.solids.push(format!(
                    "whitted::shape::Solid::<A>::new({}, &{prefix}OPERANDS, {first}, {count})",
                    region(&solid.made)
                ));
            }
            Body::Plane { point, normal } => {
                self.planes
                    .push(made("Plane", format!("{normal:?}, {:?}", offset(*point, *normal))));
            }
        }
        Ok(())
    }
}

fn new(kind: &str, arguments: &str, material: usize) -> String {
    format!("whitted::shape::{kind}::<A>::new({arguments}, {material})")
}

fn caps(capped: bool) -> &'static str {
    if capped { ".with_caps()" } else { "" }
}

/// As the baker's own planes have it.
fn offset(point: Point, normal: Point) -> f64 {
    normalized(normal).map_or(0.0, |n| dot(n, point))
}

/// As the baker's own operands; `None` for what can't be one, which the baker has refused.
fn operand(shape: &Shape) -> Option<String> {
    let (kind, name, arguments) = match &shape.body {
        Body::Sphere { center, radius } => {
            ("Sphere", "Sphere", format!("{center:?}, {:?}", radius.abs()))
        }
        Body::Box { low, high } => ("Cuboid", "Cuboid", format!("{low:?}, {high:?}")),
        Body::Cylinder { base, apex, radius, .. } => {
            ("Cylinder", "Cylinder", format!("{base:?}, {apex:?}, {:?}", radius.abs()))
        }
        Body::Cone { base, base_radius, apex, apex_radius, .. } => {
            let (r, q) = (base_radius.abs(), apex_radius.abs());
            ("Cone", "Cone", format!("{base:?}, {r:?}, {apex:?}, {q:?}"))
        }
        Body::Plane { point, normal } => {
            ("HalfSpace", "Plane", format!("{normal:?}, {:?}", offset(*point, *normal)))
        }
        _ => return None,
    };
    let made = new(name, &arguments, shape.material);
    Some(format!("whitted::shape::Operand::{kind}({made})"))
}

fn region(made: &Made) -> String {
    let all = |parts: &[Made], with: &str| {
        let parts = parts.iter().map(region).reduce(|all, part| format!("{all}.{with}({part})"));
        parts.unwrap_or_else(|| "whitted::shape::Region::NOTHING".into())
    };
    match made {
        Made::Of(index) => format!("whitted::shape::Region::of({index})"),
        Made::Union(parts) => all(parts, "or"),
        Made::Intersection(parts) => all(parts, "and"),
        Made::Difference(parts) => all(parts, "minus"),
    }
}

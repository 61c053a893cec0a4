//! What a [`Transform`] makes of shapes and lights, and one document within another.
//!
//! A shape that can't be what the transform asks for says so: a sphere pressed flat is none of
//! ours. A box that is turned becomes its six faces.

use std::path::Path;

use super::{Body, Document, Falloff, Included, Light, LightKind, Point, Transform};

/// What keeps a shape from being placed.
type Refusal = &'static str;

const ROUND: Refusal = "it can't be scaled unevenly: a ball stays a ball (scale = one number)";
const CIRCLE: Refusal =
    "it can't be scaled unevenly across its axis: a circle stays a circle (scale both sides alike)";
const SHEARED: Refusal =
    "it can't be scaled unevenly at a slant to its axis: scale along the axis, or by one number";
const TURNED: Refusal =
    "a box within a solid stays along the axes: put the solid into a group and turn the instance";
const LIT: Refusal = "a light can't be scaled unevenly (scale = one number)";

impl Body {
    /// The shape elsewhere: as one shape, or as several where its kind can't be what it becomes.
    ///
    /// # Errors
    /// Why it can't be placed so, and what would be right.
    pub fn placed(&self, by: &Transform) -> Result<Vec<Self>, Refusal> {
        Ok(vec![match self {
            Self::Sphere { center, radius } => {
                let scale = by.uniform_scale().ok_or(ROUND)?;
                Self::Sphere { center: by.point(*center), radius: radius * scale }
            }
            Self::Plane { point, normal } => {
                Self::Plane { point: by.point(*point), normal: by.normal(*normal) }
            }
            Self::Disc { center, normal, radius } => {
                let scale = by.circle_scale(*normal).ok_or(CIRCLE)?;
                let center = by.point(*center);
                Self::Disc { center, normal: by.normal(*normal), radius: radius * scale }
            }
            Self::Box { low, high } => {
                if !by.keeps_axes() {
                    return Ok(faces(*low, *high).map(|c| polygon(&c, by)).into());
                }
                let (a, b) = (by.point(*low), by.point(*high));
                let pick = |f: fn(f64, f64) -> f64| [0, 1, 2].map(|i| f(a[i], b[i]));
                Self::Box { low: pick(f64::min), high: pick(f64::max) }
            }
            Self::Triangle { corners } => {
                Self::Triangle { corners: facing(corners.map(|c| by.point(c)), by) }
            }
            Self::SmoothTriangle { corners, normals } => Self::SmoothTriangle {
                corners: facing(corners.map(|c| by.point(c)), by),
                normals: facing(normals.map(|n| by.normal(n)), by),
            },
            Self::Polygon { corners } => polygon(corners, by),
            Self::Cylinder { base, apex, radius, capped } => Self::Cylinder {
                capped: *capped,
                base: by.point(*base),
                apex: by.point(*apex),
                radius: radius * around(by, *base, *apex)?,
            },
            Self::Cone { base, base_radius, apex, apex_radius, capped } => {
                let scale = around(by, *base, *apex)?;
                Self::Cone {
                    base: by.point(*base),
                    base_radius: base_radius * scale,
                    apex: by.point(*apex),
                    apex_radius: apex_radius * scale,
                    capped: *capped,
                }
            }
            Self::Solid(solid) => {
                let mut solid = solid.clone();
                for operand in &mut solid.operands {
                    operand.body = match operand.body.placed(by)?.as_slice() {
                        [one] => one.clone(),
                        _ => return Err(TURNED),
                    };
                }
                Self::Solid(solid)
            }
        }])
    }
}

/// By how much what is round about an axis grows.
fn around(by: &Transform, base: Point, apex: Point) -> Result<f64, Refusal> {
    let axis = super::sub(apex, base);
    if !by.keeps_square_to(axis) {
        return Err(SHEARED);
    }
    by.circle_scale(axis).ok_or(CIRCLE)
}

/// The corners in the order that keeps the front where it was.
fn facing(corners: [Point; 3], by: &Transform) -> [Point; 3] {
    let [a, b, c] = corners;
    if by.mirrors() { [a, c, b] } else { corners }
}

fn polygon(corners: &[Point], by: &Transform) -> Body {
    let mut corners: Vec<Point> = corners.iter().map(|&c| by.point(c)).collect();
    if by.mirrors() {
        corners.reverse();
    }
    Body::Polygon { corners }
}

/// The faces of a box, counter-clockwise seen from outside.
fn faces(low: Point, high: Point) -> [[Point; 4]; 6] {
    let at = |x: usize, y: usize, z: usize| {
        let ends = [low, high];
        [ends[x][0], ends[y][1], ends[z][2]]
    };
    [
        [at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)],
        [at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)],
        [at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)],
        [at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0)],
        [at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)],
        [at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)],
    ]
}

impl Light {
    /// The light elsewhere. Where it weakens with distance its intensity grows with the square of
    /// the scale, so that what it lights looks as before.
    ///
    /// # Errors
    /// Lengths don't all grow by the same.
    pub fn placed(&self, by: &Transform) -> Result<Self, Refusal> {
        let scale = by.uniform_scale().ok_or(LIT)?;
        let mut light = self.clone();
        match &mut light.kind {
            LightKind::Point { position, .. } => *position = by.point(*position),
            LightKind::Directional { direction } => *direction = by.direction(*direction),
            LightKind::Spot { position, direction, .. } => {
                *position = by.point(*position);
                *direction = by.direction(*direction);
            }
            LightKind::Area { area, .. } => {
                *area = area.placed(by, scale);
                return Ok(light);
            }
        }
        if self.falloff() == Falloff::InverseSquare {
            light.color = light.color.map(|c| c * scale * scale);
        }
        Ok(light)
    }
}

/// What of a document can't be placed.
#[derive(Clone, Copy, Debug)]
pub struct Misplaced {
    /// "sphere", "light" …
    pub what: &'static str,
    /// The line of its file.
    pub line: usize,
    /// Why, and what would be right.
    pub why: Refusal,
}

impl Document {
    /// Adds the materials and groups of another file's document, and its shapes, instances and lights once for each
    /// transform. Where and how the other is seen doesn't count here.
    ///
    /// # Errors
    /// The first shape or light that can't be placed so.
    pub fn include(
        &mut self,
        other: &Self,
        file: &Path,
        copies: &[Transform],
    ) -> Result<(), Misplaced> {
        let first = self.materials.len();
        let mut materials = other.materials.clone();
        for checker in materials.iter_mut().filter_map(|m| m.checker.as_mut()) {
            checker.other += first;
        }
        for other in materials.iter_mut().filter_map(|m| m.texture.as_mut()?.other.as_mut()) {
            *other += first;
        }
        self.materials.append(&mut materials);
        // Files that the other file includes keep their names; in a copy they lie further on.
        let part = |shapes, materials, lights, groups, file: &Path| Included {
            file: file.to_owned(),
            shapes,
            materials,
            lights,
            groups,
        };
        let materials = first..self.materials.len();
        let first_group = self.groups.len();
        for group in &other.groups {
            let mut group = group.clone();
            group.shapes.iter_mut().for_each(|shape| shape.rename(&mut |index| index + first));
            self.groups.push(group);
        }
        let groups = first_group..self.groups.len();
        for by in copies {
            let (shapes, lights) = (self.shapes.len(), self.lights.len());
            // Where each of the other's shapes went: one may have become several.
            let mut went = Vec::with_capacity(other.shapes.len() + 1);
            for shape in &other.shapes {
                went.push(self.shapes.len());
                let misplaced = |why| Misplaced { what: shape.body.name(), line: shape.line, why };
                for body in shape.body.placed(by).map_err(misplaced)? {
                    let mut placed = super::Shape { body, ..shape.clone() };
                    placed.uv = super::Shape::uv_placed(shape.uv, by.mirrors());
                    placed.rename(&mut |index| index + first);
                    self.shapes.push(placed);
                }
            }
            went.push(self.shapes.len());
            for light in &other.lights {
                let misplaced = |why| Misplaced { what: "light", line: light.line, why };
                self.lights.push(light.placed(by).map_err(misplaced)?);
            }
            for instance in &other.instances {
                let place = instance.place.then(by);
                if let Some(why) = super::Instance::flaw(&place) {
                    return Err(Misplaced { what: "instance", line: instance.line, why });
                }
                let material = instance.material.map(|material| material + first);
                let group = instance.group + first_group;
                self.instances.push(super::Instance { group, place, material, ..*instance });
            }
            let all = (shapes..self.shapes.len(), lights..self.lights.len());
            self.included.push(part(all.0, materials.clone(), all.1, groups.clone(), file));
            for inner in &other.included {
                let place = |i: usize| went.get(i).copied().unwrap_or(self.shapes.len());
                self.included.push(part(
                    place(inner.shapes.start)..place(inner.shapes.end),
                    inner.materials.start + first..inner.materials.end + first,
                    inner.lights.start + lights..inner.lights.end + lights,
                    inner.groups.start + first_group..inner.groups.end + first_group,
                    &inner.file,
                ));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn box_faces(by: &Transform) -> Vec<Body> {
        Body::Box { low: [-1.0, -2.0, -3.0], high: [1.0, 2.0, 3.0] }.placed(by).unwrap()
    }

    #[test]
    fn a_box_stays_one_where_it_can() {
        let by = Transform::turned([0.0, 1.0, 0.0], 90.0).then(&Transform::moved([5.0, 0.0, 0.0]));
        let whole = Body::Box { low: [2.0, -2.0, -1.0], high: [8.0, 2.0, 1.0] };
        assert_eq!(box_faces(&by), [whole]);
    }

    #[test]
    fn the_faces_of_a_box_show_outwards_mirrored_or_not() {
        for scale in [1.0, -2.0] {
            let turn = Transform::turned([1.0, 2.0, 0.5], 31.0);
            let faces = box_faces(&turn.then(&Transform::scaled([1.0, scale, 1.0])));
            assert_eq!(faces.len(), 6);
            for face in faces {
                let Body::Polygon { corners } = face else { panic!("{face:?}") };
                use crate::document::{cross, dot, sub};
                let n = cross(sub(corners[1], corners[0]), sub(corners[2], corners[1]));
                assert!(dot(n, corners[0]) > 0.0, "the box is around the origin");
            }
        }
    }

    #[test]
    fn what_can_be_pressed_flat() {
        let by = Transform::scaled([1.0, 3.0, 1.0]);
        let (base, apex) = ([0.0; 3], [0.0, 1.0, 0.0]);
        let tube = Body::Cylinder { base, apex, radius: 2.0, capped: false };
        let longer = Body::Cylinder { base, apex: [0.0, 3.0, 0.0], radius: 2.0, capped: false };
        assert_eq!(tube.placed(&by), Ok(vec![longer]));
        let lying = Body::Cylinder { base, apex: [1.0, 0.0, 0.0], radius: 2.0, capped: true };
        assert_eq!(lying.placed(&by), Err(CIRCLE));
        let slanting = Body::Cylinder { base, apex: [1.0, 1.0, 0.0], radius: 2.0, capped: true };
        assert_eq!(slanting.placed(&by), Err(SHEARED));
        let ball = Body::Sphere { center: apex, radius: -2.0 };
        assert_eq!(ball.placed(&by), Err(ROUND));
        let larger = Body::Sphere { center: [0.0, -3.0, 0.0], radius: -6.0 };
        assert_eq!(ball.placed(&Transform::scaled([-3.0; 3])), Ok(vec![larger]));
    }

    #[test]
    fn a_light_that_grows_with_its_room_lights_it_alike() {
        let kind = LightKind::Point { position: [1.0, 2.0, 3.0], falloff: Falloff::InverseSquare };
        let light = Light { kind, color: [4.0; 3], line: 1 };
        let placed = light.placed(&Transform::scaled([2.0; 3])).unwrap();
        assert_eq!(placed.position(), Some([2.0, 4.0, 6.0]));
        assert_eq!(placed.color, [16.0; 3]);
    }
}

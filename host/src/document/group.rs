//! Groups of shapes, and where they stand.

use super::{Body, Bounds, Document, Shape, Transform};

/// Shapes that are placed together, in a space of their own.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// What the file calls it.
    pub name: String,
    /// Its shapes, none of them a plane.
    pub shapes: Vec<Shape>,
    /// The line of the file that it starts on.
    pub line: usize,
}

impl Group {
    /// The box around all its shapes.
    pub fn bounds(&self) -> Option<Bounds> {
        self.shapes.iter().filter_map(|shape| shape.body.bounds()).reduce(Bounds::union)
    }
}

/// A group in the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    /// The index of the group.
    pub group: usize,
    /// From the group's space to the scene's: all lengths grow by the same, and nothing is mirrored.
    pub place: Transform,
    /// The index of the material that all its shapes have instead of their own.
    pub material: Option<usize>,
    /// The line of the file that it starts on.
    pub line: usize,
}

impl Instance {
    /// Why a group can't be placed so, if so, and what would be right.
    pub fn flaw(place: &Transform) -> Option<&'static str> {
        if place.uniform_scale().is_none() {
            Some("it can't be scaled unevenly: a group keeps its form (scale = one number)")
        } else if place.mirrors() {
            Some("it can't be mirrored: a scale must be larger than 0")
        } else {
            None
        }
    }

    /// The box around its shapes.
    pub fn bounds(&self, document: &Document) -> Option<Bounds> {
        let shapes = &document.groups.get(self.group)?.shapes;
        shapes.iter().filter_map(|shape| self.bounds_of(&shape.body)).reduce(Bounds::union)
    }

    /// The box around one of its shapes.
    fn bounds_of(&self, body: &Body) -> Option<Bounds> {
        if let Ok(bodies) = body.placed(&self.place) {
            return bodies.iter().filter_map(Body::bounds).reduce(Bounds::union);
        }
        // What can't be turned by itself lies within its turned box.
        let Bounds { low, high } = body.bounds()?;
        let corner = |i: usize| {
            let pick = |axis: usize| if i >> axis & 1 == 0 { low[axis] } else { high[axis] };
            self.place.point([pick(0), pick(1), pick(2)])
        };
        Bounds::around(&[0, 1, 2, 3, 4, 5, 6, 7].map(corner))
    }
}

//! Solids: shapes united, intersected, taken from each other.

use super::{Bounds, Shape};

/// A solid of several closed shapes.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// The shapes, each with its material: spheres, boxes, cylinders and cones with their caps, and
    /// what lies behind planes.
    pub operands: Vec<Shape>,
    /// What is made of them.
    pub made: Made,
}

/// What is made of the operands of a solid.
#[derive(Clone, Debug, PartialEq)]
pub enum Made {
    /// One operand.
    Of(usize),
    /// What is in any.
    Union(Vec<Made>),
    /// What is in all.
    Intersection(Vec<Made>),
    /// What is in the first alone.
    Difference(Vec<Made>),
}

impl Solid {
    /// The box around it; `None` where it has no end.
    pub fn bounds(&self) -> Option<Bounds> {
        self.bounds_of(&self.made)
    }

    fn bounds_of(&self, made: &Made) -> Option<Bounds> {
        match made {
            Made::Of(index) => self.operands.get(*index)?.body.bounds(),
            Made::Union(parts) => {
                let all: Option<Vec<Bounds>> = parts.iter().map(|p| self.bounds_of(p)).collect();
                all?.into_iter().reduce(Bounds::union)
            }
            Made::Intersection(parts) => {
                parts.iter().filter_map(|p| self.bounds_of(p)).reduce(Bounds::intersection)
            }
            Made::Difference(parts) => self.bounds_of(parts.first()?),
        }
    }
}

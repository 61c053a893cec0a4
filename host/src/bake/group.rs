//! Groups and their instances, as the core wants them.

use whitted::scene::{Group, Instance, Transform};
use whitted::shape::ShapeError;

use super::shapes::{Shapes, Thrift};
use super::{Construct, refused};
use crate::document::{self, Document};
use crate::error::{Flaw, Problem};

/// The groups of a scene, and where they stand.
#[derive(Debug)]
pub(super) struct Groups<A: Construct> {
    /// By the document's index; those that stand nowhere have no shapes.
    shapes: Vec<Shapes<A>>,
    places: Vec<Place>,
}

/// Where a group stands.
#[derive(Debug)]
struct Place {
    group: usize,
    transform: Transform,
    material: Option<u16>,
    line: usize,
}

impl<A: Construct> Groups<A> {
    /// Makes the groups of a document that has been placed.
    pub(super) fn new(document: &Document, thrift: Thrift) -> Result<Self, Flaw> {
        let used = |index| document.instances.iter().any(|i| i.group == index);
        let group = |(index, group): (usize, &document::Group)| {
            let shapes: &[_] = if used(index) { &group.shapes } else { &[] };
            Shapes::new(shapes, group.bounds(), |_| document.file_of_group(index), thrift)
        };
        let place = |instance: &document::Instance| {
            let refuse = |e| refused::<A>("the instance", e, Some(instance.line));
            let number = |i| u16::try_from(i).map_err(|_| refuse(ShapeError::Material));
            Ok(Place {
                group: instance.group,
                transform: transform(&instance.place),
                material: instance.material.map(number).transpose()?,
                line: instance.line,
            })
        };
        Ok(Self {
            shapes: document.groups.iter().enumerate().map(group).collect::<Result<_, _>>()?,
            places: document.instances.iter().map(place).collect::<Result<_, _>>()?,
        })
    }

    /// The core's groups, by the document's index; `None` for those that stand nowhere.
    pub(super) fn groups(&self) -> Result<Vec<Option<Group<'_, A>>>, Flaw> {
        let mut groups = Vec::with_capacity(self.shapes.len());
        for (index, shapes) in self.shapes.iter().enumerate() {
            if !self.places.iter().any(|place| place.group == index) {
                groups.push(None);
                continue;
            }
            let made: Result<Group<'_, A>, _> = A::new_group(shapes.parts()?.shapes());
            groups.push(Some(made.map_err(|error| {
                let why = format!("{error} (in {} arithmetic)", A::NAME);
                Problem::Unrepresentable { what: "a group".into(), why }.anywhere()
            })?));
        }
        Ok(groups)
    }

    /// The core's instances of its groups.
    pub(super) fn instances<'g>(
        &self,
        groups: &'g [Option<Group<'g, A>>],
    ) -> Result<Vec<Instance<'g, A>>, Flaw> {
        let make = |place: &Place| {
            let group = groups.get(place.group).and_then(Option::as_ref)?;
            let made: Result<Instance<'g, A>, _> = A::new_instance(group, &place.transform);
            Some(match (made, place.material) {
                (Ok(instance), Some(material)) => Ok(instance.with_material(material)),
                (Ok(instance), None) => Ok(instance),
                (Err(error), _) => Err(refused::<A>("the instance", error, Some(place.line))),
            })
        };
        self.places.iter().filter_map(make).collect()
    }

    /// The shapes of each group in the document's order; `None` for one that stands nowhere.
    pub(super) fn all(&self) -> impl Iterator<Item = Option<&Shapes<A>>> {
        (0..self.shapes.len()).map(|index| self.placed(index))
    }

    /// The shapes of a group by the document's index; `None` if it stands nowhere.
    pub(super) fn placed(&self, index: usize) -> Option<&Shapes<A>> {
        self.places.iter().find(|place| place.group == index)?;
        self.shapes.get(index)
    }

    /// The index of the group that stands at each place, how it stands there, and the material
    /// that its shapes have instead of their own.
    pub(super) fn places(&self) -> impl Iterator<Item = (usize, &Transform, Option<u16>)> {
        self.places.iter().map(|place| (place.group, &place.transform, place.material))
    }

    /// Words of all trees.
    pub(super) fn tree_words(&self) -> usize {
        self.shapes.iter().filter_map(Shapes::tree).map(|(words, _)| words).sum()
    }

    /// The document's indices of the group and of its shape that has this number, counted from the
    /// first instance's first shape; how far it lies beyond the last one, if it does.
    pub(super) fn origin(&self, mut number: u32) -> Result<(usize, usize), u32> {
        for place in &self.places {
            let Some(shapes) = self.shapes.get(place.group) else { continue };
            match shapes.origin(number) {
                Ok(origin) => return Ok((place.group, origin)),
                Err(left) => number = left,
            }
        }
        Err(number)
    }
}

/// A document's transform, of which all lengths grow by the same.
fn transform(place: &document::Transform) -> Transform {
    let scale = place.uniform_scale().unwrap_or(1.0);
    let [x, y, z] = place.columns;
    let row = |i: usize| [x[i] / scale, y[i] / scale, z[i] / scale];
    Transform { rotation: [row(0), row(1), row(2)], scale, position: place.offset }
}

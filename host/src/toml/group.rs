//! Groups of shapes and their instances.

use super::material::Names;
use super::place;
use super::table::Table;
use crate::document::{Body, Group, Instance};
use crate::error::{Flaw, Problem};

/// The groups of a file, and the names of all that its instances can name.
pub(super) struct Groups {
    pub(super) own: Vec<Group>,
    /// With their indices in the document.
    known: Vec<(String, usize)>,
}

impl Groups {
    /// Reads all groups.
    pub(super) fn read(tables: &[Table<'_>], names: &Names<'_>) -> Result<Self, Flaw> {
        let mut groups = Self { own: Vec::new(), known: Vec::new() };
        for table in tables {
            let name = table.need("name")?;
            let text = name.text("name")?;
            if let Some(first) = groups.own.iter().find(|g| g.name == text) {
                let what = format!("group \"{}\"", crate::error::shown(text));
                return Err(Problem::Twice { what, first: first.line }.at(name.line));
            }
            let shapes = super::shapes(table, names)?;
            table.done()?;
            if shapes.is_empty() {
                return Err(table.missing("a shape ([[group.sphere]], …)"));
            }
            if let Some(plane) = shapes.iter().find(|s| matches!(s.body, Body::Plane { .. })) {
                let why = "it has no end, and a group must have one: place it in the scene";
                return Err(Problem::degenerate("plane", why).at(plane.line));
            }
            groups.include(&[text], groups.own.len());
            groups.own.push(Group { name: text.to_owned(), shapes, line: table.line });
        }
        Ok(groups)
    }

    /// Makes the names of other groups known, that begin at `first` in the document.
    pub(super) fn include(&mut self, names: &[&str], first: usize) {
        self.known.extend(names.iter().enumerate().map(|(i, name)| (name.to_string(), first + i)));
    }

    /// Reads all instances.
    pub(super) fn instances(
        &self,
        tables: &[Table<'_>],
        names: &Names<'_>,
    ) -> Result<Vec<Instance>, Flaw> {
        let mut instances = Vec::new();
        for table in tables {
            let name = table.need("group")?;
            let text = name.text("group")?;
            let found = self.known.iter().find(|(known, _)| known == text);
            let Some(&(_, group)) = found else {
                let known: Vec<&str> = self.known.iter().map(|(name, _)| name.as_str()).collect();
                return Err(Problem::unknown("group", text, &known).at(name.line));
            };
            let material = match table.get("material") {
                Some(_) => Some(names.of(table)?),
                None => None,
            };
            let copies = place::read(table)?;
            table.done()?;
            super::room(instances.len() + copies.len(), table.line)?;
            for place in copies {
                if let Some(why) = Instance::flaw(&place) {
                    return Err(Problem::degenerate("instance", why).at(table.line));
                }
                instances.push(Instance { group, place, material, line: table.line });
            }
        }
        Ok(instances)
    }
}

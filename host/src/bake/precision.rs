//! Whether fixed point's one step is fine enough for a scene.
//!
//! A position is known to half a step, 2⁻¹⁷. Where that is more than a part in [`PARTS`] of a shape's
//! size, its outline and its normals would be seen to be off, and the scene is refused: its smallest
//! shape is too small beside its extent.

use super::Placement;
use crate::document::{Body, Document, Point, length, sub};
use crate::error::{Flaw, Problem};

/// A shape is so many times as large as what a position may be off by, or larger.
const PARTS: f64 = 128.0;

/// The largest error of a position: half a step of Q16.16.
const ROUNDING: f64 = 0.5 / 65536.0;

/// What a shape's precision is measured by, and how much that is: a radius where it is round, its
/// longest side where it is flat. Endless planes and solids, whose parts cut each other, have none.
fn size(body: &Body) -> Option<(&'static str, f64)> {
    let longest = |corners: &[Point]| {
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).map(|(&a, &b)| length(sub(b, a))).fold(0.0, f64::max)
    };
    Some(match body {
        Body::Sphere { radius, .. } | Body::Disc { radius, .. } | Body::Cylinder { radius, .. } => {
            ("radius", radius.abs())
        }
        Body::Cone { base_radius, apex_radius, .. } => {
            ("larger radius", base_radius.abs().max(apex_radius.abs()))
        }
        Body::Box { low, high } => {
            ("longest side", sub(*high, *low).map(f64::abs).into_iter().fold(0.0, f64::max))
        }
        Body::Triangle { corners } | Body::SmoothTriangle { corners, .. } => {
            ("longest side", longest(corners))
        }
        Body::Polygon { corners } => ("longest side", longest(corners)),
        Body::Plane { .. } | Body::Solid(_) => return None,
    })
}

/// Whether a scene that is placed so keeps the precision of its shapes, those of groups among them.
///
/// # Errors
/// The first shape that is too small, with its line, how large it is and how large it would have to be.
pub(super) fn check(
    document: &Document,
    placement: &Placement,
    placed: &Document,
) -> Result<(), Flaw> {
    let least = PARTS * ROUNDING / placement.scale();
    for (index, shape) in document.shapes.iter().enumerate() {
        let Some((measure, size)) = size(&shape.body) else { continue };
        if size < least {
            let whole = document.bounds().map_or(0.0, |bounds| bounds.side());
            let why = format!(
                "its {measure} {size:.3e} is too small for fixed arithmetic in a scene {whole:.3e} \
                 across, seen and lit from where it is: it must be {least:.3e} or more. Leave it \
                 out, make the scene smaller, or use f32"
            );
            let what = shape.body.name().into();
            let from = document.file_of_shape(index);
            return Err(Problem::Unrepresentable { what, why }.at(shape.line).within(from));
        }
    }
    (0..document.groups.len()).try_for_each(|index| check_group(document, placed, index))
}

/// The same for the shapes of a group: positions are rounded in its own space, and in the scene's again.
fn check_group(document: &Document, placed: &Document, index: usize) -> Result<(), Flaw> {
    let (Some(group), Some(there)) = (document.groups.get(index), placed.groups.get(index)) else {
        return Ok(());
    };
    let instances = placed.instances.iter().filter(|instance| instance.group == index);
    let scales = instances.filter_map(|instance| instance.place.uniform_scale());
    // One that stands nowhere isn't baked.
    let Some(smallest) = scales.reduce(f64::min) else { return Ok(()) };
    for (shape, there) in group.shapes.iter().zip(&there.shapes) {
        let (Some((measure, size)), Some((_, there))) = (size(&shape.body), size(&there.body))
        else {
            continue;
        };
        let there = there * smallest.min(1.0);
        if there < PARTS * ROUNDING {
            let least = size * PARTS * ROUNDING / there;
            let name = &group.name;
            let why = format!(
                "its {measure} {size:.3e} is too small for fixed arithmetic in the group \"{name}\" as \
                 it stands in the scene: it must be {least:.3e} or more. Leave it out, place the \
                 group larger, or use f32"
            );
            let what = shape.body.name().into();
            let from = document.file_of_group(index);
            return Err(Problem::Unrepresentable { what, why }.at(shape.line).within(from));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read::{Format, parse};

    /// A scene 1,002 units across, scaled by 2⁻²: a step is 2⁻¹⁴, so 1/256 is the least.
    fn refused(shape: &str) -> Option<String> {
        let text = format!(
            "[camera]\neye = [0, 0, -5]\nlook_at = [0, 0, 0]\n[[material]]\nname = \"a\"\n\
             diffuse = 0.5\n[[sphere]]\ncenter = [0, 0, 950]\nradius = 50\n{shape}"
        );
        let document = parse(Format::Toml, text.as_bytes()).unwrap_or_else(|f| panic!("{f:?}"));
        let placement = Placement::filling(&document);
        assert_eq!(placement.log2_scale, -2);
        let flaw = check(&document, &placement, &placement.place(&document)).err()?;
        assert_eq!(flaw.line, Some(10));
        Some(flaw.problem.to_string())
    }

    #[test]
    fn too_small_a_shape_is_named_with_what_would_do() {
        let message = refused("[[sphere]]\ncenter = [0, 0, -2]\nradius = 0.0039").unwrap();
        assert!(message.contains("its radius 3.900e-3 is too small"), "{message}");
        assert!(message.contains("must be 3.906e-3 or more"), "{message}");
        let small = "[[box]]\nmin = [0, 0, -2]\nmax = [0.001, 0.002, -1.998]";
        assert!(refused(small).unwrap().contains("its longest side 2.000e-3"));
    }

    /// A bead of this radius in a group of 2.02 units, placed at this scale within a sphere of radius
    /// 100, for which the scene's step is 2⁻¹⁶.
    fn grouped(bead: f64, scale: f64) -> Option<String> {
        let text = format!(
            "[camera]\neye = [0, 0, -300]\nlook_at = [0, 0, 0]\n[[material]]\nname = \"a\"\n\
             [[sphere]]\ncenter = [0, 0, 0]\nradius = 100\n\
             [[group]]\nname = \"beads\"\n[[group.sphere]]\ncenter = [0, 0, 0]\nradius = {bead}\n\
             [[group.sphere]]\ncenter = [0, 0, 0]\nradius = 1.01\n\
             [[instance]]\ngroup = \"beads\"\nscale = {scale}\n"
        );
        let document = parse(Format::Toml, text.as_bytes()).unwrap_or_else(|f| panic!("{f:?}"));
        let placement = Placement::filling(&document);
        assert_eq!(placement, Placement::IDENTITY);
        let flaw = check(&document, &placement, &placement.place(&document)).err()?;
        assert_eq!(flaw.line, Some(11));
        Some(flaw.problem.to_string())
    }

    #[test]
    fn shapes_of_groups_are_measured_in_both_spaces() {
        assert_eq!(grouped(0.01, 1.0), None);
        assert_eq!(grouped(1.6e-5, 98.0), None);
        // The group's own space is 64 times as large as the file's, the scene's 98 times.
        let message = grouped(1.3e-5, 98.0).unwrap();
        assert!(message.contains("radius 1.300e-5 is too small"), "{message}");
        assert!(message.contains("in the group \"beads\""), "{message}");
        assert!(message.contains("must be 1.526e-5 or more"), "{message}");
        // Large in its own space, a speck in the scene.
        let message = grouped(0.5, 0.001).unwrap();
        assert!(message.contains("must be 9.766e-1 or more"), "{message}");
    }

    #[test]
    fn what_is_large_enough_or_thin_is_taken() {
        assert_eq!(refused("[[sphere]]\ncenter = [0, 0, -2]\nradius = 0.00391"), None);
        let thin = "[[triangle]]\ncorners = [[0, 0, -2], [1, 0, -2], [0.5, 0.001, -2]]";
        assert_eq!(refused(thin), None);
    }
}

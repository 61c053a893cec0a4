//! Nodes: where things are. A tree of them is walked with a list, each node once, so that neither
//! depth nor a circle does harm.

use gltf_json::camera::Type as CameraType;
use gltf_json::extensions::scene::khr_lights_punctual::{Light as Theirs, Type as LightType};
use gltf_json::scene::Node;
use gltf_json::validation::Checked;
use gltf_json::{Index, Root};

use super::{Noticed, indexed};
use crate::document::{
    Camera, FARTHEST, Falloff, Light, LightKind, Span, Transform, add, normalized, scaled,
};
use crate::error::Problem;

/// The nodes of the scene that is shown, each with its place in the world.
pub(super) fn flattened(root: &Root) -> Result<Vec<(usize, Transform)>, Problem> {
    let scene = match root.scene {
        Some(index) => Some(indexed(&root.scenes, index, "scene", "scenes")?),
        None => root.scenes.first(),
    };
    let roots: Vec<Index<Node>> = match scene {
        Some(scene) => scene.nodes.clone(),
        // Without a scene: all that hang from no other.
        None => {
            let mut hangs = vec![false; root.nodes.len()];
            for child in root.nodes.iter().flat_map(|node| node.children.iter().flatten()) {
                if let Some(hangs) = hangs.get_mut(child.value()) {
                    *hangs = true;
                }
            }
            let free = hangs.iter().enumerate().filter(|(_, hangs)| !**hangs);
            free.map(|(i, _)| Index::new(i as u32)).collect()
        }
    };
    let mut seen = vec![false; root.nodes.len()];
    let mut all = Vec::new();
    let mut waiting: Vec<_> = roots
        .into_iter()
        .rev()
        .map(|i| (i, Transform::IDENTITY, "scenes nodes".to_owned()))
        .collect();
    while let Some((index, above, from)) = waiting.pop() {
        let node = indexed(&root.nodes, index, &from, "nodes")?;
        let place = format!("nodes[{}]", index.value());
        if std::mem::replace(&mut seen[index.value()], true) {
            let why = format!("{place} is there a second time; a node hangs from one other");
            return Err(Problem::degenerate(from, why));
        }
        let world = local(node, &place)?.then(&above);
        if !world.columns.iter().chain([&world.offset]).flatten().all(|x| x.abs() <= FARTHEST) {
            let why = format!("it lies beyond ±{FARTHEST}, or is scaled by more");
            return Err(Problem::degenerate(place, why));
        }
        all.push((index.value(), world));
        for child in node.children.iter().flatten().rev() {
            waiting.push((*child, world, format!("{place}.children")));
        }
    }
    Ok(all)
}

/// A node's matrix, or its scale, rotation and translation in this order.
fn local(node: &Node, place: &str) -> Result<Transform, Problem> {
    if let Some(m) = node.matrix {
        let m = m.map(f64::from);
        if [m[3], m[7], m[11], m[15]] != [0.0, 0.0, 0.0, 1.0] {
            let why = "its last row must be 0 0 0 1";
            return Err(Problem::degenerate(format!("{place}.matrix"), why));
        }
        let column = |i: usize| [m[i], m[i + 1], m[i + 2]];
        return Ok(Transform { columns: [0, 4, 8].map(column), offset: column(12) });
    }
    let scale = node.scale.map_or([1.0; 3], |s| s.map(f64::from));
    let [x, y, z, w] = node.rotation.unwrap_or_default().0.map(f64::from);
    let square = x * x + y * y + z * z + w * w;
    if !(0.5..2.0).contains(&square) {
        let what = format!("{place}.rotation's length");
        return Err(Problem::range(what, square.sqrt(), "1"));
    }
    // Of a quaternion (Shoemake 1985), made a unit.
    let s = 2.0 / square;
    let columns = [
        [1.0 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)],
        [s * (x * y - w * z), 1.0 - s * (x * x + z * z), s * (y * z + w * x)],
        [s * (x * z + w * y), s * (y * z - w * x), 1.0 - s * (x * x + y * y)],
    ];
    let offset = node.translation.map_or([0.0; 3], |t| t.map(f64::from));
    Ok(Transform::scaled(scale).then(&Transform { columns, offset }))
}

/// The camera of the first node that has one.
pub(super) fn camera(
    root: &Root,
    nodes: &[(usize, Transform)],
    noticed: &mut Noticed,
) -> Result<Option<Camera>, Problem> {
    let mut found = None;
    for (i, world) in nodes {
        let Some(index) = root.nodes[*i].camera else { continue };
        let place = format!("cameras[{}]", index.value());
        let camera = indexed(&root.cameras, index, &format!("nodes[{i}].camera"), "cameras")?;
        match (camera.type_, &camera.perspective) {
            (Checked::Valid(CameraType::Orthographic), _) => {
                noticed.leave_out("orthographic cameras", &place);
            }
            (Checked::Valid(CameraType::Perspective), Some(_)) if found.is_some() => {
                noticed.leave_out("cameras beyond the first", &place);
            }
            (Checked::Valid(CameraType::Perspective), Some(perspective)) => {
                let angle = f64::from(perspective.yfov).to_degrees();
                if !(0.01..=170.0).contains(&angle) {
                    let what = format!("{place}.perspective.yfov");
                    let right = "0.0002 to 2.96 (radians)";
                    return Err(Problem::range(what, perspective.yfov.into(), right));
                }
                let eye = world.offset;
                let ahead = normalized(world.direction([0.0, 0.0, -1.0])).unwrap_or_default();
                let camera = Camera {
                    eye,
                    look_at: add(eye, ahead),
                    up: world.direction([0.0, 1.0, 0.0]),
                    angle,
                    span: Span::Edges,
                };
                if let Some(why) = camera.flaw() {
                    return Err(Problem::degenerate(format!("nodes[{i}]"), why));
                }
                found = Some(camera);
            }
            _ => return Err(Problem::Missing { what: format!("{place}.perspective") }),
        }
    }
    Ok(found)
}

/// Above this, by π, intensities are taken for lumens' and not for watts': exporters multiply by
/// [`LUMENS`], and pictures of the file are then shown with as much less exposure.
const BRIGHTEST: f64 = 1000.0;
/// Lumens of a watt at the eye's most sensitive wavelength.
const LUMENS: f64 = 683.0;

/// The lights of nodes (KHR_lights_punctual).
pub(super) fn lights(
    root: &Root,
    nodes: &[(usize, Transform)],
    noticed: &mut Noticed,
) -> Result<Vec<Light>, Problem> {
    let none: Vec<Theirs> = Vec::new();
    let known = root.extensions.as_ref().and_then(|more| more.khr_lights_punctual.as_ref());
    let known = known.map_or(&none, |more| &more.lights);
    let mut lights = Vec::new();
    for (i, world) in nodes {
        let more = root.nodes[*i].extensions.as_ref();
        let Some(light) = more.and_then(|more| more.khr_lights_punctual.as_ref()) else { continue };
        let place = format!("KHR_lights_punctual.lights[{}]", light.light.value());
        let theirs = indexed(known, light.light, &format!("nodes[{i}] light"), "lights")?;
        lights.push(one(theirs, &place, world)?);
        if theirs.range.is_some() {
            noticed.leave_out("ranges of lights", &place);
        }
    }
    let brightest = lights.iter().flat_map(|light| light.color).fold(0.0, f64::max);
    if brightest > BRIGHTEST {
        for light in &mut lights {
            light.color = light.color.map(|c| c / LUMENS);
        }
        noticed.say(format!(
            "the lights' intensities, up to {:.0}, are taken for lumens': all divided by {LUMENS}",
            brightest * std::f64::consts::PI
        ));
    }
    Ok(lights)
}

fn one(theirs: &Theirs, place: &str, world: &Transform) -> Result<Light, Problem> {
    /// More than the sun's candelas a scene can't mean.
    const MOST: f64 = 1e8;
    let intensity = f64::from(theirs.intensity);
    if !(0.0..=MOST).contains(&intensity) {
        return Err(Problem::range(
            format!("{place}.intensity"),
            intensity,
            format!("0 to {MOST}"),
        ));
    }
    let color = theirs.color.map(f64::from);
    if let Some(c) = color.into_iter().find(|c| !(0.0..=1.0).contains(c)) {
        return Err(Problem::range(format!("{place}.color"), c, "0 to 1"));
    }
    let (position, falloff) = (world.offset, Falloff::InverseSquare);
    let direction = world.direction([0.0, 0.0, -1.0]);
    let pointed = !matches!(theirs.type_, Checked::Valid(LightType::Point));
    if pointed && normalized(direction).is_none() {
        return Err(Problem::degenerate(place, "its node is scaled to nothing: no direction"));
    }
    let kind = match (theirs.type_, &theirs.spot) {
        (Checked::Valid(LightType::Point), _) => LightKind::Point { position, falloff },
        (Checked::Valid(LightType::Directional), _) => LightKind::Directional { direction },
        (Checked::Valid(LightType::Spot), Some(spot)) => {
            let [inner, outer] =
                [spot.inner_cone_angle, spot.outer_cone_angle].map(|a| f64::from(a).to_degrees());
            if !(inner >= 0.0 && inner < outer && outer <= 90.001) {
                let why = format!(
                    "cone angles {:.4} and {:.4}: 0 ≤ inner < outer ≤ π/2 must hold",
                    spot.inner_cone_angle, spot.outer_cone_angle
                );
                return Err(Problem::degenerate(format!("{place}.spot"), why));
            }
            // The core's cone ends before a half-space.
            let outer = outer.min(89.9);
            let inner = inner.min(outer - 0.05);
            LightKind::Spot { position, direction, inner, outer, falloff }
        }
        (Checked::Valid(LightType::Spot), None) => {
            return Err(Problem::Missing { what: format!("{place}.spot") });
        }
        (Checked::Invalid, _) => {
            let found = format!("{place}.type of another kind");
            return Err(Problem::Found { found, wanted: "point, directional or spot".into() });
        }
    };
    let color = scaled(color, intensity / std::f64::consts::PI);
    Ok(Light { kind, color, line: 0 })
}

//! Our own scene format, in TOML: all that the model has (described in `docs/scene-format.md`).

mod body;
mod group;
mod include;
mod indirect;
mod light;
mod material;
mod place;
mod solid;
mod table;
mod texture;

use toml::de::DeTable;
use whitted::trace::Terms;

use crate::document::{
    Background, Body, Bounds, Camera, Document, FARTHEST, Falloff, LightSelection, Point, Rules,
    Shape, Size, Span,
};
use crate::error::{Flaw, Problem};
use crate::read::Around;
use crate::render::Sampling;
use crate::sampling;
use crate::terms;
use group::Groups;
use material::Names;
use table::{Lines, Table, Value};

/// Reads a text in our own format; what it includes lies beside `around`'s file.
///
/// # Errors
/// The first thing that is wrong with it, with its line.
pub fn parse(text: &str, around: &Around) -> Result<Document, Flaw> {
    let lines = Lines::of(text);
    let root = DeTable::parse(text).map_err(|error| {
        let line = error.span().map(|span| lines.at(span.start));
        Flaw { line, file: None, problem: Problem::Syntax(error.message().to_owned()) }
    })?;
    let scene = Table::new(root.get_ref(), &lines, "", 1);

    let camera = match scene.get("camera") {
        Some(camera) => camera_of(&camera.table("camera")?)?,
        None if around.is_included() => NOWHERE,
        None => {
            let what = "the camera ([camera] eye, look_at)".into();
            return Err(Problem::Missing { what }.anywhere());
        }
    };
    let (size, rules) = match scene.get("render") {
        Some(render) => render_of(&render.table("render")?)?,
        None => (None, Rules::SLIDES),
    };
    let background = match scene.get("background") {
        Some(value) => background_of(&value)?,
        None => Background::Color([0.0; 3]),
    };
    let ambient = scene.color("ambient", 1000.0, [0.0; 3])?;

    let indirect = match scene.get("indirect") {
        Some(value) => Some(indirect::read(&value.table("indirect")?)?),
        None => None,
    };

    let mut names = Names::read(&tables(&scene, "material")?, around)?;
    let lights = tables(&scene, "light")?;
    let lights = lights.iter().map(|t| light::read(t, rules.falloff)).collect::<Result<_, _>>()?;
    let mut document = Document {
        camera,
        size,
        background,
        ambient,
        indirect,
        rules,
        materials: names.own().to_vec(),
        lights,
        shapes: Vec::new(),
        groups: Vec::new(),
        instances: Vec::new(),
        warnings: Vec::new(),
        included: Vec::new(),
    };
    let included = include::all(&scene, around, &mut document, &mut names)?;
    names.link(&mut document.materials)?;

    let mut groups = Groups::read(&tables(&scene, "group")?, &names)?;
    let mut first = groups.own.len();
    for part in &included {
        let theirs = part.groups();
        groups.include(&theirs, first);
        first += theirs.len();
    }
    document.instances = groups.instances(&tables(&scene, "instance")?, &names)?;
    document.groups = groups.own;
    document.shapes = shapes(&scene, &names)?;
    scene.done()?;
    for part in included {
        part.place(&mut document)?;
    }
    if document.shapes.is_empty() && document.instances.is_empty() && !around.is_included() {
        let kinds: Vec<String> =
            body::KINDS.iter().map(|(kind, _)| format!("[[{kind}]]")).collect();
        let what = format!("a shape ({})", kinds.join(", "));
        return Err(Problem::Missing { what }.anywhere());
    }
    Ok(document)
}

/// The shapes of a scene or of a group.
fn shapes(scene: &Table<'_>, names: &Names<'_>) -> Result<Vec<Shape>, Flaw> {
    let mut shapes = Vec::new();
    for (kind, read) in body::KINDS {
        for table in tables(scene, kind)? {
            let material = names.of(&table)?;
            let bodies = read(&table)?;
            copies(&table, bodies, material, &mut shapes)?;
        }
    }
    for table in tables(scene, "solid")? {
        let material = names.of(&table)?;
        let bodies = vec![solid::read(&table, names, material)?];
        copies(&table, bodies, material, &mut shapes)?;
    }
    // The kinds were read one after the other; numbers go by the file's order.
    shapes.sort_by_key(|shape| shape.line);
    Ok(shapes)
}

/// Adds what a table describes, once for each of its placements.
fn copies(
    table: &Table<'_>,
    bodies: Vec<Body>,
    material: usize,
    shapes: &mut Vec<Shape>,
) -> Result<(), Flaw> {
    let uv = if table.name == "triangle" { body::uv(table)? } else { None };
    let copies = place::read(table)?;
    table.done()?;
    for body in bodies {
        if let Some(why) = body.flaw() {
            return Err(Problem::degenerate(table.name, why).at(table.line));
        }
        room(copies.len() + shapes.len(), table.line)?;
        for by in &copies {
            let wrong = |why| Problem::degenerate(table.name, why).at(table.line);
            for body in body.placed(by).map_err(wrong)? {
                if let Some(why) = body.flaw() {
                    return Err(wrong(why));
                }
                within(&body, table.line)?;
                let uv = Shape::uv_placed(uv, by.mirrors());
                shapes.push(Shape { body, material, uv, line: table.line });
            }
        }
    }
    Ok(())
}

/// A scene's camera for files that are seen by another file's.
const NOWHERE: Camera = Camera {
    eye: [0.0, 0.0, 1.0],
    look_at: [0.0; 3],
    up: [0.0, 1.0, 0.0],
    angle: 45.0,
    span: Span::Edges,
};

/// More shapes than an octree counts are no scene.
fn room(shapes: usize, line: usize) -> Result<(), Flaw> {
    const MOST: usize = 8_388_607;
    if shapes <= MOST {
        return Ok(());
    }
    Err(Problem::range("number of shapes", shapes as f64, format!("at most {MOST}")).at(line))
}

/// Whether what was placed lies where coordinates may.
fn within(body: &Body, line: usize) -> Result<(), Flaw> {
    let bounds = match body {
        Body::Plane { point, .. } => Bounds::around(&[*point]),
        _ => body.bounds(),
    };
    let coordinates = bounds.into_iter().flat_map(|b| b.low.into_iter().chain(b.high));
    match coordinates.into_iter().find(|x| x.is_nan() || x.abs() > 2.0 * FARTHEST) {
        None => Ok(()),
        Some(x) => {
            let right = format!("within ±{FARTHEST}");
            Err(Problem::range("placed coordinate", x, right).at(line))
        }
    }
}

/// The tables of an array of tables, none if it isn't there.
fn tables<'d>(scene: &Table<'d>, key: &'static str) -> Result<Vec<Table<'d>>, Flaw> {
    let Some(value) = scene.get(key) else { return Ok(Vec::new()) };
    let wanted = format!("a list of tables, each under [[{key}]],");
    value.list(key, &wanted)?.iter().map(|item| item.table(key)).collect()
}

fn camera_of(table: &Table<'_>) -> Result<Camera, Flaw> {
    let spans = [("edges", Span::Edges), ("pixel-centers", Span::Centers)];
    let camera = Camera {
        eye: table.need("eye")?.point("eye")?,
        look_at: table.need("look_at")?.point("look_at")?,
        up: table.get("up").map_or(Ok([0.0, 1.0, 0.0]), |v| v.direction("up"))?,
        angle: table.number("angle", 0.01..170.0, 45.0)?,
        span: table
            .get("angle_spans")
            .map_or(Ok(Span::Edges), |v| v.word("angle_spans", &spans))?,
    };
    table.done()?;
    match camera.flaw() {
        Some(why) => Err(Problem::degenerate("camera", why).at(table.line)),
        None => Ok(camera),
    }
}

const FALLOFFS: [(&str, Falloff); 2] =
    [("inverse-square", Falloff::InverseSquare), ("none", Falloff::None)];

fn render_of(table: &Table<'_>) -> Result<(Option<Size>, Rules), Flaw> {
    let size = table.get("size").map(size_of).transpose()?;
    let like = Rules::SLIDES;
    let rules = Rules {
        specular_cosine: table.flag("specular_cosine", like.specular_cosine)?,
        highlight_cosine: table.flag("highlight_cosine", like.highlight_cosine)?,
        falloff: table.get("falloff").map_or(Ok(like.falloff), |v| v.word("falloff", &FALLOFFS))?,
        transmitters_reflect: table.flag("transmitters_reflect", like.transmitters_reflect)?,
        lossy_total_reflection: table
            .flag("lossy_total_reflection", like.lossy_total_reflection)?,
        cutoff: table.number("cutoff", 0.0..1.0, like.cutoff)?,
        depth: table.get("depth").map_or(Ok(like.depth), |v| {
            v.count("depth", 1, Rules::DEEPEST.into()).map(|depth| depth as u8)
        })?,
        lights: table.get("lights").map_or(Ok(like.lights), |v| selection_of(&v))?,
        terms: table.get("terms").map_or(Ok(like.terms), |v| terms_of(&v))?,
        light_jitter: {
            let seed = table.get("seed").map_or(Ok(0), |v| v.count("seed", 0, 65535))?;
            table.flag("light_jitter", true)?.then_some(seed as u16)
        },
        sampling: table.get("sampling").map_or(Ok(like.sampling), |v| sampling_of(&v))?,
    };
    table.done()?;
    Ok((size, rules))
}

fn terms_of(value: &Value<'_>) -> Result<Terms, Flaw> {
    let mut sum = Terms::NONE;
    for item in value.list("terms", "a list of words")? {
        sum = sum.with(item.word("terms", &terms::NAMES)?);
    }
    if terms::ends(sum) {
        return Ok(sum);
    }
    Err(Problem::degenerate("terms", terms::ENDLESS).at(value.line))
}

fn selection_of(value: &Value<'_>) -> Result<LightSelection, Flaw> {
    let Ok(table) = value.table("lights") else {
        return value.word("lights", &[("all", LightSelection::All)]);
    };
    let threshold = table.get("threshold").map(|v| v.number_in("threshold", 0.0..1000.0));
    let choose = table.get("choose").map(|v| v.count("choose", 1, 255));
    table.done()?;
    match (threshold.transpose()?, choose.transpose()?) {
        (Some(threshold), None) => Ok(LightSelection::Threshold(threshold)),
        (None, Some(count)) => Ok(LightSelection::Choose(count as u8)),
        _ => Err(table.missing("either \"threshold\" or \"choose\"")),
    }
}

fn sampling_of(value: &Value<'_>) -> Result<Sampling, Flaw> {
    let text = value.text("sampling")?;
    sampling::parse(text).map_err(|why| Problem::Syntax(format!("sampling: {why}")).at(value.line))
}

fn size_of(value: Value<'_>) -> Result<Size, Flaw> {
    let wanted = "[width, height]";
    let list = value.list("size", wanted)?;
    let [width, height] = list.as_slice() else {
        let found = format!("a list of {} for \"size\"", list.len());
        return Err(Problem::Found { found, wanted: wanted.into() }.at(value.line));
    };
    Ok(Size {
        width: width.count("width", 1, Size::LARGEST)?,
        height: height.count("height", 1, Size::LARGEST)?,
    })
}

fn background_of(value: &Value<'_>) -> Result<Background, Flaw> {
    // `background = 0.2` is the short form of `[background] color = 0.2`.
    let Ok(table) = value.table("background") else {
        return Ok(Background::Color(value.color("background", 1000.0)?));
    };
    let color = table.get("color").map(|v| v.color("color", 1000.0)).transpose()?;
    let bottom = table.get("bottom").map(|v| v.color("bottom", 1000.0)).transpose()?;
    let top = table.get("top").map(|v| v.color("top", 1000.0)).transpose()?;
    let up: Option<Point> = table.get("up").map(|v| v.direction("up")).transpose()?;
    table.done()?;
    match (color, bottom, top) {
        (Some(color), None, None) => Ok(Background::Color(color)),
        (None, Some(bottom), Some(top)) => {
            Ok(Background::Gradient { bottom, top, up: up.unwrap_or([0.0, 1.0, 0.0]) })
        }
        _ => Err(table.missing("either \"color\", or both \"bottom\" and \"top\",")),
    }
}

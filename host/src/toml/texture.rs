//! Textures and bumps of materials.

use whitted::scene::{Filter, Mapping, Pattern, TextureSpec, Wrap};

use super::table::{Table, Value};
use crate::document::{FARTHEST, Point, Texture};
use crate::error::{Flaw, Problem, shown};
use crate::flash;
use crate::read::Around;

#[derive(Clone, Copy)]
enum Kind {
    Checker,
    Stripes,
    Gradient,
    Noise,
    Marble,
    Wood,
    Brick,
    Image,
}

const KINDS: [(&str, Kind); 8] = [
    ("checker", Kind::Checker),
    ("stripes", Kind::Stripes),
    ("gradient", Kind::Gradient),
    ("noise", Kind::Noise),
    ("marble", Kind::Marble),
    ("wood", Kind::Wood),
    ("brick", Kind::Brick),
    ("image", Kind::Image),
];

const MAPPINGS: [(&str, Mapping); 4] = [
    ("planar", Mapping::Planar),
    ("spherical", Mapping::Spherical),
    ("cylindrical", Mapping::Cylindrical),
    ("uv", Mapping::Uv),
];

const WRAPS: [(&str, Wrap); 2] = [("repeat", Wrap::Repeat), ("clamp", Wrap::Clamp)];

const FILTERS: [(&str, Filter); 2] = [("nearest", Filter::Nearest), ("bilinear", Filter::Bilinear)];

/// The strongest that a colour can make a coefficient.
const STRONGEST: f64 = 15.9;

/// A texture, and the name of the material that it shows in places.
pub(super) fn read<'d>(
    table: &Table<'d>,
    around: &Around,
) -> Result<(Texture, Option<Value<'d>>), Flaw> {
    let (mut texture, kind) = pattern(table, around)?;
    let with = table.get("with");
    match table.get("colors") {
        Some(value) if with.is_some() || matches!(kind, Kind::Image) => {
            let why = if with.is_some() { "\"with\" says what it shows" } else { "it has its own" };
            return Err(Problem::degenerate("colors of a texture", why).at(value.line));
        }
        Some(value) => {
            let wanted = "two colors";
            let list = value.list("colors", wanted)?;
            let [first, second] = list.as_slice() else {
                let found = format!("a list of {} for \"colors\"", list.len());
                return Err(Problem::Found { found, wanted: wanted.into() }.at(value.line));
            };
            texture.spec.colors =
                [first.color("colors", STRONGEST)?, second.color("colors", STRONGEST)?];
        }
        None => {}
    }
    if let Some(with) = &with
        && texture.spec.mapping == Mapping::Uv
    {
        let why = "another material can't be shown by a mesh's coordinates";
        return Err(Problem::degenerate("texture", why).at(with.line));
    }
    table.done()?;
    Ok((texture, with))
}

/// A texture whose height bends normals.
pub(super) fn bump(table: &Table<'_>, around: &Around) -> Result<Texture, Flaw> {
    let (mut texture, _) = pattern(table, around)?;
    let height = table.need("height")?;
    texture.spec.height = height.number_in("height", -FARTHEST..FARTHEST)?;
    if texture.spec.mapping != Mapping::Planar {
        let why = "only a planar mapping has slopes";
        return Err(Problem::degenerate("bump", why).at(table.line));
    }
    let finest = texture.spec.size.into_iter().filter(|&s| s > 0.0).fold(f64::MAX, f64::min);
    let cells = match texture.spec.pattern {
        Pattern::Image(image) => f64::from(image.size().0.max(image.size().1)),
        _ => 1.0,
    };
    let most = 4.0 * finest / cells;
    if texture.spec.height.abs() > most {
        let right = format!("within ±{most}, four cells (pixels of a picture)");
        return Err(Problem::range("height", texture.spec.height, right).at(height.line));
    }
    table.done()?;
    Ok(texture)
}

fn pattern(table: &Table<'_>, around: &Around) -> Result<(Texture, Kind), Flaw> {
    let kind = table.need("type")?.word("type", &KINDS)?;
    let octaves = |default| {
        table.get("octaves").map_or(Ok(default), |v| v.count("octaves", 1, 8).map(|n| n as u8))
    };
    let turbulence = |default| table.number("turbulence", 0.0..16.0, default);
    let wrap = || table.get("wrap").map_or(Ok(Wrap::Repeat), |v| v.word("wrap", &WRAPS));
    let mut file = None;
    let pattern = match kind {
        Kind::Checker => Pattern::Checker,
        Kind::Stripes => Pattern::Stripes { width: table.number("width", 0.0..1.0, 0.5)? },
        Kind::Gradient => Pattern::Gradient { wrap: wrap()? },
        Kind::Noise => Pattern::Noise { octaves: octaves(4)? },
        Kind::Marble => Pattern::Marble { octaves: octaves(4)?, turbulence: turbulence(1.0)? },
        Kind::Wood => Pattern::Wood { octaves: octaves(2)?, turbulence: turbulence(0.3)? },
        Kind::Brick => Pattern::Brick { mortar: table.number("mortar", 0.0..1.0, 0.15)? },
        Kind::Image => {
            let name = table.need("file")?;
            let text = name.text("file")?;
            let path = around.file_beside(text);
            let most = table.get("palette").map_or(Ok(flash::MOST_COLORS), |v| {
                v.count("palette", flash::LEAST_COLORS, flash::MOST_COLORS)
            })?;
            let image = flash::picture(&path, most).map_err(|problem| {
                let what = format!("picture \"{}\"", shown(text));
                Problem::degenerate(what, problem.to_string()).at(name.line)
            })?;
            let filter =
                table.get("filter").map_or(Ok(Filter::Bilinear), |v| v.word("filter", &FILTERS))?;
            file = Some(path);
            Pattern::Image(image.with_filter(filter).with_wrap(wrap()?))
        }
    };
    let like = TextureSpec::of(pattern);
    let mapping = table.get("mapping");
    let spec = TextureSpec {
        mapping: mapping.map_or(Ok(Mapping::Planar), |v| v.word("mapping", &MAPPINGS))?,
        origin: table.get("origin").map_or(Ok(like.origin), |v| v.point("origin"))?,
        right: table.get("right").map_or(Ok(like.right), |v| v.direction("right"))?,
        up: table.get("up").map_or(Ok(like.up), |v| v.direction("up"))?,
        size: size(table)?,
        ..like
    };
    // What the core makes of it is asked in the arithmetic that has room for all.
    if let Err(error) = whitted::scene::Texture::<f64>::try_new(&spec) {
        return Err(Problem::degenerate("texture", error.to_string()).at(table.line));
    }
    Ok((Texture { spec, other: None, file, line: table.line }, kind))
}

/// The sides of a cell.
fn size(table: &Table<'_>) -> Result<Point, Flaw> {
    let Some(value) = table.get("size") else { return Ok([1.0; 3]) };
    let size = match value.number("size") {
        Ok(_) => [value.positive("size")?; 3],
        Err(_) => value.point("size")?,
    };
    if size.iter().any(|&s| s < 0.0) || size == [0.0; 3] {
        let why = "its size must be positive along one axis, and 0 along those that don't count";
        return Err(Problem::degenerate("texture", why).at(value.line));
    }
    Ok(size)
}

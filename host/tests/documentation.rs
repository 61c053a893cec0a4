//! The page on the scene format names every key that the reader knows, and its example is right.

use whitted_host::error::Problem;
use whitted_host::read::{Format, parse};

const PAGE: &str = include_str!("../../docs/scene-format.md");

const SMALLEST: &str = "[camera]\neye = [0, 1, -5]\nlook_at = [0, 0, 0]\n";
const SPHERE: &str = "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n";
const BALL: &str = "sphere = { center = [0, 0, 0], radius = 1 }";
const GROUP: &str = "[[group]]\nname = \"g\"\n[[group.sphere]]\ncenter = [0, 0, 0]\nradius = 1\n";
const MATERIAL: &str = "[[material]]\nname = \"a\"\n";

/// The keys that the reader lists where it finds one that it doesn't know.
fn known(text: &str) -> Vec<String> {
    match parse(Format::Toml, text.as_bytes()).map_err(|flaw| flaw.problem) {
        Err(Problem::Unknown { what: "key", found, known }) if found == "zzz" => known,
        Err(problem) => panic!("{text}\n{problem}"),
        Ok(_) => panic!("{text}\nunknown key not noticed"),
    }
}

#[test]
fn every_key_is_documented() {
    let point = "[0, 1, 0]";
    let tables = [
        "[camera]\neye = [0, 1, -5]\nlook_at = [0, 0, 0]\nzzz = 1\n".to_string(),
        format!("{SMALLEST}[render]\nzzz = 1\n"),
        format!("{SMALLEST}[background]\nzzz = 1\n"),
        format!("{SMALLEST}{MATERIAL}zzz = 1\n"),
        format!("{SMALLEST}{MATERIAL}checker = {{ with = \"b\", zzz = 1 }}\n"),
        format!("{SMALLEST}{MATERIAL}texture = {{ type = \"wood\", zzz = 1 }}\n"),
        format!("{SMALLEST}{MATERIAL}texture = {{ type = \"brick\", zzz = 1 }}\n"),
        format!("{SMALLEST}{MATERIAL}texture = {{ type = \"stripes\", zzz = 1 }}\n"),
        format!("{SMALLEST}{MATERIAL}texture = {{ type = \"gradient\", zzz = 1 }}\n"),
        format!("{SMALLEST}{MATERIAL}bump = {{ type = \"noise\", height = 1, zzz = 1 }}\n"),
        format!("{SMALLEST}{MATERIAL}[[light]]\nposition = {point}\nzzz = 1\n"),
        format!(
            "{SMALLEST}{MATERIAL}[[light]]\ntype = \"spot\"\nposition = {point}\n\
             direction = {point}\nzzz = 1\n"
        ),
        format!(
            "{SMALLEST}{MATERIAL}[[light]]\ntype = \"rectangle\"\nradiance = 1\n\
             corner = {point}\nedges = [[1, 0, 0], [0, 1, 0]]\nzzz = 1\n"
        ),
        format!(
            "{SMALLEST}{MATERIAL}[[light]]\ntype = \"disc\"\nradiance = 1\n\
             center = {point}\nnormal = {point}\nradius = 1\nzzz = 1\n"
        ),
        format!("{SMALLEST}{MATERIAL}[[plane]]\npoint = {point}\nnormal = {point}\nzzz = 1\n"),
        format!("{SMALLEST}{MATERIAL}{SPHERE}zzz = 1\n"),
        format!("{SMALLEST}{MATERIAL}[[box]]\nmin = [0, 0, 0]\nmax = [1, 1, 1]\nzzz = 1\n"),
        format!(
            "{SMALLEST}{MATERIAL}[[cone]]\nbase = [0, 0, 0]\nbase_radius = 1\napex = {point}\n\
             zzz = 1\n"
        ),
        format!("{SMALLEST}{MATERIAL}{SPHERE}rotate = {{ axis = {point}, angle = 1, zzz = 1 }}\n"),
        format!("{SMALLEST}{MATERIAL}{SPHERE}repeat = {{ count = 1, step = {point}, zzz = 1 }}\n"),
        format!("mesh = [{{ file = \"\", zzz = 1 }}]\n{SMALLEST}"),
        format!("include = [{{ file = \"\", zzz = 1 }}]\n{SMALLEST}"),
        format!("{SMALLEST}{MATERIAL}{SPHERE}[[zzz]]\n"),
        format!("{SMALLEST}{MATERIAL}[[solid]]\nunion = [{{ {BALL}, zzz = 1 }}]\n"),
        format!("{SMALLEST}{MATERIAL}[[solid]]\nunion = [{{ {BALL} }}]\nzzz = 1\n"),
        format!("{SMALLEST}{MATERIAL}[[group]]\nname = \"g\"\n[[group.zzz]]\n"),
        format!("{SMALLEST}{MATERIAL}{GROUP}[[instance]]\ngroup = \"g\"\nzzz = 1\n"),
    ];
    for table in tables {
        for key in known(&table) {
            let [plain, one, many] = [format!("`{key}`"), format!("[{key}]"), format!("[[{key}]]")];
            let inline = format!("{key} = ");
            assert!(
                [plain, one, many, inline].iter().any(|form| PAGE.contains(form)),
                "\"{key}\" is not in docs/scene-format.md"
            );
        }
    }
}

#[test]
fn the_example_is_right() {
    let example = PAGE.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next());
    let document = parse(Format::Toml, example.expect("there is one").as_bytes());
    assert_eq!(document.map(|d| d.shapes.len()).ok(), Some(1));
}

//! Where an address belongs: the functions that were inlined there, and the stage of a frame.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use addr2line::Loader;

use crate::elf;
use crate::shell::root;

/// What of a frame's work stands in no file of the library that has a stage.
const OTHER: &str = "other";

/// A function, inlined or not.
#[derive(Clone)]
struct Function {
    /// Its own, behind that of the file.
    name: String,
    /// The file below the library's `src`, without its ending; none outside.
    file: Option<String>,
    /// Whether it is the one that draws a frame, and the marks around a row.
    draws: bool,
    mark: Option<Mark>,
}

/// Where a firmware reads its counter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mark {
    /// Before a row.
    Before,
    /// After it.
    After,
}

/// The functions of a program.
pub(crate) struct Places {
    lines: Loader,
    library: PathBuf,
    /// By address, the outermost first.
    known: HashMap<u32, Vec<Function>>,
    marks: HashMap<u32, Option<Mark>>,
}

/// Who called whom.
pub(crate) struct Stack {
    /// The functions, the outermost first, with `;` between them.
    pub(crate) functions: String,
    pub(crate) stage: String,
    /// Whether a shadow ray was on its way.
    pub(crate) shadow: bool,
}

impl Places {
    pub(crate) fn new(image: &Path) -> Result<Self, String> {
        let lines = Loader::new(image).map_err(|error| format!("{}: {error}", image.display()))?;
        let library = root().join("src");
        Ok(Self { lines, library, known: HashMap::new(), marks: HashMap::new() })
    }

    /// Whether an address reads the counter, for a frame.
    pub(crate) fn mark(&mut self, address: u32) -> Option<Mark> {
        if let Some(&mark) = self.marks.get(&address) {
            return mark;
        }
        let functions = self.functions(address);
        let mark = functions.iter().find_map(|function| function.mark);
        let mark = mark.filter(|_| functions.iter().any(|function| function.draws));
        self.marks.insert(address, mark);
        mark
    }

    /// The stack at an address, from the calls that led there, the outermost first. It begins with
    /// the library.
    pub(crate) fn stack(&mut self, calls: &[u32], address: u32) -> Stack {
        let mut all = Vec::new();
        for &address in calls.iter().chain([&address]) {
            all.extend_from_slice(self.functions(address));
        }
        let within = all.iter().position(|function| function.file.is_some());
        let all = &all[within.unwrap_or(all.len().saturating_sub(1))..];
        let names: Vec<_> = all.iter().map(|function| function.name.as_str()).collect();
        let stage = all.iter().rev().find_map(|f| stage(f.file.as_deref()?, &f.name));
        let shadow = all.iter().any(|f| f.file.as_deref() == Some("trace/visible"));
        Stack {
            functions: if names.is_empty() { "?".into() } else { names.join(";") },
            stage: stage.unwrap_or_else(|| OTHER.into()),
            shadow,
        }
    }

    fn functions(&mut self, address: u32) -> &[Function] {
        let (lines, library) = (&self.lines, &self.library);
        self.known.entry(address).or_insert_with(|| read(lines, library, address))
    }
}

/// The functions at an address, the outermost first.
fn read(lines: &Loader, library: &Path, address: u32) -> Vec<Function> {
    let mut functions = Vec::new();
    if let Ok(mut frames) = lines.find_frames(u64::from(address)) {
        while let Ok(Some(frame)) = frames.next() {
            let path = frame.function.as_ref().and_then(|function| function.raw_name().ok());
            let path = path.map_or_else(|| "?".into(), |raw| elf::demangled(&raw));
            let file = frame.location.and_then(|place| place.file);
            functions.push(Function::new(&path, file.map(Path::new), library));
        }
    }
    if functions.is_empty() {
        let symbol =
            lines.find_symbol(u64::from(address)).map_or_else(|| "?".into(), elf::demangled);
        functions.push(Function::new(&symbol, None, library));
    }
    functions.reverse();
    functions
}

impl Function {
    /// Of a path, of which there is but the end where a function was inlined.
    fn new(path: &str, file: Option<&Path>, library: &Path) -> Self {
        let plain = without_arguments(path);
        let own = plain.rsplit("::").next().unwrap_or(&plain);
        let counts = file.is_some_and(|file| file.ends_with("demo/src/counter.rs"));
        let mark = match own {
            "before" if counts => Some(Mark::Before),
            "after" if counts => Some(Mark::After),
            _ => None,
        };
        let draws = own == "draw_scene";
        let file = file.and_then(|file| file.strip_prefix(library).ok()).map(|file| {
            // The same on every system.
            file.with_extension("").to_string_lossy().replace('\\', "/")
        });
        let name = match &file {
            Some(file) => format!("{}::{own}", file.trim_end_matches("/mod")),
            None => own.to_owned(),
        };
        Self { name: name.replace([';', ' '], "_"), file, draws, mark }
    }
}

/// The stage that a function stands for; none for one that serves several.
fn stage(file: &str, function: &str) -> Option<String> {
    let function = function.rsplit("::").next().unwrap_or(function);
    let (folder, name) = file.split_once('/').unwrap_or(("", file));
    let stage = match (folder, name) {
        // What a shape does once it is hit.
        ("shape", _) if surface(function) => "surface",
        ("shape", "mod" | "chord" | "projection" | "region" | "error") => return None,
        ("shape", name) => return Some(format!("test: {}", name.replace('_', " "))),
        ("octree", _) => "tree walk",
        ("trace", "nearest") => "search: nearest",
        ("trace", "visible") => "search: shadow",
        ("trace", "sight") => "search: cones",
        ("trace", "meet") if surface(function) => "surface",
        ("trace", "meet") => return None,
        ("trace", "direct" | "select") => "direct light",
        ("trace", name) if name.starts_with("area") => "direct light",
        ("trace", "detail") => "texture",
        ("trace", "radiance") if function == "shade" => "shading",
        ("trace", "indirect") => "interreflection",
        ("trace", _) => "ray tree",
        ("gather", _) => "interreflection",
        ("scene", "light" | "area_light" | "selection") => "direct light",
        ("scene", "background") => "background",
        ("scene", "camera") => "camera",
        ("scene", "material" | "absorption") => "shading",
        ("scene", "instance" | "transform" | "group") => "instances",
        ("scene", name) if name.starts_with("texture") => "texture",
        ("frame", "tone" | "pixel" | "band" | "mod") => "output",
        ("frame", _) => "frame and sampling",
        ("", "draw") => "output",
        _ => return None,
    };
    Some(stage.into())
}

/// Whether a function of a shape is asked of the shape that was hit.
fn surface(function: &str) -> bool {
    function.starts_with("surface") || function.starts_with("turned") || function == "back"
}

/// A path without generic arguments, and without what stands in brackets before it.
fn without_arguments(path: &str) -> String {
    let mut plain = String::new();
    let mut depth = 0;
    for c in path.chars() {
        match c {
            '<' => depth += 1,
            '>' if depth > 0 => depth -= 1,
            _ if depth == 0 => plain.push(c),
            _ => {}
        }
    }
    plain.trim_end_matches("::").into()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::{Function, Mark, stage, without_arguments};

    #[test]
    fn names_without_arguments() {
        for (path, name) in [
            ("main", "main"),
            (
                "whitted::trace::visible::occluder::<Fixed, (), 513>",
                "whitted::trace::visible::occluder",
            ),
            ("whitted::shape::sphere::Sphere<A>::meet", "whitted::shape::sphere::Sphere::meet"),
            ("<whitted::shape::sphere::Sphere<Fixed>>::meet::<1>", "::meet"),
            ("<(A, B<C>) as d::E>::f", "::f"),
        ] {
            assert_eq!(without_arguments(path), name, "{path}");
        }
    }

    #[test]
    fn stages_by_file_and_function() {
        let found = |file, function| stage(file, function);
        assert_eq!(found("shape/sphere", "Sphere::meet").as_deref(), Some("test: sphere"));
        assert_eq!(found("shape/sphere", "Sphere::surface").as_deref(), Some("surface"));
        assert_eq!(found("math/fixed/kernel", "kernel::wide"), None);
        assert_eq!(found("octree/walk", "walk::walk").as_deref(), Some("tree walk"));
        assert_eq!(found("scene/texture/noise", "noise::at").as_deref(), Some("texture"));
    }

    #[test]
    fn functions_by_file() {
        let of = |path, file: &'static str| {
            Function::new(path, Some(Path::new(file)), "/l/src".as_ref())
        };
        let counter = "/l/boards/demo/src/counter.rs";
        assert_eq!(of("before", counter).mark, Some(Mark::Before));
        assert_eq!(of("<d::Counter as d::Watch>::after", counter).mark, Some(Mark::After));
        assert_eq!(of("before", "/l/src/frame/mod.rs").mark, None);
        assert!(of("d::Frame<W>::draw_scene", "/l/boards/demo/src/frame.rs").draws);
        assert_eq!(of("<s::Sphere<A>>::meet", "/l/src/shape/sphere.rs").name, "shape/sphere::meet");
        assert_eq!(of("memcpy", "/rust/src/mem.rs").name, "memcpy");
    }
}

//! The template, copied as `docs/ten-minutes.md` says, for a smaller display: what its image draws on the emulated
//! Pico is what the host draws of the same scene.

use std::fmt::Display;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use whitted::frame::{Output, Renderer, Rgb565, Settings};
use whitted::math::Fixed;
use whitted::trace::Work;
use whitted_demo::rgb565::BYTES;
use whitted_host::bake::Baked;
use whitted_host::document::Size;
use whitted_host::read;

use crate::machine;
use crate::report::Report;
use crate::setup;
use crate::shell::{boards, cargo, output, root};

/// The copy's display.
const SIZE: (u16, u16) = (60, 45);
/// What is copied.
const FILES: [&str; 7] = [
    "Cargo.toml",
    "Cargo.lock",
    ".cargo/config.toml",
    "build.rs",
    "memory.x",
    "scene.toml",
    "src/main.rs",
];
/// The copy's name. With the template's own, cargo would take what it has built of one for the other: it keeps both in
/// one place, and tells packages apart by their names.
const NAME: &str = "my-small-scene";
/// Trees of rays that there is memory for here, whatever the scene asks for.
const MAX_DEPTH: usize = 8;

/// Copies, builds, runs and compares.
pub(crate) fn check(report: &mut Report) {
    report.check(
        "template (rp2040py): a copy, its display smaller, gets the host's picture",
        || {
            // Outside the boards' directory, whose settings would be added to the copy's.
            let copy = root().join("target/tmp").join(NAME);
            FILES.iter().try_for_each(|name| duplicate(name, &copy))?;
            // As it was linted: nothing else is to be built again.
            let target = boards().join("target").display().to_string();
            let words =
                ["build", "-q", "--locked", "--target-dir", &target, "--message-format=json"];
            let image = machine::built(&mut cargo(&copy, words), NAME)?;
            let (there, here) = (emulate(&image)?, expected(&copy.join("scene.toml"))?);
            let wrong = there.iter().zip(&here).filter(|(there, here)| there != here).count();
            if there.len() == here.len() && wrong == 0 {
                Ok(())
            } else {
                Err(format!("{wrong} bytes of {} differ", here.len()))
            }
        },
    );
}

/// Copies a file, which is changed as its user changes it.
fn duplicate(name: &str, copy: &Path) -> Result<(), String> {
    let (width, height) = SIZE;
    let paths = format!("path = \"{}", root().display());
    let size = format!("({width}, {height})");
    let sides = format!("width: {width}, height: {height}");
    let package = ("name = \"my-scene\"", format!("name = \"{NAME}\""));
    let changes = match name {
        "Cargo.toml" => vec![package, ("path = \"..", paths)],
        "Cargo.lock" => vec![package],
        "src/main.rs" => vec![("(240, 240)", size)],
        "build.rs" => vec![("width: 240, height: 240", sides)],
        _ => vec![],
    };
    let (from, to) = (root().join("template").join(name), copy.join(name));
    let wrong = |error: &dyn Display| format!("{}: {error}", from.display());
    let mut text = fs::read_to_string(&from).map_err(|error| wrong(&error))?;
    for (old, new) in changes {
        if !text.contains(old) {
            return Err(wrong(&format!("no `{old}`")));
        }
        text = text.replace(old, &new);
    }
    // A file that is as it was is nothing to build again.
    if fs::read_to_string(&to).is_ok_and(|there| there == text) {
        return Ok(());
    }
    let written =
        to.parent().map_or(Ok(()), fs::create_dir_all).and_then(|()| fs::write(&to, text));
    written.map_err(|error| format!("{}: {error}", to.display()))
}

/// What the display holds when the LED goes off, the flash erased in the meantime.
fn emulate(image: &Path) -> Result<Vec<u8>, String> {
    let dump: PathBuf = image.with_extension("rgb565");
    // A picture from before proves nothing.
    let _ = fs::remove_file(&dump);
    let mut python = Command::new(setup::python()?);
    python.arg("-B").arg(boards().join("pico/emulate/emulate.py")).arg("--erase").arg(image);
    python.args(["-", &SIZE.0.to_string(), &SIZE.1.to_string(), "0", "0", "240", "320"]);
    let said = output(python.arg(&dump))?;
    said.lines().for_each(|line| println!("     {line}"));
    fs::read(&dump).map_err(|error| format!("{}: {error}", dump.display()))
}

/// The host's picture of the scene.
fn expected(scene: &Path) -> Result<Vec<u8>, String> {
    let (width, height) = SIZE;
    let size = Size { width: width.into(), height: height.into() };
    let document = read::read(scene).map_err(|error| error.to_string())?;
    let flaw = |flaw: whitted_host::error::Flaw| flaw.of(scene).to_string();
    let baked = Baked::<Fixed>::new(&document).map_err(flaw)?;
    let camera = baked.camera(size).map_err(flaw)?;
    let drawn = baked.with_scene(|scene| {
        let mut work = Work::<Fixed, MAX_DEPTH>::new();
        let settings = Settings { depth: document.rules.depth, ..Settings::new(width, height) };
        let mut renderer = Renderer::new(scene, &camera, settings, &mut work, &mut [])
            .map_err(|error| error.to_string())?;
        let mut bytes = vec![0; usize::from(width) * usize::from(height) * BYTES];
        renderer.band::<Rgb565>(0, &Output::SRGB, &mut bytes);
        Ok::<_, String>(bytes)
    });
    drawn.map_err(flaw)?
}

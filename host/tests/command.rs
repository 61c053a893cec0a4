//! The command as a person uses it.

mod common;

use common::{errors, files, said, whitted};

const SCENES: [&str; 5] = ["showcase", "shapes", "limit", "raystones", "ftb"];

fn scene(name: &str) -> String {
    format!("{}/scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

/// Width and height of a PNG.
fn png_size(path: &std::path::Path) -> (u32, u32) {
    let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let reader = png::Decoder::new(file).read_info().unwrap();
    (reader.info().width, reader.info().height)
}

#[test]
fn alone_it_renders_the_showcase() {
    let place = tempfile::tempdir().unwrap();
    let output = whitted(place.path(), &[]);
    assert_eq!(errors(&output), "");
    assert!(output.status.success());
    assert_eq!(files(place.path()), ["whitted.png"]);
    assert_eq!(png_size(&place.path().join("whitted.png")), (480, 320));
    let said = said(&output);
    assert!(said.contains("153600 primary"), "{said}");
    assert!(said.ends_with("whitted.png\n"), "{said}");
    assert!(!said.contains('\x1b'), "no control codes to a pipe");
}

#[test]
fn every_scene_of_ours_renders_in_every_arithmetic() {
    let place = tempfile::tempdir().unwrap();
    for name in SCENES {
        for arithmetic in ["fixed", "f32", "f64"] {
            let scene = scene(name);
            let arguments = ["-q", "render", &scene, "--arith", arithmetic, "--size", "32x24"];
            let output = whitted(place.path(), &arguments);
            assert_eq!(errors(&output), "", "{name} {arithmetic}");
            assert_eq!(said(&output), "");
        }
        assert_eq!(png_size(&place.path().join(name).with_extension("png")), (32, 24));
    }
}

#[test]
fn a_deadline_leaves_what_the_screen_shows_then() {
    let place = tempfile::tempdir().unwrap();
    let render = |more: &[&str]| {
        let scene = scene("limit");
        let arguments = [&["render", &scene, "--size", "40x32", "-o", "x.png"], more].concat();
        let output = whitted(place.path(), &arguments);
        assert_eq!(errors(&output), "");
        (said(&output), std::fs::read(place.path().join("x.png")).unwrap())
    };
    let (_, plain) = render(&[]);
    let (said, shown) = render(&["--deadline", "0"]);
    assert!(said.contains("the deadline came in the pass of 16x16 blocks\n"), "{said}");
    assert!(shown != plain);
    let (said, shown) = render(&["--deadline", "1500"]);
    assert!(said.contains("the deadline came in the pass of 1x1 blocks\n"), "{said}");
    assert!(shown != plain);
    let (said, shown) = render(&["--deadline", "100000"]);
    assert!(said.contains("the picture is finished\n"), "{said}");
    assert!(shown == plain, "the last pass leaves the plain picture");
    let (_, plain) = render(&["--sampling", "sparse"]);
    let (_, shown) = render(&["--sampling", "sparse", "--deadline", "100000"]);
    assert!(shown == plain);
}

/// The light that surfaces send each other is made first; a pool that was too small is said.
#[test]
fn a_deadline_has_indirect_light_too() {
    let place = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(scene("box")).unwrap();
    let render = |records: &str, more: &[&str]| {
        let text = text.replace("rays = 192", &format!("rays = 12\nrecords = {records}"));
        std::fs::write(place.path().join("x.toml"), text).unwrap();
        let arguments = [&["render", "x.toml", "--size", "16x16", "-o", "x.png"], more].concat();
        let output = whitted(place.path(), &arguments);
        assert_eq!(errors(&output), "");
        (said(&output), std::fs::read(place.path().join("x.png")).unwrap())
    };
    let (said, plain) = render("20000", &[]);
    assert!(!said.contains("full"), "{said}");
    let (said, shown) = render("20000", &["--deadline", "1000000"]);
    assert!(said.contains("the picture is finished\n") && said.contains(" ambient\n"), "{said}");
    assert!(shown == plain);
    for more in [&[][..], &["--deadline", "1000000"]] {
        let (said, shown) = render("20", more);
        assert!(said.contains("the irradiance cache is full"), "{said}");
        assert!(shown != plain);
    }
}

#[test]
fn a_scene_can_say_how_it_is_sampled() {
    let place = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(scene("limit")).unwrap();
    let text = text.replace("depth = 4", "depth = 4\nsampling = \"adaptive:2\"");
    std::fs::write(place.path().join("x.toml"), text).unwrap();
    let render = |more: &[&str]| {
        let all = [&["-q", "render", "x.toml", "--size", "24x16", "-o", "-"], more].concat();
        let output = whitted(place.path(), &all);
        assert_eq!(errors(&output), "");
        output.stdout
    };
    assert!(render(&[]) == render(&["--sampling", "adaptive:2"]));
    assert!(render(&[]) != render(&["--sampling", "center"]));
}

#[test]
fn stats_say_what_it_took() {
    let place = tempfile::tempdir().unwrap();
    let scene = scene("shapes");
    let arguments =
        ["render", &scene, "--size", "20x10", "--sampling", "corners", "--stats", "s.json"];
    assert!(whitted(place.path(), &arguments).status.success());
    let text = std::fs::read_to_string(place.path().join("s.json")).unwrap();
    let stats: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(stats["width"], 20);
    assert_eq!(stats["height"], 10);
    assert_eq!(stats["arithmetic"], "f64");
    assert_eq!(stats["rays"]["primary"], 21 * 11);
    for (group, names) in [
        ("rays", &["reflection", "transmission", "shadow", "ambient"][..]),
        ("hits", &["primary", "shadow"]),
        ("octree", &["nodes_visited", "shapes_tested"]),
        ("seconds", &["load", "build", "render"]),
    ] {
        for name in names {
            assert!(stats[group][name].is_number(), "{group}.{name}");
        }
    }
}

#[test]
fn it_shows_other_things() {
    let place = tempfile::tempdir().unwrap();
    for show in ["depth", "normal", "rays", "octree"] {
        let scene = scene("shapes");
        let arguments = ["-q", "render", &scene, "--size", "24x16", "--show", show, "-o", "x.png"];
        assert_eq!(errors(&whitted(place.path(), &arguments)), "", "{show}");
    }
}

#[test]
fn check_says_what_is_in_it() {
    let place = tempfile::tempdir().unwrap();
    let said = said(&whitted(place.path(), &["check", &scene("shapes")]));
    for part in ["1 sphere", "1 box", "1 smooth triangle", "2 cones", "point, spot, directional"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    assert!(said.contains("fixed      yes, scaled by 2^"), "{said}");
    for part in ["  flash    ", "bytes to trace 5 deep", " a pixel, and ", "Raspberry Pi Pico "] {
        assert!(said.contains(part), "{part}: {said}");
    }
    assert!(!said.contains("doesn't fit"), "{said}");
}

/// A ball sends no ray on; a mirror beside it sends one, and a far light's rays are parallel.
#[test]
fn check_says_how_deep_trees_of_rays_get_and_what_became_of_lights() {
    let place = tempfile::tempdir().unwrap();
    let matt = "[camera]\neye = [0, 0, 9]\nlook_at = [0, 0, 0]\n\
                [[light]]\nposition = [0, 9e6, 0]\n[[light]]\nposition = [0, 9, 0]\n\
                [[material]]\nname = \"a\"\n[[sphere]]\nmaterial = \"a\"\ncenter = [0, 0, 0]\nradius = 1\n";
    let mirror = "[[material]]\nname = \"b\"\nreflection = 0.5\n\
                  [[sphere]]\nmaterial = \"b\"\ncenter = [2.5, 0, 0]\nradius = 1\n";
    let check = |text: &str| {
        std::fs::write(place.path().join("x.toml"), text).unwrap();
        said(&whitted(place.path(), &["check", "x.toml"]))
    };
    let alone = check(matt);
    assert!(alone.contains("  trees    up to 1 deep in a small picture: depth = 1 would do\n"));
    assert!(alone.contains(", 1 far light made directional; no octree\n"), "{alone}");
    let both = check(&format!("{matt}{mirror}"));
    assert!(both.contains("  trees    up to 2 deep in a small picture: depth = 2 would do\n"));
    let mirrors = check(&format!("{matt}{mirror}[render]\ndepth = 2\n"));
    assert!(mirrors.contains("up to 2 deep in a small picture: as deep as they may\n"));
}

#[test]
fn the_terms_of_a_pixel_sum_to_it() {
    let place = tempfile::tempdir().unwrap();
    let said = said(&whitted(place.path(), &["trace", &scene("showcase"), "200", "180"]));
    let numbers = |line: &str| -> Vec<f64> {
        line.split_whitespace().skip(1).take(3).map(|n| n.parse().unwrap()).collect()
    };
    let mut sum = [0.0; 3];
    for line in said.lines().filter(|l| l.trim_start().starts_with("+ ")) {
        sum.iter_mut().zip(numbers(line)).for_each(|(s, n)| *s += n);
    }
    let total = numbers(said.lines().last().unwrap());
    let count = said.lines().count() as f64;
    for (s, t) in sum.iter().zip(total) {
        // Each line is rounded to four digits.
        assert!((s - t).abs() < 0.00005 * count, "{s} {t}\n{said}");
    }
    let output = whitted(place.path(), &["trace", &scene("showcase"), "480", "0"]);
    assert!(errors(&output).contains("pixel 480 0 is outside the picture: its size is 480x320"));
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn wrong_options() {
    let place = tempfile::tempdir().unwrap();
    for (arguments, says) in [
        (&["render"][..], "<SCENE>"),
        (&["render", "x.toml", "--size", "0x4"], "write WxH, each 1 to 16384"),
        (&["render", "x.toml", "--size", "99999999x4"], "write WxH"),
        (&["render", "x.toml", "--size", "axb"], "write WxH"),
        (&["render", "x.toml", "--depth", "0"], "0 is not in 1..=64"),
        (&["render", "x.toml", "--sampling", "grid:9"], "isn't a number of cells each way, 1 to 8"),
        (&["render", "x.toml", "--sampling", "sparse:5"], "isn't a block's side, 2, 4, 8 or 16"),
        (&["render", "x.toml", "--sampling", "adaptive:9"], "isn't a number of halvings, 1 to 3"),
        (&["render", "x.toml", "--sampling", "adaptive:2:256"], "isn't a threshold on 8-bit sRGB"),
        (&["render", "x.toml", "--sampling", "some"], "it is center, corners, grid:N"),
        (&["render", "x.toml", "--deadline", "soon"], "invalid digit"),
        (&["render", "x.toml", "--deadline", "9", "--show", "rays"], "cannot be used with"),
        (&["render", "x.toml", "--arith", "f16"], "possible values: fixed, f32, f64"),
        (&["paint"], "unrecognized subcommand"),
    ] {
        let output = whitted(place.path(), arguments);
        assert!(errors(&output).contains(says), "{says}: {}", errors(&output));
        assert_eq!(output.status.code(), Some(2));
    }
}

#[test]
fn an_output_that_cannot_be_written() {
    let place = tempfile::tempdir().unwrap();
    let scene = scene("limit");
    std::fs::create_dir(place.path().join("folder.png")).unwrap();
    std::fs::create_dir(place.path().join("folder.bin")).unwrap();
    for (command, out, says) in [
        (
            "render",
            "nowhere/x.png",
            "nowhere/x.png: can't be written: there is no directory nowhere\n",
        ),
        (
            "render",
            "folder.png",
            "folder.png: can't be written: it is a directory; give a file's name\n",
        ),
        (
            "bake",
            "nowhere/x.bin",
            "nowhere/x.bin: can't be written: there is no directory nowhere\n",
        ),
        (
            "bake",
            "folder.bin",
            "folder.bin: can't be written: it is a directory; give a file's name\n",
        ),
    ] {
        let output = whitted(place.path(), &[command, &scene, "--size", "8x8", "-o", out]);
        assert_eq!(errors(&output), format!("whitted: {says}"));
        assert_eq!(output.status.code(), Some(2));
    }
    let arguments = ["render", &scene, "--size", "8x8", "--stats", "nowhere/x.json"];
    let output = whitted(place.path(), &arguments);
    assert!(errors(&output).contains("x.json: can't be written: there is no directory nowhere"));
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(files(place.path()), ["folder.bin", "folder.png"]);
}

#[cfg(all(unix, not(target_os = "macos")))]
#[test]
fn a_window_without_a_display_is_refused_clearly() {
    let place = tempfile::tempdir().unwrap();
    let view = |display: Option<&str>| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_whitted"));
        command.current_dir(place.path()).args(["view", &scene("limit")]);
        command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
        command.envs(display.map(|name| ("DISPLAY", name)));
        let output = command.output().unwrap();
        assert_eq!(output.status.code(), Some(2));
        assert_eq!(said(&output), "");
        errors(&output)
    };
    assert_eq!(
        view(None),
        "whitted: there is no display to open a window on (neither DISPLAY nor WAYLAND_DISPLAY is \
         set); `whitted render` saves a picture instead\n"
    );
    // One that is named but isn't there.
    let error = view(Some(":987"));
    assert!(error.starts_with("whitted: there is no display to open a window on ("), "{error}");
    assert_eq!(files(place.path()), [""; 0]);
}

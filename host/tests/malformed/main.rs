//! Scenes that are wrong: each a clear error with file and line, exit code 2, no output.

#[path = "../common/mod.rs"]
mod common;
mod nff;
mod obj;
mod toml;

use std::fmt::Write as _;

use common::{errors, files, whitted};

/// Every case as a file: its name, its bytes, what the error says.
fn cases() -> Vec<(&'static str, Vec<u8>, &'static str)> {
    let after = |start: &str, rest: &str| format!("{start}{rest}\n").into_bytes();
    let mut all = Vec::new();
    all.extend(nff::LINES.iter().map(|(text, says)| ("bad.nff", after(nff::VIEW, text), *says)));
    all.extend(nff::FILES.iter().map(|(bytes, says)| ("bad.nff", bytes.to_vec(), *says)));
    let three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    all.extend(obj::LINES.iter().map(|(text, says)| ("bad.obj", after(three, text), *says)));
    all.extend(toml::LINES.iter().map(|(text, says)| ("bad.toml", after(toml::GOOD, text), *says)));
    all.extend(toml::FILES.iter().map(|(bytes, says)| ("bad.toml", bytes.to_vec(), *says)));
    all
}

#[test]
fn each_is_a_clear_error_and_leaves_no_file() {
    let cases = cases();
    assert!(cases.len() >= 40);
    let mut wrong = String::new();
    for (name, bytes, says) in cases {
        let place = tempfile::tempdir().unwrap();
        std::fs::write(place.path().join(name), &bytes).unwrap();
        let output = whitted(place.path(), &["render", name, "--size", "8x8", "-o", "out.png"]);
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let error = errors(&output);
        let wanted = format!("{name}{says}");
        if !error.contains(&wanted) {
            let _ = write!(wrong, "{text}\nsays: {error}not: {wanted}\n\n");
        }
        assert_eq!(
            error.trim_end().lines().last().map(|l| l.contains(name)),
            Some(true),
            "{error}"
        );
        assert_eq!(output.status.code(), Some(2), "{text}");
        assert!(output.stdout.is_empty());
        assert_eq!(files(place.path()), [name]);
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn the_good_parts_are_good() {
    let place = tempfile::tempdir().unwrap();
    std::fs::write(place.path().join("good.toml"), toml::GOOD).unwrap();
    std::fs::write(place.path().join("good.nff"), format!("{}s 0 0 0 1\n", nff::VIEW)).unwrap();
    for scene in ["good.toml", "good.nff"] {
        let output = whitted(place.path(), &["check", scene]);
        assert_eq!(errors(&output), "");
        assert_eq!(output.status.code(), Some(0));
    }
}

#[test]
fn what_is_no_scene_file() {
    let place = tempfile::tempdir().unwrap();
    std::fs::create_dir(place.path().join("folder.toml")).unwrap();
    std::fs::write(place.path().join("scene.stl"), "solid").unwrap();
    std::fs::write(place.path().join("scene"), "solid").unwrap();
    for (scene, says) in [
        ("nowhere.toml", "nowhere.toml: can't be read: No such file"),
        ("folder.toml", "folder.toml: is a directory; a scene is a file"),
        ("scene.stl", "scene.stl: unknown format \"stl\"; known: .toml, .nff, .obj, .gltf"),
        ("scene", "scene: unknown format \"\"; known: .toml, .nff, .obj, .gltf"),
    ] {
        let output = whitted(place.path(), &["render", scene]);
        assert!(errors(&output).contains(says), "{}", errors(&output));
        assert_eq!(output.status.code(), Some(2));
    }
    assert_eq!(files(place.path()), ["folder.toml", "scene", "scene.stl"]);
}

#[cfg(unix)]
#[test]
fn a_file_that_may_not_be_read() {
    use std::os::unix::fs::PermissionsExt;
    let place = tempfile::tempdir().unwrap();
    let file = place.path().join("secret.toml");
    std::fs::write(&file, toml::GOOD).unwrap();
    std::fs::set_permissions(&file, std::fs::Permissions::from_mode(0o000)).unwrap();
    if std::fs::read(&file).is_ok() {
        eprintln!("skipped: this user may read everything");
        return;
    }
    let output = whitted(place.path(), &["render", "secret.toml"]);
    assert!(errors(&output).contains("secret.toml: can't be read: Permission denied"));
    assert_eq!(output.status.code(), Some(2));
}

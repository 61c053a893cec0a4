//! `whitted bake`: blobs of scenes of thousands, and what the command says.

mod common;

use std::fs;
use std::path::Path;

use common::{errors, files, said, spd, whitted};
use whitted::blob::{Blob, Room};
use whitted::frame::{Output, Renderer, Rgb888, Settings};
use whitted::gather::Record;
use whitted::math::Fixed;
use whitted::scene::{
    Absorption, Area, AreaLight, AreaLightSpec, Camera, FanCorner, Group, Instance, Light,
    Material, MaterialSpec, Pattern, Scene, Texture, TextureSpec,
};
use whitted::shape::{Operand, Solid};
use whitted::tally::Counts;
use whitted::trace::Work;
use whitted_host::bake::{Baked, Glow, Thrift};
use whitted_host::document::{Indirect, Size};
use whitted_host::indirect::Pools;
use whitted_host::read;

const SIZE: Size = Size { width: 48, height: 48 };

fn render(scene: &Scene<'_, Fixed>, camera: &Camera<Fixed>) -> Vec<Rgb888> {
    let settings = Settings { depth: 5, ..Settings::new(SIZE.width as u16, SIZE.height as u16) };
    let mut work = Work::<Fixed, 5>::new();
    let mut renderer = Renderer::new(scene, camera, settings, &mut work, &mut []).unwrap();
    let mut picture = Vec::new();
    for y in 0..SIZE.height as u16 {
        let mut line = [Rgb888::default(); SIZE.width as usize];
        renderer.line(y, &Output::SRGB, &mut line);
        picture.extend(line);
    }
    picture
}

/// Bakes a file, reads the blob back, and compares; gives the bytes and the number of shapes.
fn baked(file: &Path) -> (usize, usize) {
    let document = read::read(file).unwrap_or_else(|error| panic!("{error}"));
    let baked = Baked::<Fixed>::with(&document, Thrift::Flash).unwrap();
    let bytes = baked.blob(SIZE).unwrap().bytes;
    let mut aligned = vec![0u64; bytes.len() / 8];
    bytemuck::cast_slice_mut(&mut aligned).copy_from_slice(&bytes);
    let blob = Blob::<Fixed>::open(bytemuck::cast_slice(&aligned)).unwrap();
    let mut materials = vec![Material::<Fixed>::new(MaterialSpec::BLACK); 1024];
    let mut lights = [Light::<Fixed>::point([0.0; 3], [0.0; 3]); 8];
    let none = AreaLightSpec {
        area: Area::Sphere { center: [0.0; 3], radius: 1.0 },
        radiance: [1.0; 3],
        error: AreaLightSpec::ERROR,
        samples: AreaLightSpec::SAMPLES,
        body: None,
    };
    let room = Room {
        materials: &mut materials,
        lights: &mut lights,
        area_lights: &mut [AreaLight::<Fixed>::new(none); 8],
        fans: &mut [FanCorner::NONE; 16],
        textures: &mut [Texture::<Fixed>::new(TextureSpec::of(Pattern::Checker)); 64],
        absorptions: &mut [Absorption::<Fixed>::new([0.0; 3], [0.0; 3]); 8],
        solids: &mut [Solid::NONE; 16],
        operands: &mut [Operand::NONE; 64],
        groups: &mut [Group::<Fixed>::NONE; 8],
        instances: &mut [Instance::<Fixed>::NONE; 32],
    };
    let scene = blob.scene_in(room).unwrap();
    let camera = blob.camera().unwrap();
    // The picture doesn't depend on the tree.
    let host = Baked::<Fixed>::new(&document).unwrap();
    let camera_there = host.camera(SIZE).unwrap();
    let indirect = document.indirect;
    let wanted = host.with_scene(|scene| {
        let (mut pools, mut counts) = (Pools::default(), Counts::default());
        let lit = pools.light(&host, scene, &camera_there, SIZE, indirect, &mut counts).unwrap();
        render(&lit, &camera_there)
    });
    let wanted = wanted.unwrap();
    assert!(render(&scene, &camera) == wanted);
    (bytes.len(), document.shapes.len())
}

#[test]
fn scenes_of_thousands_fit_and_look_as_before() {
    let Some(spd) = spd() else { return };
    for (name, most) in [("balls", 40.0), ("rings", 70.0), ("mount", 90.0), ("teapot_s12", 110.0)] {
        let (bytes, shapes) = baked(&spd.join(name).with_extension("nff"));
        let each = bytes as f64 / shapes as f64;
        eprintln!("{name}: {bytes} bytes, {shapes} shapes, {each:.1} each");
        assert!(each <= most, "{name}: {each}");
        assert!(name != "balls" || bytes < 300_000);
    }
}

#[test]
fn blobs_hold_whatever_a_scene_may_have() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for file in [
        "scenes/textures.toml",
        "../boards/baked/lights.toml",
        "scenes/box.toml",
        "../boards/baked/surfaces.toml",
    ] {
        baked(&root.join(file));
    }
}

const SCENE: &str = "[render]\nsize = [40, 30]\n[camera]\neye = [0, 1, -5]\nlook_at = [0, 0, 0]\n\
                     [[light]]\nposition = [0, 5, -5]\nintensity = 9\n\
                     [[material]]\nname = \"red\"\n\
                     [[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nrepeat = { count = 12, step = [2, 0, 0] }\n";

#[test]
fn the_command_writes_either_form_and_says_its_size() {
    let place = tempfile::tempdir().unwrap();
    fs::write(place.path().join("row.toml"), SCENE).unwrap();
    let output = whitted(place.path(), &["bake", "row.toml"]);
    assert_eq!(errors(&output), "");
    let blob = fs::read(place.path().join("row.bin")).unwrap();
    assert!(said(&output).contains("288 bytes  12 spheres\n"), "{}", said(&output));
    assert!(said(&output).contains(&format!("{} bytes in all", blob.len())));
    let placed = "scaled by 2^3 around 11 0 0, for the range of fixed\nrow.bin\n";
    assert!(said(&output).ends_with(placed), "{}", said(&output));
    let output = whitted(place.path(), &["bake", "row.toml", "--arith", "f32", "-o", "row.rs"]);
    assert_eq!(errors(&output), "");
    let source = fs::read_to_string(place.path().join("row.rs")).unwrap();
    let version = env!("CARGO_PKG_VERSION");
    assert!(source.starts_with(&format!("// row.toml, baked for f32 by whitted {version}.")));
    assert!(source.contains("static SPHERES: [whitted::shape::Sphere<A>; 12] = ["));
    assert!(source.contains("pub const SIZE: (u16, u16) = (40, 30);"));
}

const LIGHTS: &str = "
[[light]]
type = 'disc'
center = [0, 5, 0]
normal = [0, -1, 0]
radius = 1
radiance = 3
";

#[test]
fn what_few_scenes_have_is_baked_to_both_forms() {
    let place = tempfile::tempdir().unwrap();
    let indirect = "\n[indirect]\ntype = 'virtual-lights'\n";
    let solid = "\n[[solid]]\nunion = [{ sphere = { center = [0, 3, 0], radius = 1 } }, \
                 { sphere = { center = [0, 4, 0], radius = 1 } }]\n";
    for (name, more) in [("area.toml", LIGHTS), ("indirect.toml", indirect), ("solid.toml", solid)]
    {
        fs::write(place.path().join(name), format!("{SCENE}{more}")).unwrap();
    }
    for (arguments, says) in [
        (["bake", "indirect.toml", "-o", "indirect.bin"], "7168 bytes  256 virtual lights\n"),
        (["bake", "solid.toml", "-o", "solid.bin"], "materials, lights, setting, groups, solids\n"),
    ] {
        let output = whitted(place.path(), &arguments);
        assert_eq!(errors(&output), "");
        assert!(said(&output).contains(says), "{}", said(&output));
    }
    let output = whitted(place.path(), &["bake", "area.toml", "-q", "-o", "area.rs"]);
    assert_eq!(errors(&output), "");
    let source = fs::read_to_string(place.path().join("area.rs")).unwrap();
    assert!(source.contains("static AREA_LIGHTS: [whitted::scene::AreaLight<A>; 1] = ["));
    let output = whitted(place.path(), &["bake", "indirect.toml", "-o", "indirect.rs"]);
    assert_eq!(errors(&output), "");
    assert!(said(&output).contains("7168 bytes  256 virtual lights\n"), "{}", said(&output));
    let source = fs::read_to_string(place.path().join("indirect.rs")).unwrap();
    assert!(source.contains("static VIRTUAL_LIGHTS: [whitted::gather::VirtualLight<A>; 256] = ["));
    assert!(source.contains("    indirect: INDIRECT,\n"));
    assert_eq!(
        files(place.path()),
        [
            "area.rs",
            "area.toml",
            "indirect.bin",
            "indirect.rs",
            "indirect.toml",
            "solid.bin",
            "solid.toml"
        ]
    );
}

#[test]
fn what_cannot_be_baked_leaves_no_file() {
    let place = tempfile::tempdir().unwrap();
    fs::write(place.path().join("row.toml"), SCENE).unwrap();
    fs::write(place.path().join("bad.toml"), format!("{SCENE}radius = 2\n")).unwrap();
    for (arguments, says) in [
        (vec!["bake", "row.toml", "-o", "row.elf"], "row.elf: its name must end in .bin or .rs"),
        (vec!["bake", "bad.toml"], "bad.toml:15: duplicate key"),
        (vec!["bake", "none.toml"], "none.toml: can't be read"),
    ] {
        let output = whitted(place.path(), &arguments);
        assert!(errors(&output).contains(says), "{}", errors(&output));
        assert_eq!(output.status.code(), Some(2));
    }
    assert_eq!(files(place.path()), ["bad.toml", "row.toml"]);
}

/// What source is made of makes the gatherer's records again, to the bit.
#[test]
fn irradiance_records_come_back() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut document = read::read(&scenes.join("bathroom-indirect.toml")).unwrap();
    let Some(Indirect::Cache(cache)) = &mut document.indirect else { panic!("no cache") };
    cache.bounces = 1;
    let baked = Baked::<Fixed>::with(&document, Thrift::Flash).unwrap();
    let glow = baked.glow(Size { width: 40, height: 30 }).unwrap();
    let Glow::Cache { records, error } = glow else { panic!("no cache") };
    assert_eq!(error, 0.5);
    assert!(records.len() > 162, "{}", records.len());
    for spec in records {
        let again = Record::<Fixed>::try_new(&spec).map(|record| record.spec());
        assert_eq!(again, Ok(spec));
    }
}

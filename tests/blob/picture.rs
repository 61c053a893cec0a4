//! Writing blobs, and what they show.

use super::super::aligned::Aligned;
use super::super::specs::{AREA_LIGHTS, SETTING};
use super::A;
use whitted::blob::{Blob, BlobError, CameraSpec, Content, Room, seal};
use whitted::frame::{Output, Renderer, Rgb888, Settings};
use whitted::scene::{
    Absorption, Ambient, AreaLight, Background, Camera, FanCorner, Group, Instance, Light,
    Material, MaterialSpec, Parts, Pattern, Rules, Scene, Texture, TextureSpec,
};
use whitted::shape::{Operand, Solid};
use whitted::trace::Work;

pub(super) fn written(content: &Content<'_, A>) -> Aligned {
    let mut bytes = Vec::new();
    content.write(&mut |part| bytes.extend_from_slice(part));
    seal(&mut bytes);
    Aligned::of(&bytes)
}

/// A scene of nothing, with [`SETTING`]'s light and rules.
pub(super) fn setting() -> Parts<'static, A> {
    Parts {
        light_jitter: SETTING.light_jitter,
        ambient: Ambient::<A>::new(SETTING.ambient),
        background: Background::<A>::gradient([0.0, 1.0, 0.0], [0.5; 3], [0.1, 0.2, 0.6]),
        rules: Rules { specular_cosine: false, transmitters_reflect: true, ..Rules::COURSE },
        ..Parts::EMPTY
    }
}

/// Whether a blob shows what the scene of these parts shows, from [`SETTING`]'s camera.
pub(super) fn assert_shows(blob: &Aligned, parts: Parts<'_, A>) {
    let scene = Scene::<A>::new(parts).unwrap();
    let CameraSpec { eye, at, up, tangent } = SETTING.camera;
    let camera = Camera::<A>::try_look_at(eye, at, up, tangent).unwrap();
    assert_eq!(shown(blob.bytes(), 48), Ok(render(&scene, &camera, 48)));
}

/// Reads a scene of a type with memory for materials and lights alone.
pub(super) fn read_plainly<const USES: u64>(content: &Content<'_, A>) -> Result<(), BlobError> {
    let blob = written(content);
    let mut materials = [Material::<A>::new(MaterialSpec::BLACK); 4];
    let mut lights = [Light::<A>::point([0.0; 3], [0.0; 3]); 4];
    Blob::<A>::open(blob.bytes())?.scene::<USES>(&mut materials, &mut lights).map(drop)
}

fn render(scene: &Scene<'_, A>, camera: &Camera<A>, side: u16) -> Vec<Rgb888> {
    let settings = Settings { depth: SETTING.depth, ..Settings::new(side, side) };
    let mut work = Work::<A, 8>::new();
    let mut samples = [];
    let mut renderer = Renderer::new(scene, camera, settings, &mut work, &mut samples).unwrap();
    let mut picture = Vec::new();
    for y in 0..side {
        let mut line = vec![Rgb888::default(); side.into()];
        renderer.line(y, &Output::SRGB, &mut line);
        picture.extend(line);
    }
    picture
}

/// Opens a blob and renders what is in it.
pub(super) fn shown(bytes: &[u8], side: u16) -> Result<Vec<Rgb888>, BlobError> {
    let blob = Blob::<A>::open(bytes)?;
    let mut materials = [Material::<A>::new(MaterialSpec::BLACK); 4];
    let mut lights = [Light::<A>::point([0.0; 3], [0.0; 3]); 4];
    let camera = blob.camera()?;
    let light = AreaLight::<A>::new(AREA_LIGHTS[1]);
    let texture = Texture::<A>::new(TextureSpec::of(Pattern::Checker));
    let room = Room {
        materials: &mut materials,
        lights: &mut lights,
        area_lights: &mut [light; 2],
        fans: &mut [FanCorner::NONE; 3],
        textures: &mut [texture; 3],
        absorptions: &mut [Absorption::<A>::new([0.0; 3], [0.0; 3])],
        solids: &mut [Solid::NONE; 2],
        operands: &mut [Operand::NONE; 7],
        groups: &mut [Group::<A>::NONE; 2],
        instances: &mut [Instance::<A>::NONE; 3],
    };
    Ok(render(&blob.scene_in(room)?, &camera, side))
}

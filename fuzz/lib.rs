//! What the targets share.

use whitted::blob::{Blob, Room, seal};
use whitted::frame::{Output, Renderer, Rgb888, Sample, Settings};
use whitted::math::Fixed;
use whitted::scene::{
    Absorption, Area, AreaLight, AreaLightSpec, Camera, FanCorner, Group, Instance, Light,
    Material, MaterialSpec, Pattern, Scene, Texture, TextureSpec,
};
use whitted::shape::{Operand, Solid};
use whitted::trace::Work;
use whitted_host::bake::{Baked, Construct};
use whitted_host::document::Size;
use whitted_host::read::{Format, parse};

/// Shapes beyond which baking takes longer than a fuzzer likes to wait.
const MOST_SHAPES: usize = 200;

/// Reads a text; if that works, bakes it and traces a few pixels. The only wrong answers are a panic
/// and a hang.
pub fn survives(format: Format, bytes: &[u8]) {
    let Ok(document) = parse(format, bytes) else { return };
    if document.shapes.len() > MOST_SHAPES {
        return;
    }
    if let Ok(baked) = Baked::<f64>::new(&document) {
        look(&baked);
    }
    if let Ok(baked) = Baked::<Fixed>::new(&document) {
        look(&baked);
    }
}

/// Opens bytes as a blob, the checksum made right, and traces a few pixels of what is in it. Says
/// whether it came to that.
pub fn survives_blob(bytes: &[u8]) -> bool {
    let mut words = vec![0u64; bytes.len().div_ceil(8)];
    let Some(aligned) = bytemuck::cast_slice_mut::<u64, u8>(&mut words).get_mut(..bytes.len())
    else {
        return false;
    };
    aligned.copy_from_slice(bytes);
    // The length is a count like others, so the sum is over what it says.
    let length = bytes.get(12..16).and_then(|b| b.try_into().ok()).map_or(0, u32::from_le_bytes);
    if let Some(blob) = aligned.get_mut(..length as usize) {
        seal(blob);
    }
    look_into_fixed(aligned) || look_into_f32(aligned) || look_into_f64(aligned)
}

macro_rules! look_into {
    ($($name:ident: $a:ty),*) => {
        $(
            fn $name(bytes: &[u8]) -> bool {
                let Ok(blob) = Blob::<$a>::open(bytes) else { return false };
                let mut materials = [Material::<$a>::new(MaterialSpec::BLACK); 16];
                let mut lights = [Light::<$a>::point([0.0; 3], [0.0; 3]); 8];
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
                    area_lights: &mut [AreaLight::<$a>::new(none); 4],
                    fans: &mut [FanCorner::NONE; 32],
                    textures: &mut [Texture::<$a>::new(TextureSpec::of(Pattern::Checker)); 16],
                    absorptions: &mut [Absorption::<$a>::new([0.0; 3], [0.0; 3]); 4],
                    solids: &mut [Solid::NONE; 16],
                    operands: &mut [Operand::NONE; 64],
                    groups: &mut [Group::<$a>::NONE; 8],
                    instances: &mut [Instance::<$a>::NONE; 16],
                };
                let Ok(scene) = blob.scene_in(room) else { return false };
                let Ok(camera) = blob.camera() else { return false };
                trace::<$a>(&scene, &camera);
                true
            }
        )*
    };
}

look_into!(look_into_fixed: Fixed, look_into_f32: f32, look_into_f64: f64);

/// The side of a picture of a few pixels.
const SIDE: u16 = 4;

/// Traces such a picture of what a document became.
fn look<A: Construct>(baked: &Baked<A>) {
    let size = Size { width: SIDE.into(), height: SIDE.into() };
    let Ok(camera) = baked.camera(size) else { return };
    let _ = baked.with_scene(|scene| trace(scene, &camera));
}

fn trace<A: Construct>(scene: &Scene<'_, A>, camera: &Camera<A>) {
    let mut work = Work::<A, 4>::new();
    let mut samples = [Sample::NONE; 0];
    let settings = Settings { depth: 4, ..Settings::new(SIDE, SIDE) };
    let Ok(mut renderer) = Renderer::new(scene, camera, settings, &mut work, &mut samples) else {
        return;
    };
    let mut line = [Rgb888::default(); SIDE as usize];
    for y in 0..SIDE {
        renderer.line(y, &Output::SRGB, &mut line);
    }
}

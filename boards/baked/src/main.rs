//! Reads a blob where it lies in flash, checks it, renders it, and compares the picture with the
//! one that the build script made on the host.
#![no_std]
#![no_main]

use semihosting::println;
use whitted::blob::{Blob, BlobError, Room};
use whitted::frame::{Output, Renderer, Rgb888, Settings};
use whitted::math::Fixed;
use whitted::scene::{
    Absorption, Area, AreaLight, AreaLightSpec, FanCorner, Group, Instance, Light, Material,
    MaterialSpec, Pattern, Scene, Texture, TextureSpec,
};
use whitted::shape::{Operand, Solid};
use whitted::trace::Work;
use whitted_demo::board::{self, Board};
use whitted_demo::checksum::Checksum;
use whitted_demo::stack;

/// What the build script baked.
static BLOB: &[u8] = whitted::include_blob!(env!("BLOB"));
/// The checksum of the host's picture.
const WANTED: &str = env!("WANTED");
/// The rays of that picture, of all kinds.
const RAYS: &str = env!("RAYS");

/// The machine's clock.
const CLOCK_KHZ: u32 = 25_000;

const WIDTH: u16 = 96;
const HEIGHT: u16 = 64;
/// Room in RAM: shapes and tree stay in flash.
const MATERIALS: usize = 64;
const LIGHTS: usize = 8;
/// What a place for an area light holds until there is one.
const LAMP: AreaLightSpec<'_> = AreaLightSpec {
    area: Area::Sphere { center: [0.0; 3], radius: 1.0 },
    radiance: [0.0; 3],
    error: AreaLightSpec::ERROR,
    samples: AreaLightSpec::SAMPLES,
    body: None,
};
/// The same for a texture.
const PATTERN: TextureSpec<'_> = TextureSpec::of(Pattern::Checker);

/// Never inlined: what its caller measures of the stack begins with its frame.
#[inline(never)]
fn draw(board: &mut Board) -> Result<u64, BlobError> {
    let blob = Blob::<Fixed>::open(BLOB)?;
    let mut materials = [Material::<Fixed>::new(MaterialSpec::BLACK); MATERIALS];
    let mut lights = [Light::<Fixed>::point([0.0; 3], [0.0; 3]); LIGHTS];
    let mut area_lights = [AreaLight::<Fixed>::new(LAMP); 4];
    let mut fans = [FanCorner::NONE; 16];
    let mut textures = [Texture::<Fixed>::new(PATTERN); 16];
    let mut absorptions = [Absorption::<Fixed>::new([0.0; 3], [0.0; 3]); 4];
    let (mut solids, mut operands) = ([Solid::NONE; 8], [Operand::NONE; 32]);
    let mut groups = [Group::<Fixed>::NONE; 4];
    let mut instances = [Instance::<Fixed>::NONE; 16];
    let scene: Scene<'_, Fixed> = blob.scene_in(Room {
        materials: &mut materials,
        lights: &mut lights,
        area_lights: &mut area_lights,
        fans: &mut fans,
        textures: &mut textures,
        absorptions: &mut absorptions,
        solids: &mut solids,
        operands: &mut operands,
        groups: &mut groups,
        instances: &mut instances,
    })?;
    let camera = blob.camera()?;
    let mut work = Work::<Fixed, 8>::new();
    let settings = Settings { depth: blob.depth().min(8), ..Settings::new(WIDTH, HEIGHT) };
    let mut sum = Checksum::EMPTY;
    match Renderer::new(&scene, &camera, settings, &mut work, &mut []) {
        Ok(mut renderer) => {
            let mut line = [Rgb888::default(); WIDTH as usize];
            for y in 0..HEIGHT {
                board.counted(|| renderer.line(y, &Output::SRGB, &mut line));
                sum.add(line.iter().flat_map(|pixel| pixel.0));
            }
        }
        Err(error) => println!("error {error}"),
    }
    Ok(sum.value())
}

#[cortex_m_rt::entry]
fn main() -> ! {
    let mut board = Board::new("baked", CLOCK_KHZ);
    let top = stack::paint();
    let drawn = draw(&mut board);
    let (stack, statics) = (stack::used(top), stack::static_bytes());
    match drawn {
        Ok(sum) => {
            let same = WANTED.parse() == Ok(sum);
            let bytes = BLOB.len();
            let instructions = board.instructions();
            println!(
                "result board=baked blob={bytes} checksum={sum:016x} same-as-host={same} \
                 instructions={instructions} rays={RAYS} stack={stack} static={statics}"
            );
            board::exit(same)
        }
        Err(error) => {
            println!("error {error}");
            board::exit(false)
        }
    }
}

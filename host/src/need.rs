//! What a scene needs of a chip: flash, memory and, roughly, time.

use whitted::frame::{Output, Renderer, Rgb888};
use whitted::math::{Arithmetic, Rgb};
use whitted::scene::{Group, Parts, Pattern, Texels};
use whitted::shape::Ray;
use whitted::tally::{Counts, RayKind, Tally};
use whitted::trace::{Terms, Work};

use crate::bake::{Baked, Construct};
use crate::document::{Indirect, Size};
use crate::error::{Flaw, Problem};
use crate::render::{MAX_DEPTH, Sampling, Settings, render};

/// The picture whose rays are counted to tell those of larger ones.
const TRIAL: u32 = 64;

/// Bytes of flash that a scene's parts take, each kind by its name; those that there are none of
/// are left out.
pub fn flash<A: Construct>(baked: &Baked<A>) -> Result<Vec<(&'static str, usize)>, Flaw> {
    let mut sizes = baked.with_scene(|scene| {
        let parts = scene.parts();
        macro_rules! sizes {
            ($of:expr, $($kind:ident $name:literal),*) => {
                [$(($name, size_of_val($of.$kind))),*]
            };
        }
        macro_rules! shapes {
            ($of:expr) => {
                sizes!(
                    $of,
                    spheres "spheres", triangles "triangles", smooth_triangles "smooth triangles",
                    polygons "polygons", edges "their edges", cuboids "boxes", discs "discs",
                    cylinders "cylinders", cones "cones", solids "solids", operands "their parts",
                    uvs "texture coordinates"
                )
            };
        }
        let mut sizes = shapes!(parts).to_vec();
        sizes.extend(sizes!(
            parts,
            planes "planes", instances "instances", materials "materials", textures "textures",
            absorptions "media", lights "lights", area_lights "area lights",
            light_corners "their corners"
        ));
        sizes.push(("pictures", pictures(baked)));
        // A group once, however often it is placed.
        let mut groups: Vec<&Group<'_, A>> = Vec::new();
        for instance in parts.instances {
            if !groups.iter().any(|known| std::ptr::eq(*known, instance.group())) {
                groups.push(instance.group());
            }
        }
        let shapes = groups.iter().flat_map(|group| shapes!(group.shapes())).map(|of| of.1);
        sizes.push(("groups", size_of::<Group<'_, A>>() * groups.len() + shapes.sum::<usize>()));
        sizes.push(("their octrees", baked.group_tree_words() * size_of::<u32>()));
        sizes
    })?;
    sizes.push(("octree", baked.tree().map_or(0, |(words, _)| words * size_of::<u32>())));
    sizes.push(("the rest", size_of::<Parts<'_, A>>()));
    sizes.retain(|&(_, bytes)| bytes > 0);
    Ok(sizes)
}

/// Bytes of the pictures that textures show, with their palettes: one that several show counts once.
fn pictures<A: Construct>(baked: &Baked<A>) -> usize {
    let materials = baked.document().materials.iter();
    let textures = materials.flat_map(|m| [&m.texture, &m.bump]).flatten();
    let mut known: Vec<(&[u8], &[[u8; 3]])> = Vec::new();
    for texture in textures {
        let Pattern::Image(image) = texture.spec.pattern else { continue };
        let palette = match image.texels() {
            Texels::Indexed { palette, .. } => palette,
            Texels::Rgb565 => &[],
        };
        if !known.iter().any(|(bytes, _)| std::ptr::eq(*bytes, image.bytes())) {
            known.push((image.bytes(), palette));
        }
    }
    known.iter().map(|(bytes, palette)| bytes.len() + size_of_val(*palette)).sum()
}

/// Bytes of memory that a tracer works in, for trees of rays of this depth.
pub fn memory<A: Construct>(depth: u8) -> usize {
    let one = size_of::<Work<A, 1>>();
    one + usize::from(depth.max(1) - 1) * (size_of::<Work<A, 2>>() - one)
}

/// What a pixel takes, on average.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pixel {
    /// Rays, but for those to lights.
    pub rays: f64,
    /// Rays to lights.
    pub shadow: f64,
    /// Nodes of the octree visited.
    pub nodes: f64,
    /// Shapes tested.
    pub tests: f64,
    /// Surfaces for which the irradiance cache is asked, at most.
    pub lookups: f64,
    /// How deep trees of rays get in the small picture; the camera's ray has depth 1.
    pub deepest: u8,
}

/// The depth of the deepest tree of rays.
struct Deepest(u8);

impl Tally for Deepest {
    fn ray<A: Arithmetic>(&mut self, kind: RayKind, depth: u8, _: &Ray<A>, _: &Rgb<A::Weight>) {
        if matches!(kind, RayKind::Primary | RayKind::Reflection | RayKind::Transmission) {
            self.0 = self.0.max(depth);
        }
    }
}

fn deepest<A: Construct>(baked: &Baked<A>, settings: &Settings) -> Result<u8, Flaw> {
    let camera = baked.camera(settings.size)?;
    let core = settings.for_core(Terms::ALL);
    let deepest = baked.with_scene(|scene| {
        let mut work = Work::<A, MAX_DEPTH>::new();
        let tally = Deepest(1);
        Renderer::with_tally(scene, &camera, core, &mut work, &mut [], tally).map(|mut renderer| {
            let mut line = vec![Rgb888::default(); usize::from(core.width)];
            for y in 0..core.height {
                renderer.line(y, &Output::SRGB, &mut line);
            }
            renderer.tally().0
        })
    })?;
    deepest.map_err(|error| Problem::Settings(error.to_string()).anywhere())
}

/// Counts on a small picture, one ray a pixel, what a pixel takes.
///
/// # Errors
/// Those of [`render`].
pub fn pixel<A: Construct>(baked: &Baked<A>, size: Size, depth: u8) -> Result<Pixel, Flaw> {
    let longer = f64::from(size.width.max(size.height));
    let side = |side: u32| ((f64::from(side) * f64::from(TRIAL) / longer) as u32).max(1);
    // A cache takes its time to fill, and no rays afterwards.
    let indirect = baked.document().indirect;
    let virtual_lights = indirect.filter(|it| matches!(it, Indirect::VirtualLights(_)));
    let settings = Settings {
        indirect: virtual_lights,
        size: Size { width: side(size.width), height: side(size.height) },
        depth,
        sampling: Sampling::Center,
        show: None,
        threads: std::num::NonZeroUsize::MIN,
    };
    let counts = render(baked, &settings, |_| {})?.counts;
    let Counts { primary, shadow, nodes, tests, .. } = counts;
    let a_pixel = |n: u64| n as f64 / primary.max(1) as f64;
    Ok(Pixel {
        rays: a_pixel(counts.rays() - shadow),
        shadow: a_pixel(shadow),
        nodes: a_pixel(nodes),
        tests: a_pixel(tests),
        lookups: match indirect {
            Some(Indirect::Cache(_)) => a_pixel(counts.rays() - shadow),
            _ => 0.0,
        },
        deepest: deepest(baked, &settings)?,
    })
}

/// What a core spends, in clock cycles: fitted to the counts in `bench/table.md`.
#[derive(Clone, Copy, Debug)]
pub struct Core {
    /// For each pixel.
    pub pixel: f64,
    /// For each ray, shadow rays among them, besides its tests and nodes.
    pub ray: f64,
    /// For each shape tested.
    pub test: f64,
    /// For each node of the octree visited.
    pub node: f64,
    /// For a surface's irradiance out of some hundred records (`docs/interreflection.md`).
    pub lookup: f64,
}

impl Core {
    /// Cycles of a pixel.
    pub fn cycles(&self, pixel: &Pixel) -> f64 {
        self.pixel
            + self.ray * (pixel.rays + pixel.shadow)
            + self.test * pixel.tests
            + self.node * pixel.nodes
            + self.lookup * pixel.lookups
    }
}

/// A board that people have.
#[derive(Clone, Copy, Debug)]
pub struct Board {
    /// Its name.
    pub name: &'static str,
    /// The arithmetic that suits it.
    pub arithmetic: &'static str,
    /// Its clock, in megahertz.
    pub mhz: f64,
    /// How many cores trace.
    pub cores: f64,
    /// Bytes of flash.
    pub flash: usize,
    /// Bytes of memory.
    pub ram: usize,
    /// What it spends.
    pub core: Core,
}

const KIB: usize = 1024;

/// Flash that the program takes besides the scene: the tracer with everything in it, a display's
/// driver and a HAL.
pub const PROGRAM: usize = 96 * KIB;

/// Memory that isn't there for the tracer: a deep stack, a HAL's and a display's.
pub const RESERVE: usize = 6 * KIB;

// Instructions in `bench/table.md` of the scenes limit to bathroom, times cycles an instruction: 1.43 as
// counted on the emulated RP2040; 1.3 and 1.2, as assumed, on the others. No such sum comes nearer than
// a quarter: of a few spheres, cones of directions spare tests that are counted here all the same.
// Shapes other than spheres stand in trees, in which nodes therefore weigh more than they are, and a
// grid counts as one: the bathroom's pixel (60×45) is 19,572 instructions on the M0 and 9,829 on the M4F with
// 25 nodes and 31 tests; the M3's node is in proportion.
const M0_PLUS: Core = Core { pixel: 700.0, ray: 100.0, test: 122.0, node: 920.0, lookup: 9200.0 };
const M3: Core = Core { pixel: 430.0, ray: 60.0, test: 77.0, node: 550.0, lookup: 6900.0 };
const M4F: Core = Core { pixel: 200.0, ray: 20.0, test: 44.0, node: 407.0, lookup: 4400.0 };

/// The boards that the documentation names.
pub const BOARDS: [Board; 8] = [
    Board {
        name: "Raspberry Pi Pico",
        arithmetic: "fixed",
        mhz: 125.0,
        cores: 2.0,
        flash: 2048 * KIB,
        ram: 264 * KIB,
        core: M0_PLUS,
    },
    Board {
        name: "Raspberry Pi Pico 2",
        arithmetic: "f32",
        mhz: 150.0,
        cores: 1.0,
        flash: 4096 * KIB,
        ram: 520 * KIB,
        core: M4F,
    },
    Board {
        name: "STM32F411 (Black Pill)",
        arithmetic: "f32",
        mhz: 100.0,
        cores: 1.0,
        flash: 512 * KIB,
        ram: 128 * KIB,
        core: M4F,
    },
    Board {
        name: "STM32F405",
        arithmetic: "f32",
        mhz: 168.0,
        cores: 1.0,
        flash: 1024 * KIB,
        ram: 128 * KIB,
        core: M4F,
    },
    Board {
        name: "nRF52840",
        arithmetic: "f32",
        mhz: 64.0,
        cores: 1.0,
        flash: 1024 * KIB,
        ram: 256 * KIB,
        core: M4F,
    },
    Board {
        name: "BBC micro:bit 2",
        arithmetic: "f32",
        mhz: 64.0,
        cores: 1.0,
        flash: 512 * KIB,
        ram: 128 * KIB,
        core: M4F,
    },
    Board {
        name: "LM3S6965",
        arithmetic: "fixed",
        mhz: 50.0,
        cores: 1.0,
        flash: 256 * KIB,
        ram: 64 * KIB,
        core: M3,
    },
    Board {
        name: "BBC micro:bit 1",
        arithmetic: "fixed",
        mhz: 16.0,
        cores: 1.0,
        flash: 256 * KIB,
        ram: 16 * KIB,
        core: M0_PLUS,
    },
];

#[cfg(test)]
mod tests {
    use super::{M3, Pixel, flash, memory, pixel};
    use crate::bake::Baked;
    use crate::document::Size;
    use crate::read::{Format, parse};
    use whitted::math::Fixed;

    #[test]
    fn parts_are_counted() {
        let text = include_bytes!("../scenes/limit.toml");
        let baked = Baked::<Fixed>::new(&parse(Format::Toml, text).unwrap()).unwrap();
        let parts = flash(&baked).unwrap();
        let of = |name| parts.iter().find(|part| part.0 == name).map(|part| part.1);
        assert_eq!(of("spheres"), Some(3 * 24));
        assert_eq!(of("triangles"), None);
        assert_eq!(of("octree"), None);
    }

    #[test]
    fn memory_grows_by_a_ray_a_level() {
        let step = memory::<Fixed>(2) - memory::<Fixed>(1);
        assert_eq!(memory::<Fixed>(8) - memory::<Fixed>(5), 3 * step);
        // The budget is 4 KiB for five levels, without rows.
        assert!(memory::<Fixed>(5) <= 4096);
    }

    #[test]
    fn interreflection_has_its_price() {
        let text = std::str::from_utf8(include_bytes!("../scenes/showcase.toml")).unwrap();
        let size = Size { width: 64, height: 48 };
        let count = |more: &str| {
            let text = format!("{text}\n[indirect]\n{more}");
            let baked =
                Baked::<Fixed>::new(&parse(Format::Toml, text.as_bytes()).unwrap()).unwrap();
            pixel(&baked, size, 3).unwrap()
        };
        let cache = count("type = \"cache\"");
        let lights = count("type = \"virtual-lights\"\nlights = 16\ntile = 1");
        assert!(cache.lookups > 0.9 && lights.lookups == 0.0);
        assert!(lights.shadow > cache.shadow + 0.5, "{lights:?} {cache:?}");
        let (with, without) = (M3.cycles(&cache), M3.cycles(&Pixel { lookups: 0.0, ..cache }));
        assert!((with - without - M3.lookup * cache.lookups).abs() < 1e-6);
    }
}

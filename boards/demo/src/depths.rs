//! One small frame with memory for each depth from 1 to 8, to see how much stack it takes.

use whitted::frame::{Renderer, Rgb888, Settings};
use whitted::math::{Arithmetic, Fixed};
use whitted::scene::{Scene, SceneRef};
use whitted::tally::Tally;
use whitted::trace::Work;

use crate::checksum::Checksum;
use crate::job::ArithName;
use crate::scenes::{Shot, Shots, View};

/// The frame's pixels across and down.
pub const SIZE: (u16, u16) = (24, 16);
/// Bytes of its row.
pub const ROW: usize = SIZE.0 as usize * size_of::<Rgb888>();
/// The deepest.
pub const DEEPEST: usize = 8;

/// What a board without semihosting leaves in its memory about a depth: the depth itself, bytes of the
/// tracer's memory, bytes of stack, and the checksum's lower and upper half.
pub type Words = [u32; 5];

/// A depth.
#[derive(Clone, Copy)]
pub struct Depth {
    /// Generations of rays, the camera's among them.
    pub depth: usize,
    /// Bytes of the tracer's memory for so many: of `Work`.
    pub memory: usize,
    /// Draws the frame.
    pub draw: fn() -> Checksum,
}

/// All depths in an arithmetic.
#[must_use]
#[cfg_attr(target_os = "none", inline)]
pub fn all(arith: ArithName) -> [Depth; DEEPEST] {
    match arith {
        ArithName::Fixed => of::<Fixed>(),
        ArithName::F32 => of::<f32>(),
    }
}

fn of<A: Shots>() -> [Depth; DEEPEST] {
    [
        one::<A, 1>(),
        one::<A, 2>(),
        one::<A, 3>(),
        one::<A, 4>(),
        one::<A, 5>(),
        one::<A, 6>(),
        one::<A, 7>(),
        one::<A, 8>(),
    ]
}

fn one<A: Shots, const DEPTH: usize>() -> Depth {
    let draw = || frame::<A, (), DEPTH>(()).0;
    Depth { depth: DEPTH, memory: size_of::<Work<A, DEPTH>>(), draw }
}

/// Draws the frame with memory for trees `DEPTH` deep; the pixels' checksum, and what `tally` saw.
pub fn frame<A: Shots, T: Tally + Copy, const DEPTH: usize>(tally: T) -> (Checksum, T) {
    A::mirrors(Frame::<T, DEPTH>(tally))
}

struct Frame<T, const DEPTH: usize>(T);

impl<A: Arithmetic, T: Tally + Copy, const DEPTH: usize> View<A> for Frame<T, DEPTH> {
    type Output = (Checksum, T);

    #[inline(always)]
    fn view<S, const USES: u64>(self, shot: Shot<A, S>) -> (Checksum, T)
    where
        S: SceneRef<Target = Scene<'static, A, USES>>,
    {
        let mut work = Work::<A, DEPTH>::new();
        let settings = Settings { depth: DEPTH as u8, ..Settings::new(SIZE.0, SIZE.1) };
        let mut renderer =
            Renderer::with_tally(shot.scene, shot.camera, settings, &mut work, &mut [], self.0)
                .expect("a depth that there is memory for");
        let mut checksum = Checksum::EMPTY;
        let mut row = [Rgb888::default(); SIZE.0 as usize];
        for y in 0..SIZE.1 {
            renderer.line(y, &shot.output, &mut row);
            checksum.add(row.iter().flat_map(|&Rgb888(rgb)| rgb));
        }
        (checksum, *renderer.tally())
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use std::collections::BTreeSet;

    use whitted::math::{Arithmetic, Fixed, Rgb};
    use whitted::shape::Ray;
    use whitted::tally::{RayKind, Tally};

    use super::{Shots, all, frame};
    use crate::job::ArithName;

    /// The deepest ray, and how many of both kinds went so deep.
    #[derive(Clone, Copy, Default, Debug, PartialEq)]
    struct Deepest {
        depth: u8,
        reflected: u32,
        transmitted: u32,
    }

    impl Tally for Deepest {
        fn ray<A: Arithmetic>(&mut self, kind: RayKind, depth: u8, _: &Ray<A>, _: &Rgb<A::Weight>) {
            if kind == RayKind::Shadow {
                return;
            }
            if depth > self.depth {
                *self = Self { depth, ..Self::default() };
            }
            if depth == self.depth {
                self.reflected += u32::from(kind == RayKind::Reflection);
                self.transmitted += u32::from(kind == RayKind::Transmission);
            }
        }
    }

    fn reaches<A: Shots, const DEPTH: usize>() {
        let (_, seen) = frame::<A, Deepest, DEPTH>(Deepest::default());
        assert_eq!(usize::from(seen.depth), DEPTH);
        if DEPTH > 1 {
            assert!(seen.reflected > 20 && seen.transmitted > 20, "{DEPTH}: {seen:?}");
        }
    }

    #[test]
    fn the_frame_reaches_every_depth() {
        reaches::<Fixed, 1>();
        reaches::<Fixed, 2>();
        reaches::<Fixed, 5>();
        reaches::<Fixed, 8>();
        reaches::<f32, 8>();
    }

    #[test]
    fn each_depth_shows() {
        for arith in ArithName::ALL {
            let sums: BTreeSet<_> = all(arith).iter().map(|d| (d.draw)().value()).collect();
            assert!(sums.len() >= 7, "{} pictures", sums.len());
            let memory: BTreeSet<_> =
                all(arith).windows(2).map(|pair| pair[1].memory - pair[0].memory).collect();
            assert_eq!(memory.len(), 1, "each generation takes as much as the other");
        }
    }
}

//! Sparse sampling: a ray for some pixels, the others interpolated.
//!
//! After Akimoto, Mase and Suenaga ("Pixel-selected ray tracing", IEEE Computer Graphics and
//! Applications 11(4), 1991) the picture is cut into blocks of side s, with rays through the centres of
//! the pixels at their corners. Here each further ray is decided alone, by four samples around it, as
//! heights are in the diamond-square algorithm (Fournier, Fussell and Carpenter, 1982): the middle of
//! a block by its corners, then the middle of a side by the side's ends and the middles of the blocks
//! that share it. The blocks become four of half the side each, and so on down to single pixels. What
//! passes between the corners of one block rarely does so of all: the middle of a block of side s is
//! traced also if one of the four blocks beside it would be, and that of one of the smallest, side 2,
//! also if the one beside, above or below in the same block of side 4 would be and three of its corners
//! are samples. What isn't traced is the mean of what lies around it.
//!
//! All this goes by what is shown: samples are display values, after exposure and transfer curve, and
//! differ if a channel does by more than a threshold; where all four took many rays, by half as much
//! again. Integers are all that is left then, whatever the arithmetic. Another tone is another picture:
//! nothing is remembered from one to the other.
//!
//! Whether a side is traced that two rows of blocks share, the upper one says, since it is drawn first.
//! Beyond the right and the lower edge of the picture a block's corners are the last pixels' samples.
//!
//! The sampler traces nothing itself: asked for a row of pixels, it says which ray it wants
//! [next](Sparse::next), until the row's display values lie in memory. So the tracer is called from one
//! place. What is decided without knowing the outcome of each other is decided at once, and waits in a
//! chain that runs through the places where the samples will be. Each stage is a function of its own: in
//! one, none of what it works with would stay in registers.

mod grid;
mod layout;
mod pixels;
mod slot;

use super::{Sampling, Tone};
use layout::Layout;
pub(super) use slot::FEW_RAYS;
use slot::{Limits, Values, lanes, pack, unpack};

/// The end of the chain.
const END: u32 = u32::MAX;
/// Of the word that is compared: the sample waits for its ray.
const WAITS: u32 = 1 << 29;

// What is noted at a block's upper left corner, above the display value of blue.

/// The block's middle is to be traced.
const MARK: u32 = 1 << 16;
/// Rays have been sent within the block of side 4, or through the middles of its sides; of those of side 8
/// and 16 the next bits say so.
const OPEN: u32 = 1 << 17;
/// The middles of its smallest blocks are to be traced; row by row.
const WANTED: u32 = 1 << 20;

/// What comes next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    /// To ask for the corners below the next row of blocks.
    Corners,
    /// To mark the blocks between the corners.
    Marks,
    /// To ask for the middles of blocks of a side.
    Middles,
    /// For the middles of their sides.
    Sides,
    /// To lay means where there are none.
    Means,
    /// The row of blocks is ready: to ask for the smallest middles of a pair of rows, and for single
    /// pixels.
    Blocks,
    /// The row of pixels is ready.
    Row,
}

/// The caller's memory.
struct Memory<'m> {
    /// The row of pixels.
    row: &'m mut [Values],
    /// What is compared, of each slot.
    lanes: &'m mut [u32],
    /// What is shown.
    values: &'m mut [Values],
}

impl Memory<'_> {
    #[inline(always)]
    fn lanes(&self, slot: usize) -> u32 {
        self.lanes.get(slot).copied().unwrap_or(0)
    }

    #[inline(always)]
    fn values(&self, slot: usize) -> Values {
        self.values.get(slot).copied().unwrap_or_default()
    }

    #[inline(always)]
    fn set_lanes(&mut self, slot: usize, lanes: u32) {
        if let Some(to) = self.lanes.get_mut(slot) {
            *to = lanes;
        }
    }

    #[inline(always)]
    fn set_values(&mut self, slot: usize, values: Values) {
        if let Some(to) = self.values.get_mut(slot) {
            *to = values;
        }
    }

    /// Takes some notes away at a corner, and makes others.
    #[inline(always)]
    fn note(&mut self, slot: usize, without: u32, with: u32) {
        if let Some([_, notes]) = self.values.get_mut(slot) {
            *notes = *notes & !without | with;
        }
    }
}

/// The sampler: where it stands. What it has been told lies in the caller's memory.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sparse {
    layout: Layout,
    limits: Limits,
    /// What the display values were made by.
    tone: Tone,
    /// The picture's last column and row.
    last: (u16, u16),
    /// The columns that are asked for, nothing being known of others; the first behind the last for
    /// none.
    columns: (u16, u16),
    /// The row of blocks that is ready or being made.
    row: i16,
    /// The row of pixels that is ready, and the pair of rows for which the smallest blocks' middles
    /// are.
    ready: Option<u16>,
    pair: Option<u16>,
    stage: Stage,
    /// The side of the blocks that are being divided.
    side: u16,
    /// The first in the chain of samples that wait.
    waiting: u32,
    /// The slot of the ray that was asked for last, and the word where its display values go.
    slot: usize,
    place: usize,
}

impl Sparse {
    /// The sampler for a picture; one that isn't asked for another sampling.
    pub(super) const fn new(width: u16, height: u16, sampling: Sampling) -> Self {
        let (side, threshold) = match sampling {
            Sampling::Sparse { side, threshold } => (side, threshold),
            _ => (2, 0),
        };
        Self {
            layout: Layout::new(width, side),
            limits: Limits::new(threshold),
            tone: Tone::SRGB,
            last: (width - 1, height - 1),
            columns: (1, 0),
            row: 0,
            ready: None,
            pair: None,
            stage: Stage::Blocks,
            side: 0,
            waiting: END,
            slot: 0,
            place: 0,
        }
    }

    /// The sampler, which is left behind knowing nothing.
    #[inline(always)]
    pub(super) fn take(&mut self) -> Self {
        let taken = *self;
        self.columns = (1, 0);
        taken
    }

    /// The display values of a pixel of the row that is ready.
    #[inline(always)]
    pub(super) fn pixel(x: u16, words: &[u32]) -> [u16; 3] {
        let place = usize::from(x) << 1;
        let word = |place: usize| words.get(place).copied().unwrap_or(0);
        unpack([word(place), word(place | 1)])
    }

    /// Those of all, from the first on.
    #[inline(always)]
    pub(super) fn pixels_of(words: &[u32]) -> impl Iterator<Item = [u16; 3]> {
        words.as_chunks().0.iter().map(|&values| unpack(values))
    }

    /// Where the next ray goes that the row of pixels at y needs between two columns, through the
    /// centre of a pixel; the sampler is to be [told](Self::tell) what it finds before it is asked
    /// again. `None` if the row is ready.
    #[inline(never)]
    pub(super) fn next(
        &mut self,
        y: u16,
        columns: (u16, u16),
        tone: &Tone,
        words: &mut [u32],
    ) -> Option<(u16, u16)> {
        if self.waiting == END {
            self.go_on(y, columns, tone, words);
            if self.waiting == END {
                return None;
            }
        }
        // Single pixels wait in the row, the others in their slots.
        let layout = &self.layout;
        let base = if self.stage == Stage::Row { 0 } else { layout.values };
        self.slot = self.waiting as usize;
        self.place = base + 2 * self.slot;
        let word = |place: usize| words.get(place).copied().unwrap_or(END);
        let at = word(self.place);
        self.waiting = word(self.place + 1);
        Some((at as u16, (at >> 16) as u16))
    }

    /// What the ray has found that the sampler asked for.
    #[inline(always)]
    pub(super) fn tell(&self, shown: [u16; 3], costly: bool, words: &mut [u32]) {
        let mut put = |place: usize, word: u32| {
            if let Some(to) = words.get_mut(place) {
                *to = word;
            }
        };
        let values = pack(shown);
        put(self.place, values[0]);
        put(self.place + 1, values[1]);
        if self.place >= self.layout.values {
            put(self.layout.row + self.slot, lanes(values, costly));
        }
    }

    /// Goes on until samples wait for rays or the row is ready.
    #[inline(never)]
    fn go_on(&mut self, y: u16, columns: (u16, u16), tone: &Tone, words: &mut [u32]) {
        let Layout { row, all, log2_side, side, .. } = self.layout;
        let Some((row, slots)) = words.split_at_mut_checked(row) else { return };
        let Some((lanes, values)) = slots.split_at_mut_checked(all) else { return };
        let (row, values) = (row.as_chunks_mut().0, values.as_chunks_mut().0);
        let memory = &mut Memory { row, lanes, values };
        let wanted = (y >> log2_side) as i16;
        if self.columns != columns || self.tone != *tone {
            (self.columns, self.tone) = (columns, *tone);
            self.begin(wanted, memory);
        } else if self.ready == Some(y) {
            return;
        } else if self.stage == Stage::Row && self.ready.is_some() {
            // Another row was asked for before.
            self.ready = None;
            self.stage = Stage::Blocks;
            if self.row != wanted && self.row.wrapping_add(1) != wanted {
                self.begin(wanted, memory);
            }
        }
        while self.waiting == END {
            match self.stage {
                Stage::Corners => self.corners(memory),
                Stage::Marks => {
                    self.marks(memory);
                    if self.row.wrapping_add(1) < wanted || self.row < 0 {
                        self.next_row(memory);
                    } else {
                        self.side = side;
                        self.stage = if side < 4 { Stage::Blocks } else { Stage::Middles };
                    }
                }
                Stage::Middles => self.middles(memory),
                Stage::Sides => self.sides(memory),
                Stage::Means => self.means(memory),
                Stage::Blocks if self.row != wanted => self.next_row(memory),
                Stage::Blocks if self.pair != Some(y >> 1) => {
                    self.pair = Some(y >> 1);
                    self.smallest(y & !1, memory);
                }
                Stage::Blocks => self.pixels(y, memory),
                Stage::Row => {
                    self.ready = Some(y);
                    return;
                }
            }
        }
    }

    /// Lets a sample wait for its ray through a pixel; beyond an edge, through the last one.
    #[inline(always)]
    fn wait(&mut self, x: u16, y: u16, slot: usize, memory: &mut Memory<'_>) {
        let (x, y) = (x.min(self.last.0), y.min(self.last.1));
        memory.set_lanes(slot, WAITS);
        memory.set_values(slot, [u32::from(x) | u32::from(y) << 16, self.waiting]);
        self.waiting = slot as u32;
    }
}

//! The rays at even coordinates and the middles of the smallest blocks: which of them a row of pixels
//! needs before it can be drawn.
//!
//! The mark of a block's upper left corner says that its middle is to be traced. It is set when the
//! corners below the next row of blocks are known: one of the blocks beside may be below. A block is open if
//! its middle or that of one of its sides has been traced; then all five are there, those that
//! weren't as means, which don't count as known.

use super::layout::Layout;
use super::{Sparse, Stage, mean};
use crate::frame::Sample;
use crate::math::Arithmetic;

/// So many blocks beside the columns that are asked for have their corners traced.
const BESIDE: usize = 3;

#[inline(always)]
fn at<A: Arithmetic>(samples: &[Sample<A>], place: usize) -> Sample<A> {
    samples.get(place).copied().unwrap_or(Sample::NONE)
}

#[inline(always)]
fn put<A: Arithmetic>(samples: &mut [Sample<A>], place: usize, sample: Sample<A>) {
    if let Some(to) = samples.get_mut(place) {
        *to = sample;
    }
}

fn mark<A: Arithmetic>(samples: &mut [Sample<A>], place: usize) {
    if let Some(sample) = samples.get_mut(place) {
        *sample = sample.marked();
    }
}

fn forget<A: Arithmetic>(samples: &mut [Sample<A>], from: usize, to: usize) {
    if let Some(samples) = samples.get_mut(from..to) {
        samples.iter_mut().for_each(Sample::forget);
    }
}

impl Layout {
    /// The corners of a block, row by row.
    #[inline(always)]
    fn corners(&self, corner: usize, side: u16) -> [usize; 4] {
        let below = corner + self.offset(0, side);
        let right = self.offset(side, 0);
        [corner, corner + right, below, below + right]
    }

    /// The middle of a block.
    #[inline(always)]
    fn middle(&self, corner: usize, side: u16) -> usize {
        corner + self.offset(side >> 1, side >> 1)
    }

    /// The middles of a block's sides: left, right, above, below.
    #[inline(always)]
    fn sides(&self, corner: usize, side: u16) -> [usize; 4] {
        let half = side >> 1;
        let (right, down) = (self.offset(side, half), self.offset(half, side));
        [
            corner + self.offset(0, half),
            corner + right,
            corner + self.offset(half, 0),
            corner + down,
        ]
    }

    /// Whether rays have been sent within a block of side 4 or more, or through the middles of its
    /// sides.
    #[inline(always)]
    pub(super) fn is_open<A: Arithmetic>(
        &self,
        corner: usize,
        side: u16,
        samples: &[Sample<A>],
    ) -> bool {
        let known = |place: usize| samples.get(place).is_some_and(Sample::is_known);
        known(self.middle(corner, side)) || self.sides(corner, side).into_iter().any(known)
    }
}

impl<A: Arithmetic> Sparse<A> {
    /// Prepares for a row of pixels between two columns; the next ray that is missing, if there is one.
    #[inline(never)]
    pub(super) fn prepare(
        &mut self,
        y: u16,
        columns: (u16, u16),
        samples: &mut [Sample<A>],
    ) -> Option<(u16, u16)> {
        self.run.end = 0;
        let row = (y >> self.layout.log2_side) as i16;
        if self.columns != columns {
            self.ready = None;
            self.pair = None;
        }
        let begun = self.columns == columns && (self.stage != Stage::Ready || self.row == row);
        if !begun {
            let next = self.columns == columns && self.row.wrapping_add(1) == row;
            if !next {
                // From where all is known that this row depends on: the corners above the one above it.
                forget(samples, 0, self.layout.all);
                self.row = row.wrapping_sub(5).max(-3);
                self.columns = columns;
            }
            self.pair = None;
            self.next_row(samples);
        }
        loop {
            let asked = match self.stage {
                Stage::Corners => self.corners(row, samples),
                Stage::Middles => self.middles(samples),
                Stage::Sides => self.sides(samples),
                Stage::Ready if self.row == row => break,
                Stage::Ready => {
                    self.next_row(samples);
                    None
                }
            };
            if asked.is_some() {
                return asked;
            }
        }
        let pair = y >> 1;
        if self.pair != Some(pair) {
            if self.x == u16::MAX {
                let layout = &self.layout;
                forget(samples, layout.middles, layout.next);
                self.x = self.span(2).0;
            }
            if let Some(asked) = self.smallest(y & !1, samples) {
                return Some(asked);
            }
            self.pair = Some(pair);
        }
        self.x = u16::MAX;
        self.ready = Some(y);
        None
    }

    /// From which column to which one, where blocks of side s begin, so many of them beside the
    /// columns that are asked for count.
    fn span(&self, beside: usize) -> (u16, u16) {
        let Layout { log2_side, blocks, .. } = self.layout;
        let first = usize::from(self.columns.0 >> log2_side).saturating_sub(beside);
        let last = usize::from((self.columns.1 - 1) >> log2_side) + beside;
        let last = if last < blocks { last } else { blocks - 1 };
        ((first << log2_side) as u16, (last << log2_side) as u16)
    }

    /// Asks for the sample at a pixel; beyond an edge, for the last pixel's.
    fn request(&mut self, x: u16, y: u16, slot: usize) -> Option<(u16, u16)> {
        self.slot = slot;
        Some((x.min(self.last.0), y.min(self.last.1)))
    }

    /// Goes to the next row of blocks: its upper edge is the lower one of this, its lower corners are
    /// those known ahead.
    fn next_row(&mut self, samples: &mut [Sample<A>]) {
        let Layout { stride, step, lower, next, all, blocks, .. } = self.layout;
        for place in 0..stride {
            let edge = at(samples, lower + place);
            put(samples, place, edge);
        }
        forget(samples, stride, lower + stride);
        for block in 0..=blocks {
            let corner = at(samples, next + block);
            put(samples, lower + block * step, corner);
        }
        forget(samples, next, all);
        self.row = self.row.wrapping_add(1);
        self.stage = Stage::Corners;
        self.x = self.span(BESIDE).0;
    }

    /// Traces the corners below the next row of blocks, then marks those of its blocks whose corners
    /// differ, with those around them.
    fn corners(&mut self, wanted: i16, samples: &mut [Sample<A>]) -> Option<(u16, u16)> {
        let Layout { side, log2_side, step, lower, next, .. } = self.layout;
        let (first, last) = self.span(BESIDE);
        // The row of the corners, in blocks.
        let corners = self.row.wrapping_add(2);
        let y = (corners as u16) << log2_side;
        // There is no row of blocks below the picture.
        if corners >= 0 && (corners == 0 || y - side <= self.last.1) {
            let x = self.x;
            if x <= last + side {
                self.x = x + side;
                return self.request(x, y, next + usize::from(x >> log2_side));
            }
            let first = usize::from(first >> log2_side);
            for block in first..=usize::from(last >> log2_side) {
                let corner = lower + block * step;
                let [a, b, c, d] = [corner, corner + step, next + block, next + block + 1]
                    .map(|place| at(samples, place));
                if a.is_known() && a.is_worth_a_ray(&b, &c, &d, self.threshold) {
                    mark(samples, block * step);
                    mark(samples, corner);
                    mark(samples, next + block);
                    if block > first {
                        mark(samples, corner.wrapping_sub(step));
                    }
                    mark(samples, corner + step);
                }
            }
        }
        if self.row.wrapping_add(1) < wanted || self.row < 0 {
            self.next_row(samples);
        } else {
            self.divide(side);
        }
        None
    }

    /// Begins to divide the blocks of a side; none is smaller than 4.
    fn divide(&mut self, side: u16) {
        self.side = side;
        self.stage = if side < 4 { Stage::Ready } else { Stage::Middles };
        (self.x, self.down) = (if side < 4 { u16::MAX } else { self.span(BESIDE - 1).0 }, 0);
    }

    /// The corner of the next block of the side that is being divided.
    fn next_block(&mut self) -> Option<(u16, u16)> {
        let whole = self.layout.side;
        let (first, last) = self.span(BESIDE - 1);
        if self.x >= last + whole {
            self.x = first;
            self.down += self.side;
        }
        if self.down >= whole {
            return None;
        }
        let place = (self.x, self.down);
        self.x += self.side;
        Some(place)
    }

    /// Whether all blocks of which this one is a part are open; or, `divided`, whether their own middles
    /// have been traced: that doesn't depend on the row of blocks above.
    fn is_within(
        &self,
        (x, down, side): (u16, u16, u16),
        divided: bool,
        samples: &[Sample<A>],
    ) -> bool {
        let layout = &self.layout;
        let mut outer = layout.side;
        while outer > side {
            let mask = !(outer - 1);
            let corner = layout.offset(x & mask, down & mask);
            let middle = at(samples, layout.middle(corner, outer)).is_known();
            if !middle && (divided || !layout.is_open(corner, outer, samples)) {
                return false;
            }
            outer >>= 1;
        }
        true
    }

    /// Traces the middles of blocks.
    fn middles(&mut self, samples: &mut [Sample<A>]) -> Option<(u16, u16)> {
        let side = self.side;
        while let Some((x, down)) = self.next_block() {
            let layout = &self.layout;
            let corner = layout.offset(x, down);
            let wanted = if side == layout.side {
                at(samples, corner).is_marked()
            } else {
                let [a, b, c, d] = layout.corners(corner, side).map(|place| at(samples, place));
                self.is_within((x, down, side), true, samples)
                    && a.is_worth_a_ray(&b, &c, &d, self.threshold)
            };
            if wanted {
                let (half, y) = (side >> 1, self.top() + down);
                return self.request(x + half, y + half, layout.middle(corner, side));
            }
        }
        self.stage = Stage::Sides;
        (self.x, self.down, self.which) = (self.span(BESIDE - 1).0, 0, 0);
        None
    }

    /// The first row of pixels of the row of blocks.
    fn top(&self) -> u16 {
        (self.row as u16) << self.layout.log2_side
    }

    /// Traces the middles of the sides of blocks whose own has been, then lays means where none
    /// are.
    fn sides(&mut self, samples: &mut [Sample<A>]) -> Option<(u16, u16)> {
        let (side, half) = (self.side, self.side >> 1);
        loop {
            let (x, down) = if self.which == 0 {
                let Some(place) = self.next_block() else { break };
                place
            } else {
                (self.x - side, self.down)
            };
            let layout = &self.layout;
            let corner = layout.offset(x, down);
            let middle = at(samples, layout.middle(corner, side));
            if !middle.is_known() {
                continue;
            }
            let places = layout.sides(corner, side);
            let [p, q, r, s] = layout.corners(corner, side);
            let own = layout.middle(corner, side);
            let (across, along) = (layout.offset(side, 0), layout.offset(0, side));
            while self.which < 4 {
                let which = self.which;
                self.which += 1;
                // Its ends, the middle of the block on its other side, and where it is.
                let (ends, other, right, below) = match which {
                    0 => ((p, r), (x > 0).then(|| own.wrapping_sub(across)), 0, half),
                    1 => ((q, s), Some(own + across), side, half),
                    // The row of blocks above has decided its lower edge, if there is one.
                    2 if down == 0 && self.row > 0 => continue,
                    2 => ((p, q), (down > 0).then(|| own.wrapping_sub(along)), half, 0),
                    _ => {
                        let within = down + side < layout.side;
                        ((r, s), within.then_some(own + along), half, side)
                    }
                };
                let place = places[usize::from(which & 3)];
                let other = other.map(|place| at(samples, place)).filter(Sample::is_known);
                let other = other.unwrap_or(middle);
                let (a, b) = (at(samples, ends.0), at(samples, ends.1));
                if !at(samples, place).is_known()
                    && a.is_worth_a_ray(&b, &middle, &other, self.threshold)
                {
                    let y = self.top() + down + below;
                    return self.request(x + right, y, place);
                }
            }
            self.which = 0;
        }
        self.lay_means(samples);
        self.divide(half);
        None
    }

    /// Lays the means of what is around them where open blocks have no rays.
    fn lay_means(&mut self, samples: &mut [Sample<A>]) {
        let side = self.side;
        (self.x, self.down) = (self.span(BESIDE - 1).0, 0);
        while let Some((x, down)) = self.next_block() {
            let layout = &self.layout;
            let corner = layout.offset(x, down);
            if !self.is_within((x, down, side >> 1), false, samples) {
                continue;
            }
            let [a, b, c, d] = layout.corners(corner, side).map(|place| at(samples, place));
            let sides = layout.sides(corner, side);
            let middle = layout.middle(corner, side);
            let between = [(a, c), (b, d), (a, b), (c, d)].map(|(a, b)| a.between(&b, mean::<A>));
            for (place, mean) in sides.into_iter().zip(between) {
                if !at(samples, place).is_known() {
                    put(samples, place, mean);
                }
            }
            if !at(samples, middle).is_known() {
                put(samples, middle, between[0].between(&between[1], mean::<A>));
            }
        }
    }

    /// Traces the middles of the smallest blocks, those of the pair of rows from y on.
    fn smallest(&mut self, y: u16, samples: &mut [Sample<A>]) -> Option<(u16, u16)> {
        let whole = self.layout.side;
        let last = self.span(BESIDE - 1).1 + whole;
        let down = y & (whole - 1);
        while self.x < last {
            let x = self.x;
            self.x += 2;
            let layout = &self.layout;
            if whole > 2 && !self.is_within((x, down, 2), false, samples) {
                // Nor is the other half of that block.
                self.x = (x | 3) + 1;
                continue;
            }
            let wanted = |x: u16, down: u16| {
                let corner = layout.offset(x, down);
                let four = layout.corners(corner, 2).map(|place| at(samples, place));
                let [a, b, c, d] = &four;
                let known = four.iter().filter(|sample| sample.is_known()).count();
                (a.is_worth_a_ray(b, c, d, self.threshold), known)
            };
            let wanted = if whole == 2 {
                at(samples, layout.offset(x, down)).is_marked()
            } else {
                let (own, known) = wanted(x, down);
                own || known > 2 && (wanted(x ^ 2, down).0 || wanted(x, down ^ 2).0)
            };
            if wanted {
                return self.request(x | 1, y | 1, layout.middles + usize::from(x >> 1));
            }
        }
        None
    }
}

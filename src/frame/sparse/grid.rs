//! The rays at even coordinates, and which middles of the smallest blocks follow: what a row of blocks
//! needs before its pixels can be drawn.
//!
//! The mark of a block's upper left corner says that its middle is to be traced. It is set when the
//! corners below the next row of blocks are known: one of the blocks beside may be below. A block is open if
//! its middle or that of one of its sides has been traced; then all five are there, those that
//! weren't as means, which don't count as known.

use super::layout::Layout;
use super::slot::{between, is_known, mean};
use super::{END, MARK, Memory, OPEN, Sparse, Stage, WANTED};

/// So many blocks beside the columns that are asked for have their corners traced.
const BESIDE: usize = 3;

/// The note that a block of side 4, 8 or 16 is open.
#[inline(always)]
pub(super) fn open(side: u16) -> u32 {
    OPEN.wrapping_mul(u32::from(side >> 2))
}

impl Sparse {
    /// Begins so far above a row of blocks that all is known which it depends on: from the corners above
    /// the one above it.
    #[inline(never)]
    pub(super) fn begin(&mut self, wanted: i16, memory: &mut Memory<'_>) {
        memory.lanes.fill(0);
        self.row = wanted.wrapping_sub(5).max(-3);
        self.waiting = END;
        self.ready = None;
        self.next_row(memory);
    }

    /// From which column to which one, where blocks begin, so many of them beside the
    /// columns that are asked for count.
    fn span(&self, beside: usize) -> (u16, u16) {
        let Layout { log2_side, blocks, .. } = self.layout;
        let first = usize::from(self.columns.0 >> log2_side).saturating_sub(beside);
        let last = usize::from((self.columns.1 - 1) >> log2_side) + beside;
        let last = if last < blocks { last } else { blocks - 1 };
        ((first << log2_side) as u16, (last << log2_side) as u16)
    }

    /// The same of blocks that are divided.
    #[inline(always)]
    pub(super) fn divided(&self) -> (u16, u16) {
        self.span(BESIDE - 1)
    }

    /// Goes to the next row of blocks: its upper edge is the lower one of this, its lower corners are
    /// those known ahead.
    #[inline(never)]
    pub(super) fn next_row(&mut self, memory: &mut Memory<'_>) {
        let Layout { stride, step, lower, next, blocks, .. } = self.layout;
        if let Some((upper, edge)) = memory.lanes.split_at_mut_checked(lower) {
            upper.iter_mut().zip(edge).take(stride).for_each(|(to, from)| *to = *from);
        }
        if let Some((upper, edge)) = memory.values.split_at_mut_checked(lower) {
            upper.iter_mut().zip(edge).take(stride).for_each(|(to, from)| *to = *from);
        }
        if let Some(lanes) = memory.lanes.get_mut(stride..next) {
            lanes.fill(0);
        }
        let mut corner = lower;
        for place in next..=next + blocks {
            memory.set_lanes(corner, memory.lanes(place));
            memory.set_values(corner, memory.values(place));
            memory.set_lanes(place, 0);
            corner += step;
        }
        self.row = self.row.wrapping_add(1);
        self.pair = None;
        self.stage = Stage::Corners;
    }

    /// Whether there are corners below the next row of blocks: there is no row of blocks below the
    /// picture. And the pixels' row that they lie in.
    fn corners_below(&self) -> Option<u16> {
        let Layout { side, log2_side, .. } = self.layout;
        let corners = self.row.wrapping_add(2);
        let y = (corners as u16) << log2_side;
        (corners >= 0 && (corners == 0 || y - side <= self.last.1)).then_some(y)
    }

    /// Asks for the corners below the next row of blocks.
    #[inline(never)]
    pub(super) fn corners(&mut self, memory: &mut Memory<'_>) {
        self.stage = Stage::Marks;
        let Layout { side, log2_side, next, .. } = self.layout;
        let (first, last) = self.span(BESIDE);
        if let Some(y) = self.corners_below() {
            for block in first >> log2_side..=(last + side) >> log2_side {
                self.wait(block << log2_side, y, next + usize::from(block), memory);
            }
        }
    }

    /// Marks the blocks of the next row whose corners differ, with those around them.
    #[inline(never)]
    pub(super) fn marks(&mut self, memory: &mut Memory<'_>) {
        let Layout { log2_side, step, lower, next, .. } = self.layout;
        if self.corners_below().is_none() {
            return;
        }
        let (first, last) = self.span(BESIDE);
        let (first, last) = (usize::from(first >> log2_side), usize::from(last >> log2_side));
        for block in first..=last {
            let corner = lower + block * step;
            let four = [corner, corner + step, next + block, next + block + 1];
            let four = four.map(|slot| memory.lanes(slot));
            if is_known(four[0]) && self.limits.differ(four) {
                for slot in [block * step, corner, next + block, corner + step] {
                    memory.note(slot, 0, MARK);
                }
                if block > first {
                    memory.note(corner - step, 0, MARK);
                }
            }
        }
    }

    /// Whether the block of side 8 or 16 around one of half its side has been divided at its middle.
    #[inline(always)]
    fn is_around_divided(&self, x: u16, down: u16, side: u16, memory: &Memory<'_>) -> bool {
        let (outer, mask) = (side << 1, !(side << 1).wrapping_sub(1));
        let corner = self.layout.offset(x & mask, down & mask);
        is_known(memory.lanes(self.layout.middle(corner, outer)))
    }

    /// The first row of pixels of the row of blocks.
    fn top(&self) -> u16 {
        (self.row as u16) << self.layout.log2_side
    }

    /// Asks for the middles of blocks.
    #[inline(never)]
    pub(super) fn middles(&mut self, memory: &mut Memory<'_>) {
        self.stage = Stage::Sides;
        let (layout, side, half) = (self.layout, self.side, self.side >> 1);
        let (first, last) = self.divided();
        let mut down = 0;
        while down < layout.side {
            let mut x = first;
            while x < last + layout.side {
                let corner = layout.offset(x, down);
                let wanted = if side == layout.side {
                    memory.values(corner)[1] & MARK != 0
                } else {
                    let four = layout.corners(corner, side).map(|slot| memory.lanes(slot));
                    self.is_around_divided(x, down, side, memory) && self.limits.differ(four)
                };
                if wanted {
                    let y = self.top() + down;
                    self.wait(x + half, y + half, layout.middle(corner, side), memory);
                }
                x += side;
            }
            down += side;
        }
    }

    /// Asks for the middles of the sides of blocks of which one has been traced at its middle.
    #[inline(never)]
    pub(super) fn sides(&mut self, memory: &mut Memory<'_>) {
        self.stage = Stage::Means;
        let (layout, side, half) = (self.layout, self.side, self.side >> 1);
        let (first, last) = self.divided();
        let (right, under) = (layout.offset(side, 0), layout.offset(0, side));
        let mut down = 0;
        while down < layout.side {
            let y = self.top() + down;
            let mut x = first;
            let mut corner = layout.offset(x, down);
            let mut own = layout.middle(corner, side);
            let mut before = 0;
            loop {
                let is_behind = x >= last + layout.side;
                let middle = if is_behind { 0 } else { memory.lanes(own) };
                // The left one.
                if is_known(before | middle) {
                    let slot = corner + layout.offset(0, half);
                    let ends = (corner, corner + under);
                    self.side((x, y + half), slot, ends, (before, middle), memory);
                }
                if is_behind {
                    break;
                }
                // The lower one. Of the row of blocks below nothing is known yet.
                let within = down + side < layout.side;
                let next = if within { memory.lanes(own + under) } else { 0 };
                if is_known(middle | next) {
                    let slot = corner + under + (right >> 1);
                    let ends = (corner + under, corner + under + right);
                    self.side((x + half, y + side), slot, ends, (middle, next), memory);
                }
                // The row of blocks above has decided its lower ones, if there is one.
                if down == 0 && self.row <= 0 && is_known(middle) {
                    let (slot, ends) = (corner + (right >> 1), (corner, corner + right));
                    self.side((x + half, y), slot, ends, (middle, middle), memory);
                }
                before = middle;
                x += side;
                corner += right;
                own += right;
            }
            down += side;
        }
    }

    /// Asks for the middle of a side between two blocks if it is worth a ray; one of the blocks at
    /// least has been traced at its middle.
    #[inline(never)]
    fn side(
        &mut self,
        (x, y): (u16, u16),
        slot: usize,
        ends: (usize, usize),
        (one, two): (u32, u32),
        memory: &mut Memory<'_>,
    ) {
        let (one, two) = either(one, two);
        if self.limits.differ([memory.lanes(ends.0), memory.lanes(ends.1), one, two]) {
            self.wait(x, y, slot, memory);
        }
    }

    /// Lays the means of what is around them where open blocks have no rays.
    #[inline(never)]
    pub(super) fn means(&mut self, memory: &mut Memory<'_>) {
        let (layout, side) = (self.layout, self.side);
        let (first, last) = self.divided();
        let mut down = 0;
        while down < layout.side {
            let mut x = first;
            while x < last + layout.side {
                self.lay(x, down, memory);
                x += side;
            }
            down += side;
        }
        self.side = side >> 1;
        self.stage = if side > 4 { Stage::Middles } else { Stage::Blocks };
    }

    /// Lays those of one block, if it is open, and notes whether it is.
    #[inline(always)]
    fn lay(&self, x: u16, down: u16, memory: &mut Memory<'_>) {
        let (layout, side) = (&self.layout, self.side);
        let corner = layout.offset(x, down);
        let middle = layout.middle(corner, side);
        let sides = layout.sides(corner, side);
        let mask = !(side << 1).wrapping_sub(1);
        let outer = layout.offset(x & mask, down & mask);
        let within = side == layout.side || memory.values(outer)[1] & open(side << 1) != 0;
        let known = |slot: usize| is_known(memory.lanes(slot));
        if !within || !(known(middle) || sides.into_iter().any(known)) {
            memory.note(corner, open(side), 0);
            return;
        }
        let [a, b, c, d] = layout.corners(corner, side);
        let [left, right, above, below] = sides;
        lay_between(left, a, c, memory);
        lay_between(right, b, d, memory);
        lay_between(above, a, b, memory);
        lay_between(below, c, d, memory);
        lay_between(middle, left, right, memory);
        let wanted = if side == 4 { self.wanted(corner, memory) } else { 0 };
        memory.note(corner, open(4) | (15 * WANTED), open(side) | wanted);
    }
}

/// Of two of which one at least is known, each; or the one twice.
#[inline(always)]
pub(super) fn either(one: u32, two: u32) -> (u32, u32) {
    (if is_known(one) { one } else { two }, if is_known(two) { two } else { one })
}

/// Lays the mean of two slots at a third, if no ray has been sent there.
#[inline(never)]
fn lay_between(slot: usize, one: usize, two: usize, memory: &mut Memory<'_>) {
    if !is_known(memory.lanes(slot)) {
        memory.set_lanes(slot, between(memory.lanes(one), memory.lanes(two)));
        memory.set_values(slot, mean(memory.values(one), memory.values(two)));
    }
}

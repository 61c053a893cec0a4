//! The smallest blocks, and the row of pixels that is shown.

use super::grid::{either, open};
use super::layout::Layout;
use super::slot::{Limits, Values, are_three_known, is_known, mean};
use super::{MARK, Memory, Sparse, Stage, WANTED};

impl Sparse {
    /// Which middles of the four smallest blocks in an open block of side 4 are to be traced, a note
    /// for each.
    #[inline(never)]
    pub(super) fn wanted(&self, corner: usize, memory: &Memory<'_>) -> u32 {
        let stride = self.layout.stride;
        let row = |down| some(memory.lanes, corner + down * stride).copied().unwrap_or_default();
        let [a, b, c] = row(0);
        let [d, e, f] = row(1);
        let [g, h, i] = row(2);
        let (mut differ, mut known) = (0, 0);
        let four = [[e, f, h, i], [d, e, g, h], [b, c, e, f], [a, b, d, e]];
        for four in four {
            known = known << 1 | u32::from(are_three_known(four));
            differ = differ << 1 | u32::from(self.limits.differ(four));
        }
        // Those beside, above and below.
        let beside = (differ & 5) << 1 | differ >> 1 & 5 | differ << 2 | differ >> 2;
        WANTED.wrapping_mul(differ | known & beside)
    }

    /// Asks for the middles of the smallest blocks of the pair of rows from y on.
    #[inline(never)]
    pub(super) fn smallest(&mut self, y: u16, memory: &mut Memory<'_>) {
        let layout = self.layout;
        let down = y & (layout.side - 1);
        let (first, last) = self.divided();
        let mut x = first;
        while x < last + layout.side {
            let place = layout.middle_at(x);
            let wanted = if layout.side == 2 {
                u32::from(memory.values(layout.offset(x, 0))[1] & MARK != 0)
            } else {
                let [_, notes] = memory.values(layout.offset(x, down & !3));
                if notes & open(4) == 0 { 0 } else { (notes / WANTED) >> (down & 2) & 3 }
            };
            memory.set_lanes(place, 0);
            if wanted & 1 != 0 {
                self.wait(x + 1, y + 1, place, memory);
            }
            x += 2;
            if layout.side > 2 {
                memory.set_lanes(place + 1, 0);
                if wanted & 2 != 0 {
                    self.wait(x + 1, y + 1, place + 1, memory);
                }
                x += 2;
            }
        }
    }

    /// Lays a row of pixels down; those that are worth a ray of their own wait for it there.
    #[inline(never)]
    pub(super) fn pixels(&mut self, y: u16, memory: &mut Memory<'_>) {
        self.stage = Stage::Row;
        let whole = if self.layout.side == 2 { 4 } else { self.layout.side };
        let mut x = self.columns.0 & !(whole - 1);
        let is_open = open(self.layout.side);
        while x < self.columns.1 {
            let [_, notes] = memory.values(usize::from(x >> 1));
            if self.layout.side > 2 && notes & is_open == 0 {
                x = self.undivided(x, y, memory);
            } else {
                if whole == 4 {
                    self.four(x, y, memory);
                } else {
                    self.parted(x, y, memory);
                }
                x += whole;
            }
        }
    }

    /// Lays down four pixels of the smallest blocks.
    #[inline(never)]
    fn four(&mut self, x: u16, y: u16, memory: &mut Memory<'_>) {
        let layout = &self.layout;
        let corner = layout.offset(x, y & (layout.side - 1));
        let is_lower = y & 1 != 0;
        let wanted = if is_lower {
            lower(&self.limits, x, corner, layout, memory)
        } else {
            upper(&self.limits, x, corner, layout, memory)
        };
        if wanted == 0 {
            return;
        }
        let x = x + u16::from(!is_lower);
        if wanted & 1 != 0 {
            self.single(x, y, memory);
        }
        if wanted & 2 != 0 {
            self.single(x + 2, y, memory);
        }
    }

    /// Lays down the pixels of blocks that aren't divided, as many as follow each other; returns where
    /// the first begins that is.
    #[inline(never)]
    fn undivided(&self, mut x: u16, y: u16, memory: &mut Memory<'_>) -> u16 {
        let Layout { side, step, lower, .. } = self.layout;
        let (down, is_open) = (y & (side - 1), open(side));
        let mut corner = usize::from(x >> 1);
        let mut left = None;
        while x < self.columns.1 && memory.values(corner)[1] & is_open == 0 {
            let edge = |corner: usize| {
                if side == 4 {
                    edge_of_4(corner, lower, down, memory)
                } else {
                    edge(corner, lower, down, side, memory)
                }
            };
            let from = left.unwrap_or_else(|| edge(corner));
            corner += step;
            let to = edge(corner);
            if side == 4 {
                lay_4(x, from, to, memory.row);
            } else {
                lay(x, side, from, to, memory.row);
            }
            left = Some(to);
            x += side;
        }
        x
    }

    /// Lays down those of a block of side 8 or 16 that is divided.
    #[inline(never)]
    fn parted(&mut self, mut x: u16, y: u16, memory: &mut Memory<'_>) {
        let layout = self.layout;
        let down = y & (layout.side - 1);
        let end = x + layout.side;
        while x < end {
            // The largest undivided block that begins there.
            let mut side = layout.side;
            let mut corner = 0;
            while side > 2 {
                let inner = !(side - 1);
                corner = layout.offset(x & inner, down & inner);
                if memory.values(corner)[1] & open(side) == 0 {
                    break;
                }
                side >>= 1;
            }
            if side > 2 {
                let (down, under) = (down & (side - 1), layout.offset(0, side));
                let left = edge(corner, under, down, side, memory);
                let right = edge(corner + usize::from(side >> 1), under, down, side, memory);
                lay(x, side, left, right, memory.row);
                x += side;
            } else {
                self.four(x, y, memory);
                x += 4;
            }
        }
    }

    /// Lets a pixel of the row wait for a ray of its own, if it is asked for.
    fn single(&mut self, x: u16, y: u16, memory: &mut Memory<'_>) {
        if x >= self.columns.0
            && x < self.columns.1
            && let Some(place) = memory.row.get_mut(usize::from(x))
        {
            *place = [u32::from(x) | u32::from(y) << 16, self.waiting];
            self.waiting = x.into();
        }
    }
}

#[inline(always)]
fn some<const N: usize, T>(all: &[T], first: usize) -> Option<&[T; N]> {
    all.get(first..first.wrapping_add(N))?.first_chunk()
}

/// Four pixels of a row.
#[inline(always)]
fn four_of(row: &mut [Values], x: u16) -> Option<&mut [Values; 4]> {
    row.as_chunks_mut().0.get_mut(usize::from(x >> 2))
}

/// Lays down four pixels above the middles of the smallest blocks: corners, and what lies between them. The
/// middle below says whether that is worth a ray; a bit for each that is.
#[inline(never)]
fn upper(limits: &Limits, x: u16, corner: usize, layout: &Layout, memory: &mut Memory<'_>) -> u32 {
    let Some(&[a, b, c]) = some(memory.values, corner) else { return 0 };
    let Some(row) = four_of(memory.row, x) else { return 0 };
    *row = [a, mean(a, b), b, mean(b, c)];
    let Some(&[one, two]) = some(memory.lanes, layout.middle_at(x)) else { return 0 };
    if !is_known(one | two) {
        return 0;
    }
    let Some(&[a, b, c]) = some(memory.lanes, corner) else { return 0 };
    let is_wanted = |a, b, middle| is_known(middle) && limits.differ([a, b, middle, middle]);
    u32::from(is_wanted(a, b, one)) | u32::from(is_wanted(b, c, two)) << 1
}

/// Lays down four pixels of the row of these middles: what lies between a corner and the one below, where
/// the middles on both sides say whether it is worth a ray, and the middles.
#[inline(never)]
fn lower(limits: &Limits, x: u16, corner: usize, layout: &Layout, memory: &mut Memory<'_>) -> u32 {
    let (below, place) = (corner + layout.stride, layout.middle_at(x));
    let Some(&[a, b, c]) = some(memory.values, corner) else { return 0 };
    let Some(&[d, e, f]) = some(memory.values, below) else { return 0 };
    let Some(&[before, one, two]) = some(memory.lanes, place - 1) else { return 0 };
    let Some(&middles) = some::<2, _>(memory.values, place) else { return 0 };
    let Some(row) = four_of(memory.row, x) else { return 0 };
    let (left, middle, right) = (mean(a, d), mean(b, e), mean(c, f));
    let first = if is_known(one) { middles[0] } else { mean(left, middle) };
    let last = if is_known(two) { middles[1] } else { mean(middle, right) };
    *row = [left, first, middle, last];
    if !is_known(before | one | two) {
        return 0;
    }
    let Some(&[a, b]) = some(memory.lanes, corner) else { return 0 };
    let Some(&[d, e]) = some(memory.lanes, below) else { return 0 };
    let is_wanted = |a, b, one, two| {
        is_known(one | two) && {
            let (one, two) = either(one, two);
            limits.differ([a, b, one, two])
        }
    };
    u32::from(is_wanted(a, d, before, one)) | u32::from(is_wanted(b, e, one, two)) << 1
}

/// The values between two slots, of which one lies `side` below the other: `under` slots on.
#[inline(never)]
fn edge(slot: usize, under: usize, down: u16, side: u16, memory: &Memory<'_>) -> Values {
    let mut low = memory.values(slot);
    if down == 0 {
        return low;
    }
    let mut high = memory.values(slot + under);
    let (mut half, mut down) = (side >> 1, down);
    loop {
        let middle = mean(low, high);
        if down & half == 0 {
            high = middle;
        } else {
            low = middle;
            down -= half;
            if down == 0 {
                return low;
            }
        }
        half >>= 1;
    }
}

/// The same of a side of 4.
#[inline(always)]
fn edge_of_4(slot: usize, under: usize, down: u16, memory: &Memory<'_>) -> Values {
    let low = memory.values(slot);
    if down == 0 {
        return low;
    }
    let high = memory.values(slot + under);
    let middle = mean(low, high);
    match down {
        1 => mean(low, middle),
        2 => middle,
        _ => mean(middle, high),
    }
}

/// Lays down the pixels of an undivided block.
#[inline(never)]
fn lay(x: u16, side: u16, left: Values, right: Values, row: &mut [Values]) {
    let Some(row) = row.get_mut(usize::from(x)..) else { return };
    let Some(row) = row.get_mut(..side.into()) else { return };
    if let Some(first) = row.first_mut() {
        *first = left;
    }
    let mut half = row.len() >> 1;
    while half > 0 {
        let mut i = half;
        while i < row.len() {
            let (a, b) = (row.get(i - half), row.get(i + half));
            let (a, b) = (a.copied().unwrap_or(left), b.copied().unwrap_or(right));
            if let Some(to) = row.get_mut(i) {
                *to = mean(a, b);
            }
            i += 2 * half;
        }
        half >>= 1;
    }
}

/// The same of four.
#[inline(always)]
fn lay_4(x: u16, left: Values, right: Values, row: &mut [Values]) {
    if let Some(four) = four_of(row, x) {
        let middle = mean(left, right);
        *four = [left, mean(left, middle), middle, mean(middle, right)];
    }
}

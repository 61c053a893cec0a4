//! Walking the tree along a ray.
//!
//! For each axis the walk knows the ray parameter at which the current cell's far face is passed (its
//! exits) and that of crossing a whole cell of the grid. The smallest exit says which face the ray leaves
//! the cell through; the next cell's exit on that axis is later by a cell, the others stay (Amanatides and
//! Woo, "A fast voxel traversal algorithm for ray tracing", 1987).
//!
//! Below a cell of the grid the ray is mirrored so that it goes towards larger coordinates on every
//! axis; children are then numbered along it, and one xor gives their true numbers. A child's exits are
//! the cell's in the upper half, and less by half a cell in the lower one. Going down halves; going on
//! crosses one axis alone: the next child's exit there is the cell's. Where the child lies in the upper
//! half already, the cell itself is left across the same face, and what is around it goes on with the
//! same axis. There is no multiplication after the set-up.
//!
//! A ray that starts outside is first moved to where it enters the grid, less what that place
//! may be wrong, so its start may lie a little before the grid: nothing here minds. Nor does it
//! mind a cell too many: a shape that lies elsewhere is tested in vain.
//!
//! **The end.** The next cell is entered where the last one is left; if that is beyond the best
//! hit (spans of distances are rounded up: a tie isn't beyond), nothing nearer can follow. Where the
//! walk's idea of the parameter is wrong, it is the position along the ray that is wrong by less than
//! the builder's margin, so the shape was listed in a cell already seen.

use super::OctreeBuffer;
use super::builder::{LEAST_LOG2_SIDE, MOST_LOG2_SIDE};
use super::grid::{self, Grid};
use super::limits::Cube;
use super::node::{self, IdWidth, MAX_LEVELS, TreeError, validate};
use crate::math::{Arithmetic, for_each_arithmetic, sub};

/// What a walk finds is its visitor's business.
pub trait Visitor<A: Arithmetic> {
    /// The distance of the best hit so far: nothing beyond it is of interest.
    fn limit(&self) -> A::Length;
    /// Tests a shape, and says whether the walk may stop. A shape may come more than once, and
    /// in any order; of several at the same distance all come.
    fn visit(&mut self, id: u32) -> bool;
    /// An inner node is entered, or the grid.
    #[inline(always)]
    fn node(&mut self) {}
    /// A cell or a child is looked at, whether it exists or not.
    #[inline(always)]
    fn step(&mut self) {}
}

/// A tree, borrowed and validated.
#[derive(Clone, Copy, Debug)]
pub struct Octree<'a, A: Arithmetic> {
    words: &'a [u32],
    origin: [A::Length; 3],
    /// The sides of the grid and of a cell.
    sides: [A::Length; 3],
    cell: A::Length,
    per_cell: A::Span,
    cells: [u8; 3],
    /// See [`Arithmetic::spans`].
    unit: u8,
    width: IdWidth,
    shapes: u32,
}

/// So many ids are remembered, by their low bits: it saves a sixth of the tests, and clearing
/// them costs a dozen cycles.
const RECENT: usize = 8;

/// An inner node under way.
#[derive(Clone, Copy, Debug)]
struct Frame<A: Arithmetic> {
    word: u32,
    /// The current child's number, in the mirrored order: written where the ray goes down.
    number: u32,
    /// The current child's exits; those of the node itself are in the frame before.
    ends: [A::Span; 3],
}

/// A walk's memory. It needn't be cleared between walks.
#[derive(Clone, Copy, Debug)]
pub struct WalkStack<A: Arithmetic> {
    /// The first one stands for a cell of the grid: its word and number stay 0.
    frames: [Frame<A>; MAX_LEVELS + 1],
}

impl<A: Arithmetic> WalkStack<A> {
    /// Memory for walks, one after the other.
    pub const fn new() -> Self {
        Self { frames: [Frame { word: 0, number: 0, ends: [A::NO_SPAN; 3] }; MAX_LEVELS + 1] }
    }
}

impl<A: Arithmetic> Default for WalkStack<A> {
    fn default() -> Self {
        Self::new()
    }
}

/// What a walk below the grid needs to know of the ray.
struct Way<A: Arithmetic> {
    whole: [A::Span; 3],
    /// What the spans' beginning is from the ray's origin.
    back: A::Length,
    mirror: u32,
    entry: A::Span,
    bound: A::Span,
}

/// Whether positions in the cube, and differences of them, fit.
const fn cube_fits(cube: &Cube, log2_step: i8, grid: &Grid) -> bool {
    let log2 = cube.log2_side as i32 + log2_step as i32;
    if cube.log2_side < LEAST_LOG2_SIDE
        || cube.log2_side > MOST_LOG2_SIDE
        || log2 < -60
        || log2 > 60
    {
        return false;
    }
    let mut axis = 0;
    while axis < 3 {
        if cube.origin[axis] < -(1 << 29) || cube.origin[axis] > 1 << 29 {
            return false;
        }
        if grid.cells[axis] as i64 * grid.side() as i64 > 1 << cube.log2_side {
            return false;
        }
        axis += 1;
    }
    true
}

for_each_arithmetic! {
    impl<'a> Octree<'a, A> {
        /// The tree in these words over so many shapes, in steps of 2^`log2_step`
        /// (−16 for fixed point, whatever is given).
        ///
        /// # Errors
        /// See [`validate`].
        pub const fn try_new(
            words: &'a [u32],
            shapes: usize,
            cube: &Cube,
            log2_step: i8,
        ) -> Result<Self, TreeError> {
            if let Err(error) = validate(words, shapes) {
                return Err(error);
            }
            let grid = match words.split_first() {
                Some((&word, _)) => Grid::read(word),
                None => Some(Grid::new([1; 3], 1)),
            };
            let Some(grid) = grid else { return Err(TreeError::Grid) };
            if !cube_fits(cube, log2_step, &grid) {
                return Err(TreeError::Cube);
            }
            let Some(width) = IdWidth::of(shapes) else { return Err(TreeError::TooManyShapes) };
            let (o, n, side) = (cube.origin, grid.cells, grid.side());
            Ok(Self {
                words,
                origin: [
                    make::from_grid(o[0], log2_step),
                    make::from_grid(o[1], log2_step),
                    make::from_grid(o[2], log2_step),
                ],
                sides: [
                    make::from_grid(side * n[0] as i32, log2_step),
                    make::from_grid(side * n[1] as i32, log2_step),
                    make::from_grid(side * n[2] as i32, log2_step),
                ],
                cell: make::from_grid(side, log2_step),
                per_cell: make::per_cell(grid.mantissa, grid.shift, log2_step),
                cells: n,
                unit: grid.shift - grid::LEAST_SHIFT,
                width,
                shapes: shapes as u32,
            })
        }

        /// The tree in a buffer, for `static`s.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error: for a step that is absurd.
        pub const fn of<const WORDS: usize>(
            buffer: &'a OctreeBuffer<WORDS>,
            log2_step: i8,
        ) -> Self {
            match Self::try_new(buffer.words(), buffer.shapes(), &buffer.built().cube, log2_step) {
                Ok(tree) => tree,
                Err(error) => panic!("{}", error.message()),
            }
        }
    }
}

impl<A: Arithmetic> Octree<'_, A> {
    /// How many shapes the tree is over.
    pub const fn shapes(&self) -> u32 {
        self.shapes
    }

    /// How many cells the grid has.
    fn count(&self) -> u32 {
        self.cells.iter().map(|n| u32::from(*n)).product()
    }

    /// Shows the visitor the shapes that the ray may meet nearer than the visitor's limit, about
    /// in the order of the ray.
    #[inline(always)]
    pub fn walk<V: Visitor<A>>(
        &self,
        origin: &[A::Length; 3],
        direction: &[A::Unit; 3],
        stack: &mut WalkStack<A>,
        visitor: &mut V,
    ) {
        let mut o = sub(origin, &self.origin);
        let mut d = *direction;
        let mut mirror = 0;
        for axis in 0..3 {
            if d[axis] < A::NO_UNIT {
                d[axis] = -d[axis];
                o[axis] = self.sides[axis] - o[axis];
                mirror |= 1 << axis;
            }
        }
        let pace = [A::pace(d[0]), A::pace(d[1]), A::pace(d[2])];
        let mut start = A::NO_LENGTH;
        for axis in 0..3 {
            if o[axis] < A::NO_LENGTH {
                let entry = A::takes(-o[axis], &pace[axis]);
                if entry > start {
                    start = entry;
                }
            }
        }
        let mut slack = A::NO_LENGTH;
        if start > A::NO_LENGTH {
            if start >= A::FAR {
                return;
            }
            slack = position_error::<A>(start);
            slack = slack + slack;
            start = start - slack;
            o = A::along(&o, start, &d);
        }
        // Where the hits are, distances are as wrong as the place where the ray enters.
        let back = start - slack;
        let mut bound = A::span(visitor.limit() - back, self.unit);
        if A::NO_SPAN > bound {
            return;
        }
        for axis in 0..3 {
            if o[axis] >= self.sides[axis] {
                return;
            }
        }
        // For each axis the exit of the cell that the ray starts in, and where the ray leaves the grid. One
        // axis after the other, and nothing to return for on the way: otherwise the compiler works out for
        // all axes at once what it can, and puts it by.
        let (mut exits, mut whole) = ([A::NO_SPAN; 3], [A::NO_SPAN; 3]);
        let [row, column, _] = self.cells.map(u32::from);
        // The place of the cell's word, and what a step adds to it.
        let mut place = 1u32;
        let mut steps = [1, row, row.wrapping_mul(column)];
        for axis in 0..3 {
            let last = u32::from(self.cells[axis]) - 1;
            let before = A::cells_before(o[axis], self.per_cell, last, self.unit);
            // Where the axis is mirrored: all ones, and the way leads back from the last cell.
            let flip = (mirror >> axis & 1u32).wrapping_neg();
            place = place.wrapping_add(last.wrapping_mul(steps[axis]) & flip);
            steps[axis] = (steps[axis] ^ flip).wrapping_sub(flip);
            place = place.wrapping_add(steps[axis].wrapping_mul(before));
            let left = A::cells_long(self.cell, before + 1) - o[axis];
            (exits[axis], whole[axis]) = A::spans(left, self.cell, &pace[axis], self.unit);
            // No later than the last cell's exit, so that no ray steps off the grid.
            let end = A::spans_on(exits[axis], whole[axis], last.wrapping_sub(before));
            if end < bound {
                bound = end;
            }
        }
        let [mut exit_x, mut exit_y, mut exit_z] = exits;
        let mut recent = [u32::MAX; RECENT];
        visitor.node();
        loop {
            visitor.step();
            debug_assert!((1..=self.count()).contains(&place), "off the grid");
            let Some(&below) = self.words.get(place as usize) else { return };
            if node::is_leaf(below) {
                if self.visit_leaf(below, &mut recent, back, &mut bound, visitor) {
                    return;
                }
            } else if below != node::EMPTY {
                let [grid, ..] = &mut stack.frames;
                grid.ends = [exit_x, exit_y, exit_z];
                // Where the cell is entered: the walk hasn't kept it.
                let mut entry = A::NO_SPAN;
                for axis in 0..3 {
                    let before = A::span_before(grid.ends[axis], whole[axis]);
                    entry = if before > entry { before } else { entry };
                }
                let way = Way { whole, back, mirror, entry, bound };
                match self.walk_below(below, way, &mut recent, stack, visitor) {
                    Some(nearer) => bound = nearer,
                    None => return,
                }
            }
            // On through the nearest face.
            if exit_x < exit_y && exit_x < exit_z {
                if exit_x >= bound {
                    return;
                }
                exit_x = exit_x + whole[0];
                place = place.wrapping_add(steps[0]);
            } else if exit_y < exit_z {
                if exit_y >= bound {
                    return;
                }
                exit_y = exit_y + whole[1];
                place = place.wrapping_add(steps[1]);
            } else {
                if exit_z >= bound {
                    return;
                }
                exit_z = exit_z + whole[2];
                place = place.wrapping_add(steps[2]);
            }
        }
    }

    /// The walk below a cell of the grid, whose exits are in the first frame. Gives the new bound, or
    /// nothing where the visitor wants to stop.
    #[inline(always)]
    fn walk_below<V: Visitor<A>>(
        &self,
        mut word: u32,
        Way { whole, back, mirror, mut entry, mut bound }: Way<A>,
        recent: &mut [u32; RECENT],
        stack: &mut WalkStack<A>,
        visitor: &mut V,
    ) -> Option<A::Span> {
        let mut level = 0;
        loop {
            // The node of this word is entered.
            visitor.node();
            let [above, frame, ..] = stack.frames.get_mut(level..)? else { return None };
            level += 1;
            let mut number = 0;
            for axis in 0..3 {
                let middle = above.ends[axis] - A::halved(whole[axis], level as u32);
                let upper = middle <= entry;
                number |= u32::from(upper) << axis;
                frame.ends[axis] = if upper { above.ends[axis] } else { middle };
            }
            frame.word = word;
            loop {
                visitor.step();
                if let Some(index) = node::child(word, number ^ mirror) {
                    let &below = self.words.get(index)?;
                    if !node::is_leaf(below) {
                        stack.frames.get_mut(level)?.number = number;
                        word = below;
                        break;
                    }
                    if self.visit_leaf(below, recent, back, &mut bound, visitor) {
                        return None;
                    }
                }
                // On to the next child, of this node or of one above.
                let frame = stack.frames.get(level)?;
                let mut axis = 0;
                entry = frame.ends[0];
                if frame.ends[1] < entry {
                    (entry, axis) = (frame.ends[1], 1);
                }
                if frame.ends[2] < entry {
                    (entry, axis) = (frame.ends[2], 2);
                }
                if entry >= bound {
                    return None;
                }
                while number & 1 << axis != 0 {
                    level -= 1;
                    let frame = stack.frames.get(level)?;
                    (word, number) = (frame.word, frame.number);
                }
                number |= 1 << axis;
                // The cell of the grid is left, across the same face as its child.
                let Some(level_above) = level.checked_sub(1) else { return Some(bound) };
                let [above, frame, ..] = stack.frames.get_mut(level_above..)? else { return None };
                frame.ends[axis] = above.ends[axis];
            }
        }
    }

    /// Visits the ids of a leaf, and says whether the visitor wants to stop.
    #[inline(always)]
    fn visit_leaf<V: Visitor<A>>(
        &self,
        leaf: u32,
        recent: &mut [u32; RECENT],
        back: A::Length,
        bound: &mut A::Span,
        visitor: &mut V,
    ) -> bool {
        let (mut word, mut place) = (leaf, 0);
        if let Some(start) = node::run(leaf) {
            let Some(&first) = self.words.get(start) else { return false };
            (word, place) = (first, start);
        }
        loop {
            let mut ids = self.width.ids(word);
            while let Some(id) = ids.next() {
                // Large shapes lie in many cells.
                if id != recent[id as usize % RECENT] {
                    recent[id as usize % RECENT] = id;
                    let before = visitor.limit();
                    if visitor.visit(id) {
                        return true;
                    }
                    // Without a hit nothing is left of this.
                    let limit = visitor.limit();
                    if limit < before {
                        let limit = A::span(limit - back, self.unit);
                        *bound = if limit < *bound { limit } else { *bound };
                    }
                }
            }
            // A leaf whose ids are inline isn't continued.
            if !node::continues(word) {
                return false;
            }
            place += 1;
            let Some(&next) = self.words.get(place) else { return false };
            word = next;
        }
    }
}

/// What a position may be wrong that was reached over the distance `t`.
#[inline(always)]
fn position_error<A: Arithmetic>(t: A::Length) -> A::Length {
    let ahead = [A::ONE_UNIT, A::NO_UNIT, A::NO_UNIT];
    A::leave(&[A::NO_LENGTH; 3], &ahead, t)[0]
}

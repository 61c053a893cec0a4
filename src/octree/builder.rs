//! Building a tree: whole numbers alone, in memory of fixed size, at compile time or run time.
//!
//! A cell is cut where that is expected to make rays cheaper (greedily, after MacDonald and
//! Booth, "Heuristics for ray tracing using space subdivision", 1990): a ray that crosses a cell
//! crosses an octant with the probability ¼, the ratio of their surfaces, so two octants on
//! average.
//!
//! **Margin.** A walk is less exact than a shape's own test, so shapes are listed in all cells
//! they come near. With a fixed-point walk, in 2⁻¹⁶ of the side: a position is rounded to 1;
//! quotients are 1 wrong; halving a span loses at most 1 a level where the ray is fast, and a
//! component below 2⁻¹⁴ is taken for 2⁻¹⁴, which drifts by up to √3·4 = 7 where it is slow; a
//! sphere's test keeps sixteen bits of the radius, 2. Together less than 16, side·2⁻¹². The test
//! of a small sphere and the rounding of an extent add a few steps: 8.

use super::Extent;
use super::node::{self, IdWidth, MAX_LEVELS, ROOM};
use super::overlap::{Cell, bounds};
use core::fmt;

/// Cycles on a Cortex-M0+ for an inner node, a step to a child, and a shape's test: their
/// proportions decide where a cell is cut.
const NODE_COST: usize = 150;
const STEP_COST: usize = 110;
const TEST_COST: usize = 170;

/// What rounding adds to an extent and to a test of it, in steps.
const MARGIN_STEPS: i32 = 8;

/// The smallest side is 2¹⁶ steps: fixed-point spans have 16 fraction bits.
pub(super) const LEAST_LOG2_SIDE: u8 = 16;
/// The largest is 2²⁹.
pub(super) const MOST_LOG2_SIDE: u8 = 29;
/// Coordinates are within ±2²⁷, twice the range of fixed-point positions.
const REACH: i32 = 1 << 27;

/// How far to go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// So many levels below the root, at most [`MAX_LEVELS`].
    pub levels: u8,
    /// A cell of so many shapes or fewer is never cut.
    pub leaf: u8,
    /// Cells are enlarged by 2^−precision of the cube's side, at most 24. Fixed point needs 12;
    /// floats can do with 16, unless rays start hundreds of sides away.
    pub precision: u8,
}

impl Limits {
    /// Good for all arithmetics: ten levels (where the margin is a quarter of a cell), leaves as
    /// the cost wants them.
    pub const DEFAULT: Self = Self { levels: 10, leaf: 2, precision: 12 };
}

impl Default for Limits {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// The cube that a tree divides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cube {
    /// The smallest coordinates, in steps of the grid.
    pub origin: [i32; 3],
    /// The side is 2 to this power, in steps.
    pub log2_side: u8,
}

/// What was built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Built {
    /// Words used.
    pub words: usize,
    /// Words of scratch used.
    pub scratch: usize,
    /// Levels below the root.
    pub levels: u8,
    /// The cube.
    pub cube: Cube,
}

/// Why a tree can't be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum BuildError {
    /// The words don't suffice.
    Words,
    /// The scratch memory doesn't suffice.
    Scratch,
    /// A shape reaches beyond ±2²⁷ steps, or its numbers make no sense.
    Extent,
    /// More shapes than there are ids.
    TooManyShapes,
}

impl BuildError {
    /// What is wrong, in words: for `const` panics and logs.
    pub const fn message(self) -> &'static str {
        match self {
            Self::Words => "too few words for the octree",
            Self::Scratch => "too little scratch memory to build the octree",
            Self::Extent => "a shape is out of the octree's range",
            Self::TooManyShapes => "an octree holds at most 8388607 shapes",
        }
    }
}

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.message())
    }
}

impl core::error::Error for BuildError {}

const fn margin(log2_side: u8, precision: u8) -> i32 {
    let precision = if precision > 24 { 24 } else { precision };
    ((1 << log2_side) >> precision) + MARGIN_STEPS
}

/// The smallest cube that holds all extents and the margin around them, centred on them.
const fn cube_of(extents: &[Extent], precision: u8) -> Result<Cube, BuildError> {
    let (mut min, mut max) = ([i32::MAX; 3], [i32::MIN; 3]);
    let mut i = 0;
    while i < extents.len() {
        if !in_range(&extents[i]) {
            return Err(BuildError::Extent);
        }
        let (low, high) = bounds(&extents[i]);
        let mut axis = 0;
        while axis < 3 {
            if low[axis] < min[axis] {
                min[axis] = low[axis];
            }
            if high[axis] > max[axis] {
                max[axis] = high[axis];
            }
            axis += 1;
        }
        i += 1;
    }
    if extents.is_empty() {
        (min, max) = ([0; 3], [0; 3]);
    }
    let size = [max[0] - min[0], max[1] - min[1], max[2] - min[2]];
    let mut largest = if size[0] > size[1] { size[0] } else { size[1] };
    if size[2] > largest {
        largest = size[2];
    }
    let mut log2_side = LEAST_LOG2_SIDE;
    while (1 << log2_side) < largest + 2 * margin(log2_side, precision) {
        log2_side += 1;
        if log2_side > MOST_LOG2_SIDE {
            return Err(BuildError::Extent);
        }
    }
    let mut origin = min;
    let mut axis = 0;
    while axis < 3 {
        origin[axis] -= ((1 << log2_side) - size[axis]) >> 1;
        axis += 1;
    }
    Ok(Cube { origin, log2_side })
}

const fn in_range(extent: &Extent) -> bool {
    // before anything is added up
    if let Extent::Round { ends, radii, .. } = extent {
        let mut i = 0;
        while i < 6 {
            let x = ends[i / 3][i % 3];
            let r = radii[i / 3];
            if x < -REACH || x > REACH || r < 0 || r > REACH {
                return false;
            }
            i += 1;
        }
    }
    if let Extent::Sphere { center, radius } = extent {
        let mut axis = 0;
        while axis < 3 {
            if center[axis] < -REACH || center[axis] > REACH {
                return false;
            }
            axis += 1;
        }
        if *radius < 0 || *radius > REACH {
            return false;
        }
    }
    let (min, max) = bounds(extent);
    let mut axis = 0;
    while axis < 3 {
        if min[axis] < -REACH || max[axis] > REACH || min[axis] > max[axis] {
            return false;
        }
        axis += 1;
    }
    true
}

/// A list of ids in the scratch memory: `start..end`.
#[derive(Clone, Copy)]
struct List {
    start: usize,
    end: usize,
}

/// An inner node whose children are being made. Each id of its list has the octants it meets in
/// the highest byte.
#[derive(Clone, Copy)]
struct Parent {
    min: [i32; 3],
    list: List,
    children: u32,
    next: u32,
    /// Where the next child's word goes.
    slot: usize,
}

const ID: u32 = (1 << 24) - 1;

/// Sets a word, if it is there.
const fn set(words: &mut [u32], index: usize, word: u32) {
    if index < words.len() {
        words[index] = word;
    }
}

const fn octants(cell: &Cell, extents: &[Extent], id: u32) -> u32 {
    if (id as usize) < extents.len() { cell.octants(&extents[id as usize]) as u32 } else { 0 }
}

/// Notes beside each id the octants it meets, and decides whether to cut the cell: its children,
/// or 0.
const fn cut(extents: &[Extent], scratch: &mut [u32], list: List, cell: &Cell) -> u32 {
    let (mut children, mut entries) = (0, 0);
    let mut i = list.start;
    while i < list.end {
        let id = node::word(scratch, i) & ID;
        let octants = octants(cell, extents, id);
        children |= octants;
        entries += node::population(octants) as usize;
        set(scratch, i, octants << 24 | id);
        i += 1;
    }
    let whole = (list.end - list.start) * TEST_COST;
    let parts = NODE_COST + 2 * STEP_COST + entries * TEST_COST / 4;
    if parts < whole { children } else { 0 }
}

/// Writes a leaf to `slot`, with its run if it needs one, and gives the new number of words.
const fn write_leaf(
    words: &mut [u32],
    mut used: usize,
    slot: usize,
    ids: &[u32],
    list: List,
    width: IdWidth,
) -> Result<usize, BuildError> {
    let mut left = list.end - list.start;
    let inline = left <= width.per_word();
    if !inline {
        set(words, slot, node::leaf_of_run(used));
    }
    let mut next = list.start;
    while left > 0 {
        let count = if left > width.per_word() { width.per_word() } else { left };
        left -= count;
        let mut word = width.empty(left > 0);
        let mut i = 0;
        while i < count {
            word = width.with(word, i, node::word(ids, next) & ID);
            next += 1;
            i += 1;
        }
        if inline {
            set(words, slot, word);
        } else {
            if used >= words.len() {
                return Err(BuildError::Words);
            }
            set(words, used, word);
            used += 1;
        }
    }
    Ok(used)
}

/// Builds the tree over the extents, whose ids are their indices.
///
/// Five words a shape are the rule, and three words of scratch; both depend on how the shapes
/// lie, and never more than `levels + 1` words of scratch a shape are needed.
///
/// # Errors
/// A shape out of range, or too little memory.
pub const fn build_into(
    extents: &[Extent],
    words: &mut [u32],
    scratch: &mut [u32],
    limits: Limits,
) -> Result<Built, BuildError> {
    let cube = match cube_of(extents, limits.precision) {
        Ok(cube) => cube,
        Err(error) => return Err(error),
    };
    let Some(width) = IdWidth::of(extents.len()) else { return Err(BuildError::TooManyShapes) };
    let mut built = Built { words: 0, scratch: extents.len(), levels: 0, cube };
    if extents.is_empty() {
        return Ok(built);
    }
    if words.is_empty() {
        return Err(BuildError::Words);
    }
    if scratch.len() < extents.len() {
        return Err(BuildError::Scratch);
    }
    let mut list = List { start: 0, end: extents.len() };
    while list.start < list.end {
        set(scratch, list.start, list.start as u32);
        list.start += 1;
    }
    list.start = 0;

    let levels =
        if limits.levels as usize > MAX_LEVELS { MAX_LEVELS } else { limits.levels as usize };
    let margin = margin(cube.log2_side, limits.precision);
    let nobody = Parent { min: cube.origin, list, children: 0, next: 0, slot: 0 };
    let mut parents = [nobody; ROOM];
    let (mut min, mut level, mut slot, mut used) = (cube.origin, 0, 0, 1);
    loop {
        let half = 1 << (cube.log2_side as usize - level - 1);
        let children = if level < levels && list.end - list.start > limits.leaf as usize {
            cut(extents, scratch, list, &Cell { min, half, margin })
        } else {
            0
        };
        if children != 0 {
            let row = used;
            used += node::population(children) as usize;
            if used > words.len() {
                return Err(BuildError::Words);
            }
            let Some(word) = node::inner(children, row) else { return Err(BuildError::Words) };
            set(words, slot, word);
            parents[level % ROOM] = Parent { min, list, children, next: 0, slot: row };
            level += 1;
            if level > built.levels as usize {
                built.levels = level as u8;
            }
        } else {
            used = match write_leaf(words, used, slot, scratch, list, width) {
                Ok(used) => used,
                Err(error) => return Err(error),
            };
        }
        // The next child of the innermost parent that has one.
        let octant = loop {
            if level == 0 {
                built.words = used;
                return Ok(built);
            }
            let parent = &mut parents[(level - 1) % ROOM];
            let octant = parent.next;
            if parent.children >> octant == 0 {
                level -= 1;
                continue;
            }
            parent.next += 1;
            if parent.children >> octant & 1 != 0 {
                break octant;
            }
        };
        let parent = &mut parents[(level - 1) % ROOM];
        slot = parent.slot;
        parent.slot += 1;
        min = parent.min;
        let side = 1 << (cube.log2_side as usize - level);
        let mut axis = 0;
        while axis < 3 {
            min[axis] += (octant as i32 >> axis & 1) * side;
            axis += 1;
        }
        list = List { start: parent.list.end, end: parent.list.end };
        let mut i = parent.list.start;
        while i < parent.list.end {
            let entry = node::word(scratch, i);
            if entry >> 24 >> octant & 1 != 0 {
                if list.end >= scratch.len() {
                    return Err(BuildError::Scratch);
                }
                set(scratch, list.end, entry & ID);
                list.end += 1;
            }
            i += 1;
        }
        if list.end > built.scratch {
            built.scratch = list.end;
        }
    }
}

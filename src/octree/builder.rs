//! Building a tree: whole numbers alone, in memory of fixed size, at compile time or run time.
//!
//! The grid at the root is as fine as makes rays cheap where shapes lie evenly: a ray that crosses the
//! grid crosses a cell with a probability that is the ratio of their surfaces, and of each shape as many
//! copies are expected as its box is larger than a cell.
//!
//! A cell is cut where that is expected to make rays cheaper (greedily, after MacDonald and
//! Booth, "Heuristics for ray tracing using space subdivision", 1990): a ray that crosses a cell
//! crosses an octant with the probability ¼, the ratio of their surfaces, so two octants on
//! average.
//!
//! **Margin.** A walk is less exact than a shape's own test, so shapes are listed in all cells
//! they come near. With a fixed-point walk, in 2⁻¹⁴ of a cell's side (or up to half of that): a position
//! is rounded to 1; a sphere's test keeps sixteen bits of the radius, 2. Where the ray is fast, quotients
//! are 1 wrong, and what eight cells' quotients add up to 7; their relative error is 2; halving a span loses
//! at most 1 a level. Where it is slow, a component below 9·2⁻¹⁷ is taken for that, which drifts by up to
//! √3·9 = 16. Either way it is less than 32. The test of a small sphere and the rounding of an extent add a
//! few steps: 8.

use super::Extent;
use super::node::{self, Grid, IdWidth, MAX_CELLS, MAX_LEVELS, ROOM};
use super::overlap::{Cell, bounds};
use core::fmt;

/// Cycles on a Cortex-M0+, roughly: for a cell of the grid, for an inner node, for a step to a child,
/// and for the test of a sphere or of another shape, most of which miss. Their proportions decide how fine
/// the grid is and where a cell is cut.
const CELL_COST: usize = 80;
const NODE_COST: usize = 150;
const STEP_COST: usize = 110;
const SPHERE_COST: usize = 150;
const TEST_COST: usize = 300;

/// What rounding adds to an extent and to a test of it, in steps.
const MARGIN_STEPS: i32 = 8;

/// The smallest side is 2¹⁶ steps.
pub(super) const LEAST_LOG2_SIDE: u8 = 16;
/// The largest is 2²⁹.
pub(super) const MOST_LOG2_SIDE: u8 = 29;
/// Coordinates are within ±2²⁷, twice the range of fixed-point positions.
const REACH: i32 = 1 << 27;

/// How far to go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// So many levels; the grid counts as those that it stands for, up to three. Below it there are at
    /// most [`MAX_LEVELS`].
    pub levels: u8,
    /// A cell of so many shapes or fewer is never cut.
    pub leaf: u8,
    /// Cells are enlarged by 2^−precision of what eight cells of the grid span, up to twice that; 6 to 24,
    /// and what lies beyond counts as these. Fixed point needs 12; floats can do with 16, unless rays start
    /// hundreds of sides away.
    pub precision: u8,
}

impl Limits {
    /// Good for all arithmetics: ten levels (where the margin is a quarter of a cell or more), leaves as
    /// the cost wants them.
    pub const DEFAULT: Self = Self { levels: 10, leaf: 2, precision: 12 };
}

impl Default for Limits {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// The cube that a tree lies in: the grid starts at its smallest coordinates, and may be shorter.
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
    /// Levels, those that the grid stands for among them.
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

/// By how much cells are enlarged: by a quarter at most, so that a grid of one cell holds all shapes and
/// the margin around them.
const fn margin(grid: &Grid, precision: u8) -> i32 {
    let precision = if precision > 24 {
        24
    } else if precision < 6 {
        6
    } else {
        precision
    };
    ((1i64 << (grid.shift + 11)) >> precision) as i32 + MARGIN_STEPS
}

/// The box around all extents.
const fn bounds_of(extents: &[Extent]) -> Result<([i32; 3], [i32; 3]), BuildError> {
    if extents.is_empty() {
        return Ok(([0; 3], [0; 3]));
    }
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
    Ok((min, max))
}

/// How large the shapes' boxes are together, a unit being 2^`shift` steps, each as often as its test
/// costs.
struct Sizes {
    shift: u32,
    costs: u64,
    lengths: u64,
    areas: u64,
    volumes: u64,
}

impl Sizes {
    /// Nine bits are left of the largest size, and of the least side of a cell: the cube of a side times
    /// eight million costs fits 64 bits.
    const fn of(extents: &[Extent], largest: i32) -> Self {
        let least = Grid::new([1; 3], 1).side();
        let (largest, mut shift) = (if largest > least { largest } else { least }, 0);
        while largest >> shift > 1 << 9 {
            shift += 1;
        }
        let mut all = Self { shift, costs: 0, lengths: 0, areas: 0, volumes: 0 };
        let mut i = 0;
        while i < extents.len() {
            let (low, high) = bounds(&extents[i]);
            let x = ((high[0] - low[0]) >> shift) as u32 + 1;
            let y = ((high[1] - low[1]) >> shift) as u32 + 1;
            let z = ((high[2] - low[2]) >> shift) as u32 + 1;
            let cost = test_cost(extents, i) as u64;
            all.costs += cost;
            all.lengths += cost * (x + y + z) as u64;
            all.areas += cost * (x * y + y * z + z * x) as u64;
            all.volumes += cost * (x * y) as u64 * z as u64;
            i += 1;
        }
        all
    }

    /// What testing all shapes in all cells of this side costs, times 16.
    const fn tests(&self, side: i32) -> u64 {
        let side = (side >> self.shift) as u64 + 1;
        let all = ((self.costs * side + self.lengths) * side + self.areas) * side + self.volumes;
        match all.checked_div((side * side * side) >> 4) {
            Some(tests) => tests,
            None => all,
        }
    }
}

/// The cheapest grid around a box of this size, with no more than `most` cells along an axis.
const fn grid_of(extents: &[Extent], size: &[i32; 3], most: usize, precision: u8) -> Grid {
    let mut largest = if size[0] > size[1] { size[0] } else { size[1] };
    if size[2] > largest {
        largest = size[2];
    }
    let sizes = Sizes::of(extents, largest);
    let mut best = Grid::new([1; 3], 1);
    let mut least = u64::MAX;
    let mut n = 1;
    while n <= most as i32 {
        // The margin depends on the cells' side.
        let mut grid = Grid::new([1; 3], 1);
        let mut need = largest + 2 * margin(&grid, precision);
        while (n as i64 * grid.side() as i64) < need as i64 && grid.shift < node::MOST_SHIFT {
            let side = (need - 1) / n + 1;
            grid = Grid::new([1; 3], side);
            need = largest + 2 * margin(&grid, precision);
        }
        let mut axis = 0;
        while axis < 3 {
            let need = size[axis] + 2 * margin(&grid, precision);
            while (grid.cells[axis] as i64 * grid.side() as i64) < need as i64
                && grid.cells[axis] < MAX_CELLS as u8
            {
                grid.cells[axis] += 1;
            }
            axis += 1;
        }
        let [x, y, z] = [grid.cells[0] as u64, grid.cells[1] as u64, grid.cells[2] as u64];
        let all = 16 * x * y * z * CELL_COST as u64 + sizes.tests(grid.side());
        let cost = match (3 * all).checked_div(x * y + y * z + z * x) {
            Some(cost) => cost,
            None => all,
        };
        if cost < least {
            (best, least) = (grid, cost);
        }
        n += 1;
    }
    best
}

/// The cube that holds the grid, centred on the box from `min` of this size.
const fn cube_of(grid: &Grid, min: &[i32; 3], size: &[i32; 3]) -> Result<Cube, BuildError> {
    let (mut origin, mut log2_side) = (*min, LEAST_LOG2_SIDE);
    let mut axis = 0;
    while axis < 3 {
        let length = grid.cells[axis] as i64 * grid.side() as i64;
        while 1i64 << log2_side < length {
            log2_side += 1;
        }
        origin[axis] -= ((length - size[axis] as i64) >> 1) as i32;
        axis += 1;
    }
    if log2_side > MOST_LOG2_SIDE {
        return Err(BuildError::Extent);
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

/// A row or an inner node whose children are being made. Each id of its list has the children that it
/// meets in the highest byte.
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

/// What a test of this shape costs.
const fn test_cost(extents: &[Extent], id: usize) -> usize {
    if id < extents.len() && matches!(extents[id], Extent::Sphere { .. }) {
        SPHERE_COST
    } else {
        TEST_COST
    }
}

/// Notes beside each id the octants it meets, and decides whether to cut the cell: its children,
/// or 0.
const fn cut(extents: &[Extent], scratch: &mut [u32], list: List, cell: &Cell) -> u32 {
    let (mut children, mut whole, mut parts) = (0, 0, 0);
    let mut i = list.start;
    while i < list.end {
        let id = node::word(scratch, i) & ID;
        let octants = octants(cell, extents, id);
        children |= octants;
        let test = test_cost(extents, id as usize);
        whole += test;
        parts += node::population(octants) as usize * test;
        set(scratch, i, octants << 24 | id);
        i += 1;
    }
    if NODE_COST + 2 * STEP_COST + parts / 4 < whole { children } else { 0 }
}

/// Lists those ids whose shapes' boxes meet a slab, of all or of a list; behind the end of that.
const fn within(
    extents: &[Extent],
    scratch: &mut [u32],
    of: Option<List>,
    axis: usize,
    (low, high): (i32, i32),
) -> Result<List, BuildError> {
    let (start, end) = match of {
        Some(list) => (list.start, list.end),
        None => (0, extents.len()),
    };
    let mut list = if of.is_some() { List { start: end, end } } else { List { start: 0, end: 0 } };
    let mut i = start;
    while i < end {
        let id = if of.is_some() { node::word(scratch, i) & ID } else { i as u32 };
        if (id as usize) < extents.len() {
            let (min, max) = bounds(&extents[id as usize]);
            if max[axis] >= low && min[axis] <= high {
                if list.end >= scratch.len() {
                    return Err(BuildError::Scratch);
                }
                set(scratch, list.end, id);
                list.end += 1;
            }
        }
        i += 1;
    }
    Ok(list)
}

/// Notes beside each id the cells of a row that it meets, and gives all that any does.
const fn fill(
    extents: &[Extent],
    scratch: &mut [u32],
    list: List,
    grid: &Grid,
    (min, margin): (&[i32; 3], i32),
) -> u32 {
    let mut all = 0;
    let mut i = list.start;
    while i < list.end {
        let id = node::word(scratch, i) & ID;
        let mut cells = 0;
        let mut x = 0;
        while x < grid.cells[0] as u32 && (id as usize) < extents.len() {
            // Two neighbours are two octants.
            let min = [min[0] + x as i32 * grid.side(), min[1], min[2]];
            let pair = Cell { min, half: grid.side(), margin };
            cells |= (pair.octants_of(&extents[id as usize], 3) as u32) << x;
            x += 2;
        }
        cells &= (1 << grid.cells[0]) - 1;
        all |= cells;
        set(scratch, i, cells << 24 | id);
        i += 1;
    }
    all
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
/// Eight words a shape are the rule, and four words of scratch; both depend on how the shapes
/// lie, and never more than `levels + 3` words of scratch a shape are needed.
///
/// # Errors
/// A shape out of range, or too little memory.
pub const fn build_into(
    extents: &[Extent],
    words: &mut [u32],
    scratch: &mut [u32],
    limits: Limits,
) -> Result<Built, BuildError> {
    let (min, max) = match bounds_of(extents) {
        Ok(bounds) => bounds,
        Err(error) => return Err(error),
    };
    let size = [max[0] - min[0], max[1] - min[1], max[2] - min[2]];
    let most = if extents.len() <= limits.leaf as usize {
        1
    } else if limits.levels < 3 {
        1 << limits.levels
    } else {
        MAX_CELLS
    };
    let grid = grid_of(extents, &size, most, limits.precision);
    let cube = match cube_of(&grid, &min, &size) {
        Ok(cube) => cube,
        Err(error) => return Err(error),
    };
    let Some(width) = IdWidth::of(extents.len()) else { return Err(BuildError::TooManyShapes) };
    let mut built = Built { words: 0, scratch: 0, levels: 0, cube };
    if extents.is_empty() {
        return Ok(built);
    }
    if words.len() <= grid.rows() {
        return Err(BuildError::Words);
    }
    set(words, 0, grid.word());
    let mut used = 1 + grid.rows();
    built.levels = grid.levels();

    // Levels below the grid's cells.
    let mut levels = limits.levels.saturating_sub(grid.levels());
    if levels as usize > MAX_LEVELS {
        levels = MAX_LEVELS as u8;
    }
    // A side that can't be halved exactly isn't.
    if levels > grid.shift {
        levels = grid.shift;
    }
    let margin = margin(&grid, limits.precision);
    let nobody = List { start: 0, end: 0 };
    let nobody = Parent { min: cube.origin, list: nobody, children: 0, next: 0, slot: 0 };
    let mut parents = [nobody; ROOM];
    let (mut row, mut slab) = (0, nobody.list);
    while row < grid.rows() {
        let y = row % grid.cells[1] as usize;
        let z = row / grid.cells[1] as usize;
        let mut min = cube.origin;
        min[1] += y as i32 * grid.side();
        min[2] += z as i32 * grid.side();
        let reach = grid.side() + margin;
        if y == 0 {
            slab = match within(extents, scratch, None, 2, (min[2] - margin, min[2] + reach)) {
                Ok(list) => list,
                Err(error) => return Err(error),
            };
        }
        let list = match within(extents, scratch, Some(slab), 1, (min[1] - margin, min[1] + reach))
        {
            Ok(list) => list,
            Err(error) => return Err(error),
        };
        if list.end > built.scratch {
            built.scratch = list.end;
        }
        let children = fill(extents, scratch, list, &grid, (&min, margin));
        let Some(word) = node::inner(children, used) else { return Err(BuildError::Words) };
        row += 1;
        set(words, row, word);
        parents[0] = Parent { min, list, children, next: 0, slot: used };
        used += node::population(children) as usize;
        if used > words.len() {
            return Err(BuildError::Words);
        }
        let mut level = 1;
        while level > 0 {
            // The next child of the innermost parent.
            let parent = &mut parents[(level - 1) % ROOM];
            let child = parent.next;
            if parent.children >> child == 0 {
                level -= 1;
                continue;
            }
            parent.next += 1;
            if parent.children >> child & 1 == 0 {
                continue;
            }
            let slot = parent.slot;
            parent.slot += 1;
            let side = grid.side() >> (level - 1);
            let mut min = parent.min;
            if level == 1 {
                min[0] += child as i32 * side;
            } else {
                let mut axis = 0;
                while axis < 3 {
                    min[axis] += (child as i32 >> axis & 1) * side;
                    axis += 1;
                }
            }
            let mut list = List { start: parent.list.end, end: parent.list.end };
            let mut i = parent.list.start;
            while i < parent.list.end {
                let entry = node::word(scratch, i);
                if entry >> 24 >> child & 1 != 0 {
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
            let children =
                if level <= levels as usize && list.end - list.start > limits.leaf as usize {
                    cut(extents, scratch, list, &Cell { min, half: side >> 1, margin })
                } else {
                    0
                };
            if children == 0 {
                used = match write_leaf(words, used, slot, scratch, list, width) {
                    Ok(used) => used,
                    Err(error) => return Err(error),
                };
                continue;
            }
            let Some(word) = node::inner(children, used) else { return Err(BuildError::Words) };
            set(words, slot, word);
            parents[level % ROOM] = Parent { min, list, children, next: 0, slot: used };
            used += node::population(children) as usize;
            if used > words.len() {
                return Err(BuildError::Words);
            }
            level += 1;
            if built.levels as usize + 1 < level + grid.levels() as usize {
                built.levels = (level - 1) as u8 + grid.levels();
            }
        }
    }
    built.words = used;
    Ok(built)
}

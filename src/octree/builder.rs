//! Building a tree: whole numbers alone, in memory of fixed size, at compile time or run time.
//!
//! A cell is cut where that is expected to make rays cheaper (greedily, after MacDonald and
//! Booth, "Heuristics for ray tracing using space subdivision", 1990): a ray that crosses a cell
//! crosses an octant with the probability ¼, the ratio of their surfaces, so two octants on
//! average.

use super::Extent;
use super::grid::{Grid, MAX_CELLS, grid_of, margin, test_cost};
use super::limits::{BuildError, Built, Cube, Limits};
use super::node::{self, IdWidth, MAX_LEVELS, ROOM};
use super::overlap::{Cell, bounds};

/// Cycles on a Cortex-M0+, roughly: for an inner node, and for a step to a child. With what tests cost they
/// decide where a cell is cut.
const NODE_COST: usize = 150;
const STEP_COST: usize = 110;

/// The smallest side is 2¹⁶ steps.
pub(super) const LEAST_LOG2_SIDE: u8 = 16;
/// The largest is 2²⁹.
pub(super) const MOST_LOG2_SIDE: u8 = 29;
/// Coordinates are within ±2²⁷, twice the range of fixed-point positions.
const REACH: i32 = 1 << 27;

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
/// Eight words a shape are the rule, besides one for each cell of the grid, and four words of scratch;
/// both depend on how the shapes lie, and never more than `levels + 3` words of scratch a shape are needed.
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
    if words.len() <= grid.count() {
        return Err(BuildError::Words);
    }
    set(words, 0, grid.word());
    let mut used = 1 + grid.count();
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
        // The row's cells are like the children of a node, but all have words.
        parents[0] =
            Parent { min, list, children, next: 0, slot: 1 + row * grid.cells[0] as usize };
        row += 1;
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
                if level == 1 {
                    set(words, parent.slot, node::EMPTY);
                    parent.slot += 1;
                }
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

//! The grid at the root: its word, and how fine it is.
//!
//! It is as fine as makes rays cheap where shapes lie evenly: a ray that crosses the grid crosses a cell
//! with a probability that is the ratio of their surfaces, and of each shape as many copies are expected as
//! its box is larger than a cell.
//!
//! **Margin.** A walk is less exact than a shape's own test, so shapes are listed in all cells
//! they come near. With a fixed-point walk, in 2⁻¹⁴ of a cell's side (or up to half of that): a position
//! is rounded to 1; a sphere's test keeps sixteen bits of the radius, 2. Where the ray is fast, quotients
//! are 1 wrong, and what eight cells' quotients add up to 7; their relative error is 2; halving a span loses
//! at most 1 a level. Where it is slow, a component below 9·2⁻¹⁷ is taken for that, which drifts by up to
//! √3·9 = 16. Either way it is less than 32. The test of a small sphere and the rounding of an extent add a
//! few steps: 8.

use super::Extent;
use super::overlap::bounds;

/// The grid has no more cells along an axis: three bits of the root's word.
pub(super) const MAX_CELLS: usize = 8;

/// Cycles on a Cortex-M0+, roughly: for a cell of the grid, its leaf among them, and for the test of a sphere
/// or of another shape, most of which miss. Of a sphere's copies every third has been tested already.
const CELL_COST: usize = 110;
const SPHERE_COST: usize = 90;
const TEST_COST: usize = 300;

/// What rounding adds to an extent and to a test of it, in steps.
const MARGIN_STEPS: i32 = 8;

/// The root: so many cells along each axis, all cubes of one side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Grid {
    pub(super) cells: [u8; 3],
    /// A cell's side is `mantissa << shift` steps, the mantissa's highest bit set.
    pub(super) mantissa: u8,
    pub(super) shift: u8,
}

/// A cell's side has at least so many trailing zeros: it can be halved as often.
pub(super) const LEAST_SHIFT: u8 = 6;
pub(super) const MOST_SHIFT: u8 = 22;

impl Grid {
    /// So many cells of the side, which is rounded up.
    pub(super) const fn new(cells: [u8; 3], side: i32) -> Self {
        let mut shift = LEAST_SHIFT;
        while shift < MOST_SHIFT && ((side - 1) >> shift) + 1 > 0xff {
            shift += 1;
        }
        let mut mantissa = ((side - 1) >> shift) + 1;
        mantissa = if mantissa < 0x80 { 0x80 } else { mantissa };
        Self { cells, mantissa: if mantissa > 0xff { 0xff } else { mantissa as u8 }, shift }
    }

    /// A cell's side, in steps.
    pub(super) const fn side(&self) -> i32 {
        (self.mantissa as i32) << self.shift
    }

    /// The word of this grid.
    pub(super) const fn word(&self) -> u32 {
        let [x, y, z] = self.cells;
        (x as u32 - 1)
            | (y as u32 - 1) << 3
            | (z as u32 - 1) << 6
            | (self.mantissa as u32) << 9
            | (self.shift as u32) << 17
    }

    /// The grid of a word, if it is one.
    pub(super) const fn read(word: u32) -> Option<Self> {
        let cells = [1 + (word & 7) as u8, 1 + (word >> 3 & 7) as u8, 1 + (word >> 6 & 7) as u8];
        let (mantissa, shift) = ((word >> 9) as u8, (word >> 17 & 31) as u8);
        if word >> 22 != 0 || mantissa < 0x80 || shift < LEAST_SHIFT || shift > MOST_SHIFT {
            return None;
        }
        Some(Self { cells, mantissa, shift })
    }

    /// How many rows there are.
    pub(super) const fn rows(&self) -> usize {
        self.cells[1] as usize * self.cells[2] as usize
    }

    /// How many cells there are.
    pub(super) const fn count(&self) -> usize {
        self.cells[0] as usize * self.rows()
    }

    /// How often a cube would have to be halved for such cells.
    pub(super) const fn levels(&self) -> u8 {
        let [x, y, z] = self.cells;
        let most = (x - 1) | (y - 1) | (z - 1);
        8 - most.leading_zeros() as u8
    }
}

/// By how much cells are enlarged: by a quarter at most, so that a grid of one cell holds all shapes and
/// the margin around them.
pub(super) const fn margin(grid: &Grid, precision: u8) -> i32 {
    let precision = if precision > 24 {
        24
    } else if precision < 6 {
        6
    } else {
        precision
    };
    ((1i64 << (grid.shift + 11)) >> precision) as i32 + MARGIN_STEPS
}

/// What a test of this shape costs.
pub(super) const fn test_cost(extents: &[Extent], id: usize) -> usize {
    if id < extents.len() && matches!(extents[id], Extent::Sphere { .. }) {
        SPHERE_COST
    } else {
        TEST_COST
    }
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
pub(super) const fn grid_of(
    extents: &[Extent],
    size: &[i32; 3],
    most: usize,
    precision: u8,
) -> Grid {
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
        while (n as i64 * grid.side() as i64) < need as i64 && grid.shift < MOST_SHIFT {
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

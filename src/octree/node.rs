//! The tree's words. One array of `u32` holds everything; a tree without shapes has no words at all.
//!
//! The root is a grid of up to 8×8×8 cells: word 0 says how many and how large ([`Grid`]), and a word
//! for each cell follows, those along x beside each other, then those along y. A cell is empty, a leaf or
//! an inner node, whose children are its octants.
//!
//! | word | bit 31 | bit 30 | below |
//! |---|---|---|---|
//! | empty cell of the grid | 0 | 0 | 0 |
//! | inner node | 0 | 30 to 23: which of the eight children exist | 22 to 0: index of the first one's word |
//! | leaf, its ids inline | 1 | 0 | 29 to 0: ids |
//! | leaf, its ids elsewhere | 1 | 1 | 29 to 0: index of the run's first word |
//! | word of a run | 1 | another word of the run follows | 29 to 0: ids |
//!
//! Child 0 has the smallest coordinates; bit 0 of a child's number stands for the upper half in
//! x, bit 1 in y, bit 2 in z. The children that exist lie in a row, in that order.
//!
//! An id takes as many bits as the scene's largest needs, the first one lowest. Whatever isn't
//! used is all ones, which is never an id: so ids can be shifted out arithmetically, ones follow,
//! and the first id of all ones is the end, without counting.
//!
//! **Order**: children and runs stand without gaps in the order of a depth-first visit, children
//! ascending. So nothing is shared, a child comes after its parent, and one pass can
//! [`validate`] words of any origin.

use super::grid::Grid;
use core::fmt;

/// A leaf is at most this many levels below a cell of the grid.
pub const MAX_LEVELS: usize = 12;
/// Ids of this many bits at most: the builder keeps a byte beside an id.
pub const MAX_ID_BITS: u32 = 23;

const LEAF: u32 = 1 << 31;
const MORE: u32 = 1 << 30;
const INDEX_BITS: u32 = 23;
const IDS: u32 = MORE - 1;

/// Room for all levels, a power of two: a masked index needs no check.
pub(super) const ROOM: usize = 16;

const _: () = assert!(MAX_LEVELS + 2 <= ROOM);
const _: () = assert!(INDEX_BITS + 8 == 31);
const _: () = assert!(MAX_ID_BITS <= 24);

/// How many children of a mask exist: no core that matters here counts bits by itself.
static POPULATION: [u8; 256] = {
    let mut table = [0; 256];
    let mut i = 0;
    while i < 256 {
        table[i] = (i as u8).count_ones() as u8;
        i += 1;
    }
    table
};

/// The number of ones in the lowest byte.
#[inline(always)]
pub(super) const fn population(mask: u32) -> u32 {
    POPULATION[(mask & 0xff) as usize] as u32
}

#[inline(always)]
pub(super) const fn is_leaf(word: u32) -> bool {
    word & LEAF != 0
}

/// An inner node, if the index fits.
pub(super) const fn inner(children: u32, first: usize) -> Option<u32> {
    if first >> INDEX_BITS != 0 {
        None
    } else {
        Some((children & 0xff) << INDEX_BITS | first as u32)
    }
}

#[inline(always)]
pub(super) const fn children(inner: u32) -> u32 {
    inner >> INDEX_BITS
}

#[inline(always)]
pub(super) const fn first(inner: u32) -> usize {
    (inner & ((1 << INDEX_BITS) - 1)) as usize
}

/// Where the word of a child is, if it exists.
#[inline(always)]
pub(super) fn child(inner: u32, number: u32) -> Option<usize> {
    let children = children(inner);
    let bit = 1 << (number & 7);
    if children & bit == 0 {
        return None;
    }
    Some(first(inner) + population(children & (bit - 1)) as usize)
}

/// A cell of the grid in which nothing lies.
pub(super) const EMPTY: u32 = 0;

/// A leaf whose ids are in a run.
pub(super) const fn leaf_of_run(first: usize) -> u32 {
    LEAF | MORE | (first as u32 & IDS)
}

/// Where the run of a leaf starts, unless its ids are inline.
#[inline(always)]
pub(super) const fn run(leaf: u32) -> Option<usize> {
    if leaf & MORE == 0 { None } else { Some((leaf & IDS) as usize) }
}

/// Whether another word of the run follows.
#[inline(always)]
pub(super) const fn continues(word: u32) -> bool {
    word & MORE != 0
}

/// A word, or 0 beyond the end: no panic is left in the program.
#[inline(always)]
pub(super) const fn word(words: &[u32], index: usize) -> u32 {
    if index < words.len() { words[index] } else { 0 }
}

/// How wide a scene's ids are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct IdWidth {
    bits: u32,
    mask: u32,
}

impl IdWidth {
    /// For this many shapes: the largest id is not all ones.
    pub(super) const fn of(shapes: usize) -> Option<Self> {
        let mut bits = 1;
        while bits <= MAX_ID_BITS {
            if (1 << bits) > shapes {
                return Some(Self { bits, mask: (1 << bits) - 1 });
            }
            bits += 1;
        }
        None
    }

    /// How many ids a word holds.
    pub(super) const fn per_word(self) -> usize {
        match 30u32.checked_div(self.bits) {
            Some(count) => count as usize,
            None => 1,
        }
    }

    /// A leaf without ids, or a run's word.
    pub(super) const fn empty(self, continues: bool) -> u32 {
        if continues { LEAF | MORE | IDS } else { LEAF | IDS }
    }

    /// The word with its id number `slot` set, that wasn't yet.
    pub(super) const fn with(self, word: u32, slot: usize, id: u32) -> u32 {
        let up = slot as u32 * self.bits;
        word & !((self.mask ^ (id & self.mask)) << up)
    }

    /// The ids of a leaf or of a run's word.
    #[inline(always)]
    pub(super) const fn ids(self, word: u32) -> Ids {
        Ids { rest: (word | MORE) as i32, width: self }
    }
}

/// The ids in a word.
pub(super) struct Ids {
    rest: i32,
    width: IdWidth,
}

impl Ids {
    #[inline(always)]
    pub(super) const fn next(&mut self) -> Option<u32> {
        if self.is_over() {
            return None;
        }
        let id = self.rest as u32 & self.width.mask;
        self.rest >>= self.width.bits & 31;
        Some(id)
    }

    /// Whether all that is left is ones.
    #[inline(always)]
    pub(super) const fn is_over(&self) -> bool {
        self.rest == -1
    }
}

/// Why words are not a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum TreeError {
    /// There are more shapes than ids.
    TooManyShapes,
    /// The cube is too small, too large or too far away.
    Cube,
    /// The root is no grid.
    Grid,
    /// Children or a run of ids aren't where the order wants them.
    Order,
    /// Cells, children or a run of ids don't end within the words.
    Truncated,
    /// An inner node has no children.
    Childless,
    /// More levels than a walk has room for.
    TooDeep,
    /// An id that no shape has.
    Id,
    /// Words that belong to no node, or shapes without words.
    Length,
}

impl TreeError {
    /// What is wrong, in words: for `const` panics and logs.
    pub const fn message(self) -> &'static str {
        match self {
            Self::TooManyShapes => "an octree holds at most 8388607 shapes",
            Self::Cube => "the octree's cube is out of range",
            Self::Grid => "the octree's root is not a grid",
            Self::Order => "a row or run of the octree is out of order",
            Self::Truncated => "a row or run of the octree is truncated",
            Self::Childless => "an inner node of the octree has no children",
            Self::TooDeep => "the octree has too many levels",
            Self::Id => "the octree names a shape that doesn't exist",
            Self::Length => "the octree has too many words, or none",
        }
    }
}

impl fmt::Display for TreeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.message())
    }
}

impl core::error::Error for TreeError {}

const fn check_ids(width: IdWidth, word: u32, shapes: usize) -> bool {
    let mut ids = width.ids(word);
    while let Some(id) = ids.next() {
        if id as usize >= shapes {
            return false;
        }
    }
    ids.is_over()
}

/// Checks the words of a tree over so many shapes, and gives the number of its levels, those that the
/// grid stands for among them. One pass: each word is looked at once.
///
/// # Errors
/// Whatever could make a walk wrong or endless.
pub const fn validate(words: &[u32], shapes: usize) -> Result<u8, TreeError> {
    let Some(width) = IdWidth::of(shapes) else { return Err(TreeError::TooManyShapes) };
    if words.is_empty() {
        return if shapes == 0 { Ok(0) } else { Err(TreeError::Length) };
    }
    let Some(grid) = Grid::read(word(words, 0)) else { return Err(TreeError::Grid) };
    if words.len() <= grid.count() {
        return Err(TreeError::Truncated);
    }
    // For each level the next word of the row, and its end; the grid's cells are level 0.
    let mut next = [0; ROOM];
    let mut end = [0; ROOM];
    let (mut level, mut deepest) = (0, 0);
    let mut used = 1 + grid.count();
    (next[0], end[0]) = (1, used);
    loop {
        let current = level % ROOM;
        if next[current] == end[current] {
            if level == 0 {
                break;
            }
            level -= 1;
            continue;
        }
        let word = self::word(words, next[current]);
        next[current] += 1;
        if level == 0 && word == EMPTY {
            continue;
        }
        if !is_leaf(word) {
            let (start, length) = (first(word), population(children(word)) as usize);
            if length == 0 {
                return Err(TreeError::Childless);
            }
            if level == MAX_LEVELS {
                return Err(TreeError::TooDeep);
            }
            if start != used {
                return Err(TreeError::Order);
            }
            if length > words.len() - used {
                return Err(TreeError::Truncated);
            }
            used += length;
            level += 1;
            next[level % ROOM] = start;
            end[level % ROOM] = used;
            if level > deepest {
                deepest = level;
            }
        } else if let Some(start) = run(word) {
            if start != used {
                return Err(TreeError::Order);
            }
            let mut more = true;
            while more {
                if used == words.len() {
                    return Err(TreeError::Truncated);
                }
                let word = self::word(words, used);
                if !is_leaf(word) || !check_ids(width, word, shapes) {
                    return Err(TreeError::Id);
                }
                more = continues(word);
                used += 1;
            }
        } else if !check_ids(width, word, shapes) {
            return Err(TreeError::Id);
        }
    }
    if used == words.len() { Ok(grid.levels() + deepest as u8) } else { Err(TreeError::Length) }
}

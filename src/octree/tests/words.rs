//! Trees as words: in a `static`, out of bounds, and made by somebody hostile.

use super::grid::Grid;
use super::*;

static EXTENTS: [Extent; 64] = {
    let mut all = [Extent::Sphere { center: [0; 3], radius: 30_000 }; 64];
    let mut i = 0;
    while i < 64 {
        let c = [(i % 4) as i32, (i / 4 % 4) as i32, (i / 16) as i32];
        let center = [c[0] * 65536, c[1] * 70000 + c[0] * 5000, c[2] * 80000 - c[1] * 9000];
        all[i] = Extent::Sphere { center, radius: 20_000 + 500 * i as i32 };
        i += 1;
    }
    all
};
static BUFFER: OctreeBuffer<900> = OctreeBuffer::build(&EXTENTS);
static TREE: Octree<Fixed> = Octree::<Fixed>::of(&BUFFER, STEP);

#[test]
fn a_static_tree() {
    assert_eq!(BUFFER.shapes(), 64);
    assert!(BUFFER.built().levels >= 2);
    let mut words = [0; 900];
    let mut scratch = [0; 1000];
    let built = build_into(&EXTENTS, &mut words, &mut scratch, Limits::DEFAULT).unwrap();
    assert_eq!(&words[..built.words], BUFFER.words());
    let shapes: Vec<Sphere<Fixed>> = (EXTENTS.iter())
        .map(|e| match e {
            Extent::Sphere { center, radius } => {
                let center = center.map(|x| f64::from(x) / 65536.0);
                Sphere::<Fixed>::new(center, f64::from(*radius) / 65536.0, 0)
            }
            _ => unreachable!(),
        })
        .collect();
    let o = [1.0, 1.0, -9.0].map(|x| crate::math::fixed_constructors::length(x).unwrap());
    let d = [0.0, 0.0, 1.0].map(|x| crate::math::fixed_constructors::unit(x).unwrap());
    let mut found = Nearest::<Fixed>::new(&shapes, o, d);
    TREE.walk(&o, &d, &mut WalkStack::new(), &mut found);
    assert!(found.id != u32::MAX);
}

#[test]
fn errors() {
    let one = [Extent::Sphere { center: [0; 3], radius: 100 }; 40];
    let build = |extents: &[Extent], words: usize, scratch: usize| {
        build_into(extents, &mut vec![0; words], &mut vec![0; scratch], Limits::DEFAULT)
    };
    assert_eq!(build(&one, 3, 1000).unwrap_err(), BuildError::Words);
    assert_eq!(build(&one, 1, 1000).unwrap_err(), BuildError::Words);
    assert_eq!(build(&one, 0, 1000).unwrap_err(), BuildError::Words);
    let scratch = build(&one, 100, 1000).unwrap().scratch;
    assert_eq!(build(&one, 100, scratch - 1).unwrap_err(), BuildError::Scratch);
    assert!(build(&one, 100, scratch).is_ok());
    assert_eq!(build(&[], 0, 0).unwrap().words, 0);
    for (center, radius) in [([i32::MAX, 0, 0], 1), ([0; 3], -1), ([0, 1 << 27, 0], 1)] {
        let bad = [Extent::Sphere { center, radius }];
        assert_eq!(build(&bad, 10, 10).unwrap_err(), BuildError::Extent);
    }
    let inverted = [Extent::Box { min: [1; 3], max: [0; 3] }];
    assert_eq!(build(&inverted, 10, 10).unwrap_err(), BuildError::Extent);
    let all = [Extent::Box { min: [-(1 << 27); 3], max: [1 << 27; 3] }];
    let built = build(&all, 10, 10).unwrap();
    assert_eq!((built.words, built.cube.log2_side), (2, 29));
    std::assert_eq!(std::format!("{}", BuildError::Words), "too few words for the octree");
}

#[test]
fn hostile_words_are_refused() {
    let leaf = |ids: &[u32]| {
        let width = node::IdWidth::of(5).unwrap();
        let mut word = width.empty(false);
        for (slot, id) in ids.iter().enumerate() {
            word = width.with(word, slot, *id);
        }
        word
    };
    let inner = |children, first| node::inner(children, first).unwrap();
    let grid = |cells| Grid::new(cells, 1 << 16).word();
    // One cell.
    let cell = |words: &[u32], shapes| {
        let mut all = vec![grid([1; 3])];
        all.extend(words);
        validate(&all, shapes)
    };
    assert_eq!(cell(&[leaf(&[0, 4])], 5), Ok(0));
    assert_eq!(cell(&[node::EMPTY], 5), Ok(0));
    assert_eq!(cell(&[inner(3, 2), leaf(&[0]), leaf(&[1])], 5), Ok(1));
    assert_eq!(cell(&[leaf(&[5])], 5), Err(TreeError::Id));
    assert_eq!(cell(&[leaf(&[1]), leaf(&[1])], 5), Err(TreeError::Length));
    assert_eq!(cell(&[inner(1, 1)], 5), Err(TreeError::Order));
    assert_eq!(cell(&[inner(0, 2)], 5), Err(TreeError::Childless));
    assert_eq!(cell(&[inner(3, 2), leaf(&[1])], 5), Err(TreeError::Truncated));
    assert_eq!(cell(&[inner(1, 2), node::EMPTY], 5), Err(TreeError::Childless));
    assert_eq!(cell(&[node::leaf_of_run(2)], 5), Err(TreeError::Truncated));
    assert_eq!(cell(&[node::leaf_of_run(1)], 5), Err(TreeError::Order));
    let chain = |levels| {
        let mut words: Vec<u32> = (2..2 + levels).map(|i| inner(1, i)).collect();
        words.push(leaf(&[1]));
        cell(&words, 5)
    };
    assert_eq!(chain(MAX_LEVELS), Ok(MAX_LEVELS as u8));
    assert_eq!(chain(MAX_LEVELS + 1), Err(TreeError::TooDeep));
    assert_eq!(cell(&[0; 4], 1 << 23), Err(TreeError::TooManyShapes));
    // The grid itself.
    let (one, none) = (leaf(&[1]), node::EMPTY);
    assert_eq!(validate(&[], 5), Err(TreeError::Length));
    assert_eq!(validate(&[], 0), Ok(0));
    assert_eq!(validate(&[grid([2, 2, 2])], 5), Err(TreeError::Truncated));
    let mut cells = vec![grid([2, 2, 2])];
    cells.extend([none; 7]);
    assert_eq!(validate(&cells, 5), Err(TreeError::Truncated));
    cells.push(none);
    assert_eq!(validate(&cells, 5), Ok(1));
    cells.push(one);
    assert_eq!(validate(&cells, 5), Err(TreeError::Length));
    let cells = [grid([5, 1, 1]), one, none, inner(5, 6), none, inner(1, 8), one, one, one];
    assert_eq!(validate(&cells, 5), Ok(4));
    let cells = [grid([5, 1, 1]), one, none, inner(5, 7), none, inner(1, 6), one, one, one];
    assert_eq!(validate(&cells, 5), Err(TreeError::Order));
    // Words that are no grid.
    for bit in [16, 22, 31] {
        assert_eq!(validate(&[grid([1; 3]) ^ 1 << bit, one], 5), Err(TreeError::Grid));
    }
}

/// Words that are nearly a tree.
fn nearly_a_tree() -> impl Strategy<Value = (Vec<u32>, usize)> {
    (1u64.., 1usize..40, 0usize..3, 0usize..40).prop_map(|(seed, count, damage, room)| {
        let mut random = Random(seed);
        if damage == 0 {
            return ((0..room).map(|_| random.next() as u32).collect(), count);
        }
        // grown at random in the right order, then perhaps damaged
        let cells = [0; 3].map(|_| 1 + random.below(8) as u8);
        let grid = Grid::new(cells, 1 << (10 + random.below(18)));
        let mut words = vec![node::EMPTY; 1 + grid.count()];
        words[0] = grid.word();
        for cell in 1..words.len() {
            if random.below(2) == 0 {
                grow(&mut words, cell, 3, count, &mut random);
            }
        }
        for _ in 1..damage {
            let i = random.below(words.len() as u64) as usize;
            words[i] ^= 1 << random.below(32);
        }
        (words, count)
    })
}

fn grow(words: &mut Vec<u32>, slot: usize, level: usize, count: usize, random: &mut Random) {
    let width = node::IdWidth::of(count).unwrap();
    let first = words.len();
    if random.below(4) > level as u64 / 2 || (level < MAX_LEVELS && random.below(20) == 0) {
        let children = 1 + random.below(255) as u32;
        words[slot] = node::inner(children, first).unwrap();
        words.resize(first + children.count_ones() as usize, 0);
        for i in first..first + children.count_ones() as usize {
            grow(words, i, level + 1, count, random);
        }
        return;
    }
    let mut word = |continues| {
        let mut word = width.empty(continues);
        for slot in 0..random.below(1 + width.per_word() as u64) as usize {
            word = width.with(word, slot, random.below(count as u64) as u32);
        }
        word
    };
    if level.is_multiple_of(2) {
        words[slot] = word(false);
    } else {
        words[slot] = node::leaf_of_run(first);
        words.push(word(true));
        words.push(word(false));
    }
}

struct Counter<A: Arithmetic> {
    visits: usize,
    shapes: u32,
    limit: A::Length,
}

impl<A: Arithmetic> Visitor<A> for Counter<A> {
    fn limit(&self) -> A::Length {
        self.limit
    }

    fn visit(&mut self, id: u32) -> bool {
        assert!(id < self.shapes);
        self.visits += 1;
        false
    }

    fn node(&mut self) {
        self.visits += 1;
    }

    fn step(&mut self) {
        self.visits += 1;
    }
}

/// Whatever passes can be walked, in so many steps, and names no shape that isn't there.
macro_rules! what_passes_can_be_walked {
    ($name:ident, $a:ident, $make:ident) => {
        proptest! {
            #![proptest_config(ProptestConfig::with_cases(3000))]
            #[test]
            fn $name((words, count) in nearly_a_tree(), seed in 1u64.., step in -40i8..0) {
                use crate::math::$make as make;
                let mut random = Random(seed);
                let step = if random.below(2) == 0 { STEP } else { step };
                let origin = random.point(6e7).map(|x| x as i32);
                let cube = Cube { origin, log2_side: 10 + random.below(22) as u8 };
                let tree = Octree::<$a>::try_new(&words, count, &cube, step);
                if tree.is_ok() {
                    prop_assert!(validate(&words, count).is_ok());
                }
                let Ok(tree) = tree else { return Ok(()) };
                let grid = words.first().and_then(|&word| Grid::read(word));
                let grid = grid.unwrap_or(Grid::new([1; 3], 1));
                let unit = 2f64.powi(i32::from(if stringify!($a) == "Fixed" { STEP } else { step }));
                for _ in 0..20 {
                    let reach = [1000.0, 10.0][random.below(2) as usize];
                    let mut o = random.point(reach);
                    let mut d = random.direction();
                    // From a place in the grid, or towards it.
                    let at = [0, 1, 2].map(|i| {
                        let n = random.within(0.0, f64::from(grid.cells[i]));
                        let n = if random.below(2) == 0 { n.round() } else { n };
                        (f64::from(origin[i]) + n * f64::from(grid.side())) * unit
                    });
                    match random.below(4) {
                        0 => {}
                        1 => {
                            let way = [0, 1, 2].map(|i| at[i] - o[i]);
                            let length = way.iter().map(|x| x * x).sum::<f64>().sqrt();
                            d = if length > 0.0 { way.map(|x| x / length) } else { d };
                        }
                        _ => o = at,
                    }
                    match random.below(4) {
                        0 => d = d.map(|x| x.signum() * (1f64 / 3.0).sqrt()),
                        1 => {
                            d = d.map(|x| x * 1e-5);
                            d[random.below(3) as usize] = 1.0;
                        }
                        _ => {}
                    }
                    let o = o.map(|x| make::length(x.clamp(-1000.0, 1000.0)).unwrap());
                    let d = d.map(|x| make::unit(x).unwrap());
                    let limit = <$a>::FAR;
                    let mut counter = Counter::<$a> { visits: 0, shapes: count as u32, limit };
                    tree.walk(&o, &d, &mut WalkStack::new(), &mut counter);
                    prop_assert!(counter.visits <= 40 * words.len());
                }
            }
        }
    };
}

what_passes_can_be_walked!(walked_in_fixed, Fixed, fixed_constructors);
what_passes_can_be_walked!(walked_in_f32, f32, f32_constructors);
what_passes_can_be_walked!(walked_in_f64, f64, f64_constructors);

/// Extents of any kind and size, at places that lie near one another or not.
fn any_extents(random: &mut Random, count: usize) -> Vec<Extent> {
    let reach = f64::from(1 << (4 + random.below(22)));
    let spread = [1.0, 1e-3, 0.0][random.below(3) as usize];
    let all = (0..count).map(|_| {
        let at = random.point(reach * spread);
        let r = reach * 10f64.powf(random.within(-3.0, 0.0));
        let corner = |random: &mut Random| {
            let by = random.point(r);
            [0, 1, 2].map(|i| (at[i] + by[i]) as i32)
        };
        match random.below(4) {
            0 => {
                let (a, b) = (corner(random), corner(random));
                Extent::Box {
                    min: [0, 1, 2].map(|i| a[i].min(b[i])),
                    max: [0, 1, 2].map(|i| a[i].max(b[i])),
                }
            }
            1 => Extent::Triangle { corners: [corner(random), corner(random), corner(random)] },
            2 => Extent::Round {
                ends: [corner(random), corner(random)],
                radii: [(r / 2.0) as i32, 0],
                hollow: true,
            },
            _ => Extent::Sphere { center: at.map(|x| x as i32), radius: r as i32 },
        }
    });
    all.collect()
}

proptest! {
    /// What `build_into` says of its memory: never more scratch than stated; as much as was used is
    /// enough, and one word less is an error.
    #[test]
    fn memory_is_bounded_and_stated(
        seed in 1u64.., count in 1usize..60, levels in 0u8..=12, leaf in 0u8..8, precision in 0u8..=30,
    ) {
        let mut random = Random(seed);
        let extents = any_extents(&mut random, count);
        let limits = Limits { levels, leaf, precision };
        let most = (usize::from(levels) + 3) * count;
        let (mut words, mut scratch) = (vec![0; 300_000], vec![0; most]);
        let built = build_into(&extents, &mut words, &mut scratch, limits).unwrap();
        prop_assert_eq!(validate(&words[..built.words], count), Ok(built.levels));
        prop_assert!(built.levels <= levels.max(Grid::read(words[0]).unwrap().levels()));
        let build = |words: usize, scratch: usize| {
            build_into(&extents, &mut vec![0; words], &mut vec![0; scratch], limits)
        };
        prop_assert_eq!(build(built.words, built.scratch), Ok(built));
        prop_assert_eq!(build(built.words - 1, most), Err(BuildError::Words));
        prop_assert_eq!(build(300_000, built.scratch - 1), Err(BuildError::Scratch));
    }
}

#[test]
fn the_bound_of_scratch_is_reached() {
    // One cell, and all shapes in the lists of the slab, of the row and of the cell.
    let limits = Limits { levels: 0, ..Limits::DEFAULT };
    for count in [1, 7, 40] {
        let extents = vec![Extent::Sphere { center: [0; 3], radius: 100 }; count];
        let built = build_into(&extents, &mut [0; 100], &mut vec![0; 3 * count], limits).unwrap();
        assert_eq!(built.scratch, 3 * count);
    }
}

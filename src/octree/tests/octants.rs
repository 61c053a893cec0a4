//! Which octants a shape lies in: each that one of its points lies in, and few more.

use super::*;

/// Points on (or, for a box, in) the extent.
fn samples(extent: &Extent, random: &mut Random) -> Vec<[f64; 3]> {
    let mut all = Vec::new();
    for _ in 0..400 {
        all.push(match extent {
            Extent::Box { min, max } => {
                [0, 1, 2].map(|i| random.within(f64::from(min[i]), f64::from(max[i])))
            }
            Extent::Sphere { center, radius } => {
                let d = random.direction();
                [0, 1, 2].map(|i| f64::from(center[i]) + f64::from(*radius) * d[i])
            }
            Extent::Round { ends, radii, hollow } => {
                let end = |i: usize| ends[i].map(f64::from);
                let way = [0, 1, 2].map(|i| end(1)[i] - end(0)[i]);
                let length = way.iter().map(|x| x * x).sum::<f64>().sqrt().max(1.0);
                // across the axis
                let d = random.direction();
                let along = (0..3).map(|i| d[i] * way[i]).sum::<f64>() / length;
                let d = [0, 1, 2].map(|i| d[i] - along * way[i] / length);
                let size = d.iter().map(|x| x * x).sum::<f64>().sqrt().max(1e-9);
                let s = random.within(0.0, 1.0);
                let r = f64::from(radii[0]) * (1.0 - s) + f64::from(radii[1]) * s;
                let r = if *hollow { r } else { r * random.within(0.0, 1.0) };
                [0, 1, 2].map(|i| end(0)[i] + s * way[i] + r * d[i] / size)
            }
            Extent::Triangle { corners } => {
                let (mut b, mut c) = (random.within(0.0, 1.0), random.within(0.0, 1.0));
                if b + c > 1.0 {
                    (b, c) = (1.0 - b, 1.0 - c);
                }
                [0, 1, 2].map(|i| {
                    f64::from(corners[0][i]) * (1.0 - b - c)
                        + f64::from(corners[1][i]) * b
                        + f64::from(corners[2][i]) * c
                })
            }
        });
    }
    all
}

fn some_extent(random: &mut Random, reach: f64) -> Extent {
    let mut p = || random.point(reach).map(|x| x as i32);
    let (a, b, c) = (p(), p(), p());
    match random.below(5) {
        0 => Extent::Box {
            min: [0, 1, 2].map(|i| a[i].min(b[i])),
            max: [0, 1, 2].map(|i| a[i].max(b[i])),
        },
        1 => Extent::Sphere { center: a, radius: random.within(0.0, reach) as i32 },
        2 => Extent::Triangle { corners: [a, b, c] },
        kind => {
            let size = [1.0, 0.1, 0.01][random.below(3) as usize] * reach;
            let r = random.within(0.0, size) as i32;
            let q = if kind == 3 { r } else { random.within(0.0, size) as i32 };
            Extent::Round { ends: [a, b], radii: [r, q], hollow: random.below(2) == 0 }
        }
    }
}

#[test]
fn octants_hold_all_samples() {
    let mut random = Random(5);
    let (mut empty, mut met) = (0, 0);
    for _ in 0..4000 {
        let reach = [50.0, 3000.0, 1e6, 6e7][random.below(4) as usize];
        let extent = some_extent(&mut random, reach);
        let half = 1 << (random.below(16) + 3).min(reach.log2() as u64 + 1);
        let min = random.point(reach).map(|x| x as i32);
        let cell = Cell { min, half, margin: 1 };
        let octants = cell.octants(&extent);
        let mut seen = 0u8;
        for p in samples(&extent, &mut random) {
            for octant in 0..8 {
                let low = |i: usize| f64::from(min[i] + (octant >> i & 1) * half);
                if (0..3).all(|i| p[i] >= low(i) && p[i] <= low(i) + f64::from(half)) {
                    assert!(octants >> octant & 1 != 0, "{extent:?} {cell:?} {octant}");
                    seen |= 1 << octant;
                }
            }
        }
        met += seen.count_ones();
        empty += (!octants).count_ones();
    }
    assert!(met > 500 && empty > 500, "{met} {empty}");
}

#[test]
fn triangles_and_spheres_skip_cells_of_their_boxes() {
    let cell = Cell { min: [0; 3], half: 1000, margin: 0 };
    // The plane x + y + z = 2100 cuts all octants but the highest.
    let corners = [[2100, 0, 0], [0, 2100, 0], [0, 0, 2100]];
    assert_eq!(cell.octants(&Extent::Triangle { corners }), 0x7f);
    // A thin one along the diagonal of the floor: an edge separates.
    let corners = [[0, 100, 0], [1900, 2000, 0], [0, 120, 0]];
    assert_eq!(cell.octants(&Extent::Triangle { corners }), 0b1101);
    let hollow = Extent::Sphere { center: [500; 3], radius: 900 };
    // Only the lowest octant lies all inside.
    assert_eq!(cell.octants(&hollow), 0xfe);
    assert_eq!(bounds(&hollow), ([-400; 3], [1400; 3]));
}

#[test]
fn cylinders_and_cones_skip_cells_of_their_boxes() {
    let cell = Cell { min: [0; 3], half: 1000, margin: 0 };
    let along = |r, q| {
        let ends = [[0, 100, 100], [1900, 2000, 100]];
        cell.octants(&Extent::Round { ends, radii: [r, q], hollow: true })
    };
    // Beside the floor's diagonal it misses one of the four, which lies 71 away.
    assert_eq!([along(20, 20), along(90, 90), along(950, 950)], [0b1101, 0b1111, 0xff]);
    // A cone is thick enough at its end alone.
    assert_eq!([along(0, 90), along(0, 900) & 0xf], [0b1101, 0b1111]);
    // Within a wall is nothing, unless there are caps.
    let wide = |hollow| {
        let ends = [[500, 500, -9000], [500, 500, 9000]];
        cell.octants(&Extent::Round { ends, radii: [800, 800], hollow })
    };
    assert_eq!(wide(true), 0b1110_1110);
    assert_eq!(wide(false), 0b1111_1111);
    let ends = [[0; 3], [300, 400, 0]];
    let (min, max) = bounds(&Extent::Round { ends, radii: [100, 100], hollow: true });
    // r·(4/5, 3/5, 1) around both ends
    let near = |a: [i32; 3], b: [i32; 3]| (0..3).all(|i| (a[i] - b[i]).abs() <= 2);
    assert!(near(min, [-80, -60, -100]) && near(max, [380, 460, 100]), "{min:?} {max:?}");
}

/// Any tree of boxes, spheres and triangles lists each shape in the leaf of each sampled point.
#[test]
fn leaves_hold_all_samples() {
    let mut random = Random(9);
    for round in 0..40 {
        let count = 1 + random.below(60) as usize;
        let reach = [10.0, 1e4, 1e6, 6e7][round % 4];
        let extents: Vec<_> = (0..count).map(|_| some_extent(&mut random, reach)).collect();
        let mut words = vec![0; 400_000];
        let mut scratch = vec![0; 13 * count];
        let limits = Limits { levels: 6, ..Limits::DEFAULT };
        let built = build_into(&extents, &mut words, &mut scratch, limits).unwrap();
        words.truncate(built.words);
        assert_eq!(validate(&words, count), Ok(built.levels));
        for (id, extent) in extents.iter().enumerate() {
            for p in samples(extent, &mut random).iter().take(50) {
                assert!(leaf_at(&words, count, &built, p).contains(&(id as u32)));
            }
        }
    }
}

fn leaf_at(words: &[u32], count: usize, built: &Built, p: &[f64; 3]) -> Vec<u32> {
    let width = node::IdWidth::of(count).unwrap();
    let grid = grid::Grid::read(words[0]).unwrap();
    let mut side = f64::from(grid.side());
    let mut min = built.cube.origin.map(f64::from);
    let cell = [0, 1, 2].map(|i| ((p[i] - min[i]) / side) as usize);
    min = [0, 1, 2].map(|i| min[i] + cell[i] as f64 * side);
    let [row, column, _] = grid.cells.map(usize::from);
    let mut word = words[1 + (cell[2] * column + cell[1]) * row + cell[0]];
    assert_ne!(word, node::EMPTY, "no cell where a shape is");
    while !node::is_leaf(word) {
        side /= 2.0;
        let mut number = 0;
        for i in 0..3 {
            if p[i] >= min[i] + side {
                min[i] += side;
                number |= 1 << i;
            }
        }
        word = words[node::child(word, number).expect("no child where a shape is")];
    }
    let mut next = words.len();
    if let Some(start) = node::run(word) {
        (word, next) = (words[start], start);
    }
    let mut all = Vec::new();
    loop {
        let mut ids = width.ids(word);
        while let Some(id) = ids.next() {
            all.push(id);
        }
        if !node::continues(word) {
            return all;
        }
        next += 1;
        word = words[next];
    }
}

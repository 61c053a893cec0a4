//! A tree finds what a list finds, to the bit.

extern crate std;

use super::overlap::{Cell, bounds};
use super::*;
use crate::math::{Arithmetic, Fixed};
use crate::shape::{Leaving, Ray, Shape, Sphere};
use proptest::prelude::*;
use std::vec;
use std::vec::Vec;

const STEP: i8 = -16;

/// xorshift64*, so that a failure can be repeated.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    fn below(&mut self, n: u64) -> u64 {
        (self.next() >> 33) % n
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.next() >> 11) as f64 / (1u64 << 53) as f64)
    }

    fn point(&mut self, r: f64) -> [f64; 3] {
        [self.within(-r, r), self.within(-r, r), self.within(-r, r)]
    }

    fn direction(&mut self) -> [f64; 3] {
        loop {
            let v = self.point(1.0);
            let l = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
            if l > 0.1 && l <= 1.0 {
                return v.map(|x| x / l);
            }
        }
    }
}

struct Nearest<'a, A: Arithmetic> {
    shapes: &'a [Sphere<A>],
    ray: Ray<A>,
    coarse: A::Coarse,
    best: A::Length,
    id: u32,
    tests: u32,
    nodes: u32,
    steps: u32,
}

impl<'a, A: Arithmetic> Nearest<'a, A> {
    fn new(shapes: &'a [Sphere<A>], origin: [A::Length; 3], direction: [A::Unit; 3]) -> Self {
        let coarse = A::coarse(&origin, &direction);
        let ray = Ray { origin, direction, leaving: Leaving::NOTHING };
        Self { shapes, ray, coarse, best: A::FAR, id: u32::MAX, tests: 0, nodes: 0, steps: 0 }
    }
}

impl<A: Arithmetic> Visitor<A> for Nearest<'_, A> {
    fn limit(&self) -> A::Length {
        self.best
    }

    fn visit(&mut self, id: u32) -> bool {
        self.tests += 1;
        let shape = &self.shapes[id as usize];
        if let Some(m) = shape.nearest(&self.ray, &self.coarse, false, self.best)
            && (m.distance < self.best || (m.distance == self.best && id < self.id))
        {
            (self.best, self.id) = (m.distance, id);
        }
        false
    }

    fn node(&mut self) {
        self.nodes += 1;
    }

    fn step(&mut self) {
        self.steps += 1;
    }
}

/// Scenes that are hard in some way: centre and radius.
fn spheres(random: &mut Random, kind: u64, count: usize) -> Vec<([f64; 3], f64)> {
    let mut all = Vec::new();
    for i in 0..count {
        let p = random.point(20.0);
        let r = random.within(0.2, 2.0);
        all.push(match kind {
            // tiny to huge
            0 => (p, 0.001 * 10f64.powf(random.within(0.0, 4.3))),
            // clusters
            1 => {
                let cluster = (i % 4) as f64 * 11.0 - 20.0;
                let q = random.point(0.5);
                ([cluster + q[0], q[1] - cluster * 0.3, q[2]], random.within(0.01, 0.2))
            }
            // all around one point
            2 => ([1.25, -3.5, 0.75], random.within(0.1, 3.0)),
            // the same one many times
            3 => ([0.5, 0.5, 0.5], 1.0),
            // flat
            4 => ([p[0], 0.0, p[2]], random.within(0.1, 0.7)),
            // touching, on a grid
            5 => {
                let c = |n: usize| (n % 7) as f64 - 3.0;
                ([c(i), c(i / 7), c(i / 49)], 0.5)
            }
            // wide
            6 => (random.point(500.0), random.within(0.5, 100.0)),
            // small
            7 => (random.point(0.1), random.within(0.001, 0.01)),
            _ => (p, r),
        });
    }
    all
}

macro_rules! against_a_list {
    ($name:ident, $a:ident, $make:ident) => {
        mod $name {
            use super::*;
            use crate::math::$make as make;
            type A = $a;
            type Length = <A as Arithmetic>::Length;

            pub(super) struct Scene {
                pub(super) shapes: Vec<Sphere<A>>,
                pub(super) words: Vec<u32>,
                pub(super) built: Built,
            }

            impl Scene {
                pub(super) fn new(spheres: &[([f64; 3], f64)], limits: Limits) -> Self {
                    let shapes: Vec<_> = spheres
                        .iter()
                        .map(|s| Sphere::<A>::try_new(s.0, s.1, 0).unwrap())
                        .collect();
                    let step = |x: Length| make::to_grid(x, STEP);
                    let extents: Vec<_> = shapes
                        .iter()
                        .map(|s| Extent::Sphere {
                            center: s.center().map(step),
                            radius: step(s.radius()),
                        })
                        .collect();
                    let mut words = vec![0; 200_000];
                    let mut scratch = vec![0; 20_000];
                    let built = build_into(&extents, &mut words, &mut scratch, limits).unwrap();
                    words.truncate(built.words);
                    assert_eq!(validate(&words, shapes.len()), Ok(built.levels));
                    Self { shapes, words, built }
                }

                pub(super) fn tree(&self) -> Octree<'_, A> {
                    let cube = &self.built.cube;
                    Octree::<A>::try_new(&self.words, self.shapes.len(), cube, STEP).unwrap()
                }

                /// An origin of one of many kinds.
                fn origin(&self, random: &mut Random) -> [f64; 3] {
                    let cube = &self.built.cube;
                    let side = (1u64 << cube.log2_side) as f64 / 65536.0;
                    let min = cube.origin.map(|x| f64::from(x) / 65536.0);
                    let kind = random.below(8);
                    let mut p = match kind {
                        0 => random.point(900.0),
                        1 => random.point((3.0 * side).min(900.0)),
                        _ => [0, 1, 2].map(|i| min[i] + random.within(0.0, side)),
                    };
                    if kind >= 4 {
                        // on planes between cells
                        for i in 0..3 {
                            if random.below(2) == 0 {
                                let level = 1 << random.below(6);
                                let n = random.below(level + 1);
                                p[i] = min[i] + side * n as f64 / level as f64;
                            }
                        }
                    }
                    p.map(|x| x.clamp(-1000.0, 1000.0))
                }

                pub(super) fn ray(
                    &self,
                    random: &mut Random,
                ) -> ([Length; 3], [<A as Arithmetic>::Unit; 3]) {
                    let mut o = self.origin(random);
                    let mut d = random.direction();
                    match random.below(10) {
                        0 => {
                            d = [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]]
                                [random.below(3) as usize]
                        }
                        // nearly along an axis
                        1 => {
                            let mut lsb = || (random.below(41) as f64 - 20.0) / 131072.0;
                            d = [lsb(), lsb(), lsb()];
                            d[random.below(3) as usize] =
                                if random.below(2) == 0 { 1.0 } else { -1.0 };
                        }
                        // in a plane of axes
                        2 => {
                            d[random.below(3) as usize] = 0.0;
                            let l = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
                            d = d.map(|x| x / l);
                        }
                        // through corners of cells, exactly diagonal
                        3 => {
                            let x = (1f64 / 3.0).sqrt();
                            d = d.map(|y| if y < 0.0 { -x } else { x });
                        }
                        // towards a point of the scene
                        4..=7 => {
                            let to = self.origin(random);
                            let v = [to[0] - o[0], to[1] - o[1], to[2] - o[2]];
                            let l = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
                            if l > 1e-3 {
                                d = v.map(|x| x / l);
                            }
                        }
                        // from the centre of a shape
                        8 => {
                            let s = &self.shapes[random.below(self.shapes.len() as u64) as usize];
                            o = s.center().map(|x| f64::from(make::to_grid(x, STEP)) / 65536.0);
                        }
                        _ => {}
                    }
                    (o.map(|x| make::length(x).unwrap()), d.map(|x| make::unit(x).unwrap()))
                }

                /// Tree and list agree; whether there is a hit.
                fn same(
                    &self,
                    tree: &Octree<'_, A>,
                    stack: &mut WalkStack<A>,
                    o: [Length; 3],
                    d: [<A as Arithmetic>::Unit; 3],
                ) -> bool {
                    let mut list = Nearest::<A>::new(&self.shapes, o, d);
                    for id in 0..self.shapes.len() {
                        list.visit(id as u32);
                    }
                    let mut found = Nearest::<A>::new(&self.shapes, o, d);
                    tree.walk(&o, &d, stack, &mut found);
                    assert_eq!(
                        (found.best, found.id),
                        (list.best, list.id),
                        "{o:?} {d:?} {:?}",
                        self.built
                    );
                    list.id != u32::MAX
                }

                /// Shoots so many rays; gives the number that hit.
                pub(super) fn check(&self, random: &mut Random, rays: usize) -> usize {
                    let tree = self.tree();
                    let mut stack = WalkStack::new();
                    let mut hits = 0;
                    for _ in 0..rays {
                        let (o, d) = self.ray(random);
                        hits += usize::from(self.same(&tree, &mut stack, o, d));
                    }
                    hits
                }
            }

            #[test]
            fn many_rays() {
                let mut random = Random(0x1234_5678_9abc_def1);
                let (mut rays, mut hits) = (0, 0);
                for round in 0..90 {
                    let count = [1, 2, 3, 7, 20, 60, 150, 300, 500][random.below(9) as usize];
                    let scene =
                        Scene::new(&spheres(&mut random, round % 9, count), Limits::DEFAULT);
                    hits += scene.check(&mut random, 4000);
                    rays += 4000;
                }
                std::println!("{}: {rays} rays, {hits} hits", A::NAME);
                assert!(hits > rays / 10);
            }

            /// Spheres that end just short of planes between cells, and rays along these planes
            /// that meet them there: what a tree without its margin misses.
            #[test]
            fn caps_at_planes() {
                let mut random = Random(0xfeed_beef);
                let mut hits = 0;
                for round in 0..60 {
                    let side = [1.0, 16.0, 256.0][round % 3];
                    // The first two fix the cube to about ±0.49 sides.
                    let tiny = side * 0.001;
                    let mut all = vec![([-0.49 * side; 3], tiny), ([0.49 * side; 3], tiny)];
                    let mut targets = Vec::new();
                    for _ in 0..100 {
                        let axis = random.below(3) as usize;
                        let mut pole = random.point(side * 0.4);
                        let cells = 8.0;
                        pole[axis] = (pole[axis] / side * cells).round() / cells * side;
                        let short = random.within(-8.0, 1.0) / 65536.0 * side;
                        pole[axis] += short;
                        let r = random.within(0.02, 0.08) * side;
                        let mut center = pole;
                        center[axis] -= r;
                        all.push((center, r));
                        targets.push((axis, pole));
                    }
                    let scene = Scene::new(&all, Limits { leaf: 0, ..Limits::DEFAULT });
                    let tree = scene.tree();
                    for _ in 0..4000 {
                        let (axis, pole) = targets[random.below(100) as usize];
                        let mut d = random.direction();
                        if random.below(3) == 0 {
                            d[(axis + 1) % 3] = 0.0;
                        }
                        d[axis] = 0.0;
                        let l = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
                        if l < 0.1 {
                            continue;
                        }
                        d = d.map(|x| x / l);
                        d[axis] = (random.below(25) as f64 - 12.0) / 131072.0;
                        let t = random.within(0.0, 1.5) * side;
                        let mut o = [0, 1, 2].map(|i| pole[i] - t * d[i]);
                        o[axis] -= random.within(0.0, 3.0) / 65536.0 * side;
                        let o = o.map(|x| make::length(x).unwrap());
                        let d = d.map(|x| make::unit(x).unwrap());
                        hits += usize::from(scene.same(&tree, &mut WalkStack::new(), o, d));
                    }
                }
                assert!(hits > 100_000, "{hits}");
            }

            proptest! {
                #[test]
                fn any_scene(seed in 1u64.., kind in 0u64..9, count in 1usize..200,
                             levels in 0u8..=12, leaf in 0u8..8) {
                    let mut random = Random(seed);
                    let all = spheres(&mut random, kind, count);
                    let levels = if kind == 2 || kind == 3 { levels.min(8) } else { levels };
                    let scene = Scene::new(&all, Limits { levels, leaf, precision: 12 });
                    scene.check(&mut random, 50);
                }
            }
        }
    };
}

against_a_list!(fixed, Fixed, fixed_constructors);
against_a_list!(single, f32, f32_constructors);
against_a_list!(double, f64, f64_constructors);

#[test]
fn statistics() {
    std::println!(
        "shapes | levels | nodes | steps | tests | bytes a shape | scratch a shape | M0+"
    );
    for half in [1.0, 0.5] {
        for count in [16, 64, 256, 1024, 7382] {
            let mut random = Random(77);
            // about as many hits at all counts
            let size = 1.0 / (count as f64).cbrt();
            let all: Vec<_> = (0..count)
                .map(|_| {
                    (
                        random.point(1.0).map(|x| x * 8.0),
                        8.0 * half * size * random.within(0.2, 0.6),
                    )
                })
                .collect();
            let scene = fixed::Scene::new(&all, Limits::DEFAULT);
            let tree = scene.tree();
            let (mut nodes, mut steps, mut tests, mut hits) = (0, 0, 0, 0);
            let rays = 20_000;
            let mut stack = WalkStack::new();
            for _ in 0..rays {
                // from without, towards a point within
                let from = random.direction().map(|x| x * 16.0);
                let to = random.point(8.0);
                let v = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
                let l = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
                let o = from.map(|x| crate::math::fixed_constructors::length(x).unwrap());
                let d = v.map(|x| crate::math::fixed_constructors::unit(x / l).unwrap());
                let mut found = Nearest::<Fixed>::new(&scene.shapes, o, d);
                tree.walk(&o, &d, &mut stack, &mut found);
                nodes += found.nodes;
                steps += found.steps;
                tests += found.tests;
                hits += u32::from(found.id != u32::MAX);
            }
            let per = |n: u32| f64::from(n) / f64::from(rays);
            std::println!(
                "{count} × {half} | {} | {:.1} | {:.1} | {:.1} | {:.1} | {:.1} | {:.0} | {:.2} hit",
                scene.built.levels,
                per(nodes),
                per(steps),
                per(tests),
                4.0 * scene.words.len() as f64 / count as f64,
                scene.built.scratch as f64 / count as f64,
                150.0 * per(nodes) + 110.0 * per(steps) + 170.0 * per(tests),
                per(hits),
            );
        }
    }
}

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
    let mut side = (1u64 << built.cube.log2_side) as f64;
    let mut min = built.cube.origin.map(f64::from);
    let mut word = words[0];
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
static BUFFER: OctreeBuffer<400> = OctreeBuffer::build(&EXTENTS);
static TREE: Octree<Fixed> = Octree::<Fixed>::of(&BUFFER, STEP);

#[test]
fn a_static_tree() {
    assert_eq!(BUFFER.shapes(), 64);
    assert!(BUFFER.built().levels >= 2);
    let mut words = [0; 400];
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
    assert_eq!(build(&one, 0, 1000).unwrap_err(), BuildError::Words);
    assert_eq!(build(&one, 100, 39).unwrap_err(), BuildError::Scratch);
    assert!(build(&one, 100, 40).is_ok());
    assert_eq!(build(&[], 0, 0).unwrap().words, 0);
    for (center, radius) in [([i32::MAX, 0, 0], 1), ([0; 3], -1), ([0, 1 << 27, 0], 1)] {
        let bad = [Extent::Sphere { center, radius }];
        assert_eq!(build(&bad, 10, 10).unwrap_err(), BuildError::Extent);
    }
    let inverted = [Extent::Box { min: [1; 3], max: [0; 3] }];
    assert_eq!(build(&inverted, 10, 10).unwrap_err(), BuildError::Extent);
    let all = [Extent::Box { min: [-(1 << 27); 3], max: [1 << 27; 3] }];
    let built = build(&all, 10, 10).unwrap();
    assert_eq!((built.words, built.cube.log2_side), (1, 29));
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
    assert_eq!(validate(&[leaf(&[0, 4])], 5), Ok(0));
    assert_eq!(validate(&[inner(3, 1), leaf(&[0]), leaf(&[1])], 5), Ok(1));
    assert_eq!(validate(&[leaf(&[5])], 5), Err(TreeError::Id));
    assert_eq!(validate(&[leaf(&[1]), leaf(&[1])], 5), Err(TreeError::Length));
    assert_eq!(validate(&[], 5), Err(TreeError::Length));
    assert_eq!(validate(&[], 0), Ok(0));
    assert_eq!(validate(&[inner(1, 0)], 5), Err(TreeError::Order));
    assert_eq!(validate(&[inner(0, 1)], 5), Err(TreeError::Childless));
    assert_eq!(validate(&[inner(3, 1), leaf(&[1])], 5), Err(TreeError::Truncated));
    assert_eq!(validate(&[node::leaf_of_run(1)], 5), Err(TreeError::Truncated));
    assert_eq!(validate(&[node::leaf_of_run(0)], 5), Err(TreeError::Order));
    let chain: Vec<u32> = (1..40).map(|i| inner(1, i)).collect();
    assert_eq!(validate(&chain, 5), Err(TreeError::TooDeep));
    assert_eq!(validate(&[0; 4], 1 << 23), Err(TreeError::TooManyShapes));
}

/// Words that are nearly a tree.
fn nearly_a_tree() -> impl Strategy<Value = (Vec<u32>, usize)> {
    (1u64.., 1usize..40, 0usize..3, 0usize..40).prop_map(|(seed, count, damage, room)| {
        let mut random = Random(seed);
        if damage == 0 {
            return ((0..room).map(|_| random.next() as u32).collect(), count);
        }
        // grown at random in the right order, then perhaps damaged
        let mut words = vec![0];
        grow(&mut words, 0, 0, count, &mut random);
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

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]
    #[test]
    fn what_passes_can_be_walked((words, count) in nearly_a_tree(), seed in 1u64..) {
        let mut random = Random(seed);
        let origin = random.point(6e7).map(|x| x as i32);
        let cube = Cube { origin, log2_side: 10 + random.below(22) as u8 };
        let tree = Octree::<Fixed>::try_new(&words, count, &cube, STEP);
        if tree.is_ok() {
            prop_assert!(validate(&words, count).is_ok());
        }
        let Ok(tree) = tree else { return Ok(()) };
        for _ in 0..20 {
            use crate::math::fixed_constructors as make;
            let reach = [1000.0, 10.0][random.below(2) as usize];
            let o = random.point(reach).map(|x| make::length(x).unwrap());
            let d = random.direction().map(|x| make::unit(x).unwrap());
            let mut counter = Counter { visits: 0, shapes: count as u32, limit: Fixed::FAR };
            tree.walk(&o, &d, &mut WalkStack::new(), &mut counter);
            prop_assert!(counter.visits <= 40 * words.len());
        }
    }
}

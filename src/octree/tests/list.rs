//! A tree finds what a list finds, to the bit.

use super::grid::Grid;
use super::*;

/// As near to a distance as comes before it.
trait Before {
    fn before(self) -> Self;
}

impl Before for <Fixed as Arithmetic>::Length {
    fn before(self) -> Self {
        self - Self::DELTA
    }
}

impl Before for f32 {
    fn before(self) -> Self {
        self.next_down()
    }
}

impl Before for f64 {
    fn before(self) -> Self {
        self.next_down()
    }
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

                /// The grid, its smallest coordinates and a cell's side.
                fn grid(&self) -> (Grid, [f64; 3], f64) {
                    let grid = Grid::read(self.words[0]).unwrap();
                    let min = self.built.cube.origin.map(|x| f64::from(x) / 65536.0);
                    (grid, min, f64::from(grid.side()) / 65536.0)
                }

                /// An origin of one of many kinds.
                fn origin(&self, random: &mut Random) -> [f64; 3] {
                    let (grid, min, cell) = self.grid();
                    let sides = grid.cells.map(|n| f64::from(n) * cell);
                    let side = sides[0].max(sides[1]).max(sides[2]);
                    let kind = random.below(8);
                    let mut p = match kind {
                        0 => random.point(900.0),
                        1 => random.point((3.0 * side).min(900.0)),
                        _ => [0, 1, 2].map(|i| min[i] + random.within(0.0, sides[i])),
                    };
                    if kind >= 4 {
                        // on planes between cells, the grid's faces among them
                        for i in 0..3 {
                            if random.below(2) == 0 {
                                let parts = 1 << random.below(6).saturating_sub(2);
                                let n = random.below(u64::from(grid.cells[i]) * parts + 1);
                                p[i] = min[i] + cell * n as f64 / parts as f64;
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
                            // whose other components are null, or as null as floats have it
                            d = d.map(|x| if x < 0.0 { -0.0 } else { 0.0 });
                            let axis = random.below(3) as usize;
                            d[axis] = if random.below(2) == 0 { 1.0 } else { -1.0 };
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

                /// Tree and list agree; whether there is a hit. They do if nothing beyond the hit is of
                /// interest, or nothing that isn't nearer, or nothing beyond half of the way to it.
                fn same(
                    &self,
                    tree: &Octree<'_, A>,
                    stack: &mut WalkStack<A>,
                    o: [Length; 3],
                    d: [<A as Arithmetic>::Unit; 3],
                ) -> bool {
                    let mut search = |limit: Length| {
                        let start =
                            || Nearest { best: limit, ..Nearest::<A>::new(&self.shapes, o, d) };
                        let (mut list, mut found) = (start(), start());
                        for id in 0..self.shapes.len() {
                            list.visit(id as u32);
                        }
                        tree.walk(&o, &d, stack, &mut found);
                        assert_eq!(
                            (found.best, found.id),
                            (list.best, list.id),
                            "{o:?} {d:?} {limit:?} {:?}",
                            self.built
                        );
                        list
                    };
                    let nearest = search(A::FAR);
                    if nearest.id == u32::MAX {
                        return false;
                    }
                    assert_eq!(search(nearest.best).id, nearest.id);
                    assert_eq!(search(nearest.best.before()).id, u32::MAX);
                    let half = make::length(Into::<f64>::into(nearest.best) / 2.0).unwrap();
                    assert!(half >= nearest.best || search(half).id == u32::MAX);
                    true
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

            /// Spheres that end just short of planes between cells, on either side, and rays along these
            /// planes that meet them there, from near and far: what a tree without its margin misses.
            #[test]
            fn caps_at_planes() {
                let mut random = Random(0xfeed_beef);
                let mut hits = 0;
                for round in 0..90 {
                    let side = [1.0, 16.0, 256.0][round % 3];
                    // How far from the plane, and how far from the pole: 2⁻¹⁶ of the grid's side.
                    let part = side / 65536.0;
                    let short = [9.0, 60.0][round % 2];
                    // The first two fix the grid to about ±0.49 sides.
                    let tiny = side * 0.001;
                    let mut all = vec![([-0.49 * side; 3], tiny), ([0.49 * side; 3], tiny)];
                    let mut targets = Vec::new();
                    for _ in 0..100 {
                        let axis = random.below(3) as usize;
                        let toward = if random.below(2) == 0 { 1.0 } else { -1.0 };
                        let mut pole = random.point(side * 0.4);
                        pole[axis] = random.within(-0.25, 0.4) * toward * side;
                        let r = random.within(0.02, 0.08) * side;
                        all.push((pole, r));
                        targets.push((axis, toward, pole));
                    }
                    // The grid depends on how large they are, not on where.
                    let limits = Limits { leaf: 0, ..Limits::DEFAULT };
                    let (grid, min, cell) = Scene::new(&all, limits).grid();
                    for ((axis, toward, pole), (center, r)) in targets.iter_mut().zip(&mut all[2..])
                    {
                        let (axis, cell) = (*axis, cell / (1 << random.below(3)) as f64);
                        let n = ((pole[axis] - min[axis]) / cell).round();
                        pole[axis] =
                            min[axis] + n * cell - *toward * random.within(-1.0, short) * part;
                        *center = *pole;
                        center[axis] -= *toward * *r;
                    }
                    let scene = Scene::new(&all, limits);
                    assert_eq!(scene.grid().0, grid);
                    let tree = scene.tree();
                    for _ in 0..4000 {
                        let (axis, toward, pole) = targets[random.below(100) as usize];
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
                        if random.below(3) > 0 {
                            d[axis] = (random.below(25) as f64 - 12.0) / 131072.0;
                        }
                        let d = d.map(|x| make::unit(x).unwrap());
                        let far = [1.5 * side, 1.5 * side, 900.0][random.below(3) as usize];
                        let t = random.within(0.0, far);
                        let way = d.map(Into::<f64>::into);
                        let mut o = [0, 1, 2].map(|i| pole[i] - t * way[i]);
                        o[axis] -= toward * random.within(0.0, 3.0) * part;
                        let o = o.map(|x| make::length(x.clamp(-1000.0, 1000.0)).unwrap());
                        hits += usize::from(scene.same(&tree, &mut WalkStack::new(), o, d));
                    }
                }
                assert!(hits > 150_000, "{hits}");
            }

            /// Small spheres just within the grid's faces, and rays from hundreds of sides away that meet
            /// them before they cross, as soon, a plane between cells: what a ray misses that is moved
            /// too far when it is brought to where it enters.
            #[test]
            fn entered_from_afar() {
                let mut random = Random(0xfa2_fa2);
                let mut hits = 0;
                for _ in 0..20 {
                    let (half, r, step) = (0.49, 0.001, 1.0 / 65536.0);
                    let mut all = vec![([-half; 3], r), ([half; 3], r)];
                    all.extend((0..200).map(|_| (random.point(0.4), r)));
                    let limits = Limits { leaf: 0, ..Limits::DEFAULT };
                    let (grid, min, cell) = Scene::new(&all, limits).grid();
                    let mut ways = Vec::new();
                    for (center, _) in &mut all[2..] {
                        let axis = random.below(3) as usize;
                        let across = (axis + 1 + random.below(2) as usize) % 3;
                        let [from, toward] =
                            [0; 2].map(|_: i32| [-1.0, 1.0][random.below(2) as usize]);
                        center[axis] = from * half;
                        let n = 1 + random.below(u64::from(grid.cells[across]) - 1);
                        let gap = r + random.within(40.0, 400.0) * step;
                        center[across] = min[across] + n as f64 * cell - toward * gap;
                        let mut d = [0.0; 3];
                        d[axis] = -from * random.within(0.2, 0.8);
                        d[across] = toward * (1.0 - d[axis] * d[axis]).sqrt();
                        ways.push((*center, d));
                    }
                    let scene = Scene::new(&all, limits);
                    assert_eq!(scene.grid().0, grid);
                    for (center, d) in ways {
                        let d = d.map(|x| make::unit(x).unwrap());
                        let way = d.map(Into::<f64>::into);
                        for _ in 0..20 {
                            let t = random.within(100.0, 990.0);
                            let near = random.point(0.5 * r);
                            let o = [0, 1, 2].map(|i| center[i] + near[i] - t * way[i]);
                            let o = o.map(|x| make::length(x).unwrap());
                            let stack = &mut WalkStack::new();
                            hits += usize::from(scene.same(&scene.tree(), stack, o, d));
                        }
                    }
                }
                assert!(hits > 20_000, "{hits}");
            }

            /// Rays that hardly move along an axis or two, among shapes that lie close together below cells of
            /// the grid: crossing a cell takes them so long that floats round away where they are on the other axes.
            #[test]
            fn slow_axes() {
                let mut random = Random(0x510_3a8e5);
                let mut hits = 0;
                for _ in 0..20 {
                    let scene = Scene::new(&spheres(&mut random, 1, 300), Limits::DEFAULT);
                    assert!(scene.built.levels > 1);
                    let tree = scene.tree();
                    for _ in 0..4000 {
                        let s = &scene.shapes[random.below(300) as usize];
                        let near = random.point(0.3);
                        let mut d = random.direction();
                        for axis in 0..3 {
                            if random.below(2) == 0 {
                                d[axis] = d[axis].signum() * 10f64.powf(random.within(-9.0, -3.0));
                            }
                        }
                        let l = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
                        if l < 0.1 {
                            continue;
                        }
                        let d = d.map(|x| make::unit(x / l).unwrap());
                        let way = d.map(Into::<f64>::into);
                        let t = random.within(0.0, 60.0);
                        let center =
                            s.center().map(|x| f64::from(make::to_grid(x, STEP)) / 65536.0);
                        let o = [0, 1, 2].map(|i| center[i] + near[i] - t * way[i]);
                        let o = o.map(|x| make::length(x).unwrap());
                        hits += usize::from(scene.same(&tree, &mut WalkStack::new(), o, d));
                    }
                }
                assert!(hits > 20_000, "{hits}");
            }

            /// Scenes of all proportions, flat ones and needles among them: grids of one to eight cells
            /// along each axis.
            #[test]
            fn grids_of_all_proportions() {
                let mut random = Random(0x0b5e_55ed);
                let (mut seen, mut hits) = ([[false; 9]; 3], 0);
                for round in 0..240 {
                    // Eighths of the longest side; 0 is flat.
                    let mut eighths = [0; 3].map(|_| random.below(9));
                    eighths[round % 3] = 8;
                    let size = [0.05, 3.0, 40.0, 500.0][random.below(4) as usize];
                    let count = [4, 30, 200, 600][random.below(4) as usize];
                    let most = size / f64::from(count as u32).cbrt();
                    let all: Vec<_> = (0..count)
                        .map(|_| {
                            let p = random.point(size);
                            let r = (most * random.within(0.02, 0.3)).max(1e-3);
                            ([0, 1, 2].map(|i| p[i] * eighths[i] as f64 / 8.0), r)
                        })
                        .collect();
                    let scene = Scene::new(&all, Limits::DEFAULT);
                    let (grid, ..) = scene.grid();
                    for axis in 0..3 {
                        seen[axis][usize::from(grid.cells[axis])] = true;
                    }
                    hits += scene.check(&mut random, 800);
                }
                assert_eq!(
                    seen.map(|n| n.iter().filter(|&&seen| seen).count()),
                    [8; 3],
                    "{seen:?}"
                );
                assert!(hits > 20_000, "{hits}");
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

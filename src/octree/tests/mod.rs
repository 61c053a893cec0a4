//! What the tests of trees share: random scenes, and a search that keeps count.

extern crate std;

mod list;
mod octants;
mod words;

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

//! Roots, reciprocals and what is made of them, on 64 operands: the rate is operations'.

use std::hint::black_box;

use criterion::{Criterion, Throughput};
use whitted::math::Arithmetic;

use crate::common::make::Make;
use crate::common::random::Random;

const OPERANDS: usize = 64;

/// Operands of everything.
struct Operands<A: Arithmetic> {
    way: [A::Length; 3],
    length: A::Length,
    direction: [A::Unit; 3],
    normal: [A::Unit; 3],
    radiance: A::Radiance,
    other: A::Radiance,
}

fn operands<A: Make>() -> Vec<Operands<A>> {
    let mut random = Random::new(1);
    let mut one = || Operands {
        way: random.point(100.0).map(A::length),
        length: A::length(random.within(0.1, 100.0)),
        direction: random.direction().map(A::unit),
        normal: random.direction().map(A::unit),
        radiance: A::from_q16(random.below(1 << 20) as i32),
        other: A::from_q16(random.below(1 << 20) as i32),
    };
    (0..OPERANDS).map(|_| one()).collect()
}

/// The operations that numbers can be made for outside the library; the others are in the frames.
pub(crate) fn bench<A: Make>(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group(format!("roots/{}", A::NAME));
    group.throughput(Throughput::Elements(OPERANDS as u64));
    let all = operands::<A>();
    macro_rules! bench {
        ($name:literal, $operands:ident => $operation:expr) => {
            group.bench_function($name, |bencher| {
                bencher.iter(|| {
                    for $operands in black_box(&all) {
                        black_box($operation);
                    }
                });
            });
        };
    }
    let inverse = A::normalize(&all[0].way).2;
    bench!("normalize", x => A::normalize(&x.way));
    bench!("renormalize", x => A::renormalize(&x.direction));
    bench!("project", x => A::project(&x.way, &x.direction));
    bench!("along", x => A::along(&x.way, x.length, &x.direction));
    bench!("ratio", x => A::ratio(x.length, x.direction[0]));
    bench!("mirror", x => {
        A::reflect(&x.direction, &x.normal, A::dot(&x.direction, &x.normal))
    });
    bench!("share", x => A::share(x.way[0], &inverse));
    bench!("cosine", x => A::cosine(&x.direction, &x.normal));
    bench!("relative", x => A::relative(x.radiance, x.other));
}

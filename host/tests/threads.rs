//! Any number of threads gives the same picture and counts the same rays.

use std::num::NonZeroUsize;

use whitted_host::bake::Baked;
use whitted_host::document::Size;
use whitted_host::read;
use whitted_host::render::{Sampling, Settings, render};

#[test]
fn the_same_bits_and_counts() {
    let text = include_bytes!("../scenes/showcase.toml");
    let document = read::parse(read::Format::Toml, text).unwrap();
    let baked = Baked::<f32>::new(&document).unwrap();
    let samplings = [
        Sampling::Center,
        Sampling::Corners,
        Sampling::Grid { side: 2 },
        Sampling::Jittered { side: 2, seed: 7 },
        Sampling::ADAPTIVE,
        Sampling::SPARSE,
    ];
    for sampling in samplings {
        let mut one = None;
        for threads in [1, 2, 3, 64] {
            let settings = Settings {
                indirect: None,
                size: Size { width: 64, height: 100 },
                depth: 4,
                sampling,
                show: None,
                threads: NonZeroUsize::new(threads).unwrap(),
            };
            let mut told = 0;
            let made = render(&baked, &settings, |done| told = done).unwrap();
            assert_eq!(told, 100, "rows are told of");
            let made = (made.picture, made.counts);
            let first = one.get_or_insert_with(|| made.clone());
            assert!(*first == made, "{sampling:?} on {threads} threads");
        }
    }
}

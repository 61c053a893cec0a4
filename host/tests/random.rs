//! Readers and baking survive anything: random bytes, and good scenes with something changed.

use proptest::prelude::*;
use whitted::math::Fixed;
use whitted_host::bake::Baked;
use whitted_host::read::{Format, parse};

const SHOWCASE: &str = include_str!("../scenes/showcase.toml");
const SHAPES: &str = include_str!("../scenes/shapes.toml");
const NFF: &str = "b 0.1 0.2 0.3\nv\nfrom 1 2 3\nat 0 0 0\nup 0 0 1\nangle 45\nhither 1\n\
    resolution 8 8\nl 1 2 3\nl 4 5 6 1 1 1\nf 1 0.5 0.5 0.5 0.5 3 0.5 1.5\ns 0 0 0 1\n\
    c 0 0 0 1 0 0 1 0.5\np 5\n0 0 0\n2 0 0\n2 2 0\n1 1 0\n0 2 0\npp 3\n0 0 0 0 0 1\n1 0 0 0 0 1\n\
    1 1 0 0 0 1\n";

/// Words that mean something, to get beyond the first error.
fn words() -> impl Strategy<Value = String> {
    let word = prop_oneof![
        prop::sample::select(vec![
            "v",
            "from",
            "at",
            "up",
            "angle",
            "b",
            "l",
            "f",
            "s",
            "c",
            "p",
            "pp",
            "resolution",
            "1",
            "0",
            "3",
            "4",
            "-1",
            "0.5",
            "1e8",
            "-1e8",
            "1e-300",
            "nan",
            "inf",
            "#",
            "\n",
        ])
        .prop_map(str::to_string),
        any::<f64>().prop_map(|x| x.to_string()),
    ];
    prop::collection::vec(word, 0..60).prop_map(|words| words.join(" "))
}

/// Reads, and if that works bakes: the only wrong answer is a panic.
fn survives(format: Format, bytes: &[u8]) {
    if let Ok(document) = parse(format, bytes) {
        let _ = Baked::<f64>::new(&document);
        let _ = Baked::<Fixed>::new(&document);
    }
}

/// Some bytes of a text replaced, inserted or cut out.
fn changed(text: &str, changes: &[(usize, u8, u8)]) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for &(place, kind, byte) in changes {
        let place = place % (bytes.len() + 1);
        match kind % 4 {
            0 if place < bytes.len() => bytes[place] = byte,
            1 => bytes.insert(place, byte),
            2 => bytes.truncate(place.max(bytes.len() / 2)),
            _ if place < bytes.len() => {
                bytes.remove(place);
            }
            _ => {}
        }
    }
    bytes
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn bytes(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        survives(Format::Nff, &bytes);
        survives(Format::Toml, &bytes);
    }

    #[test]
    fn nff_words(text in words()) {
        survives(Format::Nff, text.as_bytes());
        let rest = format!("{NFF}{text}");
        survives(Format::Nff, rest.as_bytes());
    }

    #[test]
    fn changed_scenes(
        changes in prop::collection::vec((any::<usize>(), any::<u8>(), 32u8..127), 1..6),
    ) {
        survives(Format::Nff, &changed(NFF, &changes));
        survives(Format::Toml, &changed(SHOWCASE, &changes));
        survives(Format::Toml, &changed(SHAPES, &changes));
    }
}

//! Samplings as a person writes them, in a scene's `[render]` and after `--sampling`.

use std::str::FromStr;

use whitted::frame::Sampling;

/// The ways there are, as an error lists them.
pub const FORMS: &str = "center, corners, grid:N, jittered:N[:SEED], \
                         adaptive[:DEPTH[:THRESHOLD]] or sparse[:SIDE[:THRESHOLD]]";

/// Reads one of the [`FORMS`].
///
/// # Errors
/// What is wrong, and what would be right.
pub fn parse(text: &str) -> Result<Sampling, String> {
    let mut parts = text.split(':');
    let name = parts.next().unwrap_or_default();
    let numbers: Vec<&str> = parts.collect();
    let cells = |text| number(text, "a number of cells each way, 1 to 8", |n| (1..=8).contains(&n));
    let depth = |text| number(text, "a number of halvings, 1 to 3", |n| (1..=3).contains(&n));
    let side =
        |text| number(text, "a block's side, 2, 4, 8 or 16", |n: u8| [2, 4, 8, 16].contains(&n));
    let threshold = |text| number(text, "a threshold on 8-bit sRGB, 0 to 255", |_| true);
    match (name, numbers.as_slice(), Sampling::ADAPTIVE, Sampling::SPARSE) {
        ("center", [], ..) => Ok(Sampling::Center),
        ("corners", [], ..) => Ok(Sampling::Corners),
        ("grid", [n], ..) => Ok(Sampling::Grid { side: cells(n)? }),
        ("jittered", [n], ..) => Ok(Sampling::Jittered { side: cells(n)?, seed: 0 }),
        ("jittered", [n, seed], ..) => {
            let seed = number(seed, "a seed, 0 to 65535", |_| true)?;
            Ok(Sampling::Jittered { side: cells(n)?, seed })
        }
        ("adaptive", [], usual, _) => Ok(usual),
        ("adaptive", [n], Sampling::Adaptive { threshold, .. }, _) => {
            Ok(Sampling::Adaptive { depth: depth(n)?, threshold })
        }
        ("adaptive", [n, t], ..) => {
            Ok(Sampling::Adaptive { depth: depth(n)?, threshold: threshold(t)? })
        }
        ("sparse", [], _, usual) => Ok(usual),
        ("sparse", [n], _, Sampling::Sparse { threshold, .. }) => {
            Ok(Sampling::Sparse { side: side(n)?, threshold })
        }
        ("sparse", [n, t], ..) => Ok(Sampling::Sparse { side: side(n)?, threshold: threshold(t)? }),
        _ => Err(format!("{text:?} isn't a sampling: it is {FORMS}")),
    }
}

fn number<N: FromStr + Copy>(
    text: &str,
    wanted: &str,
    right: impl Fn(N) -> bool,
) -> Result<N, String> {
    let read = text.parse().ok().filter(|&n| right(n));
    read.ok_or_else(|| format!("{text:?} isn't {wanted}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_form_is_read() {
        for (text, sampling) in [
            ("center", Sampling::Center),
            ("corners", Sampling::Corners),
            ("grid:8", Sampling::Grid { side: 8 }),
            ("jittered:2", Sampling::Jittered { side: 2, seed: 0 }),
            ("jittered:2:65535", Sampling::Jittered { side: 2, seed: 65535 }),
            ("adaptive", Sampling::ADAPTIVE),
            ("adaptive:2:0", Sampling::Adaptive { depth: 2, threshold: 0 }),
            ("sparse", Sampling::SPARSE),
            ("sparse:16:255", Sampling::Sparse { side: 16, threshold: 255 }),
        ] {
            assert_eq!(parse(text), Ok(sampling));
        }
        let Sampling::Adaptive { threshold, .. } = Sampling::ADAPTIVE else { panic!() };
        assert_eq!(parse("adaptive:1"), Ok(Sampling::Adaptive { depth: 1, threshold }));
        let Sampling::Sparse { threshold, .. } = Sampling::SPARSE else { panic!() };
        assert_eq!(parse("sparse:8"), Ok(Sampling::Sparse { side: 8, threshold }));
    }

    #[test]
    fn mistakes_say_what_would_be_right() {
        for (text, says) in [
            ("", "\"\" isn't a sampling: it is center, corners, grid:N"),
            ("grid", "\"grid\" isn't a sampling"),
            ("grid:9", "\"9\" isn't a number of cells each way, 1 to 8"),
            ("jittered:4:x", "\"x\" isn't a seed, 0 to 65535"),
            ("adaptive:4", "\"4\" isn't a number of halvings, 1 to 3"),
            ("adaptive:2:256", "\"256\" isn't a threshold on 8-bit sRGB, 0 to 255"),
            ("sparse:3", "\"3\" isn't a block's side, 2, 4, 8 or 16"),
            ("sparse:4:8:1", "isn't a sampling"),
        ] {
            let error = parse(text).unwrap_err();
            assert!(error.contains(says), "{text}: {error}");
        }
    }
}

//! How fast a board would draw: its tracing and its display's wires, whichever is slower.

use std::time::Duration;

use whitted_host::need::{BOARDS, Board, Pixel};

/// Bits that a pixel takes on the wire.
const BITS: f64 = 16.0;

/// Seconds a pixel: a board's tracing, estimated as `whitted check` does, while the pixel before
/// is on its way at so many megahertz.
pub(super) fn seconds(board: Option<(&Board, Pixel)>, spi_mhz: Option<f64>) -> f64 {
    let tracing = board
        .map_or(0.0, |(board, pixel)| board.core.cycles(&pixel) / (board.mhz * 1e6 * board.cores));
    let sending = spi_mhz.map_or(0.0, |mhz| BITS / (mhz * 1e6));
    tracing.max(sending)
}

/// How many pixels are there after a time.
pub(super) fn pixels(seconds: f64, time: Duration) -> u64 {
    if seconds > 0.0 { (time.as_secs_f64() / seconds) as u64 } else { u64::MAX }
}

/// The board that a person means: its name, its end, or a part that no other board's has; capitals,
/// blanks and signs don't count.
pub(super) fn board(text: &str) -> Result<&'static Board, String> {
    let plain = |name: &str| {
        name.chars().filter(|c| c.is_ascii_alphanumeric()).collect::<String>().to_ascii_lowercase()
    };
    let text = plain(text);
    let only = |fits: &dyn Fn(&str) -> bool| {
        let mut found = BOARDS.iter().filter(|board| fits(&plain(board.name)));
        found.next().filter(|_| found.next().is_none() && !text.is_empty())
    };
    only(&|name| name.ends_with(&text)).or_else(|| only(&|name| name.contains(&text))).ok_or_else(
        || {
            let names = BOARDS.map(|board| board.name).join(", ");
            format!("it isn't one of the boards {names}, or a part of one name alone, as in pico2")
        },
    )
}

/// A clock of SPI, in megahertz.
pub(super) fn megahertz(text: &str) -> Result<f64, String> {
    let read = text.parse().ok().filter(|mhz| (0.001..=1000.0).contains(mhz));
    read.ok_or_else(|| "write megahertz, 0.001 to 1000, as in 62.5".to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use whitted_host::need::Core;

    #[test]
    fn boards_by_what_people_call_them() {
        for (text, name) in [
            ("pico", "Raspberry Pi Pico"),
            ("Pico 2", "Raspberry Pi Pico 2"),
            ("pico2", "Raspberry Pi Pico 2"),
            ("f411", "STM32F411 (Black Pill)"),
            ("nrf52840", "nRF52840"),
            ("microbit1", "BBC micro:bit 1"),
        ] {
            assert_eq!(board(text).unwrap().name, name);
        }
        for text in ["", "microbit", "esp32", "raspberry"] {
            assert!(board(text).unwrap_err().contains("Raspberry Pi Pico 2, "), "{text}");
        }
    }

    #[test]
    fn the_slower_of_tracing_and_sending() {
        let core = Core { pixel: 1000.0, ray: 0.0, test: 0.0, node: 0.0, lookup: 0.0 };
        let board = Board { mhz: 100.0, cores: 2.0, core, ..BOARDS[0] };
        let pixel =
            Pixel { rays: 1.0, shadow: 1.0, nodes: 1.0, tests: 1.0, lookups: 0.0, deepest: 1 };
        let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
        close(seconds(Some((&board, pixel)), None), 5e-6);
        close(seconds(Some((&board, pixel)), Some(62.5)), 5e-6);
        close(seconds(Some((&board, pixel)), Some(1.6)), 10e-6);
        close(seconds(None, Some(62.5)), 16.0 / 62.5e6);
        assert_eq!(pixels(5e-6, Duration::from_millis(1)), 200);
        assert_eq!(pixels(seconds(None, None), Duration::ZERO), u64::MAX);
    }

    #[test]
    fn clocks() {
        assert_eq!(megahertz("62.5"), Ok(62.5));
        for text in ["0", "-1", "NaN", "1001", "fast", ""] {
            assert!(megahertz(text).is_err(), "{text}");
        }
    }
}

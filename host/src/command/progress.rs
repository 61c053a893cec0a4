//! A bar on stderr while a picture is rendered, for terminals alone.

use std::io::{IsTerminal, stderr};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A bar of so many rows; it shows nothing where nobody would see it, or `quiet` is wished.
pub(super) fn bar(rows: u32, quiet: bool) -> ProgressBar {
    if quiet || !stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:40} {percent:>3} %  {eta} left")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    let bar =
        ProgressBar::with_draw_target(Some(rows.into()), ProgressDrawTarget::stderr_with_hz(10));
    bar.set_style(style);
    // Short renders end before anything is drawn.
    bar.set_elapsed(Duration::ZERO);
    bar
}

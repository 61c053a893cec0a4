//! Tables of `docs/precision.md` that tests keep: they hold it to what they assert, or write it.

extern crate std;

use std::prelude::v1::*;

const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/precision.md");

/// The page has this table; with `WHITTED_RENEW` set, it gets it in place of the one of the same first column:
/// one test after the other (`--test-threads 1`).
pub(crate) fn states(table: &str) {
    let page = std::fs::read_to_string(PAGE).unwrap();
    if page.contains(table) {
        return;
    }
    assert!(std::env::var_os("WHITTED_RENEW").is_some(), "run this with WHITTED_RENEW=1");
    let (first, _) = table.split_once(" | ").unwrap();
    let (before, rest) = page.split_once(first).unwrap();
    let after = rest.split_once("\n\n").map_or("", |(_, after)| after);
    std::fs::write(PAGE, std::format!("{before}{table}\n{after}")).unwrap();
}

//! `[indirect]`: the light that surfaces send each other.

use super::table::Table;
use crate::document::{Cache, FARTHEST, Indirect, VirtualLights};
use crate::error::{Flaw, Problem};

#[derive(Clone, Copy)]
enum Kind {
    Cache,
    VirtualLights,
}

const KINDS: [(&str, Kind); 2] = [("cache", Kind::Cache), ("virtual-lights", Kind::VirtualLights)];

/// Reads the table.
pub(super) fn read(table: &Table<'_>) -> Result<Indirect, Flaw> {
    let kind = table.need("type")?.word("type", &KINDS)?;
    let count = |key: &'static str, low: u32, high: u32, default: u32| {
        table.get(key).map_or(Ok(default), |v| v.count(key, low, high))
    };
    let distance = |key: &'static str| table.get(key).map(|value| value.positive(key)).transpose();
    let indirect = match kind {
        Kind::Cache => {
            let like = Cache::DEFAULT;
            let cache = Cache {
                error: table.number("error", 0.05..1.0, like.error)?,
                rays: count("rays", 1, 800, like.rays)?,
                bounces: count("bounces", 1, 16, like.bounces)?,
                records: count("records", 1, 1_000_000, like.records)?,
                nearest: distance("nearest")?,
                farthest: distance("farthest")?,
                seed: count("seed", 0, 65535, like.seed)?,
            };
            let (nearest, farthest) = (cache.nearest, cache.farthest.unwrap_or(FARTHEST));
            if nearest.is_some_and(|nearest| nearest > farthest) {
                let why = "\"nearest\" is larger than \"farthest\"";
                return Err(Problem::degenerate("indirect", why).at(table.line));
            }
            Indirect::Cache(cache)
        }
        Kind::VirtualLights => {
            let like = VirtualLights::DEFAULT;
            let tile = match table.get("tile") {
                None => like.tile,
                Some(value) => match value.count("tile", 1, 4)? {
                    3 => return Err(Problem::range("tile", 3.0, "1, 2 or 4").at(value.line)),
                    tile => tile,
                },
            };
            Indirect::VirtualLights(VirtualLights {
                lights: count("lights", 1, 65536, like.lights)?,
                bounces: count("bounces", 1, 4, like.bounces)?,
                tile,
                nearest: distance("nearest")?,
            })
        }
    };
    table.done()?;
    Ok(indirect)
}

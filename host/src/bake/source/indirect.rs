//! The light that surfaces send each other as Rust source: irradiance records or virtual lights,
//! made here and read-only there.

use std::fmt::{self, Write as _};

use super::write_list;
use crate::bake::Glow;

/// Writes what was made, and a const of it; gives the field of `Parts`.
pub(super) fn write(
    to: &mut String,
    glow: &Glow,
) -> Result<Option<(&'static str, String)>, fmt::Error> {
    match glow {
        Glow::None => return Ok(None),
        Glow::Cache { records, error } => {
            let records: Vec<String> = records
                .iter()
                .map(|record| {
                    format!("whitted::gather::Record::<A>::new(whitted::gather::{record:?})")
                })
                .collect();
            write_list(to, "RECORDS", "whitted::gather::Record<A>", &records)?;
            writeln!(
                to,
                "const INDIRECT: whitted::gather::Indirect<'static, A> =\n    \
                 whitted::gather::Indirect::Cache(\n        \
                 whitted::gather::IrradianceCache::<A>::new(&RECORDS, {error:?}));\n"
            )?;
        }
        Glow::VirtualLights { lights, settings } => {
            let lights: Vec<String> = lights
                .iter()
                .map(|light| {
                    format!("whitted::gather::VirtualLight::<A>::new(whitted::gather::{light:?})")
                })
                .collect();
            write_list(to, "VIRTUAL_LIGHTS", "whitted::gather::VirtualLight<A>", &lights)?;
            writeln!(
                to,
                "const INDIRECT: whitted::gather::Indirect<'static, A> =\n    \
                 whitted::gather::Indirect::VirtualLights(whitted::gather::VirtualLights::new(\n        \
                 &VIRTUAL_LIGHTS,\n        \
                 &whitted::gather::VirtualLightsSettings::<A>::new(\n            \
                 whitted::gather::{settings:?})));\n"
            )?;
        }
    }
    Ok(Some(("indirect", "INDIRECT".into())))
}

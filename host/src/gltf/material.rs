//! From metal, roughness and base colour to Phong's coefficients.
//!
//! With the base colour b, metal m, roughness r and transmission t of the file:
//!
//! | model | rule |
//! |---|---|
//! | k_d | b·(1 − m)·(1 − t) |
//! | k_sg | m·b·(1 − r)²: smooth metals mirror |
//! | n_s | (2/r⁴ − 2)/4, within 1 to 1000: the lobe of the microfacets' half-vectors (Walter et al. 2007, with α = r²) is four times as narrow as Phong's (Fisher and Woo 1994) |
//! | k_s | F·(n_s + 2)/2, at most 1, with F = 0.04·(1 − m) + m·b: Phong's lobe, normalised |
//! | k_tg | t·b, refracted by the index of the file |
//! | texture | baseColorTexture, that k_d and k_amb are multiplied by |
//! | k_amb | b·(1 − t)·(1 − m·(1 − r)²): what isn't transmitted or mirrored |
//! | L_e | emissiveFactor times its strength |

use gltf_json::material::{AlphaMode, Material as Theirs};
use gltf_json::validation::Checked;

use super::Noticed;
use crate::document::{Material, Rgb, ShadowThrough};
use crate::error::Problem;

/// What a dielectric of index 1.5 reflects when it is met head on.
const DIELECTRIC: f64 = 0.04;

/// As bright as a scene of ours may say.
const BRIGHTEST: f64 = 1000.0;

pub(super) fn read(
    theirs: &Theirs,
    place: &str,
    noticed: &mut Noticed,
) -> Result<Material, Problem> {
    let pbr = &theirs.pbr_metallic_roughness;
    let within = |what: &str, value: f32, high: f64| {
        let value = f64::from(value);
        if (0.0..=high).contains(&value) {
            return Ok(value);
        }
        Err(Problem::range(format!("{place}.{what}"), value, format!("0 to {high}")))
    };
    let [red, green, blue, alpha] = pbr.base_color_factor.0;
    let color = |what: &str, rgb: [f32; 3]| -> Result<Rgb, Problem> {
        let [r, g, b] = rgb;
        Ok([within(what, r, 1.0)?, within(what, g, 1.0)?, within(what, b, 1.0)?])
    };
    let base = color("pbrMetallicRoughness.baseColorFactor", [red, green, blue])?;
    let alpha = within("pbrMetallicRoughness.baseColorFactor alpha", alpha, 1.0)?;
    let metal = within("pbrMetallicRoughness.metallicFactor", pbr.metallic_factor.0, 1.0)?;
    let rough = within("pbrMetallicRoughness.roughnessFactor", pbr.roughness_factor.0, 1.0)?;
    let emission = color("emissiveFactor", theirs.emissive_factor.0)?;
    let more = theirs.extensions.as_ref();
    let strength = more.and_then(|more| more.emissive_strength.as_ref());
    let strength = strength.map_or(1.0, |strength| strength.emissive_strength.0);
    let strength = within("extensions emissiveStrength", strength, BRIGHTEST)?;
    let through = more.and_then(|more| more.transmission.as_ref());
    let mut through = match through {
        Some(through) => {
            if through.transmission_texture.is_some() {
                noticed.leave_out("textures other than the base colour's", place);
            }
            within("extensions transmissionFactor", through.transmission_factor.0, 1.0)?
        }
        None => 0.0,
    };
    let mut index = match more.and_then(|more| more.ior.as_ref()) {
        Some(ior) if through > 0.0 => {
            let ior = f64::from(ior.ior.0);
            if !(1.0..=4.0).contains(&ior) {
                let what = format!("{place}.extensions ior");
                return Err(Problem::range(what, ior, "1 to 4"));
            }
            ior
        }
        _ => 1.5,
    };
    match theirs.alpha_mode {
        Checked::Valid(AlphaMode::Blend) if alpha < 1.0 && through == 0.0 => {
            // What blends isn't refracted.
            (through, index) = (1.0 - alpha, 1.0);
        }
        Checked::Valid(AlphaMode::Mask) => noticed.leave_out("masks (alphaMode MASK)", place),
        _ => {}
    }
    let textures = pbr.metallic_roughness_texture.is_some()
        || theirs.normal_texture.is_some()
        || theirs.occlusion_texture.is_some()
        || theirs.emissive_texture.is_some();
    if textures {
        noticed.leave_out("textures other than the base colour's", place);
    }
    let smooth = (1.0 - rough).powi(2);
    let lobe = ((2.0 / rough.powi(4).max(1e-6) - 2.0) / 4.0).clamp(1.0, 1000.0);
    let normal = |b: f64| DIELECTRIC * (1.0 - metal) + metal * b;
    let transmission = base.map(|b| b * through);
    let transmits = transmission.iter().any(|&k| k > 0.0);
    Ok(Material {
        name: theirs.name.clone().unwrap_or_default(),
        ambient: base.map(|b| b * (1.0 - through) * (1.0 - metal * smooth)),
        diffuse: base.map(|b| b * (1.0 - metal) * (1.0 - through)),
        specular: base.map(|b| (normal(b) * (lobe + 2.0) / 2.0).min(1.0)),
        shininess: lobe,
        reflection: base.map(|b| metal * b * smooth),
        transmission,
        index_behind: if transmits { index } else { 1.0 },
        emission: emission.map(|e| e * strength),
        shadow: if transmits { ShadowThrough::Filtered } else { ShadowThrough::Opaque },
        ..Material::matt(0)
    })
}

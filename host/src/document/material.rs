//! Materials: every coefficient of the model, per channel.

use super::{Point, Rgb, Texture};

/// What a shadow ray finds where it meets the material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShadowThrough {
    /// Nothing passes.
    Opaque,
    /// The part k_tg passes, along the straight line.
    Filtered,
    /// Everything passes.
    None,
}

/// A pattern of two materials in cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checker {
    /// The side of a cell along each axis; 0 where the pattern doesn't change along it.
    pub cell: Point,
    /// The corner of a cell.
    pub offset: Point,
    /// The material of the cells whose index sum is odd.
    pub other: usize,
}

/// What a surface does with light.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// What the file calls it; empty where it has no names.
    pub name: String,
    /// k_amb.
    pub ambient: Rgb,
    /// k_d, the albedo.
    pub diffuse: Rgb,
    /// k_s.
    pub specular: Rgb,
    /// n_s, Phong's exponent.
    pub shininess: f64,
    /// k_sg, the part mirrored.
    pub reflection: Rgb,
    /// k_tg, the part transmitted.
    pub transmission: Rgb,
    /// The index of refraction on the side that the normal points to.
    pub index_front: f64,
    /// The index on the other side: inside a closed shape.
    pub index_behind: f64,
    /// L_e: what its front emits.
    pub emission: Rgb,
    /// What a shadow ray finds.
    pub shadow: ShadowThrough,
    /// Cells of another material.
    pub checker: Option<Checker>,
    /// What `diffuse` and `ambient` are multiplied by.
    pub texture: Option<Texture>,
    /// What bends the normal that shading sees.
    pub bump: Option<Texture>,
    /// Reflection and transmission are weighted by Fresnel's formula.
    pub fresnel: bool,
    /// What a unit of length takes of the light, as the a of exp(−a·d), before the surface and behind.
    pub absorption: [Rgb; 2],
    /// The lines that say so.
    pub absorption_lines: [usize; 2],
    /// The line of the file that it starts on.
    pub line: usize,
}

impl Material {
    /// A grey, matt material, from which readers start.
    pub fn matt(line: usize) -> Self {
        Self {
            name: String::new(),
            ambient: [0.8; 3],
            diffuse: [0.8; 3],
            specular: [0.0; 3],
            shininess: 32.0,
            reflection: [0.0; 3],
            transmission: [0.0; 3],
            index_front: 1.0,
            index_behind: 1.0,
            emission: [0.0; 3],
            shadow: ShadowThrough::Opaque,
            checker: None,
            texture: None,
            bump: None,
            fresnel: false,
            absorption: [[0.0; 3]; 2],
            absorption_lines: [line; 2],
            line,
        }
    }

    /// Whether light passes.
    pub fn transmits(&self) -> bool {
        self.transmission.iter().any(|&k| k > 0.0)
    }

    /// Whether a medium at its sides takes light.
    pub fn absorbs(&self) -> bool {
        self.absorption.as_flattened().iter().any(|&a| a > 0.0)
    }

    /// Whether it mirrors.
    pub fn reflects(&self) -> bool {
        self.reflection.iter().any(|&k| k > 0.0)
    }
}

//! The shapes of a scene by their numbers: one list a kind, numbered through.

use super::{Parts, SceneError};
use crate::math::Arithmetic;
use crate::shape::MaterialId;

/// Evaluates `$body` with `$shape` bound to the shape of number `$id`, whatever its kind; `$none`
/// where there is no such shape. The slices' own bounds checks are what finds the kind.
macro_rules! with_shape {
    ($parts:expr, $id:expr, $shape:ident => $body:expr, $none:expr) => {{
        let parts = $parts;
        let index = $id as usize;
        if let Some($shape) = parts.spheres.get(index) {
            $body
        } else {
            let index = index.wrapping_sub(parts.spheres.len());
            if let Some($shape) = parts.planes.get(index) { $body } else { $none }
        }
    }};
}
pub(crate) use with_shape;

/// Every shape's material must be there.
pub(super) const fn check_materials<A: Arithmetic>(parts: &Parts<'_, A>) -> Result<(), SceneError> {
    macro_rules! check {
        ($($kind:ident),*) => {
            $(
                let mut i = 0;
                while i < parts.$kind.len() {
                    let id: MaterialId = parts.$kind[i].material_id();
                    if id.index() >= parts.materials.len() {
                        return Err(SceneError::Material { index: id.index() as u16 });
                    }
                    i += 1;
                }
            )*
        };
    }
    check!(spheres, planes);
    Ok(())
}

//! Scenes: borrowed slices of shapes, materials and lights, validated once.
//!
//! A scene is put together from [`Parts`], slices that lie in flash or in buffers of the
//! caller's, and checked by [`Scene::new`], a const fn; after that nothing is checked again.
//!
//! ```
//! use whitted::math::Fixed;
//! use whitted::scene::{Ambient, Background, Light, Material, MaterialSpec, Parts, Scene};
//! use whitted::shape::{Plane, Sphere};
//!
//! static SCENE: Scene<Fixed> = Scene::checked(Parts {
//!     spheres: &[Sphere::<Fixed>::new([0.0, 1.0, 4.0], 1.0, 0)],
//!     planes: &[Plane::<Fixed>::new([0.0, 1.0, 0.0], 0.0, 1)],
//!     materials: &[
//!         Material::<Fixed>::new(MaterialSpec {
//!             diffuse: [0.8, 0.1, 0.1],
//!             reflection: [0.2; 3],
//!             ..MaterialSpec::BLACK
//!         }),
//!         Material::<Fixed>::new(MaterialSpec { diffuse: [0.7; 3], ..MaterialSpec::BLACK }),
//!     ],
//!     lights: &[Light::<Fixed>::point([-4.0, 5.0, -3.0], [40.0; 3])],
//!     background: Background::<Fixed>::uniform([0.2, 0.4, 0.8]),
//!     ..Parts::EMPTY
//! });
//! ```

mod absorption;
mod area_light;
mod background;
mod camera;
mod error;
mod group;
mod instance;
mod light;
mod material;
mod parts;
mod rules;
mod scene_ref;
mod selection;
mod shapes;
mod texture;
mod transform;
pub mod uses;

pub use absorption::Absorption;
pub use area_light::{Area, AreaLight, AreaLightSpec, FanCorner};
pub use background::Background;
pub use camera::{Camera, Row, View};
pub use error::SceneError;
pub use group::Group;
pub use instance::Instance;
pub use light::{Falloff, Light, LightSpec};
pub use material::{Material, MaterialSpec, PatternSpec, Shadow};
pub use parts::Parts;
pub use rules::Rules;
pub use scene_ref::SceneRef;
pub(crate) use scene_ref::{ShapesOf, is_known};
pub use selection::Selection;
pub use shapes::Shapes;
pub(crate) use shapes::with_shape;
pub use texture::{
    Filter, Image, Mapping, Pattern, Texels, Texture, TextureSpec, TriangleUv, Wrap,
};
pub use transform::Transform;

pub(crate) use area_light::Form;
pub(crate) use light::{Incident, Source};

use crate::gather::Indirect;
use crate::math::{Arithmetic, Rgb};
use crate::shape::MaterialId;
use uses::has;

/// The ambient irradiance E_amb divided by π, the same in the whole scene.
#[derive(Clone, Copy, Debug)]
pub struct Ambient<A: Arithmetic>(pub Rgb<A::Radiance>);

/// A scene that has been checked: what rays are traced in.
///
/// `USES` says what it may hold: anything, by default (see [`uses`]).
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a, A: Arithmetic, const USES: u64 = { uses::ALL }> {
    pub(crate) parts: Parts<'a, A>,
    /// The shapes of the parts.
    pub(crate) shapes: Shapes<'a, A>,
    /// All materials stop shadow rays, so that a shadow ray may end at the first hit.
    pub(crate) opaque_shadows: bool,
    /// The number of bounded shapes, and of the first instance's first shape.
    pub(crate) bounded: u32,
    /// The number of the first plane.
    pub(crate) first_plane: u32,
}

impl<'a, A: Arithmetic> Scene<'a, A> {
    /// Checks the parts: every index, and the tree.
    ///
    /// # Errors
    /// What doesn't fit together.
    pub const fn new(parts: Parts<'a, A>) -> Result<Self, SceneError> {
        Self::try_tailored(parts)
    }

    /// The same for scenes in `static`s: a mistake doesn't compile.
    ///
    /// # Panics
    /// Where [`new`](Self::new) has an error.
    pub const fn checked(parts: Parts<'a, A>) -> Self {
        Self::tailored(parts)
    }
}

impl<'a, A: Arithmetic, const USES: u64> Scene<'a, A, USES> {
    /// Checks the parts of a scene that uses no more than its type says, which
    /// [`Parts::uses`] tells.
    ///
    /// # Errors
    /// What doesn't fit together, or isn't in `USES`.
    pub const fn try_tailored(parts: Parts<'a, A>) -> Result<Self, SceneError> {
        let shapes = parts.shapes();
        if let Err(error) = shapes.check(parts.materials.len()) {
            return Err(error);
        }
        let mut i = 0;
        while i < parts.planes.len() {
            let id = parts.planes[i].material_id();
            if id.index() >= parts.materials.len() {
                return Err(SceneError::Material { index: id.index() as u16 });
            }
            i += 1;
        }
        let mut opaque_shadows = true;
        let mut i = 0;
        while i < parts.materials.len() {
            let material = &parts.materials[i];
            if !matches!(material.shadow, Shadow::Opaque) {
                opaque_shadows = false;
            }
            if let Some(pattern) = &material.pattern
                && pattern.other as usize >= parts.materials.len()
            {
                return Err(SceneError::Material { index: pattern.other });
            }
            if let Err(error) = detail_is_there(&parts, material) {
                return Err(error);
            }
            i += 1;
        }
        let mut i = 0;
        while i < parts.textures.len() {
            if let Some(other) = parts.textures[i].other()
                && other as usize >= parts.materials.len()
            {
                return Err(SceneError::Material { index: other });
            }
            i += 1;
        }
        let mut i = 0;
        while i < parts.area_lights.len() {
            let (first, count) = parts.area_lights[i].fan_range();
            if first as u64 + count as u64 > parts.light_corners.len() as u64 {
                return Err(SceneError::Fan { light: i as u32 });
            }
            i += 1;
        }
        let bounded = shapes.bounded();
        let first_plane = match Self::number(&parts, parts.instances) {
            Ok(number) => number,
            Err(error) => return Err(error),
        };
        let missing = parts.uses() & !USES;
        if missing != 0 {
            return Err(SceneError::Uses { missing });
        }
        Ok(Self { parts, shapes, opaque_shadows, bounded, first_plane })
    }

    /// The same scene with other instances: for objects that move. Nothing else is looked at.
    ///
    /// # Errors
    /// A material that isn't there; what isn't in `USES`.
    pub const fn with_instances<'b>(
        &self,
        instances: &'b [Instance<'b, A>],
    ) -> Result<Scene<'b, A, USES>, SceneError>
    where
        'a: 'b,
    {
        let first_plane = match Self::number(&self.parts, instances) {
            Ok(number) => number,
            Err(error) => return Err(error),
        };
        let missing = uses::of_instances(instances) & !USES;
        if missing != 0 {
            return Err(SceneError::Uses { missing });
        }
        Ok(Scene {
            parts: Parts { instances, ..self.parts },
            shapes: self.shapes,
            opaque_shadows: self.opaque_shadows,
            bounded: self.bounded,
            first_plane,
        })
    }

    /// The number of the first plane; the materials of the instances must be there.
    const fn number(
        parts: &Parts<'_, A>,
        instances: &[Instance<'_, A>],
    ) -> Result<u32, SceneError> {
        let mut number = parts.bounded();
        let mut i = 0;
        while i < instances.len() {
            let instance = &instances[i];
            let group = instance.group();
            if group.materials as usize > parts.materials.len() {
                return Err(SceneError::Material { index: group.materials - 1 });
            }
            if let Some(id) = instance.material()
                && id.index() >= parts.materials.len()
            {
                return Err(SceneError::Material { index: id.index() as u16 });
            }
            number = match number.checked_add(group.count) {
                Some(number) => number,
                None => return Err(SceneError::Numbers),
            };
            i += 1;
        }
        // The highest numbers stand for no shape.
        if number > u32::MAX / 2 { Err(SceneError::Numbers) } else { Ok(number) }
    }

    /// The same for scenes in `static`s: a mistake doesn't compile.
    ///
    /// # Panics
    /// Where [`try_tailored`](Self::try_tailored) has an error.
    pub const fn tailored(parts: Parts<'a, A>) -> Self {
        match Self::try_tailored(parts) {
            Ok(scene) => scene,
            Err(error) => panic!("{}", error.message()),
        }
    }

    /// The same scene in the type that may hold anything. Scenes that are tailored each take code of their
    /// own; in this type they share it.
    pub const fn general(&self) -> Scene<'a, A> {
        let &Self { parts, shapes, opaque_shadows, bounded, first_plane } = self;
        Scene { parts, shapes, opaque_shadows, bounded, first_plane }
    }

    /// The same scene with other light between its surfaces: irradiance records or virtual lights
    /// that were made after it.
    ///
    /// # Errors
    /// The scene is tailored to have none.
    pub const fn with_indirect<'b>(
        &self,
        indirect: Indirect<'b, A>,
    ) -> Result<Scene<'b, A, USES>, SceneError>
    where
        'a: 'b,
    {
        let missing = indirect.uses() & !USES;
        if missing != 0 {
            return Err(SceneError::Uses { missing });
        }
        Ok(self.lit_by(indirect))
    }

    /// Whether a shape shows an area light.
    pub(crate) fn is_light(&self, shape: u32) -> bool {
        self.parts.area_lights.iter().any(|light| light.body() == Some(shape))
    }

    pub(crate) const fn lit_by<'b>(&self, indirect: Indirect<'b, A>) -> Scene<'b, A, USES>
    where
        'a: 'b,
    {
        let mut scene: Scene<'b, A, USES> = *self;
        scene.parts.indirect = indirect;
        scene
    }

    /// What the scene was put together from.
    pub const fn parts(&self) -> &Parts<'a, A> {
        &self.parts
    }

    /// The material at a point of a shape, the checker resolved.
    #[inline(always)]
    pub(crate) fn material_at(
        &self,
        id: MaterialId,
        p: &[A::Length; 3],
    ) -> Option<&'a Material<A>> {
        let material = self.parts.materials.get(id.index())?;
        let material = match &material.pattern {
            Some(pattern) if has(USES, uses::PATTERNS) && pattern.odd(p) => {
                self.parts.materials.get(usize::from(pattern.other))?
            }
            _ => material,
        };
        match material.texture() {
            Some(texture) if has(USES, uses::TEXTURES) => self.swapped(material, texture, *p),
            _ => Some(material),
        }
    }

    /// The material that a texture shows in the place of this one, if it does.
    #[inline(never)]
    fn swapped(
        &self,
        material: &'a Material<A>,
        texture: u16,
        p: [A::Length; 3],
    ) -> Option<&'a Material<A>> {
        let texture = self.parts.textures.get(usize::from(texture))?;
        match texture.other() {
            Some(other) if texture.is_other(&p) => self.parts.materials.get(usize::from(other)),
            _ => Some(material),
        }
    }
}

/// Whether what a material names of surface detail is there.
const fn detail_is_there<A: Arithmetic>(
    parts: &Parts<'_, A>,
    material: &Material<A>,
) -> Result<(), SceneError> {
    let textures = parts.textures.len();
    if let Some(index) = material.texture()
        && index as usize >= textures
    {
        return Err(SceneError::Texture { index });
    }
    if let Some(index) = material.bump()
        && index as usize >= textures
    {
        return Err(SceneError::Texture { index });
    }
    if let Some(index) = material.absorption()
        && index as usize >= parts.absorptions.len()
    {
        return Err(SceneError::Absorption { index });
    }
    Ok(())
}

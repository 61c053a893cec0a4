//! What a blob's specifications say, made: materials, lights and what else isn't read in place.

use super::spec::{Reader, Spec};
use super::{BackgroundSpec, Blob, BlobError, CameraSpec, SelectionSpec, detail};
use crate::math::for_each_arithmetic;
use crate::scene::{
    Absorption, Ambient, Area, AreaLight, AreaLightSpec, Background, Camera, FanCorner, Light,
    LightSpec, Material, MaterialSpec, Rules, Selection, Texture,
};

for_each_arithmetic! {
    impl<'b> Blob<'b, A> {
        /// The camera.
        ///
        /// # Errors
        /// None that [`open`](Self::open) hasn't seen.
        pub fn camera(&self) -> Result<Camera<A>, BlobError> {
            let CameraSpec { eye, at, up, tangent } = self.setting.camera;
            Camera::<A>::try_look_at(eye, at, up, tangent).map_err(BlobError::Value)
        }

        #[allow(clippy::type_complexity)]
        pub(super) fn surroundings(&self) -> Result<(Ambient<A>, Background<A>, Rules<A>), BlobError> {
            let setting = &self.setting;
            let background = match setting.background {
                BackgroundSpec::Uniform(color) => Background::<A>::try_uniform(color),
                BackgroundSpec::Gradient { up, bottom, top } => {
                    Background::<A>::try_gradient(up, bottom, top)
                }
            };
            let rules = Rules {
                specular_cosine: setting.specular_cosine,
                highlight_cosine: setting.highlight_cosine,
                transmitters_reflect: setting.transmitters_reflect,
                lossy: setting.lossy,
                ..Rules::<A>::try_with_cutoff(setting.cutoff).ok_or(BlobError::Unknown)?
            };
            Ok((
                Ambient::<A>::try_new(setting.ambient).map_err(BlobError::Value)?,
                background.map_err(BlobError::Value)?,
                rules,
            ))
        }

        pub(super) fn selection(&self) -> Result<Selection<A>, BlobError> {
            match self.setting.selection {
                SelectionSpec::All => Ok(Selection::All),
                SelectionSpec::Choose(count) => Ok(Selection::Choose(count)),
                SelectionSpec::Above(radiance) => {
                    Selection::<A>::try_above(radiance).map_err(BlobError::Value)
                }
            }
        }

        pub(super) fn absorption(from: &mut Reader<'_>) -> Result<Absorption<A>, BlobError> {
            let [front, behind] = detail::read_absorption(from).ok_or(BlobError::Unknown)?;
            Absorption::<A>::try_new(front, behind).map_err(BlobError::Value)
        }

        pub(super) fn texture(&self, from: &mut Reader<'_>) -> Result<Texture<'b, A>, BlobError> {
            let spec = detail::read_texture(from, self.pictures).ok_or(BlobError::Unknown)?;
            Texture::<A>::try_new(&spec).map_err(BlobError::Value)
        }

        /// A light, and its fan if it is a polygon; where there are no more places for the fan, its
        /// corners are checked alone.
        pub(super) fn area_light(
            spec: &AreaLightSpec<'_>,
            fans: &mut core::slice::IterMut<'_, FanCorner<A>>,
        ) -> Result<AreaLight<A>, BlobError> {
            let light = AreaLight::<A>::try_new(spec).map_err(BlobError::Value)?;
            if let Area::Polygon { corners, .. } = spec.area {
                for i in 1..corners.len() {
                    let corner = AreaLight::<A>::try_fan(corners, i.wrapping_sub(1));
                    let corner = corner.map_err(BlobError::Value)?;
                    if let Some(place) = fans.next() {
                        *place = corner;
                    }
                }
            }
            Ok(light)
        }

        pub(super) fn material(from: &mut Reader<'_>) -> Result<Material<A>, BlobError> {
            let spec = MaterialSpec::read(from).ok_or(BlobError::Unknown)?;
            Material::<A>::try_new(&spec).map_err(BlobError::Value)
        }

        pub(super) fn light(from: &mut Reader<'_>) -> Result<Light<A>, BlobError> {
            let spec = LightSpec::read(from).ok_or(BlobError::Unknown)?;
            Light::<A>::try_new(&spec).map_err(BlobError::Value)
        }
    }
}

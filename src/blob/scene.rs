//! The scene over a blob, and memory of the caller's.

use super::group::{self, GroupHead};
use super::lists::{first_mut, grouped};
use super::spec::Reader;
use super::{Blob, BlobError, Room, detail};
use crate::math::{Arithmetic, for_each_arithmetic};
use crate::scene::uses::has;
use crate::scene::{Group, Instance, Light, Material, Parts, Scene, SceneError, Shapes, uses};
use crate::shape::{Operand, Solid};

/// The part of a [`Room`] that is for groups, and for what stands where of them.
struct GroupRoom<'r, A: Arithmetic> {
    solids: &'r mut [Solid<A>],
    operands: &'r mut [Operand<A>],
    groups: &'r mut [Group<'r, A>],
    instances: &'r mut [Instance<'r, A>],
}

for_each_arithmetic! {
    impl<'b> Blob<'b, A> {
        /// The next solids, and their operands, from these memories' beginnings.
        #[allow(clippy::type_complexity)]
        fn solids_in<'s>(
            reader: &mut Reader<'_>,
            count: u32,
            solids: &mut &'s mut [Solid<A>],
            operands: &mut &'s mut [Operand<A>],
        ) -> Result<(&'s [Solid<A>], &'s [Operand<A>]), BlobError> {
            let own = first_mut(solids, count)?;
            let mut used = 0;
            for place in own.iter_mut() {
                let (solid, (its, n)) = Solid::<A>::read(reader, used).ok_or(BlobError::Solid)?;
                *place = solid;
                let places = operands.get_mut(used as usize..).unwrap_or(&mut []);
                places.iter_mut().zip(its).take(n.into()).for_each(|(to, from)| *to = from);
                used = used.wrapping_add(n.into());
            }
            Ok((own, first_mut(operands, used)?))
        }

        /// The scene's shapes with its solids, and its instances: what follows the area lights.
        #[allow(clippy::type_complexity)]
        fn placed_in<'s>(
            &self,
            reader: &mut Reader<'b>,
            room: GroupRoom<'s, A>,
        ) -> Result<(Shapes<'s, A>, &'s [Instance<'s, A>]), BlobError>
        where
            'b: 's,
        {
            let counts = &self.header.counts;
            let missing = BlobError::RoomForGroups {
                solids: counts.solids,
                operands: counts.operands,
                groups: counts.groups,
                instances: counts.instances,
            };
            let GroupRoom { mut solids, mut operands, groups, instances } = room;
            let groups = groups.get_mut(..counts.groups.into()).ok_or(missing)?;
            let instances = instances.get_mut(..counts.instances.into()).ok_or(missing)?;
            if counts.solids as usize > solids.len() || counts.operands as usize > operands.len() {
                return Err(missing);
            }
            // What `open` has made of the indirect light stands in between.
            if reader.switch() == Some(true) {
                reader.number();
            }
            if reader.switch() == Some(true) {
                group::read_virtual_lights(reader);
            }
            let (mut left, mut words, mut own) = (self.all, self.words, counts.solids);
            for place in groups.iter_mut() {
                let head = GroupHead::read(reader).ok_or(BlobError::Unknown)?;
                let (shapes, words) = grouped(&head, &mut left, &mut words)?;
                let tree = Self::tree(head.tree, words, &shapes, head.solids)?;
                own = own.wrapping_sub(head.solids);
                let (solids, operands) =
                    Self::solids_in(reader, head.solids, &mut solids, &mut operands)?;
                let shapes = Shapes { solids, operands, tree, ..shapes };
                *place = Group::<A>::try_new(shapes).map_err(BlobError::Scene)?;
            }
            let groups: &'s [Group<'s, A>] = groups;
            let (solids, operands) = Self::solids_in(reader, own, &mut solids, &mut operands)?;
            for place in instances.iter_mut() {
                let spec = group::read_instance(reader).ok_or(BlobError::Unknown)?;
                let group = groups.get(usize::from(spec.group)).ok_or(BlobError::Parts)?;
                let made = Instance::<A>::try_new(group, &spec.transform);
                let made = made.map_err(BlobError::Value)?;
                *place = match spec.material {
                    Some(material) => made.with_material(material),
                    None => made,
                };
            }
            Ok((Shapes { solids, operands, ..self.shapes }, instances))
        }

        /// The scene, over materials and lights in memory of the caller's: as many as
        /// [`counts`](Self::counts) says, or more.
        ///
        /// # Errors
        /// Too little room, none for area lights, textures and media among it; parts that don't fit
        /// together.
        pub fn scene<'s, const USES: u64>(
            &self,
            materials: &'s mut [Material<A>],
            lights: &'s mut [Light<A>],
        ) -> Result<Scene<'s, A, USES>, BlobError>
        where
            'b: 's,
        {
            self.scene_in(Room { materials, lights, ..Room::default() })
        }

        /// The scene, over whatever of it isn't read in place in memory of the caller's: as much of
        /// each as [`counts`](Self::counts) says, or more.
        ///
        /// # Errors
        /// Too little room; parts that don't fit together.
        pub fn scene_in<'s, const USES: u64>(
            &self,
            room: Room<'s, 'b, A>,
        ) -> Result<Scene<'s, A, USES>, BlobError>
        where
            'b: 's,
        {
            let Room { materials, lights, area_lights, fans, textures, absorptions, .. } = room;
            let Room { solids, operands, groups, instances, .. } = room;
            let counts = &self.header.counts;
            let room = BlobError::Room { materials: counts.materials, lights: counts.lights };
            let materials = materials.get_mut(..counts.materials.into()).ok_or(room)?;
            let lights = lights.get_mut(..counts.lights.into()).ok_or(room)?;
            let mut reader = self.reader();
            for material in materials.iter_mut() {
                *material = Self::material(&mut reader)?;
            }
            for light in lights.iter_mut() {
                *light = Self::light(&mut reader)?;
            }
            let room = BlobError::RoomBesides {
                area_lights: counts.area_lights,
                fans: counts.fans,
                textures: counts.textures,
                absorptions: counts.absorptions,
            };
            let absorptions = absorptions.get_mut(..counts.absorptions.into()).ok_or(room)?;
            let textures = textures.get_mut(..counts.textures.into()).ok_or(room)?;
            let area_lights = area_lights.get_mut(..counts.area_lights.into()).ok_or(room)?;
            let light_corners = fans.get_mut(..counts.fans.into()).ok_or(room)?;
            for absorption in absorptions.iter_mut() {
                *absorption = Self::absorption(&mut reader)?;
            }
            for texture in textures.iter_mut() {
                *texture = self.texture(&mut reader)?;
            }
            let (mut left, mut first, mut fans) = (self.corners, 0, light_corners.iter_mut());
            for light in area_lights.iter_mut() {
                let spec = detail::read_area_light(&mut reader, &mut left, &mut first);
                *light = Self::area_light(&spec.ok_or(BlobError::Unknown)?, &mut fans)?;
            }
            let memory = GroupRoom { solids, operands, groups, instances };
            let (shapes, instances) = if has(USES, uses::SOLIDS) || has(USES, uses::INSTANCES) {
                self.placed_in(&mut reader, memory)?
            } else if counts.solids == 0 && counts.instances == 0 {
                (self.shapes, &[][..])
            } else {
                let missing = uses::SOLIDS | uses::INSTANCES;
                return Err(BlobError::Scene(SceneError::Uses { missing }));
            };
            let (ambient, background, rules) = self.surroundings()?;
            let Shapes {
                spheres,
                triangles,
                smooth_triangles,
                polygons,
                edges,
                cuboids,
                discs,
                cylinders,
                cones,
                tree,
                uvs,
                solids,
                operands,
            } = shapes;
            Scene::<A, USES>::try_tailored(Parts {
                spheres,
                triangles,
                smooth_triangles,
                polygons,
                edges,
                cuboids,
                discs,
                cylinders,
                cones,
                tree,
                uvs,
                solids,
                operands,
                instances,
                planes: self.planes,
                materials,
                lights,
                absorptions,
                textures,
                area_lights,
                light_corners,
                light_jitter: self.setting.light_jitter,
                selection: self.selection()?,
                indirect: self.indirect,
                ambient,
                background,
                rules,
            })
            .map_err(|error: SceneError| BlobError::Scene(error))
        }
    }
}

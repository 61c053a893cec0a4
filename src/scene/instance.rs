//! Instances: groups placed in a scene.
//!
//! Instances stand outside the scene's octree, in a short list, each with a bounding sphere that is
//! tested first: so one that moves costs nothing but its own few numbers, and nothing is rebuilt. A
//! ray that may meet the group is taken into the group's space, searched for there, and what it
//! meets is brought back.
//!
//! A ray starts anew where it enters the bounding sphere. So the rounding of its turned direction
//! counts over the group's size alone, however far the ray has come, and a small group's space
//! isn't left by rays from afar.

use super::{Group, Transform};
use crate::math::{Arithmetic, for_each_arithmetic, sub};
use crate::shape::{Leaving, MaterialId, Ray, ShapeError, Surface, point, some_or};

/// A group, and where it stands.
#[derive(Clone, Copy, Debug)]
pub struct Instance<'a, A: Arithmetic> {
    group: &'a Group<'a, A>,
    /// Of the bounding sphere, in the scene.
    center: [A::Length; 3],
    radius: A::Radius,
    position: [A::Length; 3],
    rotation: A::Rotation,
    scale: A::Scale,
    material: Option<MaterialId>,
    turned: bool,
    scaled: bool,
}

for_each_arithmetic! {
    const NO_GROUP: &Group<'static, A> = &Group::<A>::NONE;

    impl<'a> Instance<'a, A> {
        /// One of a group without shapes: what a pool is made of before instances are put there.
        pub const NONE: Self = Self::new(NO_GROUP, Transform::IDENTITY);

        /// A group at a place, for scenes in `const`s.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(group: &'a Group<'a, A>, transform: Transform) -> Self {
            match Self::try_new(group, &transform) {
                Ok(instance) => instance,
                Err(error) => panic!("{}", error.message()),
            }
        }

        /// A group at a place.
        ///
        /// # Errors
        /// Coordinates or size out of range (scales are 1/1024 to 1024 in fixed point, a millionth
        /// to a million otherwise); a matrix that isn't a rotation.
        pub const fn try_new(
            group: &'a Group<'a, A>,
            transform: &Transform,
        ) -> Result<Self, ShapeError> {
            if !transform.is_rigid() {
                return Err(ShapeError::Direction);
            }
            let scale = some_or!(make::scale(transform.scale), Size);
            let c = &group.center;
            let center = [
                make::from_length(c[0]),
                make::from_length(c[1]),
                make::from_length(c[2]),
            ];
            // A little larger, for the rounding of its centre.
            let radius = make::from_radius(&group.radius) * transform.scale * (1.0 + 1.0 / 4096.0);
            let step = make::from_length(make::from_grid(1, -100));
            Ok(Self {
                group,
                center: point!(make, transform.apply(center)),
                radius: some_or!(make::radius(radius + 4.0 * step), Size),
                position: point!(make, transform.position),
                rotation: make::rotation(&transform.rotation),
                scale,
                material: None,
                turned: !transform.is_upright(),
                scaled: transform.scale != 1.0,
            })
        }
    }
}

impl<'a, A: Arithmetic> Instance<'a, A> {
    /// All shapes have this material, instead of their own.
    #[must_use]
    pub const fn with_material(mut self, material: u16) -> Self {
        self.material = Some(MaterialId::new(material));
        self
    }

    /// The same elsewhere, in the arithmetic's own numbers: what a moving instance costs a frame.
    #[must_use]
    pub fn at(self, position: [A::Length; 3]) -> Self {
        let offset = sub(&position, &self.position);
        Self { center: crate::math::add(&self.center, &offset), position, ..self }
    }

    /// Where the group's origin lies.
    pub const fn position(&self) -> [A::Length; 3] {
        self.position
    }

    /// The group.
    pub const fn group(&self) -> &'a Group<'a, A> {
        self.group
    }

    /// The material that all shapes have, if it isn't their own.
    pub(crate) const fn material(&self) -> Option<MaterialId> {
        self.material
    }

    /// The ray in the group's space, if it may meet the bounding sphere nearer than `limit`.
    /// `first`: the scene's number of the group's first shape.
    #[inline(always)]
    pub(crate) fn enter(
        &self,
        first: u32,
        ray: &Ray<A>,
        coarse: &A::Coarse,
        limit: A::Length,
    ) -> Option<Inside<A>> {
        if !A::may_hit::<false>(coarse, &self.center, &self.radius, limit) {
            return None;
        }
        let c = sub(&self.center, &ray.origin);
        let t = A::project(&c, &ray.direction);
        let leg2 = A::leg2(&self.radius, &c, t, &ray.direction)?;
        // The chord reaches from t − h to t + h: does an end, or all, lie within 0 to limit?
        let short = |way: A::Length| leg2 <= A::square(&self.radius, way);
        if t < A::NO_LENGTH && short(t) || t > limit && short(t - limit) {
            return None;
        }
        let mut start = A::NO_LENGTH;
        let mut origin = ray.origin;
        if self.turned || self.scaled {
            let near = t - A::radius(&self.radius);
            if near > A::NO_LENGTH {
                start = near;
                origin = A::along(&origin, start, &ray.direction);
            }
        }
        let ray = Ray {
            origin: self.inwards(&origin),
            direction: if self.turned {
                A::turn_back(&self.rotation, &ray.direction)
            } else {
                ray.direction
            },
            // A number beyond the group's is that of no shape in it.
            leaving: Leaving { shape: ray.leaving.shape.wrapping_sub(first), ..ray.leaving },
        };
        Some(Inside { ray, start })
    }

    /// A point of the scene, in the group's space.
    #[inline(always)]
    fn inwards(&self, p: &[A::Length; 3]) -> [A::Length; 3] {
        let mut p = sub(p, &self.position);
        if self.turned {
            p = A::rotate_back(&self.rotation, &p);
        }
        if self.scaled {
            p = p.map(|x| A::reduce(&self.scale, x));
        }
        p
    }

    /// A point of the group's space, in the scene.
    #[inline(always)]
    pub(crate) fn outwards(&self, p: &[A::Length; 3]) -> [A::Length; 3] {
        let mut p = *p;
        if self.scaled {
            p = p.map(|x| A::magnify(&self.scale, x));
        }
        if self.turned {
            p = A::rotate(&self.rotation, &p);
        }
        crate::math::add(&p, &self.position)
    }

    /// A surface of the group, in the scene.
    #[inline(always)]
    pub(crate) fn turn(&self, surface: Surface<A>) -> Surface<A> {
        if !self.turned {
            return surface;
        }
        let geometric = A::turn(&self.rotation, &surface.geometric);
        let normal =
            if surface.smooth { A::turn(&self.rotation, &surface.normal) } else { geometric };
        Surface { geometric, normal, ..surface }
    }

    /// A vector of the group's space, up to 2 long, in the scene.
    pub(crate) fn turn_vector(&self, v: &[A::Unit; 3]) -> [A::Unit; 3] {
        if self.turned { A::turn(&self.rotation, v) } else { *v }
    }

    /// A distance along the ray in the scene, along that in the group's space.
    #[inline(always)]
    pub(crate) fn distance_inside(&self, inside: &Inside<A>, t: A::Length) -> A::Length {
        let t = t - inside.start;
        let t = if self.scaled { A::reduce(&self.scale, t) } else { t };
        if t > A::FAR { A::FAR } else { t }
    }

    /// The other way about.
    #[inline(always)]
    pub(crate) fn distance_outside(&self, inside: &Inside<A>, t: A::Length) -> A::Length {
        let t = if self.scaled { A::magnify(&self.scale, t) } else { t };
        inside.start + t
    }
}

/// A ray in a group's space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Inside<A: Arithmetic> {
    pub(crate) ray: Ray<A>,
    /// How far along the ray in the scene it starts.
    start: A::Length,
}

//! The primitives, a file each: what they are, how a ray meets them, where they lie.
//!
//! A shape is first asked *whether* and *where* a ray meets it ([`Shape::nearest`],
//! [`Shape::occludes`]); only the nearest one is asked for its normal ([`Shape::surface`]).
//!
//! **Rays that leave a surface don't hit it again**, by construction rather than by a small
//! distance: a ray knows the shape it leaves and the side it leaves on. A flat shape it leaves is
//! not tested; nor is a convex one (sphere, box, cylinder, cone) left outwards; left inwards, a
//! convex shape is tested for its far root alone.

mod chord;
mod cone;
mod cuboid;
mod cylinder;
mod disc;
mod error;
mod plane;
mod polygon;
mod projection;
mod region;
mod smooth_triangle;
mod solid;
mod sphere;
#[cfg(test)]
pub(crate) mod testing;
#[cfg(test)]
mod tests;
mod triangle;

pub use cone::Cone;
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use disc::Disc;
pub use error::ShapeError;
pub(crate) use error::{ok_or_panic, point, rounded_point, some_or, unit_vector};
pub use plane::Plane;
pub use polygon::{Polygon, PolygonEdge, PolygonView};
pub use region::Region;
pub use smooth_triangle::SmoothTriangle;
pub use solid::{Operand, Solid, SolidView};
pub use sphere::Sphere;
pub use triangle::Triangle;

use bytemuck::{Pod, Zeroable};

use crate::math::Arithmetic;

/// A half-line, and which shape it leaves.
#[derive(Clone, Copy, Debug)]
pub struct Ray<A: Arithmetic> {
    /// Where it starts.
    pub origin: [A::Length; 3],
    /// Where it goes, a unit vector.
    pub direction: [A::Unit; 3],
    /// The shape on whose surface it starts.
    pub leaving: Leaving,
}

/// The shape on whose surface a ray starts, and the side it starts towards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Leaving {
    /// The shape's number in the scene.
    pub shape: u32,
    /// Which part of it: see [`Surface::part`].
    pub part: u8,
    /// Whether the ray goes into the shape.
    pub inwards: bool,
}

impl Leaving {
    /// A ray that starts in free space.
    pub const NOTHING: Self = Self { shape: u32::MAX, part: 0, inwards: false };

    /// A ray that goes back to the side that the surface was seen from.
    #[inline(always)]
    pub fn back<A: Arithmetic>(shape: u32, surface: &Surface<A>) -> Self {
        Self { shape, part: surface.part, inwards: surface.behind }
    }

    /// A ray that goes through the surface.
    #[inline(always)]
    pub fn through<A: Arithmetic>(shape: u32, surface: &Surface<A>) -> Self {
        Self { shape, part: surface.part, inwards: !surface.behind }
    }
}

/// Where a ray meets a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting<A: Arithmetic> {
    /// The distance from the ray's origin.
    pub distance: A::Length,
    /// What the shape's [`surface`](Shape::surface) wants to know of the test: for a sphere or a
    /// cylinder the half chord, negative at the near root; for a cuboid, a cone and a cap too it
    /// is negative where the ray enters.
    pub detail: A::Length,
}

/// The surface at a point, seen from where the ray came.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface<A: Arithmetic> {
    /// The geometric unit normal, turned to the side the ray came from.
    pub geometric: [A::Unit; 3],
    /// The unit normal that shading sees, on the same side: the geometric one, or the
    /// interpolated one of a smooth triangle.
    pub normal: [A::Unit; 3],
    /// The cosine between `normal` and the way back along the ray, not negative.
    pub cosine: A::Unit,
    /// Whether the ray came from behind: from inside a closed shape, from the side that a flat
    /// shape's normal doesn't point to.
    pub behind: bool,
    /// Whether the two normals may differ.
    pub smooth: bool,
    /// Which part of the shape it belongs to, for a ray that leaves it: 0 for a shape that has but
    /// one; nobody but the shape itself knows what the others mean.
    pub part: u8,
}

/// What tracing asks of every primitive.
pub trait Shape<A: Arithmetic> {
    /// Flat shapes are met once by any ray, so one that leaves them need not test them.
    const FLAT: bool;
    /// A ray that leaves a convex shape outwards doesn't meet it again.
    const CONVEX: bool = true;

    /// The nearest point in front of the ray's origin and nearer than `limit` or exactly there
    /// (the caller decides ties). `inwards`: the ray starts on this shape and goes into it.
    fn nearest(
        &self,
        ray: &Ray<A>,
        coarse: &A::Coarse,
        inwards: bool,
        limit: A::Length,
    ) -> Option<Meeting<A>>;

    /// The same for a ray that may start on it (`left`): it can't meet every shape again.
    #[inline(always)]
    fn nearest_from(
        &self,
        ray: &Ray<A>,
        coarse: &A::Coarse,
        left: bool,
        limit: A::Length,
    ) -> Option<Meeting<A>> {
        if left && (Self::FLAT || Self::CONVEX && !ray.leaving.inwards) {
            return None;
        }
        self.nearest(ray, coarse, left, limit)
    }

    /// Whether anything of the shape lies in front of the ray's origin and nearer than `limit`.
    #[inline(always)]
    fn occludes(&self, ray: &Ray<A>, coarse: &A::Coarse, inwards: bool, limit: A::Length) -> bool {
        match self.nearest(ray, coarse, inwards, limit) {
            Some(meeting) => meeting.distance < limit,
            None => false,
        }
    }

    /// The surface at the point `p` where the ray met the shape; puts `p` back on it where that
    /// needs to be and is cheap.
    fn surface(&self, ray: &Ray<A>, meeting: &Meeting<A>, p: &mut [A::Length; 3]) -> Surface<A>;

    /// The material's number, and whether the shape shows its inside only.
    fn material(&self) -> MaterialId;

    /// The material where a ray met the shape, for shapes that have several.
    #[inline(always)]
    fn material_at(&self, _meeting: &Meeting<A>) -> MaterialId {
        self.material()
    }
}

/// A cylinder or cone of a scene in which none has caps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Open<'s, S>(pub(crate) &'s S);

/// Which of the scene's materials a shape has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
#[repr(transparent)]
pub struct MaterialId(u16);

impl MaterialId {
    const INSIDE_ONLY: u16 = 0x8000;
    /// One more than the largest index.
    pub const LIMIT: u16 = Self::INSIDE_ONLY;

    /// The material of this index, below [`LIMIT`](Self::LIMIT) (the highest bit is dropped).
    #[inline(always)]
    pub const fn new(index: u16) -> Self {
        Self(index & !Self::INSIDE_ONLY)
    }

    /// The index into the scene's materials.
    #[inline(always)]
    pub const fn index(self) -> usize {
        (self.0 & !Self::INSIDE_ONLY) as usize
    }

    /// Whether only the inside of the shape shows (a negative radius in NFF).
    #[inline(always)]
    pub const fn inside_only(self) -> bool {
        self.0 & Self::INSIDE_ONLY != 0
    }

    pub(crate) const fn showing_inside(self) -> Self {
        Self(self.0 | Self::INSIDE_ONLY)
    }
}

/// The surface with one normal, given as it points out of the shape (or out of its front), and
/// `dn` its product with the direction.
#[inline(always)]
pub(crate) fn turned<A: Arithmetic>(outward: &[A::Unit; 3], dn: A::Unit) -> Surface<A> {
    turned_to(outward, dn, dn > A::NO_UNIT)
}

/// The same where the side is known better than by the sign of a rounded product.
#[inline(always)]
pub(crate) fn turned_to<A: Arithmetic>(
    outward: &[A::Unit; 3],
    dn: A::Unit,
    behind: bool,
) -> Surface<A> {
    let normal = if behind { crate::math::neg(outward) } else { *outward };
    let cosine = if behind { dn } else { -dn };
    let cosine = if cosine > A::NO_UNIT { cosine } else { A::NO_UNIT };
    Surface { geometric: normal, normal, cosine, behind, smooth: false, part: 0 }
}

/// The distance to a plane that lies `left` ahead and is neared with the speed `slope`, and that
/// speed, positive; `None` for a plane that lies behind or beyond `limit`.
#[inline(always)]
pub(crate) fn meets_plane<A: Arithmetic>(
    left: A::Length,
    slope: A::Unit,
    limit: A::Length,
) -> Option<(A::Length, A::Unit)> {
    let (left, slope) = if left > A::NO_LENGTH { (left, slope) } else { (-left, -slope) };
    if slope <= A::NO_UNIT {
        return None;
    }
    let distance = A::ratio(left, slope);
    if distance > A::NO_LENGTH && distance <= limit { Some((distance, slope)) } else { None }
}

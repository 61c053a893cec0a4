//! The shapes of a scene by their numbers: one list a kind, numbered through.

use super::{Parts, SceneError};
use crate::math::{Arithmetic, for_each_arithmetic};
use crate::octree::Extent;
use crate::shape::MaterialId;

/// Evaluates `$body` with `$shape` bound to the shape of number `$id`, whatever its kind; `$none`
/// where there is no such shape. The slices' own bounds checks are what finds the kind.
macro_rules! with_shape {
    ($uses:expr, $parts:expr, $id:expr, $shape:ident => $body:expr, $none:expr) => {{
        use $crate::scene::uses::{self, has};
        let parts = $parts;
        let index = $id as usize;
        if let Some($shape) = parts.spheres.get(index) {
            $body
        } else {
            let index = index.wrapping_sub(parts.spheres.len());
            if has($uses, uses::TRIANGLES)
                && let Some($shape) = parts.triangles.get(index)
            {
                $body
            } else {
                let index = index.wrapping_sub(parts.triangles.len());
                if has($uses, uses::SMOOTH_TRIANGLES)
                    && let Some($shape) = parts.smooth_triangles.get(index)
                {
                    $body
                } else {
                    let index = index.wrapping_sub(parts.smooth_triangles.len());
                    if has($uses, uses::POLYGONS)
                        && let Some(polygon) = parts.polygons.get(index)
                    {
                        let $shape = &polygon.view(parts.edges);
                        $body
                    } else {
                        let index = index.wrapping_sub(parts.polygons.len());
                        if has($uses, uses::CUBOIDS)
                            && let Some($shape) = parts.cuboids.get(index)
                        {
                            $body
                        } else {
                            let index = index.wrapping_sub(parts.cuboids.len());
                            if has($uses, uses::DISCS)
                                && let Some($shape) = parts.discs.get(index)
                            {
                                $body
                            } else {
                                let index = index.wrapping_sub(parts.discs.len());
                                if has($uses, uses::CYLINDERS)
                                    && let Some($shape) = parts.cylinders.get(index)
                                {
                                    $body
                                } else {
                                    let index = index.wrapping_sub(parts.cylinders.len());
                                    if has($uses, uses::CONES)
                                        && let Some($shape) = parts.cones.get(index)
                                    {
                                        $body
                                    } else {
                                        let index = index.wrapping_sub(parts.cones.len());
                                        if has($uses, uses::PLANES)
                                            && let Some($shape) = parts.planes.get(index)
                                        {
                                            $body
                                        } else {
                                            $none
                                        }
                                    }
                                }
                            }
                        }
                    }
                }
            }
        }
    }};
}
pub(crate) use with_shape;

impl<A: Arithmetic> Parts<'_, A> {
    /// How many shapes there are besides planes: those that the tree is over.
    #[inline(always)]
    pub const fn bounded(&self) -> u32 {
        (self.spheres.len()
            + self.triangles.len()
            + self.smooth_triangles.len()
            + self.polygons.len()
            + self.cuboids.len()
            + self.discs.len()
            + self.cylinders.len()
            + self.cones.len()) as u32
    }
}

/// Every shape's material must be there, and every polygon's edges.
pub(super) const fn check<A: Arithmetic>(parts: &Parts<'_, A>) -> Result<(), SceneError> {
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
    check!(
        spheres,
        triangles,
        smooth_triangles,
        polygons,
        cuboids,
        discs,
        cylinders,
        cones,
        planes
    );
    let mut i = 0;
    while i < parts.polygons.len() {
        let polygon = &parts.polygons[i];
        let end = polygon.first_edge() as u64 + polygon.edge_count() as u64;
        if end > parts.edges.len() as u64 {
            return Err(SceneError::Edges { polygon: i as u32 });
        }
        i += 1;
    }
    Ok(())
}

/// Adds the extents of the shapes of one kind.
macro_rules! add {
    ($parts:expr, $kind:ident, $extents:ident, $next:ident, $log2_step:expr) => {
        let mut i = 0;
        while i < $parts.$kind.len() {
            $extents[$next] = $parts.$kind[i].extent($log2_step);
            $next += 1;
            i += 1;
        }
    };
}

for_each_arithmetic! {
    impl Parts<'_, A> {
        /// Where the bounded shapes lie, for [`OctreeBuffer::build`]: in steps of
        /// 2^`log2_step` for floating point (fixed point's are always 2⁻¹⁶). `N` must be
        /// [`bounded`](Self::bounded).
        ///
        /// [`OctreeBuffer::build`]: crate::octree::OctreeBuffer::build
        ///
        /// # Panics
        /// Where `N` is another number.
        pub const fn extents<const N: usize>(&self, log2_step: i8) -> [Extent; N] {
            assert!(N == self.bounded() as usize, "the extents are as many as the bounded shapes");
            let mut extents = [Extent::Sphere { center: [0; 3], radius: 0 }; N];
            let mut next = 0;
            add!(self, spheres, extents, next, log2_step);
            add!(self, triangles, extents, next, log2_step);
            add!(self, smooth_triangles, extents, next, log2_step);
            add!(self, polygons, extents, next, log2_step);
            add!(self, cuboids, extents, next, log2_step);
            add!(self, discs, extents, next, log2_step);
            add!(self, cylinders, extents, next, log2_step);
            add!(self, cones, extents, next, log2_step);
            extents
        }
    }
}

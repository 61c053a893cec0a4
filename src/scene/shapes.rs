//! Bounded shapes by their numbers: one list a kind, numbered through.

use super::{Parts, SceneError, TriangleUv};
use crate::math::{Arithmetic, for_each_arithmetic};
use crate::octree::{Extent, Octree};
use crate::shape::{Cone, Cuboid, Cylinder, Disc, MaterialId, Operand, Polygon, PolygonEdge};
use crate::shape::{SmoothTriangle, Solid, Sphere, Triangle};

/// Shapes that have an end, and the tree over them: what rays are searched for in. They are
/// numbered through in the order of the fields.
#[derive(Clone, Copy, Debug)]
pub struct Shapes<'a, A: Arithmetic> {
    /// Spheres.
    pub spheres: &'a [Sphere<A>],
    /// Flat triangles.
    pub triangles: &'a [Triangle<A>],
    /// Triangles with a normal at each corner.
    pub smooth_triangles: &'a [SmoothTriangle<A>],
    /// Convex polygons.
    pub polygons: &'a [Polygon<A>],
    /// The edges of all polygons.
    pub edges: &'a [PolygonEdge<A>],
    /// Texture coordinates of the triangles, then of the smooth triangles, in their order; none for
    /// those beyond its end.
    pub uvs: &'a [TriangleUv],
    /// Boxes along the axes.
    pub cuboids: &'a [Cuboid<A>],
    /// Discs.
    pub discs: &'a [Disc<A>],
    /// Cylinders.
    pub cylinders: &'a [Cylinder<A>],
    /// Cones.
    pub cones: &'a [Cone<A>],
    /// Solids of several shapes.
    pub solids: &'a [Solid<A>],
    /// The operands of all solids.
    pub operands: &'a [Operand<A>],
    /// The octree over all of them. Without one every ray tests every shape, which is quicker for
    /// fewer than ten.
    pub tree: Option<Octree<'a, A>>,
}

/// Evaluates `$body` with `$shape` bound to the bounded shape of number `$id`, whatever its kind;
/// `$none` where there is no such shape. The slices' own bounds checks are what finds the kind.
macro_rules! with_shape {
    ($uses:expr, $shapes:expr, $id:expr, $shape:ident => $body:expr, $none:expr) => {{
        use $crate::scene::uses::{self, has};
        let shapes = $shapes;
        let index = $id as usize;
        if let Some($shape) = shapes.spheres.get(index) {
            $body
        } else {
            let index = index.wrapping_sub(shapes.spheres.len());
            if has($uses, uses::TRIANGLES)
                && let Some($shape) = shapes.triangles.get(index)
            {
                $body
            } else {
                let index = index.wrapping_sub(shapes.triangles.len());
                if has($uses, uses::SMOOTH_TRIANGLES)
                    && let Some($shape) = shapes.smooth_triangles.get(index)
                {
                    $body
                } else {
                    let index = index.wrapping_sub(shapes.smooth_triangles.len());
                    if has($uses, uses::POLYGONS)
                        && let Some(polygon) = shapes.polygons.get(index)
                    {
                        let $shape = &polygon.view(shapes.edges);
                        $body
                    } else {
                        let index = index.wrapping_sub(shapes.polygons.len());
                        if has($uses, uses::CUBOIDS)
                            && let Some($shape) = shapes.cuboids.get(index)
                        {
                            $body
                        } else {
                            let index = index.wrapping_sub(shapes.cuboids.len());
                            if has($uses, uses::DISCS)
                                && let Some($shape) = shapes.discs.get(index)
                            {
                                $body
                            } else {
                                let index = index.wrapping_sub(shapes.discs.len());
                                if has($uses, uses::CYLINDERS)
                                    && let Some(it) = shapes.cylinders.get(index)
                                {
                                    if has($uses, uses::CAPS) {
                                        let $shape = it;
                                        $body
                                    } else {
                                        let $shape = &$crate::shape::Open(it);
                                        $body
                                    }
                                } else {
                                    let index = index.wrapping_sub(shapes.cylinders.len());
                                    if has($uses, uses::CONES)
                                        && let Some(it) = shapes.cones.get(index)
                                    {
                                        if has($uses, uses::CAPS) {
                                            let $shape = it;
                                            $body
                                        } else {
                                            let $shape = &$crate::shape::Open(it);
                                            $body
                                        }
                                    } else {
                                        let index = index.wrapping_sub(shapes.cones.len());
                                        if has($uses, uses::SOLIDS)
                                            && let Some(solid) = shapes.solids.get(index)
                                        {
                                            let $shape = &solid.view(shapes.operands);
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

impl<A: Arithmetic> Shapes<'_, A> {
    /// None: the base for `Shapes { spheres: …, ..Shapes::EMPTY }`.
    pub const EMPTY: Self = Self {
        spheres: &[],
        triangles: &[],
        smooth_triangles: &[],
        polygons: &[],
        edges: &[],
        uvs: &[],
        cuboids: &[],
        discs: &[],
        cylinders: &[],
        cones: &[],
        solids: &[],
        operands: &[],
        tree: None,
    };

    /// How many there are.
    #[inline(always)]
    pub const fn bounded(&self) -> u32 {
        (self.spheres.len()
            + self.triangles.len()
            + self.smooth_triangles.len()
            + self.polygons.len()
            + self.cuboids.len()
            + self.discs.len()
            + self.cylinders.len()
            + self.cones.len()
            + self.solids.len()) as u32
    }

    /// One more than the highest material's index.
    pub(super) const fn materials(&self) -> usize {
        let mut most = 0;
        macro_rules! look {
            ($($kind:ident)*) => {
                $(
                    let mut i = 0;
                    while i < self.$kind.len() {
                        let index = self.$kind[i].material_id().index();
                        if index >= most {
                            most = index + 1;
                        }
                        i += 1;
                    }
                )*
            };
        }
        look!(spheres triangles smooth_triangles polygons cuboids discs cylinders cones operands);
        most
    }

    /// Every shape's material must be there, every polygon's edges, and the tree must be over
    /// these shapes.
    pub(super) const fn check(&self, materials: usize) -> Result<(), SceneError> {
        macro_rules! check {
            ($($kind:ident),*) => {
                $(
                    let mut i = 0;
                    while i < self.$kind.len() {
                        let id: MaterialId = self.$kind[i].material_id();
                        if id.index() >= materials {
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
            operands
        );
        let mut i = 0;
        while i < self.polygons.len() {
            let polygon = &self.polygons[i];
            let end = polygon.first_edge() as u64 + polygon.edge_count() as u64;
            if end > self.edges.len() as u64 {
                return Err(SceneError::Edges { polygon: i as u32 });
            }
            i += 1;
        }
        let mut i = 0;
        while i < self.solids.len() {
            let solid = &self.solids[i];
            let end = solid.first_operand() as u64 + solid.operand_count() as u64;
            if end > self.operands.len() as u64 {
                return Err(SceneError::Operands { solid: i as u32 });
            }
            i += 1;
        }
        if let Some(tree) = &self.tree
            && tree.shapes() != self.bounded()
        {
            return Err(SceneError::Tree { shapes: tree.shapes() });
        }
        Ok(())
    }
}

impl<'a, A: Arithmetic> Parts<'a, A> {
    /// The shapes that have an end, and their tree.
    pub const fn shapes(&self) -> Shapes<'a, A> {
        Shapes {
            spheres: self.spheres,
            triangles: self.triangles,
            smooth_triangles: self.smooth_triangles,
            polygons: self.polygons,
            edges: self.edges,
            uvs: self.uvs,
            cuboids: self.cuboids,
            discs: self.discs,
            cylinders: self.cylinders,
            cones: self.cones,
            solids: self.solids,
            operands: self.operands,
            tree: self.tree,
        }
    }

    /// How many shapes there are besides planes: those that the tree is over.
    #[inline(always)]
    pub const fn bounded(&self) -> u32 {
        self.shapes().bounded()
    }
}

/// Adds the extents of the shapes of one kind.
macro_rules! add {
    ($shapes:expr, $kind:ident, $extents:ident, $next:ident, $log2_step:expr) => {
        let mut i = 0;
        while i < $shapes.$kind.len() {
            $extents[$next] = $shapes.$kind[i].extent($log2_step);
            $next += 1;
            i += 1;
        }
    };
}

for_each_arithmetic! {
    impl Shapes<'_, A> {
        /// Where the shapes lie, for [`OctreeBuffer::build`]: in steps of 2^`log2_step` for
        /// floating point (fixed point's are always 2⁻¹⁶). `N` must be
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
            add!(self, solids, extents, next, log2_step);
            extents
        }
    }

    impl Parts<'_, A> {
        /// See [`Shapes::extents`].
        ///
        /// # Panics
        /// Where `N` is another number than that of the bounded shapes.
        pub const fn extents<const N: usize>(&self, log2_step: i8) -> [Extent; N] {
            self.shapes().extents(log2_step)
        }
    }
}

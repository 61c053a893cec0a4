//! Solids: closed convex shapes united, intersected, taken from each other (constructive solid
//! geometry; Roth, "Ray casting for modeling solids", 1982).
//!
//! Each operand cuts at most one interval from a ray. Along the ray the ends of the intervals come
//! in order, each changes whether the ray is inside that operand, and the solid's surface is where
//! the [`Region`] then says otherwise than before. Ends at the same distance count at once.
//!
//! **Leaving.** A solid isn't convex, so a ray that leaves it may meet it again. But each operand is
//! convex: of the one whose surface the ray leaves, the side it goes to says all, without a test of
//! the surface it starts on. So the part of a solid that a ray leaves is the operand, and whether
//! the solid lies on its outside there.

use super::chord::{Chord, Convex};
use super::{Cone, Cuboid, Cylinder, MaterialId, Meeting, Plane, Ray, Region, Shape, ShapeError};
use super::{Sphere, Surface, ok_or_panic};
use crate::math::{Arithmetic, for_each_arithmetic};
use crate::octree::Extent;

/// A closed convex shape that solids are made of. It has a material of its own, which shows where
/// its surface is the solid's.
#[derive(Clone, Copy, Debug)]
pub enum Operand<A: Arithmetic> {
    /// A ball.
    Sphere(Sphere<A>),
    /// A box along the axes.
    Cuboid(Cuboid<A>),
    /// A cylinder with caps, whether it was given them or not.
    Cylinder(Cylinder<A>),
    /// A cone with caps, whether it was given them or not.
    Cone(Cone<A>),
    /// All that lies behind a plane.
    HalfSpace(Plane<A>),
}

/// A solid of up to eight [`Operand`]s, which lie elsewhere.
#[derive(Clone, Copy, Debug)]
pub struct Solid<A: Arithmetic> {
    region: Region,
    /// A box around it, a little larger.
    bound: Cuboid<A>,
    first_operand: u32,
    operand_count: u8,
}

/// A solid and its operands: the shape that rays meet.
#[derive(Clone, Copy, Debug)]
pub struct SolidView<'a, A: Arithmetic> {
    solid: &'a Solid<A>,
    operands: &'a [Operand<A>],
}

/// Without an end, in plain numbers.
const ENDLESS: f64 = 1e9;

for_each_arithmetic! {
    impl Operand<A> {
        /// The box around it, where it has an end.
        const fn reach(&self) -> ([f64; 3], [f64; 3]) {
            match self {
                Self::Sphere(sphere) => sphere.reach(),
                Self::Cuboid(cuboid) => cuboid.reach(),
                Self::Cylinder(cylinder) => cylinder.reach(),
                Self::Cone(cone) => cone.reach(),
                Self::HalfSpace(_) => ([-ENDLESS; 3], [ENDLESS; 3]),
            }
        }
    }

    impl Solid<A> {
        /// A solid, for scenes in `const`s.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(region: Region, operands: &[Operand<A>], first: u32, count: u8) -> Self {
            ok_or_panic!(Self::try_new(region, operands, first, count))
        }

        /// The solid that the region makes of `count` of the scene's operands, from `first` on.
        ///
        /// # Errors
        /// More than eight operands, or others than there are; a region without an inside or an
        /// end: one that is empty, that operands without an end leave open, or that holds what is
        /// outside all.
        pub const fn try_new(
            region: Region,
            operands: &[Operand<A>],
            first: u32,
            count: u8,
        ) -> Result<Self, ShapeError> {
            let n = count as usize;
            if n > Region::OPERANDS || n > operands.len() || first as usize > operands.len() - n {
                return Err(ShapeError::Operands);
            }
            // Combinations with operands that aren't there don't occur.
            let mut region = region;
            let mut k = n;
            while k < Region::OPERANDS {
                region = region.minus(Region::of(k));
                k += 1;
            }
            if region.is_nothing() {
                return Err(ShapeError::Operands);
            }
            // Where every combination has one of some operands, the solid lies in the box around
            // those: it lies in all such boxes.
            let (mut min, mut max) = ([-ENDLESS; 3], [ENDLESS; 3]);
            let mut some = 1;
            while some < 1usize << n {
                let mut left = region;
                let (mut low, mut high) = ([ENDLESS; 3], [-ENDLESS; 3]);
                let mut k = 0;
                while k < n {
                    if some >> k & 1 != 0 {
                        left = left.minus(Region::of(k));
                        let index = first as usize + k;
                        // There are so many; said once more so that no panic is left.
                        if index < operands.len() {
                            let (a, b) = operands[index].reach();
                            let mut i = 0;
                            while i < 3 {
                                low[i] = if a[i] < low[i] { a[i] } else { low[i] };
                                high[i] = if b[i] > high[i] { b[i] } else { high[i] };
                                i += 1;
                            }
                        }
                    }
                    k += 1;
                }
                let mut i = 0;
                while i < 3 && left.is_nothing() {
                    min[i] = if low[i] > min[i] { low[i] } else { min[i] };
                    max[i] = if high[i] < max[i] { high[i] } else { max[i] };
                    i += 1;
                }
                some += 1;
            }
            let mut size = 0.0;
            let mut i = 0;
            while i < 3 {
                if !(min[i] > -ENDLESS && max[i] < ENDLESS && min[i] < max[i]) {
                    return Err(ShapeError::Operands);
                }
                size = if max[i] - min[i] > size { max[i] - min[i] } else { size };
                i += 1;
            }
            // What rounding does to the operands, and to a ray that starts on one.
            let off = size / 4096.0 + 32.0 * make::from_length(make::from_grid(1, -100));
            let mut i = 0;
            while i < 3 {
                min[i] = clipped::<false>(min[i] - off);
                max[i] = clipped::<true>(max[i] + off);
                i += 1;
            }
            let bound = match Cuboid::<A>::try_new(min, max, 0) {
                Ok(bound) => bound,
                Err(error) => return Err(error),
            };
            Ok(Self { region, bound, first_operand: first, operand_count: count })
        }

        /// A box around it.
        pub const fn extent(&self, log2_step: i8) -> Extent {
            self.bound.extent(log2_step)
        }
    }

    /// Within the arithmetic's coordinates, where what is larger by a margin is not.
    const fn clipped<const UP: bool>(x: f64) -> f64 {
        if make::length(x).is_some() {
            return x;
        }
        let most = if make::length(2000.0).is_some() { 1e8 } else { 1024.0 };
        if UP { most } else { -most }
    }
}

impl<A: Arithmetic> Operand<A> {
    /// One without a size: what a pool is made of before operands are put there.
    pub const NONE: Self = Self::Cuboid(Cuboid::NONE);

    pub(crate) const fn material_id(&self) -> MaterialId {
        match self {
            Self::Sphere(shape) => shape.material_id(),
            Self::Cuboid(shape) => shape.material_id(),
            Self::Cylinder(shape) => shape.material_id(),
            Self::Cone(shape) => shape.material_id(),
            Self::HalfSpace(shape) => shape.material_id(),
        }
    }

    fn chord(&self, ray: &Ray<A>, coarse: &A::Coarse) -> Option<Chord<A>> {
        match self {
            Self::Sphere(shape) => shape.chord(ray, coarse),
            Self::Cuboid(shape) => shape.chord(ray, coarse),
            Self::Cylinder(shape) => shape.chord(ray, coarse),
            Self::Cone(shape) => shape.chord(ray, coarse),
            Self::HalfSpace(shape) => shape.chord(ray, coarse),
        }
    }

    fn surface(&self, ray: &Ray<A>, meeting: &Meeting<A>, p: &mut [A::Length; 3]) -> Surface<A> {
        match self {
            Self::Sphere(shape) => shape.surface(ray, meeting, p),
            Self::Cuboid(shape) => shape.surface(ray, meeting, p),
            Self::Cylinder(shape) => shape.surface(ray, meeting, p),
            Self::Cone(shape) => shape.surface(ray, meeting, p),
            Self::HalfSpace(shape) => shape.surface(ray, meeting, p),
        }
    }
}

impl<A: Arithmetic> Solid<A> {
    /// One without an inside, of no operands: what a pool is made of before solids are put there.
    pub const NONE: Self =
        Self { region: Region::NOTHING, bound: Cuboid::NONE, first_operand: 0, operand_count: 0 };

    /// The same with its operands elsewhere.
    pub(crate) const fn starting_at(self, first: u32) -> Self {
        Self { first_operand: first, ..self }
    }

    pub(crate) const fn region(&self) -> &Region {
        &self.region
    }

    /// The index of its first operand, among the scene's.
    pub const fn first_operand(&self) -> u32 {
        self.first_operand
    }

    /// How many operands it has.
    pub const fn operand_count(&self) -> u8 {
        self.operand_count
    }

    /// With its operands, of all those of the scene.
    #[inline(always)]
    pub(crate) fn view<'a>(&'a self, operands: &'a [Operand<A>]) -> SolidView<'a, A> {
        let first = self.first_operand as usize;
        let end = first.wrapping_add(usize::from(self.operand_count));
        SolidView { solid: self, operands: operands.get(first..end).unwrap_or(&[]) }
    }
}

/// Of the operand whose surface is the solid's: its place, and what happens there.
#[derive(Clone, Copy)]
struct Part {
    operand: u8,
    /// The ray leaves the operand there.
    leaves: bool,
    /// The solid lies on the operand's outside.
    flipped: bool,
}

impl Part {
    const FLIPPED: u8 = 1 << 7;

    /// As a meeting's detail: a number of five bits.
    fn detail<A: Arithmetic>(self) -> A::Length {
        let bits = self.operand & 7 | u8::from(self.leaves) << 3 | u8::from(self.flipped) << 4;
        let mut sum = A::NO_LENGTH;
        for i in 0..5 {
            if bits >> i & 1 != 0 {
                sum = sum + A::side(i);
            }
        }
        sum
    }

    fn of_detail<A: Arithmetic>(mut sum: A::Length) -> Self {
        let mut bits = 0;
        for i in (0..5).rev() {
            if sum >= A::side(i) {
                sum = sum - A::side(i);
                bits |= 1 << i;
            }
        }
        Self { operand: bits & 7, leaves: bits & 8 != 0, flipped: bits & 16 != 0 }
    }
}

impl<A: Arithmetic> SolidView<'_, A> {
    fn operand(&self, part: Part) -> Option<&Operand<A>> {
        self.operands.get(usize::from(part.operand))
    }
}

impl<A: Arithmetic> Shape<A> for SolidView<'_, A> {
    const FLAT: bool = false;
    const CONVEX: bool = false;

    /// `left`: the ray starts on this solid.
    fn nearest(
        &self,
        ray: &Ray<A>,
        coarse: &A::Coarse,
        left: bool,
        limit: A::Length,
    ) -> Option<Meeting<A>> {
        let around = self.solid.bound.chord(ray, coarse)?;
        if around.exit.distance < A::NO_LENGTH || around.entry.distance > limit {
            return None;
        }
        // Each operand's entry and exit, if they lie ahead, and those that the ray starts in.
        let mut ends = [[A::NO_LENGTH; 2]; Region::OPERANDS];
        let mut within = 0u8;
        let mut bit = 1u8;
        let mut number = 0;
        for (operand, [entry, exit]) in self.operands.iter().zip(&mut ends) {
            let leaving = left && ray.leaving.part & !Part::FLIPPED == number;
            let flipped = ray.leaving.part & Part::FLIPPED != 0;
            // Left outwards, the operand lies behind.
            if (!leaving || ray.leaving.inwards != flipped)
                && let Some(chord) = operand.chord(ray, coarse)
                && chord.exit.distance > A::NO_LENGTH
            {
                *exit = chord.exit.distance;
                if chord.entry.distance > A::NO_LENGTH && !leaving {
                    *entry = chord.entry.distance;
                } else {
                    within |= bit;
                }
            }
            bit <<= 1;
            number += 1;
        }
        let inside = self.solid.region.holds(within);
        let mut last = A::NO_LENGTH;
        loop {
            let mut next = A::FAR;
            for &end in ends.iter().flatten() {
                if end > last && end < next {
                    next = end;
                }
            }
            if next >= A::FAR || next > limit {
                return None;
            }
            let mut part = Part { operand: 0, leaves: false, flipped: false };
            let mut bit = 1u8;
            let mut number = 0;
            for &[entry, exit] in &ends {
                if entry == next || exit == next {
                    within ^= bit;
                    part.operand = number;
                    part.leaves = exit == next;
                }
                bit <<= 1;
                number += 1;
            }
            if self.solid.region.holds(within) != inside {
                part.flipped = part.leaves != inside;
                return Some(Meeting { distance: next, detail: part.detail::<A>() });
            }
            last = next;
        }
    }

    fn surface(&self, ray: &Ray<A>, meeting: &Meeting<A>, p: &mut [A::Length; 3]) -> Surface<A> {
        let part = Part::of_detail::<A>(meeting.detail);
        let coarse = A::coarse(&ray.origin, &ray.direction);
        let found = self.operand(part).and_then(|operand| {
            let chord = operand.chord(ray, &coarse)?;
            let end = if part.leaves { chord.exit } else { chord.entry };
            Some((operand, Meeting { distance: meeting.distance, detail: end.detail }))
        });
        let Some((operand, meeting)) = found else {
            // It had that chord when the ray met it.
            return super::turned(&[A::NO_UNIT; 3], A::NO_UNIT);
        };
        let surface = operand.surface(ray, &meeting, p);
        let number = part.operand | if part.flipped { Part::FLIPPED } else { 0 };
        Surface { behind: part.leaves != part.flipped, part: number, ..surface }
    }

    fn material(&self) -> MaterialId {
        self.operands.first().map_or(MaterialId::new(0), Operand::material_id)
    }

    fn material_at(&self, meeting: &Meeting<A>) -> MaterialId {
        let operand = self.operand(Part::of_detail::<A>(meeting.detail));
        operand.map_or(MaterialId::new(0), Operand::material_id)
    }
}

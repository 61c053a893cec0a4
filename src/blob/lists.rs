//! A blob's lists, taken off one after the other.

use bytemuck::AnyBitPattern;

use super::group::GroupHead;
use super::{BlobError, Stored, header};
use crate::math::Arithmetic;
use crate::scene::Shapes;

/// The next list of a blob, its values not looked at.
pub(super) fn raw<'b, T: AnyBitPattern>(
    bytes: &mut &'b [u8],
    count: u32,
) -> Result<&'b [T], BlobError> {
    let size = (count as usize).checked_mul(size_of::<T>()).ok_or(BlobError::Parts)?;
    // Rounding up a size near the largest number gives less.
    let whole = header::up(size);
    if whole < size {
        return Err(BlobError::Parts);
    }
    let (part, rest) = bytes.split_at_checked(whole).ok_or(BlobError::Parts)?;
    let values = part.get(..size).ok_or(BlobError::Parts)?;
    *bytes = rest;
    bytemuck::try_cast_slice(values).map_err(|_| BlobError::Alignment)
}

/// The next list of a blob.
pub(super) fn list<'b, T: Stored>(
    bytes: &mut &'b [u8],
    count: u32,
    index: &mut u32,
) -> Result<&'b [T], BlobError> {
    let values = raw::<T>(bytes, count)?;
    match values.iter().position(|value| !value.is_sound()) {
        Some(at) => return Err(BlobError::Shape { index: index.wrapping_add(at as u32) }),
        None => *index = index.wrapping_add(count),
    }
    Ok(values)
}

/// The first of a list, which are then not in it any more.
pub(super) fn first<'b, T>(list: &mut &'b [T], count: u32) -> Result<&'b [T], BlobError> {
    let (own, rest) = list.split_at_checked(count as usize).ok_or(BlobError::Parts)?;
    *list = rest;
    Ok(own)
}

/// The same of memory to be filled.
pub(super) fn first_mut<'r, T>(
    list: &mut &'r mut [T],
    count: u32,
) -> Result<&'r mut [T], BlobError> {
    let all = core::mem::take(list);
    let (own, rest) = all.split_at_mut_checked(count as usize).ok_or(BlobError::Parts)?;
    *list = rest;
    Ok(own)
}

/// A group's shapes and its tree's words, the first of those that are left.
pub(super) fn grouped<'b, A: Arithmetic>(
    head: &GroupHead,
    left: &mut Shapes<'b, A>,
    words: &mut &'b [u32],
) -> Result<(Shapes<'b, A>, &'b [u32]), BlobError> {
    let [a, b, c, d, e, f, g, h, i] = head.shapes;
    let shapes = Shapes {
        spheres: first(&mut left.spheres, a)?,
        triangles: first(&mut left.triangles, b)?,
        smooth_triangles: first(&mut left.smooth_triangles, c)?,
        polygons: first(&mut left.polygons, d)?,
        edges: first(&mut left.edges, e)?,
        cuboids: first(&mut left.cuboids, f)?,
        discs: first(&mut left.discs, g)?,
        cylinders: first(&mut left.cylinders, h)?,
        cones: first(&mut left.cones, i)?,
        uvs: first(&mut left.uvs, head.uvs)?,
        ..Shapes::EMPTY
    };
    Ok((shapes, first(words, head.words)?))
}

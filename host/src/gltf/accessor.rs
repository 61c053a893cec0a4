//! Numbers out of buffers. Nothing is taken on trust: a count is compared with the bytes there are
//! before anything of its size is made.

use std::cell::Cell;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use gltf_json::accessor::{Accessor, ComponentType, Type};
use gltf_json::buffer::View;
use gltf_json::validation::Checked;
use gltf_json::{Index, Root};

use super::indexed;
use crate::error::{Problem, shown};
use crate::read::Around;

/// Elements that are read of a file, all together: primitives may share bytes, so that a short
/// file could ask for much.
const MOST_ELEMENTS: u64 = 1 << 22;

/// Bytes of all buffers.
const MOST_BYTES: usize = 256 << 20;

/// The buffers of a file.
pub(super) struct Data<'r> {
    root: &'r Root,
    buffers: Vec<Vec<u8>>,
    /// Those read so far.
    elements: Cell<usize>,
}

/// Numbers in a view, as the file says.
struct List {
    view: Index<View>,
    offset: u64,
    count: u64,
    kind: ComponentType,
    /// Of an element.
    components: usize,
}

/// Where their bytes are.
struct Elements<'d> {
    bytes: &'d [u8],
    count: usize,
    stride: usize,
    kind: ComponentType,
}

impl<'r> Data<'r> {
    /// Reads all buffers, from the file itself, from texts in it, and from beside it.
    pub(super) fn new(
        root: &'r Root,
        binary: Option<&[u8]>,
        around: &Around,
    ) -> Result<Self, Problem> {
        let (mut buffers, mut sum) = (Vec::new(), 0);
        for (i, buffer) in root.buffers.iter().enumerate() {
            let place = format!("buffers[{i}]");
            let bytes = match &buffer.uri {
                None if i == 0 => binary
                    .ok_or_else(|| Problem::Missing { what: format!("{place}.uri") })?
                    .to_vec(),
                None => return Err(Problem::Missing { what: format!("{place}.uri") }),
                Some(uri) => of_uri(uri, &place, around)?,
            };
            sum += bytes.len();
            if sum > MOST_BYTES {
                return Err(Problem::TooLarge { bytes: sum as u64, most: MOST_BYTES as u64 });
            }
            if buffer.byte_length.0 > bytes.len() as u64 {
                let right = format!("at most {}, the bytes there are", bytes.len());
                let what = format!("{place}.byteLength");
                return Err(Problem::range(what, buffer.byte_length.0 as f64, right));
            }
            buffers.push(bytes);
        }
        Ok(Self { root, buffers, elements: Cell::new(0) })
    }

    /// Vectors of `N` components.
    pub(super) fn vectors<const N: usize>(
        &self,
        index: Index<Accessor>,
        place: &str,
    ) -> Result<Vec<[f64; N]>, Problem> {
        let wanted = if N == 2 { Type::Vec2 } else { Type::Vec3 };
        let all = self.rows::<N>(index, place, wanted)?;
        let farthest = crate::document::FARTHEST;
        for (at, vector) in all.iter().enumerate() {
            for (axis, &x) in vector.iter().enumerate() {
                if !x.is_finite() || x.abs() > farthest {
                    let what = format!("{place}[{at}] {}", ["x", "y", "z"][axis]);
                    return Err(Problem::range(what, x, format!("finite and within ±{farthest}")));
                }
            }
        }
        Ok(all)
    }

    /// Indices, each below `below`.
    pub(super) fn indices(
        &self,
        index: Index<Accessor>,
        place: &str,
        below: usize,
    ) -> Result<Vec<usize>, Problem> {
        let rows = self.rows::<1>(index, place, Type::Scalar)?;
        let accessor = indexed(&self.root.accessors, index, place, "accessors")?;
        if let Checked::Valid(kind) = accessor.component_type
            && !matches!(kind.0, ComponentType::U8 | ComponentType::U16 | ComponentType::U32)
        {
            let found = format!("{place} of {:?}", kind.0);
            return Err(Problem::Found { found, wanted: "unsigned whole numbers".into() });
        }
        let mut all = Vec::with_capacity(rows.len());
        for (at, [number]) in rows.into_iter().enumerate() {
            if number >= below as f64 {
                let right = format!("below {below}, the number of positions");
                return Err(Problem::range(format!("{place}[{at}]"), number, right));
            }
            all.push(number as usize);
        }
        Ok(all)
    }

    /// The bytes of an image that lies in a buffer.
    pub(super) fn image(&self, view: Index<View>, place: &str) -> Result<&[u8], Problem> {
        Ok(self.view(view, &format!("{place}.bufferView"))?.0)
    }

    /// An accessor's numbers: those of its view, or zeros without one, and in place of some of them
    /// those of its sparse list.
    fn rows<const N: usize>(
        &self,
        index: Index<Accessor>,
        place: &str,
        wanted: Type,
    ) -> Result<Vec<[f64; N]>, Problem> {
        let root = self.root;
        let accessor = indexed(&root.accessors, index, place, "accessors")?;
        let place = format!("accessors[{}]", index.value());
        let (Checked::Valid(kind), Checked::Valid(shape)) =
            (accessor.component_type, accessor.type_)
        else {
            let found = format!("{place} of an unknown type");
            return Err(Problem::Found { found, wanted: "componentType 5120 to 5126".into() });
        };
        if shape != wanted {
            let found = format!("{place}.type {shape:?}");
            return Err(Problem::Found { found, wanted: format!("{wanted:?}") });
        }
        let normalized = accessor.normalized;
        let count = accessor.count.0;
        let mut all = match (accessor.buffer_view, &accessor.sparse) {
            (Some(view), _) => {
                let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
                let list = List { view, offset, count, kind: kind.0, components: N };
                read(&self.elements(&list, &place)?, normalized)
            }
            (None, Some(_)) => {
                self.count(count)?;
                vec![[0.0; N]; count as usize]
            }
            (None, None) => {
                return Err(Problem::Missing { what: format!("{place}.bufferView") });
            }
        };
        if let Some(sparse) = &accessor.sparse {
            let place = format!("{place}.sparse");
            let Checked::Valid(index_kind) = sparse.indices.component_type else {
                let found = format!("{place}.indices of an unknown type");
                return Err(Problem::Found { found, wanted: "componentType 5121 to 5125".into() });
            };
            let count = sparse.count.0;
            let list = List {
                view: sparse.indices.buffer_view,
                offset: sparse.indices.byte_offset.0,
                count,
                kind: index_kind.0,
                components: 1,
            };
            let at: Vec<[f64; 1]> =
                read(&self.elements(&list, &format!("{place}.indices"))?, false);
            let list = List {
                view: sparse.values.buffer_view,
                offset: sparse.values.byte_offset.0,
                count,
                kind: kind.0,
                components: N,
            };
            let values = read(&self.elements(&list, &format!("{place}.values"))?, normalized);
            for ([at], value) in at.into_iter().zip(values) {
                let length = all.len();
                *all.get_mut(at as usize).ok_or_else(|| {
                    let right = format!("below {length}, the accessor's count");
                    Problem::range(format!("{place}.indices"), at, right)
                })? = value;
            }
        }
        Ok(all)
    }

    /// Counts elements, before there is memory for them.
    fn count(&self, more: u64) -> Result<(), Problem> {
        let all = (self.elements.get() as u64).saturating_add(more);
        if all > MOST_ELEMENTS {
            let what = "number of elements of all accessors together";
            return Err(Problem::range(what, all as f64, format!("at most {MOST_ELEMENTS}")));
        }
        self.elements.set(all as usize);
        Ok(())
    }

    /// The bytes of a view, and the view.
    fn view(&self, view: Index<View>, place: &str) -> Result<(&[u8], &'r View), Problem> {
        let view_place = format!("bufferViews[{}]", view.value());
        let view = indexed(&self.root.buffer_views, view, place, "bufferViews")?;
        let buffer =
            indexed(&self.buffers, view.buffer, &format!("{view_place}.buffer"), "buffers")?;
        let start = view.byte_offset.map_or(0, |offset| offset.0);
        let bytes = part(buffer, start, view.byte_length.0).ok_or_else(|| {
            let right = format!("within the {} bytes of its buffer", buffer.len());
            let end = start as f64 + view.byte_length.0 as f64;
            Problem::range(format!("{view_place}: byteOffset + byteLength"), end, right)
        })?;
        Ok((bytes, view))
    }

    fn elements(&self, list: &List, place: &str) -> Result<Elements<'_>, Problem> {
        let view_place = format!("bufferViews[{}]", list.view.value());
        let (bytes, view) = self.view(list.view, &format!("{place}.bufferView"))?;
        let size = list.kind.size() * list.components;
        let stride = view.byte_stride.map_or(size, |stride| stride.0);
        if stride < size || stride > 252 {
            let what = format!("{view_place}.byteStride");
            return Err(Problem::range(what, stride as f64, format!("{size} to 252")));
        }
        let bytes = usize::try_from(list.offset).ok().and_then(|offset| bytes.get(offset..));
        let room = bytes.map_or(0, |bytes| match bytes.len().checked_sub(size) {
            Some(more) => more / stride + 1,
            None => 0,
        });
        let (Some(bytes), true) = (bytes, list.count <= room as u64) else {
            let right = format!("at most {room}: {view_place} ends there");
            return Err(Problem::range(format!("{place}.count"), list.count as f64, right));
        };
        self.count(list.count)?;
        Ok(Elements { bytes, count: list.count as usize, stride, kind: list.kind })
    }
}

/// The numbers of a list.
fn read<const N: usize>(elements: &Elements<'_>, normalized: bool) -> Vec<[f64; N]> {
    let size = elements.kind.size();
    let row = |at: usize| {
        let from = at * elements.stride;
        std::array::from_fn(|i| {
            let from = from + i * size;
            number(elements.bytes.get(from..from + size), elements.kind, normalized)
        })
    };
    (0..elements.count).map(row).collect()
}

fn part(bytes: &[u8], start: u64, length: u64) -> Option<&[u8]> {
    let start = usize::try_from(start).ok()?;
    bytes.get(start..)?.get(..usize::try_from(length).ok()?)
}

/// A component, which is there: `elements` has counted.
fn number(bytes: Option<&[u8]>, kind: ComponentType, normalized: bool) -> f64 {
    let (value, most) = match (kind, bytes) {
        (ComponentType::F32, Some(&[a, b, c, d])) => {
            return f32::from_le_bytes([a, b, c, d]).into();
        }
        (ComponentType::U32, Some(&[a, b, c, d])) => {
            (u32::from_le_bytes([a, b, c, d]).into(), u32::MAX.into())
        }
        (ComponentType::I16, Some(&[a, b])) => (i16::from_le_bytes([a, b]).into(), i16::MAX.into()),
        (ComponentType::U16, Some(&[a, b])) => (u16::from_le_bytes([a, b]).into(), u16::MAX.into()),
        (ComponentType::I8, Some(&[a])) => ((a as i8).into(), i8::MAX.into()),
        (ComponentType::U8, Some(&[a])) => (a.into(), u8::MAX.into()),
        _ => (f64::NAN, 1.0),
    };
    if normalized { f64::max(value / most, -1.0) } else { value }
}

/// The bytes that a URI names: of itself, or of a file.
pub(super) fn of_uri(uri: &str, place: &str, around: &Around) -> Result<Vec<u8>, Problem> {
    if let Some(data) = uri.strip_prefix("data:") {
        let bytes = data.split_once(";base64,").and_then(|(_, text)| STANDARD.decode(text).ok());
        let found = || format!("{place}.uri \"{}\"", shown(uri));
        let wanted = "data:application/octet-stream;base64, and bytes so written";
        return bytes.ok_or_else(|| Problem::Found { found: found(), wanted: wanted.into() });
    }
    let file = around.beside(&uri.replace("%20", " "))?;
    file.bytes().map_err(|problem| {
        Problem::degenerate(format!("{place}.uri \"{}\"", shown(uri)), problem.to_string())
    })
}

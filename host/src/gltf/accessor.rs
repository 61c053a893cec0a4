//! Numbers out of buffers. Nothing is taken on trust: a count is compared with the bytes there are
//! before anything of its size is made.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use gltf_json::accessor::{Accessor, ComponentType, Type};
use gltf_json::validation::Checked;
use gltf_json::{Index, Root};

use super::indexed;
use crate::error::{Problem, shown};
use crate::read::Around;

/// Elements that are read of a file, all together: primitives may share bytes, so that a short
/// file could ask for much.
const MOST_ELEMENTS: usize = 1 << 22;

/// Bytes of all buffers.
const MOST_BYTES: usize = 256 << 20;

/// The buffers of a file.
pub(super) struct Data<'r> {
    root: &'r Root,
    buffers: Vec<Vec<u8>>,
    elements: usize,
}

/// Where an accessor's bytes are.
struct Elements<'d> {
    bytes: &'d [u8],
    count: usize,
    stride: usize,
    kind: ComponentType,
    normalized: bool,
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
        Ok(Self { root, buffers, elements: 0 })
    }

    /// Vectors of three.
    pub(super) fn vectors(
        &mut self,
        index: Index<Accessor>,
        place: &str,
    ) -> Result<Vec<[f64; 3]>, Problem> {
        let elements = self.elements(index, place, Type::Vec3)?;
        let size = elements.kind.size();
        let mut all = Vec::with_capacity(elements.count);
        for at in 0..elements.count {
            let mut vector = [0.0; 3];
            for (axis, x) in vector.iter_mut().enumerate() {
                let from = at * elements.stride + axis * size;
                *x = number(elements.bytes.get(from..from + size), &elements);
                if !x.is_finite() || x.abs() > crate::document::FARTHEST {
                    let what = format!("{place}[{at}] {}", ["x", "y", "z"][axis]);
                    let right = format!("finite and within ±{}", crate::document::FARTHEST);
                    return Err(Problem::range(what, *x, right));
                }
            }
            all.push(vector);
        }
        Ok(all)
    }

    /// Indices, each below `below`.
    pub(super) fn indices(
        &mut self,
        index: Index<Accessor>,
        place: &str,
        below: usize,
    ) -> Result<Vec<usize>, Problem> {
        let elements = self.elements(index, place, Type::Scalar)?;
        let size = elements.kind.size();
        if !matches!(elements.kind, ComponentType::U8 | ComponentType::U16 | ComponentType::U32) {
            let found = format!("{place} of {:?}", elements.kind);
            return Err(Problem::Found { found, wanted: "unsigned whole numbers".into() });
        }
        let mut all = Vec::with_capacity(elements.count);
        for at in 0..elements.count {
            let from = at * elements.stride;
            let bytes = elements.bytes.get(from..from + size).unwrap_or_default();
            let number = bytes.iter().rev().fold(0, |n, &b| n << 8 | usize::from(b));
            if number >= below {
                let right = format!("below {below}, the number of positions");
                return Err(Problem::range(format!("{place}[{at}]"), number as f64, right));
            }
            all.push(number);
        }
        Ok(all)
    }

    fn elements(
        &mut self,
        index: Index<Accessor>,
        place: &str,
        wanted: Type,
    ) -> Result<Elements<'_>, Problem> {
        let accessor = indexed(&self.root.accessors, index, place, "accessors")?;
        let place = format!("accessors[{}]", index.value());
        if accessor.sparse.is_some() {
            let found = format!("{place}.sparse");
            let wanted = "a plain list (sparse accessors aren't read)".into();
            return Err(Problem::Found { found, wanted });
        }
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
        let view = accessor
            .buffer_view
            .ok_or_else(|| Problem::Missing { what: format!("{place}.bufferView") })?;
        let at = format!("{place}.bufferView");
        let view_place = format!("bufferViews[{}]", view.value());
        let view = indexed(&self.root.buffer_views, view, &at, "bufferViews")?;
        let buffer =
            indexed(&self.buffers, view.buffer, &format!("{view_place}.buffer"), "buffers")?;
        let start = view.byte_offset.map_or(0, |offset| offset.0);
        let bytes = part(buffer, start, view.byte_length.0).ok_or_else(|| {
            let right = format!("within the {} bytes of its buffer", buffer.len());
            let end = start as f64 + view.byte_length.0 as f64;
            Problem::range(format!("{view_place}: byteOffset + byteLength"), end, right)
        })?;
        let components = if wanted == Type::Vec3 { 3 } else { 1 };
        let size = kind.0.size() * components;
        let stride = view.byte_stride.map_or(size, |stride| stride.0);
        if stride < size || stride > 252 {
            let what = format!("{view_place}.byteStride");
            return Err(Problem::range(what, stride as f64, format!("{size} to 252")));
        }
        let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
        let bytes = usize::try_from(offset).ok().and_then(|offset| bytes.get(offset..));
        let room = bytes.map_or(0, |bytes| match bytes.len().checked_sub(size) {
            Some(more) => more / stride + 1,
            None => 0,
        });
        let count = accessor.count.0;
        let (Some(bytes), true) = (bytes, count <= room as u64) else {
            let right = format!("at most {room}: {view_place} ends there");
            return Err(Problem::range(format!("{place}.count"), count as f64, right));
        };
        self.elements = self.elements.saturating_add(count as usize);
        if self.elements > MOST_ELEMENTS {
            let right = format!("at most {MOST_ELEMENTS}");
            let what = "number of elements of all accessors together";
            return Err(Problem::range(what, self.elements as f64, right));
        }
        let normalized = accessor.normalized;
        Ok(Elements { bytes, count: count as usize, stride, kind: kind.0, normalized })
    }
}

fn part(bytes: &[u8], start: u64, length: u64) -> Option<&[u8]> {
    let start = usize::try_from(start).ok()?;
    bytes.get(start..)?.get(..usize::try_from(length).ok()?)
}

/// A component, which is there: `elements` has counted.
fn number(bytes: Option<&[u8]>, elements: &Elements<'_>) -> f64 {
    let (value, most) = match (elements.kind, bytes) {
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
    if elements.normalized { f64::max(value / most, -1.0) } else { value }
}

/// The bytes that a URI names: of itself, or of a file.
fn of_uri(uri: &str, place: &str, around: &Around) -> Result<Vec<u8>, Problem> {
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

//! What a file of glTF is made of: a text in JSON, and bytes; both in one piece in a GLB.
//!
//! A GLB is twelve bytes (the letters glTF, the version, the length of all) and chunks: their
//! length, their kind, their bytes; numbers are little-endian. The first is the text, the second,
//! if there is one, the first buffer; others mean nothing here.

use crate::error::Problem;

/// The parts of a file.
pub(super) struct Container<'b> {
    pub(super) json: &'b [u8],
    pub(super) binary: Option<&'b [u8]>,
}

const VERSION: u32 = 2;

/// Splits a GLB; a file that isn't one is the text itself.
pub(super) fn split(bytes: &[u8]) -> Result<Container<'_>, Problem> {
    let Some(rest) = bytes.strip_prefix(b"glTF") else {
        return Ok(Container { json: bytes, binary: None });
    };
    let (version, rest) = word(rest, "the GLB's version")?;
    if version != VERSION {
        return Err(Problem::range("GLB version", version.into(), VERSION.to_string()));
    }
    let (length, rest) = word(rest, "the GLB's length")?;
    // Bytes behind the end aren't the file's.
    let body = (length as usize).checked_sub(12).and_then(|length| rest.get(..length));
    let body = body.ok_or_else(|| {
        let right = format!("12 to {}, the bytes that are there", bytes.len());
        Problem::range("GLB length", length.into(), right)
    })?;
    let (kind, json, rest) = chunk(body)?;
    if kind != *b"JSON" {
        let found = format!("a chunk \"{}\"", kind.escape_ascii());
        return Err(Problem::Found { found, wanted: "a first chunk \"JSON\"".into() });
    }
    let mut binary = None;
    if !rest.is_empty() {
        let (kind, bytes, _) = chunk(rest)?;
        binary = (kind == *b"BIN\0").then_some(bytes);
    }
    Ok(Container { json, binary })
}

fn word<'b>(bytes: &'b [u8], what: &str) -> Result<(u32, &'b [u8]), Problem> {
    let split = bytes.split_first_chunk::<4>();
    let (word, rest) = split.ok_or_else(|| Problem::Ended { wanted: what.into() })?;
    Ok((u32::from_le_bytes(*word), rest))
}

/// A chunk's kind, its bytes, and what follows it.
type Chunk<'b> = ([u8; 4], &'b [u8], &'b [u8]);

fn chunk(bytes: &[u8]) -> Result<Chunk<'_>, Problem> {
    let (length, rest) = word(bytes, "the length of a chunk")?;
    let kind = rest.split_first_chunk::<4>();
    let (kind, rest) = kind.ok_or_else(|| Problem::Ended { wanted: "a chunk's kind".into() })?;
    let (inside, rest) = rest.split_at_checked(length as usize).ok_or_else(|| {
        let what = format!("length of the chunk \"{}\"", kind.escape_ascii());
        Problem::range(what, length.into(), format!("at most {}, the bytes left", rest.len()))
    })?;
    Ok((*kind, inside, rest))
}

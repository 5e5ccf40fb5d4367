//! The GLB container: a header, a JSON chunk, and optionally a binary chunk (glTF 2.0
//! specification, section 4.4).

use std::path::Path;

use crate::error::{LoadError, Location};
use crate::warning::Warnings;

const HEADER: usize = 12;
const CHUNK_HEADER: usize = 8;
const JSON: u32 = 0x4e4f_534a;
const BIN: u32 = 0x004e_4942;

/// The parts of a GLB.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Container<'a> {
    pub(crate) json: &'a [u8],
    pub(crate) binary: Option<&'a [u8]>,
}

/// Parses a GLB. Every length is checked against the actual size.
pub(crate) fn open_glb<'a>(
    path: &Path,
    bytes: &'a [u8],
    warnings: &mut Warnings,
) -> Result<Container<'a>, LoadError> {
    let error = |at: usize, what: String| {
        LoadError::malformed(path, what, "export or download the file again").at(Location::Byte(at as u64))
    };
    if bytes.len() < HEADER {
        return Err(error(
            bytes.len(),
            format!("the file is truncated: {} bytes, and the GLB header has {HEADER}", bytes.len()),
        ));
    }
    if &bytes[..4] != b"glTF" {
        return Err(error(0, "this is not a GLB: the magic number is wrong".to_owned()));
    }
    let version = word(bytes, 4);
    if version != 2 {
        let what = format!("GLB version {version} is not supported, only version 2 is");
        return Err(LoadError::malformed(path, what, "export the model as glTF 2.0").at(Location::Byte(4)));
    }
    let length = word(bytes, 8) as usize;
    if length > bytes.len() {
        return Err(error(
            8,
            format!("the file is truncated: its length should be {length} bytes and is {}", bytes.len()),
        ));
    }
    if length < HEADER {
        return Err(error(8, format!("the length in the header is {length}, less than the header itself")));
    }
    if length < bytes.len() {
        let what = format!("{} bytes after the declared end are ignored", bytes.len() - length);
        warnings.push(Location::Byte(length as u64), what, "export the model again if something is missing");
    }
    read_chunks(&bytes[..length]).map_err(|(at, what)| error(at, what))
}

fn read_chunks(bytes: &[u8]) -> Result<Container<'_>, (usize, String)> {
    let (kind, json, mut at) = read_chunk(bytes, HEADER)?;
    if kind != JSON {
        return Err((HEADER, "the first chunk is not JSON".to_owned()));
    }
    if json.is_empty() {
        return Err((HEADER, "the JSON chunk is empty".to_owned()));
    }
    let mut binary = None;
    while at < bytes.len() {
        let (kind, data, next) = read_chunk(bytes, at)?;
        match kind {
            BIN if binary.is_none() => binary = Some(data),
            BIN => return Err((at, "there is a second binary chunk".to_owned())),
            JSON => return Err((at, "there is a second JSON chunk".to_owned())),
            // Chunks of other kinds belong to extensions and are skipped.
            _ => {}
        }
        at = next;
    }
    // Some exporters pad with zeros instead of spaces.
    let text = json.iter().rposition(|&byte| byte != 0).map_or(0, |last| last + 1);
    Ok(Container { json: &json[..text], binary })
}

/// A chunk's kind, its data, and the start of the next one.
fn read_chunk(bytes: &[u8], at: usize) -> Result<(u32, &[u8], usize), (usize, String)> {
    let rest = bytes.len() - at;
    if rest < CHUNK_HEADER {
        return Err((at, format!("the file ends within a chunk header: {rest} bytes of {CHUNK_HEADER}")));
    }
    let (length, kind) = (word(bytes, at) as usize, word(bytes, at + 4));
    let start = at + CHUNK_HEADER;
    if length > bytes.len() - start {
        return Err((
            at,
            format!(
                "a chunk claims {length} bytes and {} are left: the file is truncated",
                bytes.len() - start
            ),
        ));
    }
    Ok((kind, &bytes[start..start + length], start + length))
}

fn word(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn glb(chunks: &[(u32, &[u8])]) -> Vec<u8> {
        let mut body = Vec::new();
        for (kind, data) in chunks {
            body.extend((data.len() as u32).to_le_bytes());
            body.extend(kind.to_le_bytes());
            body.extend(*data);
        }
        let mut bytes = b"glTF\x02\0\0\0".to_vec();
        bytes.extend((body.len() as u32 + 12).to_le_bytes());
        bytes.extend(body);
        bytes
    }

    fn open(bytes: &[u8]) -> Result<Container<'_>, LoadError> {
        open_glb(Path::new("a.glb"), bytes, &mut Warnings::about(Path::new("a.glb")))
    }

    #[test]
    fn chunks_come_apart() {
        let bytes = glb(&[(JSON, b"{}  "), (0x1234_5678, b"skip"), (BIN, b"data")]);
        assert_eq!(open(&bytes), Ok(Container { json: b"{}  ", binary: Some(b"data") }), "both chunks");
    }

    #[test]
    fn every_truncation_and_every_wrong_length_is_an_error() {
        let good = glb(&[(JSON, b"{}  "), (BIN, b"data")]);
        for length in 0..good.len() {
            open(&good[..length]).expect_err("truncated");
        }
        for (at, value) in [
            (0, 0),
            (4, 1),
            (8, 0),
            (8, 11),
            (8, u32::MAX),
            (12, u32::MAX),
            (12, 0xffff_fff0),
            (12, 5),
            (16, BIN),
        ] {
            let mut bad = good.clone();
            bad[at..at + 4].copy_from_slice(&value.to_le_bytes());
            open(&bad).expect_err("a wrong word");
        }
        for chunks in [
            &[(JSON, &b""[..])][..],
            &[],
            &[(BIN, b"data")],
            &[(JSON, b"{}"), (JSON, b"{}")],
            &[(JSON, b"{}"), (BIN, b""), (BIN, b"")],
        ] {
            open(&glb(chunks)).expect_err("wrong chunks");
        }
    }
}

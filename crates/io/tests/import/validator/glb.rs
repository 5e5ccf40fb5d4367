//! The codes of the group GlbError: the container is broken.

use super::files::{BIN_CHUNK, JSON_CHUNK, chunks, container};
use super::row::{Refused, Row, Silent, Warned, raw};

pub(super) fn rows() -> Vec<Row> {
    [chunk_rows(), headers(), ends()].concat()
}

/// A kind of chunk that nobody knows.
const UNKNOWN_CHUNK: u32 = 0x4b4f_4f4c;

/// The sound square.
fn sound() -> Vec<u8> {
    let (json, binary) = chunks();
    container(&[(JSON_CHUNK, &json), (BIN_CHUNK, &binary)])
}

/// The sound square with four bytes of it changed.
fn patched(at: usize, value: u32) -> Vec<u8> {
    let mut bytes = sound();
    bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
    bytes
}

/// The sound square without its last bytes.
fn without(count: usize) -> Vec<u8> {
    let mut bytes = sound();
    bytes.truncate(bytes.len() - count);
    bytes
}

fn chunk_rows() -> Vec<Row> {
    vec![
        raw(
            "GLB_CHUNK_LENGTH_UNALIGNED",
            "a JSON chunk of an odd length",
            Silent("chunks are found by their lengths, aligned or not"),
            || {
                let (mut json, binary) = chunks();
                json.push(b' ');
                container(&[(JSON_CHUNK, &json), (BIN_CHUNK, &binary)])
            },
        ),
        raw("GLB_CHUNK_TOO_BIG", "a chunk that is longer than the file", Refused, || patched(12, 1 << 20)),
        raw("GLB_DUPLICATE_CHUNK", "two binary chunks", Refused, || {
            let (json, binary) = chunks();
            container(&[(JSON_CHUNK, &json), (BIN_CHUNK, &binary), (BIN_CHUNK, &binary)])
        }),
        raw("GLB_EMPTY_CHUNK", "an empty JSON chunk", Refused, || container(&[(JSON_CHUNK, b"")])),
        raw(
            "GLB_UNEXPECTED_BIN_CHUNK",
            "a binary chunk that is the third",
            Silent("there is only one binary chunk, so its place does not matter"),
            || {
                let (json, binary) = chunks();
                container(&[(JSON_CHUNK, &json), (UNKNOWN_CHUNK, b"look"), (BIN_CHUNK, &binary)])
            },
        ),
        raw("GLB_UNEXPECTED_FIRST_CHUNK", "a binary chunk before the JSON", Refused, || {
            let (json, binary) = chunks();
            container(&[(BIN_CHUNK, &binary), (JSON_CHUNK, &json)])
        }),
        raw(
            "GLB_UNKNOWN_CHUNK_TYPE",
            "a chunk of an unknown kind",
            Silent("by the specification, unknown chunks are skipped"),
            || {
                let (json, binary) = chunks();
                container(&[(JSON_CHUNK, &json), (BIN_CHUNK, &binary), (UNKNOWN_CHUNK, b"look")])
            },
        ),
    ]
}

fn headers() -> Vec<Row> {
    vec![
        raw("GLB_INVALID_MAGIC", "a GLB that does not start with glTF", Refused, || patched(0, 0x4654_6c68)),
        raw("GLB_INVALID_VERSION", "a GLB of version 3", Refused, || patched(4, 3)),
        raw("GLB_LENGTH_MISMATCH", "a length that is eight bytes too long", Refused, || {
            patched(8, sound().len() as u32 + 8)
        }),
        raw("GLB_LENGTH_TOO_SMALL", "a length of 4", Refused, || patched(8, 4)),
    ]
}

fn ends() -> Vec<Row> {
    vec![
        raw("GLB_EXTRA_DATA", "bytes after the end", Warned, || [&sound()[..], b"more"].concat()),
        raw("GLB_UNEXPECTED_END_OF_CHUNK_DATA", "a file that ends within a chunk", Refused, || without(9)),
        raw(
            "GLB_UNEXPECTED_END_OF_CHUNK_HEADER",
            "a file that ends within a chunk's header",
            Refused,
            || sound()[..16].to_vec(),
        ),
        raw("GLB_UNEXPECTED_END_OF_HEADER", "a file that ends within its header", Refused, || {
            sound()[..9].to_vec()
        }),
    ]
}

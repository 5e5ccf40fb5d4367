//! The hash of a mesh's triangles in a file: all accessors of all primitives, in a form that does
//! not change if a program only renumbers or moves them.

use gltf::json::accessor::{ComponentType, Type};

use super::hash::xxh64;

/// The hash of an accessor: its format, and the hash of its elements' bytes.
pub(super) fn accessor_hash(
    component: ComponentType,
    kind: Type,
    normalized: bool,
    count: usize,
    elements: u64,
) -> u64 {
    let format = [component.as_gl_enum(), kind.multiplicity() as u32, u32::from(normalized)];
    let mut bytes: Vec<u8> = format.iter().flat_map(|word| word.to_le_bytes()).collect();
    bytes.extend((count as u64).to_le_bytes());
    bytes.extend(elements.to_le_bytes());
    xxh64(&bytes)
}

/// Collects the primitives of a mesh.
#[derive(Default)]
pub(super) struct TriangleHash {
    bytes: Vec<u8>,
}

impl TriangleHash {
    /// Begins the next primitive, with its OpenGL mode.
    pub(super) fn primitive(&mut self, mode: u32) {
        self.accessor("mode", u64::from(mode));
    }

    /// The next accessor of the primitive. Attributes come sorted by their names, then indices,
    /// then morph targets.
    pub(super) fn accessor(&mut self, name: &str, hash: u64) {
        self.bytes.extend((name.len() as u32).to_le_bytes());
        self.bytes.extend(name.as_bytes());
        self.bytes.extend(hash.to_le_bytes());
    }

    /// The hash as stored in files.
    pub(super) fn finish(&self) -> String {
        format!("{:016x}", xxh64(&self.bytes))
    }
}

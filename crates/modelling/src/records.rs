//! What is stored for an element besides its values: who its neighbours are.
//!
//! Following Ton Roosendaal's and others' BMesh (Blender), which itself follows Weiler's
//! radial edge structure (Kevin Weiler, "The Radial Edge Structure", 1988), with indices in
//! place of pointers:
//!
//! - a vertex knows one of its edges; all edges at a vertex form a ring (`next`, `previous`
//!   of each edge, for each of its ends);
//! - an edge knows one of the corners that leave along it; all of them, of any number of
//!   faces, form a ring (`radial_next`, `radial_previous`);
//! - a corner knows its vertex, its face, the edge to the face's next corner, and its
//!   neighbours in the face;
//! - a face knows its first corner.
//!
//! So every walk from an element to its neighbours takes time proportional to what it
//! finds, and an edge may belong to any number of faces.

use super::ids::NONE;

/// There is such an element; else its slot waits to be used again.
pub(super) const ALIVE: u32 = 1;
/// The element is neither shown nor changed by operations of an editor.
pub(super) const HIDDEN: u32 = 2;
/// An edge that stays sharp in smooth shading.
pub(super) const SHARP: u32 = 4;
/// An edge at which texture coordinates are cut when they are laid out.
pub(super) const SEAM: u32 = 8;
/// A face that is shaded smoothly.
pub(super) const SMOOTH: u32 = 16;
/// A vertex that is shown as a point.
pub(super) const POINT: u32 = 32;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct VertexRecord {
    /// One of its edges; `NONE` without any. Of a slot that is free: the next free one.
    pub(super) edge: u32,
    pub(super) flags: u32,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct EdgeRecord {
    /// Two different vertices.
    pub(super) vertices: [u32; 2],
    /// For each end, the next edge at that vertex. Of a free slot: the next free one in `[0]`.
    pub(super) next: [u32; 2],
    pub(super) previous: [u32; 2],
    /// One of the corners that leave along it; `NONE` without a face.
    pub(super) corner: u32,
    /// 0 (smooth) to 1 (sharp) in Catmull-Clark subdivision.
    pub(super) crease: f32,
    pub(super) flags: u32,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CornerRecord {
    pub(super) vertex: u32,
    /// From this vertex to that of the next corner.
    pub(super) edge: u32,
    /// `NONE` where the slot is free; then `next` is the next free one.
    pub(super) face: u32,
    pub(super) next: u32,
    pub(super) previous: u32,
    pub(super) radial_next: u32,
    pub(super) radial_previous: u32,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FaceRecord {
    /// Its first corner. Of a slot that is free: the next free one.
    pub(super) corner: u32,
    /// How many corners it has.
    pub(super) size: u32,
    pub(super) material: u32,
    pub(super) flags: u32,
}

impl EdgeRecord {
    /// Which end a vertex is: 0 or 1.
    #[inline]
    pub(super) fn end(&self, vertex: u32) -> usize {
        debug_assert!(self.vertices.contains(&vertex), "the edge ends at another vertex");
        usize::from(self.vertices[0] != vertex)
    }

    /// The vertex at the other end.
    #[inline]
    pub(super) fn other(&self, vertex: u32) -> u32 {
        self.vertices[1 - self.end(vertex)]
    }
}

/// The first free slot of each kind, and how many elements there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Slots {
    pub(super) free: u32,
    pub(super) alive: u32,
}

impl Default for Slots {
    fn default() -> Self {
        Self { free: NONE, alive: 0 }
    }
}

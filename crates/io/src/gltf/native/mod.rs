//! What a native file holds beside a glTF that every program reads: `extras.trigon` of meshes,
//! nodes and materials.
//!
//! A mesh names views of the buffer with its polygons, its exact values and its marks
//! ([`Header`]), and the hash of the triangles that stand for them. If another program changed
//! the triangles, the hash tells, and the triangles count. Transforms need nothing here: numbers
//! of glTF are decimal, so a node's own members hold all digits of an f64.

mod columns;
mod extras;
mod read;

pub(super) use columns::columns_of_mesh;
pub(super) use extras::{AmbientExtras, ExactShading, Extras, Header, MaterialExtras, NodeExtras};
pub(super) use read::{NativeMesh, read_native_mesh};

/// The member of `extras`.
pub(super) const MEMBER: &str = "trigon";

/// The version that is written, and the last that is read.
pub(super) const VERSION: u32 = 1;

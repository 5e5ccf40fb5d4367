//! The editor's additions to a standard glTF file: `extras.trigon` of meshes, nodes and materials.
//!
//! A mesh names buffer views with its polygons, its exact values and its marks ([`Header`]), and
//! the hash of the triangles that represent them. If another program changed the triangles, the
//! hash differs, and the triangles are used. Transforms need nothing here: numbers in glTF are
//! decimal, so a node's own members hold all digits of an f64.

mod columns;
mod extras;
mod read;

pub(super) use columns::columns_of_mesh;
pub(super) use extras::{AmbientExtras, ExactShading, Extras, Header, MaterialExtras, NodeExtras};
pub(super) use read::{NativeMesh, read_native_mesh};

/// The member of `extras`.
pub(super) const MEMBER: &str = "trigon";

/// The version that is written, and the latest that is read.
pub(super) const VERSION: u32 = 1;

//! The cases of `docs/hard-cases.md` that no other module holds yet, one file for
//! each family.

mod blending;
mod coverage;
mod depth;
mod huge;
mod junctions;
mod near_plane;
pub(crate) mod slivers;
mod texture;

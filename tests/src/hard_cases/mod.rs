//! The cases of `docs/hard-cases.md` that no other module holds yet, one file for
//! each family.

mod against_rays;
mod blending;
mod camera;
mod coverage;
mod depth;
mod edits;
mod flight;
mod flight_facet;
mod flight_oracle;
mod flight_scenes;
mod hostile_values;
mod huge;
mod junctions;
mod lights;
mod mesh;
mod near_plane;
mod sizes;
pub(crate) mod slivers;
mod texture;
mod transforms;

//! The cases of `docs/hard-cases.md` that no other module holds yet, one file for
//! each family.

mod against_rays;
mod animation;
mod blending;
mod camera;
mod clip_planes;
mod coverage;
mod depth;
mod edits;
mod environments;
pub(crate) mod flight;
mod flight_facet;
pub(crate) mod flight_oracle;
pub(crate) mod flight_scenes;
mod hostile_values;
pub(crate) mod huge;
mod instances;
mod junctions;
mod lights;
mod masks;
mod mesh;
mod morphs;
mod near_plane;
mod near_points;
mod shadows;
mod sizes;
pub(crate) mod slivers;
mod texture;
mod texture_detail;
mod transforms;
pub(crate) mod wide_lines;

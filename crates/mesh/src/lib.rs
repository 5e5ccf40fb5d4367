//! Polygon meshes: faces and edges as they were modelled, what they carry,
//! the standard objects, and what a renderer needs of them.

mod attributes;
mod builder;
mod edges;
mod error;
mod groups;
mod mesh;
mod normals;
pub mod primitives;
mod render_mesh;
mod smooth;
mod topology;
mod transform;
mod triangulate;
mod triangulation;
mod weld;

pub use attributes::Attributes;
pub use builder::MeshBuilder;
pub use error::MeshError;
pub use mesh::Mesh;

pub use render_mesh::RenderMesh;
pub use triangulate::triangulate_polygon;
pub use triangulation::Triangulation;

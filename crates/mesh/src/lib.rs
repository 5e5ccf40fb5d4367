//! Polygon meshes: vertices, edges and faces as modelled, their attributes, standard objects, and
//! render meshes.
//!
//! A [`Mesh`] keeps polygons and edges as they were modelled; triangles and welded vertices are
//! derived from it when needed ([`Triangulation`], [`RenderMesh`]). So a cube shows its own 12
//! edges as wires, a face id is the index of the polygon in the file, and saving a mesh writes what
//! was loaded.
//!
//! This crate does not depend on cameras, materials or pixels, reads no files, and gives the same
//! bits on every machine.
//!
//! # Conventions
//! Metres, right-handed, +Y up; faces are counter-clockwise seen from outside; texture coordinates
//! have (0, 0) in the upper left corner of the image.
//!
//! # Example
//! A rectangle with a rectangular hole, as one face: the outline is connected to the hole by one edge, which it
//! follows in both directions. Its triangles leave the hole open, as the output shows:
//!
//! ```
//! use trigon_mesh::MeshBuilder;
//! use trigon_mesh::math::Vec3;
//!
//! let mut builder = MeshBuilder::new();
//! for (x, y) in [(0, 0), (8, 0), (8, 4), (0, 4), (2, 1), (2, 3), (6, 3), (6, 1)] {
//!     builder.push_vertex(Vec3::new(x as f32, y as f32, 0.0));
//! }
//! builder.push_face(&[0, 1, 2, 3, 0, 4, 5, 6, 7, 4])?;
//! let mesh = builder.build();
//! assert_eq!((mesh.vertex_count(), mesh.edge_count(), mesh.face_count()), (8, 9, 1));
//!
//! let corner = |corner: u32| mesh.positions()[mesh.corner_vertices()[corner as usize] as usize];
//! let triangles = mesh.triangulation().triangles;
//! let covers = |point: Vec3, triangle: &[u32; 3]| {
//!     let [a, b, c] = triangle.map(|i| corner(i) - point);
//!     a.cross(b).z > 0.0 && b.cross(c).z > 0.0 && c.cross(a).z > 0.0
//! };
//! let image = [0, 1, 2, 3].map(|row| -> String {
//!     let pixel = |column| Vec3::new(column as f32 + 0.45, row as f32 + 0.55, 0.0);
//!     let is_covered = |column| triangles.iter().any(|t| covers(pixel(column), t));
//!     (0..8).map(|column| if is_covered(column) { '#' } else { '.' }).collect()
//! });
//! assert_eq!(image, ["########", "##....##", "##....##", "########"]);
//! # Ok::<(), trigon_mesh::MeshError>(())
//! ```

mod attributes;
mod builder;
mod change;
mod clustering;
mod columns;
mod deformed;
mod edges;
mod error;
mod flat_faces;
mod groups;
mod mesh;
mod normals;
pub mod primitives;
mod render_mesh;
mod surface;
mod tangents;
mod transform;
mod triangulate;
mod triangulation;
mod vertex_values;
mod weld;
mod welded_mesh;

pub use attributes::{Attributes, Deltas, MorphTarget, SkinWeights};
pub use builder::MeshBuilder;
pub use change::{ChangeError, ChangedElements, MeshChange, RenderLinks, RenderUpdate, UpdatedVertex};
pub use clustering::ClusteredMesh;
pub use columns::{EdgeMark, EditData, MeshColumns, VertexGroupData};
pub use deformed::Deformed;
pub use error::MeshError;
pub use flat_faces::FlatFaces;
pub use mesh::Mesh;
pub use render_mesh::RenderMesh;
pub use surface::{EdgeJoin, Surface};
pub use triangulate::{Triangulator, triangulate_polygon};
pub use triangulation::Triangulation;
pub use welded_mesh::WeldedMesh;

/// Re-export of the crate below, so that points and vectors need no other dependency.
pub use trigon_math as math;

/// Runs the README's example as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

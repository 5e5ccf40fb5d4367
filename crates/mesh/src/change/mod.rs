//! Changes of a mesh whose vertices, edges and faces stay what they are, and what a
//! renderer has to do anew after one.
//!
//! A [`MeshChange`] gives some elements other values; [`Mesh::change`](crate::Mesh::change)
//! takes it over. [`RenderLinks`] know which vertices of a
//! [`RenderMesh`](crate::RenderMesh) come from which corners, so that a change of few
//! elements costs what lies around these and not the whole mesh. The values that they give are, to the
//! bit, those of a [`RenderMesh`](crate::RenderMesh) made from the changed mesh.

mod changed_elements;
mod corner_faces;
mod face_normals;
mod local_normals;
mod marks;
mod mesh_change;
mod render_links;
mod render_update;
mod vertex_values;

pub use changed_elements::ChangedElements;
pub use mesh_change::{ChangeError, MeshChange};
pub use render_links::RenderLinks;
pub use render_update::{RenderUpdate, UpdatedVertex};

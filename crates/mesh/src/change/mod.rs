//! Changes of values in a mesh whose vertices, edges and faces stay the same, and the updates that a
//! renderer needs after such a change.
//!
//! A [`MeshChange`] lists new values for some elements; [`Mesh::change`](crate::Mesh::change) writes them.
//! [`RenderLinks`] map the vertices of a [`RenderMesh`](crate::RenderMesh) to the corners that they come
//! from. The cost of a change of few elements therefore depends on their neighbourhood and not on the whole
//! mesh. The updated values are, to the bit, those of a [`RenderMesh`](crate::RenderMesh) made from the
//! changed mesh.

mod changed_elements;
mod corner_faces;
mod face_normals;
mod fans;
mod local_normals;
mod marks;
mod mesh_change;
mod neighborhood;
mod normal_lists;
mod outlines;
mod render_links;
mod render_update;
mod vertex_values;

pub use changed_elements::ChangedElements;
pub use mesh_change::{ChangeError, MeshChange};
pub use outlines::Outlines;
pub use render_links::RenderLinks;
pub use render_update::{RenderUpdate, UpdatedVertex};

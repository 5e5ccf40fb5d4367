//! Changes of values in a mesh whose vertices, edges and faces stay the same, and the updates that a
//! renderer needs after such a change.
//!
//! A [`MeshChange`] lists new values for some elements; [`Mesh::change`](crate::Mesh::change) writes them.
//! [`RenderLinks`] know from which corners each vertex of a [`RenderMesh`](crate::RenderMesh) comes, and so tell
//! what a change affects. A small change costs as much as its neighbourhood, whatever the size of the mesh. The
//! updated values are, to the bit, those of a [`RenderMesh`](crate::RenderMesh) made from the changed mesh.

mod mesh_change;
mod normals;
mod render_links;

pub use mesh_change::{ChangeError, ChangedElements, MeshChange};
pub use render_links::{RenderLinks, RenderUpdate, UpdatedVertex};

/// Faces or vertices per task: about a tenth of a millisecond's work, a few times what it takes to wake a thread.
const ELEMENTS_PER_TASK: usize = 1024;

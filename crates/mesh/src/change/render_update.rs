//! What a change of a mesh changes in the render mesh that was made from it.

use trigon_math::Vec3;

use crate::Triangulation;

/// What of a [`RenderMesh`](crate::RenderMesh) is to be written anew after a change of its
/// mesh; told by [`RenderLinks::follow`](crate::RenderLinks::follow).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RenderUpdate {
    /// Vertices with other values. Those beyond the ones that there were are new, and come
    /// in the order of their numbers.
    pub vertices: Vec<UpdatedVertex>,
    /// Polygons that may be cut otherwise, or whose corners are other vertices than
    /// before; increasing.
    pub faces: Vec<u32>,
    /// Their triangles over the corners of the mesh. A polygon may have more or fewer than
    /// before.
    pub triangulation: Triangulation,
}

/// A vertex of a [`RenderMesh`](crate::RenderMesh) with other values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UpdatedVertex {
    /// Its number in the render mesh.
    pub vertex: u32,
    /// The corner of the mesh whose position and attributes it shows.
    pub corner: u32,
    /// The shading normal of that corner; of unit length.
    pub normal: Vec3,
}

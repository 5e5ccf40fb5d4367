//! The values of a mesh's vertices, column by column: what a vertex stage in
//! vectors reads.

use trigon_math::{Vec2, Vec3, Vec4};
use trigon_mesh::RenderMesh;

/// The values of a mesh's vertices. All columns have the same length.
#[derive(Clone, Debug, Default)]
pub(crate) struct Columns {
    pub(crate) positions: [Vec<f32>; 3],
    /// Of unit length.
    pub(crate) normals: [Vec<f32>; 3],
    /// Of unit length, and the handedness of the bitangent.
    pub(crate) tangents: Option<[Vec<f32>; 4]>,
    pub(crate) uv_sets: Vec<[Vec<f32>; 2]>,
    /// Linear light, straight alpha.
    pub(crate) colors: Option<[Vec<f32>; 4]>,
}

impl Columns {
    pub(crate) fn new(mesh: &RenderMesh) -> Self {
        Self {
            positions: turned(&mesh.positions, Vec3::to_array),
            normals: turned(&mesh.normals, Vec3::to_array),
            tangents: mesh.tangents.as_deref().map(|tangents| turned(tangents, Vec4::to_array)),
            uv_sets: mesh.uv_sets.iter().map(|set| turned(set, Vec2::to_array)).collect(),
            colors: mesh.colors.as_deref().map(|colors| turned(colors, Vec4::to_array)),
        }
    }

    pub(crate) fn vertex_count(&self) -> usize {
        self.positions[0].len()
    }
}

/// Rows become columns.
fn turned<T, const N: usize>(rows: &[T], entries: fn(&T) -> [f32; N]) -> [Vec<f32>; N] {
    let mut columns = [const { Vec::new() }; N];
    for (axis, column) in columns.iter_mut().enumerate() {
        column.extend(rows.iter().map(|row| entries(row)[axis]));
    }
    columns
}

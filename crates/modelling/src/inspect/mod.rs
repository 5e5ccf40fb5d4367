//! What may be wrong with a model, for example for 3D printing: findings that name elements, and repairs.
//!
//! None of these faults breaks the structure, so [`EditMesh::check_structure`] does not look for them. Such
//! meshes are valid here, but other programs have trouble with them. Each finding is a method of its own;
//! [`EditMesh::inspect`] returns all of them. Most repairs are methods, too. Two findings are repaired by
//! operations: doubled vertices by merging by distance, inconsistent winding by recalculating normals.

mod doubles;
mod edges;
mod faces;
mod loose;
mod overhang;
mod repair;
mod thickness;
mod touching;
mod triangle_tree;
mod triangles_touch;

pub use doubles::{DoubledFace, DoubledVertex};
pub use edges::BoundaryLoop;
pub use faces::NonPlanarFace;
pub use overhang::OverhangSettings;
pub use thickness::FaceThickness;
pub(crate) use touching::FaceTriangle;
pub use touching::TouchingFaces;
pub(crate) use triangle_tree::{PairSearch, TriangleTree};

use super::edit_mesh::EditMesh;
use super::ids::{EdgeId, FaceId, VertexId};

/// From when on something counts as a finding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InspectionSettings {
    /// An edge that is no longer than this has no length, in metres.
    pub zero_length: f64,
    /// A face that is no larger than this has no area, in square metres.
    pub zero_area: f64,
    /// A face with a corner farther than this from its plane is not planar, in metres.
    pub planar_within: f64,
    /// Vertices that are no farther than this from each other are doubled, in metres.
    pub doubled_within: f64,
    /// After how many touches the search for touching faces ends.
    pub most_touches: usize,
}

impl Default for InspectionSettings {
    /// A micrometre for lengths and doubles, its square for areas, a tenth of a millimetre for planes, ten thousand touches.
    fn default() -> Self {
        Self {
            zero_length: 1e-6,
            zero_area: 1e-12,
            planar_within: 1e-4,
            doubled_within: 1e-6,
            most_touches: 10_000,
        }
    }
}

/// Everything that was found. Lists are in ascending order of ids unless they say otherwise.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct Inspection {
    /// Edges with three or more sides of faces.
    pub non_manifold_edges: Vec<EdgeId>,
    /// Edges with one side of a face, in chains.
    pub boundary_loops: Vec<BoundaryLoop>,
    /// Edges whose two faces run along them in the same direction.
    pub inconsistent_edges: Vec<EdgeId>,
    /// Edges without a face.
    pub loose_edges: Vec<EdgeId>,
    /// Vertices without an edge, but for those that are shown as points.
    pub loose_vertices: Vec<VertexId>,
    /// The faces of each part that is connected over vertices, the part with the smallest
    /// face first.
    pub parts: Vec<Vec<FaceId>>,
    /// Edges without length.
    pub zero_length_edges: Vec<EdgeId>,
    /// Faces without area.
    pub zero_area_faces: Vec<FaceId>,
    /// Faces with corners off their plane.
    pub non_planar_faces: Vec<NonPlanarFace>,
    /// Vertices at the place of another.
    pub doubled_vertices: Vec<DoubledVertex>,
    /// Faces with the vertices of another.
    pub doubled_faces: Vec<DoubledFace>,
    /// Faces that touch or cross others with which they share no vertex.
    pub touching_faces: TouchingFaces,
    /// The volume in cubic metres if the mesh is watertight; negative if it looks inwards.
    pub volume: Option<f64>,
}

impl EditMesh {
    /// Looks for everything that is usually in the way of printing or further work.
    #[must_use]
    pub fn inspect(&self, settings: &InspectionSettings) -> Inspection {
        Inspection {
            non_manifold_edges: self.non_manifold_edges(),
            boundary_loops: self.boundary_loops(),
            inconsistent_edges: self.inconsistent_edges(),
            loose_edges: self.loose_edges(),
            loose_vertices: self.loose_vertices(),
            parts: self.parts(),
            zero_length_edges: self.zero_length_edges(settings.zero_length),
            zero_area_faces: self.zero_area_faces(settings.zero_area),
            non_planar_faces: self.non_planar_faces(settings.planar_within),
            doubled_vertices: self.doubled_vertices(settings.doubled_within),
            doubled_faces: self.doubled_faces(),
            touching_faces: self.touching_faces(settings.most_touches),
            volume: self.is_watertight().then(|| self.volume()),
        }
    }
}

#[cfg(test)]
mod tests {
    use trigon_mesh::primitives;

    use super::*;

    #[test]
    fn a_solid_gives_no_findings() {
        for solid in
            [primitives::cube(2.0), primitives::torus(2.0, 0.5, 16, 8), primitives::icosphere(1.0, 2)]
        {
            let (mesh, _) = EditMesh::from_mesh(&solid);
            let found = mesh.inspect(&InspectionSettings::default());
            let expected = Inspection {
                parts: vec![mesh.faces().collect()],
                touching_faces: TouchingFaces { pairs: vec![], is_complete: true },
                volume: Some(mesh.volume()),
                ..Inspection::default()
            };
            assert_eq!(found, expected, "only one part with its volume");
        }
    }
}

//! Measures of the whole mesh: bounds, volume, centre of mass.

use trigon_math::{Bounds3, DVec3};
use trigon_mesh::EdgeJoin;

use crate::edit_mesh::EditMesh;
use crate::ids::VertexId;

impl EditMesh {
    /// The box around some vertices; its size are the dimensions. Empty without a vertex.
    pub fn bounds_of(&self, vertices: impl IntoIterator<Item = VertexId>) -> Bounds3 {
        Bounds3::from_points(vertices.into_iter().map(|vertex| self.point(vertex)))
    }

    /// The box around all vertices.
    #[must_use]
    pub fn bounds(&self) -> Bounds3 {
        self.bounds_of(self.vertices())
    }

    /// Whether the faces bound a volume without a gap: there are faces, and every edge that has
    /// any belongs to exactly two that run along it in opposite directions.
    #[must_use]
    pub fn is_watertight(&self) -> bool {
        let is_tight = |edge| matches!(self.edge_join(edge), EdgeJoin::Closed | EdgeJoin::Loose);
        self.face_count() > 0 && self.edges().all(is_tight)
    }

    /// The volume inside the faces in cubic metres, by the divergence theorem over the fans of
    /// their triangles. Negative if the faces look inwards. Without meaning unless the mesh
    /// [is watertight](Self::is_watertight).
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.moments().0
    }

    /// The centre of mass of what is inside the faces, filled evenly. `None` unless the mesh is
    /// watertight and its volume is not zero.
    #[must_use]
    pub fn center_of_mass(&self) -> Option<DVec3> {
        let (volume, moment) = self.moments();
        let center = self.origin() + moment / volume;
        (center.is_finite() && self.is_watertight()).then_some(center)
    }

    /// A place among the vertices, so that a mesh far from the origin loses nothing.
    fn origin(&self) -> DVec3 {
        self.vertices().next().map_or(DVec3::ZERO, |vertex| self.point(vertex))
    }

    /// The volume, and the integral of the place relative to the origin over it.
    fn moments(&self) -> (f64, DVec3) {
        let origin = self.origin();
        let (mut volume, mut moment) = (0.0, DVec3::ZERO);
        for face in self.faces() {
            let mut positions = self.face_vertices(face).map(|vertex| self.point(vertex) - origin);
            let (Some(first), Some(mut last)) = (positions.next(), positions.next()) else { continue };
            for position in positions {
                // The tetrahedron of the origin and a triangle of the face's fan. Its centre is a quarter of
                // the sum of its corners.
                let part = first.dot(last.cross(position)) / 6.0;
                volume += part;
                moment += (first + last + position) * (part / 4.0);
                last = position;
            }
        }
        (volume, moment)
    }
}

#[cfg(test)]
mod tests {
    use trigon_mesh::primitives;

    use super::*;
    use crate::Transform;

    #[test]
    fn a_solid_has_its_volume_and_its_center_where_it_is_put() {
        let offset = DVec3::new(100.0, -50.0, 25.0);
        for solid in
            [primitives::cube(2.0), primitives::torus(2.0, 0.5, 16, 8), primitives::dodecahedron(1.0)]
        {
            let (mut mesh, _) = EditMesh::from_mesh(&solid);
            let vertices: Vec<VertexId> = mesh.vertices().collect();
            mesh.transform_vertices(&vertices, &Transform::Translate { offset }, None).expect("possible");
            let expected = solid.volume();
            // Places are rounded to f32 a hundred metres away.
            assert!((mesh.volume() - expected).abs() < 1e-4 * expected, "{} for {expected}", mesh.volume());
            let center = mesh.center_of_mass().expect("it is closed");
            assert!(center.abs_diff_eq(offset, 1e-4), "{center}");
            assert!((mesh.bounds().size() - solid.bounds().size()).abs().max_element() < 1e-4, "dimensions");
        }
        let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        assert!(cube.is_watertight(), "a cube is");
        let face = cube.faces().next().expect("six");
        cube.flip_face(face).expect("it exists");
        assert!(!cube.is_watertight() && cube.center_of_mass().is_none(), "one face looks inwards");
    }

    #[test]
    fn a_pyramids_center_is_a_quarter_up() {
        let (pyramid, _) = EditMesh::from_mesh(&primitives::pyramid(2.0, 4.0));
        let low = pyramid.bounds().center().expect("not empty").y - 2.0;
        let center = pyramid.center_of_mass().expect("it is closed");
        assert!((center.y - low - 1.0).abs() < 1e-12, "{center}");
        assert!((pyramid.volume() - 16.0 / 3.0).abs() < 1e-12, "a third of base times height");
    }
}

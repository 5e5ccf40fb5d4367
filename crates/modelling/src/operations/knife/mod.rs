//! The knife: cuts faces along a path.

mod divide;
mod line;
mod path;

use std::collections::BTreeMap;

use super::delete::require;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, NONE, VertexId};
use crate::refusal::Refusal;
use divide::Inside;
pub use line::ProjectedLine;
use path::Stretch;
use trigon_math::Vec3;

const OPERATION: &str = "a knife cut";

/// A point of the path of [`EditMesh::knife`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum KnifePoint {
    /// At a vertex.
    Vertex(VertexId),
    /// On an edge, at a part of the way from its first vertex to its second: 0 to 1.
    Edge(EdgeId, f64),
    /// Within a face, near this place: it is moved along the face's normal onto the face.
    Face(FaceId, Vec3),
}

/// What [`EditMesh::knife`] made.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct KnifeCut {
    /// The edges of the cut, in the order of the path; those that were there already, too.
    pub edges: Vec<EdgeId>,
    /// The vertex of each point of the path.
    pub vertices: Vec<VertexId>,
    /// The new faces. Cut faces keep their ids for one of their parts.
    pub faces: Vec<FaceId>,
}

impl EditMesh {
    /// Cuts faces along a path of points on edges, at vertices and within faces. Edges are
    /// split where the path crosses them, faces where it goes through them.
    ///
    /// Consecutive points belong to the same face. If several faces have both, the one with the lowest index
    /// is cut; between two points of the same edge nothing is cut. The path begins and ends at vertices or on
    /// edges, does not cross itself within a face, and has no two stretches with the same ends within one.
    /// Lines are not checked for leaving a concave face. Values are interpolated: on edges along them, within
    /// faces by mean value coordinates (Floater, "Mean value coordinates", 2003), which are exact for values
    /// that are affine in position.
    ///
    /// Unlike in Blender's tool, the points are given; [`EditMesh::knife_line`] determines where a line that is seen from a
    /// camera meets edges.
    ///
    /// # Errors
    /// There are fewer than two points; an element does not exist; a position on an edge is not
    /// within 0…1; the conditions above are violated.
    pub fn knife(&mut self, path: &[KnifePoint]) -> Result<KnifeCut, Refusal> {
        require(path, OPERATION, "a path of at least two points")?;
        path.iter().try_for_each(|point| self.check_knife_point(point))?;
        let stretches = self.knife_stretches(path)?;
        self.whole(|mesh| {
            let mut cut = KnifeCut { vertices: mesh.knife_vertices(path)?, ..KnifeCut::default() };
            let inside = mesh.knife_insides(path, &mut cut.vertices)?;
            // Into which faces each cut face was divided, besides itself.
            let mut parts: BTreeMap<FaceId, Vec<FaceId>> = BTreeMap::new();
            for stretch in &stretches {
                let inside = &inside[stretch.from + 1..stretch.to];
                mesh.cut_stretch(stretch, inside, &mut parts, &mut cut)?;
            }
            cut.faces = parts.into_values().flatten().collect();
            cut.faces.sort_unstable();
            Ok(cut)
        })
    }

    /// Splits edges where points are on them. The vertex of each point; none yet within faces.
    fn knife_vertices(&mut self, path: &[KnifePoint]) -> Result<Vec<VertexId>, Refusal> {
        let mut vertices = vec![VertexId(NONE); path.len()];
        let mut on_edges: Vec<(EdgeId, f64, usize)> = Vec::new();
        for (i, point) in path.iter().enumerate() {
            match *point {
                KnifePoint::Vertex(vertex) => vertices[i] = vertex,
                KnifePoint::Edge(edge, 0.0) => vertices[i] = self.edge_vertices(edge)[0],
                KnifePoint::Edge(edge, 1.0) => vertices[i] = self.edge_vertices(edge)[1],
                KnifePoint::Edge(edge, t) => on_edges.push((edge, t, i)),
                KnifePoint::Face(..) => {}
            }
        }
        on_edges.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        for on_edge in on_edges.chunk_by(|a, b| a.0 == b.0) {
            let edge = on_edge[0].0;
            let mut parameters: Vec<f64> = on_edge.iter().map(|&(_, t, _)| t).collect();
            parameters.dedup();
            let made = self.cut_rung(edge, self.edge_vertices(edge)[0], &parameters)?;
            for &(_, t, i) in on_edge {
                vertices[i] = made[parameters.partition_point(|&parameter| parameter < t)];
            }
        }
        Ok(vertices)
    }

    /// Makes vertices of points within faces; for other points what they are is of no use.
    fn knife_insides(
        &mut self,
        path: &[KnifePoint],
        vertices: &mut [VertexId],
    ) -> Result<Vec<Inside>, Refusal> {
        let mut insides = Vec::with_capacity(path.len());
        for (point, vertex) in path.iter().zip(vertices) {
            let inside = match *point {
                KnifePoint::Face(face, position) => self.vertex_within(face, position)?,
                _ => Inside::at(*vertex),
            };
            *vertex = inside.vertex;
            insides.push(inside);
        }
        Ok(insides)
    }

    /// Cuts one face, if the path does not run along an edge.
    fn cut_stretch(
        &mut self,
        stretch: &Stretch,
        inside: &[Inside],
        parts: &mut BTreeMap<FaceId, Vec<FaceId>>,
        cut: &mut KnifeCut,
    ) -> Result<(), Refusal> {
        let chain = &cut.vertices[stretch.from..=stretch.to];
        let is_new = chain.len() > 2 || self.find_edge(chain[0], chain[1]).is_none();
        if let (Some(face), true) = (stretch.face, is_new) {
            let known = parts.entry(face).or_default();
            let (from, to) = self.corners_to_cut(face, known, chain[0], chain[chain.len() - 1])?;
            known.push(self.split_face_along(from, to, inside)?);
        }
        for pair in chain.windows(2) {
            cut.edges.extend(self.find_edge(pair[0], pair[1]));
        }
        Ok(())
    }

    /// The corners at two vertices in that part of a cut face that has both.
    fn corners_to_cut(
        &self,
        face: FaceId,
        parts: &[FaceId],
        a: VertexId,
        b: VertexId,
    ) -> Result<(CornerId, CornerId), Refusal> {
        let refused = |reason| Err(Refusal::NotPossible { operation: OPERATION, reason });
        let corners = |face: FaceId| Some((self.face_corner_at(face, a)?, self.face_corner_at(face, b)?));
        let mut found = [face].iter().chain(parts).filter_map(|&part| corners(part)).collect::<Vec<_>>();
        match (found.pop(), found.is_empty()) {
            (Some(_), _) if a == b => refused("the path returns to a vertex within one face"),
            (Some(pair), true) => Ok(pair),
            (Some(_), false) => refused("two cuts through a face have the same ends; cut in two steps"),
            (None, _) => refused("the path crosses itself within a face; cut in two steps"),
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_mesh::primitives;

    use super::*;
    use crate::tests::{keeps_affine_values, meshes, with_affine_values};

    fn edit(mesh: trigon_mesh::Mesh) -> EditMesh {
        EditMesh::from_mesh(&with_affine_values(mesh)).0
    }

    fn counts(mesh: &EditMesh) -> [usize; 3] {
        mesh.check_structure().expect("whole");
        [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()]
    }

    fn center(mesh: &EditMesh, face: FaceId) -> Vec3 {
        let sum: Vec3 = mesh.face_vertices(face).map(|vertex| mesh.position(vertex)).sum();
        sum / mesh.face_size(face) as f32
    }

    #[test]
    fn a_path_over_a_cube_cuts_the_faces_that_it_crosses() {
        let mut cube = edit(primitives::cube(2.0));
        let edges: Vec<EdgeId> = cube.face_edges(FaceId(0)).collect();
        let middle = KnifePoint::Face(FaceId(0), center(&cube, FaceId(0)));
        // From one side to its neighbour, with a corner in the middle of the face.
        let path = [KnifePoint::Edge(edges[0], 0.25), middle, KnifePoint::Edge(edges[1], 0.5)];
        let cut = cube.knife(&path).expect("one face");
        assert_eq!(
            (cut.edges.len(), cut.vertices.len(), cut.faces.len()),
            (2, 3, 1),
            "one cut with a corner"
        );
        assert_eq!(counts(&cube), [8 + 3, 12 + 2 + 2, 7], "genus 0");
        let position = center(&edit(primitives::cube(2.0)), FaceId(0));
        assert!(cube.position(cut.vertices[1]).abs_diff_eq(position, 1e-6), "as given, but for rounding");
        keeps_affine_values(&cube).expect("interpolated");
    }

    #[test]
    fn a_notch_at_an_edge_and_a_diagonal_are_cuts_too() {
        let mut cube = edit(primitives::cube(2.0));
        let corners: Vec<VertexId> = cube.face_vertices(FaceId(0)).collect();
        let diagonal = [KnifePoint::Vertex(corners[0]), KnifePoint::Vertex(corners[2])];
        cube.knife(&diagonal).expect("across a face");
        assert_eq!(counts(&cube), [8, 13, 7], "two triangles");
        let again = cube.knife(&diagonal).expect("along an edge");
        assert_eq!((again.faces.len(), again.edges.len()), (0, 1), "nothing is cut");

        let mut plane = edit(primitives::plane(2.0, 2.0));
        let corners: Vec<VertexId> = plane.face_vertices(FaceId(0)).collect();
        let inside = KnifePoint::Face(FaceId(0), Vec3::ZERO);
        let cut = plane.knife(&[KnifePoint::Vertex(corners[0]), inside, KnifePoint::Vertex(corners[1])]);
        let cut = cut.expect("a triangle at a side");
        assert_eq!(counts(&plane), [5, 6, 2], "a triangle and a hollow pentagon");
        let mut sizes = [plane.face_size(FaceId(0)), plane.face_size(cut.faces[0])];
        sizes.sort_unstable();
        assert_eq!(sizes, [3, 5], "with the point in both");
        keeps_affine_values(&plane).expect("interpolated");
    }

    #[test]
    fn a_path_that_is_none_is_refused_and_nothing_is_cut() {
        let mut mesh = edit(primitives::grid(2.0, 2.0, 2, 2));
        let before = mesh.clone();
        let edges: Vec<EdgeId> = mesh.face_edges(FaceId(0)).collect();
        let far: Vec<EdgeId> = mesh.face_edges(FaceId(3)).filter(|&edge| mesh.is_boundary(edge)).collect();
        let inside = KnifePoint::Face(FaceId(0), center(&mesh, FaceId(0)));
        let side = |i: usize| KnifePoint::Edge(edges[i], 0.5);
        let outside = KnifePoint::Face(FaceId(0), Vec3::splat(100.0));
        for (path, reason) in [
            (vec![side(0), inside], "begins and ends"),
            (vec![side(0), outside, side(1)], "on its border or outside"),
            (vec![side(0), KnifePoint::Edge(far[0], 0.5)], "no face in common"),
            (vec![side(0), side(2), KnifePoint::Edge(edges[2], 0.25), side(1), side(3)], "crosses itself"),
        ] {
            let refusal = mesh.knife(&path).expect_err(reason);
            assert!(refusal.to_string().contains(reason), "{refusal}");
        }
        let outside = mesh.knife(&[side(0), KnifePoint::Edge(edges[1], 2.0)]);
        assert!(matches!(outside, Err(Refusal::OutOfRange { .. })), "beyond the edge");
        assert!(mesh == before, "unchanged");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(400))]

        /// A walk from face to face across their edges, now and then through a point within.
        #[test]
        fn cuts_keep_structure_and_affine_values_and_can_be_undone(
            start in meshes(),
            face in any::<u32>(),
            steps in prop::collection::vec((any::<u32>(), 0.0f64..=1.0, any::<bool>()), 1..8),
        ) {
            let (mut mesh, _) = EditMesh::from_mesh(&start);
            let before = mesh.clone();
            let mut face = FaceId(face % mesh.face_capacity().max(1) as u32);
            prop_assume!(mesh.has_face(face));
            let mut path = Vec::new();
            for (choice, t, is_inside) in steps {
                let edges: Vec<EdgeId> = mesh.face_edges(face).collect();
                let edge = edges[choice as usize % edges.len()];
                if is_inside && !path.is_empty() {
                    path.push(KnifePoint::Face(face, center(&mesh, face)));
                }
                path.push(KnifePoint::Edge(edge, t));
                let faces: Vec<FaceId> = mesh.edge_faces(edge).collect();
                face = faces[choice as usize / 7 % faces.len()];
            }
            if let Ok((cut, mut difference)) = mesh.transaction(|mesh| mesh.knife(&path)) {
                prop_assert_eq!(mesh.check_structure(), Ok(()));
                prop_assert_eq!(cut.vertices.len(), path.len());
                prop_assert_eq!(mesh.face_count(), before.face_count() + cut.faces.len());
                prop_assert_eq!(keeps_affine_values(&mesh), Ok(()));
                difference.apply(&mut mesh);
            }
            prop_assert!(mesh == before, "undone, or refused");
        }
    }
}

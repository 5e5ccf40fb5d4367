//! Where a straight line that is seen from somewhere meets the edges of a surface, from face to face.

use trigon_math::DVec3;

use super::KnifePoint;
use super::through::Sight;
use crate::edit_mesh::EditMesh;
use crate::ids::FaceId;

/// A line in an image, as it lies over a surface.
pub trait ProjectedLine {
    /// On which side of the line a point is: linear in space, and 0 on it.
    fn side(&self, point: DVec3) -> f64;

    /// How far along the line a point is seen: greater further on; −∞ behind the eye.
    fn progress(&self, point: DVec3) -> f64;

    /// The lines of sight through its ends: where it begins, and where it ends.
    fn sights(&self) -> [Sight; 2];
}

/// A surface of that many faces across is cut in several lines.
const MOST_FACES: usize = 100_000;

impl EditMesh {
    /// The points at which a line from one point of the surface to another crosses edges, in their order and without the
    /// two: with them, a stroke for [`EditMesh::knife`]. `None` where the line leaves the surface, as at a border or
    /// where the surface turns away.
    #[must_use]
    pub fn knife_line(
        &self,
        [from, to]: [KnifePoint; 2],
        line: &impl ProjectedLine,
    ) -> Option<Vec<KnifePoint>> {
        let goal = self.faces_around(to);
        let (mut path, mut current) = (Vec::new(), from);
        let mut reached = line.progress(self.knife_position(from));
        let end = line.progress(self.knife_position(to));
        while path.len() < MOST_FACES {
            let faces = self.faces_around(current);
            if faces.iter().any(|face| goal.contains(face)) {
                return Some(path);
            }
            let exits = faces.iter().flat_map(|&face| self.crossings(face, line));
            let ahead = exits.filter_map(|point| {
                let progress = line.progress(self.knife_position(point));
                (progress > reached && progress <= end && !self.is_beside(point, current))
                    .then_some((progress, point))
            });
            (reached, current) = ahead.min_by(|a, b| a.0.total_cmp(&b.0))?;
            path.push(current);
        }
        None
    }

    /// Where a point of a path is.
    #[must_use]
    pub fn knife_position(&self, point: KnifePoint) -> DVec3 {
        match point {
            KnifePoint::Vertex(vertex) => self.point(vertex),
            KnifePoint::Edge(edge, share) => {
                let [a, b] = self.edge_vertices(edge).map(|vertex| self.point(vertex));
                a.lerp(b, share)
            }
            KnifePoint::Face(_, position) => position.as_dvec3(),
        }
    }

    fn faces_around(&self, point: KnifePoint) -> Vec<FaceId> {
        match point {
            KnifePoint::Vertex(vertex) => self.vertex_faces(vertex).collect(),
            KnifePoint::Edge(edge, _) => self.edge_faces(edge).collect(),
            KnifePoint::Face(face, _) => vec![face],
        }
    }

    /// Whether two points lie on one edge: between them nothing is cut.
    pub(super) fn is_beside(&self, a: KnifePoint, b: KnifePoint) -> bool {
        match (a, b) {
            (KnifePoint::Edge(a, _), KnifePoint::Edge(b, _)) => a == b,
            (KnifePoint::Vertex(vertex), KnifePoint::Edge(edge, _))
            | (KnifePoint::Edge(edge, _), KnifePoint::Vertex(vertex)) => {
                self.edge_vertices(edge).contains(&vertex)
            }
            (KnifePoint::Vertex(a), KnifePoint::Vertex(b)) => a == b,
            _ => false,
        }
    }

    /// Where the line meets the outline of a face: at vertices that are on it, and on edges between sides.
    pub(super) fn crossings(
        &self,
        face: FaceId,
        line: &impl ProjectedLine,
    ) -> impl Iterator<Item = KnifePoint> {
        self.face_edges(face).flat_map(|edge| {
            let [a, b] = self.edge_vertices(edge);
            let [from, to] = [a, b].map(|vertex| line.side(self.point(vertex)));
            let between = (from < 0.0) != (to < 0.0) && from != 0.0 && to != 0.0;
            let on_edge = between.then(|| KnifePoint::Edge(edge, (from / (from - to)).clamp(0.0, 1.0)));
            let at = |side: f64, vertex| (side == 0.0).then_some(KnifePoint::Vertex(vertex));
            [on_edge, at(from, a), at(to, b)].into_iter().flatten()
        })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::{Vec3, area_vector};
    use trigon_mesh::primitives;

    use super::*;

    /// Seen straight from above: through two points of the plane of x and z.
    struct FromAbove {
        from: DVec3,
        to: DVec3,
    }

    impl ProjectedLine for FromAbove {
        fn side(&self, point: DVec3) -> f64 {
            (self.to - self.from).cross(point - self.from).y
        }

        fn progress(&self, point: DVec3) -> f64 {
            (self.to - self.from).dot(point - self.from)
        }

        fn sights(&self) -> [Sight; 2] {
            [self.from, self.to].map(|origin| Sight { origin, direction: DVec3::NEG_Y })
        }
    }

    /// A sheet of 6 × 6 squares with sides of 1 m.
    fn sheet() -> EditMesh {
        EditMesh::from_mesh(&primitives::grid(6.0, 6.0, 6, 6)).0
    }

    /// The face around a point, and the point in it.
    fn within(mesh: &EditMesh, x: f32, z: f32) -> KnifePoint {
        let is_around = |face: &FaceId| {
            let corners: Vec<Vec3> = mesh.face_vertices(*face).map(|vertex| mesh.position(vertex)).collect();
            let low = corners.iter().copied().reduce(Vec3::min).expect("corners");
            let high = corners.iter().copied().reduce(Vec3::max).expect("corners");
            low.x <= x && x <= high.x && low.z <= z && z <= high.z
        };
        let face = mesh.faces().find(is_around).expect("it is on the sheet");
        KnifePoint::Face(face, Vec3::new(x, 0.0, z))
    }

    fn between(mesh: &EditMesh, ends: [KnifePoint; 2]) -> Option<Vec<KnifePoint>> {
        let [from, to] = ends.map(|point| mesh.knife_position(point));
        mesh.knife_line(ends, &FromAbove { from, to })
    }

    #[test]
    fn a_line_within_a_face_meets_nothing_and_one_beyond_the_border_is_none() {
        let mesh = sheet();
        let ends = [within(&mesh, 0.2, 0.3), within(&mesh, 0.8, 0.4)];
        assert_eq!(between(&mesh, ends), Some(Vec::new()));
        // Two sheets beside each other.
        let mut apart = sheet();
        let line: Vec<FaceId> = apart
            .faces()
            .filter(|&face| {
                apart.face_vertices(face).all(|vertex| (0.0..=1.0).contains(&apart.position(vertex).x))
            })
            .collect();
        apart.delete_faces(&line).expect("a row");
        let ends = [within(&apart, -1.5, 0.3), within(&apart, 1.5, 0.3)];
        assert_eq!(between(&apart, ends), None, "there is a gap");
    }

    #[test]
    fn a_line_along_vertices_passes_through_them() {
        let mesh = sheet();
        let ends = [within(&mesh, -2.5, -2.5), within(&mesh, 1.5, 1.5)];
        let path = between(&mesh, ends).expect("a diagonal");
        assert_eq!(path.len(), 4, "{path:?}");
        assert!(path.iter().all(|point| matches!(point, KnifePoint::Vertex(_))), "{path:?}");
    }

    proptest! {
        /// As many squares are crossed as lines of the grid lie between the ends, and the cut is straight.
        #[test]
        fn a_line_crosses_each_line_of_the_grid_between_its_ends(
            from in prop::array::uniform2(-2.95f32..2.95), to in prop::array::uniform2(-2.95f32..2.95)
        ) {
            let mut mesh = sheet();
            let ends = [within(&mesh, from[0], from[1]), within(&mesh, to[0], to[1])];
            let path = between(&mesh, ends).expect("all of the sheet is seen");
            let lines = |axis: usize| {
                let (low, high) = (from[axis].min(to[axis]), from[axis].max(to[axis]));
                (-3..=3).filter(|&line| low < line as f32 && (line as f32) < high).count()
            };
            prop_assert_eq!(path.len(), lines(0) + lines(1), "{:?}", path);
            prop_assume!(path.len() >= 2);
            let before = mesh.vertex_count();
            let cut = mesh.knife(std::slice::from_ref(&path)).map_err(|error| TestCaseError::fail(error.to_string()))?;
            mesh.check_structure().map_err(TestCaseError::fail)?;
            prop_assert_eq!(mesh.vertex_count() - before, path.len());
            let [from, to] = ends.map(|point| mesh.knife_position(point));
            let along = to - from;
            for vertex in cut.vertices.iter().flatten().copied() {
                let off = along.cross(mesh.point(vertex) - from).length() / along.length();
                prop_assert!(off < 1e-5, "{} beside the line", off);
            }
            let area: f64 = mesh
                .faces()
                .map(|face| area_vector(mesh.face_vertices(face).map(|vertex| mesh.point(vertex))).length())
                .sum();
            prop_assert!((area - 36.0).abs() < 1e-4, "{}", area);
        }
    }
}

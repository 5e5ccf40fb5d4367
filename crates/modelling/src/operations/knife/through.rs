//! Cuts through all faces between two lines of sight, also those that others hide.

use trigon_math::{AxisProjection, DVec2, DVec3, area_vector};

use super::net::contains;
use super::{KnifePoint, ProjectedLine};
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId};

/// A line of sight, in the space of a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sight {
    /// One of its points.
    pub origin: DVec3,
    /// Away from the eye, of any length.
    pub direction: DVec3,
}

/// A line of sight meets a vertex or an edge if it passes it at less than this share of the edge's length: then lines
/// that end on that line of sight meet there.
const SNAP: f64 = 1e-6;

/// A line over a surface, as it is cut into faces.
struct Through<'l, L> {
    line: &'l L,
    sights: [Sight; 2],
    /// How far along the line it begins and ends.
    range: [f64; 2],
    /// What counts as one of its ends.
    near: f64,
}

impl EditMesh {
    /// The cuts of a line through some faces, in front and behind, as far as it reaches: strokes for [`EditMesh::knife`].
    ///
    /// Lines that begin on a line of sight on which others end meet these in each face. Faces that are seen edge-on,
    /// or reach behind the eye, are left out.
    #[must_use]
    pub fn knife_through(&self, faces: &[FaceId], line: &impl ProjectedLine) -> Vec<Vec<KnifePoint>> {
        let sights = line.sights();
        let range = sights.map(|sight| line.progress(sight.origin + sight.direction));
        let through = Through { line, sights, range, near: SNAP * (range[1] - range[0]).abs() };
        let mut strokes = Vec::new();
        for &face in faces.iter().filter(|&&face| self.has_face(face)) {
            self.cut_through_face(face, &through, &mut strokes);
        }
        strokes
    }

    fn cut_through_face<L: ProjectedLine>(
        &self,
        face: FaceId,
        through: &Through<'_, L>,
        strokes: &mut Vec<Vec<KnifePoint>>,
    ) {
        let line = through.line;
        if self.face_vertices(face).all(|vertex| line.side(self.point(vertex)) == 0.0) {
            return;
        }
        let mut crossings: Vec<(f64, KnifePoint)> = self
            .crossings(face, line)
            .map(|point| (line.progress(self.knife_position(point)), point))
            .collect();
        crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
        crossings.dedup_by(|a, b| a.1 == b.1);
        for pair in crossings.windows(2) {
            let [(from, first), (to, second)] = [pair[0], pair[1]];
            let [begin, end] = through.range;
            let is_beyond = to <= begin + through.near || from >= end - through.near || !from.is_finite();
            if is_beyond || self.is_beside(first, second) || !self.is_over_face(face, [first, second]) {
                continue;
            }
            let first = match from > begin + through.near {
                true => Some(first),
                false => self.point_on_sight(face, through.sights[0]),
            };
            let second = match to < end - through.near {
                true => Some(second),
                false => self.point_on_sight(face, through.sights[1]),
            };
            strokes.extend(first.zip(second).map(|(first, second)| vec![first, second]));
        }
    }

    /// Whether the middle between two points of a face's outline is in the face.
    fn is_over_face(&self, face: FaceId, ends: [KnifePoint; 2]) -> bool {
        let outline: Vec<DVec3> = self.face_vertices(face).map(|vertex| self.point(vertex)).collect();
        let view = AxisProjection::against(area_vector(outline.iter().copied()));
        let flat: Vec<DVec2> = outline.into_iter().map(|position| view.project(position)).collect();
        let [a, b] = ends.map(|end| self.knife_position(end));
        contains(&flat, view.project((a + b) / 2.0))
    }

    /// Where a line of sight meets a face: the same for each line that ends on it.
    fn point_on_sight(&self, face: FaceId, sight: Sight) -> Option<KnifePoint> {
        let on_edge = self.face_edges(face).find_map(|edge| self.point_on_edge(edge, sight));
        if on_edge.is_some() {
            return on_edge;
        }
        let normal = self.face_area_vector(face);
        let sum: DVec3 = self.face_vertices(face).map(|vertex| self.point(vertex) - sight.origin).sum();
        let center = sum / self.face_size(face) as f64;
        let position = sight.origin + sight.direction * (center.dot(normal) / sight.direction.dot(normal));
        position.is_finite().then(|| KnifePoint::Face(face, position.as_vec3()))
    }

    fn point_on_edge(&self, edge: EdgeId, sight: Sight) -> Option<KnifePoint> {
        let ends = self.edge_vertices(edge);
        let [a, b] = ends.map(|vertex| self.point(vertex));
        let direction = sight.direction.normalize_or_zero();
        let across = |way: DVec3| way - direction * way.dot(direction);
        let (along, offset) = (across(b - a), across(a - sight.origin));
        let share = (-offset.dot(along) / along.length_squared()).clamp(0.0, 1.0);
        let near = SNAP * (b - a).length();
        if share.is_nan() || (offset + along * share).length() > near {
            return None;
        }
        Some(if share <= SNAP {
            KnifePoint::Vertex(ends[0])
        } else if share >= 1.0 - SNAP {
            KnifePoint::Vertex(ends[1])
        } else {
            KnifePoint::Edge(edge, share)
        })
    }
}

#[cfg(test)]
mod tests {
    use trigon_mesh::primitives;

    use super::*;
    use crate::{BisectSettings, VertexId};

    /// From an eye through two points.
    pub(super) struct FromEye {
        pub(super) eye: DVec3,
        pub(super) through: [DVec3; 2],
    }

    impl ProjectedLine for FromEye {
        fn side(&self, point: DVec3) -> f64 {
            let [a, b] = self.through.map(|point| point - self.eye);
            a.cross(b).dot(point - self.eye)
        }

        fn progress(&self, point: DVec3) -> f64 {
            // On the plane z = 1 in front of the eye, which looks along -z.
            let flat = |point: DVec3| (point - self.eye).truncate() / (self.eye.z - point.z);
            let [a, b] = self.through.map(flat);
            if point.z < self.eye.z { (flat(point) - a).dot(b - a) } else { f64::NEG_INFINITY }
        }

        fn sights(&self) -> [Sight; 2] {
            self.through.map(|point| Sight { origin: self.eye, direction: point - self.eye })
        }
    }

    fn cube() -> EditMesh {
        EditMesh::from_mesh(&primitives::cube(2.0)).0
    }

    fn area(mesh: &EditMesh) -> f64 {
        mesh.faces().map(|face| mesh.face_area_vector(face).length()).sum()
    }

    fn cut_through(mesh: &mut EditMesh, eye: DVec3, corners: &[DVec3]) -> super::super::KnifeCut {
        let faces: Vec<FaceId> = mesh.faces().collect();
        let strokes: Vec<Vec<KnifePoint>> = corners
            .windows(2)
            .flat_map(|pair| mesh.knife_through(&faces, &FromEye { eye, through: [pair[0], pair[1]] }))
            .collect();
        mesh.knife(&strokes).expect("it cuts")
    }

    #[test]
    fn a_line_all_over_a_cube_cuts_it_as_a_plane_does() {
        let eye = DVec3::new(0.1, 0.2, 5.0);
        let ends = [DVec3::new(-3.0, 0.3, 1.0), DVec3::new(3.0, -0.2, 1.0)];
        let mut cut = cube();
        let made = cut_through(&mut cut, eye, &ends);
        assert_eq!((made.edges.len(), made.faces.len(), made.uncut), (4, 4, 0), "front, back and two sides");
        let mut cut_by_plane = cube();
        let faces: Vec<FaceId> = cut_by_plane.faces().collect();
        let normal = (ends[0] - eye).cross(ends[1] - eye);
        cut_by_plane.bisect(&faces, eye, normal, &BisectSettings::default()).expect("it crosses");
        let positions = |mesh: &EditMesh| {
            let mut all: Vec<[i64; 3]> = mesh
                .vertices()
                .map(|vertex| mesh.point(vertex).to_array().map(|x| (x * 1e6).round() as i64))
                .collect();
            all.sort_unstable();
            all
        };
        assert_eq!(positions(&cut), positions(&cut_by_plane), "the same vertices, to a micrometre");
        assert_eq!((cut.edge_count(), cut.face_count()), (20, 10));
        assert_eq!(cut.check_structure(), Ok(()));
    }

    #[test]
    fn a_triangle_is_cut_out_in_front_and_behind() {
        let eye = DVec3::new(0.0, 0.0, 5.0);
        let corners =
            [[-0.4, -0.3, 1.0], [0.5, -0.2, 1.0], [0.1, 0.4, 1.0], [-0.4, -0.3, 1.0]].map(DVec3::from_array);
        let mut mesh = cube();
        let whole = area(&mesh);
        let made = cut_through(&mut mesh, eye, &corners);
        assert_eq!((made.edges.len(), made.faces.len(), made.uncut), (6, 4, 0), "a window and a ring, twice");
        assert_eq!([mesh.vertex_count(), mesh.edge_count(), mesh.face_count()], [14, 22, 10], "genus 0");
        assert!((area(&mesh) - whole).abs() < 1e-5, "of the same area");
        // Behind it is larger by the distances from the eye: 6 to 4.
        let outline = |z: f64| -> Vec<VertexId> {
            let made = made.vertices.iter().flatten().copied();
            let mut all: Vec<VertexId> = made.filter(|&vertex| mesh.point(vertex).z * z > 0.0).collect();
            all.sort_unstable();
            all.dedup();
            all
        };
        let area_of = |vertices: Vec<VertexId>| {
            area_vector(vertices.into_iter().map(|vertex| mesh.point(vertex))).length()
        };
        let ratio = area_of(outline(-1.0)) / area_of(outline(1.0));
        assert!((ratio - 2.25).abs() < 1e-5, "{ratio}");
    }

    #[test]
    fn a_line_that_ends_within_a_face_is_counted_in_front_and_behind() {
        let mut mesh = cube();
        let made = cut_through(
            &mut mesh,
            DVec3::new(0.0, 0.0, 5.0),
            &[DVec3::new(-0.5, 0.0, 1.0), DVec3::new(3.0, 0.1, 1.0)],
        );
        assert_eq!((made.edges.len(), made.uncut), (1, 2), "the side alone is cut all across");
    }
}

//! A straight path across several faces.

use trigon_math::{DVec3, area_vector};

use super::{CONNECTING, Connected};
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::refusal::Refusal;

/// So near to an end of an edge, as a share of its length, the path runs through the vertex.
const SNAP: f64 = 1e-6;

/// Where a path meets the sides of faces.
#[derive(Debug, Clone, Copy, PartialEq)]
enum PathPoint {
    Vertex(VertexId),
    /// On an edge, at a share of the way from its first end.
    Edge(EdgeId, f64),
}

/// The plane in which a path runs.
struct Plane {
    origin: DVec3,
    normal: DVec3,
    /// From the first vertex to the last.
    direction: DVec3,
}

impl EditMesh {
    pub(super) fn connect_by_path(
        &mut self,
        from: VertexId,
        to: VertexId,
        connected: &mut Connected,
    ) -> Result<(), Refusal> {
        let stops = self.find_path(from, to)?;
        let mut last = from;
        for stop in stops {
            let here = match stop {
                PathPoint::Vertex(vertex) => vertex,
                PathPoint::Edge(edge, t) => {
                    let split = self.split_edge(edge, t)?;
                    connected.vertices.push(split.vertex);
                    split.vertex
                }
            };
            self.join_across(last, here, connected)?;
            last = here;
        }
        Ok(())
    }

    /// Joins two vertices of the same face.
    fn join_across(&mut self, a: VertexId, b: VertexId, connected: &mut Connected) -> Result<(), Refusal> {
        if let Some(edge) = self.find_edge(a, b) {
            connected.edges.push(edge);
            return Ok(());
        }
        let pair = self.vertex_corners(a).find_map(|corner| {
            let other = self.face_corner_at(self.corner_face(corner), b)?;
            self.is_cut_inside(corner, other).then_some((corner, other))
        });
        let Some((from, to)) = pair else {
            let reason = "the straight path leaves a concave face: connect by shorter steps";
            return Err(Refusal::NotPossible { operation: CONNECTING, reason });
        };
        let split = self.split_face(from, to)?;
        connected.edges.push(split.edge);
        connected.faces.push(split.face);
        Ok(())
    }

    /// All stops after the first vertex, the last vertex included.
    fn find_path(&self, from: VertexId, to: VertexId) -> Result<Vec<PathPoint>, Refusal> {
        let refused = |reason| Err(Refusal::NotPossible { operation: CONNECTING, reason });
        let Some(plane) = self.path_plane(from, to) else {
            return refused("the two positions and their normals define no plane");
        };
        let (mut stops, mut here, mut came_through) = (Vec::new(), PathPoint::Vertex(from), None);
        // The path only goes forwards, so it ends; the bound is for places that are not finite.
        for _ in 0..=self.edge_count() {
            let faces: Vec<FaceId> = match here {
                PathPoint::Vertex(vertex) => self.vertex_faces(vertex).collect(),
                PathPoint::Edge(edge, _) => {
                    self.edge_faces(edge).filter(|&face| Some(face) != came_through).collect()
                }
            };
            if faces.iter().any(|&face| self.face_corner_at(face, to).is_some()) {
                stops.push(PathPoint::Vertex(to));
                return Ok(stops);
            }
            let reached = plane.progress(self.stop_point(here));
            let exits =
                faces.iter().flat_map(|&face| self.exits(face, here, &plane).map(move |exit| (face, exit)));
            let ahead = exits
                .map(|(face, stop)| (plane.progress(self.stop_point(stop)), face, stop))
                .filter(|&(progress, ..)| progress > reached && progress <= plane.direction.length_squared());
            let Some((_, face, stop)) = ahead.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))) else {
                return refused("the straight path between them runs into a border or off the surface");
            };
            stops.push(stop);
            (here, came_through) = (stop, Some(face));
        }
        refused("there is no straight path between them")
    }

    fn path_plane(&self, from: VertexId, to: VertexId) -> Option<Plane> {
        let (origin, target) = (self.point(from), self.point(to));
        let mut up = DVec3::ZERO;
        for vertex in [from, to] {
            for face in self.vertex_faces(vertex) {
                let normal = area_vector(self.face_vertices(face).map(|vertex| self.point(vertex)));
                up += normal.normalize_or_zero();
            }
        }
        let direction = target - origin;
        let normal = direction.try_normalize()?.cross(up).try_normalize()?;
        Some(Plane { origin, normal, direction })
    }

    fn stop_point(&self, stop: PathPoint) -> DVec3 {
        match stop {
            PathPoint::Vertex(vertex) => self.point(vertex),
            PathPoint::Edge(edge, t) => {
                let [a, b] = self.edge_vertices(edge).map(|vertex| self.point(vertex));
                a * (1.0 - t) + b * t
            }
        }
    }

    /// Where the plane meets the sides of a face that do not touch a stop.
    fn exits<'a>(
        &'a self,
        face: FaceId,
        here: PathPoint,
        plane: &'a Plane,
    ) -> impl Iterator<Item = PathPoint> + 'a {
        let touches = move |edge: EdgeId| match here {
            PathPoint::Vertex(vertex) => self.edge_vertices(edge).contains(&vertex),
            PathPoint::Edge(other, _) => edge == other,
        };
        self.face_corners(face).filter_map(move |corner: CornerId| {
            let edge = self.corner_edge(corner);
            if touches(edge) {
                return None;
            }
            let [a, b] = self.edge_vertices(edge);
            let [from, to] = [a, b].map(|vertex| plane.normal.dot(self.point(vertex) - plane.origin));
            let t = from / (from - to);
            // Not a number where the edge lies in the plane: its neighbours meet its ends.
            if !(-SNAP..=1.0 + SNAP).contains(&t) {
                return None;
            }
            Some(if t < SNAP {
                PathPoint::Vertex(a)
            } else if t > 1.0 - SNAP {
                PathPoint::Vertex(b)
            } else {
                PathPoint::Edge(edge, t)
            })
        })
    }
}

impl Plane {
    /// How far a place is on the way, in units that only compare.
    fn progress(&self, point: DVec3) -> f64 {
        (point - self.origin).dot(self.direction)
    }
}

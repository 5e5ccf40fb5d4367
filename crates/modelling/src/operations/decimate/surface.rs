//! The triangles that are reduced, as lists: what a collapse reads and writes lies close together.

use fixedbitset::FixedBitSet;
use trigon_math::DVec3;

use super::quadric::Quadric;
use super::wedges::Wedges;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, NONE, VertexId};
use crate::operations::region::Region;
use crate::records::{SEAM, SHARP};

/// How a vertex may move.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Freedom {
    /// Anywhere, and into any other vertex.
    Free,
    /// Along the two features that meet there.
    OnCurve,
    /// Not at all: features end or meet there, or other elements need the vertex.
    Fixed,
}

/// A triangle; sides go from each vertex to the next.
#[derive(Debug, Clone, Copy)]
pub(super) struct ReducedTriangle {
    pub(super) vertices: [u32; 3],
    /// For each side its index in the list of features; [`NONE`] for other sides.
    pub(super) features: [u32; 3],
    /// The index in the list of faces.
    pub(super) face: u32,
}

/// Marks of an edge that is a feature.
#[derive(Debug, Clone, Copy)]
pub(super) struct Marks {
    pub(super) flags: u32,
    pub(super) crease: f32,
}

/// A collapse, for the values of vertices and corners that follow it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Merge {
    pub(super) retained: u32,
    pub(super) gone: u32,
    /// From the retained one's value (0) to that of the other (1).
    pub(super) part: f64,
}

pub(super) struct Surface {
    pub(super) faces: Vec<FaceId>,
    /// The vertex of the mesh of each vertex here.
    pub(super) vertices: Vec<VertexId>,
    /// Subtracted from all positions.
    pub(super) origin: DVec3,
    pub(super) points: Vec<DVec3>,
    pub(super) freedoms: Vec<Freedom>,
    /// Vertices of faces and loose edges that are not reduced.
    pub(super) is_outside: FixedBitSet,
    pub(super) quadrics: Vec<Quadric>,
    /// How much of an error each vertex allows, 0 to 1; empty where all allow it wholly.
    pub(super) allowances: Vec<f64>,
    pub(super) triangles: Vec<ReducedTriangle>,
    pub(super) features: Vec<Marks>,
    /// Merged vertices, in order.
    pub(super) merges: Vec<Merge>,
    pub(super) values: Wedges,
    /// Whether some edges are features for their values alone.
    pub(super) has_value_borders: bool,
}

/// The weight of a plane along a feature, against that of a square of the feature's length.
const FEATURE: f64 = 10.0;

impl Surface {
    /// All faces of the region are triangles.
    pub(super) fn of(mesh: &EditMesh, region: &Region, holds_values: bool) -> Self {
        let vertices = region.vertices(mesh);
        let mut indices = vec![NONE; mesh.vertex_capacity()];
        for (index, vertex) in (0..).zip(&vertices) {
            indices[vertex.0 as usize] = index;
        }
        let center = mesh.bounds_of(vertices.iter().copied()).center().unwrap_or(DVec3::ZERO);
        let origin = if center.is_finite() { center.as_vec3().as_dvec3() } else { DVec3::ZERO };
        let corners = |face: FaceId| {
            let mut corners = mesh.face_corners(face);
            std::array::from_fn(|_| corners.next().expect("a triangle"))
        };
        let triangle = |(number, &face): (u32, &FaceId)| ReducedTriangle {
            vertices: corners(face).map(|corner: CornerId| indices[mesh.corner_vertex(corner).0 as usize]),
            features: [NONE; 3],
            face: number,
        };
        let mut surface = Self {
            triangles: (0..).zip(&region.faces).map(triangle).collect(),
            points: vertices.iter().map(|&vertex| mesh.point(vertex) - origin).collect(),
            freedoms: vec![Freedom::Free; vertices.len()],
            is_outside: FixedBitSet::with_capacity(vertices.len()),
            quadrics: vec![Quadric::default(); vertices.len()],
            allowances: Vec::new(),
            faces: region.faces.clone(),
            origin,
            features: Vec::new(),
            merges: Vec::new(),
            values: Wedges::default(),
            has_value_borders: false,
            vertices,
        };
        let features = surface.find_features(mesh, region, holds_values);
        surface.find_freedoms(mesh, region, &features);
        surface.add_planes();
        if holds_values {
            surface.values = Wedges::of(mesh, &mut surface);
        }
        surface
    }

    /// Marks the features' sides of triangles. For each vertex how many features end there, or more if it is not clear
    /// where they go on.
    fn find_features(&mut self, mesh: &EditMesh, region: &Region, holds_values: bool) -> Vec<u32> {
        let mut counts = vec![0; self.vertices.len()];
        let mut known = std::collections::BTreeMap::new();
        for index in 0..self.triangles.len() {
            let ReducedTriangle { face, vertices, .. } = self.triangles[index];
            let corners: [CornerId; 3] = self.corners(mesh, face);
            for (side, &corner) in corners.iter().enumerate() {
                let edge = mesh.corner_edge(corner);
                let Some(Feature { ends, of_values }) = feature(mesh, region, edge) else { continue };
                if of_values && !holds_values {
                    continue;
                }
                self.has_value_borders |= of_values;
                let number = *known.entry(edge).or_insert_with(|| {
                    counts[vertices[side] as usize] += ends;
                    counts[vertices[(side + 1) % 3] as usize] += ends;
                    let record = &mesh.edges[edge.0];
                    self.features.push(Marks { flags: record.flags & (SHARP | SEAM), crease: record.crease });
                    self.features.len() as u32 - 1
                });
                self.triangles[index].features[side] = number;
            }
        }
        counts
    }

    /// How much of an error an edge between two vertices allows.
    pub(super) fn allowance(&self, ends: [u32; 2]) -> f64 {
        let [a, b] = ends.map(|end| self.allowances.get(end as usize).copied().unwrap_or(1.0));
        if a < b { a } else { b }
    }

    /// The corners of a triangle that was not changed yet.
    pub(super) fn corners(&self, mesh: &EditMesh, face: u32) -> [CornerId; 3] {
        let mut corners = mesh.face_corners(self.faces[face as usize]);
        std::array::from_fn(|_| corners.next().expect("a triangle"))
    }

    fn find_freedoms(&mut self, mesh: &EditMesh, region: &Region, features: &[u32]) {
        for (index, &vertex) in self.vertices.iter().enumerate() {
            let is_within = |edge: EdgeId| {
                let mut faces = mesh.edge_faces(edge).peekable();
                faces.peek().is_some() && faces.all(|face| region.contains(face))
            };
            let is_outside = !mesh.vertex_edges(vertex).all(is_within);
            self.is_outside.set(index, is_outside);
            self.freedoms[index] = match features[index] {
                _ if is_outside || !self.points[index].is_finite() => Freedom::Fixed,
                0 => Freedom::Free,
                2 => Freedom::OnCurve,
                _ => Freedom::Fixed,
            };
        }
    }

    /// Gives each vertex the planes of its triangles, and those that stand upright on them along features.
    fn add_planes(&mut self) {
        for triangle in &self.triangles {
            let points = triangle.vertices.map(|vertex| self.points[vertex as usize]);
            let cross = (points[1] - points[0]).cross(points[2] - points[0]);
            let Some(normal) = cross.try_normalize() else { continue };
            let plane = Quadric::plane(points[0], normal, cross.length() / 2.0);
            triangle.vertices.iter().for_each(|&vertex| self.quadrics[vertex as usize] += plane);
            for side in (0..3).filter(|&side| triangle.features[side] != NONE) {
                let next = (side + 1) % 3;
                let along = points[next] - points[side];
                let Some(upright) = along.cross(normal).try_normalize() else { continue };
                let plane = Quadric::plane(points[side], upright, FEATURE * along.length_squared());
                self.quadrics[triangle.vertices[side] as usize] += plane;
                self.quadrics[triangle.vertices[next] as usize] += plane;
            }
        }
    }
}

/// An edge at which something ends.
struct Feature {
    /// For how many edges it counts at its ends: more than two mean that the ends stay.
    ends: u32,
    /// Whether only texture coordinates or colours end there.
    of_values: bool,
}

/// Whether an edge is a feature: the surface ends or branches there, or values or marks end.
fn feature(mesh: &EditMesh, region: &Region, edge: EdgeId) -> Option<Feature> {
    let of_shape = |ends| Some(Feature { ends, of_values: false });
    let mut sides = mesh.edge_corners(edge).filter(|&side| region.has_corner(mesh, side));
    let (Some(one), Some(two)) = (sides.next(), sides.next()) else { return of_shape(1) };
    if sides.next().is_some() || mesh.corner_vertex(one) == mesh.corner_vertex(two) {
        return of_shape(3);
    }
    let [a, b] = [one, two].map(|side| mesh.corner_face(side));
    let is_marked = mesh.is_sharp(edge) || mesh.is_seam(edge) || mesh.crease(edge) > 0.0;
    let is_border = mesh.material(a) != mesh.material(b) || mesh.is_smooth(a) != mesh.is_smooth(b);
    let is_cut = !mesh.has_same_values(one, mesh.next_corner(two))
        || !mesh.has_same_values(mesh.next_corner(one), two);
    (is_marked || is_border || is_cut).then_some(Feature { ends: 1, of_values: !is_marked && !is_border })
}

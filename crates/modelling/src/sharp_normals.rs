//! Normals of corners at sharp edges.
//!
//! A [`Mesh`](trigon_mesh::Mesh) blends normals over all smooth faces at a vertex. If an edge of the vertex is
//! sharp, the corners there get normals of their own, one for each fan of smooth faces between sharp edges.
//! All other corners keep the value zero, which stands for "computed".

use smallvec::SmallVec;
use trigon_math::{DVec3, Vec3, or_if_zero, unit_or_zero};

use super::edit_mesh::EditMesh;
use super::ids::{CornerId, EdgeId, VertexId};
use super::measure::FaceNormals;

impl EditMesh {
    /// By corner, the normals that sharp edges between smooth faces make; zero at all others.
    /// `None` where there is no such edge.
    ///
    /// A fan ends at sharp edges, and at edges that are not between exactly two smooth faces in
    /// opposite directions. Its normal is the mean of its faces' normals, weighted by angle, as
    /// that of a vertex.
    pub(super) fn sharp_normals(&self) -> Option<Vec<Vec3>> {
        let mut vertices: Vec<VertexId> = self
            .edges()
            .filter(|&edge| self.splits_fans(edge))
            .flat_map(|edge| self.edge_vertices(edge))
            .collect();
        if vertices.is_empty() {
            return None;
        }
        vertices.sort_unstable();
        vertices.dedup();
        let mut fans = VertexFans::new(self);
        let mut normals = vec![Vec3::ZERO; self.corner_capacity()];
        for vertex in vertices {
            fans.add(vertex, |corner, normal| normals[corner.0 as usize] = normal);
        }
        Some(normals)
    }

    /// The normals that [`EditMesh::to_mesh`] gives to all corners at some vertices, in time
    /// proportional to these and their neighbours.
    pub(super) fn normals_at(&self, vertices: &[VertexId]) -> Vec<(CornerId, Vec3)> {
        let mut fans = VertexFans::new(self);
        let mut normals = Vec::new();
        for &vertex in vertices {
            let first = normals.len();
            let given = |corner| (corner, self.custom_normal(corner).unwrap_or(Vec3::ZERO));
            normals.extend(self.vertex_corners(vertex).map(given));
            if !self.vertex_edges(vertex).any(|edge| self.splits_fans(edge)) {
                continue;
            }
            let own = &mut normals[first..];
            own.sort_unstable_by_key(|&(corner, _)| corner);
            fans.add(vertex, |corner, of_fan| {
                if let Ok(index) = own.binary_search_by_key(&corner, |&(corner, _)| corner) {
                    own[index].1 = or_if_zero(own[index].1, of_fan);
                }
            });
        }
        normals
    }

    /// The normals of all corners at some vertices: given ones, the means of fans of smooth faces between
    /// sharp edges, and of other faces their own.
    pub(super) fn fan_normals_at(&self, vertices: &[VertexId]) -> Vec<(CornerId, Vec3)> {
        let mut fans = VertexFans::new(self);
        let mut normals = Vec::new();
        for &vertex in vertices {
            let mut of_fans = SmallVec::<[(CornerId, Vec3); 8]>::new();
            fans.add(vertex, |corner, normal| of_fans.push((corner, normal)));
            normals.extend(self.vertex_corners(vertex).map(|corner| {
                // Fans are told in ascending order of corners.
                let of_fan = of_fans.binary_search_by_key(&corner, |&(corner, _)| corner);
                let of_fan = of_fan.ok().map(|index| of_fans[index].1);
                let own = || self.face_normal(self.corner_face(corner)).as_vec3();
                (corner, self.custom_normal(corner).or(of_fan).unwrap_or_else(own))
            }));
        }
        normals
    }

    /// Whether an edge is sharp between two smooth faces.
    fn splits_fans(&self, edge: EdgeId) -> bool {
        self.is_sharp(edge) && self.edge_faces(edge).filter(|&face| self.is_smooth(face)).nth(1).is_some()
    }

    /// The two corners at a vertex that an edge there joins into one fan.
    fn joined_corners(&self, vertex: VertexId, edge: EdgeId) -> Option<[CornerId; 2]> {
        let [one, two] = self.edge_pair(edge)?;
        let is_smooth = |corner| self.is_smooth(self.corner_face(corner));
        if self.is_sharp(edge) || !is_smooth(one) || !is_smooth(two) {
            return None;
        }
        // One leaves from here, the other arrives.
        match (self.corner_vertex(one) == vertex, self.corner_vertex(two) == vertex) {
            (true, false) => Some([one, self.next_corner(two)]),
            (false, true) => Some([self.next_corner(one), two]),
            _ => None,
        }
    }
}

struct VertexFans<'a> {
    mesh: &'a EditMesh,
    face_normals: FaceNormals,
    /// The corners at the vertex in ascending order, and which of them stands for each one's fan.
    corners: Vec<CornerId>,
    fans: Vec<u32>,
    sums: Vec<DVec3>,
}

impl<'a> VertexFans<'a> {
    fn new(mesh: &'a EditMesh) -> Self {
        Self {
            mesh,
            face_normals: FaceNormals::default(),
            corners: Vec::new(),
            fans: Vec::new(),
            sums: Vec::new(),
        }
    }

    /// Computes the normals of all smooth corners at a vertex.
    fn add(&mut self, vertex: VertexId, mut give: impl FnMut(CornerId, Vec3)) {
        let mesh = self.mesh;
        self.corners.clear();
        let smooth = |corner: &CornerId| mesh.is_smooth(mesh.corner_face(*corner));
        self.corners.extend(mesh.vertex_corners(vertex).filter(smooth));
        self.corners.sort_unstable();
        self.join(vertex);
        self.sums.clear();
        self.sums.resize(self.corners.len(), DVec3::ZERO);
        for index in 0..self.corners.len() {
            let corner = self.corners[index];
            let normal = self.face_normals.of(mesh, mesh.corner_face(corner)).as_vec3();
            let fan = self.fan(index as u32);
            self.sums[fan as usize] += normal.as_dvec3() * mesh.corner_angle(corner);
        }
        for index in 0..self.corners.len() {
            let fan = self.fan(index as u32);
            let corner = self.corners[index];
            let of_face = self.face_normals.of(mesh, mesh.corner_face(corner)).as_vec3();
            let of_fan = unit_or_zero(self.sums[fan as usize]).as_vec3();
            give(corner, or_if_zero(of_fan, of_face));
        }
    }

    /// Joins the fans of corners that blend over an edge.
    fn join(&mut self, vertex: VertexId) {
        self.fans.clear();
        self.fans.extend(0..self.corners.len() as u32);
        for edge in self.mesh.vertex_edges(vertex) {
            let Some(pair) = self.mesh.joined_corners(vertex, edge) else { continue };
            let indices: SmallVec<[u32; 2]> = pair
                .iter()
                .filter_map(|corner| self.corners.binary_search(corner).ok())
                .map(|i| i as u32)
                .collect();
            if let [a, b] = indices[..] {
                let (a, b) = (self.fan(a), self.fan(b));
                self.fans[a.max(b) as usize] = a.min(b);
            }
        }
    }

    /// What stands for the fan of a corner: the first of them.
    fn fan(&mut self, mut index: u32) -> u32 {
        while self.fans[index as usize] != index {
            // Halves the path for the next search.
            let above = self.fans[self.fans[index as usize] as usize];
            self.fans[index as usize] = above;
            index = above;
        }
        index
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use trigon_mesh::{Mesh, primitives};

    use super::*;
    use crate::ids::FaceId;

    fn smooth(mesh: &Mesh) -> EditMesh {
        let mut flat = mesh.clone();
        flat.set_attributes(trigon_mesh::Attributes::default()).expect("nothing has a length");
        let (mut mesh, _) = EditMesh::from_mesh(&flat);
        let faces: Vec<FaceId> = mesh.faces().collect();
        mesh.shade_smooth(&faces).expect("they exist");
        mesh
    }

    #[test]
    fn without_sharp_edges_no_normals_are_made() {
        let mut cube = smooth(&primitives::cube(2.0));
        assert_eq!(cube.to_mesh().0.attributes().corner_normals, None, "they are computed");
        let faces: Vec<FaceId> = cube.faces().collect();
        let edges: Vec<EdgeId> = cube.edges().collect();
        cube.mark_sharp(&edges).expect("they exist");
        cube.shade_flat(&faces).expect("they exist");
        assert_eq!(cube.to_mesh().0.attributes().corner_normals, None, "flat faces blend with none");
    }

    #[test]
    fn a_smooth_cube_with_sharp_edges_looks_flat() {
        let mut cube = smooth(&primitives::cube(2.0));
        let flat = cube.to_mesh().0;
        let edges: Vec<EdgeId> = cube.edges().collect();
        cube.mark_sharp(&edges).expect("they exist");
        let normals = cube.to_mesh().0.shading_normals();
        let face_normals = flat.face_normals();
        for (face, corners) in flat.faces().enumerate() {
            assert!(normals[corners].iter().all(|&normal| normal == face_normals[face]), "face {face}");
        }
    }

    #[test]
    fn a_single_sharp_edge_divides_nothing_but_two_that_meet_do() {
        // Around a cube's corner three faces meet: one edge does not part them.
        let mut cube = smooth(&primitives::cube(2.0));
        let edges: Vec<EdgeId> = cube.vertex_edges(VertexId(0)).collect();
        let before = cube.to_mesh().0.shading_normals();
        let distinct = |cube: &EditMesh| {
            let (mesh, map) = cube.to_mesh();
            let normals = mesh.shading_normals();
            let at = |(_, corner): &(&Vec3, &CornerId)| cube.corner_vertex(**corner) == VertexId(0);
            let mut found: Vec<[u32; 3]> = normals
                .iter()
                .zip(&map.corners)
                .filter(at)
                .map(|(n, _)| n.to_array().map(f32::to_bits))
                .collect();
            found.sort_unstable();
            found.dedup();
            found.len()
        };
        cube.mark_sharp(&edges[..1]).expect("it exists");
        for (normal, expected) in cube.to_mesh().0.shading_normals().iter().zip(&before) {
            // Sums in another order.
            assert!(normal.abs_diff_eq(*expected, 1e-6), "{normal} for {expected}");
        }
        cube.mark_sharp(&edges[..2]).expect("it exists");
        assert_eq!(distinct(&cube), 2, "one face on its own");
        cube.mark_sharp(&edges).expect("they exist");
        assert_eq!(distinct(&cube), 3, "each on its own");
    }

    /// Against the normals that a mesh breaks by angle.
    #[test]
    fn sharp_by_angle_looks_as_smooth_by_angle() {
        let solids = [
            primitives::cylinder(1.0, 2.0, 16),
            primitives::cone(1.0, 2.0, 9),
            primitives::uv_sphere(1.0, 12, 8),
            primitives::dodecahedron(1.0),
            primitives::grid(2.0, 1.0, 3, 3),
        ];
        for solid in solids {
            for angle in [0.1, 0.5, 1.0, 1.6, PI] {
                let mut expected = solid.clone();
                expected.smooth_by_angle(angle);
                let mut edited = smooth(&solid);
                let edges: Vec<EdgeId> = edited.edges().collect();
                edited.mark_sharp_by_angle(&edges, angle).expect("they exist");
                let (mesh, _) = edited.to_mesh();
                for (normal, expected) in mesh.shading_normals().iter().zip(expected.shading_normals()) {
                    // Both sums are rounded to f32 once, in orders of their own.
                    assert!(normal.abs_diff_eq(expected, 1e-6), "{normal} for {expected} at {angle}");
                }
            }
        }
    }

    #[test]
    fn lids_with_50_000_corners_do_not_make_marks_and_normals_slow() {
        let around = 50_000u32;
        let mut builder = trigon_mesh::MeshBuilder::new();
        for i in 0..2 * around {
            let turn = f64::from(i / 2) / f64::from(around) * 2.0 * PI;
            let (sin, cos) = trigon_math::elementary::sin_cos(turn);
            builder.push_vertex(DVec3::new(cos, f64::from(i % 2), -sin).as_vec3());
        }
        let rim = |lid: u32| (0..around).map(move |i| 2 * i + lid);
        builder.push_face(&rim(1).collect::<Vec<u32>>()).expect("a lid");
        builder.push_face(&rim(0).rev().collect::<Vec<u32>>()).expect("a lid");
        for i in 0..around {
            let next = (i + 1) % around;
            builder.push_face(&[2 * i, 2 * next, 2 * next + 1, 2 * i + 1]).expect("a wall");
        }
        let mut tube = builder.build();
        tube.smooth_by_angle(PI);
        let (mut tube, _) = EditMesh::from_mesh(&tube);
        let edges: Vec<EdgeId> = tube.edges().collect();
        // In quadratic time this would not end.
        assert_eq!(tube.mark_sharp_by_angle(&edges, 1.0), Ok(100_000), "both rims");
        let normals = tube.to_mesh().0.shading_normals();
        let upright = normals.iter().filter(|normal| normal.y.abs() == 1.0).count();
        assert_eq!(upright, 100_000, "the corners of the lids");
    }

    #[test]
    fn given_normals_stay_where_fans_would_make_others() {
        let mut start = primitives::cube(2.0);
        start.smooth_by_angle(PI);
        let (mut cube, _) = EditMesh::from_mesh(&start);
        let edges: Vec<EdgeId> = cube.vertex_edges(VertexId(0)).collect();
        cube.mark_sharp(&edges).expect("they exist");
        let given = cube.corners().filter(|&corner| cube.custom_normal(corner).is_some()).count();
        assert_eq!(given, 12, "the corners of four of eight vertices");
        let (mesh, map) = cube.to_mesh();
        let normals = mesh.attributes().corner_normals.as_ref().expect("there are some");
        for (&normal, &corner) in normals.iter().zip(&map.corners) {
            assert!(cube.custom_normal(corner).is_none_or(|given| given == normal), "{corner}");
        }
    }
}

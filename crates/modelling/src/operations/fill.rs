//! Filling: new faces and edges between existing elements (a modeller's F).

use trigon_math::{DVec3, elementary::atan2};

use super::delete::require;
use super::outlines::Chain;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::numbering::{Numbering, sorted_once};
use crate::refusal::Refusal;

/// The new elements.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Filled {
    /// The new faces.
    pub faces: Vec<FaceId>,
    /// The new edges.
    pub edges: Vec<EdgeId>,
    /// The new vertices, inside a grid.
    pub vertices: Vec<VertexId>,
}

const FILLING: &str = "filling";

impl EditMesh {
    /// Fills each loop of some edges with a face; a chain of two or more edges is first closed by a
    /// new edge.
    ///
    /// A face is wound like its neighbours: opposite to the adjacent faces at most of its edges. Without
    /// neighbours it faces the positive side of the axis along which its projection is largest. It has the
    /// material of the first neighbour, and its corners have the values of neighbours' corners.
    ///
    /// # Errors
    /// No edge is given, one does not exist, more than two meet in a vertex, one stands alone, or a
    /// face with the same vertices exists already.
    pub fn fill_edges(&mut self, edges: &[EdgeId]) -> Result<Filled, Refusal> {
        require(edges, FILLING, "at least two edges, or one loop")?;
        let chains = self.chains(edges, FILLING)?;
        self.check_capacity_for_each(edges.len())?;
        self.whole(|mesh| {
            let mut filled = Filled::default();
            for chain in chains {
                mesh.fill_chain(chain, &mut filled)?;
            }
            Ok(filled)
        })
    }

    /// Joins two vertices with an edge, or three or more with a face. If edges among them form a single chain
    /// or loop, this is the face's outline; otherwise the vertices are sorted by their direction from their
    /// mean position. Otherwise as [`Self::fill_edges`].
    ///
    /// # Errors
    /// There are fewer than two vertices, one does not exist, the edge or a face with the same vertices
    /// exists already, or no order can be determined because all positions are collinear.
    pub fn fill_vertices(&mut self, vertices: &[VertexId]) -> Result<Filled, Refusal> {
        require(vertices, FILLING, "at least two vertices")?;
        vertices.iter().try_for_each(|&vertex| self.check_vertex(vertex))?;
        let vertices = sorted_once(vertices.to_vec());
        let refused = |reason| Err(Refusal::NotPossible { operation: FILLING, reason });
        match vertices[..] {
            [_] => refused("at least two vertices are needed"),
            [a, b] if self.find_edge(a, b).is_some() => refused("there is an edge already"),
            [a, b] => Ok(Filled { edges: vec![self.add_edge(a, b)?], ..Filled::default() }),
            _ => {
                let chain = self.outline_of(&vertices)?;
                self.whole(|mesh| {
                    let mut filled = Filled::default();
                    mesh.fill_chain(chain, &mut filled).map(|()| filled)
                })
            }
        }
    }

    /// The outline of a face over three or more vertices, ascending.
    fn outline_of(&self, vertices: &[VertexId]) -> Result<Chain, Refusal> {
        let indices: Vec<u32> = vertices.iter().map(|vertex| vertex.0).collect();
        let numbering = Numbering::new(&indices, self.vertex_capacity());
        let is_given = |vertex: VertexId| numbering.get(vertex.0).is_some();
        let edges = vertices.iter().flat_map(|&vertex| self.vertex_edges(vertex));
        let edges: Vec<EdgeId> =
            edges.filter(|&edge| self.edge_vertices(edge).into_iter().all(is_given)).collect();
        match self.chains(&edges, FILLING).ok().as_deref() {
            Some([chain]) if chain.vertices.len() == vertices.len() => Ok(chain.clone()),
            _ => self.around_the_mean(vertices),
        }
    }

    fn around_the_mean(&self, vertices: &[VertexId]) -> Result<Chain, Refusal> {
        let mean = vertices.iter().map(|&vertex| self.point(vertex)).sum::<DVec3>() / vertices.len() as f64;
        let arm = |vertex: VertexId| self.point(vertex) - mean;
        let longest = |of: &dyn Fn(VertexId) -> DVec3| {
            vertices.iter().fold(DVec3::ZERO, |best, &vertex| {
                if of(vertex).length_squared() > best.length_squared() { of(vertex) } else { best }
            })
        };
        let first = longest(&arm);
        let normal = longest(&|vertex| first.cross(arm(vertex)));
        let (Some(right), Some(normal)) = (first.try_normalize(), normal.try_normalize()) else {
            let reason = "the vertices are in a line: select edges in their order";
            return Err(Refusal::NotPossible { operation: FILLING, reason });
        };
        let up = normal.cross(right);
        let angle = |vertex: VertexId| atan2(arm(vertex).dot(up), arm(vertex).dot(right));
        let mut order: Vec<(f64, VertexId)> = vertices.iter().map(|&v| (angle(v), v)).collect();
        order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        Ok(Chain { vertices: order.into_iter().map(|(_, vertex)| vertex).collect(), is_closed: true })
    }

    fn fill_chain(&mut self, mut chain: Chain, filled: &mut Filled) -> Result<(), Refusal> {
        let refused = |reason| Err(Refusal::NotPossible { operation: FILLING, reason });
        if chain.vertices.len() < 3 {
            return refused("a single edge has nothing to fill: select the others, too");
        }
        chain.is_closed = true;
        if self.is_wound_against(&chain) {
            chain.vertices.reverse();
        }
        let sources = self.corners_beside(&chain);
        let known: Vec<bool> = chain.steps().map(|(from, to)| self.find_edge(from, to).is_some()).collect();
        let face = self.add_first_face(&chain.vertices, FILLING)?;
        let corners: Vec<CornerId> = self.face_corners(face).collect();
        for ((&corner, source), is_known) in corners.iter().zip(&sources).zip(known) {
            if let Some(source) = *source {
                self.copy_corner(source, corner);
            }
            if !is_known {
                filled.edges.push(self.corner_edge(corner));
            }
        }
        if let Some(source) = sources.iter().flatten().next() {
            self.copy_face(self.corner_face(*source), face);
        }
        filled.faces.push(face);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::{Vec3, area_vector};
    use trigon_mesh::primitives;

    use super::*;
    use crate::tests::{check_operation, keeps_affine_values, meshes, with_affine_values};

    fn editable(mesh: trigon_mesh::Mesh) -> EditMesh {
        EditMesh::from_mesh(&with_affine_values(mesh)).0
    }

    fn counts(mesh: &EditMesh) -> [usize; 3] {
        mesh.check_structure().expect("whole");
        [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()]
    }

    fn points(positions: &[[f32; 3]]) -> (EditMesh, Vec<VertexId>) {
        let mut mesh = EditMesh::new();
        let v = positions
            .iter()
            .map(|&position| mesh.add_vertex(Vec3::from_array(position)).expect("room"))
            .collect();
        (mesh, v)
    }

    #[test]
    fn a_hole_in_a_cube_is_closed_as_it_was() {
        let cube = editable(primitives::cube(2.0));
        for face in cube.faces() {
            let mut mesh = cube.clone();
            let border: Vec<EdgeId> = mesh.face_edges(face).collect();
            let normal = |mesh: &EditMesh, face| {
                area_vector(mesh.face_vertices(face).map(|vertex| mesh.point(vertex)))
            };
            let before = normal(&mesh, face);
            mesh.remove_face(face).expect("it is there");
            let filled = mesh.fill_edges(&border).expect("a loop");
            assert_eq!(normal(&mesh, filled.faces[0]), before, "it faces outwards");
            assert_eq!((counts(&mesh), filled.edges.len()), ([8, 12, 6], 0), "a cube");
            keeps_affine_values(&mesh).expect("the values of its neighbours");
            let again = mesh.fill_edges(&border).expect_err("it is filled");
            assert!(matches!(again, Refusal::NotPossible { .. }), "{again}");
        }
    }

    #[test]
    fn both_ends_of_a_tube_are_filled_at_once() {
        let mut mesh = editable(primitives::cylinder(1.0, 2.0, 7));
        let ends: Vec<FaceId> = mesh.faces().filter(|&face| mesh.face_size(face) != 4).collect();
        mesh.delete_faces(&ends).expect("they are there");
        let border: Vec<EdgeId> = mesh.edges().filter(|&edge| mesh.is_boundary(edge)).collect();
        assert_eq!(mesh.fill_edges(&border).expect("two loops").faces.len(), 2, "an n-gon each");
        assert!(mesh.edges().all(|edge| mesh.edge_pair(edge).is_some()), "closed");
        counts(&mesh);
    }

    #[test]
    fn vertices_become_an_edge_a_triangle_a_quad_and_a_polygon() {
        let positions = [[0.0; 3], [2.0, 2.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [1.0, 3.0, 0.0]];
        let (mut mesh, v) = points(&positions);
        assert_eq!(mesh.fill_vertices(&v[..2]).expect("two").edges.len(), 1, "an edge");
        assert!(mesh.fill_vertices(&v[..2]).is_err(), "it is there");
        assert!(mesh.fill_vertices(&v[..1]).is_err(), "too few");
        for (count, area) in [(3, 2.0), (4, 4.0), (5, 5.0)] {
            let (mut mesh, v) = points(&positions);
            let filled = mesh.fill_vertices(&v[..count]).expect("a face");
            assert_eq!((filled.faces.len(), filled.edges.len()), (1, count), "{count} vertices");
            let normal = area_vector(mesh.face_vertices(FaceId(0)).map(|vertex| mesh.point(vertex)));
            assert_eq!(normal, DVec3::Z * area, "in order around the middle, towards +Z");
        }
    }

    #[test]
    fn a_chain_is_closed_and_filled() {
        let (mut mesh, v) = points(&[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
        let edges: Vec<EdgeId> =
            v.windows(2).map(|two| mesh.add_edge(two[0], two[1]).expect("two")).collect();
        let filled = mesh.fill_edges(&edges).expect("a chain");
        assert_eq!((counts(&mesh), filled.edges.len()), ([4, 4, 1], 1), "a quad");
    }

    #[test]
    fn what_cannot_be_filled_is_said() {
        let mut mesh = editable(primitives::cube(2.0));
        let before = mesh.clone();
        let all: Vec<EdgeId> = mesh.edges().collect();
        assert!(mesh.fill_edges(&all).is_err(), "three meet in each vertex");
        assert!(mesh.fill_edges(&all[..1]).is_err(), "a single edge");
        assert!(mesh.fill_edges(&[]).is_err(), "nothing");
        let (mut line, v) = points(&[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]]);
        assert!(line.fill_vertices(&v).expect_err("a line").to_string().contains("line"), "the reason");
        assert!(mesh == before, "nothing changed");
    }

    proptest! {
        #[test]
        fn filling_keeps_every_rule(start in meshes(), chosen in any::<u64>(), by_vertices: bool) {
            let (mesh, _) = EditMesh::from_mesh(&start);
            let is_chosen = |index: u32| chosen >> (index % 64) & 3 == 3;
            let vertices: Vec<VertexId> = mesh.vertices().filter(|vertex| is_chosen(vertex.0)).collect();
            let edges: Vec<EdgeId> = mesh.edges().filter(|edge| is_chosen(edge.0)).collect();
            let outcome = check_operation(&mesh, |mesh| match by_vertices {
                true => mesh.fill_vertices(&vertices),
                false => mesh.fill_edges(&edges),
            });
            if let Some((after, filled)) = outcome.map_err(TestCaseError::fail)? {
                prop_assert_eq!(after.face_count(), mesh.face_count() + filled.faces.len());
                prop_assert_eq!(after.edge_count(), mesh.edge_count() + filled.edges.len());
            }
        }
    }
}

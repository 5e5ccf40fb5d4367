//! Reversing a subdivision: each face that was cut into quads around its middle becomes one again.

use std::collections::{BTreeMap, BTreeSet};

use super::region::Region;
use super::tables::IndexTable;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, FaceId, VertexId};
use crate::refusal::Refusal;

/// What was left.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct UnSubdivided {
    /// The faces that are left of the given ones.
    pub faces: Vec<FaceId>,
    /// How many vertices were removed.
    pub removed: usize,
}

const OPERATION: &str = "reversing a subdivision";

/// What a vertex was before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Origin {
    Vertex,
    Edge,
    Face,
}

impl Origin {
    const ALL: [Self; 3] = [Self::Vertex, Self::Edge, Self::Face];

    /// Of the corners of a quad, from that of the old vertex on.
    fn of_corner(offset: usize) -> Self {
        match offset % 4 {
            0 => Self::Vertex,
            2 => Self::Face,
            _ => Self::Edge,
        }
    }
}

impl EditMesh {
    /// Reverses one subdivision of faces into quads: as [`Self::catmull_clark`] makes them, or [`Self::subdivide`] with one
    /// cut of quads. What is left keeps its position, so a surface that was smoothed stays as it is at those vertices.
    ///
    /// Each connected part has one vertex that was one before; where everything is regular and closed, as on a torus,
    /// several choices are possible, and the first vertex of the first face is one.
    ///
    /// # Errors
    /// No face is given, or one does not exist or is no quad; more than two meet at an edge, or the vertices have no such
    /// pattern; new vertices belong to other faces, too. Nothing is changed then.
    ///
    /// ```
    /// use trigon_mesh::primitives;
    /// use trigon_modelling::{EditMesh, FaceId};
    ///
    /// let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    /// cube.catmull_clark(2)?;
    /// let faces: Vec<FaceId> = cube.faces().collect();
    /// let made = cube.un_subdivide(&faces)?;
    /// assert_eq!((cube.face_count(), made.removed), (24, 72));
    /// # Ok::<(), trigon_modelling::Refusal>(())
    /// ```
    pub fn un_subdivide(&mut self, faces: &[FaceId]) -> Result<UnSubdivided, Refusal> {
        let region = Region::new(self, faces, OPERATION)?;
        if region.faces.iter().any(|&face| self.face_size(face) != 4) {
            return refused("a face is no quad");
        }
        let mut origins = IndexTable::new(self.vertex_capacity(), region.corner_count(self));
        for &seed in &region.faces {
            let first = self.face_vertices(seed).next().expect("a quad has four");
            if origins.get(first.0).is_none() {
                let found = (0..4).find_map(|offset| self.origins_from(&region, seed, offset));
                let Some(found) = found else {
                    return refused("no regular subdivision would give these faces");
                };
                found.into_iter().for_each(|(vertex, origin)| origins.insert(vertex.0, origin as u32));
            }
        }
        let vertices = region.vertices(self);
        let of = |wanted: Origin| -> Vec<VertexId> {
            vertices.iter().copied().filter(|vertex| origins.get(vertex.0) == Some(wanted as u32)).collect()
        };
        let [_, edges, middles] = Origin::ALL.map(of);
        self.whole(|mesh| {
            let left = mesh.dissolve_vertices(&middles)?.faces;
            edges.iter().try_for_each(|&vertex| mesh.join_edges(vertex).map(drop))?;
            Ok(UnSubdivided { faces: left, removed: middles.len() + edges.len() })
        })
    }

    /// What all vertices of a connected part were, if this corner of a face of it was a vertex. `None` if they have no such
    /// pattern.
    fn origins_from(
        &self,
        region: &Region,
        seed: FaceId,
        offset: usize,
    ) -> Option<BTreeMap<VertexId, Origin>> {
        // As large as the part, of which there may be many.
        let mut found = BTreeMap::new();
        let mut visited = BTreeSet::new();
        let first = self.face_corners(seed).nth(offset)?;
        let mut waiting = vec![first];
        while let Some(start) = waiting.pop() {
            if !visited.insert(self.corner_face(start)) {
                continue;
            }
            let mut corner = start;
            for step in 0..4 {
                let (vertex, origin) = (self.corner_vertex(corner), Origin::of_corner(step));
                if *found.entry(vertex).or_insert(origin) != origin {
                    return None;
                }
                if let Some(other) = self.start_across(region, corner, step)? {
                    waiting.push(other);
                }
                corner = self.next_corner(corner);
            }
        }
        let is_regular = found.iter().all(|(&vertex, &origin)| self.is_regular(region, vertex, origin));
        is_regular.then_some(found)
    }

    /// The corner of the old vertex in the quad across a side, which is that many steps after the corner of this one.
    /// `Some(None)` at a border, `None` if the sides there are no pair of neighbours.
    fn start_across(&self, region: &Region, corner: CornerId, step: usize) -> Option<Option<CornerId>> {
        let mut others = self
            .edge_corners(self.corner_edge(corner))
            .filter(|&other| other != corner && region.has_corner(self, other));
        let Some(other) = others.next() else { return Some(None) };
        if others.next().is_some() || self.corner_vertex(other) == self.corner_vertex(corner) {
            return None;
        }
        // The other quad runs along the side backwards: it begins where this one's side ends.
        let next = |corner| self.next_corner(corner);
        Some(Some(match step {
            // From the old vertex to that of an edge, or back.
            0 => next(other),
            3 => other,
            // From that of an edge to that of the face, or back: the old vertex is across from that of the face.
            1 => next(next(other)),
            _ => next(next(next(other))),
        }))
    }

    /// Whether a vertex has the edges that a subdivision gives it, and only faces of the region if it is a new one.
    fn is_regular(&self, region: &Region, vertex: VertexId, origin: Origin) -> bool {
        let sides = |edge| self.edge_faces(edge).filter(|&face| region.contains(face)).count();
        let is_open = self.vertex_edges(vertex).any(|edge| sides(edge) == 1);
        let is_within = self.vertex_faces(vertex).all(|face| region.contains(face))
            && self.vertex_edges(vertex).all(|edge| sides(edge) > 0);
        let edges = self.vertex_edges(vertex).count();
        match origin {
            Origin::Vertex => true,
            Origin::Edge => is_within && edges == if is_open { 3 } else { 4 },
            Origin::Face => is_within && !is_open && edges > 2,
        }
    }
}

fn refused<T>(reason: &'static str) -> Result<T, Refusal> {
    Err(Refusal::NotPossible { operation: OPERATION, reason })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_mesh::primitives;

    use super::*;
    use crate::EdgeId;
    use crate::tests::{check_operation, keeps_affine_values, meshes, with_affine_values};

    fn counts(mesh: &EditMesh) -> [usize; 3] {
        [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()]
    }

    fn all(mesh: &EditMesh) -> Vec<FaceId> {
        mesh.faces().collect()
    }

    #[test]
    fn a_subdivided_mesh_becomes_itself() {
        for mesh in [
            primitives::grid(2.0, 3.0, 3, 2),
            primitives::cube(2.0),
            primitives::torus(2.0, 0.5, 6, 5),
            primitives::cylinder(1.0, 2.0, 7),
            primitives::icosphere(1.0, 1),
        ] {
            let (before, _) = EditMesh::from_mesh(&mesh);
            let mut mesh = before.clone();
            mesh.catmull_clark(1).expect("possible");
            let faces = all(&mesh);
            let outcome = check_operation(&mesh, |mesh| mesh.un_subdivide(&faces));
            let (after, made) = outcome.expect("in order").expect("possible");
            assert_eq!(counts(&after), counts(&before));
            assert_eq!(made.faces.len(), before.face_count());
        }
    }

    #[test]
    fn a_divided_grid_is_as_it_was() {
        let (before, _) = EditMesh::from_mesh(&with_affine_values(primitives::grid(2.0, 3.0, 3, 2)));
        let mut mesh = before.clone();
        let edges: Vec<EdgeId> = mesh.edges().collect();
        mesh.subdivide(&edges, 1).expect("possible");
        mesh.un_subdivide(&all(&mesh)).expect("possible");
        assert_eq!(counts(&mesh), counts(&before));
        assert_eq!(mesh.bounds().size(), before.bounds().size());
        keeps_affine_values(&mesh).expect("values of the vertices that are left");
    }

    #[test]
    fn what_is_no_subdivision_is_refused_and_unchanged() {
        for mesh in [primitives::cube(2.0), primitives::grid(1.0, 1.0, 3, 3), primitives::icosphere(1.0, 1)] {
            let (mut mesh, _) = EditMesh::from_mesh(&mesh);
            let before = mesh.clone();
            assert!(mesh.un_subdivide(&all(&before)).is_err() && mesh.un_subdivide(&[]).is_err());
            assert!(mesh == before);
        }
    }

    proptest! {
        #[test]
        fn any_faces_stay_in_order(start in meshes(), bits in any::<u64>(), is_whole: bool) {
            let (mut mesh, _) = EditMesh::from_mesh(&start);
            prop_assume!(mesh.catmull_clark(1).is_ok());
            let faces: Vec<FaceId> =
                mesh.faces().filter(|face| is_whole || bits >> (face.0 % 64) & 1 != 0).collect();
            prop_assume!(!faces.is_empty());
            let outcome = check_operation(&mesh, |mesh| mesh.un_subdivide(&faces));
            if let Some((after, made)) = outcome.map_err(TestCaseError::fail)? {
                prop_assert_eq!(after.vertex_count() + made.removed, mesh.vertex_count());
            }
        }
    }
}

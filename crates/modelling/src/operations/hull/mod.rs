//! The convex hull of vertices.

mod build;
#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use self::build::hull_polygons;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::numbering::sorted_once;
use crate::refusal::Refusal;
use crate::slots::NewElements;

/// Parameters of [`EditMesh::convex_hull`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct HullSettings {
    /// Whether faces and edges among the vertices that are not the hull's go, and vertices that nothing uses then.
    pub replace: bool,
}

impl Default for HullSettings {
    /// The hull replaces what it is around.
    fn default() -> Self {
        Self { replace: true }
    }
}

/// What a hull consists of.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct ConvexHull {
    /// All its faces, looking outwards, also those that were there.
    pub faces: Vec<FaceId>,
    /// Given vertices that are not at a corner of it, and are left.
    pub inner: Vec<VertexId>,
    /// How many faces were removed.
    pub removed: usize,
}

const OPERATION: &str = "making a convex hull";

impl EditMesh {
    /// Makes the faces of the smallest convex solid around vertices. Which vertices are at its corners is exact, and so is
    /// which triangles lie in one plane and become one polygon; positions do not change.
    ///
    /// A face of the hull that is there already, looking outwards, stays. Others have the material, texture coordinates and
    /// colours of a face at their vertices, where there is one.
    ///
    /// # Errors
    /// No vertex is given, or one does not exist or is not finite; all are in one plane; there would be too many elements.
    ///
    /// ```
    /// use trigon_mesh::primitives;
    /// use trigon_modelling::{EditMesh, HullSettings, VertexId};
    ///
    /// let (mut torus, _) = EditMesh::from_mesh(&primitives::torus(2.0, 0.5, 12, 8));
    /// let vertices: Vec<VertexId> = torus.vertices().collect();
    /// torus.convex_hull(&vertices, &HullSettings::default())?;
    /// assert!(torus.is_watertight());
    /// assert_eq!(torus.vertex_count() + torus.face_count(), torus.edge_count() + 2, "without the hole");
    /// # Ok::<(), trigon_modelling::Refusal>(())
    /// ```
    pub fn convex_hull(
        &mut self,
        vertices: &[VertexId],
        settings: &HullSettings,
    ) -> Result<ConvexHull, Refusal> {
        self.check_vertices(vertices, OPERATION)?;
        let vertices = sorted_once(vertices.to_vec());
        let refused = |reason| Err(Refusal::NotPossible { operation: OPERATION, reason });
        let points: Vec<_> = vertices.iter().map(|&vertex| self.point(vertex)).collect();
        if points.iter().any(|point| !point.is_finite()) {
            return refused("the position of a vertex is not finite");
        }
        // A hull of triangles has twice as many of these as vertices.
        let count = vertices.len() as u64;
        self.check_capacity_for(NewElements {
            vertices: 0,
            edges: 3 * count,
            corners: 6 * count,
            faces: 2 * count,
        })?;
        let Some(polygons) = hull_polygons(&points) else {
            return refused("all vertices are in one plane: fill them with a face");
        };
        let polygons: Vec<Vec<VertexId>> = polygons
            .into_iter()
            .map(|polygon| polygon.into_iter().map(|index| vertices[index as usize]).collect())
            .collect();
        self.whole(|mesh| mesh.lay_hull(&vertices, &polygons, *settings))
    }

    fn lay_hull(
        &mut self,
        given: &[VertexId],
        polygons: &[Vec<VertexId>],
        settings: HullSettings,
    ) -> Result<ConvexHull, Refusal> {
        let sources = self.hull_sources(polygons);
        let mut hull = ConvexHull::default();
        let mut missing = Vec::new();
        for polygon in polygons {
            match self.face_over(polygon, |_| false) {
                Some(face) if self.follows(face, polygon) => hull.faces.push(face),
                // One that looks inwards would lie on the new one.
                Some(face) => {
                    self.remove_face(face)?;
                    hull.removed += 1;
                    missing.push(polygon);
                }
                None => missing.push(polygon),
            }
        }
        for polygon in missing {
            let face = self.face_of(polygon);
            self.dress_hull_face(face, &sources);
            hull.faces.push(face);
        }
        if settings.replace {
            hull.removed += self.remove_within(given, &hull.faces)?;
        }
        let at_corners: BTreeSet<VertexId> = polygons.iter().flatten().copied().collect();
        let is_inner = |vertex: &VertexId| !at_corners.contains(vertex) && self.has_vertex(*vertex);
        hull.inner = given.iter().copied().filter(is_inner).collect();
        Ok(hull)
    }

    /// For each vertex of the hull the values of a corner there, copied to new ones before faces go.
    fn hull_sources(&self, polygons: &[Vec<VertexId>]) -> BTreeMap<VertexId, CornerId> {
        let vertices: BTreeSet<VertexId> = polygons.iter().flatten().copied().collect();
        let source = |vertex: VertexId| Some((vertex, self.vertex_corners(vertex).next()?));
        vertices.into_iter().filter_map(source).collect()
    }

    fn dress_hull_face(&mut self, face: FaceId, sources: &BTreeMap<VertexId, CornerId>) {
        let corners: Vec<CornerId> = self.face_corners(face).collect();
        let mut first = true;
        for corner in corners {
            let source = sources.get(&self.corner_vertex(corner)).copied();
            // A face that looked inwards is gone.
            let Some(source) = source.filter(|&source| self.has_corner(source)) else { continue };
            self.copy_corner_upright(source, corner);
            if std::mem::take(&mut first) {
                self.copy_face(self.corner_face(source), face);
            }
        }
        self.reveal_outline(face);
    }

    /// Whether a face visits vertices in this direction.
    fn follows(&self, face: FaceId, polygon: &[VertexId]) -> bool {
        let corner = self.face_corner_at(face, polygon[0]);
        corner.is_some_and(|corner| self.corner_vertex(self.next_corner(corner)) == polygon[1])
    }

    /// Removes the faces and edges all of whose vertices are among some, but for some faces, and vertices that nothing uses
    /// then. How many faces there were.
    fn remove_within(&mut self, given: &[VertexId], stay: &[FaceId]) -> Result<usize, Refusal> {
        let is_given = |vertex: VertexId| given.binary_search(&vertex).is_ok();
        let stay: BTreeSet<FaceId> = stay.iter().copied().collect();
        let faces =
            sorted_once(given.iter().flat_map(|&vertex| self.vertex_faces(vertex)).collect::<Vec<FaceId>>());
        let mut removed = 0;
        for face in faces {
            if !stay.contains(&face) && self.face_vertices(face).all(is_given) {
                self.remove_face(face)?;
                removed += 1;
            }
        }
        let edges =
            sorted_once(given.iter().flat_map(|&vertex| self.vertex_edges(vertex)).collect::<Vec<EdgeId>>());
        for edge in edges {
            if self.edge_vertices(edge).into_iter().all(is_given) {
                self.remove_loose_edge(edge);
            }
        }
        for &vertex in given {
            self.remove_loose_vertex(vertex);
        }
        Ok(removed)
    }
}

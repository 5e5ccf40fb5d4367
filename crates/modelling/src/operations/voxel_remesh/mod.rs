//! Remeshing by voxels: the volume of a closed surface gets a new surface of quads of equal size.
//!
//! 1. `lines` finds where the lines of a lattice cross the triangles; `lattice` which of its points are inside.
//! 2. `dual` makes the quads between points inside and outside, with a vertex for each sheet of the surface in a cell
//!    (`cell`).
//! 3. The quads replace the faces and get their values.

mod cell;
mod dual;
mod lattice;
mod lines;
#[cfg(test)]
mod tests;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_math::{Bounds3, DAffine3, DVec3, DVec4};

use self::dual::{DualSurface, dual_surface};
use self::lattice::{InsidePoints, Lattice};
use self::lines::line_crossings;
use super::delete::require;
use super::surface_tree::{SurfacePoint, SurfaceTree};
use crate::edit_mesh::EditMesh;
use crate::ids::{FaceId, VertexId};
use crate::refusal::Refusal;
use crate::slots::NewElements;

/// Replaces the faces of whole meshes with quads of equal size: of the edited meshes, or of those of the selected objects.
/// Their surfaces have to be closed, and may cross themselves.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct VoxelRemeshSettings {
    /// The length of the sides of quads, in metres in the space of the mesh. What is thinner may be lost.
    #[schemars(range(min = 1e-6))]
    pub voxel_size: f64,
    /// Whether vertices are moved onto the nearest points of the old surface. Otherwise edges are a little blunt.
    pub project: bool,
}

impl Default for VoxelRemeshSettings {
    /// Ten centimetres, without moving vertices.
    fn default() -> Self {
        Self { voxel_size: 0.1, project: false }
    }
}

const OPERATION: &str = "remeshing by voxels";

impl EditMesh {
    /// Replaces all faces by quads around the same volume.
    ///
    /// What the surface winds around is inside, so parts that overlap become one, and what is turned inside out counts as
    /// well. The result is closed and manifold whatever the mesh is like: each edge has two faces, and the faces at each
    /// vertex are one cycle. Vertices are at most a voxel's diagonal from the old surface. Parts and gaps that are thinner
    /// than a voxel may be lost.
    ///
    /// Materials and shading are those of the nearest face, colours and values of vertices those of the nearest point.
    /// Texture coordinates are zero. Edges and vertices without faces go, too. An open surface is refused, because it has
    /// no inside: [`Self::solidify_faces`] gives it a thickness.
    ///
    /// # Errors
    /// There is no face; the surface is open, or faces beside each other look different ways; a position is not finite; the
    /// size is out of range, or no point is inside; there would be too many points or elements.
    ///
    /// ```
    /// use trigon_mesh::primitives;
    /// use trigon_modelling::{EditMesh, VoxelRemeshSettings};
    ///
    /// let (mut torus, _) = EditMesh::from_mesh(&primitives::torus(1.0, 0.3, 48, 24));
    /// torus.voxel_remesh(&VoxelRemeshSettings { voxel_size: 0.1, ..VoxelRemeshSettings::default() })?;
    /// assert!(torus.is_watertight() && torus.faces().all(|face| torus.face_size(face) == 4));
    /// assert_eq!(torus.vertex_count() + torus.face_count(), torus.edge_count(), "with a hole");
    /// # Ok::<(), trigon_modelling::Refusal>(())
    /// ```
    pub fn voxel_remesh(&mut self, settings: &VoxelRemeshSettings) -> Result<Vec<FaceId>, Refusal> {
        let faces: Vec<FaceId> = self.faces().collect();
        require(&faces, OPERATION, "a mesh with faces")?;
        let &VoxelRemeshSettings { voxel_size, .. } = settings;
        if !(voxel_size > 0.0 && voxel_size.is_finite()) {
            let parameter = "the size of voxels";
            return Err(Refusal::OutOfRange { parameter, value: voxel_size, range: "above 0" });
        }
        if self.vertices().any(|vertex| !self.position(vertex).is_finite()) {
            let reason = "the position of a vertex is not finite: repair the mesh first";
            return Err(Refusal::NotPossible { operation: OPERATION, reason });
        }
        self.edges().try_for_each(|edge| self.check_sides(edge, OPERATION))?;
        let tree = SurfaceTree::new(self, &DAffine3::IDENTITY);
        let surface = self.voxel_surface(&tree, voxel_size)?;
        let (vertices, quads) = (surface.positions.len() as u64, surface.quads.len() as u64);
        self.check_capacity_for(NewElements {
            vertices,
            edges: 2 * quads,
            corners: 4 * quads,
            faces: quads,
        })?;
        let like = VoxelSources::new(self, tree, settings);
        self.whole(|mesh| {
            let old: Vec<VertexId> = mesh.vertices().collect();
            let made = mesh.add_voxel_surface(&surface, &like);
            mesh.delete_vertices(&old)?;
            Ok(made)
        })
    }

    fn voxel_surface(&self, tree: &SurfaceTree, step: f64) -> Result<DualSurface, Refusal> {
        let triangles: Vec<[DVec3; 3]> = tree.triangles().collect();
        let lattice = Lattice::around(Bounds3::from_points(triangles.iter().flatten().copied()), step)?;
        let needed = (self.bytes() as u64).saturating_add(lattice.bytes());
        if needed > self.memory {
            return Err(Refusal::Memory { needed, allowed: self.memory });
        }
        let crossings = [0, 1, 2].map(|axis| line_crossings(&triangles, &lattice, axis));
        let inside = InsidePoints::new(lattice, &crossings[0])?;
        Ok(dual_surface(&lattice, &inside, &crossings))
    }

    fn add_voxel_surface(&mut self, surface: &DualSurface, like: &VoxelSources) -> Vec<FaceId> {
        let mut vertices = Vec::with_capacity(surface.positions.len());
        let mut nearest = Vec::new();
        for &position in &surface.positions {
            let point = like.of_vertex(position);
            let position = point.filter(|_| like.project).map_or(position, |point| point.position).as_vec3();
            let vertex = VertexId(self.new_vertex(position));
            if let Some(point) = point {
                let parts: Vec<(VertexId, f64)> =
                    point.parts().map(|(corner, weight)| (self.corner_vertex(corner), weight)).collect();
                self.blend_vertex(&parts, vertex);
                self.set_first_position(vertex, position);
            }
            vertices.push(vertex);
            nearest.push(point);
        }
        let mut made = Vec::with_capacity(surface.quads.len());
        for quad in &surface.quads {
            let face = self.face_of(&quad.map(|vertex| vertices[vertex as usize]));
            let middle = quad.iter().map(|&vertex| surface.positions[vertex as usize]).sum::<DVec3>() / 4.0;
            if let Some(source) = like.of_face(middle) {
                self.copy_face(source, face);
                self.set_face_hidden(face, false);
            }
            let corners: Vec<_> = self.face_corners(face).collect();
            for (corner, &vertex) in corners.into_iter().zip(quad) {
                if let Some(color) = nearest[vertex as usize].and_then(|point| self.color_at(&point)) {
                    self.set_color(corner, color.as_vec4());
                }
            }
            made.push(face);
        }
        made
    }

    /// The colour at a point of a surface; `None` where the mesh has no colours.
    pub(super) fn color_at(&self, point: &SurfacePoint) -> Option<DVec4> {
        point.parts().map(|(corner, weight)| Some(self.color(corner)?.as_dvec4() * weight)).sum()
    }
}

/// Where the values of a new surface come from.
struct VoxelSources {
    tree: SurfaceTree,
    project: bool,
    /// Whether vertices or corners have values besides positions.
    has_values: bool,
    /// The face that all are like, if they are.
    same: Option<FaceId>,
}

impl VoxelSources {
    fn new(mesh: &EditMesh, tree: SurfaceTree, settings: &VoxelRemeshSettings) -> Self {
        let first = mesh.faces().next();
        let values = |face: FaceId| (mesh.material(face), mesh.is_smooth(face));
        let same = first.filter(|&first| mesh.faces().all(|face| values(face) == values(first)));
        let has_colors = mesh.corners().next().is_some_and(|corner| mesh.color(corner).is_some());
        let has_values = has_colors || !mesh.vertex_layers.is_empty();
        Self { tree, project: settings.project, has_values, same }
    }

    /// The nearest point of the old surface, if anything needs it.
    fn of_vertex(&self, position: DVec3) -> Option<SurfacePoint> {
        if self.project || self.has_values { self.tree.nearest(position) } else { None }
    }

    fn of_face(&self, middle: DVec3) -> Option<FaceId> {
        self.same.or_else(|| self.tree.nearest(middle).map(|point| point.face))
    }
}

//! Render meshes: vertices with all their values, and triangles.
//!
//! A mesh stores values on corners; a renderer needs one value of everything per vertex, and as few
//! vertices as possible. So corners of a vertex whose values all agree, to the bit, are welded.

use trigon_math::{Vec2, Vec3, Vec4};

use crate::weld::{Welded, weld};
use crate::{FlatFaces, Mesh, MorphTarget, RenderLinks, SkinWeights, WeldedMesh};

/// A mesh as triangles over welded corners. All lists of vertex values have the same length, and so
/// have all lists of triangles.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RenderMesh {
    /// Metres.
    pub positions: Vec<Vec3>,
    /// Of unit length.
    pub normals: Vec<Vec3>,
    /// See [`Attributes::corner_tangents`](crate::Attributes::corner_tangents).
    pub tangents: Option<Vec<Vec4>>,
    /// One list per set of texture coordinates.
    pub uv_sets: Vec<Vec<Vec2>>,
    /// Linear light, straight alpha.
    pub colors: Option<Vec<Vec4>>,
    /// The joints that each vertex follows.
    pub skin: Option<SkinWeights>,
    /// Morph targets; see [`RenderMesh::deform`].
    pub morph_targets: Vec<MorphTarget>,
    /// Polygons whose normals [`RenderMesh::deform`] recomputes; none unless a pose can change the
    /// mesh.
    pub flat_faces: FlatFaces,
    /// Vertices, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// The polygon that each triangle is part of.
    pub triangle_faces: Vec<u32>,
    /// The material slot of each triangle; `None` if the mesh has no slots, which means slot 0.
    pub triangle_materials: Option<Vec<u32>>,
}

impl RenderMesh {
    /// Derives triangles and welded vertices from a mesh.
    ///
    /// Vertices are numbered in order of first use by the corners; corners that no triangle uses
    /// (of faces without area) still count. Vertices without faces are left out, as are loose edges
    /// and points. The normals are those of [`Mesh::shading_normals`].
    pub fn from_mesh(mesh: &Mesh) -> RenderMesh {
        let (normals, welded) = Self::welded_normals(mesh);
        Self::from_welded(mesh, normals, welded)
    }

    /// The same as [`RenderMesh::from_mesh`], with the data to follow changes of the mesh later; `None` if a pose can deform the
    /// mesh, which must be rebuilt after a change.
    pub fn with_links(mesh: &Mesh) -> (RenderMesh, Option<RenderLinks>) {
        let (normals, welded) = Self::welded_normals(mesh);
        let render_mesh = Self::from_welded(mesh, normals, welded.clone());
        let links = (!render_mesh.is_deformable()).then(|| RenderLinks::new(mesh, welded, false));
        (render_mesh, links)
    }

    /// The normals of the welded vertices. Those of the corners, which are many, are needed no longer.
    fn welded_normals(mesh: &Mesh) -> (Vec<Vec3>, Welded) {
        let (welded, normals) = weld(mesh, &mesh.shading_normals_or_given());
        (normals, welded)
    }

    /// `normals` are those of the welded vertices.
    fn from_welded(mesh: &Mesh, normals: Vec<Vec3>, welded: Welded) -> RenderMesh {
        let flat_faces = FlatFaces::of(mesh, welded.vertex_of_corner.as_slice());
        let welded = WeldedMesh::new(mesh, normals, welded);
        let attributes = mesh.attributes();
        let corners = &welded.corners;
        let vertex = |&corner: &u32| mesh.corner_vertices()[corner as usize];
        let position = |corner: &u32| mesh.positions()[vertex(corner) as usize];
        let morph = |target: &MorphTarget| MorphTarget {
            name: target.name.clone(),
            positions: target.positions.reordered(mesh.vertex_count(), corners.iter().map(vertex)),
            normals: target.normals.reordered(mesh.corner_count(), corners.iter().copied()),
            tangents: target.tangents.reordered(mesh.corner_count(), corners.iter().copied()),
        };
        RenderMesh {
            positions: corners.iter().map(position).collect(),
            tangents: attributes.corner_tangents.as_ref().map(|tangents| pick(tangents, corners)),
            uv_sets: attributes.uv_sets.iter().map(|set| pick(set, corners)).collect(),
            colors: attributes.corner_colors.as_ref().map(|c| pick(c, corners)),
            skin: attributes.skin.as_ref().map(|skin| skin.reordered(corners.iter().map(vertex))),
            morph_targets: attributes.morph_targets.iter().map(morph).collect(),
            flat_faces,
            normals: welded.normals,
            triangles: welded.triangles,
            triangle_faces: welded.triangle_faces,
            triangle_materials: welded.triangle_materials,
        }
    }
}

fn pick<T: Copy>(values: &[T], corners: &[u32]) -> Vec<T> {
    corners.iter().map(|&corner| values[corner as usize]).collect()
}

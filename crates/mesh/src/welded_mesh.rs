//! Welded meshes: triangles over welded corners, whose values stay in the mesh.

use trigon_math::Vec3;

use crate::weld::{OfCorners, Welded, weld};
use crate::{Mesh, RenderLinks, Triangulation};

/// The triangles of a mesh that no pose can deform, over welded corners as in a [`RenderMesh`](crate::RenderMesh). Values
/// are not copied: those of a vertex are the mesh's at its first corner.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct WeldedMesh {
    /// The first corner of each vertex.
    pub corners: Vec<u32>,
    /// Of each vertex, of unit length. None in a mesh of [`WeldedMesh::of_flat`].
    pub normals: Vec<Vec3>,
    /// Vertices, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// The polygon that each triangle is part of.
    pub triangle_faces: Vec<u32>,
    /// The material slot of each triangle; `None` if the mesh has no slots, which means slot 0.
    pub triangle_materials: Option<Vec<u32>>,
}

impl WeldedMesh {
    /// The triangles of a mesh over the vertices that [`RenderMesh::from_mesh`](crate::RenderMesh::from_mesh) has. `None` if
    /// a pose can deform the mesh: that needs the values of all vertices.
    pub fn of(mesh: &Mesh) -> Option<WeldedMesh> {
        if mesh.attributes().skin.is_some() || !mesh.attributes().morph_targets.is_empty() {
            return None;
        }
        let (welded, normals) = weld(mesh, &mesh.shading_normals_or_given());
        Some(Self::new(mesh, normals, welded))
    }

    /// The same for a mesh whose polygons are all flat, with the normal of each polygon instead of normals of
    /// vertices. Corners at one vertex are welded unless other values differ, where [`WeldedMesh::of`] needs
    /// a vertex for each corner. `None` if a corner has a normal of its own, a polygon is smooth, or a pose
    /// can deform the mesh.
    pub fn of_flat(mesh: &Mesh) -> Option<(WeldedMesh, Vec<Vec3>)> {
        let (normals, welded) = weld_flat(mesh)?;
        Some((Self::new(mesh, Vec::new(), welded), normals))
    }

    /// The same as [`WeldedMesh::of_flat`], with the data to follow changes of the mesh later.
    pub fn of_flat_with_links(mesh: &Mesh) -> Option<((WeldedMesh, Vec<Vec3>), RenderLinks)> {
        let (normals, welded) = weld_flat(mesh)?;
        let links = RenderLinks::new(mesh, welded.clone(), true);
        Some(((Self::new(mesh, Vec::new(), welded), normals), links))
    }

    /// `normals` are those of the welded vertices.
    pub(crate) fn new(mesh: &Mesh, normals: Vec<Vec3>, welded: Welded) -> WeldedMesh {
        let Welded { corner_of_vertex, vertex_of_corner } = welded;
        let (triangles, triangle_faces) = welded_triangles(mesh, vertex_of_corner);
        let slots_of = |slots: &[u32]| triangle_faces.iter().map(|&face| slots[face as usize]).collect();
        let slots = mesh.attributes().face_materials.as_deref().map(slots_of);
        let corners = corner_of_vertex;
        WeldedMesh { corners, normals, triangles, triangle_faces, triangle_materials: slots }
    }
}

/// The normals of the polygons of a flat mesh, whose corners are welded without normals; `None` if it is not flat.
fn weld_flat(mesh: &Mesh) -> Option<(Vec<Vec3>, Welded)> {
    // Welding takes one thread.
    let weld_all = || rayon::join(|| mesh.flat_normals(), || weld(mesh, &[]).0);
    mesh.is_flat().then(weld_all)
}

/// The triangles over welded vertices, and the faces that they come from.
fn welded_triangles(mesh: &Mesh, vertex_of_corner: OfCorners) -> (Vec<[u32; 3]>, Vec<u32>) {
    match vertex_of_corner {
        OfCorners::Triangles(triangles) => (triangles, (0..mesh.face_count() as u32).collect()),
        OfCorners::Polygons(vertices) => {
            let Triangulation { mut triangles, triangle_faces } = mesh.triangulation();
            for triangle in &mut triangles {
                *triangle = triangle.map(|corner| vertices[corner as usize]);
            }
            (triangles, triangle_faces)
        }
    }
}

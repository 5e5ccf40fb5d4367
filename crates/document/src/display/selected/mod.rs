//! The selected elements of an edited mesh by their numbers in the image.

use fixedbitset::FixedBitSet;
use trigon_mesh::Mesh;
use trigon_modelling::{EditMesh, ElementMap, ElementNumbers, FaceId};
use trigon_scene::MeshId;

use super::element::{bits, bits_where};
use crate::document::Document;
use crate::selection::{ElementKind, MeshSelection};

/// To find the elements around a selected vertex takes about as long as to test this many elements of the mesh.
const MANY: usize = 32;

/// An edited mesh and how it is shown.
pub(super) struct EditedMeshView<'d> {
    mesh: &'d EditMesh,
    pub(super) map: &'d ElementMap,
    pub(super) numbers: &'d ElementNumbers,
    /// The mesh that is shown, if it is all of the edited one and nothing else.
    whole: Option<&'d Mesh>,
}

impl<'d> EditedMeshView<'d> {
    /// `None` if it is not shown.
    pub(super) fn of(document: &'d Document, id: MeshId) -> Option<Self> {
        let (mesh, map) = (document.mesh(id)?, document.shown_elements(id)?);
        let numbers = document.shown_numbers(id)?;
        let whole = document.shown_whole(id);
        Some(Self { mesh, map, numbers, whole })
    }

    /// How many vertices, edges and faces it has in the image.
    pub(super) fn counts(&self) -> [usize; 3] {
        [self.map.vertices.len(), self.numbers.edge_count(), self.map.faces.len()]
    }

    /// The vertices, edges and faces that are selected, or follow from what is.
    pub(super) fn selected(&self, selected: &MeshSelection, kind: ElementKind) -> [FixedBitSet; 3] {
        match self.whole {
            Some(mesh) if kind == ElementKind::Vertex && self.are_many(selected) => {
                self.of_vertices(mesh, selected)
            }
            _ => self.of_any(selected, kind),
        }
    }

    /// Whether it is quicker to look at all elements than at those around the selected vertices.
    fn are_many(&self, selected: &MeshSelection) -> bool {
        selected.len() > self.map.vertices.len() / MANY
    }

    /// The same of a mesh that is shown as a whole: its own lists of vertices decide, which lie in memory one
    /// after the other. So most of a large mesh takes a few milliseconds.
    fn of_vertices(&self, mesh: &Mesh, selected: &MeshSelection) -> [FixedBitSet; 3] {
        let [of_vertices, of_edges, of_faces] = self.counts();
        let vertices = bits_where(of_vertices, |number| selected.contains(self.map.vertices[number].index()));
        let has = |&vertex: &u32| vertices.contains(vertex as usize);
        let ends = mesh.edges();
        let (edges, faces) = rayon::join(
            || bits_where(of_edges, |number| ends[number].iter().all(has)),
            || bits_where(of_faces, |number| mesh.face_vertices(number).iter().all(has)),
        );
        [vertices, edges, faces]
    }

    /// The same of any mesh and any kind.
    fn of_any(&self, selected: &MeshSelection, kind: ElementKind) -> [FixedBitSet; 3] {
        let Self { mesh, numbers, .. } = self;
        let [of_vertices, of_edges, of_faces] = self.counts();
        // Of many elements each kind takes milliseconds.
        let vertices = || {
            let vertices = selected.vertices(mesh, kind);
            bits(of_vertices, vertices.iter().filter_map(|&id| numbers.vertex(id)))
        };
        let edges = || {
            let edges = selected.edges(mesh, kind);
            bits(of_edges, edges.iter().filter_map(|&id| numbers.edge(id)))
        };
        let faces = || {
            let faces = selected.faces(mesh, kind).into_iter();
            bits(of_faces, faces.flat_map(|face| self.parts(face)))
        };
        let (edges, (vertices, faces)) = rayon::join(edges, || rayon::join(vertices, faces));
        [vertices, edges, faces]
    }

    /// The numbers of a face: that of a surface has several parts of it, one after the other.
    pub(super) fn parts(&self, face: FaceId) -> impl Iterator<Item = u32> + use<> {
        let faces = &self.map.faces;
        let first = self.numbers.face(face).map_or(faces.len(), |first| first as usize);
        let count = faces[first..].iter().take_while(|part| **part == face).count();
        (first..first + count).map(|number| number as u32)
    }
}

#[cfg(test)]
mod tests;

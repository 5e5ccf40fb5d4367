//! Faces that are swept with their outline: they close its ends.

use trigon_math::{DAffine3, DisjointSets};

use super::sweep::Sweep;
use super::{Spun, Turns};
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::numbering::sorted_once;
use crate::operations::copy::Elements;
use crate::operations::tables::{IndexSet, IndexTable};
use crate::slots::NewElements;

/// Faces all of whose edges are swept, without those of closed surfaces: these have no outline.
#[derive(Default)]
pub(super) struct SweptFaces {
    /// With their edges and vertices.
    all: Elements,
    /// Those that are a surface by themselves: they stay as the beginning.
    free: Vec<FaceId>,
    /// Those that are a part of a larger surface: they go, and what is swept begins at the hole.
    within: Vec<FaceId>,
    /// Edges and vertices that are not on an outline, and are not swept.
    inner_edges: Vec<EdgeId>,
    inner_vertices: Vec<VertexId>,
}

impl SweptFaces {
    pub(super) fn of(mesh: &EditMesh, edges: &[EdgeId]) -> Self {
        let mut is_given = IndexSet::new(mesh.edge_capacity(), edges.len());
        let edges: Vec<EdgeId> = edges.iter().copied().filter(|edge| is_given.insert(edge.0)).collect();
        let at_edges = sorted_once(edges.iter().flat_map(|&edge| mesh.edge_faces(edge)).collect());
        let is_whole = |&face: &FaceId| mesh.face_edges(face).all(|edge| is_given.contains(edge.0));
        let faces: Vec<FaceId> = at_edges.into_iter().filter(is_whole).collect();
        let mut numbers = IndexTable::new(mesh.face_capacity(), faces.len());
        (0..).zip(&faces).for_each(|(number, face)| numbers.insert(face.0, number));
        let at = |edge: EdgeId| mesh.edge_faces(edge).filter_map(|face| numbers.get(face.0));
        let mut patches = DisjointSets::new(faces.len());
        for &edge in &edges {
            let mut sides = at(edge);
            if let Some(first) = sides.next() {
                sides.for_each(|other| patches.join(first, other));
            }
        }
        let (mut has_outline, mut is_within) = (vec![false; faces.len()], vec![false; faces.len()]);
        for &edge in &edges {
            let mut sides = at(edge);
            if let (Some(only), None) = (sides.next(), sides.next()) {
                let patch = patches.root(only) as usize;
                has_outline[patch] = true;
                is_within[patch] |= !mesh.is_boundary(edge);
            }
        }
        let mut swept = Self::default();
        for (number, &face) in (0..).zip(&faces) {
            let patch = patches.root(number) as usize;
            if has_outline[patch] {
                if is_within[patch] { swept.within.push(face) } else { swept.free.push(face) }
            }
        }
        let all: Vec<FaceId> = swept.free.iter().chain(&swept.within).copied().collect();
        swept.all = Elements::with_parts(mesh, &[], &[], &all);
        swept.find_inner(mesh);
        swept
    }

    fn find_inner(&mut self, mesh: &EditMesh) {
        let is_swept = IndexSet::from_faces(mesh, &self.all.faces);
        let is_inner =
            |edge: EdgeId| mesh.edge_faces(edge).filter(|face| is_swept.contains(face.0)).count() > 1;
        self.inner_edges = self.all.edges.iter().copied().filter(|&edge| is_inner(edge)).collect();
        let is_inside = |&vertex: &VertexId| mesh.vertex_edges(vertex).all(is_inner);
        self.inner_vertices = self.all.vertices.iter().copied().filter(is_inside).collect();
    }

    /// What is left of given elements to be swept.
    pub(super) fn outlines(&self, edges: &[EdgeId], vertices: &[VertexId]) -> (Vec<EdgeId>, Vec<VertexId>) {
        let edges = edges.iter().copied().filter(|edge| self.inner_edges.binary_search(edge).is_err());
        let is_outside = |vertex: &VertexId| self.inner_vertices.binary_search(vertex).is_err();
        (edges.collect(), vertices.iter().copied().filter(is_outside).collect())
    }

    pub(super) fn is_empty(&self) -> bool {
        self.all.faces.is_empty()
    }

    pub(super) fn new_elements(&self, mesh: &EditMesh) -> NewElements {
        let Elements { vertices, edges, faces } = &self.all;
        let corners = faces.iter().map(|&face| mesh.face_size(face) as u64).sum();
        NewElements {
            vertices: vertices.len() as u64,
            edges: edges.len() as u64,
            corners,
            faces: faces.len() as u64,
        }
    }

    /// Takes out what does not stay at the beginning. Returns a copy of all faces for the end.
    pub(super) fn open(&self, mesh: &mut EditMesh, turns: &Turns) -> EditMesh {
        let copy = mesh.part(&self.all);
        let gone = self.within.iter().chain(self.free.iter().filter(|_| turns.is_joined));
        for &face in gone {
            mesh.remove_face(face).expect("it exists");
        }
        for &edge in &self.inner_edges {
            mesh.remove_loose_edge(edge);
        }
        for &vertex in &self.inner_vertices {
            mesh.remove_loose_vertex(vertex);
        }
        copy
    }

    /// Closes the ends of what was swept.
    pub(super) fn close(
        &self,
        mesh: &mut EditMesh,
        copy: &EditMesh,
        turns: &Turns,
        sweep: &Sweep,
        spun: &mut Spun,
    ) {
        let (rotation, way) = turns.after(turns.steps);
        let map = DAffine3::from_mat3_translation(rotation, turns.center - rotation * turns.center + way);
        let end = mesh.join_mesh(copy, &map).expect("there is room");
        let ring = |vertex: &VertexId| Some(spun.vertices[sweep.number(*vertex)?]);
        let copies = end.vertices.iter().zip(&self.all.vertices);
        let pairs: Vec<_> = copies.filter_map(|(&copied, vertex)| Some((copied, ring(vertex)?))).collect();
        mesh.merge_vertices(&pairs).expect("all exist, and each copy has one target");
        // Where the end touches the beginning, faces that would lie on others are gone.
        let is_left = |face: &FaceId| mesh.has_face(*face);
        spun.ends = end.faces.into_iter().filter(is_left).collect();
        spun.faces.retain(is_left);
        spun.edges.retain(|&edge| mesh.has_edge(edge));
        let free = self.free.iter().copied().filter(is_left);
        let shell: Vec<FaceId> = free.chain(spun.faces.iter().chain(&spun.ends).copied()).collect();
        if !self.free.is_empty() && !shell.is_empty() {
            mesh.recalculate_normals(&shell).expect("they exist");
        }
    }
}

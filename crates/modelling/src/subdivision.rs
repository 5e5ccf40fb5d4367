//! The subdivision surface of an editable mesh: how many levels of it are shown, and what a view shows. In
//! edit mode the mesh itself is shown over the surface, as its cage.

use trigon_mesh::{Attributes, Mesh, MeshColumns};

use super::edit_mesh::EditMesh;
use super::ids::{EdgeId, FaceId, NONE, VertexId};
use super::refusal::Refusal;
use super::to_mesh::ElementMap;

impl EditMesh {
    /// The most levels of a subdivision surface: a quad becomes 1,024 faces.
    pub const MOST_SUBDIVISION: u32 = 5;

    /// In how many Catmull-Clark levels the mesh is to be shown and exported; 0 as it is.
    #[must_use]
    pub fn subdivision(&self) -> u32 {
        self.subdivision
    }

    /// Sets in how many levels the mesh is to be shown. The mesh itself stays as it is.
    ///
    /// # Errors
    /// There are more than [`Self::MOST_SUBDIVISION`]; the surface would take more memory than is allowed.
    pub fn set_subdivision(&mut self, levels: u32) -> Result<(), Refusal> {
        if levels > Self::MOST_SUBDIVISION {
            let (parameter, range) = ("the number of levels", "0 to 5");
            return Err(Refusal::OutOfRange { parameter, value: f64::from(levels), range });
        }
        if levels > 0 {
            self.check_capacity_for_levels(levels)?;
        }
        self.subdivision = levels;
        Ok(())
    }

    /// Makes the mesh the surface that it is shown as; from then on it is shown as it is.
    ///
    /// # Errors
    /// It is shown as it is, it has no faces, or the surface would have more than 16,777,216 of them.
    pub fn apply_subdivision(&mut self) -> Result<(), Refusal> {
        let levels = self.subdivision;
        if levels == 0 {
            let reason = "the mesh has no subdivision surface: give it one first (Ctrl+1 to Ctrl+5)";
            return Err(Refusal::NotPossible { operation: "applying a subdivision", reason });
        }
        self.check_surface(levels)?;
        self.catmull_clark(levels)?;
        self.subdivision = 0;
        Ok(())
    }

    /// How many faces the surface has after so many levels.
    #[must_use]
    pub fn subdivided_face_count(&self, levels: u32) -> u64 {
        match levels {
            0 => self.face_count() as u64,
            // One quad for each corner, then four for each quad.
            _ => (self.corner_count() as u64).saturating_mul(4u64.saturating_pow(levels - 1)),
        }
    }

    /// The surface after so many levels, without a cage: what an object looks like. Of a mesh without faces
    /// the mesh itself.
    ///
    /// # Errors
    /// The surface would have more than 16,777,216 faces.
    pub fn to_subdivided_mesh(&self, levels: u32) -> Result<Mesh, Refusal> {
        let (surface, _) = self.surface(levels)?;
        Ok(surface.to_mesh().0)
    }

    /// The surface after so many levels with the mesh over it: its vertices follow those of the surface, and its
    /// edges are loose ones. What is hidden is left out.
    ///
    /// In the map vertices of the surface have no element of the mesh ([`Self::has_vertex`] is false for them);
    /// its faces are those of which they are parts, and parts of one face follow one another. There are no
    /// corners in it. The surface has no skin and no morph targets: while it is edited it is at rest.
    ///
    /// # Errors
    /// The surface would have more than 16,777,216 faces.
    pub fn to_mesh_with_cage(&self, levels: u32) -> Result<(Mesh, ElementMap), Refusal> {
        let (mut surface, wholes) = self.surface(levels)?;
        surface.vertex_layers.clear();
        let mut map = surface.shown_in_order(&wholes);
        let mut columns = surface.columns_of(&mut map);
        let attributes = Attributes { morph_targets: Vec::new(), ..surface.attributes(&map) };
        let faces = map.faces.iter().map(|part| FaceId(wholes[part.0 as usize])).collect();
        let mut vertices = vec![VertexId(NONE); map.vertices.len()];
        vertices.extend(self.vertices().filter(|&vertex| !self.is_vertex_hidden(vertex)));
        let is_shown = |&edge: &EdgeId| {
            let is_hidden = |vertex| self.is_vertex_hidden(vertex);
            !self.is_edge_hidden(edge) && !self.edge_vertices(edge).into_iter().any(is_hidden)
        };
        let loose_edges: Vec<EdgeId> = self.edges().filter(is_shown).collect();
        self.add_cage(&mut columns, &vertices[map.vertices.len()..], &loose_edges);
        let mut mesh = Mesh::from_valid_columns(columns);
        mesh.set_attributes(attributes).expect("no value is one of a vertex");
        Ok((mesh, ElementMap { vertices, faces, corners: Vec::new(), loose_edges }))
    }

    /// Whether the surface is one that memory has room for.
    fn check_surface(&self, levels: u32) -> Result<(), Refusal> {
        const MOST_FACES: u64 = 1 << 24;
        if levels > 0 && self.subdivided_face_count(levels) > MOST_FACES {
            let reason = "the surface would have more than 16,777,216 faces: take fewer levels";
            return Err(Refusal::NotPossible { operation: "subdividing", reason });
        }
        Ok(())
    }

    /// The surface, and for each of its faces that of the mesh of which it is a part.
    fn surface(&self, levels: u32) -> Result<(Self, Vec<u32>), Refusal> {
        let mut surface = self.clone();
        let mut wholes: Vec<u32> = (0..self.faces.len()).collect();
        if levels > 0 && self.face_count() > 0 {
            self.check_surface(levels)?;
            for _ in 0..levels {
                surface.note_parts(&mut wholes);
                surface.catmull_clark(1)?;
            }
        }
        Ok((surface, wholes))
    }

    /// The faces of the surface that are not hidden, parts of one face after one another.
    fn shown_in_order(&self, wholes: &[u32]) -> ElementMap {
        let is_shown = |vertex: VertexId| !self.is_vertex_hidden(vertex);
        let mut faces: Vec<FaceId> = self
            .faces()
            .filter(|&face| !self.is_face_hidden(face) && self.face_vertices(face).all(is_shown))
            .collect();
        faces.sort_by_key(|face| wholes[face.0 as usize]);
        ElementMap { vertices: self.vertices().collect(), faces, ..ElementMap::default() }
    }

    /// Adds vertices and edges of this mesh to those of a surface.
    fn add_cage(&self, surface: &mut MeshColumns, vertices: &[VertexId], edges: &[EdgeId]) {
        let first = surface.positions.len() as u32;
        let mut numbers = vec![NONE; self.vertex_capacity()];
        for (number, vertex) in (first..).zip(vertices) {
            numbers[vertex.0 as usize] = number;
        }
        let ends = |&edge: &EdgeId| self.edge_vertices(edge).map(|vertex| numbers[vertex.0 as usize]);
        surface.positions.extend(vertices.iter().map(|&vertex| self.position(vertex)));
        surface.loose_edges.extend(edges.iter().map(ends));
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_mesh::primitives;

    use super::*;
    use crate::tests::meshes;

    fn editable(mesh: &Mesh) -> EditMesh {
        EditMesh::from_mesh(mesh).0
    }

    #[test]
    fn a_cage_lies_over_the_surface_of_a_cube() {
        let cube = editable(&primitives::cube(2.0));
        let (mesh, map) = cube.to_mesh_with_cage(2).expect("it is small");
        assert_eq!(
            [mesh.face_count(), mesh.vertex_count()],
            [96, 98 + 8],
            "the surface, and the cage's vertices"
        );
        assert_eq!(mesh.loose_edges().len(), 12, "the edges of the cage");
        let cage: Vec<_> = map.vertices.iter().filter(|vertex| cube.has_vertex(**vertex)).collect();
        assert_eq!(cage.len(), 8, "vertices of the surface are none of the mesh");
        for (number, vertex) in
            map.vertices.iter().enumerate().filter(|(_, vertex)| cube.has_vertex(**vertex))
        {
            assert_eq!(mesh.positions()[number], cube.position(*vertex), "where it is edited");
        }
        assert_eq!(mesh.face_count() as u64, cube.subdivided_face_count(2));
    }

    #[test]
    fn a_surface_is_what_catmull_clark_makes_and_applying_it_keeps_it() {
        let mut cube = editable(&primitives::cube(2.0));
        cube.set_crease(EdgeId(3), 0.7);
        cube.set_subdivision(3).expect("three are few");
        let surface = cube.to_subdivided_mesh(3).expect("it is small");
        cube.apply_subdivision().expect("there is one");
        assert_eq!(cube.to_mesh().0, surface, "also at the crease");
        assert_eq!(cube.subdivision(), 0, "the mesh is its own surface now");
        assert!(cube.apply_subdivision().is_err(), "once");
    }

    #[test]
    fn levels_are_undone_and_surfaces_that_are_too_large_are_refused() {
        let mut grid = editable(&primitives::grid(1.0, 1.0, 200, 100));
        let before = grid.clone();
        let refusal = grid.set_subdivision(5).expect_err("20 million faces");
        assert!(refusal.to_string().contains("`memory`") && grid == before, "the setting: {refusal}");
        let levels = grid.transaction_within(u64::MAX, |grid| grid.set_subdivision(5));
        let (_, mut difference) = levels.expect("all memory is allowed");
        assert!(!difference.is_empty() && difference.changes_subdivision());
        let (was, refused) = (grid.clone(), grid.to_subdivided_mesh(5).expect_err("20 million faces"));
        assert!(refused.to_string().contains("fewer levels"), "{refused}");
        assert!(grid.apply_subdivision().is_err() && grid == was, "it stays as it was");
        difference.apply(&mut grid);
        assert_eq!(grid.subdivision(), 0, "undone");
        assert!(grid.set_subdivision(6).is_err(), "5 are the most");
    }

    proptest! {
        /// Materials follow faces through each level, so they tell of which face a part is.
        #[test]
        fn parts_are_told_of_which_face_they_are(start in meshes(), removed in any::<u32>(), levels in 1u32..3) {
            let mut mesh = editable(&start);
            let face = FaceId(removed % mesh.face_capacity().max(1) as u32);
            drop(mesh.remove_face(face));
            for face in mesh.faces().collect::<Vec<_>>() {
                mesh.set_material(face, face.0);
            }
            prop_assume!(mesh.face_count() > 0);
            let (shown, map) = mesh.to_mesh_with_cage(levels).expect("it is small");
            let none = vec![0; shown.face_count()];
            let materials = shown.attributes().face_materials.as_ref().unwrap_or(&none);
            let parts: Vec<u32> = map.faces.iter().map(|face| face.0).collect();
            prop_assert_eq!(&parts, materials);
            prop_assert!(parts.is_sorted(), "parts of one face follow one another");
        }
    }
}

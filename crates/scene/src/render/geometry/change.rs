//! Geometry that follows changes of its mesh instead of being made anew.
//!
//! Whatever it holds afterwards draws the bytes of geometry made from the changed mesh:
//! each triangle shows the same values. Only the numbers of vertices may differ. What is
//! made anew as a whole: tangents that were generated, when a normal map asks for them;
//! the geometry of a mesh that a pose can bend; and all of it when a polygon gets more or
//! fewer triangles than it had.

use std::ops::Range;
use std::sync::{Arc, OnceLock};

use rayon::prelude::*;
use trigon_mesh::{ChangedElements, Mesh, RenderMesh, RenderUpdate};
use trigon_raster::EdgeFlags;

use super::edge_flags::flags_of_face;
use super::side_edges::sides_of_triangle;
use super::{Geometry, GeometryChange, GeometryState, places_for};

impl Geometry {
    /// Geometry that can follow changes of its mesh.
    pub(crate) fn that_follows(mesh: &Mesh) -> Self {
        let (render_mesh, links) = RenderMesh::with_links(mesh);
        Self { links, ..Self::of(render_mesh) }
    }

    /// Whether it can follow changes of its mesh.
    pub(crate) fn can_follow(&self) -> bool {
        self.links.is_some()
    }

    /// The geometry of a mesh, from the one that it had before these elements were
    /// changed. That is copied if somebody else holds it.
    pub(crate) fn after_change(before: Arc<Self>, mesh: &Mesh, changed: &ChangedElements) -> Self {
        let state = before.state.clone();
        let mut geometry = Arc::try_unwrap(before).unwrap_or_else(|shared| shared.copied());
        match geometry.follow(mesh, changed) {
            Some((vertices, triangles)) => {
                geometry.change = Some(GeometryChange { before: state, vertices, triangles });
                geometry
            }
            None => Self::that_follows(mesh),
        }
    }

    /// All that follows changes.
    fn copied(&self) -> Self {
        Self { links: self.links.clone(), ..self.with_columns(self.columns.clone()) }
    }

    /// The vertices and triangles that are written. `None` if it cannot follow, and then it
    /// is of no more use.
    fn follow(&mut self, mesh: &Mesh, changed: &ChangedElements) -> Option<(Vec<u32>, Vec<u32>)> {
        let update = self.links.as_mut()?.follow(mesh, changed);
        self.state = GeometryState::default();
        self.bounds = OnceLock::new();
        self.tangential = places_for(&self.columns);
        self.columns.update(mesh, &update.vertices);
        let triangles = self.replace_triangles(mesh, &update)?;
        Some((update.vertices.iter().map(|updated| updated.vertex).collect(), triangles))
    }

    /// The triangles that are replaced, increasing.
    fn replace_triangles(&mut self, mesh: &Mesh, update: &RenderUpdate) -> Option<Vec<u32>> {
        let mut replaced = Vec::with_capacity(update.triangulation.triangles.len());
        let slots = mesh.attributes().face_materials.as_deref();
        let made_flags = self.edge_flags.get().map(|_| flags_of_update(mesh, update));
        let made_faces = update.triangulation.triangle_faces.as_slice();
        let mut first = 0;
        for &face in &update.faces {
            let count = made_faces[first..].iter().take_while(|&&of| of == face).count();
            let made = first..first + count;
            first = made.end;
            let slot = slots.map_or(0, |slots| slots[face as usize]);
            let place = self.place_of(face, slot, mesh.face_count());
            if place.len() != count {
                return None;
            }
            replaced.extend(place.clone().map(|triangle| triangle as u32));
            let vertex_of_corner = self.links.as_ref()?.vertex_of_corner();
            let triangles = &update.triangulation.triangles[made.clone()];
            for (own, &corners) in self.triangles[place.clone()].iter_mut().zip(triangles) {
                *own = corners.map(|corner| vertex_of_corner[corner as usize]);
            }
            if let Some(sides) = self.side_edges.get_mut() {
                let sides = &mut Arc::make_mut(sides)[place.clone()];
                for (sides, triangle) in sides.iter_mut().zip(triangles) {
                    *sides = sides_of_triangle(mesh, face, triangle);
                }
            }
            if let (Some(flags), Some(made_flags)) = (self.edge_flags.get_mut(), &made_flags) {
                flags[place].copy_from_slice(&made_flags[made]);
            }
        }
        // Out of order where faces of several slots change.
        replaced.sort_unstable();
        Some(replaced)
    }

    /// Where the triangles of a face of a slot lie; empty where it has none.
    fn place_of(&self, face: u32, slot: u32, face_count: usize) -> Range<usize> {
        let Ok(run) = self.runs.binary_search_by_key(&slot, |run| run.slot) else { return 0..0 };
        let start = self.runs[run].triangles.start;
        let faces = &self.faces[self.runs[run].triangles.clone()];
        // Right at once where all faces have equally many triangles and one slot.
        let guess = (u64::from(face) * faces.len() as u64 / face_count as u64) as usize;
        let begins = |at: usize| faces.get(at) == Some(&face) && (at == 0 || faces[at - 1] != face);
        let first = if begins(guess) { guess } else { faces.partition_point(|&other| other < face) };
        let count = faces[first..].iter().take_while(|&&other| other == face).count();
        start + first..start + first + count
    }
}

/// The flags of all triangles that are made anew.
fn flags_of_update(mesh: &Mesh, update: &RenderUpdate) -> Vec<EdgeFlags> {
    /// Faces that a thread takes at a time.
    const PIECE: usize = 1024;
    let triangles = update.triangulation.triangles.as_slice();
    let mut faces = Vec::with_capacity(update.faces.len());
    let mut first = 0;
    for face in update.triangulation.triangle_faces.chunk_by(|a, b| a == b) {
        faces.push((face[0], &triangles[first..first + face.len()]));
        first += face.len();
    }
    let flags_of = |faces: &[(u32, &[[u32; 3]])]| {
        let mut flags = Vec::new();
        faces.iter().for_each(|&face| flags_of_face(mesh, face, |part| flags.push(part)));
        flags
    };
    faces.par_chunks(PIECE).map(flags_of).collect::<Vec<_>>().concat()
}

#[cfg(test)]
mod tests;

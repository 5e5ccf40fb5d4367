//! Geometry that follows changes of its mesh instead of being made anew.
//!
//! Whatever it holds afterwards draws the bytes of geometry made from the changed mesh:
//! each triangle shows the same values. Only the numbers of vertices may differ. What is
//! made anew as a whole: tangents that were generated, when a normal map asks for them;
//! the geometry of a mesh that a pose can bend; and all of it when a polygon gets more or
//! fewer triangles than it had.

use std::mem::{replace, take};
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
                let mesh_vertices = changed.vertices();
                geometry.change = Some(GeometryChange { before: state, vertices, mesh_vertices, triangles });
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
        self.blocks = OnceLock::new();
        self.tangential = places_for(&self.columns);
        let mut columns = take(&mut self.columns);
        let (triangles, ()) =
            rayon::join(|| self.replace_triangles(mesh, &update), || columns.update(mesh, &update.vertices));
        self.columns = columns;
        Some((update.vertices.iter().map(|updated| updated.vertex).collect(), triangles?))
    }

    /// Replaces the triangles of faces; those that are other ones now, or have other flags or
    /// sides, increasing. `None`, and nothing is replaced, where a face has more or fewer than
    /// before.
    fn replace_triangles(&mut self, mesh: &Mesh, update: &RenderUpdate) -> Option<Vec<u32>> {
        /// Faces that a thread takes at a time.
        const PIECE: usize = 1024;
        let cuts = self.cuts(mesh, update)?;
        let vertex_of_corner = self.links.as_ref()?.vertex_of_corner();
        let mut lists = TriangleLists {
            triangles: &mut self.triangles,
            flags: self.edge_flags.get_mut().map_or(&mut [], Vec::as_mut_slice),
            sides: self.side_edges.get_mut().map_or(&mut [], |sides| Arc::make_mut(sides).as_mut_slice()),
        };
        let mut first = 0;
        let mut pieces = Vec::with_capacity(cuts.len().div_ceil(PIECE));
        for cuts in cuts.chunks(PIECE) {
            let end = cuts[cuts.len() - 1].end();
            pieces.push((cuts, first, lists.split_off(end - first)));
            first = end;
        }
        let replace = |(cuts, first, mut lists): (&[Cut<'_>], usize, TriangleLists<'_>)| {
            let (mut replaced, mut flags) = (Vec::new(), Vec::new());
            for cut in cuts {
                flags.clear();
                if !lists.flags.is_empty() {
                    flags_of_face(mesh, (cut.face, cut.triangles), |made| flags.push(made));
                }
                lists.write(mesh, vertex_of_corner, (cut, first), (&flags, &mut replaced));
            }
            replaced
        };
        Some(pieces.into_par_iter().map(replace).collect::<Vec<_>>().concat())
    }

    /// How the changed faces are cut, by the place of their triangles.
    fn cuts<'a>(&self, mesh: &Mesh, update: &'a RenderUpdate) -> Option<Vec<Cut<'a>>> {
        let slots = mesh.attributes().face_materials.as_deref();
        let (mut triangles, mut faces) =
            (update.triangulation.triangles.as_slice(), update.triangulation.triangle_faces.as_slice());
        let mut cuts = Vec::with_capacity(update.faces.len());
        for &face in &update.faces {
            let count = faces.iter().take_while(|&&of| of == face).count();
            faces = &faces[count..];
            let own = triangles.split_off(..count)?;
            let slot = slots.map_or(0, |slots| slots[face as usize]);
            let place = self.place_of(face, slot, mesh.face_count());
            if place.len() != count {
                return None;
            }
            if count > 0 {
                cuts.push(Cut { face, triangles: own, place: place.start });
            }
        }
        // Out of order where faces of several slots change.
        cuts.sort_by_key(|cut| cut.place);
        Some(cuts)
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

/// A changed face and its triangles.
struct Cut<'a> {
    face: u32,
    /// Over the corners of the mesh.
    triangles: &'a [[u32; 3]],
    /// Where they lie in the geometry.
    place: usize,
}

impl Cut<'_> {
    fn end(&self) -> usize {
        self.place + self.triangles.len()
    }
}

/// What geometry has for each triangle, of some triangles one after the other; or nothing
/// where it is not known.
struct TriangleLists<'a> {
    triangles: &'a mut [[u32; 3]],
    flags: &'a mut [EdgeFlags],
    sides: &'a mut [[u32; 3]],
}

impl<'a> TriangleLists<'a> {
    /// Takes away the first so many.
    fn split_off(&mut self, count: usize) -> Self {
        fn first<'a, T>(list: &mut &'a mut [T], count: usize) -> &'a mut [T] {
            list.split_off_mut(..count).unwrap_or_default()
        }
        Self {
            triangles: first(&mut self.triangles, count),
            flags: first(&mut self.flags, count),
            sides: first(&mut self.sides, count),
        }
    }

    /// Writes those of a face, given the place of the first triangle of these lists, and adds
    /// the places of those that differ from before.
    fn write(
        &mut self,
        mesh: &Mesh,
        vertex_of_corner: &[u32],
        (cut, first): (&Cut<'_>, usize),
        (made_flags, replaced): (&[EdgeFlags], &mut Vec<u32>),
    ) {
        for (number, triangle) in cut.triangles.iter().enumerate() {
            let at = cut.place - first + number;
            let corners = triangle.map(|corner| vertex_of_corner[corner as usize]);
            let mut differs = replace(&mut self.triangles[at], corners) != corners;
            if let Some((own, &made)) = self.flags.get_mut(at).zip(made_flags.get(number)) {
                differs |= replace(own, made) != made;
            }
            if let Some(own) = self.sides.get_mut(at) {
                let sides = sides_of_triangle(mesh, cut.face, triangle);
                differs |= replace(own, sides) != sides;
            }
            if differs {
                replaced.push((cut.place + number) as u32);
            }
        }
    }
}

#[cfg(test)]
mod tests;

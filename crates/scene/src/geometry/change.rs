//! Updates geometry after a change of its mesh, instead of rebuilding it.
//!
//! Updated geometry draws the same bytes as geometry rebuilt from the changed mesh: each triangle shows the
//! same values, only the number of vertices may differ. Two things are rebuilt as a whole: tangents that were
//! generated for a normal map, and the geometry of a mesh that a pose can deform. Each polygon has slots for
//! two triangles fewer than it has corners. A folded polygon has fewer triangles; degenerate ones, whose
//! three corners are the same vertex, fill the rest of its slots.

use std::mem::{replace, take};
use std::ops::Range;
use std::sync::{Arc, OnceLock};

use rayon::prelude::*;
use trigon_math::{Bounds3, Vec3};
use trigon_mesh::{
    ChangedElements, Mesh, RenderLinks, RenderMesh, RenderUpdate, Triangulation, UpdatedVertex,
};
use trigon_raster::EdgeFlags;

use super::edge_flags::flags_of_face;
use super::side_edges::{NO_EDGE, sides_of_triangle};
use super::{Geometry, GeometryChange, GeometryState, box_around, places_for};

impl Geometry {
    /// Geometry that can follow changes of its mesh.
    pub(crate) fn that_follows(mesh: &Mesh) -> Self {
        let (mut render_mesh, links) = RenderMesh::with_links(mesh);
        let fillers = links.as_ref().map(|links| fill(&mut render_mesh, mesh, links));
        Self { links, fillers: fillers.unwrap_or_default(), ..Self::of(render_mesh) }
    }

    /// Whether it can follow changes of its mesh.
    pub(crate) fn can_follow(&self) -> bool {
        self.links.is_some()
    }

    /// Updates the geometry of a mesh after these elements have changed. It is copied first if somebody else
    /// holds it.
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

    /// The data needed to follow changes.
    fn copied(&self) -> Self {
        Self { links: self.links.clone(), ..self.with_columns(self.columns.clone()) }
    }

    /// Writes the affected vertices and triangles, and returns them. `None` if it cannot follow the change;
    /// it is then of no further use.
    fn follow(&mut self, mesh: &Mesh, changed: &ChangedElements) -> Option<(Vec<u32>, Vec<u32>)> {
        let update = self.links.as_mut()?.follow(mesh, changed);
        self.state = GeometryState::default();
        let bounds = self.bounds_without(&update.vertices);
        self.blocks = OnceLock::new();
        self.mesh_vertices = OnceLock::new();
        self.tangential = places_for(&self.columns);
        let mut columns = take(&mut self.columns);
        let (triangles, ()) =
            rayon::join(|| self.replace_triangles(mesh, &update), || columns.update(mesh, &update.vertices));
        self.columns = columns;
        let bounds = bounds.map(|bounds| self.bounds_with(bounds, &update.vertices));
        self.bounds = bounds.map_or_else(OnceLock::new, OnceLock::from);
        Some((update.vertices.iter().map(|updated| updated.vertex).collect(), triangles?))
    }

    /// The box, if it is known and does not change without some vertices.
    fn bounds_without(&self, vertices: &[UpdatedVertex]) -> Option<Bounds3> {
        let bounds = *self.bounds.get()?;
        let is_on_border = |vertex: &UpdatedVertex| {
            // New vertices have no position yet.
            let place = self.columns.position(vertex.vertex).map(Vec3::as_dvec3);
            place.is_some_and(|place| (place.cmpeq(bounds.min) | place.cmpeq(bounds.max)).any())
        };
        (!vertices.iter().any(is_on_border)).then_some(bounds)
    }

    /// The box extended by vertices that were written.
    fn bounds_with(&self, bounds: Bounds3, vertices: &[UpdatedVertex]) -> Bounds3 {
        let places = vertices.iter().filter_map(|vertex| self.columns.position(vertex.vertex));
        bounds.union(box_around(places))
    }

    /// Replaces the triangles of faces, and returns those that have other corners, edge flags or sides now,
    /// increasing. `None`, with nothing replaced, if a face needs more slots than it has.
    fn replace_triangles(&mut self, mesh: &Mesh, update: &RenderUpdate) -> Option<Vec<u32>> {
        /// Faces per task.
        const PIECE: usize = 1024;
        let cuts = self.cuts(mesh, update)?;
        self.note_fillers(&cuts);
        let vertex_of_corner = self.links.as_ref()?.vertex_of_corner();
        let mut lists = TriangleLists {
            triangles: &mut self.triangles,
            flags: self.edge_flags.get_mut().map_or(&mut [], Vec::as_mut_slice),
            sides: self.side_edges.get_mut().map_or(&mut [], |sides| Arc::make_mut(sides).as_mut_slice()),
        };
        let mut first = 0;
        let mut pieces = Vec::with_capacity(cuts.len().div_ceil(PIECE));
        for cuts in cuts.chunks(PIECE) {
            let end = cuts[cuts.len() - 1].place.end;
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

    /// The triangulation of the changed faces, by the slots of their triangles.
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
            if place.len() < count {
                return None;
            }
            if !place.is_empty() {
                cuts.push(Cut { face, triangles: own, place });
            }
        }
        // Out of order where faces of several slots change.
        cuts.sort_by_key(|cut| cut.place.start);
        Some(cuts)
    }

    /// Updates the list of fillers.
    fn note_fillers(&mut self, cuts: &[Cut<'_>]) {
        let is_full = |cut: &Cut<'_>| cut.triangles.len() == cut.place.len();
        if self.fillers.is_empty() && cuts.iter().all(is_full) {
            return;
        }
        // The slots of a face are consecutive in the triangulation, too.
        let in_triangulation = |cut: &Cut<'_>| {
            let start = self.place_in_triangulation(cut.place.start);
            (start..start + cut.place.len() as u32, cut.triangles.len() as u32)
        };
        let mut places: Vec<_> = cuts.iter().map(in_triangulation).collect();
        places.sort_unstable_by_key(|(places, _)| places.start);
        self.fillers.retain(|filler| {
            let next = places.partition_point(|(places, _)| places.end <= *filler);
            !places.get(next).is_some_and(|(places, _)| places.contains(filler))
        });
        self.fillers.extend(places.into_iter().flat_map(|(places, count)| places.start + count..places.end));
        self.fillers.sort_unstable();
    }

    /// The slots of a face's triangles in a material slot; empty if it has none.
    fn place_of(&self, face: u32, slot: u32, face_count: usize) -> Range<usize> {
        let Ok(run) = self.runs.binary_search_by_key(&slot, |run| run.slot) else { return 0..0 };
        let Range { start, end } = self.runs[run].triangles;
        let Some(faces) = self.faces_of(start..end) else {
            return if (face as usize) < end { face as usize..face as usize + 1 } else { 0..0 };
        };
        // Correct at once if all faces have equally many triangles and one material slot.
        let guess = (u64::from(face) * faces.len() as u64 / face_count as u64) as usize;
        let begins = |at: usize| faces.get(at) == Some(&face) && (at == 0 || faces[at - 1] != face);
        let first = if begins(guess) { guess } else { faces.partition_point(|&other| other < face) };
        let count = faces[first..].iter().take_while(|&&other| other == face).count();
        start + first..start + first + count
    }
}

/// Gives each face slots for as many triangles as it can ever have, and returns the slots of fillers,
/// increasing. A polygon that crosses itself or has no area has fewer triangles than slots.
fn fill(render_mesh: &mut RenderMesh, mesh: &Mesh, links: &RenderLinks) -> Vec<u32> {
    let most = mesh.corner_count() - 2 * mesh.face_count();
    let mut fillers = Vec::new();
    if render_mesh.triangles.len() == most {
        return fillers;
    }
    // Those of the render mesh, over corners.
    let Triangulation { triangles, triangle_faces } = mesh.triangulation();
    let (mut rest, mut faces) = (triangles.as_slice(), triangle_faces.as_slice());
    (render_mesh.triangles, render_mesh.triangle_faces) =
        (Vec::with_capacity(most), Vec::with_capacity(most));
    let slots = mesh.attributes().face_materials.as_deref();
    let mut materials = slots.map(|_| Vec::with_capacity(most));
    for (face, corners) in (0_u32..).zip(mesh.faces()) {
        let count = faces.iter().take_while(|&&of| of == face).count();
        let own;
        (own, rest) = rest.split_at(count);
        faces = &faces[count..];
        let mut made = fillers_of(mesh, face, own);
        for number in 0..corners.len() - 2 {
            let triangle = own.get(number).copied().unwrap_or_else(|| {
                fillers.push(render_mesh.triangles.len() as u32);
                [made.next(); 3]
            });
            render_mesh.triangles.push(triangle.map(|corner| links.vertex_of_corner()[corner as usize]));
            render_mesh.triangle_faces.push(face);
            if let (Some(materials), Some(slots)) = (&mut materials, slots) {
                materials.push(slots[face as usize]);
            }
        }
    }
    render_mesh.triangle_materials = materials;
    fillers
}

/// The corners that the fillers of a face use.
struct Fillers {
    /// First those that no triangle of the face uses, so that no corner is left without a triangle.
    unused: std::vec::IntoIter<u32>,
    first: u32,
}

fn fillers_of(mesh: &Mesh, face: u32, triangles: &[[u32; 3]]) -> Fillers {
    let corners = mesh.face_corners(face as usize);
    let first = corners.start as u32;
    let mut unused = Vec::new();
    if triangles.len() + 2 < corners.len() {
        let mut is_used = vec![false; corners.len()];
        triangles.as_flattened().iter().for_each(|corner| is_used[(corner - first) as usize] = true);
        unused.extend((first..).zip(is_used).filter(|(_, is_used)| !is_used).map(|(corner, _)| corner));
    }
    Fillers { unused: unused.into_iter(), first }
}

impl Fillers {
    fn next(&mut self) -> u32 {
        self.unused.next().unwrap_or(self.first)
    }
}

/// A changed face and its triangles.
struct Cut<'a> {
    face: u32,
    /// Over the corners of the mesh.
    triangles: &'a [[u32; 3]],
    /// Their slots in the geometry; there may be more.
    place: Range<usize>,
}

/// Per-triangle data of consecutive triangles, or nothing where it is unknown.
struct TriangleLists<'a> {
    triangles: &'a mut [[u32; 3]],
    flags: &'a mut [EdgeFlags],
    sides: &'a mut [[u32; 3]],
}

impl<'a> TriangleLists<'a> {
    /// Splits off the first `count` triangles and returns them.
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

    /// Writes the triangles of a face to the slots from the given one on, and records the slots that have
    /// changed.
    fn write(
        &mut self,
        mesh: &Mesh,
        vertex_of_corner: &[u32],
        (cut, first): (&Cut<'_>, usize),
        (made_flags, replaced): (&[EdgeFlags], &mut Vec<u32>),
    ) {
        let mut fillers = fillers_of(mesh, cut.face, cut.triangles);
        for (number, place) in cut.place.clone().enumerate() {
            let (at, triangle) = (place - first, cut.triangles.get(number));
            let corners = triangle.copied().unwrap_or_else(|| [fillers.next(); 3]);
            let corners = corners.map(|corner| vertex_of_corner[corner as usize]);
            let mut differs = replace(&mut self.triangles[at], corners) != corners;
            if let Some(own) = self.flags.get_mut(at) {
                let made = made_flags.get(number).copied().unwrap_or(EdgeFlags::NONE);
                differs |= replace(own, made) != made;
            }
            if let Some(own) = self.sides.get_mut(at) {
                let of_triangle = |triangle| sides_of_triangle(mesh, cut.face, triangle);
                let sides = triangle.map_or([NO_EDGE; 3], of_triangle);
                differs |= replace(own, sides) != sides;
            }
            if differs {
                replaced.push(place as u32);
            }
        }
    }
}

#[cfg(test)]
mod tests;

//! Updates geometry after a change of its mesh, instead of rebuilding it.
//!
//! Updated geometry draws the same bytes as geometry rebuilt from the changed mesh: each triangle shows the
//! same values, only the number of vertices may differ. Two things are rebuilt as a whole: tangents that were
//! generated for a normal map, and the geometry of a mesh that a pose can deform. Each polygon has slots for
//! two triangles fewer than it has corners. A folded polygon has fewer triangles; degenerate ones, whose
//! three corners are the same vertex, fill the rest of its slots.

mod cut_quads;
mod face_places;
mod triangle_lists;

use std::mem::take;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

use rayon::prelude::*;
use trigon_math::Bounds3;
use trigon_mesh::{
    ChangedElements, Mesh, RenderLinks, RenderMesh, RenderUpdate, Triangulation, UpdatedVertex, WeldedMesh,
};

use cut_quads::cut_quads;
pub(super) use face_places::FacePlaces;
use face_places::{FacePlace, PIECE};
use triangle_lists::{Replaced, TriangleLists, fillers_of};

use super::{
    Columns, Geometry, GeometryChange, GeometryState, Triangles, box_around, box_of_ranges, large_flat,
    places_for, range_without,
};

impl Geometry {
    /// Geometry that can follow changes of its mesh.
    pub(crate) fn that_follows(mesh: &Mesh) -> Self {
        if let Some(((mut welded, normals), links)) = large_flat(mesh, WeldedMesh::of_flat_with_links) {
            let triangles = Triangles::of_welded(&mut welded);
            let columns = || Columns::of_flat_faces(mesh, welded, normals);
            return Self::linked(mesh, (triangles, links), columns);
        }
        let (mut render_mesh, links) = RenderMesh::with_links(mesh);
        let Some(links) = links else { return Self::of(render_mesh) };
        let triangles = Triangles::of_render_mesh(&mut render_mesh);
        Self::linked(mesh, (triangles, links), || Columns::new(render_mesh))
    }

    /// Of these triangles of a mesh, and its vertices.
    fn linked(
        mesh: &Mesh,
        (mut triangles, links): (Triangles, RenderLinks),
        columns: impl FnOnce() -> Columns,
    ) -> Self {
        let fillers = triangles.fill(mesh, &links);
        Self { links: Some(links), fillers, ..Self::with(triangles, columns, None) }
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
        let mut links = self.links.take()?;
        links.follow(mesh, changed);
        let update = links.update();
        self.state = GeometryState::default();
        let bounds = self.bounds_without(update);
        self.blocks = OnceLock::new();
        self.mesh_vertices = OnceLock::new();
        (self.tangential, self.split) = (places_for(&self.columns), OnceLock::new());
        let mut columns = take(&mut self.columns);
        let is_flat = columns.face_normals.is_some();
        // They come last.
        let is_new = |last: &UpdatedVertex| last.vertex as usize >= columns.vertex_count();
        if update.vertices.last().is_some_and(is_new) {
            self.face_places.forget_cuts();
        }
        let (triangles, vertices) = rayon::join(
            || self.replace_triangles(mesh, (&links, is_flat)),
            || {
                columns.update(mesh, update);
                update.vertices.iter().map(|updated| updated.vertex).collect()
            },
        );
        self.columns = columns;
        let bounds = bounds.map(|bounds| self.bounds_with(bounds, update));
        self.bounds = bounds.map_or_else(OnceLock::new, OnceLock::from);
        self.links = Some(links);
        Some((vertices, triangles?))
    }

    /// The box around all vertices but those that are about to move, if it is known.
    fn bounds_without(&mut self, update: &RenderUpdate) -> Option<Bounds3> {
        let moved = update.replaced().map(|vertex| vertex.vertex);
        let columns = &self.columns;
        // New vertices have no position yet.
        let place = |vertex| columns.position(vertex);
        self.still_bounds.without(self.bounds.get().copied(), moved, place, |moved| {
            box_of_ranges(columns.positions.each_ref().map(|column| range_without(column, moved)))
        })
    }

    /// The box extended by vertices that were written.
    fn bounds_with(&self, bounds: Bounds3, update: &RenderUpdate) -> Bounds3 {
        let places = update.replaced().filter_map(|vertex| self.columns.position(vertex.vertex));
        bounds.union(box_around(places))
    }

    /// Replaces the triangles of faces, and returns those that may have other corners, edge flags, sides or normals of
    /// polygons now, increasing. `None` if a face needs more slots than it has.
    fn replace_triangles(&mut self, mesh: &Mesh, (links, is_flat): (&RenderLinks, bool)) -> Option<Vec<u32>> {
        let mut face_places = take(&mut self.face_places);
        let materials = mesh.attributes().face_materials.as_deref();
        let places = face_places.update(links.update(), |face| {
            self.place_of(face, materials.map_or(0, |slots| slots[face as usize]), mesh.face_count())
        });
        let mut lists = TriangleLists {
            triangles: &mut self.triangles,
            flags: self.edge_flags.get_mut().map_or(&mut [], Vec::as_mut_slice),
            sides: self.side_edges.get_mut().map_or(&mut [], |sides| Arc::make_mut(sides).as_mut_slice()),
        };
        let quads = cut_quads(mesh, &links.update().outlines, !lists.flags.is_empty());
        let mut first = 0;
        let mut pieces = Vec::with_capacity(places.len().div_ceil(PIECE));
        for places in places.chunks_mut(PIECE) {
            let end = places[places.len() - 1].slots().end;
            pieces.push((places, first, lists.split_off(end - first)));
            first = end;
        }
        let replace = |(places, first, lists): (&mut [FacePlace], usize, TriangleLists<'_>)| {
            lists.replace(mesh, links, (places, &quads), first)
        };
        let replaced: Vec<Replaced> = pieces.into_par_iter().map(replace).collect::<Option<_>>()?;
        self.note_fillers(places, &replaced);
        // Each shows the normal of its polygon.
        let triangles = match is_flat {
            true => places.iter().flat_map(|place| place.slots()).map(|slot| slot as u32).collect(),
            false => replaced.into_iter().flat_map(|part| part.triangles).collect(),
        };
        self.face_places = face_places;
        Some(triangles)
    }

    /// Updates the list of fillers after triangles were replaced.
    fn note_fillers(&mut self, places: &[FacePlace], replaced: &[Replaced]) {
        let are_all_full = self.fillers.is_empty() && replaced.iter().all(|part| part.counts.is_empty());
        if are_all_full || !replaced.iter().any(|part| part.may_differ_in_counts) {
            return;
        }
        // The slots of a face are consecutive in the triangulation, too.
        let slots = |place: &FacePlace| {
            let start = self.place_in_triangulation(place.slots().start);
            start..start + place.slots().len() as u32
        };
        let mut counted = Vec::with_capacity(places.len());
        for (places, part) in places.chunks(PIECE).zip(replaced) {
            let count = |number: usize, slots: &Range<u32>| {
                part.counts.get(number).map_or(slots.len() as u32, |&count| count)
            };
            counted.extend(
                places.iter().map(slots).enumerate().map(|(number, slots)| (count(number, &slots), slots)),
            );
        }
        counted.sort_unstable_by_key(|(_, slots)| slots.start);
        self.fillers.retain(|filler| {
            let next = counted.partition_point(|(_, slots)| slots.end <= *filler);
            !counted.get(next).is_some_and(|(_, slots)| slots.contains(filler))
        });
        self.fillers.extend(counted.into_iter().flat_map(|(count, slots)| slots.start + count..slots.end));
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

impl Triangles {
    /// Gives each face slots for as many triangles as it can ever have, and returns the slots of fillers,
    /// increasing. A polygon that crosses itself or has no area has fewer triangles than slots.
    fn fill(&mut self, mesh: &Mesh, links: &RenderLinks) -> Vec<u32> {
        let most = mesh.corner_count() - 2 * mesh.face_count();
        let mut fillers = Vec::new();
        if self.triangles.len() == most {
            return fillers;
        }
        // Those of the render mesh, over corners.
        let Triangulation { triangles, triangle_faces } = mesh.triangulation();
        let (mut rest, mut faces) = (triangles.as_slice(), triangle_faces.as_slice());
        (self.triangles, self.faces) = (Vec::with_capacity(most), Vec::with_capacity(most));
        for (face, corners) in (0_u32..).zip(mesh.faces()) {
            let count = faces.iter().take_while(|&&of| of == face).count();
            let own;
            (own, rest) = rest.split_at(count);
            faces = &faces[count..];
            let mut made = fillers_of(mesh, face, own);
            for number in 0..corners.len() - 2 {
                let triangle = own.get(number).copied().unwrap_or_else(|| {
                    fillers.push(self.triangles.len() as u32);
                    [made.next(); 3]
                });
                self.triangles.push(triangle.map(|corner| links.vertex_of_corner()[corner as usize]));
                self.faces.push(face);
            }
        }
        if let Some(slots) = mesh.attributes().face_materials.as_deref() {
            self.slots = self.faces.iter().map(|&face| slots[face as usize]).collect();
        }
        fillers
    }
}

#[cfg(test)]
mod tests;

//! Updates geometry after a change of its mesh, instead of rebuilding the geometry.
//!
//! Updated geometry draws the same bytes as geometry rebuilt from the changed mesh: each triangle shows the same values,
//! and only the number of vertices may differ. Two things are rebuilt as a whole: tangents that were generated for a
//! normal map, and the geometry of a mesh that a pose can deform. Each polygon has slots for two triangles fewer than its
//! corners. A folded polygon has fewer triangles. Degenerate triangles, whose three corners are the same vertex, fill the
//! rest of the polygon's slots.

mod changed_faces;

use std::mem::take;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

use rayon::prelude::*;
use trigon_math::Bounds3;
use trigon_mesh::{
    ChangedElements, Mesh, RenderLinks, RenderMesh, RenderUpdate, Triangulation, UpdatedVertex, WeldedMesh,
};

use changed_faces::{ChangedFace, ChangedFaces, FACES_PER_TASK, Rewritten, TriangleLists, fillers_of};

use super::{
    Columns, Geometry, GeometryChange, MaterialTriangles, box_around, box_of_ranges, empty_slots, large_flat,
    range_without,
};

impl Geometry {
    /// Geometry that can follow changes of its mesh.
    pub(crate) fn that_follows(mesh: &Mesh) -> Self {
        if let Some(((mut welded, normals), links)) = large_flat(mesh, WeldedMesh::of_flat_with_links) {
            let triangles = MaterialTriangles::of_welded(&mut welded);
            let columns = || Columns::of_flat_faces(mesh, welded, normals);
            return Self::linked(mesh, triangles, links, columns);
        }
        let (mut render_mesh, links) = RenderMesh::with_links(mesh);
        let Some(links) = links else { return Self::of(render_mesh) };
        let triangles = MaterialTriangles::of_render_mesh(&mut render_mesh);
        Self::linked(mesh, triangles, links, || Columns::new(render_mesh))
    }

    /// Of these triangles of a mesh, and its vertices.
    fn linked(
        mesh: &Mesh,
        mut triangles: MaterialTriangles,
        links: RenderLinks,
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
        let mut geometry = Arc::try_unwrap(before).unwrap_or_else(|shared| shared.copied());
        match geometry.follow(mesh, changed) {
            Some(change) => Self { change: Some(change), ..geometry },
            None => Self::that_follows(mesh),
        }
    }

    /// The data needed to follow changes.
    fn copied(&self) -> Self {
        Self { links: self.links.clone(), ..self.with_columns(self.columns.clone()) }
    }

    /// Writes the affected vertices and triangles, and returns them. `None` if it cannot follow the change;
    /// it is then of no further use.
    fn follow(&mut self, mesh: &Mesh, changed: &ChangedElements) -> Option<GeometryChange> {
        let mut links = self.links.take()?;
        let update = links.follow(mesh, changed);
        let before = take(&mut self.state);
        let bounds = self.bounds_without(&update);
        self.blocks = OnceLock::new();
        self.mesh_vertices = OnceLock::new();
        (self.tangential, self.split) = (empty_slots(&self.columns), OnceLock::new());
        let mut columns = take(&mut self.columns);
        let is_flat = columns.face_normals.is_some();
        let (triangles, vertices) = rayon::join(
            || self.replace_triangles(mesh, &links, &update.faces, is_flat),
            || {
                columns.update(mesh, &update);
                update.vertices.iter().map(|updated| updated.vertex).collect()
            },
        );
        self.columns = columns;
        let bounds = bounds.map(|bounds| self.bounds_with(bounds, &update));
        self.bounds = bounds.map_or_else(OnceLock::new, OnceLock::from);
        self.links = Some(links);
        Some(GeometryChange { before, vertices, mesh_vertices: changed.vertices(), triangles: triangles? })
    }

    /// The box around all vertices but those that are about to move, if it is known.
    fn bounds_without(&mut self, update: &RenderUpdate) -> Option<Bounds3> {
        let moved = replaced(update).map(|vertex| vertex.vertex);
        let columns = &self.columns;
        // New vertices have no position yet.
        let position = |vertex| columns.position(vertex);
        self.still_bounds.without(self.bounds.get().copied(), moved, position, |moved| {
            box_of_ranges(columns.positions.each_ref().map(|column| range_without(column, moved)))
        })
    }

    /// The box extended by vertices that were written.
    fn bounds_with(&self, bounds: Bounds3, update: &RenderUpdate) -> Bounds3 {
        let positions = replaced(update).filter_map(|vertex| self.columns.position(vertex.vertex));
        bounds.union(box_around(positions))
    }

    /// Cuts faces into triangles again, and returns the triangles that may have other corners, edge flags, sides or
    /// normals of polygons now, increasing. `None` if a face needs more slots than it has.
    fn replace_triangles(
        &mut self,
        mesh: &Mesh,
        links: &RenderLinks,
        faces: &[u32],
        is_flat: bool,
    ) -> Option<Vec<u32>> {
        let faces = self.changed_faces(mesh, faces);
        let mut lists = TriangleLists {
            triangles: &mut self.triangles,
            flags: self.edge_flags.get_mut().map_or(&mut [], Vec::as_mut_slice),
            sides: self.side_edges.get_mut().map_or(&mut [], |sides| Arc::make_mut(sides).as_mut_slice()),
        };
        let mut first_slot = 0;
        let mut tasks = Vec::with_capacity(faces.len().div_ceil(FACES_PER_TASK));
        for faces in faces.chunks(FACES_PER_TASK) {
            let end = faces[faces.len() - 1].slots().end;
            let lists = lists.split_off(end - first_slot);
            tasks.push(ChangedFaces { mesh, links, faces, first_slot, lists });
            first_slot = end;
        }
        let rewritten: Vec<Rewritten> =
            tasks.into_par_iter().map(ChangedFaces::rewrite).collect::<Option<_>>()?;
        self.note_fillers(&faces, &rewritten);
        // Each shows the normal of its polygon.
        Some(match is_flat {
            true => faces.iter().flat_map(|face| face.slots()).map(|slot| slot as u32).collect(),
            false => rewritten.into_iter().flat_map(|part| part.triangles).collect(),
        })
    }

    /// Where the triangles of faces are, if they have any; in the order of their slots.
    fn changed_faces(&self, mesh: &Mesh, faces: &[u32]) -> Vec<ChangedFace> {
        let materials = mesh.attributes().face_materials.as_deref();
        let find = |&face: &u32| {
            let material = materials.map_or(0, |slots| slots[face as usize]);
            let slots = self.slots_of(face, material, mesh.face_count());
            ChangedFace { face, start: slots.start as u32, end: slots.end as u32 }
        };
        let found = faces.par_iter().with_min_len(FACES_PER_TASK).map(find);
        let mut found: Vec<ChangedFace> = found.filter(|face| face.start < face.end).collect();
        // Out of order where faces of several materials change.
        found.sort_by_key(|face| face.start);
        found
    }

    /// Updates the list of fillers after faces were cut again.
    fn note_fillers(&mut self, faces: &[ChangedFace], rewritten: &[Rewritten]) {
        let fillers = rewritten.iter().flat_map(|part| &part.fillers);
        let fillers: Vec<u32> = fillers.map(|&slot| self.index_with_fillers(slot as usize)).collect();
        if self.fillers.is_empty() && fillers.is_empty() {
            return;
        }
        // The slots of a face are consecutive in the triangulation, too.
        let in_triangulation = |face: &ChangedFace| {
            let start = self.index_with_fillers(face.start as usize);
            start..start + face.end - face.start
        };
        let mut changed: Vec<Range<u32>> = faces.iter().map(in_triangulation).collect();
        changed.sort_unstable_by_key(|slots| slots.start);
        self.fillers.retain(|filler| {
            let next = changed.partition_point(|slots| slots.end <= *filler);
            !changed.get(next).is_some_and(|slots| slots.contains(filler))
        });
        self.fillers.extend(fillers);
        self.fillers.sort_unstable();
    }

    /// The slots of a face's triangles in a material slot; empty if it has none.
    fn slots_of(&self, face: u32, material: u32, face_count: usize) -> Range<usize> {
        let Ok(run) = self.runs.binary_search_by_key(&material, |run| run.slot) else { return 0..0 };
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

impl MaterialTriangles {
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

/// The vertices that may show more than another normal.
fn replaced(update: &RenderUpdate) -> impl Iterator<Item = &UpdatedVertex> + Clone {
    update.vertices.iter().filter(|vertex| !vertex.is_normal_alone)
}

#[cfg(test)]
mod tests;

//! How the vertices of a render mesh come from its mesh, kept so that changes can be
//! followed.

use std::sync::Arc;

use trigon_math::Vec3;

use super::ChangedElements;
use super::corner_faces::CornerFaces;
use super::local_normals::LocalNormals;
use super::marks::Marks;
use super::render_update::{RenderUpdate, UpdatedVertex};
use crate::Mesh;
use crate::groups::Groups;
use crate::normals::unit_keeping;
use crate::weld::{AttributeComparison, Welded, bits};

/// How the vertices of a [`RenderMesh`](crate::RenderMesh) come from its mesh. Made by
/// [`RenderMesh::with_links`](crate::RenderMesh::with_links).
///
/// Corners of a vertex that no longer agree get render vertices of their own, at the end
/// of the list. Those that agree again stay apart, so that no render vertex is without a
/// corner: triangles show the same values as those of a render mesh made from the changed
/// mesh, to the bit, but may name them by other numbers.
#[derive(Debug, Clone)]
pub struct RenderLinks {
    /// The render vertex of each corner.
    vertex_of_corner: Vec<u32>,
    vertex_count: u32,
    /// The corners at each vertex of the mesh, increasing. No change alters them.
    corners_at: Arc<Groups<u32>>,
    /// The normals of all faces, as soon as a corner takes its normal from them.
    face_normals: Option<Vec<Vec3>>,
}

impl RenderLinks {
    pub(crate) fn new(mesh: &Mesh, welded: Welded) -> Self {
        let corners = mesh.corner_vertices().iter().copied().zip(0u32..);
        let given = mesh.attributes().corner_normals.as_deref();
        let follows = given.is_none_or(|given| given.iter().any(|&normal| has_no_direction(normal)));
        Self {
            vertex_count: welded.corner_of_vertex.len() as u32,
            vertex_of_corner: welded.vertex_of_corner,
            corners_at: Arc::new(Groups::new(mesh.vertex_count(), corners)),
            face_normals: follows.then(|| mesh.face_normals()),
        }
    }

    /// The render vertex of each corner of the mesh.
    pub fn vertex_of_corner(&self) -> &[u32] {
        &self.vertex_of_corner
    }

    /// What is to be written anew when these elements of the mesh were changed, in time
    /// proportional to what lies around them. `mesh` is the one that these links were made
    /// for, with its new values.
    pub fn follow(&mut self, mesh: &Mesh, changed: &ChangedElements) -> RenderUpdate {
        let (vertices, corners) = (changed.vertices(), changed.corners());
        let mut update = RenderUpdate::default();
        let faces = self.faces_around(mesh, &vertices);
        self.update_face_normals(mesh, (&faces, &corners));
        let affected = self.affected_vertices(mesh, (&vertices, &corners, &faces));
        update.vertices.reserve(affected.len());
        update.faces = faces;
        // Triangles are cut in one way only.
        update.faces.retain(|&face| mesh.face_corners(face as usize).len() > 3);
        self.update_vertices(mesh, &affected, corners.is_empty(), &mut update);
        if !update.faces.is_sorted_by(|a, b| a < b) {
            update.faces.sort_unstable();
            update.faces.dedup();
        }
        update.triangulation = mesh.triangulation_of(update.faces.iter().copied(), 2 * update.faces.len());
        update
    }

    /// The faces that have one of these vertices, each once.
    fn faces_around(&self, mesh: &Mesh, vertices: &[u32]) -> Vec<u32> {
        let (of_corner, mut met) = (CornerFaces::new(mesh), Marks::new(mesh.face_count()));
        let corners = vertices.iter().flat_map(|&vertex| self.corners_at.get(vertex));
        let faces = corners.map(|&corner| of_corner.of(corner).0 as u32);
        faces.filter(|&face| met.insert(face)).collect()
    }

    /// Brings the normals of faces up to date whose corners moved.
    fn update_face_normals(&mut self, mesh: &Mesh, (faces, corners): (&[u32], &[u32])) {
        if let Some(normals) = &mut self.face_normals {
            for &face in faces {
                normals[face as usize] = mesh.face_normal(face as usize);
            }
            return;
        }
        let given = mesh.attributes().corner_normals.as_deref().unwrap_or_default();
        if corners.iter().any(|&corner| given.get(corner as usize).is_some_and(|&n| has_no_direction(n))) {
            self.face_normals = Some(mesh.face_normals());
        }
    }

    /// The vertices at which a corner may show other values than before, each once.
    fn affected_vertices(
        &self,
        mesh: &Mesh,
        (vertices, corners, faces): (&[u32], &[u32], &[u32]),
    ) -> Vec<u32> {
        let mut met = Marks::new(mesh.vertex_count());
        let mut affected: Vec<u32> = vertices.iter().copied().filter(|&vertex| met.insert(vertex)).collect();
        let of_corners = corners.iter().map(|&corner| mesh.corner_vertices()[corner as usize]);
        affected.extend(of_corners.filter(|&vertex| met.insert(vertex)));
        if self.face_normals.is_some() {
            let around = faces.iter().flat_map(|&face| mesh.face_vertices(face as usize));
            affected.extend(around.copied().filter(|&vertex| met.insert(vertex)));
        }
        affected
    }

    /// `same_attributes`: whether corners that were one vertex can differ in nothing but
    /// their normals.
    fn update_vertices(
        &mut self,
        mesh: &Mesh,
        affected: &[u32],
        same_attributes: bool,
        update: &mut RenderUpdate,
    ) {
        let corners_at = Arc::clone(&self.corners_at);
        let face_normals = self.face_normals.take();
        let normals_of = LocalNormals::new(mesh, face_normals.as_deref().unwrap_or_default());
        let split = Split { of_corner: CornerFaces::new(mesh), attributes: AttributeComparison::new(mesh) };
        let (mut normals, mut items) = (Vec::new(), Vec::new());
        for &vertex in affected {
            let corners = corners_at.get(vertex);
            normals_of.at_corners(corners, &mut normals);
            let Some((&corner, &normal)) = corners.first().zip(normals.first()) else { continue };
            let shown = self.vertex_of_corner[corner as usize];
            let is_one = |&corner: &u32| self.vertex_of_corner[corner as usize] == shown;
            if same_attributes
                && corners.iter().all(is_one)
                && normals.iter().all(|other| tells_apart(*other) == tells_apart(normal))
            {
                update.vertices.push(UpdatedVertex { vertex: shown, corner, normal });
            } else {
                let pairs = corners.iter().zip(&normals);
                items.clear();
                items.extend(pairs.map(|(&corner, &normal)| CornerValue {
                    corner,
                    normal,
                    before: self.vertex_of_corner[corner as usize],
                    shown: (corner, normal),
                }));
                self.split(&split, &mut items, update);
            }
        }
        self.face_normals = face_normals;
    }

    /// Updates the render vertices of the corners at one vertex: one for all that agreed
    /// before and agree now.
    fn split(&mut self, by: &Split<'_>, items: &mut [CornerValue], update: &mut RenderUpdate) {
        items.sort_unstable_by(|a, b| {
            let values = tells_apart(a.normal).cmp(&tells_apart(b.normal));
            values.then_with(|| by.attributes.order(a.corner, b.corner)).then(a.corner.cmp(&b.corner))
        });
        // All that agree now show the values of the first of them, as when they are welded.
        // (They differ in nothing but the signs of zeros.)
        let agree = |a: &CornerValue, b: &CornerValue| {
            tells_apart(a.normal) == tells_apart(b.normal) && by.attributes.equal(a.corner, b.corner)
        };
        for alike in items.chunk_by_mut(agree) {
            let first = (alike[0].corner, alike[0].normal);
            alike.iter_mut().for_each(|item| item.shown = first);
        }
        items.sort_unstable_by_key(|item| (item.before, item.shown.0, item.corner));
        let mut last = None;
        for alike in items.chunk_by(|a, b| (a.before, a.shown.0) == (b.before, b.shown.0)) {
            let CornerValue { before, shown: (corner, normal), .. } = alike[0];
            // The first of those that agreed before keep their vertex.
            let vertex = if last == Some(before) { self.new_vertex(by, alike, update) } else { before };
            last = Some(before);
            update.vertices.push(UpdatedVertex { vertex, corner, normal });
        }
    }

    /// A render vertex for corners that have had another one.
    fn new_vertex(&mut self, by: &Split<'_>, corners: &[CornerValue], update: &mut RenderUpdate) -> u32 {
        let vertex = self.vertex_count;
        self.vertex_count += 1;
        for item in corners {
            self.vertex_of_corner[item.corner as usize] = vertex;
            update.faces.push(by.of_corner.of(item.corner).0 as u32);
        }
        vertex
    }
}

/// What decides which corners are one vertex.
struct Split<'m> {
    of_corner: CornerFaces<'m>,
    attributes: AttributeComparison<'m>,
}

/// A corner, its normal, its render vertex so far, and the corner whose values that one is
/// to show, with its normal.
struct CornerValue {
    corner: u32,
    normal: Vec3,
    before: u32,
    shown: (u32, Vec3),
}

fn tells_apart(normal: Vec3) -> [u32; 3] {
    bits(normal.to_array())
}

/// Whether a normal counts as "none given here".
fn has_no_direction(normal: Vec3) -> bool {
    unit_keeping(normal) == Vec3::ZERO
}

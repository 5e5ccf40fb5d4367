//! The links between the vertices of a render mesh and its mesh, kept so that changes can be followed, and
//! the values of the corners at a vertex, some of which can still be one render vertex.

use std::sync::Arc;

use rayon::prelude::*;
use trigon_math::Vec3;

use super::mesh_change::IndexSet;
use super::normals::{CornerFaces, FaceNormals, VertexNormals};
use super::{ChangedElements, ELEMENTS_PER_TASK};
use crate::Mesh;
use crate::groups::Groups;
use crate::normals::unit_keeping;
use crate::weld::{AttributeComparison, Welded, bits};

/// How the vertices of a [`RenderMesh`](crate::RenderMesh) or a [`WeldedMesh`](crate::WeldedMesh) come from its mesh. Made
/// by [`RenderMesh::with_links`](crate::RenderMesh::with_links) and
/// [`WeldedMesh::of_flat_with_links`](crate::WeldedMesh::of_flat_with_links).
///
/// Corners of a vertex that no longer agree get render vertices of their own, at the end
/// of the list. Corners that agree again stay apart, so that no render vertex is without a
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
    face_normals: Option<FaceNormals>,
    /// Whether render vertices have no normals, because all polygons are flat and show their own.
    is_flat: bool,
    /// What lies around the elements of the last change.
    around: Neighborhood,
}

/// What of a [`RenderMesh`](crate::RenderMesh) is to be written anew after a change of its
/// mesh; made by [`RenderLinks::follow`].
#[derive(Debug, Clone, Default)]
pub struct RenderUpdate {
    /// Vertices with other values. New ones come last, in the order of their numbers.
    pub vertices: Vec<UpdatedVertex>,
    /// Polygons that may be cut otherwise, or whose corners are other vertices than
    /// before; increasing. See [`Mesh::triangulation_of`](crate::Mesh::triangulation_of): a polygon may have more
    /// or fewer triangles than before.
    pub faces: Vec<u32>,
    /// Polygons that may show another normal than before, increasing, and these normals, of unit length. None unless
    /// the links are those of a [`WeldedMesh::of_flat_with_links`](crate::WeldedMesh::of_flat_with_links).
    pub face_normals: Vec<(u32, Vec3)>,
}

/// A vertex of a [`RenderMesh`](crate::RenderMesh) with other values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UpdatedVertex {
    /// Its number in the render mesh.
    pub vertex: u32,
    /// The corner of the mesh whose position and attributes it shows.
    pub corner: u32,
    /// The shading normal of that corner; of unit length. Zero if vertices have none, because all polygons are flat: see
    /// [`RenderUpdate::face_normals`].
    pub normal: Vec3,
    /// Whether nothing but the normal can have changed.
    pub is_normal_alone: bool,
}

impl RenderLinks {
    /// `is_flat` says that the mesh was welded without normals.
    pub(crate) fn new(mesh: &Mesh, welded: Welded, is_flat: bool) -> Self {
        let corners = mesh.corner_vertices().iter().copied().zip(0u32..);
        let given = mesh.attributes().corner_normals.as_deref();
        let follows = given.is_none_or(|given| given.iter().any(|&normal| has_no_direction(normal)));
        Self {
            vertex_count: welded.corner_of_vertex.len() as u32,
            vertex_of_corner: welded.vertex_of_corner.into_vec(),
            corners_at: Arc::new(Groups::new(mesh.vertex_count(), corners)),
            face_normals: follows.then(|| FaceNormals::new(mesh)),
            is_flat,
            around: Neighborhood::default(),
        }
    }

    /// The render vertex of each corner of the mesh.
    #[must_use]
    pub fn vertex_of_corner(&self) -> &[u32] {
        &self.vertex_of_corner
    }

    /// Finds out what is to be written anew when these elements of the mesh were changed, in time
    /// proportional to what lies around them. `mesh` is the one that these links were made
    /// for, with its new values.
    pub fn follow(&mut self, mesh: &Mesh, changed: &ChangedElements) -> RenderUpdate {
        self.find_face_normals(mesh, changed);
        let has_vertex_normals = self.face_normals.is_some() && !self.is_flat;
        self.around.update(mesh, &self.corners_at, changed, has_vertex_normals);
        let faces = &self.around.faces;
        let mut update = RenderUpdate { faces: self.around.polygons.clone(), ..RenderUpdate::default() };
        if let Some(normals) = &mut self.face_normals {
            normals.update(mesh, faces);
            if self.is_flat {
                update.face_normals = faces.iter().map(|&face| (face, normals.shown(face))).collect();
            }
        }
        self.update_vertices(mesh, &mut update);
        update
    }

    /// Computes the normals of all faces when a corner has lost its own normal.
    fn find_face_normals(&mut self, mesh: &Mesh, changed: &ChangedElements) {
        if self.face_normals.is_some() {
            return;
        }
        let given = mesh.attributes().corner_normals.as_deref().unwrap_or_default();
        let is_lost =
            |&corner: &u32| given.get(corner as usize).is_some_and(|&normal| has_no_direction(normal));
        if changed.corners().iter().any(is_lost) {
            self.face_normals = Some(FaceNormals::new(mesh));
        }
    }

    /// Updates what the corners at affected vertices show.
    fn update_vertices(&mut self, mesh: &Mesh, update: &mut RenderUpdate) {
        let none = FaceNormals::default();
        let face_normals = self.face_normals.as_ref().unwrap_or(&none);
        let normals = (!self.is_flat).then(|| VertexNormals::new(mesh, face_normals));
        let Neighborhood { vertices, moved, corners, .. } = &self.around;
        let values = VertexValues {
            vertex_of_corner: &self.vertex_of_corner,
            corners_at: &self.corners_at,
            normals,
            attributes: AttributeComparison::new(mesh),
            moved,
            has_same_attributes: corners.is_empty(),
        };
        let shown: Vec<ShownVertices> =
            vertices.par_chunks(ELEMENTS_PER_TASK).map(|task| values.at(task)).collect();
        update.vertices.reserve_exact(shown.iter().map(|part| part.retained.len() + part.split.len()).sum());
        shown.iter().for_each(|part| update.vertices.extend_from_slice(&part.retained));
        let corner_faces = CornerFaces::new(mesh);
        let face_count = update.faces.len();
        for split in shown.into_iter().flat_map(|part| part.split) {
            let vertex = self.vertex_count;
            self.vertex_count += 1;
            for corner in split.corners {
                self.vertex_of_corner[corner as usize] = vertex;
                update.faces.push(corner_faces.face_of(corner));
            }
            update.vertices.push(UpdatedVertex { vertex, ..split.shown });
        }
        if update.faces.len() > face_count {
            update.faces.sort_unstable();
            update.faces.dedup();
        }
    }
}

/// The elements of a mesh that a change affects. They follow from which elements were changed and not from
/// their values, so they are found once for a drag that changes the same vertices in each frame.
#[derive(Debug, Clone, Default)]
struct Neighborhood {
    /// The vertices that were moved, increasing.
    moved: Vec<u32>,
    /// The corners with other attributes, increasing.
    corners: Vec<u32>,
    /// The faces with a vertex that was moved, increasing.
    faces: Vec<u32>,
    /// The faces among them that can be cut in more than one way.
    polygons: Vec<u32>,
    /// The vertices at which a corner may show other values, increasing.
    vertices: Vec<u32>,
    /// Whether normals of vertices depend on faces.
    has_vertex_normals: bool,
}

impl Neighborhood {
    /// Takes the place of the one of an earlier change, if that was of other elements.
    fn update(
        &mut self,
        mesh: &Mesh,
        corners_at: &Groups<u32>,
        changed: &ChangedElements,
        has_vertex_normals: bool,
    ) {
        let (moved, corners) = (changed.vertices(), changed.corners());
        if (&self.moved, &self.corners, self.has_vertex_normals) == (&moved, &corners, has_vertex_normals) {
            return;
        }
        let faces = faces_around(mesh, corners_at, &moved);
        let mut vertices = IndexSet::new(mesh.vertex_count());
        moved.iter().for_each(|&vertex| vertices.insert(vertex));
        corners.iter().for_each(|&corner| vertices.insert(mesh.corner_vertices()[corner as usize]));
        if has_vertex_normals {
            let around = faces.iter().flat_map(|&face| mesh.face_vertices(face as usize));
            around.for_each(|&vertex| vertices.insert(vertex));
        }
        let is_polygon = |&face: &u32| mesh.face_corners(face as usize).len() > 3;
        let polygons = faces.iter().copied().filter(is_polygon).collect();
        *self =
            Self { moved, corners, faces, polygons, vertices: vertices.into_sorted(), has_vertex_normals };
    }
}

/// The faces that have one of these vertices, increasing.
fn faces_around(mesh: &Mesh, corners_at: &Groups<u32>, vertices: &[u32]) -> Vec<u32> {
    let corner_faces = CornerFaces::new(mesh);
    let mut faces = IndexSet::new(mesh.face_count());
    let corners = vertices.iter().flat_map(|&vertex| corners_at.get(vertex));
    corners.for_each(|&corner| faces.insert(corner_faces.face_of(corner)));
    faces.into_sorted()
}

/// Whether a normal counts as "none given here".
fn has_no_direction(normal: Vec3) -> bool {
    unit_keeping(normal) == Vec3::ZERO
}

/// What is known of a mesh to find out what its corners show.
pub(super) struct VertexValues<'a> {
    /// The render vertex of each corner.
    pub(super) vertex_of_corner: &'a [u32],
    pub(super) corners_at: &'a Groups<u32>,
    /// `None` if render vertices have no normals.
    pub(super) normals: Option<VertexNormals<'a>>,
    pub(super) attributes: AttributeComparison<'a>,
    /// The vertices that were moved, increasing.
    pub(super) moved: &'a [u32],
    /// Whether corners that were one render vertex can differ in nothing but normals.
    pub(super) has_same_attributes: bool,
}

/// What the corners at some vertices show.
#[derive(Default)]
pub(super) struct ShownVertices {
    /// By render vertices that there are.
    pub(super) retained: Vec<UpdatedVertex>,
    /// By new ones.
    pub(super) split: Vec<SplitOff>,
}

/// Corners that no longer agree with others of their render vertex.
pub(super) struct SplitOff {
    pub(super) corners: Vec<u32>,
    /// What they show; the vertex is still the one that they had.
    pub(super) shown: UpdatedVertex,
}

/// A corner, its normal, its render vertex so far, and the corner whose values that one is
/// to show.
#[derive(Clone, Copy)]
struct CornerValue {
    corner: u32,
    normal: Vec3,
    before: u32,
    shown_corner: u32,
    shown_normal: Vec3,
}

impl VertexValues<'_> {
    /// What is shown at some vertices.
    pub(super) fn at(&self, vertices: &[u32]) -> ShownVertices {
        let mut shown = ShownVertices { retained: Vec::with_capacity(vertices.len()), split: Vec::new() };
        let (mut normals, mut values) = (Vec::new(), Vec::new());
        for &vertex in vertices {
            let corners = self.corners_at.get(vertex);
            match &self.normals {
                Some(of_corners) => of_corners.at_corners(corners, &mut normals),
                None => {
                    normals.clear();
                    normals.resize(corners.len(), Vec3::ZERO);
                }
            }
            if let Some(updated) = self.whole(corners, &normals) {
                let is_normal_alone = self.moved.binary_search(&vertex).is_err();
                shown.retained.push(UpdatedVertex { is_normal_alone, ..updated });
                continue;
            }
            values.clear();
            values.extend(corners.iter().zip(&normals).map(|(&corner, &normal)| CornerValue {
                corner,
                normal,
                before: self.vertex_of_corner[corner as usize],
                shown_corner: corner,
                shown_normal: normal,
            }));
            self.parts(&mut values, &mut shown);
        }
        shown
    }

    /// The render vertex of all corners at a vertex, if they had the same one, can differ in nothing but normals, and
    /// agree in these. Most vertices of most meshes are such.
    fn whole(&self, corners: &[u32], normals: &[Vec3]) -> Option<UpdatedVertex> {
        let (&corner, &normal) = (corners.first()?, normals.first()?);
        let vertex = self.vertex_of_corner[corner as usize];
        let agrees = |(&other, &other_normal): (&u32, &Vec3)| {
            self.vertex_of_corner[other as usize] == vertex
                && normal_bits(other_normal) == normal_bits(normal)
        };
        let is_whole = self.has_same_attributes && corners.iter().zip(normals).all(agrees);
        is_whole.then_some(UpdatedVertex { vertex, corner, normal, is_normal_alone: false })
    }

    /// The render vertices of the corners at one vertex: one for all that agreed before and
    /// agree now.
    fn parts(&self, values: &mut [CornerValue], found: &mut ShownVertices) {
        values.sort_unstable_by(|a, b| {
            let order = normal_bits(a.normal).cmp(&normal_bits(b.normal));
            order.then_with(|| self.attributes.order(a.corner, b.corner)).then(a.corner.cmp(&b.corner))
        });
        // All that agree now show the values of the first of them, as when they are welded.
        // (They differ in nothing but the signs of zeros.)
        let agree = |a: &CornerValue, b: &CornerValue| {
            normal_bits(a.normal) == normal_bits(b.normal) && self.attributes.equal(a.corner, b.corner)
        };
        for alike in values.chunk_by_mut(agree) {
            let CornerValue { corner, normal, .. } = alike[0];
            alike.iter_mut().for_each(|value| (value.shown_corner, value.shown_normal) = (corner, normal));
        }
        values.sort_unstable_by_key(|value| (value.before, value.shown_corner, value.corner));
        let mut last = None;
        let are_one =
            |a: &CornerValue, b: &CornerValue| (a.before, a.shown_corner) == (b.before, b.shown_corner);
        for alike in values.chunk_by(are_one) {
            let CornerValue { before, shown_corner, shown_normal, .. } = alike[0];
            // They may show the values of another corner than before.
            let shown = UpdatedVertex {
                vertex: before,
                corner: shown_corner,
                normal: shown_normal,
                is_normal_alone: false,
            };
            // The first of those that agreed before keep their vertex.
            if last.replace(before) == Some(before) {
                let corners = alike.iter().map(|value| value.corner).collect();
                found.split.push(SplitOff { corners, shown });
            } else {
                found.retained.push(shown);
            }
        }
    }
}

/// What tells normals apart.
fn normal_bits(normal: Vec3) -> [u32; 3] {
    bits(normal.to_array())
}

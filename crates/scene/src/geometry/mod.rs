//! The triangles of a mesh as they are drawn, grouped by material slot.
//!
//! A geometry is created once per mesh, at the mesh's first frame. All nodes that draw the mesh share the geometry.
//! When a few values of the mesh change, `change` updates the geometry.

mod bounds;
mod change;
mod columns;
mod edge_flags;

use std::mem::take;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

use trigon_math::Bounds3;
use trigon_math::glam::Affine3;
use trigon_mesh::{Attributes, Deformed, Mesh, RenderLinks, RenderMesh, WeldedMesh};
use trigon_raster::EdgeFlags;

use crate::work::{Work, note};

use self::columns::mesh_vertices;
use self::edge_flags::{NO_EDGE, sides_of_mesh};
pub(crate) use bounds::{BlockBox, Blocks, StillBounds, box_around, runs_without};
use bounds::{box_of_ranges, range, range_without};
pub(crate) use columns::Columns;
use edge_flags::flags_of_mesh;

/// The number of UV sets that can have tangents: as many as the glTF reader supports. Each set with a normal
/// map takes as much memory as the mesh, and a file may have thousands.
const MOST_TANGENT_SETS: usize = 8;

/// With so many corners a mesh of flat polygons has normals of polygons instead of vertices: a vertex for each
/// corner would take 24 bytes in the mesh and up to 48 in the memory of each frame, and where a vertex moves, those of
/// all corners around would change. Less does not matter. In tests small meshes count as large, for the sake of
/// properties over meshes of a few polygons.
const MANY_CORNERS: usize = if cfg!(test) { 1 << 6 } else { 1 << 16 };

/// A mesh as drawn.
#[derive(Debug)]
pub(crate) struct Geometry {
    pub(crate) columns: Columns,
    /// Vertices, ordered by material slot.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// The polygon of each triangle; `None` if each is the polygon with its number, and all are in one run.
    faces: Option<Vec<u32>>,
    /// The triangles of each slot, in the order of the slots.
    pub(crate) runs: Vec<Run>,
    /// The original position of each triangle in the triangulation; `None` if unchanged.
    order: Option<Vec<u32>>,
    /// Slots of the triangulation whose triangle a change has taken from its face, increasing. The three
    /// corners of such a filler are the same vertex.
    fillers: Vec<u32>,
    /// Different from that of any other geometry, and from its own before a change.
    pub(crate) state: GeometryState,
    bounds: OnceLock<Bounds3>,
    blocks: OnceLock<Blocks>,
    mesh_vertices: OnceLock<Vec<u32>>,
    edge_flags: OnceLock<Vec<EdgeFlags>>,
    /// Shared by poses.
    side_edges: OnceLock<Arc<Vec<[u32; 3]>>>,
    /// The mesh at rest, if a pose can change it.
    rest: Option<Box<RenderMesh>>,
    /// For each of the first UV sets the same with its tangents, created when a normal map on that
    /// set needs them.
    tangential: Vec<OnceLock<Box<Geometry>>>,
    /// The same with normals of vertices, if it has those of polygons and a draw needs the others.
    split: OnceLock<Box<Geometry>>,
    /// How a posed mesh without tangents was deformed, to compute them later.
    pose: Option<GeometryPose>,
    /// The data needed to follow changes of the mesh; `None` until the first one.
    links: Option<RenderLinks>,
    still_bounds: StillBounds,
    /// The difference that the last change made.
    pub(crate) change: Option<GeometryChange>,
}

/// The difference between geometry and its state before a change.
#[derive(Debug)]
pub(crate) struct GeometryChange {
    pub(crate) before: GeometryState,
    /// Vertices whose values changed.
    pub(crate) vertices: Vec<u32>,
    /// Vertices of the mesh that moved.
    pub(crate) mesh_vertices: Vec<u32>,
    /// Triangles whose corners, edge flags or normals of polygons may have changed; increasing.
    pub(crate) triangles: Vec<u32>,
}

/// Identifies geometry in its state at some moment. Data derived from geometry is kept with its
/// state, to recognize it later, and not with the geometry, which is changed in place if it has no
/// other owner.
#[derive(Clone, Debug, Default)]
pub(crate) struct GeometryState(Arc<()>);

impl PartialEq for GeometryState {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// A mesh at rest and how it was deformed.
#[derive(Debug)]
struct GeometryPose {
    rest: Arc<Geometry>,
    weights: Vec<f32>,
    palette: Vec<Affine3>,
}

/// Triangles that share a material slot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Run {
    pub(crate) slot: u32,
    pub(crate) triangles: Range<usize>,
}

/// The triangles of a mesh, in the order of its polygons.
struct MaterialTriangles {
    triangles: Vec<[u32; 3]>,
    /// The polygon of each.
    faces: Vec<u32>,
    /// The material slot of each; empty if the mesh has none.
    slots: Vec<u32>,
}

impl MaterialTriangles {
    /// Takes those of a welded mesh from it.
    fn of_welded(mesh: &mut WeldedMesh) -> Self {
        Self::taken(&mut mesh.triangles, &mut mesh.triangle_faces, &mut mesh.triangle_materials)
    }

    /// Takes those of a render mesh from it.
    fn of_render_mesh(mesh: &mut RenderMesh) -> Self {
        Self::taken(&mut mesh.triangles, &mut mesh.triangle_faces, &mut mesh.triangle_materials)
    }

    fn taken(triangles: &mut Vec<[u32; 3]>, faces: &mut Vec<u32>, slots: &mut Option<Vec<u32>>) -> Self {
        Self { triangles: take(triangles), faces: take(faces), slots: take(slots).unwrap_or_default() }
    }
}

impl Geometry {
    pub(crate) fn new(source: &Mesh) -> Self {
        if let Some((mesh, normals)) = large_flat(source, WeldedMesh::of_flat) {
            return Self::of_welded(mesh, |mesh| Columns::of_flat_faces(source, mesh, normals));
        }
        Self::smooth(source)
    }

    /// With normals of vertices.
    fn smooth(source: &Mesh) -> Self {
        match WeldedMesh::of(source) {
            Some(mesh) => Self::of_welded(mesh, |mesh| Columns::of_welded(source, mesh)),
            None => Self::of(RenderMesh::from_mesh(source)),
        }
    }

    fn of_welded(mut mesh: WeldedMesh, columns: impl FnOnce(WeldedMesh) -> Columns) -> Self {
        let triangles = MaterialTriangles::of_welded(&mut mesh);
        Self::with(triangles, || columns(mesh), None)
    }

    fn of(mut mesh: RenderMesh) -> Self {
        let triangles = MaterialTriangles::of_render_mesh(&mut mesh);
        let rest = mesh.is_deformable().then(|| Box::new(mesh.clone()));
        Self::with(triangles, || Columns::new(mesh), rest)
    }

    fn with(
        MaterialTriangles { mut triangles, mut faces, mut slots }: MaterialTriangles,
        columns: impl FnOnce() -> Columns,
        rest: Option<Box<RenderMesh>>,
    ) -> Self {
        let order = sorted_by_slot(&slots);
        if let Some(order) = &order {
            permute(&mut triangles, order);
            permute(&mut faces, order);
            permute(&mut slots, order);
        }
        let runs = if slots.is_empty() { run_of_all(triangles.len()) } else { runs(&slots) };
        let are_numbers = runs.len() < 2 && faces.iter().copied().eq(0..faces.len() as u32);
        let faces = Some(faces).filter(|_| !are_numbers);
        drop(slots);
        let columns = columns();
        Self {
            tangential: empty_slots(&columns),
            columns,
            runs,
            triangles,
            faces,
            order,
            fillers: Vec::new(),
            rest,
            state: GeometryState::default(),
            bounds: OnceLock::new(),
            blocks: OnceLock::new(),
            mesh_vertices: OnceLock::new(),
            edge_flags: OnceLock::new(),
            side_edges: OnceLock::new(),
            split: OnceLock::new(),
            pose: None,
            links: None,
            still_bounds: StillBounds::default(),
            change: None,
        }
    }

    /// The mesh in a pose; see [`RenderMesh::deform`]. `None` if no pose can change it.
    pub(crate) fn posed(self: &Arc<Self>, weights: &[f32], palette: &[Affine3]) -> Option<Self> {
        let posed = self.deformed(weights, palette)?;
        let pose =
            || GeometryPose { rest: Arc::clone(self), weights: weights.to_vec(), palette: palette.to_vec() };
        Some(Self { pose: self.columns.tangents.is_none().then(pose), ..posed })
    }

    fn deformed(&self, weights: &[f32], palette: &[Affine3]) -> Option<Self> {
        let rest = self.rest.as_ref()?;
        let mut deformed = Deformed::default();
        note(Work::Pose);
        rest.deform(weights, palette, &mut deformed);
        Some(self.with_columns(self.columns.deformed(&deformed)))
    }

    /// The same triangles with other vertex values.
    fn with_columns(&self, columns: Columns) -> Self {
        Self {
            triangles: self.triangles.clone(),
            faces: self.faces.clone(),
            runs: self.runs.clone(),
            order: self.order.clone(),
            fillers: self.fillers.clone(),
            state: GeometryState::default(),
            bounds: OnceLock::new(),
            blocks: OnceLock::new(),
            mesh_vertices: OnceLock::new(),
            edge_flags: self.edge_flags.clone(),
            side_edges: self.side_edges.clone(),
            rest: None,
            tangential: empty_slots(&columns),
            split: OnceLock::new(),
            columns,
            pose: None,
            links: None,
            still_bounds: StillBounds::default(),
            change: None,
        }
    }

    /// The polygon of a triangle.
    #[inline]
    pub(crate) fn face(&self, triangle: usize) -> u32 {
        self.faces.as_ref().map_or(triangle as u32, |faces| faces[triangle])
    }

    /// The polygons of some triangles, of one run or of all. `None` if each is the polygon with its number, the first
    /// of them 0.
    pub(crate) fn faces_of(&self, triangles: Range<usize>) -> Option<&[u32]> {
        self.faces.as_ref().map(|faces| &faces[triangles])
    }

    /// The index in the mesh's triangulation of a triangle of this list.
    pub(crate) fn triangulated(&self, triangle: usize) -> u32 {
        let index = self.index_with_fillers(triangle);
        index - self.fillers.partition_point(|&filler| filler < index) as u32
    }

    /// The same, fillers included.
    fn index_with_fillers(&self, triangle: usize) -> u32 {
        self.order.as_ref().map_or(triangle as u32, |order| order[triangle])
    }

    /// Whether a triangle is a filler.
    fn is_filler(&self, triangle: usize) -> bool {
        self.fillers.binary_search(&self.index_with_fillers(triangle)).is_ok()
    }

    /// Per-triangle data of the triangulation, extended by a value for each filler.
    fn with_fillers<T: Copy>(&self, made: Vec<T>, filler: T) -> Vec<T> {
        let mut fillers = self.fillers.iter().peekable();
        let (count, mut made) = (made.len() + self.fillers.len(), made.into_iter());
        let of = |index: usize| match fillers.next_if(|&&next| next as usize == index) {
            Some(_) => filler,
            None => made.next().unwrap_or(filler),
        };
        if self.fillers.is_empty() { made.collect() } else { (0..count).map(of).collect() }
    }

    /// Takes the fillers from another geometry of the same mesh.
    fn filled_like(mut self, other: &Self) -> Self {
        if !other.fillers.is_empty() {
            let mut own = take(&mut self.triangles).into_iter();
            let of = |index| if other.is_filler(index) { None } else { own.next() };
            self.triangles = (0..other.triangles.len()).map(of).map(Option::unwrap_or_default).collect();
            self.faces.clone_from(&other.faces);
            self.runs.clone_from(&other.runs);
            self.order.clone_from(&other.order);
            self.fillers.clone_from(&other.fillers);
        }
        self
    }

    /// The box around all vertices that faces use.
    pub(crate) fn bounds(&self) -> Bounds3 {
        let bounds = || box_of_ranges(self.columns.positions.each_ref().map(|column| range(column)));
        *self.bounds.get_or_init(bounds)
    }

    /// Boxes around its triangles.
    pub(crate) fn blocks(&self, source: &Mesh) -> &Blocks {
        made_once(&self.blocks, || Blocks::new(source, self))
    }

    /// For each vertex of geometry at rest, a vertex of the mesh at the same position.
    pub(crate) fn mesh_vertices(&self, source: &Mesh) -> &[u32] {
        made_once::<Vec<u32>>(&self.mesh_vertices, || mesh_vertices(source, self))
    }

    /// The mesh for a normal map on a UV set: with its own tangents, or else with tangents of that set. These
    /// are created on first use from the mesh at rest, and a pose moves them along. If the mesh has no such
    /// set, it is returned unchanged, and no normal map is drawn.
    pub(crate) fn with_tangents(&self, source: &Mesh, uv_set: usize) -> &Self {
        let Some(tangential) = self.tangential.get(uv_set).filter(|_| self.columns.tangents.is_none()) else {
            return self;
        };
        made_once::<Box<Self>>(tangential, || {
            if let Some(GeometryPose { rest, weights, palette }) = &self.pose {
                let posed = rest.with_tangents(source, uv_set).deformed(weights, palette);
                return Box::new(posed.expect("tangents take no pose away"));
            }
            let mut mesh = source.clone();
            let corner_tangents = source.generate_tangents(uv_set);
            let attributes = Attributes { corner_tangents, ..source.attributes().clone() };
            mesh.set_attributes(attributes).expect("there is a tangent for each corner");
            Box::new(Self::new(&mesh).filled_like(self))
        })
    }

    /// The mesh with normals of vertices, for light that is computed at these.
    pub(crate) fn with_vertex_normals(&self, source: &Mesh) -> &Self {
        if self.columns.face_normals.is_none() {
            return self;
        }
        made_once::<Box<Self>>(&self.split, || Box::new(Self::smooth(source).filled_like(self)))
    }

    /// For each triangle, which of its sides are edges of its polygon. Computed only for frames
    /// that show edges.
    pub(crate) fn edge_flags(&self, source: &Mesh) -> &[EdgeFlags] {
        self.edge_flags.get_or_init(|| {
            let mut flags = self.with_fillers(flags_of_mesh(source), EdgeFlags::NONE);
            if let Some(order) = &self.order {
                permute(&mut flags, order);
            }
            flags
        })
    }

    /// For each triangle the mesh edges of its sides; `u32::MAX` for diagonals. Computed only for
    /// frames with marked edges: it takes 12 bytes per triangle.
    pub(crate) fn side_edges(&self, source: &Mesh) -> &[[u32; 3]] {
        self.side_edges.get_or_init(|| {
            let mut sides = self.with_fillers(sides_of_mesh(source), [NO_EDGE; 3]);
            if let Some(order) = &self.order {
                permute(&mut sides, order);
            }
            Arc::new(sides)
        })
    }

    /// The same if they have been computed.
    pub(crate) fn sides_if_known(&self) -> Option<&[[u32; 3]]> {
        self.side_edges.get().map(|sides| sides.as_slice())
    }
}

/// What is made of a mesh that has normals of polygons instead of vertices, if it is such: if it is large, and all of its
/// polygons are flat.
fn large_flat<T>(mesh: &Mesh, make: impl FnOnce(&Mesh) -> Option<T>) -> Option<T> {
    let is_large = mesh.corner_count() >= MANY_CORNERS;
    is_large.then(|| make(mesh)).flatten()
}

/// What is in a place, made now if nothing is. All threads may work on it, so there is no lock: while a thread waits for
/// the others, it may be given work that needs the same. Another caller may make its own at the same time; the first one
/// stays.
pub(crate) fn made_once<T>(slot: &OnceLock<T>, make: impl FnOnce() -> T) -> &T {
    if slot.get().is_none() {
        let _ = slot.set(make());
    }
    slot.get().expect("it was just made")
}

/// An empty slot for each UV set that can have tangents.
fn empty_slots(columns: &Columns) -> Vec<OnceLock<Box<Geometry>>> {
    columns.uv_sets.iter().take(MOST_TANGENT_SETS).map(|_| OnceLock::new()).collect()
}

/// The order that groups triangles by slot and keeps their order within one;
/// `None` when they are in that order already.
fn sorted_by_slot(slots: &[u32]) -> Option<Vec<u32>> {
    if slots.is_sorted() {
        return None;
    }
    let mut order: Vec<u32> = (0..slots.len() as u32).collect();
    order.sort_by_key(|&triangle| slots[triangle as usize]);
    Some(order)
}

fn permute<T: Copy>(items: &mut Vec<T>, order: &[u32]) {
    *items = order.iter().map(|&from| items[from as usize]).collect();
}

fn run_of_all(triangles: usize) -> Vec<Run> {
    (triangles > 0).then_some(Run { slot: 0, triangles: 0..triangles }).into_iter().collect()
}

fn runs(slots: &[u32]) -> Vec<Run> {
    let mut start = 0;
    let run = |chunk: &[u32]| {
        let triangles = start..start + chunk.len();
        start = triangles.end;
        Run { slot: chunk[0], triangles }
    };
    slots.chunk_by(|a, b| a == b).map(run).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_are_grouped_by_slot_in_stable_order() {
        assert_eq!(sorted_by_slot(&[0, 0, 1]), None, "in order already");
        let order = sorted_by_slot(&[2, 0, 2, 1, 0]).expect("out of order");
        assert_eq!(order, [1, 4, 3, 0, 2], "grouped, and stable within a slot");
        let grouped = runs(&[0, 0, 1, 2, 2]);
        let expected = [(0, 0..2), (1, 2..3), (2, 3..5)].map(|(slot, triangles)| Run { slot, triangles });
        assert_eq!(grouped, expected, "one run a slot");
    }
}

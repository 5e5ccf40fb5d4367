//! A mesh as it is drawn: triangles grouped by material slot.
//!
//! Made once per mesh, at its first picture, and shared by all nodes that draw
//! the mesh.

use std::mem::take;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

use trigon_math::glam::Affine3;
use trigon_math::{Bounds3, Vec3};
use trigon_mesh::{Attributes, Deformed, Mesh, RenderMesh};
use trigon_raster::EdgeFlags;

use super::columns::Columns;

/// The UV sets for which tangents are made: as many as the glTF reader takes. Each set
/// with a normal map takes as much memory as the mesh, and a file may have thousands.
const MOST_TANGENT_SETS: usize = 8;

/// A mesh as it is drawn.
#[derive(Debug)]
pub(crate) struct Geometry {
    pub(crate) columns: Columns,
    /// Vertices, ordered by material slot.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// The polygon that each triangle is a part of.
    pub(crate) faces: Vec<u32>,
    /// The triangles of each slot, in the order of the slots.
    pub(crate) runs: Vec<Run>,
    /// Where each triangle was in the triangulation; `None` when in place.
    order: Option<Vec<u32>>,
    bounds: OnceLock<Bounds3>,
    edge_flags: OnceLock<Vec<EdgeFlags>>,
    /// The mesh at rest, if a pose can change it.
    rest: Option<Box<RenderMesh>>,
    /// For each of the first UV sets the same with its tangents, made when a normal map
    /// on that set asks for them.
    tangential: Vec<OnceLock<Box<Geometry>>>,
    /// How a posed mesh without tangents came about, to make them.
    pose: Option<Pose>,
}

/// A mesh at rest and how it was deformed.
#[derive(Debug)]
struct Pose {
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

impl Geometry {
    pub(crate) fn new(source: &Mesh) -> Self {
        let mut mesh = RenderMesh::from_mesh(source);
        let order = sorted_by_slot(&mesh.triangle_materials);
        if let Some(order) = &order {
            permute(&mut mesh.triangles, order);
            permute(&mut mesh.triangle_faces, order);
            permute(&mut mesh.triangle_materials, order);
        }
        let runs = runs(&mesh.triangle_materials);
        let (triangles, faces) = (take(&mut mesh.triangles), take(&mut mesh.triangle_faces));
        let columns = Columns::new(&mesh);
        Self {
            tangential: places_for(&columns),
            columns,
            runs,
            triangles,
            faces,
            order,
            rest: mesh.is_deformable().then(|| Box::new(mesh)),
            bounds: OnceLock::new(),
            edge_flags: OnceLock::new(),
            pose: None,
        }
    }

    /// The mesh in a pose; see [`RenderMesh::deform`]. `None` when no pose can
    /// change it.
    pub(crate) fn posed(self: &Arc<Self>, weights: &[f32], palette: &[Affine3]) -> Option<Self> {
        let posed = self.deformed(weights, palette)?;
        let pose = || Pose { rest: Arc::clone(self), weights: weights.to_vec(), palette: palette.to_vec() };
        Some(Self { pose: self.columns.tangents.is_none().then(pose), ..posed })
    }

    fn deformed(&self, weights: &[f32], palette: &[Affine3]) -> Option<Self> {
        let rest = self.rest.as_ref()?;
        let mut deformed = Deformed::default();
        rest.deform(weights, palette, &mut deformed);
        Some(Self {
            columns: self.columns.deformed(&deformed),
            triangles: self.triangles.clone(),
            faces: self.faces.clone(),
            runs: self.runs.clone(),
            order: self.order.clone(),
            bounds: OnceLock::new(),
            edge_flags: self.edge_flags.clone(),
            rest: None,
            tangential: places_for(&self.columns),
            pose: None,
        })
    }

    /// The index in the mesh's triangulation of a triangle of this list.
    pub(crate) fn triangulated(&self, triangle: usize) -> u32 {
        self.order.as_ref().map_or(triangle as u32, |order| order[triangle])
    }

    /// The box around all vertices that faces use.
    pub(crate) fn bounds(&self) -> Bounds3 {
        *self.bounds.get_or_init(|| {
            let [x, y, z] = &self.columns.positions;
            let vertices = x.iter().zip(y).zip(z);
            Bounds3::from_points(vertices.map(|((&x, &y), &z)| Vec3::new(x, y, z).as_dvec3()))
        })
    }

    /// The mesh as a normal map on a UV set needs it: with the tangents that it
    /// has, or else with tangents of that set made at the first use, of the mesh at
    /// rest: a pose moves them along. The mesh as it is where there is no such set: no
    /// normal map is drawn on it.
    pub(crate) fn with_tangents(&self, source: &Mesh, uv_set: usize) -> &Self {
        let Some(tangential) = self.tangential.get(uv_set).filter(|_| self.columns.tangents.is_none()) else {
            return self;
        };
        tangential.get_or_init(|| {
            if let Some(Pose { rest, weights, palette }) = &self.pose {
                let posed = rest.with_tangents(source, uv_set).deformed(weights, palette);
                return Box::new(posed.expect("tangents take no pose away"));
            }
            let mut mesh = source.clone();
            let corner_tangents = source.generate_tangents(uv_set);
            let attributes = Attributes { corner_tangents, ..source.attributes().clone() };
            mesh.set_attributes(attributes).expect("there is a tangent for each corner");
            Box::new(Self::new(&mesh))
        })
    }

    /// For each triangle, which of its edges are edges of its polygon. Only
    /// pictures that show edges ask for it.
    pub(crate) fn edge_flags(&self, source: &Mesh) -> &[EdgeFlags] {
        self.edge_flags.get_or_init(|| {
            let mut flags = polygon_edges(source);
            if let Some(order) = &self.order {
                permute(&mut flags, order);
            }
            flags
        })
    }
}

/// An empty place for each UV set that can have tangents.
fn places_for(columns: &Columns) -> Vec<OnceLock<Box<Geometry>>> {
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

fn runs(slots: &[u32]) -> Vec<Run> {
    let mut start = 0;
    let run = |chunk: &[u32]| {
        let triangles = start..start + chunk.len();
        start = triangles.end;
        Run { slot: chunk[0], triangles }
    };
    slots.chunk_by(|a, b| a == b).map(run).collect()
}

/// An edge of a triangle is an edge of its polygon when it joins neighbouring
/// corners; all others are diagonals of the triangulation. With them goes how much larger
/// the polygon is than the triangle shows.
fn polygon_edges(source: &Mesh) -> Vec<EdgeFlags> {
    let triangulation = source.triangulation();
    let faces = triangulation.triangle_faces.chunk_by(|a, b| a == b);
    let mut flags = Vec::with_capacity(triangulation.triangles.len());
    let mut rest = triangulation.triangles.as_slice();
    for face in faces {
        let (triangles, others) = rest.split_at(face.len());
        rest = others;
        let corners = source.face_corners(face[0] as usize);
        let (first, last) = (corners.start as u32, corners.end as u32 - 1);
        let neighbours = |from: u32, to: u32| to == if from == last { first } else { from + 1 };
        let edges = |&[a, b, c]: &[u32; 3]| [(a, b), (b, c), (c, a)].map(|(from, to)| neighbours(from, to));
        let parts = triangles.iter().map(|triangle| (triangle, edges(triangle)));
        if let [_] = triangles {
            flags.extend(parts.map(|(_, edges)| EdgeFlags::new(edges)));
            continue;
        }
        let measures = parts.clone().map(|(triangle, edges)| Measure::new(source, triangle, edges));
        let whole = measures.clone().fold(Measure::default(), Measure::sum);
        flags.extend(parts.zip(measures).map(|((_, edges), part)| {
            // In the middle of a polygon there are no edges.
            let own = if part.edges > 0.0 { part.edges } else { part.perimeter };
            // Without an area it is no number, and so ignored.
            let ratio = (whole.area * own) / (part.area * whole.edges);
            EdgeFlags::new(edges).with_radius_ratio(ratio as f32)
        }));
    }
    flags
}

/// How large triangles of a polygon are.
#[derive(Clone, Copy, Default)]
struct Measure {
    /// Twice the area.
    area: f64,
    perimeter: f64,
    /// The length of those sides that are edges of the polygon.
    edges: f64,
}

impl Measure {
    fn new(source: &Mesh, triangle: &[u32; 3], edges: [bool; 3]) -> Self {
        let position = |corner: u32| source.positions()[source.corner_vertices()[corner as usize] as usize];
        let [a, b, c] = triangle.map(|corner| position(corner).as_dvec3());
        let sides = [b - a, c - b, a - c];
        let lengths = sides.map(|side| side.length());
        let of_edges = lengths.iter().zip(edges).filter(|(_, is_edge)| *is_edge);
        Self {
            area: sides[0].cross(sides[1]).length(),
            perimeter: lengths.iter().sum(),
            edges: of_edges.map(|(length, _)| length).sum(),
        }
    }

    fn sum(self, other: Self) -> Self {
        Self {
            area: self.area + other.area,
            perimeter: self.perimeter + other.perimeter,
            edges: self.edges + other.edges,
        }
    }
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

    #[test]
    fn a_cube_shows_twelve_edges_and_no_diagonal() {
        let cube = trigon_mesh::primitives::cube(1.0);
        let flags = polygon_edges(&cube);
        let shown: usize =
            flags.iter().map(|flags| (0..3).filter(|&edge| flags.contains(edge)).count()).sum();
        assert_eq!((flags.len(), shown), (12, 24), "each edge is seen from its two faces");
    }
}

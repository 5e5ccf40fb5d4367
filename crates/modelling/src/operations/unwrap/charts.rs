//! Charts: the connected parts of a surface that are laid out one by one, with their vertices cut open along
//! the borders of each.

use trigon_math::{DVec2, DVec3, DisjointSets, Vec3};
use trigon_mesh::Triangulator;

use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId};
use crate::numbering::{Numbering, sorted_once};

/// The least height of a triangle in relation to its longest side. Flatter ones are laid out with this height,
/// so that no weight is infinite.
const LEAST_HEIGHT: f64 = 1e-6;

/// A connected part of a surface: a manifold with orientation, cut into triangles. Vertices of the mesh where
/// it is cut occur several times.
#[derive(Debug, Default)]
pub(super) struct UvChart {
    /// Its corners in the mesh, and the vertex of the chart at each.
    pub(super) corners: Vec<ChartCorner>,
    /// The positions of its vertices, relative to the first and divided by `size`: within −1…1.
    pub(super) points: Vec<DVec3>,
    /// Its greatest extent along an axis, in metres; 1 if that is zero.
    pub(super) size: f64,
    /// Triangles, counter-clockwise seen from outside.
    pub(super) triangles: Vec<[u32; 3]>,
    /// The closed loops of its border, with the surface on the left.
    pub(super) loops: Vec<Vec<u32>>,
    /// Vertices that less stretch leaves where they are; none without pins.
    pub(super) held: Vec<u32>,
}

/// A corner of a chart.
#[derive(Debug, Clone, Copy)]
pub(super) struct ChartCorner {
    pub(super) corner: CornerId,
    pub(super) vertex: u32,
}

/// The shape of a triangle, laid flat: its first vertex at the origin, its second on the positive x axis, its
/// third above.
#[derive(Debug, Clone, Copy)]
pub(super) struct FlatTriangle {
    pub(super) vertices: [u32; 3],
    pub(super) points: [DVec2; 3],
}

impl FlatTriangle {
    /// Twice its area, above 0.
    pub(super) fn double_area(&self) -> f64 {
        self.points[1].x * self.points[2].y
    }

    fn new(vertices: [u32; 3], corners: [DVec3; 3]) -> Self {
        let [first, second, third] = corners;
        let (along, to_third) = (second - first, third - first);
        let longest = along.length().max(to_third.length()).max((third - second).length());
        // An edge without length points anywhere.
        let length = along.length().max(LEAST_HEIGHT * longest.max(LEAST_HEIGHT));
        let x = along.dot(to_third) / length;
        let height = along.cross(to_third).length() / length;
        let least = LEAST_HEIGHT * longest.max(LEAST_HEIGHT);
        let points = [DVec2::ZERO, DVec2::new(length, 0.0), DVec2::new(x, height.max(least))];
        Self { vertices, points }
    }
}

impl UvChart {
    /// Its triangles, each laid flat for itself.
    pub(super) fn flat_triangles(&self) -> Vec<FlatTriangle> {
        let flat = |&vertices: &[u32; 3]| {
            FlatTriangle::new(vertices, vertices.map(|vertex| self.points[vertex as usize]))
        };
        self.triangles.iter().map(flat).collect()
    }

    /// Whether it can be laid flat without overlaps in principle: it has a border and no handles.
    pub(super) fn is_disc_with_holes(&self) -> bool {
        let border: usize = self.loops.iter().map(Vec::len).sum();
        let edges = (3 * self.triangles.len() + border) / 2;
        let characteristic = (self.points.len() + self.triangles.len()) as i64 - edges as i64;
        !self.loops.is_empty() && characteristic == 2 - self.loops.len() as i64
    }

    /// The edges of its border.
    pub(super) fn border_edges(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        self.loops.iter().flat_map(|border| {
            let next = border.iter().skip(1).chain(border.first());
            border.iter().zip(next).map(|(&from, &to)| [from, to])
        })
    }

    /// The area of all triangles in a layout, whichever way they wind.
    pub(super) fn layout_area(&self, layout: &[DVec2]) -> f64 {
        let double = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|vertex| layout[vertex as usize]);
            (b - a).perp_dot(c - a).abs()
        };
        self.triangles.iter().map(double).sum::<f64>() / 2.0
    }

    /// Its area, in square metres.
    pub(super) fn area(&self) -> f64 {
        let double: f64 = self.flat_triangles().iter().map(FlatTriangle::double_area).sum();
        double / 2.0 * self.size * self.size
    }
}

/// The corners of some faces, by number, and what is joined of them.
struct Joined {
    corners: Vec<CornerId>,
    /// By corner: the number of its face.
    faces: Vec<u32>,
    numbering: Numbering,
    /// By corner: the position in `corners` that belongs to each number of `numbering`.
    order: Vec<u32>,
    /// By corner: whether its edge joins two faces of a chart.
    is_joined: Vec<bool>,
    vertex_sets: DisjointSets,
    face_sets: DisjointSets,
}

/// The charts of faces, in the order of their first faces. Two faces belong together at an edge where exactly
/// these two of the given faces meet in opposite directions, and which the function accepts.
pub(super) fn charts(
    mesh: &EditMesh,
    faces: &[FaceId],
    joins: impl Fn(EdgeId, [CornerId; 2]) -> bool,
) -> Vec<UvChart> {
    let faces = sorted_once(faces.to_vec());
    let mut joined = Joined::new(mesh, &faces);
    joined.join(mesh, joins);
    joined.into_charts(mesh, &faces)
}

impl Joined {
    fn new(mesh: &EditMesh, faces: &[FaceId]) -> Self {
        let (mut corners, mut face_of) = (Vec::new(), Vec::new());
        for (number, &face) in (0..).zip(faces) {
            corners.extend(mesh.face_corners(face));
            face_of.resize(corners.len(), number);
        }
        let mut order: Vec<u32> = (0..corners.len() as u32).collect();
        order.sort_unstable_by_key(|&position| corners[position as usize]);
        let sorted: Vec<u32> = order.iter().map(|&position| corners[position as usize].index()).collect();
        let numbering = Numbering::new(&sorted, mesh.corner_capacity());
        let count = corners.len();
        Self {
            corners,
            faces: face_of,
            numbering,
            order,
            is_joined: vec![false; count],
            vertex_sets: DisjointSets::new(count),
            face_sets: DisjointSets::new(faces.len()),
        }
    }

    /// The number of a corner, if it is one of a given face.
    fn number(&self, corner: CornerId) -> Option<u32> {
        self.numbering.get(corner.index()).map(|number| self.order[number])
    }

    fn join(&mut self, mesh: &EditMesh, joins: impl Fn(EdgeId, [CornerId; 2]) -> bool) {
        let edges = self.corners.iter().map(|&corner| mesh.corner_edge(corner)).collect();
        for edge in sorted_once(edges) {
            let mut there = mesh.edge_corners(edge).filter(|&corner| self.number(corner).is_some());
            let (Some(a), Some(b), None) = (there.next(), there.next(), there.next()) else { continue };
            if mesh.corner_vertex(a) == mesh.corner_vertex(b) || !joins(edge, [a, b]) {
                continue;
            }
            let number = |corner| self.number(corner).expect("corners of given faces are numbered");
            let [from, to] = [a, b].map(number);
            let [after_from, after_to] = [a, b].map(|corner| number(mesh.next_corner(corner)));
            self.vertex_sets.join(from, after_to);
            self.vertex_sets.join(to, after_from);
            self.face_sets.join(self.faces[from as usize], self.faces[to as usize]);
            self.is_joined[from as usize] = true;
            self.is_joined[to as usize] = true;
        }
    }

    fn into_charts(mut self, mesh: &EditMesh, faces: &[FaceId]) -> Vec<UvChart> {
        let mut chart_of = vec![u32::MAX; faces.len()];
        let mut parts: Vec<Part> = Vec::new();
        // By corner that is the least of its set: the vertex of the chart.
        let mut vertex_of = vec![u32::MAX; self.corners.len()];
        let (mut first, mut polygon) = (0, Polygon::default());
        for (number, &face) in faces.iter().enumerate() {
            let root = self.face_sets.root(number as u32) as usize;
            if chart_of[root] == u32::MAX {
                chart_of[root] = parts.len() as u32;
                parts.push(Part::default());
            }
            let part = &mut parts[chart_of[root] as usize];
            let size = mesh.face_size(face);
            polygon.vertices.clear();
            for position in first..first + size {
                let set = self.vertex_sets.root(position as u32) as usize;
                let corner = self.corners[position];
                if vertex_of[set] == u32::MAX {
                    vertex_of[set] = part.positions.len() as u32;
                    part.positions.push(mesh.position(mesh.corner_vertex(corner)));
                }
                part.chart.corners.push(ChartCorner { corner, vertex: vertex_of[set] });
                polygon.vertices.push(vertex_of[set]);
            }
            part.add_face(&mut polygon, &self.is_joined[first..first + size]);
            first += size;
        }
        parts.into_iter().map(Part::finish).collect()
    }
}

/// Memory for one face after another.
#[derive(Default)]
struct Polygon {
    vertices: Vec<u32>,
    positions: Vec<Vec3>,
    triangulator: Triangulator,
    triangles: Vec<[u32; 3]>,
}

/// A chart that is being made.
#[derive(Default)]
struct Part {
    chart: UvChart,
    positions: Vec<Vec3>,
    border: Vec<[u32; 2]>,
}

impl Part {
    fn add_face(&mut self, polygon: &mut Polygon, is_joined: &[bool]) {
        let Polygon { vertices, positions, triangulator, triangles } = polygon;
        positions.clear();
        positions.extend(vertices.iter().map(|&vertex| self.positions[vertex as usize]));
        triangles.clear();
        triangulator.complete_polygon(positions, triangles);
        let named = |triangle: &[u32; 3]| triangle.map(|index| vertices[index as usize]);
        self.chart.triangles.extend(triangles.iter().map(named));
        for (i, _) in is_joined.iter().enumerate().filter(|(_, is_joined)| !**is_joined) {
            self.border.push([vertices[i], vertices[(i + 1) % vertices.len()]]);
        }
    }

    fn finish(mut self) -> UvChart {
        let points: Vec<DVec3> = self.positions.iter().map(|position| position.as_dvec3()).collect();
        let (mut low, mut high) = (points[0], points[0]);
        for &point in &points {
            (low, high) = (low.min(point), high.max(point));
        }
        let extent = (high - low).max_element();
        self.chart.size = if extent > 0.0 { extent } else { 1.0 };
        self.chart.points = points.iter().map(|&point| (point - points[0]) / self.chart.size).collect();
        self.chart.loops = loops(&self.border, points.len());
        self.chart
    }
}

/// The closed loops of edges of which each vertex begins at most one.
fn loops(border: &[[u32; 2]], vertices: usize) -> Vec<Vec<u32>> {
    let mut next = vec![u32::MAX; vertices];
    border.iter().for_each(|&[from, to]| next[from as usize] = to);
    let mut loops = Vec::new();
    for &[from, _] in border {
        let mut here = from;
        let mut found = Vec::new();
        while next[here as usize] != u32::MAX {
            found.push(here);
            here = std::mem::replace(&mut next[here as usize], u32::MAX);
        }
        if !found.is_empty() {
            loops.push(found);
        }
    }
    loops
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_mesh::primitives;

    use super::*;
    use crate::tests::meshes;

    fn by_seams(mesh: &EditMesh) -> Vec<UvChart> {
        let faces: Vec<FaceId> = mesh.faces().collect();
        charts(mesh, &faces, |edge, _| !mesh.is_seam(edge))
    }

    #[test]
    fn a_seam_along_a_cylinder_makes_a_disc_of_its_side() {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::cylinder(1.0, 2.0, 8));
        assert!(!by_seams(&mesh)[0].is_disc_with_holes(), "it is closed");
        let is_rim = |mesh: &EditMesh, edge| {
            let [a, b] = mesh.edge_vertices(edge).map(|vertex| mesh.position(vertex).y);
            a == b
        };
        let rims: Vec<EdgeId> = mesh.edges().filter(|&edge| is_rim(&mesh, edge)).collect();
        mesh.mark_seams(&rims).expect("they exist");
        let sizes = |mesh: &EditMesh| -> Vec<[usize; 3]> {
            let of = |chart: UvChart| [chart.points.len(), chart.loops.len(), chart.triangles.len()];
            let mut sizes: Vec<[usize; 3]> = by_seams(mesh).into_iter().map(of).collect();
            sizes.sort_unstable();
            sizes
        };
        assert_eq!(sizes(&mesh), [[8, 1, 6], [8, 1, 6], [16, 2, 16]], "two caps and a tube");
        let side = mesh.edges().find(|&edge| !is_rim(&mesh, edge)).expect("there are eight");
        mesh.mark_seams(&[side]).expect("it exists");
        assert_eq!(sizes(&mesh), [[8, 1, 6], [8, 1, 6], [18, 1, 16]], "two vertices more, and one loop");
        assert!(by_seams(&mesh).iter().all(UvChart::is_disc_with_holes), "all can be laid flat");
    }

    #[test]
    fn a_torus_has_a_handle_until_it_is_cut_twice() {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::torus(2.0, 0.5, 6, 5));
        let face = mesh.faces().next().expect("thirty");
        let rest: Vec<FaceId> = mesh.faces().skip(1).collect();
        let punctured = charts(&mesh, &rest, |_, _| true);
        assert_eq!(punctured[0].loops.len(), 1, "a hole");
        assert!(!punctured[0].is_disc_with_holes(), "and a handle");
        for edge in mesh.face_edges(face).take(1).collect::<Vec<_>>() {
            mesh.mark_seams(&[edge]).expect("it exists");
        }
        assert!(!by_seams(&mesh)[0].is_disc_with_holes(), "a slit opens no handle");
    }

    proptest! {
        /// Each corner is in one chart; all charts together have the border that the faces have, and each edge
        /// of a triangle occurs once in its direction.
        #[test]
        fn charts_are_manifolds(start in meshes(), bits in any::<u64>()) {
            let (mut mesh, _) = EditMesh::from_mesh(&start);
            let seams: Vec<EdgeId> = mesh.edges().filter(|edge| bits >> (edge.index() % 64) & 1 != 0).collect();
            if !seams.is_empty() {
                mesh.mark_seams(&seams).expect("they exist");
            }
            let charts = by_seams(&mesh);
            let mut corners: Vec<CornerId> =
                charts.iter().flat_map(|chart| chart.corners.iter().map(|corner| corner.corner)).collect();
            corners.sort_unstable();
            prop_assert_eq!(corners, mesh.corners().collect::<Vec<_>>());
            for chart in &charts {
                let mut directed: Vec<[u32; 2]> = chart
                    .triangles
                    .iter()
                    .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
                    .collect();
                let border: Vec<[u32; 2]> = chart.border_edges().collect();
                directed.extend(border.iter().map(|&[a, b]| [b, a]));
                // Each edge and its opposite, once for each of the two sides.
                let mut opposite: Vec<[u32; 2]> = directed.iter().map(|&[a, b]| [b, a]).collect();
                directed.sort_unstable();
                opposite.sort_unstable();
                prop_assert_eq!(directed, opposite);
                prop_assert!(chart.points.iter().all(|point| point.abs().max_element() <= 1.0));
            }
        }
    }
}

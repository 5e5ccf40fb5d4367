//! Texture coordinates on a line: all on an upright or level one, or each chain on the line between its ends.

use std::collections::BTreeMap;

use trigon_math::{DAffine2, DMat2, DVec2, Vec2};

use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId};
use crate::refusal::Refusal;

const OPERATION: &str = "straightening texture coordinates";

/// The line to which texture coordinates come, through the middle of the box around them.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize, schemars::JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum UvAlignment {
    /// The upright or the level one, whichever is closer.
    #[default]
    Auto,
    /// The upright one: all get the same x.
    X,
    /// The level one: all get the same y.
    Y,
}

/// What was straightened.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Straightened {
    /// How many chains are straight now.
    pub chains: usize,
    /// How many groups of edges have not exactly two ends, or both at one point, and are unchanged.
    pub left_out: usize,
}

/// Corners that share a vertex and texture coordinates: the vertex, and the bits of the coordinates.
type Key = (u32, [u32; 2]);

/// Such corners, and the numbers of those beside them.
struct ChainPoint {
    corner: CornerId,
    uv: Vec2,
    beside: Vec<usize>,
}

impl EditMesh {
    /// Moves the texture coordinates of corners to one line.
    ///
    /// # Errors
    /// There is no such set, or coordinates are not finite.
    pub fn align_uvs(&mut self, uv_set: usize, corners: &[CornerId], to: UvAlignment) -> Result<(), Refusal> {
        let uvs = || corners.iter().filter_map(|&corner| self.uv(uv_set, corner)).map(|uv| uv.as_dvec2());
        let low = uvs().fold(DVec2::INFINITY, DVec2::min);
        let size = uvs().fold(DVec2::NEG_INFINITY, DVec2::max) - low;
        let center = if corners.is_empty() { DVec2::ZERO } else { low + size / 2.0 };
        let is_upright = match to {
            UvAlignment::Auto => size.x <= size.y,
            UvAlignment::X => true,
            UvAlignment::Y => false,
        };
        let factors = if is_upright { DVec2::Y } else { DVec2::X };
        let map =
            DAffine2 { matrix2: DMat2::from_diagonal(factors), translation: center * (DVec2::ONE - factors) };
        self.transform_uvs(uv_set, corners, &map)
    }

    /// Projects the texture coordinates along chains of edges onto the line between the ends of each, which stay. On a
    /// seam each side is a chain of its own; corners that share coordinates with one of a chain go with it.
    ///
    /// # Errors
    /// No edge is given, one does not exist; there is no such set; coordinates are not finite; or no group of edges has
    /// two ends.
    pub fn straighten_uvs(&mut self, uv_set: usize, edges: &[EdgeId]) -> Result<Straightened, Refusal> {
        let not_possible = |reason| Err(Refusal::NotPossible { operation: OPERATION, reason });
        self.check_edges(edges, OPERATION)?;
        if uv_set >= self.uv_set_count() {
            return not_possible("there are no such texture coordinates; unwrap the faces first");
        }
        let points = self.chain_points(uv_set, edges);
        if !points.iter().all(|point| point.uv.is_finite()) {
            return not_possible("a texture coordinate is not finite; unwrap the faces first");
        }
        let mut straightened = Straightened::default();
        let mut visited = vec![false; points.len()];
        for first in 0..points.len() {
            if visited[first] {
                continue;
            }
            let group = group(&points, first, &mut visited);
            match self.straighten(uv_set, &points, &group) {
                Some(()) => straightened.chains += 1,
                None => straightened.left_out += 1,
            }
        }
        if straightened.chains == 0 {
            return not_possible("no group of edges is a chain with two ends; select one without branches");
        }
        Ok(straightened)
    }

    /// The ends of edges in the image, in the order in which edges reach them.
    fn chain_points(&self, uv_set: usize, edges: &[EdgeId]) -> Vec<ChainPoint> {
        let (mut numbers, mut points) = (BTreeMap::<Key, usize>::new(), Vec::<ChainPoint>::new());
        let mut number = |corner: CornerId, points: &mut Vec<ChainPoint>| {
            // The sum turns −0 into 0.
            let uv = self.uv(uv_set, corner).expect("the set exists") + Vec2::ZERO;
            let key = (self.corner_vertex(corner).0, uv.to_array().map(f32::to_bits));
            *numbers.entry(key).or_insert_with(|| {
                points.push(ChainPoint { corner, uv, beside: Vec::new() });
                points.len() - 1
            })
        };
        for corner in edges.iter().flat_map(|&edge| self.edge_corners(edge)) {
            let [from, to] = [corner, self.next_corner(corner)].map(|end| number(end, &mut points));
            for [here, there] in [[from, to], [to, from]] {
                if !points[here].beside.contains(&there) {
                    points[here].beside.push(there);
                }
            }
        }
        points
    }

    /// Projects a group of points; `None` if it is no chain.
    fn straighten(&mut self, uv_set: usize, points: &[ChainPoint], group: &[usize]) -> Option<()> {
        let ends: Vec<usize> =
            group.iter().copied().filter(|&point| points[point].beside.len() == 1).collect();
        let &[start, end] = &ends[..] else { return None };
        let [start, end] = [start, end].map(|point| points[point].uv.as_dvec2());
        let along = end - start;
        if along == DVec2::ZERO || !group.iter().all(|&point| points[point].beside.len() <= 2) {
            return None;
        }
        for point in group.iter().copied().filter(|point| !ends.contains(point)) {
            let ChainPoint { corner, uv, .. } = points[point];
            let position = (uv.as_dvec2() - start).dot(along) / along.length_squared();
            let projected = (start + along * position).as_vec2();
            let beside = self.vertex_corners(self.corner_vertex(corner));
            let shared: Vec<CornerId> = beside.filter(|&other| self.uv(uv_set, other) == Some(uv)).collect();
            shared.into_iter().for_each(|corner| self.set_uv(uv_set, corner, projected));
        }
        Some(())
    }
}

/// The points that hang together with one.
fn group(points: &[ChainPoint], first: usize, visited: &mut [bool]) -> Vec<usize> {
    let mut group = vec![first];
    visited[first] = true;
    let mut next = 0;
    while let Some(&point) = group.get(next) {
        next += 1;
        for &beside in &points[point].beside {
            if !std::mem::replace(&mut visited[beside], true) {
                group.push(beside);
            }
        }
    }
    group
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::SplitMix64;
    use trigon_mesh::primitives;

    use super::*;
    use crate::tests::check_operation;
    use crate::{UvElements, VertexId};

    /// A grid with random coordinates at each vertex, and the edges along one of its rows.
    struct Row {
        mesh: EditMesh,
        edges: Vec<EdgeId>,
        vertices: Vec<VertexId>,
    }

    fn row(seed: u64, length: usize) -> Row {
        let mut random = SplitMix64::new(seed);
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::grid(6.0, 6.0, 6, 6));
        mesh.add_uv_set(0).expect("room");
        for vertex in mesh.vertices().collect::<Vec<_>>() {
            let uv = Vec2::new(random.unit() as f32, random.unit() as f32);
            mesh.vertex_corners(vertex)
                .collect::<Vec<_>>()
                .into_iter()
                .for_each(|corner| mesh.set_uv(0, corner, uv));
        }
        let mut vertices: Vec<VertexId> =
            mesh.vertices().filter(|&vertex| mesh.position(vertex).z.abs() < 1e-3).collect();
        vertices.sort_by(|&a, &b| mesh.position(a).x.total_cmp(&mesh.position(b).x));
        vertices.truncate(length + 1);
        let edges =
            vertices.windows(2).map(|pair| mesh.find_edge(pair[0], pair[1]).expect("a row")).collect();
        Row { mesh, edges, vertices }
    }

    /// In the faces on one side of the row.
    fn uv_of(mesh: &EditMesh, vertex: VertexId, side: f32) -> DVec2 {
        let is_there = |corner: &CornerId| {
            mesh.face_vertices(mesh.corner_face(*corner)).any(|vertex| mesh.position(vertex).z * side > 0.5)
        };
        let corner = mesh.vertex_corners(vertex).find(is_there).expect("a face on each side");
        mesh.uv(0, corner).expect("set").as_dvec2()
    }

    #[test]
    fn loops_and_branches_are_no_chains() {
        let Row { mut mesh, mut edges, vertices } = row(1, 3);
        let face = mesh.faces().next().expect("36");
        let around: Vec<EdgeId> = mesh.face_edges(face).collect();
        let before = mesh.clone();
        assert!(mesh.straighten_uvs(0, &around).is_err(), "a loop");
        assert!(mesh.straighten_uvs(1, &edges).is_err() && mesh.straighten_uvs(0, &[]).is_err());
        assert!(mesh == before, "nothing was done");
        let done = mesh.straighten_uvs(0, &[edges.clone(), around].concat()).expect("one chain");
        assert_eq!((done.chains, done.left_out), (1, 1));
        let branch = mesh.vertex_edges(vertices[1]).find(|edge| !edges.contains(edge)).expect("two");
        edges.push(branch);
        let refused = mesh.straighten_uvs(0, &edges).expect_err("three ends").to_string();
        assert!(refused.contains("two ends"), "{refused}");
    }

    #[test]
    fn the_closer_axis_is_taken() {
        let Row { mut mesh, .. } = row(2, 3);
        let face = mesh.faces().next().expect("36");
        let corners: Vec<CornerId> = mesh.face_corners(face).collect();
        let wide = [[0.0, 0.25], [4.0, 0.0], [3.0, 0.5], [1.0, 0.25]];
        let give = |mesh: &mut EditMesh| {
            corners.iter().zip(wide).for_each(|(&corner, uv)| mesh.set_uv(0, corner, Vec2::from(uv)));
        };
        let uvs = |mesh: &EditMesh| -> Vec<[f32; 2]> {
            corners.iter().map(|&corner| mesh.uv(0, corner).expect("set").to_array()).collect()
        };
        give(&mut mesh);
        mesh.align_uvs(0, &corners, UvAlignment::Auto).expect("finite");
        assert_eq!(uvs(&mesh), [[0.0, 0.25], [4.0, 0.25], [3.0, 0.25], [1.0, 0.25]], "level");
        give(&mut mesh);
        mesh.align_uvs(0, &corners, UvAlignment::X).expect("finite");
        assert_eq!(uvs(&mesh), [[2.0, 0.25], [2.0, 0.0], [2.0, 0.5], [2.0, 0.25]], "upright");
        assert!(mesh.align_uvs(1, &corners, UvAlignment::Auto).is_err(), "no such set");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        /// Each point is the foot of its perpendicular, the ends stay, and no island is torn.
        #[test]
        fn chains_become_straight(seed in any::<u64>(), length in 2usize..7, seam in any::<bool>()) {
            let Row { mut mesh, edges, vertices } = row(seed, length);
            if seam {
                // Both sides of the row are chains of their own then.
                let below = mesh.corners().filter(|&corner| {
                    mesh.face_vertices(mesh.corner_face(corner)).all(|vertex| mesh.position(vertex).z > -1e-3)
                });
                for corner in below.collect::<Vec<_>>() {
                    mesh.set_uv(0, corner, mesh.uv(0, corner).expect("set") + 2.0);
                }
            }
            let done = check_operation(&mesh, |mesh| mesh.straighten_uvs(0, &edges));
            let (after, done) = done.map_err(TestCaseError::fail)?.expect("a chain");
            prop_assert_eq!((done.chains, done.left_out), (1 + usize::from(seam), 0));
            for side in [-1.0, 1.0] {
                let [start, end] = [vertices[0], vertices[length]].map(|vertex| uv_of(&mesh, vertex, side));
                for &vertex in &vertices[1..length] {
                    let (from, to) = (uv_of(&mesh, vertex, side), uv_of(&after, vertex, side));
                    // Rounded to f32.
                    prop_assert!((end - start).perp_dot(to - start).abs() < 1e-6, "on the line");
                    prop_assert!((end - start).dot(to - from).abs() < 1e-6, "straight to it");
                }
            }
            let moved = mesh.uv_corners(0, UvElements::Vertices(&vertices[1..length]));
            for corner in mesh.corners().filter(|corner| !moved.contains(corner)) {
                prop_assert_eq!(mesh.uv(0, corner), after.uv(0, corner));
            }
            let sizes = |mesh: &EditMesh| -> Vec<usize> { mesh.faces().map(|face| mesh.uv_island(0, face).len()).collect() };
            prop_assert_eq!(sizes(&mesh), sizes(&after));
        }
    }
}

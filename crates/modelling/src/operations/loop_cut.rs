//! Loop cuts: new edges across a ring of quads.

use fixedbitset::FixedBitSet;
use smallvec::SmallVec;

use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::records::HIDDEN;
use crate::refusal::Refusal;
use crate::slots::NewElements;

/// The vertices on an edge: few rings have more cuts.
pub(super) type Vertices = SmallVec<[VertexId; 8]>;

/// Settings of [`EditMesh::loop_cut`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoopCutSettings {
    /// The number of parallel loops: 1 to 1000.
    pub cuts: usize,
    /// Moves all loops together from their even distances: −1 to 1. At 1 the last loop lies on the
    /// side of the given edge's second vertex, at −1 the first one on that of its first vertex; 0
    /// is even.
    pub position: f64,
    /// Whether the loops keep the same distances on all edges of the ring as on the given one, instead of the
    /// same fraction of each edge.
    pub even: bool,
    /// With `even`: whether distances are measured from the side of the given edge's second vertex.
    pub flipped: bool,
}

impl Default for LoopCutSettings {
    fn default() -> Self {
        Self { cuts: 1, position: 0.0, even: false, flipped: false }
    }
}

/// The result of [`EditMesh::loop_cut`].
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct LoopCut {
    /// The edges across the faces, face by face along the ring: `cuts` edges per face.
    pub edges: Vec<EdgeId>,
    /// The vertices on the ring's edges, edge by edge: `cuts` vertices per edge.
    pub vertices: Vec<VertexId>,
    /// Whether the ring closes at the edge where it began.
    pub is_closed: bool,
}

/// An edge of a ring, and the vertex from which its cuts are counted.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Rung {
    edge: EdgeId,
    from: VertexId,
}

/// A quad of a ring: the corners that leave along its two edges there.
#[derive(Debug, Clone, Copy)]
struct Crossing {
    enter: CornerId,
    leave: CornerId,
}

/// Edges that lie opposite each other in a row of quads.
#[derive(Debug)]
struct EdgeRing {
    rungs: Vec<Rung>,
    crossings: Vec<Crossing>,
    is_closed: bool,
}

impl EditMesh {
    /// Cuts the ring of quads to which an edge belongs with new edge loops.
    ///
    /// The ring goes from the edge to the opposite edges of the quads on both of its sides. It ends
    /// at borders, at faces that are hidden or do not have four different vertices, at edges with
    /// more than two faces, and where it would cross itself; or it closes at the edge. Faces beyond
    /// an end get the new vertices of the last edge. Values are interpolated along the cut edges.
    /// On a Möbius band the two sides of a ring change places: there a position other than 0 gives
    /// the last face a step.
    ///
    /// All elements keep their ids; each face keeps its own for the strip at the end of the side on
    /// which it was entered. As in Blender, except that a ring that crosses itself ends there, and
    /// that an edge without quads is an error and not subdivided.
    ///
    /// # Errors
    /// There is no such edge; it has no quad, or more than two faces; a setting is out of range.
    ///
    /// ```
    /// use trigon_mesh::primitives;
    /// use trigon_modelling::{EditMesh, LoopCutSettings};
    ///
    /// let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    /// let edge = cube.edges().next().expect("a cube has twelve");
    /// let cut = cube.loop_cut(edge, &LoopCutSettings::default())?;
    /// assert!(cut.is_closed);
    /// assert_eq!((cut.vertices.len(), cut.edges.len(), cube.face_count()), (4, 4, 10));
    /// # Ok::<(), trigon_modelling::Refusal>(())
    /// ```
    pub fn loop_cut(&mut self, edge: EdgeId, settings: &LoopCutSettings) -> Result<LoopCut, Refusal> {
        const MOST_CUTS: usize = 1000;
        self.check_edge(edge)?;
        let LoopCutSettings { cuts, position, .. } = *settings;
        if !(1..=MOST_CUTS).contains(&cuts) {
            let (parameter, range) = ("the number of cuts", "1 to 1000");
            return Err(Refusal::OutOfRange { parameter, value: cuts as f64, range });
        }
        if !(-1.0..=1.0).contains(&position) {
            let (parameter, range) = ("the position of a loop cut", "-1 to 1");
            return Err(Refusal::OutOfRange { parameter, value: position, range });
        }
        let ring = self.ring_of_quads(edge)?;
        let count = (ring.rungs.len() * cuts) as u64;
        // A vertex on each rung, which divides its edge, and an edge across each face, which divides that.
        self.check_capacity_for(NewElements {
            vertices: count,
            edges: 2 * count,
            corners: 4 * count,
            faces: count,
        })?;
        let parameters: Vec<f64> = (1..=cuts).map(|k| (k as f64 + position) / (cuts + 1) as f64).collect();
        let parameters: Vec<Vec<f64>> = ring
            .rungs
            .iter()
            .map(|rung| self.parameters_on(rung.edge, edge, &parameters, settings))
            .collect();
        self.whole(|mesh| mesh.cut_ring_of_quads(&ring, &parameters))
    }

    /// The positions of cuts on an edge of a ring, as fractions of its length, given those on the ring's
    /// first edge.
    fn parameters_on(
        &self,
        edge: EdgeId,
        first: EdgeId,
        parameters: &[f64],
        settings: &LoopCutSettings,
    ) -> Vec<f64> {
        let ratio = self.edge_length(first) / self.edge_length(edge);
        if !settings.even || !ratio.is_finite() {
            return parameters.to_vec();
        }
        let from_edge_end = |parameter: f64| match settings.flipped {
            false => parameter * ratio,
            true => 1.0 - (1.0 - parameter) * ratio,
        };
        // A shorter edge has no room for the distance.
        parameters.iter().map(|&of_first| from_edge_end(of_first).clamp(0.0, 1.0)).collect()
    }

    /// The ring of an existing edge.
    fn ring_of_quads(&self, edge: EdgeId) -> Result<EdgeRing, Refusal> {
        let refused = |reason| Err(Refusal::NotPossible { operation: "a loop cut", reason });
        let sides: SmallVec<[CornerId; 2]> = self.edge_corners(edge).take(3).collect();
        if sides.len() > 2 {
            return refused("more than two faces meet at the edge; choose another edge of the ring");
        }
        let start = Rung { edge, from: self.edge_vertices(edge)[0] };
        // One bit per face: zeros cost nothing until they are touched.
        let mut visited = FixedBitSet::with_capacity(self.face_capacity());
        let mut ring = EdgeRing { rungs: vec![start], crossings: Vec::new(), is_closed: false };
        for side in sides {
            // The ring found on one side is reversed, to be continued on the other.
            ring.rungs.reverse();
            ring.crossings.reverse();
            self.follow_quads(side, start, &mut ring, &mut visited);
            if ring.is_closed {
                break;
            }
        }
        if ring.crossings.is_empty() {
            return refused("no face with four corners is at the edge");
        }
        Ok(ring)
    }

    /// Continues from a corner that leaves along the ring's last edge.
    fn follow_quads(&self, side: CornerId, start: Rung, ring: &mut EdgeRing, visited: &mut FixedBitSet) {
        let (mut enter, mut rung) = (side, start);
        while self.can_cut_across(self.corner_face(enter)) && !visited.put(self.corner_face(enter).0 as usize)
        {
            let leave = self.next_corner(self.next_corner(enter));
            let edge = self.corner_edge(leave);
            ring.crossings.push(Crossing { enter, leave });
            if edge == start.edge {
                ring.is_closed = true;
                return;
            }
            // In a quad a b c d, the edges a b and d c have the same direction.
            let from = if self.corner_vertex(enter) == rung.from {
                self.other_vertex(edge, self.corner_vertex(leave))
            } else {
                self.corner_vertex(leave)
            };
            rung = Rung { edge, from };
            // Both ends may be at the same edge, if more than two faces meet there.
            if ring.rungs[0].edge != edge {
                ring.rungs.push(rung);
            }
            match self.edge_pair(edge) {
                Some([a, b]) => enter = if a == leave { b } else { a },
                None => return,
            }
        }
    }

    /// Whether a ring passes through a face: a visible quad with four different vertices.
    fn can_cut_across(&self, face: FaceId) -> bool {
        if self.face_size(face) != 4 || self.faces[face.0].flags & HIDDEN != 0 {
            return false;
        }
        let vertices: SmallVec<[VertexId; 4]> = self.face_vertices(face).collect();
        vertices[0] != vertices[2] && vertices[1] != vertices[3]
    }

    /// Cuts a ring at positions on each of its edges, the same number on each.
    fn cut_ring_of_quads(&mut self, ring: &EdgeRing, parameters: &[Vec<f64>]) -> Result<LoopCut, Refusal> {
        let cuts = parameters.first().map_or(0, Vec::len);
        let mut vertices = Vec::with_capacity(ring.rungs.len() * cuts);
        for (rung, parameters) in ring.rungs.iter().zip(parameters) {
            vertices.extend(self.cut_rung(rung.edge, rung.from, parameters)?);
        }
        let mut edges = Vec::with_capacity(ring.crossings.len() * cuts);
        for crossing in &ring.crossings {
            self.cut_quad(crossing, cuts, &mut edges)?;
        }
        Ok(LoopCut { edges, vertices, is_closed: ring.is_closed })
    }

    /// Puts vertices on an edge, at increasing fractions from one of its ends to the other.
    pub(super) fn cut_rung(
        &mut self,
        edge: EdgeId,
        from: VertexId,
        parameters: &[f64],
    ) -> Result<Vertices, Refusal> {
        let [first, second] = self.edge_vertices(edge);
        let mut parameters: SmallVec<[f64; 8]> = parameters.into();
        if from != first {
            // Counted from the other end, the last cut is the first.
            parameters.reverse();
            parameters.iter_mut().for_each(|parameter| *parameter = 1.0 - *parameter);
        }
        let sides: SmallVec<[CornerId; 4]> = self.edge_corners(edge).collect();
        let ends: SmallVec<[CornerId; 4]> = sides.iter().map(|&side| self.next_corner(side)).collect();
        let (mut rest, mut before) = (edge, 0.0);
        let mut vertices = Vertices::new();
        for &parameter in &parameters {
            let t: f64 = if before < 1.0 { (parameter - before) / (1.0 - before) } else { 0.0 };
            let split = self.split_edge(rest, t.clamp(0.0, 1.0))?;
            (rest, before) = (split.edge, parameter);
            vertices.push(split.vertex);
        }
        if vertices.len() > 1 {
            // The splits have rounded one after the other: now each vertex gets its values from the
            // ends.
            for (&vertex, &t) in vertices.iter().zip(&parameters) {
                let position = self.point(first) * (1.0 - t) + self.point(second) * t;
                self.set_position(vertex, position.as_vec3());
                self.blend_vertex(&[(first, 1.0 - t), (second, t)], vertex);
            }
            for (&side, &end) in sides.iter().zip(&ends) {
                self.blend_rung(side, end, &vertices, &parameters);
            }
        }
        if from != first {
            vertices.reverse();
        }
        Ok(vertices)
    }

    /// Gives the corners between two corners of a face values at fractions between the edge's first
    /// and second vertex.
    fn blend_rung(&mut self, side: CornerId, end: CornerId, vertices: &[VertexId], parameters: &[f64]) {
        let mut corner = self.next_corner(side);
        let is_forward = self.corner_vertex(corner) == vertices[0];
        for i in 0..parameters.len() {
            let t = if is_forward { parameters[i] } else { 1.0 - parameters[parameters.len() - 1 - i] };
            self.blend_corner(&[(side, 1.0 - t), (end, t)], corner);
            corner = self.next_corner(corner);
        }
    }

    /// Joins the new vertices on two opposite edges of a quad.
    fn cut_quad(&mut self, crossing: &Crossing, cuts: usize, edges: &mut Vec<EdgeId>) -> Result<(), Refusal> {
        let mut from = self.next_corner(crossing.enter);
        let mut to = crossing.leave;
        for _ in 0..cuts {
            to = self.next_corner(to);
        }
        for _ in 0..cuts {
            // The next cut is taken first: this one moves the corners behind it to the new face.
            let (next_from, next_to) = (self.next_corner(from), self.previous_corner(to));
            edges.push(self.split_face(from, to)?.edge);
            (from, to) = (next_from, next_to);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::Vec3;
    use trigon_mesh::primitives;

    use super::*;
    use crate::tests::{keeps_affine_values, meshes, with_affine_values};

    fn counts(mesh: &EditMesh) -> [usize; 3] {
        mesh.check_structure().expect("whole");
        [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()]
    }

    fn cut(cuts: usize, position: f64) -> LoopCutSettings {
        LoopCutSettings { cuts, position, ..LoopCutSettings::default() }
    }

    /// The edge between two neighbouring vertices.
    fn edge(mesh: &EditMesh, a: u32, b: u32) -> EdgeId {
        mesh.find_edge(VertexId(a), VertexId(b)).expect("neighbours")
    }

    #[test]
    fn a_loop_round_a_torus_adds_a_vertex_two_edges_and_a_face_for_each_quad_of_the_ring() {
        let torus = with_affine_values(primitives::torus(2.0, 0.5, 8, 5));
        let (whole, _) = EditMesh::from_mesh(&torus);
        assert_eq!(counts(&whole), [40, 80, 40], "8 by 5 quads");
        for start in whole.edges() {
            for cuts in 1..4 {
                let mut mesh = whole.clone();
                let made = mesh.loop_cut(start, &cut(cuts, 0.0)).expect("quads everywhere");
                let ring = made.vertices.len() / cuts;
                assert!(made.is_closed && (ring == 8 || ring == 5), "round it one way or the other: {ring}");
                let more = ring * cuts;
                assert_eq!(counts(&mesh), [40 + more, 80 + 2 * more, 40 + more], "genus 1 stays");
                assert_eq!(made.edges.len(), more, "one for each face and cut");
                assert!(mesh.faces().all(|face| mesh.face_size(face) == 4), "all are quads");
                keeps_affine_values(&mesh).expect("interpolated along the edges");
            }
        }
    }

    #[test]
    fn even_loops_keep_their_distance_from_one_side() {
        let (mut whole, _) = EditMesh::from_mesh(&primitives::grid(4.0, 2.0, 1, 1));
        let at = |x: f32, z: f32| {
            let place = Vec3::new(x, 0.0, z);
            whole.vertices().find(|&vertex| whole.position(vertex) == place).expect("a corner")
        };
        let (low, high, corner) = (at(-2.0, -1.0), at(-2.0, 1.0), at(2.0, 1.0));
        // The left edge stays 2 m long, the right one is 4 m.
        whole.set_position(corner, Vec3::new(2.0, 0.0, 3.0));
        let left = edge(&whole, low.0, high.0);
        let upwards = whole.edge_vertices(left)[0] == low;
        for (flipped, expected) in [(false, -0.5), (true, 1.5)] {
            let position = if upwards { -0.5 } else { 0.5 };
            let settings = LoopCutSettings { even: true, flipped: flipped == upwards, ..cut(1, position) };
            let mut mesh = whole.clone();
            let made = mesh.loop_cut(left, &settings).expect("a quad");
            let mut found: Vec<f32> = made.vertices.iter().map(|&vertex| mesh.position(vertex).z).collect();
            found.sort_by(f32::total_cmp);
            assert_eq!(
                found,
                [-0.5, expected],
                "half a metre from one end, or a metre and a half from the other"
            );
        }
    }

    #[test]
    fn cuts_are_even_and_slide_toward_the_second_vertex() {
        let (whole, _) = EditMesh::from_mesh(&primitives::grid(4.0, 3.0, 1, 3));
        // The left end of the first row is at (-2, -1.5), the right one at (2, -1.5).
        let start = edge(&whole, 0, 1);
        let [first, second] = whole.edge_vertices(start).map(|vertex| whole.position(vertex));
        for (position, places) in
            [(0.0, [0.25, 0.5, 0.75]), (1.0, [0.5, 0.75, 1.0]), (-0.5, [0.125, 0.375, 0.625])]
        {
            let mut mesh = whole.clone();
            let made = mesh.loop_cut(start, &cut(3, position)).expect("a row of quads");
            assert!(!made.is_closed, "it ends at borders");
            assert_eq!(counts(&mesh), [8 + 12, 10 + 12 + 9, 3 + 9], "4 edges, 3 quads");
            let mut found: Vec<Vec3> = made.vertices.iter().map(|&vertex| mesh.position(vertex)).collect();
            found.sort_by(|a, b| a.z.total_cmp(&b.z));
            for row in found.chunks(3) {
                let mut row: Vec<f32> = row.iter().map(|place| place.x).collect();
                row.sort_by(f32::total_cmp);
                let mut wanted = places.map(|t| first.x + (second.x - first.x) * t);
                wanted.sort_by(f32::total_cmp);
                assert_eq!(row, wanted, "in each row the same");
            }
        }
    }

    #[test]
    fn a_ring_ends_at_faces_that_are_no_quads_and_leaves_its_vertices_there() {
        let mut mesh = EditMesh::new();
        let v: Vec<VertexId> = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.5, 2.0)]
            .map(|(x, y)| mesh.add_vertex(Vec3::new(x, y, 0.0)).expect("room"))
            .to_vec();
        mesh.add_face(&[v[0], v[1], v[2], v[3]]).expect("a quad");
        let triangle = mesh.add_face(&[v[3], v[2], v[4]]).expect("a triangle");
        let made = mesh.loop_cut(edge(&mesh, 0, 1), &cut(2, 0.0)).expect("one quad");
        assert_eq!((made.vertices.len(), made.edges.len(), mesh.face_count()), (4, 2, 4), "three strips");
        assert_eq!(mesh.face_size(triangle), 5, "with two vertices on its side");
        mesh.check_structure().expect("whole");
    }

    #[test]
    fn a_ring_that_crosses_itself_ends_before_it_cuts_a_face_twice() {
        // One quad whose opposite sides are glued to the next: a cube's corner of three quads.
        let mut mesh = EditMesh::new();
        let v: Vec<VertexId> =
            (0..7).map(|i| mesh.add_vertex(Vec3::splat(i as f32)).expect("room")).collect();
        mesh.add_face(&[v[0], v[1], v[2], v[3]]).expect("a quad");
        mesh.add_face(&[v[0], v[3], v[4], v[5]]).expect("a quad");
        mesh.add_face(&[v[0], v[5], v[6], v[1]]).expect("a quad");
        let made = mesh.loop_cut(edge(&mesh, 0, 3), &cut(1, 0.0)).expect("two quads");
        assert_eq!((made.edges.len(), mesh.face_count()), (2, 5), "two of three");
        mesh.check_structure().expect("whole");
    }

    #[test]
    fn a_moebius_band_is_cut_once_round() {
        let mut mesh = EditMesh::new();
        let v: Vec<VertexId> = (0..6)
            .map(|i| mesh.add_vertex(Vec3::new((i / 2) as f32, (i % 2) as f32, 0.0)).expect("room"))
            .collect();
        mesh.add_face(&[v[0], v[2], v[3], v[1]]).expect("a quad");
        mesh.add_face(&[v[2], v[4], v[5], v[3]]).expect("a quad");
        mesh.add_face(&[v[4], v[1], v[0], v[5]]).expect("the twist");
        let made = mesh.loop_cut(edge(&mesh, 0, 1), &cut(2, 0.5)).expect("three quads");
        assert!(made.is_closed, "back at the start");
        assert_eq!(counts(&mesh), [6 + 6, 9 + 12, 9], "Euler's characteristic stays 0");
    }

    #[test]
    fn what_is_no_loop_cut_is_refused() {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::icosphere(1.0, 1));
        let before = mesh.clone();
        let no_quad = mesh.loop_cut(EdgeId(0), &cut(1, 0.0)).expect_err("triangles");
        assert!(no_quad.to_string().contains("no face with four corners"), "{no_quad}");
        let none = mesh.loop_cut(EdgeId(9999), &cut(1, 0.0));
        assert_eq!(none, Err(Refusal::NoSuchEdge(EdgeId(9999))), "no such edge");
        for settings in [cut(0, 0.0), cut(1001, 0.0), cut(1, 1.5), cut(1, f64::NAN)] {
            let refusal = mesh.loop_cut(EdgeId(0), &settings);
            assert!(matches!(refusal, Err(Refusal::OutOfRange { .. })), "{settings:?}");
        }
        assert!(mesh == before, "unchanged");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]

        #[test]
        fn a_loop_cut_keeps_structure_and_values_and_can_be_undone(
            start in meshes(),
            edge in any::<u32>(),
            cuts in 1usize..4,
            position in -1.0f64..=1.0,
        ) {
            let (mut mesh, _) = EditMesh::from_mesh(&start);
            let before = mesh.clone();
            let edge = EdgeId(edge % mesh.edge_capacity().max(1) as u32);
            match mesh.transaction(|mesh| mesh.loop_cut(edge, &cut(cuts, position))) {
                Ok((made, mut difference)) => {
                    prop_assert_eq!(mesh.check_structure(), Ok(()));
                    prop_assert_eq!(keeps_affine_values(&mesh), Ok(()));
                    let faces = mesh.face_count() - before.face_count();
                    prop_assert_eq!((faces, mesh.vertex_count()), (made.edges.len(), before.vertex_count() + made.vertices.len()));
                    difference.apply(&mut mesh);
                }
                Err(Refusal::NotPossible { .. } | Refusal::NoSuchEdge(_)) => {}
                Err(refusal) => prop_assert!(false, "{}", refusal),
            }
            prop_assert!(mesh == before, "undone, or refused");
        }
    }
}

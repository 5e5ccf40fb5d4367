//! Sliding: edge loops and vertices move along adjacent edges, and values follow.

use smallvec::{SmallVec, smallvec};
use trigon_math::DVec3;

use super::delete::require;
use crate::blends::CornerBlends;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, VertexId};
use crate::refusal::Refusal;

const EDGE_SLIDE: &str = "sliding edges";
const VERTEX_SLIDE: &str = "sliding vertices";

/// Corners and their weights.
type WeightedCorners = SmallVec<[(CornerId, f64); 6]>;

/// Where a vertex slides at most.
#[derive(Debug)]
struct Course {
    vertex: VertexId,
    /// From the vertex to the end of the course.
    way: DVec3,
    /// The edge that leads there, if one does.
    edge: Option<EdgeId>,
    /// How values change on the way, in each chart that knows it.
    charts: SmallVec<[Chart; 2]>,
}

/// How values change on the way of a vertex, as seen from some faces with the same texture
/// coordinates there.
#[derive(Debug)]
struct Chart {
    /// Corners at the vertex.
    at: SmallVec<[CornerId; 2]>,
    /// What is added to a value at the end of the way. Weights sum to 0.
    change: WeightedCorners,
}

/// An edge that slides, in the direction in which its loop runs.
#[derive(Debug, Clone, Copy)]
struct Link {
    edge: EdgeId,
    from: VertexId,
    to: VertexId,
}

impl EditMesh {
    /// Slides loops or chains of edges along the adjacent edges: each vertex by `factor` (−1 to 1)
    /// of the way to the other end of its edge on one side. At 1 it reaches that end.
    ///
    /// A loop runs from the first to the second vertex of its edge with the lowest index. A positive factor
    /// slides to its left, seen from outside, a negative one to its right. If several edges are on a side,
    /// the vertex moves towards the middle of the ends of the first and the last. If a loop turns within one
    /// face, it moves to the opposite corner of a quad, or parallel to the sides of a larger polygon. A
    /// vertex without any of these on that side stays.
    ///
    /// Texture coordinates, colours and normals follow: they change as they do along the edge. So a texture
    /// stays in place, and values that are affine in position stay so. Values of vertices (skin, morph
    /// targets) and original positions are unchanged. Returns the moved vertices, by index.
    ///
    /// # Errors
    /// No edge is given, or one does not exist. More than two of them meet at a vertex; one has more than two
    /// faces, or faces of opposite winding. The factor is out of range, or there is nothing to slide along.
    pub fn slide_edges(&mut self, edges: &[EdgeId], factor: f64) -> Result<Vec<VertexId>, Refusal> {
        require(edges, EDGE_SLIDE, "at least one edge")?;
        check_factor(factor)?;
        let mut sorted = edges.to_vec();
        sorted.sort_unstable();
        sorted.dedup();
        for &edge in &sorted {
            self.check_edge(edge)?;
            self.check_slide_sides(edge)?;
        }
        let links = self.slide_links(&sorted)?;
        let mut at_vertices: Vec<(VertexId, Link)> =
            links.iter().flat_map(|&link| [(link.from, link), (link.to, link)]).collect();
        at_vertices.sort_unstable_by_key(|&(vertex, link)| (vertex, link.edge));
        let mut courses = Vec::new();
        for group in at_vertices.chunk_by(|a, b| a.0 == b.0) {
            let links: SmallVec<[Link; 2]> = group.iter().map(|&(_, link)| link).collect();
            courses.extend(self.course_beside(group[0].0, &links, factor > 0.0));
        }
        if courses.is_empty() {
            let reason = "no edge is beside them on that side; slide to the other side";
            return Err(Refusal::NotPossible { operation: EDGE_SLIDE, reason });
        }
        Ok(self.slide_along(&courses, factor.abs()))
    }

    /// Slides vertices, each along one of its edges by `factor` of its length: 0 to 1 towards the
    /// other end, or down to −1 in the opposite direction. Values of corners follow as in
    /// [`Self::slide_edges`]. Returns the vertices, by index.
    ///
    /// # Errors
    /// No vertex is given; a vertex or an edge does not exist, or the vertex is not at the
    /// edge; a vertex is given with two different edges; the factor is out of range.
    pub fn slide_vertices(
        &mut self,
        vertices: &[(VertexId, EdgeId)],
        factor: f64,
    ) -> Result<Vec<VertexId>, Refusal> {
        require(vertices, VERTEX_SLIDE, "at least one vertex")?;
        check_factor(factor)?;
        let mut sorted = vertices.to_vec();
        sorted.sort_unstable();
        sorted.dedup();
        let refused = |reason| Err(Refusal::NotPossible { operation: VERTEX_SLIDE, reason });
        for &(vertex, edge) in &sorted {
            self.check_vertex(vertex)?;
            self.check_edge(edge)?;
            if !self.edge_vertices(edge).contains(&vertex) {
                return refused("a vertex slides along one of its own edges");
            }
        }
        if sorted.windows(2).any(|pair| pair[0].0 == pair[1].0) {
            return refused("a vertex slides along one edge only");
        }
        let courses: Vec<Course> =
            sorted.iter().map(|&(vertex, edge)| self.course_along(vertex, edge)).collect();
        Ok(self.slide_along(&courses, factor))
    }

    /// An edge that slides has at most two faces, which wind in the same way.
    fn check_slide_sides(&self, edge: EdgeId) -> Result<(), Refusal> {
        let refused = |reason| Err(Refusal::NotPossible { operation: EDGE_SLIDE, reason });
        let sides: SmallVec<[CornerId; 4]> = self.edge_corners(edge).take(3).collect();
        match sides[..] {
            [_, _, _] => refused("more than two faces meet at an edge; leave it out"),
            [a, b] if self.corner_vertex(a) == self.corner_vertex(b) => {
                refused("faces wind in opposite ways; recalculate normals first")
            }
            _ => Ok(()),
        }
    }

    /// Gives each of some sorted edges the direction of its loop.
    fn slide_links(&self, edges: &[EdgeId]) -> Result<Vec<Link>, Refusal> {
        let mut ends: Vec<(VertexId, usize)> = Vec::with_capacity(2 * edges.len());
        for (i, &edge) in edges.iter().enumerate() {
            ends.extend(self.edge_vertices(edge).map(|vertex| (vertex, i)));
        }
        ends.sort_unstable();
        if ends.windows(3).any(|three| three[0].0 == three[2].0) {
            let reason = "more than two of the edges meet at a vertex; select loops or chains";
            return Err(Refusal::NotPossible { operation: EDGE_SLIDE, reason });
        }
        let neighbor = |vertex: VertexId, i: usize| {
            let start = ends.partition_point(|&(other, _)| other < vertex);
            let here = ends[start..].iter().take_while(|&&(other, _)| other == vertex);
            here.map(|&(_, other)| other).find(|&other| other != i)
        };
        let mut links: Vec<Option<Link>> = vec![None; edges.len()];
        for start in 0..edges.len() {
            if links[start].is_some() {
                continue;
            }
            let [from, to] = self.edge_vertices(edges[start]);
            links[start] = Some(Link { edge: edges[start], from, to });
            for (mut vertex, is_forward) in [(to, true), (from, false)] {
                let mut here = start;
                while let Some(next) = neighbor(vertex, here).filter(|&next| links[next].is_none()) {
                    let edge = edges[next];
                    let other = self.other_vertex(edge, vertex);
                    let [from, to] = if is_forward { [vertex, other] } else { [other, vertex] };
                    links[next] = Some(Link { edge, from, to });
                    (here, vertex) = (next, other);
                }
            }
        }
        Ok(links.into_iter().flatten().collect())
    }

    /// Where a vertex of a loop slides to one side.
    fn course_beside(&self, vertex: VertexId, links: &[Link], is_left: bool) -> Option<Course> {
        let corners: SmallVec<[(CornerId, EdgeId); 2]> = links
            .iter()
            .filter_map(|link| Some((self.corner_beside(vertex, link, is_left)?, link.edge)))
            .collect();
        if let [(corner, _), (other, _)] = corners[..]
            && corner == other
        {
            return self.course_within(vertex, corner);
        }
        let edges: SmallVec<[EdgeId; 2]> =
            corners.iter().map(|&(corner, edge)| self.other_edge_at(corner, edge)).collect();
        match edges[..] {
            [] => None,
            [edge] => Some(self.course_along(vertex, edge)),
            [first, second, ..] if first == second => Some(self.course_along(vertex, first)),
            _ => {
                let mut change = WeightedCorners::new();
                for (&(corner, _), &edge) in corners.iter().zip(&edges) {
                    change.push((self.corner_at_other_end(corner, edge), 0.5));
                    change.push((corner, -0.5));
                }
                let at = corners.iter().map(|&(corner, _)| corner).collect();
                Some(self.slide_course(vertex, None, smallvec![Chart { at, change }]))
            }
        }
    }

    /// The corner at a vertex in the face on one side of an edge that slides.
    fn corner_beside(&self, vertex: VertexId, link: &Link, is_left: bool) -> Option<CornerId> {
        // A face on the left runs along with the edge, one on the right against it.
        let start = if is_left { link.from } else { link.to };
        let side = self.edge_corners(link.edge).find(|&corner| self.corner_vertex(corner) == start)?;
        Some(if vertex == start { side } else { self.next_corner(side) })
    }

    /// The other one of the two edges at a corner.
    fn other_edge_at(&self, corner: CornerId, edge: EdgeId) -> EdgeId {
        let out = self.corner_edge(corner);
        if out == edge { self.corner_edge(self.previous_corner(corner)) } else { out }
    }

    /// The neighbouring corner at the other end of an edge of a corner.
    fn corner_at_other_end(&self, corner: CornerId, edge: EdgeId) -> CornerId {
        if self.corner_edge(corner) == edge { self.next_corner(corner) } else { self.previous_corner(corner) }
    }

    /// Where a vertex slides at which the loop turns within one face.
    fn course_within(&self, vertex: VertexId, corner: CornerId) -> Option<Course> {
        let (next, previous) = (self.next_corner(corner), self.previous_corner(corner));
        let change: WeightedCorners = match self.face_size(self.corner_face(corner)) {
            3 => return None,
            4 => smallvec![(self.next_corner(next), 1.0), (corner, -1.0)],
            // Parallel to the edges along which its two neighbours go.
            _ => {
                let (after, before) = (self.next_corner(next), self.previous_corner(previous));
                smallvec![(after, 1.0), (next, -1.0), (before, 1.0), (previous, -1.0)]
            }
        };
        Some(self.slide_course(vertex, None, smallvec![Chart { at: smallvec![corner], change }]))
    }

    /// Where a vertex slides along an edge.
    fn course_along(&self, vertex: VertexId, edge: EdgeId) -> Course {
        let charts = self.edge_corners(edge).map(|side| {
            let next = self.next_corner(side);
            let (at, end) = if self.corner_vertex(side) == vertex { (side, next) } else { (next, side) };
            Chart { at: smallvec![at], change: smallvec![(end, 1.0), (at, -1.0)] }
        });
        let mut course = self.slide_course(vertex, Some(edge), charts.collect());
        course.way = self.point(self.other_vertex(edge, vertex)) - self.point(vertex);
        course
    }

    fn slide_course(&self, vertex: VertexId, edge: Option<EdgeId>, charts: SmallVec<[Chart; 2]>) -> Course {
        let part = |&(corner, weight): &(CornerId, f64)| self.point(self.corner_vertex(corner)) * weight;
        let way = charts.first().map_or(DVec3::ZERO, |chart| chart.change.iter().map(part).sum());
        Course { vertex, way, edge, charts }
    }

    /// Moves vertices by a part of their ways. All is computed from the state before.
    fn slide_along(&mut self, courses: &[Course], part: f64) -> Vec<VertexId> {
        let mut blends = CornerBlends::default();
        let mut positions = Vec::with_capacity(courses.len());
        for course in courses {
            positions.push((self.point(course.vertex) + course.way * part).as_vec3());
            for corner in self.vertex_corners(course.vertex) {
                let sum = blends.sum(self.slid_value(course, corner, part));
                blends.assign(sum, corner);
            }
        }
        self.blend_corners(&blends);
        for (course, position) in courses.iter().zip(positions) {
            self.set_position(course.vertex, position);
        }
        courses.iter().map(|course| course.vertex).collect()
    }

    /// The parts of the value that a corner gets when its vertex slides.
    fn slid_value(&self, course: &Course, corner: CornerId, part: f64) -> WeightedCorners {
        if let Some(edge) = course.edge {
            let previous = self.previous_corner(corner);
            if self.corner_edge(corner) == edge {
                return smallvec![(corner, 1.0 - part), (self.next_corner(corner), part)];
            }
            if self.corner_edge(previous) == edge {
                return smallvec![(corner, 1.0 - part), (previous, part)];
            }
        }
        let knows = |chart: &&Chart| chart.at.iter().all(|&at| self.have_same_uvs(at, corner));
        let Some(chart) = course.charts.iter().find(knows) else {
            return self.parts_beside(corner, course.way * part).into_iter().collect();
        };
        let change = chart.change.iter().map(|&(other, weight)| (other, weight * part));
        [(corner, 1.0)].into_iter().chain(change).collect()
    }
}

fn check_factor(factor: f64) -> Result<(), Refusal> {
    if (-1.0..=1.0).contains(&factor) {
        return Ok(());
    }
    Err(Refusal::OutOfRange { parameter: "the slide factor", value: factor, range: "-1 to 1" })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::Vec3;
    use trigon_mesh::primitives;

    use super::*;
    use crate::tests::{affine_uv, keeps_affine_values, meshes, with_affine_values};

    /// A flat grid of 4 by 3 quads with 1 m sides, and the edges of its line x = -1.
    fn grid() -> (EditMesh, Vec<EdgeId>) {
        let (mesh, _) = EditMesh::from_mesh(&with_affine_values(primitives::grid(4.0, 3.0, 4, 3)));
        let on_line = |mesh: &EditMesh, edge: &EdgeId| {
            mesh.edge_vertices(*edge).iter().all(|&vertex| mesh.position(vertex).x == -1.0)
        };
        let line = mesh.edges().filter(|edge| on_line(&mesh, edge)).collect();
        (mesh, line)
    }

    #[test]
    fn a_line_of_a_grid_slides_to_either_side_with_its_texture() {
        let (whole, line) = grid();
        assert_eq!(line.len(), 3, "three rows");
        for (factor, distance) in [(0.25, 0.25), (-0.5, 0.5), (1.0, 1.0), (0.0, 0.0)] {
            let mut mesh = whole.clone();
            let moved = mesh.slide_edges(&line, factor).expect("edges on both sides");
            assert_eq!(moved.len(), 4, "four vertices");
            let x: Vec<f32> = moved.iter().map(|&vertex| mesh.position(vertex).x + 1.0).collect();
            assert!(x.iter().all(|&at| at == x[0] && at.abs() == distance), "all by {distance}: {x:?}");
            assert!(mesh.first_position(moved[0]).x == -1.0, "where it was stays known");
            keeps_affine_values(&mesh).expect("the image stays in its place");
        }
        let mut there = whole.clone();
        let mut back = whole.clone();
        there.slide_edges(&line, 0.5).expect("one side");
        back.slide_edges(&line, -0.5).expect("other side");
        let vertex = whole.edge_vertices(line[0])[0];
        let sides = there.position(vertex).x + back.position(vertex).x;
        assert!(sides == -2.0, "one goes left, the other right: {sides}");
    }

    #[test]
    fn the_loop_round_a_face_slides_into_its_corners_or_along_the_edges_outside() {
        let (mut mesh, _) = EditMesh::from_mesh(&with_affine_values(primitives::grid(3.0, 3.0, 3, 3)));
        let middle = crate::ids::FaceId(4);
        let edges: Vec<EdgeId> = mesh.face_edges(middle).collect();
        let corners: Vec<VertexId> = mesh.face_vertices(middle).collect();
        let before: Vec<Vec3> = corners.iter().map(|&vertex| mesh.position(vertex)).collect();
        // Whichever way the loop runs, one side is inside.
        let mut inward = mesh.clone();
        inward.slide_edges(&edges, 0.25).expect("quads on both sides");
        let mut outward = mesh.clone();
        outward.slide_edges(&edges, -0.25).expect("quads on both sides");
        let of = |mesh: &EditMesh| mesh.position(corners[0]).length();
        if of(&inward) > of(&outward) {
            std::mem::swap(&mut inward, &mut outward);
        }
        for (&vertex, at) in corners.iter().zip(&before) {
            assert_eq!(inward.position(vertex), *at * 0.5, "a quarter of the way to the opposite corner");
        }
        assert!(of(&outward) > of(&mesh), "outside");
        keeps_affine_values(&inward).expect("within the face");
        mesh.slide_vertices(&[(corners[0], edges[0])], 1.0).expect("a corner of the face");
        keeps_affine_values(&mesh).expect("along an edge");
    }

    #[test]
    fn an_image_that_is_cut_at_the_loop_stays_in_its_place_on_both_sides() {
        let (mut mesh, line) = grid();
        // Left of the line the image is turned by a quarter and moved.
        let turned = |uv: trigon_math::Vec2| trigon_math::Vec2::new(3.0 - uv.y, uv.x);
        let corners: Vec<CornerId> = mesh.corners().collect();
        let is_left = |mesh: &EditMesh, corner: CornerId| {
            mesh.face_vertices(mesh.corner_face(corner)).all(|vertex| mesh.position(vertex).x < -0.5)
        };
        let left: Vec<CornerId> = corners.into_iter().filter(|&corner| is_left(&mesh, corner)).collect();
        for &corner in &left {
            let uv = mesh.uv(0, corner).expect("a set");
            mesh.set_uv(0, corner, turned(uv));
        }
        mesh.slide_edges(&line, 0.5).expect("two sides");
        for corner in mesh.corners() {
            let uv = affine_uv(mesh.position(mesh.corner_vertex(corner)));
            let wanted = if left.contains(&corner) { turned(uv) } else { uv };
            let uv = mesh.uv(0, corner).expect("a set");
            assert!(uv.abs_diff_eq(wanted, 1e-6), "{uv}, not {wanted}: rounded to f32 once");
        }
    }

    #[test]
    fn what_cannot_slide_is_refused() {
        let (mut mesh, line) = grid();
        let before = mesh.clone();
        assert!(matches!(mesh.slide_edges(&[], 0.5), Err(Refusal::NothingGiven { .. })), "nothing");
        assert!(matches!(mesh.slide_edges(&line, 1.5), Err(Refusal::OutOfRange { .. })), "too far");
        assert!(matches!(mesh.slide_edges(&line, f64::NAN), Err(Refusal::OutOfRange { .. })), "NaN");
        let all: Vec<EdgeId> = mesh.edges().collect();
        let refusal = mesh.slide_edges(&all, 0.5).expect_err("crossings");
        assert!(refusal.to_string().contains("more than two of the edges meet"), "{refusal}");
        let far = *line.last().expect("three");
        let refusal = mesh.slide_vertices(&[(VertexId(0), far)], 0.5).expect_err("elsewhere");
        assert!(refusal.to_string().contains("one of its own edges"), "{refusal}");
        assert!(mesh == before, "unchanged");
    }

    /// Whether an edge has no faces, which would say how values change along it.
    fn has_wires(mesh: &EditMesh) -> bool {
        mesh.edges().any(|edge| mesh.edge_corners(edge).next().is_none())
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]

        #[test]
        fn slides_keep_affine_values_and_can_be_undone(
            start in meshes(),
            edges in prop::collection::vec(any::<u32>(), 1..5),
            factor in -1.0f64..=1.0,
        ) {
            let (mut mesh, _) = EditMesh::from_mesh(&start);
            let before = mesh.clone();
            let capacity = mesh.edge_capacity().max(1) as u32;
            let edges: Vec<EdgeId> = edges.into_iter().map(|edge| EdgeId(edge % capacity)).collect();
            let ends = edges.iter().filter(|&&edge| mesh.has_edge(edge));
            let vertices: Vec<_> = ends.map(|&edge| (mesh.edge_vertices(edge)[0], edge)).collect();
            for which in 0..2 {
                let slid = mesh.transaction(|mesh| match which {
                    0 => mesh.slide_edges(&edges, factor),
                    _ => mesh.slide_vertices(&vertices, factor),
                });
                if let Ok((moved, mut difference)) = slid {
                    prop_assert!(!moved.is_empty());
                    prop_assert_eq!(mesh.check_structure(), Ok(()));
                    let kept = keeps_affine_values(&mesh);
                    prop_assert!(kept.is_ok() || has_wires(&mesh), "{:?}", kept);
                    difference.apply(&mut mesh);
                }
                prop_assert!(mesh == before, "undone, or refused");
            }
        }
    }
}

//! Cuts faces along the lines in which they cross others: Blender's Intersect (Knife).
//!
//! The lines are those of the faces' triangles. Which triangles cross, and whether they do in an edge or a vertex, is
//! decided by the signs of volumes, exactly; positions are computed in f64 and rounded once, from the edge and the
//! triangle that meet there: all faces at that edge get the same point.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use smallvec::SmallVec;
use trigon_math::{AxisProjection, DVec2, DVec3, Orientation, Vec3, orientation, side_of_triangle};

use super::path::{CutLine, CutPoint, Site};
use super::{KnifeCut, position_key};
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::inspect::{FaceTriangle, PairSearch, TriangleTree};
use crate::numbering::{Numbering, sorted_once};
use crate::operations::boolean::is_flat;
use crate::operations::delete::require;
use crate::refusal::Refusal;

const OPERATION: &str = "intersecting faces";

/// With which faces others are intersected.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize, schemars::JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum IntersectWith {
    /// With all other faces that are not hidden.
    #[default]
    Others,
    /// With each other.
    Themselves,
}

/// A point in which two triangles meet, as one of each.
#[derive(Debug, Clone, Copy)]
struct Contact {
    points: [CutPoint; 2],
}

type Contacts = SmallVec<[Contact; 8]>;

/// Straight pieces of the lines in which two faces cross, or in which an edge lies on a face in its plane.
#[derive(Debug, Default)]
struct Pieces {
    of_faces: BTreeMap<[FaceId; 2], Vec<[Contact; 2]>>,
    along_edges: BTreeMap<(EdgeId, FaceId), Vec<[Contact; 2]>>,
}

impl Pieces {
    /// The lines within faces. Pieces end at the diagonals by which faces are cut into
    /// triangles: in flat faces they go on.
    fn into_lines(self, mesh: &EditMesh) -> Vec<CutLine> {
        let mut lines = Vec::new();
        let is_on_diagonals = |meeting: &Contact| {
            meeting
                .points
                .iter()
                .all(|point| matches!(point.site, Site::Face(face) if mesh.is_face_flat(face)))
        };
        for (faces, pieces) in self.of_faces {
            for piece in united(pieces, is_on_diagonals) {
                for (number, face) in faces.into_iter().enumerate() {
                    mesh.add_line_within(face, piece.map(|end| end.points[number]), &mut lines);
                }
            }
        }
        let crosses_diagonal = |meeting: &Contact| matches!(meeting.points.map(|point| point.site), [Site::Edge(_), Site::Face(face)] if mesh.is_face_flat(face));
        for ((_, face), pieces) in self.along_edges {
            for piece in united(pieces, crosses_diagonal) {
                mesh.add_line_within(face, piece.map(|end| end.points[1]), &mut lines);
            }
        }
        lines
    }
}

/// Pieces of one line, joined where two of them end and need not.
fn united(mut pieces: Vec<[Contact; 2]>, can_go_on: impl Fn(&Contact) -> bool) -> Vec<[Contact; 2]> {
    let key = |meeting: &Contact| meeting.points.map(|point| position_key(point.position));
    let joint = |pieces: &[[Contact; 2]]| {
        let all = (0..pieces.len()).flat_map(|i| (0..i).map(move |j| [j, i]));
        let ends = all.flat_map(|pair| [[0, 0], [0, 1], [1, 0], [1, 1]].map(|ends| (pair, ends)));
        ends.into_iter().find(|&([one, other], [first, second])| {
            let [first, second] = [&pieces[one][first], &pieces[other][second]];
            key(first) == key(second) && can_go_on(first)
        })
    };
    while let Some(([one, other], [first, second])) = joint(&pieces) {
        let removed = pieces.swap_remove(other);
        pieces[one][first] = removed[1 - second];
    }
    pieces
}

impl EditMesh {
    /// Cuts faces along the lines in which they cross others, and those, too. Nothing is removed or joined: along a line,
    /// each side has its own edges and vertices, in the same positions. Faces that are not flat are cut as the
    /// triangles that are drawn of them. Faces in one plane are cut along each other's outlines.
    ///
    /// What crosses is decided without rounding. A line that ends within a face, as one at a border does, cuts nothing
    /// there and is counted.
    ///
    /// # Errors
    /// No face is given, or one does not exist; none of them crosses another one; there would be too many elements.
    pub fn intersect_faces(&mut self, faces: &[FaceId], with: IntersectWith) -> Result<KnifeCut, Refusal> {
        require(faces, OPERATION, "at least one face")?;
        faces.iter().try_for_each(|&face| self.check_face(face))?;
        let given = sorted_once(faces.iter().map(|face| face.0).collect());
        let numbering = Numbering::new(&given, self.face_capacity());
        let is_given = |face: FaceId| numbering.get(face.0).is_some();
        let is_wanted = |a: FaceId, b: FaceId| match with {
            IntersectWith::Themselves => is_given(a) && is_given(b),
            IntersectWith::Others => is_given(a) != is_given(b),
        };
        let triangles = self.triangles();
        let visible = triangles.into_iter().filter(|triangle| {
            is_given(triangle.face) || with == IntersectWith::Others && !self.is_face_hidden(triangle.face)
        });
        let tree = TriangleTree::new(visible.collect());
        let mut pieces = Pieces::default();
        let is_complete = PairSearch::new(&tree).for_each_pair(|a, b| {
            if a.face != b.face && is_wanted(a.face, b.face) {
                let [a, b] = if a.face < b.face { [a, b] } else { [b, a] };
                self.add_intersection(a, b, &mut pieces);
            }
            true
        });
        let refused = |reason| Err(Refusal::NotPossible { operation: OPERATION, reason });
        if !is_complete {
            return refused("too many faces overlap; intersect fewer at once");
        }
        let lines = pieces.into_lines(self);
        if lines.is_empty() {
            return refused("no face crosses another one; select faces that do");
        }
        self.cut_lines(&lines, &[])
    }

    fn add_intersection(&self, a: &FaceTriangle, b: &FaceTriangle, pieces: &mut Pieces) {
        let plane = b.positions.map(|corner| corner.as_dvec3());
        let is_in_plane = |position: Vec3| side_of_triangle(plane, position.as_dvec3()) == Ordering::Equal;
        let are_coplanar = a.positions.into_iter().all(is_in_plane);
        if are_coplanar {
            self.add_outline(a, b, pieces);
            self.add_outline(b, a, pieces);
            return;
        }
        let mut meetings = Contacts::new();
        self.meet(a, b, |meeting| add(&mut meetings, meeting));
        self.meet(b, a, |Contact { points: [first, second] }| {
            add(&mut meetings, Contact { points: [second, first] });
        });
        if let Some(piece) = ends(&meetings) {
            pieces.of_faces.entry([a.face, b.face]).or_default().push(piece);
        }
    }

    /// Cuts the second of two triangles in one plane along the sides of the first that are edges.
    fn add_outline(&self, a: &FaceTriangle, b: &FaceTriangle, pieces: &mut Pieces) {
        for side in 0..3 {
            let ends_of_side = [a.vertices[side], a.vertices[(side + 1) % 3]];
            let Some(edge) = self.edge_of_face(a.face, ends_of_side) else { continue };
            let mut meetings = Contacts::new();
            self.meet_side(a, b, side, &mut |meeting| add(&mut meetings, meeting));
            if let Some(piece) = ends(&meetings) {
                pieces.along_edges.entry((edge, b.face)).or_default().push(piece);
            }
        }
    }

    fn is_face_flat(&self, face: FaceId) -> bool {
        is_flat(&self.face_vertices(face).map(|vertex| self.position(vertex)).collect::<Vec<_>>())
    }

    /// Adds a line, but along an edge.
    fn add_line_within(&self, face: FaceId, ends: [CutPoint; 2], lines: &mut Vec<CutLine>) {
        if self.edge_along(ends).is_none() && ends[0].position != ends[1].position {
            lines.push(CutLine { ends, face: Some(face) });
        }
    }

    /// Where the sides and corners of a triangle meet another one.
    fn meet(&self, own: &FaceTriangle, other: &FaceTriangle, mut call: impl FnMut(Contact)) {
        for side in 0..3 {
            self.meet_side(own, other, side, &mut call);
        }
    }

    /// Where a side of a triangle and its first end meet another one.
    fn meet_side(
        &self,
        own: &FaceTriangle,
        other: &FaceTriangle,
        side: usize,
        call: &mut impl FnMut(Contact),
    ) {
        let mut vertices = [own.vertices[side], own.vertices[(side + 1) % 3]];
        // From either triangle at it, a side runs the same way.
        vertices.sort_unstable();
        let ends = vertices.map(|vertex| self.point(vertex));
        let corners = other.positions.map(|corner| corner.as_dvec3());
        let sides = ends.map(|end| side_of_triangle(corners, end));
        for (number, vertex) in vertices.into_iter().enumerate() {
            let there = match sides[number] {
                Ordering::Equal => self.site_in_plane(other, ends[number]),
                _ => None,
            };
            if let Some(there) = there {
                call(Contact { points: [self.cut_point_at(vertex), there] });
            }
        }
        if sides == [Ordering::Equal; 2] {
            self.meet_in_plane(own, vertices, other, call);
        } else if sides[0] != sides[1] && !sides.contains(&Ordering::Equal) {
            let turns = [0, 1, 2].map(|corner| {
                side_of_triangle([ends[0], ends[1], corners[corner]], corners[(corner + 1) % 3])
            });
            let has = |way| turns.contains(&way);
            if has(Ordering::Less) && has(Ordering::Greater) {
                return;
            }
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            let [from, to] = ends.map(|end| normal.dot(end - corners[0]));
            let here = self.on_side(own.face, vertices, from / (from - to));
            let touched: SmallVec<[usize; 3]> =
                (0..3).filter(|&corner| turns[corner] == Ordering::Equal).collect();
            call(Contact { points: [here, self.site_at(other, &touched, here)] });
        }
    }

    /// Where a side in the plane of another triangle crosses sides of that.
    fn meet_in_plane(
        &self,
        own: &FaceTriangle,
        vertices: [VertexId; 2],
        other: &FaceTriangle,
        call: &mut impl FnMut(Contact),
    ) {
        let flatten = flat(other);
        let [a, b] = vertices.map(|vertex| flatten(self.point(vertex)));
        for side in 0..3 {
            let mut others = [other.vertices[side], other.vertices[(side + 1) % 3]];
            others.sort_unstable();
            let [c, d] = others.map(|vertex| flatten(self.point(vertex)));
            let opposite =
                |one: Orientation, two: Orientation| one != Orientation::Collinear && two == one.reversed();
            if opposite(orientation(a, b, c), orientation(a, b, d))
                && opposite(orientation(c, d, a), orientation(c, d, b))
            {
                let turns = [a, b].map(|at| (d - c).perp_dot(at - c));
                let here = self.on_side(own.face, vertices, turns[0] / (turns[0] - turns[1]));
                call(Contact { points: [here, self.site_at(other, &[side], here)] });
            }
        }
    }

    /// A point of a triangle's side: on an edge, or on a diagonal of its face.
    fn on_side(&self, face: FaceId, vertices: [VertexId; 2], share: f64) -> CutPoint {
        let share = if share.is_nan() { 0.5 } else { share.clamp(0.0, 1.0) };
        match self.edge_of_face(face, vertices) {
            Some(edge) => {
                let is_forward = self.edge_vertices(edge)[0] == vertices[0];
                self.on_edge(edge, if is_forward { share } else { 1.0 - share })
            }
            None => {
                let [a, b] = vertices.map(|vertex| self.point(vertex));
                let position = (a * (1.0 - share) + b * share).as_vec3();
                CutPoint { site: Site::Face(face), position, parameter: 0.0 }
            }
        }
    }

    /// The point of a triangle in a position at some of its sides: two of them meet in a corner.
    fn site_at(&self, triangle: &FaceTriangle, sides: &[usize], at: CutPoint) -> CutPoint {
        let ends = |side: usize| [triangle.vertices[side], triangle.vertices[(side + 1) % 3]];
        match *sides {
            [first, second, ..] => {
                let common = ends(first).into_iter().find(|vertex| ends(second).contains(vertex));
                self.cut_point_at(common.unwrap_or(triangle.vertices[0]))
            }
            [side] => match self.edge_of_face(triangle.face, ends(side)) {
                Some(edge) => {
                    let [a, b] = self.edge_vertices(edge).map(|vertex| self.point(vertex));
                    let along = b - a;
                    let share = (at.position.as_dvec3() - a).dot(along) / along.length_squared();
                    self.on_edge(edge, share.clamp(0.0, 1.0))
                }
                None => CutPoint { site: Site::Face(triangle.face), ..at },
            },
            [] => CutPoint { site: Site::Face(triangle.face), position: at.position, parameter: 0.0 },
        }
    }

    /// The point of a triangle in a position of its plane; `None` outside.
    fn site_in_plane(&self, triangle: &FaceTriangle, position: DVec3) -> Option<CutPoint> {
        let flatten = flat(triangle);
        let at = flatten(position);
        let corners = triangle.positions.map(|corner| flatten(corner.as_dvec3()));
        let turns = [0, 1, 2].map(|side| orientation(corners[side], corners[(side + 1) % 3], at));
        if turns.contains(&Orientation::Clockwise) {
            return None;
        }
        let touched: SmallVec<[usize; 3]> =
            (0..3).filter(|&side| turns[side] == Orientation::Collinear).collect();
        let here = CutPoint { site: Site::Face(triangle.face), position: position.as_vec3(), parameter: 0.0 };
        Some(self.site_at(triangle, &touched, here))
    }

    /// The edge of a face between two of its vertices, if they are neighbours in it.
    fn edge_of_face(&self, face: FaceId, [a, b]: [VertexId; 2]) -> Option<EdgeId> {
        let edge = self.find_edge(a, b)?;
        self.edge_faces(edge).any(|own| own == face).then_some(edge)
    }
}

/// Sees a triangle so that it runs counter-clockwise.
fn flat(triangle: &FaceTriangle) -> impl Fn(DVec3) -> DVec2 {
    let view = AxisProjection::of(&triangle.positions);
    move |position| view.project(position)
}

/// Adds a meeting, unless it is there.
fn add(meetings: &mut Contacts, new: Contact) {
    let keys = |meeting: &Contact| meeting.points.map(|point| position_key(point.position));
    let is_on_edges = |meeting: &Contact| {
        meeting.points.iter().all(|point| matches!(point.site, Site::Edge(_) | Site::Vertex(_)))
    };
    let sites = |meeting: &Contact| meeting.points.map(|point| point.site);
    let is_same = |known: &Contact| {
        keys(known).iter().zip(keys(&new)).any(|(known, new)| *known == new)
            || is_on_edges(known) && sites(known) == sites(&new)
    };
    if !meetings.iter().any(is_same) {
        meetings.push(new);
    }
}

/// The two that are farthest apart.
fn ends(meetings: &Contacts) -> Option<[Contact; 2]> {
    let pairs = (0..meetings.len()).flat_map(|i| (0..i).map(move |j| [meetings[j], meetings[i]]));
    let length = |pair: &[Contact; 2]| {
        let [a, b] = pair.map(|meeting| meeting.points[0].position.as_dvec3());
        a.distance_squared(b)
    };
    pairs.max_by(|a, b| length(a).total_cmp(&length(b)))
}

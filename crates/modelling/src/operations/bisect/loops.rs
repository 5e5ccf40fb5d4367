//! Loops of edges on a plane, and the faces that fill them.

use std::collections::BTreeMap;

use trigon_math::{AxisProjection, DVec2, DVec3, Orientation, orientation};

use crate::edit_mesh::EditMesh;
use crate::euler::simple_parts;
use crate::ids::{CornerId, FaceId, VertexId};

/// A step of a filling face.
#[derive(Debug, Clone, Copy)]
pub(super) struct CutEdge {
    pub(super) ends: [VertexId; 2],
    /// A corner of a face along it, for the values.
    pub(super) source: CornerId,
}

/// A closed walk, as positions in the plane; it visits each vertex once.
#[derive(Debug, Clone)]
struct CutLoop {
    vertices: Vec<VertexId>,
    points: Vec<DVec2>,
    /// Twice the area; negative for a hole.
    area: f64,
}

impl EditMesh {
    /// Fills the loops of some steps, seen against a direction: those that run clockwise are holes in the others.
    pub(super) fn fill_cut(&mut self, cut: &[CutEdge], towards: DVec3) -> Vec<FaceId> {
        let view = AxisProjection::against(towards);
        let outline = |vertices: Vec<VertexId>| {
            let points: Vec<DVec2> =
                vertices.iter().map(|&vertex| view.project(self.point(vertex))).collect();
            CutLoop { area: doubled_area(&points), vertices, points }
        };
        let outlines: Vec<CutLoop> = loops(cut).into_iter().map(outline).collect();
        let walks = with_holes(outlines);
        let mut sources = BTreeMap::new();
        for edge in cut {
            let next = self.next_corner(edge.source);
            for corner in [edge.source, next] {
                sources.entry(self.corner_vertex(corner)).or_insert(corner);
            }
        }
        walks.iter().flat_map(|walk| self.fill_walk(walk, &sources)).collect()
    }

    fn fill_walk(&mut self, walk: &CutLoop, sources: &BTreeMap<VertexId, CornerId>) -> Vec<FaceId> {
        let parts = simple_parts(&walk.vertices, |vertex| self.position(vertex));
        let mut faces = Vec::new();
        for part in parts.iter() {
            let vertices: Vec<VertexId> = part.iter().map(|&index| walk.vertices[index as usize]).collect();
            if self.face_over(&vertices, |_| false).is_some() {
                continue;
            }
            let face = self.face_of(&vertices);
            if let Some(&source) = sources.get(&vertices[0]) {
                self.copy_face(self.corner_face(source), face);
            }
            let corners: Vec<CornerId> = self.face_corners(face).collect();
            for (corner, vertex) in corners.into_iter().zip(&vertices) {
                if let Some(&source) = sources.get(vertex) {
                    self.copy_corner_upright(source, corner);
                }
            }
            self.reveal_outline(face);
            faces.push(face);
        }
        faces
    }
}

/// The closed walks along steps, each step once. Where steps end nowhere, they are left out.
fn loops(cut: &[CutEdge]) -> Vec<Vec<VertexId>> {
    let mut leaving: BTreeMap<VertexId, Vec<VertexId>> = BTreeMap::new();
    for edge in cut.iter().rev() {
        leaving.entry(edge.ends[0]).or_default().push(edge.ends[1]);
    }
    let mut found = Vec::new();
    for edge in cut {
        let mut walk = vec![edge.ends[0]];
        let mut at: BTreeMap<VertexId, usize> = BTreeMap::from([(edge.ends[0], 0)]);
        while let Some(next) = walk.last().and_then(|here| leaving.get_mut(here)?.pop()) {
            let Some(&start) = at.get(&next) else {
                at.insert(next, walk.len());
                walk.push(next);
                continue;
            };
            let outline: Vec<VertexId> = walk[start..].to_vec();
            walk[start + 1..].iter().for_each(|vertex| {
                at.remove(vertex);
            });
            walk.truncate(start + 1);
            if outline.len() > 2 {
                found.push(outline);
            }
        }
    }
    found
}

fn doubled_area(points: &[DVec2]) -> f64 {
    let Some(&origin) = points.first() else { return 0.0 };
    points.windows(2).map(|pair| (pair[0] - origin).perp_dot(pair[1] - origin)).sum()
}

/// Joins holes by bridges to the smallest outlines around them. A hole without such an outline stays alone.
fn with_holes(outlines: Vec<CutLoop>) -> Vec<CutLoop> {
    let (mut walks, mut holes): (Vec<CutLoop>, Vec<CutLoop>) =
        outlines.into_iter().partition(|outline| outline.area > 0.0);
    // From the right to the left, so that a bridge to the right meets no hole that is not joined yet.
    let right = |hole: &CutLoop| hole.points.iter().map(|point| point.x).fold(f64::NEG_INFINITY, f64::max);
    holes.sort_by(|a, b| right(b).total_cmp(&right(a)));
    let count = walks.len();
    let areas: Vec<f64> = walks.iter().map(|walk| walk.area).collect();
    let borders: Vec<Vec<DVec2>> = walks.iter().map(|walk| walk.points.clone()).collect();
    for hole in holes {
        let around = (0..count).filter(|&number| is_inside(hole.points[0], &borders[number]));
        match around.min_by(|&a, &b| areas[a].total_cmp(&areas[b])) {
            Some(number) => {
                let joined = bridged(&walks[number], &hole);
                walks[number] = joined;
            }
            None => walks.push(hole),
        }
    }
    walks
}

/// Whether a point is inside an outline, or on it in part: counted along a ray to the right.
fn is_inside(point: DVec2, outline: &[DVec2]) -> bool {
    let mut inside = false;
    for (i, &a) in outline.iter().enumerate() {
        let b = outline[(i + 1) % outline.len()];
        if (a.y > point.y) != (b.y > point.y) {
            let [low, high] = if a.y < b.y { [a, b] } else { [b, a] };
            inside ^= orientation(low, high, point) == Orientation::CounterClockwise;
        }
    }
    inside
}

/// A walk that goes to a hole, around it, and back.
fn bridged(walk: &CutLoop, hole: &CutLoop) -> CutLoop {
    let mut rightmost = 0;
    for index in 1..hole.points.len() {
        if hole.points[index].x > hole.points[rightmost].x {
            rightmost = index;
        }
    }
    let tip = hole.points[rightmost];
    let mut order: Vec<usize> = (0..walk.points.len()).collect();
    order.sort_by(|&a, &b| {
        let distance = |index: usize| walk.points[index].distance_squared(tip);
        distance(a).total_cmp(&distance(b)).then(a.cmp(&b))
    });
    let is_free = |end: DVec2, outline: &[DVec2]| {
        (0..outline.len()).all(|i| !crosses([tip, end], [outline[i], outline[(i + 1) % outline.len()]]))
    };
    let is_visible = |&index: &usize| {
        let end = walk.points[index];
        // To the left it would go through the hole itself, or one that is not joined yet.
        end.x >= tip.x
            && opens_towards(walk, index, tip)
            && is_free(end, &walk.points)
            && is_free(end, &hole.points)
    };
    // Loops of a surface that crosses itself may have no bridge: any one gives faces with the right area.
    let to = [order.into_iter().find(is_visible).unwrap_or(0), rightmost];
    let mut joined = CutLoop { vertices: Vec::new(), points: Vec::new(), area: walk.area + hole.area };
    let mut push = |from: &CutLoop, index: usize| {
        let index = index % from.points.len();
        joined.vertices.push(from.vertices[index]);
        joined.points.push(from.points[index]);
    };
    (0..=to[0]).for_each(|index| push(walk, index));
    (to[1]..=to[1] + hole.points.len()).for_each(|index| push(hole, index));
    (to[0]..walk.points.len()).for_each(|index| push(walk, index));
    joined
}

/// Whether a point is within the angle of a walk at one of its corners: a walk with a bridge comes to a vertex twice.
fn opens_towards(walk: &CutLoop, index: usize, to: DVec2) -> bool {
    let count = walk.points.len();
    let (back, here, ahead) =
        (walk.points[(index + count - 1) % count], walk.points[index], walk.points[(index + 1) % count]);
    let turns = |a, b, c| orientation(a, b, c) != Orientation::Clockwise;
    let (after, before) = (turns(here, ahead, to), turns(back, here, to));
    if orientation(back, here, ahead) == Orientation::Clockwise { after || before } else { after && before }
}

/// Whether two segments meet, but for common ends.
fn crosses([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    if [c, d].contains(&a) || [c, d].contains(&b) {
        return false;
    }
    let apart = |from, to, one, two| {
        let sides = [orientation(from, to, one), orientation(from, to, two)];
        sides[0] == sides[1] && sides[0] != Orientation::Collinear
    };
    let is_flat = [c, d].iter().all(|&point| orientation(a, b, point) == Orientation::Collinear);
    if is_flat {
        let (low, high) = (a.min(b), a.max(b));
        return c.max(d).cmpge(low).all() && c.min(d).cmple(high).all();
    }
    !apart(a, b, c, d) && !apart(c, d, a, b)
}

//! The steps of a spin: rings of vertices, with faces from each to the next.

use trigon_math::{DVec3, DisjointSets};

use super::{OPERATION, Spun, Turns};
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::numbering::sorted_once;
use crate::operations::tables::IndexTable;
use crate::refusal::Refusal;
use crate::slots::NewElements;

/// A vertex nearer to the axis than this part of the farthest one's distance is on it.
const ON_AXIS: f64 = 1e-6;

/// An edge that is swept.
struct SweptEdge {
    edge: EdgeId,
    /// Its ends in the list of vertices, in the order in which faces run along the given edge.
    ends: [usize; 2],
    /// A corner of a face along it, from which new faces have their values.
    source: Option<CornerId>,
}

/// What is swept.
pub(super) struct Sweep {
    vertices: Vec<VertexId>,
    /// Whether each vertex is on the axis and stays single.
    is_fixed: Vec<bool>,
    sides: Vec<SweptEdge>,
}

/// The vertices and edges of a step.
#[derive(Clone)]
struct SweptRing {
    vertices: Vec<VertexId>,
    /// By sides.
    edges: Vec<EdgeId>,
}

impl Sweep {
    pub(super) fn of(
        mesh: &EditMesh,
        edges: &[EdgeId],
        vertices: &[VertexId],
        turns: &Turns,
    ) -> Result<Self, Refusal> {
        let edges = sorted_once(edges.to_vec());
        let ends = edges.iter().flat_map(|&edge| mesh.edge_vertices(edge));
        let vertices = sorted_once(ends.chain(vertices.iter().copied()).collect());
        let distance = |&vertex: &VertexId| turns.arm(mesh.point(vertex)).length();
        let farthest = vertices.iter().map(distance).fold(0.0, |a: f64, b| if b > a { b } else { a });
        let is_on_axis = |vertex: &VertexId| distance(vertex) <= ON_AXIS * farthest;
        let is_fixed: Vec<bool> =
            vertices.iter().map(|vertex| turns.height == 0.0 && is_on_axis(vertex)).collect();
        if is_fixed.iter().all(|&is_fixed| is_fixed) {
            let reason = "everything is on the axis: move the axis away";
            return Err(Refusal::NotPossible { operation: OPERATION, reason });
        }
        let mut numbers = IndexTable::new(mesh.vertex_capacity(), vertices.len());
        for (number, vertex) in (0..).zip(&vertices) {
            numbers.insert(vertex.0, number);
        }
        let number = |vertex: VertexId| numbers.get(vertex.0).expect("all are listed") as usize;
        let starts = mesh.wall_starts(&edges);
        let side = |(&edge, &start): (&EdgeId, &VertexId)| SweptEdge {
            edge,
            ends: [start, mesh.other_vertex(edge, start)].map(number),
            source: mesh.edge_corners(edge).next(),
        };
        let sides = edges.iter().zip(&starts).map(side).collect();
        let mut sweep = Self { vertices, is_fixed, sides };
        sweep.turn_outwards(mesh, turns);
        Ok(sweep)
    }

    /// Turns connected sides over that look towards the axis, unless they continue faces. For a closed profile, the sum of
    /// areas times distances from the axis is twice its volume (divergence theorem for the vector across the axis).
    fn turn_outwards(&mut self, mesh: &EditMesh, turns: &Turns) {
        let mut sets = DisjointSets::new(self.vertices.len());
        for side in &self.sides {
            sets.join(side.ends[0] as u32, side.ends[1] as u32);
        }
        let (rotation, way) = turns.after(1);
        let mut sums = vec![0.0; self.vertices.len()];
        let mut is_bound = vec![false; self.vertices.len()];
        for side in &self.sides {
            let set = sets.root(side.ends[0] as u32) as usize;
            is_bound[set] |= mesh.is_boundary(side.edge);
            let [a, b] = side.ends.map(|end| mesh.point(self.vertices[end]));
            let [c, d] = [b, a].map(|point| turns.center + rotation * (point - turns.center) + way);
            // Two triangles: the area vector times the mean arm, each six times.
            for [p, q, r] in [[a, b, c], [a, c, d]] {
                let arms = turns.arm(p) + turns.arm(q) + turns.arm(r);
                sums[set] += (q - p).cross(r - p).dot(arms);
            }
        }
        for side in &mut self.sides {
            let set = sets.root(side.ends[0] as u32) as usize;
            if !is_bound[set] && sums[set] < 0.0 {
                side.ends.reverse();
            }
        }
    }

    /// The number of a vertex among those that are swept, which is its number at the end, too.
    pub(super) fn number(&self, vertex: VertexId) -> Option<usize> {
        self.vertices.binary_search(&vertex).ok()
    }

    /// How many elements there will be more.
    pub(super) fn new_elements(&self, turns: &Turns) -> NewElements {
        let (steps, vertices, sides) =
            (u64::from(turns.steps), self.vertices.len() as u64, self.sides.len() as u64);
        NewElements {
            vertices: steps * vertices,
            edges: steps * (vertices + sides),
            corners: 4 * steps * sides,
            faces: steps * sides,
        }
    }

    pub(super) fn run(&self, mesh: &mut EditMesh, turns: &Turns) -> Spun {
        let first = SweptRing {
            vertices: self.vertices.clone(),
            edges: self.sides.iter().map(|side| side.edge).collect(),
        };
        let points: Vec<DVec3> = self.vertices.iter().map(|&vertex| mesh.point(vertex)).collect();
        let mut ring = first.clone();
        let mut spun = Spun::default();
        for step in 1..=turns.steps {
            let next = if turns.is_joined && step == turns.steps {
                first.clone()
            } else {
                self.next_ring(mesh, turns, step, &points, &first)
            };
            self.add_faces(mesh, &ring, &next, &mut spun);
            ring = next;
        }
        spun.edges = ring.edges;
        spun.vertices = ring.vertices;
        spun
    }

    fn next_ring(
        &self,
        mesh: &mut EditMesh,
        turns: &Turns,
        step: u32,
        points: &[DVec3],
        first: &SweptRing,
    ) -> SweptRing {
        let (rotation, way) = turns.after(step);
        let mut vertices = Vec::with_capacity(points.len());
        for ((&vertex, &point), &is_fixed) in first.vertices.iter().zip(points).zip(&self.is_fixed) {
            if is_fixed {
                vertices.push(vertex);
                continue;
            }
            let twin = mesh.twin_vertex(vertex);
            let position = turns.center + rotation * (point - turns.center) + way;
            mesh.set_position(twin, position.as_vec3());
            mesh.set_first_position(twin, position.as_vec3());
            vertices.push(twin);
        }
        let edges = self.sides.iter().map(|side| {
            let [a, b] = side.ends;
            if self.is_fixed[a] && self.is_fixed[b] {
                return side.edge;
            }
            let edge = mesh.fresh_edge(vertices[a], vertices[b]);
            mesh.copy_edge(side.edge, edge);
            edge
        });
        let edges = edges.collect();
        SweptRing { vertices, edges }
    }

    fn add_faces(&self, mesh: &mut EditMesh, from: &SweptRing, to: &SweptRing, spun: &mut Spun) {
        let rails: Vec<Option<EdgeId>> = (0..self.vertices.len())
            .map(|index| {
                let (a, b) = (from.vertices[index], to.vertices[index]);
                (a != b).then(|| mesh.fresh_edge(a, b))
            })
            .collect();
        for (number, side) in self.sides.iter().enumerate() {
            let [a, b] = side.ends;
            // Each vertex with the edge to the next one, and which end of the side it comes from.
            let mut outline = vec![((from.vertices[a], from.edges[number]), a)];
            match (rails[a], rails[b]) {
                (None, None) => continue,
                (Some(at_a), Some(at_b)) => outline.extend([
                    ((from.vertices[b], at_b), b),
                    ((to.vertices[b], to.edges[number]), b),
                    ((to.vertices[a], at_a), a),
                ]),
                (None, Some(at_b)) => {
                    outline.extend([((from.vertices[b], at_b), b), ((to.vertices[b], to.edges[number]), b)]);
                }
                (Some(at_a), None) => {
                    outline.extend([((from.vertices[b], to.edges[number]), b), ((to.vertices[a], at_a), a)]);
                }
            }
            let (steps, ends): (Vec<(VertexId, EdgeId)>, Vec<usize>) = outline.into_iter().unzip();
            let face = mesh.face_along(&steps);
            if let Some(source) = side.source {
                self.dress(mesh, face, source, &ends);
            }
            spun.faces.push(face);
        }
    }

    /// Gives a face the values of one along the given edge: each corner those of its end of the side.
    fn dress(&self, mesh: &mut EditMesh, face: FaceId, source: CornerId, ends: &[usize]) {
        mesh.copy_face(mesh.corner_face(source), face);
        let corners: Vec<CornerId> = mesh.face_corners(face).collect();
        for (corner, &end) in corners.into_iter().zip(ends) {
            let is_here = mesh.corner_vertex(source) == self.vertices[end];
            mesh.copy_corner_upright(if is_here { source } else { mesh.next_corner(source) }, corner);
        }
    }
}

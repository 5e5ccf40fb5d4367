//! The representations of a mesh, a struct for each: lists of faces, lists of vertices, the corner table, winged
//! edges, and faces with explicit edges as the engine has them.

use std::collections::BTreeMap;

use trigon_math::Vec3;
use trigon_mesh::Mesh;

use super::Triangles;
use super::answer::{Groups, List, Reads, Storage, byte_count, in_order, mesh_of, nearest};

/// Faces and vertices that know each other.
pub struct FaceList<const COUNTED: bool> {
    positions: Vec<Vec3>,
    faces: List<[u32; 3], COUNTED>,
    neighbours: Groups<COUNTED>,
    faces_around: Groups<COUNTED>,
}

impl<const COUNTED: bool> FaceList<COUNTED> {
    /// Of a closed mesh.
    #[must_use]
    pub fn new(Triangles { positions, triangles }: &Triangles) -> Self {
        let sides = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let corners = (0..).zip(triangles).flat_map(|(face, triangle)| triangle.map(|vertex| [vertex, face]));
        Self {
            positions: positions.clone(),
            faces: List::new(triangles.clone()),
            neighbours: Groups::new(positions.len(), sides),
            faces_around: Groups::new(positions.len(), corners),
        }
    }

    fn triangle(&self, face: u32) -> [u32; 3] {
        self.faces.read(face, |vertices| *vertices)
    }
}

impl<const COUNTED: bool> Storage for FaceList<COUNTED> {
    fn bytes(&self) -> usize {
        let lists = self.neighbours.bytes() + self.faces_around.bytes();
        byte_count(&self.positions) + self.faces.bytes() + lists
    }

    fn reads(&self) -> u64 {
        self.faces.reads() + self.neighbours.reads() + self.faces_around.reads()
    }

    fn nearest_edge(&self, face: u32, point: Vec3) -> [u32; 2] {
        let [a, b, c] = self.triangle(face);
        nearest([[a, b], [b, c], [c, a]], &self.positions, point)
    }

    fn triangles_around(&self, vertex: u32) -> Vec<[u32; 3]> {
        in_order(self.faces_around.of(vertex).map(|face| self.triangle(face)).collect())
    }

    fn neighbours(&self, vertex: u32) -> Vec<u32> {
        let mut answer: Vec<u32> = self.neighbours.of(vertex).collect();
        answer.sort_unstable();
        answer
    }
}

/// Vertices that know their neighbours.
pub struct VertexList<const COUNTED: bool> {
    positions: Vec<Vec3>,
    neighbours: Groups<COUNTED>,
}

impl<const COUNTED: bool> VertexList<COUNTED> {
    /// Of a closed mesh, where each side of a triangle is that of another, reversed.
    #[must_use]
    pub fn new(Triangles { positions, triangles }: &Triangles) -> Self {
        let sides = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        Self { positions: positions.clone(), neighbours: Groups::new(positions.len(), sides) }
    }
}

impl<const COUNTED: bool> Storage for VertexList<COUNTED> {
    fn bytes(&self) -> usize {
        byte_count(&self.positions) + self.neighbours.bytes()
    }

    fn reads(&self) -> u64 {
        self.neighbours.reads()
    }

    /// Without faces, among all edges.
    fn nearest_edge(&self, _: u32, point: Vec3) -> [u32; 2] {
        let vertices = 0..self.positions.len() as u32;
        let edges = vertices.flat_map(|a| self.neighbours.of(a).map(move |b| [a, b]));
        nearest(edges, &self.positions, point)
    }

    /// Neighbours that are neighbours of each other.
    fn triangles_around(&self, vertex: u32) -> Vec<[u32; 3]> {
        let around = self.neighbours.of(vertex);
        let mut triangles = Vec::new();
        for one in around.clone() {
            let later = self.neighbours.of(one).filter(|&other| other > one);
            let shared = later.filter(|&other| around.clone().any(|third| third == other));
            triangles.extend(shared.map(|other| [vertex, one, other]));
        }
        in_order(triangles)
    }

    fn neighbours(&self, vertex: u32) -> Vec<u32> {
        let mut answer: Vec<u32> = self.neighbours.of(vertex).collect();
        answer.sort_unstable();
        answer
    }
}

/// The corner table (J. Rossignac, A. Safonova and A. Szymczak, "3D compression made simple: Edgebreaker on a
/// corner table", 2001): for each corner its vertex and the opposite corner in the neighbouring triangle.
/// Everything else follows from the corner's number.
///
/// Two numbers for each corner, and one corner for each vertex.
pub struct CornerTable<const COUNTED: bool> {
    positions: Vec<Vec3>,
    vertices: List<u32, COUNTED>,
    opposites: List<u32, COUNTED>,
    /// A corner of each vertex.
    corners: List<u32, COUNTED>,
}

/// The corner after this one in its triangle.
fn next(corner: u32) -> u32 {
    corner - corner % 3 + (corner + 1) % 3
}

impl<const COUNTED: bool> CornerTable<COUNTED> {
    /// Of a closed mesh.
    #[must_use]
    pub fn new(Triangles { positions, triangles }: &Triangles) -> Self {
        let vertices: Vec<u32> = triangles.as_flattened().to_vec();
        let side = |corner: u32| [next(corner), next(next(corner))].map(|corner| vertices[corner as usize]);
        let all = 0..vertices.len() as u32;
        let sides: BTreeMap<[u32; 2], u32> = all.clone().map(|corner| (side(corner), corner)).collect();
        let opposite = |corner: u32| {
            let [from, to] = side(corner);
            sides[&[to, from]]
        };
        let opposites = all.clone().map(opposite).collect();
        let mut corners = vec![0; positions.len()];
        all.for_each(|corner| corners[vertices[corner as usize] as usize] = corner);
        Self {
            positions: positions.clone(),
            vertices: List::new(vertices),
            opposites: List::new(opposites),
            corners: List::new(corners),
        }
    }

    fn vertex(&self, corner: u32) -> u32 {
        self.vertices.at(corner)
    }

    /// The corners of a vertex, in turn.
    fn corners_around(&self, vertex: u32) -> impl Iterator<Item = u32> + '_ {
        let first = self.corners.at(vertex);
        // Across the side before the corner, the vertex's corner follows the opposite.
        let turn = |corner: u32| next(self.opposites.at(next(corner)));
        std::iter::successors(Some(first), move |&corner| {
            Some(turn(corner)).filter(|&corner| corner != first)
        })
    }
}

impl<const COUNTED: bool> Storage for CornerTable<COUNTED> {
    fn bytes(&self) -> usize {
        let corners = self.vertices.bytes() + self.opposites.bytes();
        byte_count(&self.positions) + corners + self.corners.bytes()
    }

    fn reads(&self) -> u64 {
        self.vertices.reads() + self.opposites.reads() + self.corners.reads()
    }

    fn nearest_edge(&self, face: u32, point: Vec3) -> [u32; 2] {
        let [a, b, c] = [0, 1, 2].map(|i| self.vertex(3 * face + i));
        nearest([[a, b], [b, c], [c, a]], &self.positions, point)
    }

    fn triangles_around(&self, vertex: u32) -> Vec<[u32; 3]> {
        let triangle =
            |corner: u32| [corner, next(corner), next(next(corner))].map(|corner| self.vertex(corner));
        in_order(self.corners_around(vertex).map(triangle).collect())
    }

    fn neighbours(&self, vertex: u32) -> Vec<u32> {
        let mut answer: Vec<u32> =
            self.corners_around(vertex).map(|corner| self.vertex(next(corner))).collect();
        answer.sort_unstable();
        answer
    }
}

/// An edge with all that meets it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Wings {
    vertices: [u32; 2],
    /// The face that runs along the edge as it does, and the one that runs against it.
    faces: [u32; 2],
    /// The edges before and after it in the first face, then in the second.
    wings: [u32; 4],
}

/// Winged edges (B. G. Baumgart, "Winged edge polyhedron representation", Stanford STAN-CS-320, 1972) as in
/// source D. Vertices and faces store the edges around them, and an edge stores its two vertices, its two
/// faces and its four neighbouring edges.
///
/// Vertices, edges and faces that know each other.
pub struct WingedEdge<const COUNTED: bool> {
    positions: Vec<Vec3>,
    edges: List<Wings, COUNTED>,
    face_edges: List<[u32; 3], COUNTED>,
    vertex_edges: Groups<COUNTED>,
}

impl<const COUNTED: bool> WingedEdge<COUNTED> {
    /// Of a closed mesh.
    #[must_use]
    pub fn new(Triangles { positions, triangles }: &Triangles) -> Self {
        let mut numbers = BTreeMap::new();
        for &[a, b, c] in triangles {
            for [from, to] in [[a, b], [b, c], [c, a]] {
                let next = numbers.len() as u32;
                numbers.entry(super::answer::edge(from, to)).or_insert(next);
            }
        }
        let unknown = Wings { vertices: [0; 2], faces: [0; 2], wings: [0; 4] };
        let mut edges = vec![unknown; numbers.len()];
        let mut face_edges = Vec::with_capacity(triangles.len());
        for (face, &[a, b, c]) in (0..).zip(triangles) {
            let sides = [[a, b], [b, c], [c, a]];
            let around = sides.map(|[from, to]| numbers[&super::answer::edge(from, to)]);
            for (i, [from, to]) in sides.into_iter().enumerate() {
                let wings = &mut edges[around[i] as usize];
                wings.vertices = super::answer::edge(from, to);
                let side = usize::from(from > to);
                wings.faces[side] = face;
                [wings.wings[2 * side], wings.wings[2 * side + 1]] =
                    [around[(i + 2) % 3], around[(i + 1) % 3]];
            }
            face_edges.push(around);
        }
        let ends = (0..).zip(&edges).flat_map(|(edge, wings)| wings.vertices.map(|vertex| [vertex, edge]));
        let vertex_edges = Groups::new(positions.len(), ends);
        let (edges, face_edges) = (List::new(edges), List::new(face_edges));
        Self { positions: positions.clone(), edges, face_edges, vertex_edges }
    }

    fn vertices(&self, edge: u32) -> [u32; 2] {
        self.edges.read(edge, |wings| wings.vertices)
    }
}

impl<const COUNTED: bool> Storage for WingedEdge<COUNTED> {
    fn bytes(&self) -> usize {
        let lists = self.edges.bytes() + self.face_edges.bytes();
        byte_count(&self.positions) + lists + self.vertex_edges.bytes()
    }

    fn reads(&self) -> u64 {
        self.edges.reads() + self.face_edges.reads() + self.vertex_edges.reads()
    }

    fn nearest_edge(&self, face: u32, point: Vec3) -> [u32; 2] {
        let edges = self.face_edges.read(face, |edges| *edges).map(|edge| self.vertices(edge));
        nearest(edges, &self.positions, point)
    }

    /// Each edge of the vertex leads to the face on one side of it, and a wing to that
    /// face's third vertex.
    fn triangles_around(&self, vertex: u32) -> Vec<[u32; 3]> {
        let triangle = |edge: u32| {
            let [a, b] = self.vertices(edge);
            // The face that runs along the edge away from the vertex.
            let side = if a == vertex { 1 } else { 3 };
            let [wing] = self.edges.read(edge, |edge| [edge.wings[side]]);
            let [c, d] = self.vertices(wing);
            [a, b, if c == a || c == b { d } else { c }]
        };
        in_order(self.vertex_edges.of(vertex).map(triangle).collect())
    }

    fn neighbours(&self, vertex: u32) -> Vec<u32> {
        let other = |edge: u32| {
            let [a, b] = self.vertices(edge);
            if a == vertex { b } else { a }
        };
        let mut answer: Vec<u32> = self.vertex_edges.of(vertex).map(other).collect();
        answer.sort_unstable();
        answer
    }
}

/// Faces with explicit edges, as source D finally stores them, and as the engine's [`Mesh`] does: faces store
/// their vertices and edges, edges their vertices, and nothing leads from a vertex to its faces. Finding
/// these reads the whole list of corners.
///
/// The engine's mesh.
pub struct Own<const COUNTED: bool> {
    mesh: Mesh,
    reads: Reads<COUNTED>,
}

impl<const COUNTED: bool> Own<COUNTED> {
    /// Of a closed mesh, its edges found.
    #[must_use]
    pub fn new(triangles: &Triangles) -> Self {
        let mesh = mesh_of(triangles);
        mesh.edges();
        Self { mesh, reads: Reads::default() }
    }

    /// The vertices of a triangle.
    fn triangle(&self, face: usize) -> [u32; 3] {
        let vertices = self.mesh.face_vertices(face);
        [vertices[0], vertices[1], vertices[2]].map(|vertex| self.reads.note(vertex))
    }

    /// The ends of an edge.
    fn ends(&self, edge: u32) -> [u32; 2] {
        self.mesh.edges()[edge as usize].map(|vertex| self.reads.note(vertex))
    }
}

impl<const COUNTED: bool> Storage for Own<COUNTED> {
    fn bytes(&self) -> usize {
        let indices = self.mesh.face_count() + 1 + 2 * self.mesh.corner_count() + 2 * self.mesh.edge_count();
        size_of_val(self.mesh.positions()) + indices * size_of::<u32>()
    }

    fn reads(&self) -> u64 {
        self.reads.count()
    }

    fn nearest_edge(&self, face: u32, point: Vec3) -> [u32; 2] {
        let edges = self.mesh.face_corners(face as usize).filter_map(|corner| self.mesh.corner_edge(corner));
        let ends = edges.map(|edge| self.ends(self.reads.note(edge)));
        nearest(ends, self.mesh.positions(), point)
    }

    fn triangles_around(&self, vertex: u32) -> Vec<[u32; 3]> {
        let triangles = (0..self.mesh.face_count()).map(|face| self.triangle(face));
        in_order(triangles.filter(|triangle| triangle.contains(&vertex)).collect())
    }

    fn neighbours(&self, vertex: u32) -> Vec<u32> {
        let other = |[a, b]: [u32; 2]| if a == vertex { Some(b) } else { (b == vertex).then_some(a) };
        let mut answer: Vec<u32> =
            (0..self.mesh.edge_count() as u32).map(|edge| self.ends(edge)).filter_map(other).collect();
        answer.sort_unstable();
        answer
    }
}

//! How should a mesh be stored that is to be picked and edited? The representations of
//! source D, section 1.3 (row D14), on the tasks that it has: find the edge that is
//! nearest to a point under the mouse, find the faces that change when a vertex moves,
//! and walk to a vertex's neighbours.

mod corner_table;
mod face_list;
mod groups;
mod own;
mod reads;
mod vertex_list;
mod winged_edge;

#[cfg(test)]
mod tests;

pub use corner_table::CornerTable;
pub use face_list::FaceList;
pub use own::Own;
pub use vertex_list::VertexList;
pub use winged_edge::WingedEdge;

use trigon_math::Vec3;
use trigon_mesh::{Mesh, primitives};

/// A triangle mesh, closed and without borders: what all representations are made from.
#[derive(Clone, Debug)]
pub struct Triangles {
    /// Where the vertices lie.
    pub positions: Vec<Vec3>,
    /// Indices of vertices, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl Triangles {
    /// A ball of 20 · 4^`subdivisions` triangles.
    pub fn ball(subdivisions: u32) -> Self {
        let mesh = primitives::icosphere(1.0, subdivisions);
        let triangle = |face: usize| {
            let corners = mesh.face_vertices(face);
            [corners[0], corners[1], corners[2]]
        };
        Self {
            positions: mesh.positions().to_vec(),
            triangles: (0..mesh.face_count()).map(triangle).collect(),
        }
    }
}

/// A representation of a closed triangle mesh.
pub trait Storage {
    /// What the lists hold in memory.
    fn bytes(&self) -> usize;

    /// How many indices of vertices, edges, faces and corners were read so far: counted where they are read, in a
    /// representation that was made for counting, and 0 in the others.
    fn reads(&self) -> u64;

    /// The edge nearest to a point of a face: the one that a click means. Its smaller
    /// vertex is first.
    fn nearest_edge(&self, face: u32, point: Vec3) -> [u32; 2];

    /// The triangles about a vertex, whose planes change with it: vertices in ascending
    /// order, triangles likewise.
    fn triangles_around(&self, vertex: u32) -> Vec<[u32; 3]>;

    /// The vertices that share an edge with a vertex, in ascending order.
    fn neighbours(&self, vertex: u32) -> Vec<u32>;
}

/// Makes a representation.
pub type Maker = fn(&Triangles) -> Box<dyn Storage>;

/// A representation with its name in tables.
pub struct Representation {
    /// Its name.
    pub name: &'static str,
    /// Makes one that counts nothing, to be timed.
    pub plain: Maker,
    /// Makes one that counts what it reads.
    pub counted: Maker,
}

/// All representations.
pub const REPRESENTATIONS: [Representation; 5] = [
    Representation {
        name: "vertex lists",
        plain: |triangles| Box::new(VertexList::<false>::new(triangles)),
        counted: |triangles| Box::new(VertexList::<true>::new(triangles)),
    },
    Representation {
        name: "face lists",
        plain: |triangles| Box::new(FaceList::<false>::new(triangles)),
        counted: |triangles| Box::new(FaceList::<true>::new(triangles)),
    },
    Representation {
        name: "winged edges",
        plain: |triangles| Box::new(WingedEdge::<false>::new(triangles)),
        counted: |triangles| Box::new(WingedEdge::<true>::new(triangles)),
    },
    Representation {
        name: "corner table",
        plain: |triangles| Box::new(CornerTable::<false>::new(triangles)),
        counted: |triangles| Box::new(CornerTable::<true>::new(triangles)),
    },
    Representation {
        name: "faces with edges (D, trigon)",
        plain: |triangles| Box::new(Own::<false>::new(triangles)),
        counted: |triangles| Box::new(Own::<true>::new(triangles)),
    },
];

/// The smaller vertex first.
fn edge(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// The edge nearest to a point.
fn nearest(edges: impl IntoIterator<Item = [u32; 2]>, positions: &[Vec3], point: Vec3) -> [u32; 2] {
    let distance = |[a, b]: [u32; 2]| {
        let [from, to] = [a, b].map(|vertex| positions[vertex as usize]);
        let along = to - from;
        let share = ((point - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        point.distance_squared(from + along * share)
    };
    let edges = edges.into_iter().map(|[a, b]| edge(a, b));
    let best = edges.min_by(|&a, &b| distance(a).total_cmp(&distance(b)));
    best.expect("a closed mesh has edges")
}

/// In the order that [`Storage`] promises.
fn in_order(mut triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
    triangles.iter_mut().for_each(|triangle| triangle.sort_unstable());
    triangles.sort_unstable();
    triangles
}

/// What a list holds in memory.
fn byte_count<T>(list: &[T]) -> usize {
    size_of_val(list)
}

/// A mesh of the engine with the same triangles.
fn mesh_of(triangles: &Triangles) -> Mesh {
    let mut builder = trigon_mesh::MeshBuilder::new();
    triangles.positions.iter().for_each(|&position| {
        builder.push_vertex(position);
    });
    for triangle in &triangles.triangles {
        builder.push_face(triangle).expect("indices are those of the vertices");
    }
    builder.build()
}

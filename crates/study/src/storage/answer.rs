//! The tasks that each representation performs, the mesh from which all are built, and the lists that count
//! the indices that are read from them.

use std::cell::Cell;

use trigon_math::Vec3;
use trigon_mesh::{Mesh, primitives};

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

/// The smaller vertex first.
pub(super) fn edge(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// The edge nearest to a point.
pub(super) fn nearest(
    edges: impl IntoIterator<Item = [u32; 2]>,
    positions: &[Vec3],
    point: Vec3,
) -> [u32; 2] {
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
pub(super) fn in_order(mut triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
    triangles.iter_mut().for_each(|triangle| triangle.sort_unstable());
    triangles.sort_unstable();
    triangles
}

/// What a list holds in memory.
pub(super) fn byte_count<T>(list: &[T]) -> usize {
    size_of_val(list)
}

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
    #[must_use]
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

/// A mesh of the engine with the same triangles.
pub(super) fn mesh_of(triangles: &Triangles) -> Mesh {
    let mut builder = trigon_mesh::MeshBuilder::new();
    triangles.positions.iter().for_each(|&position| {
        builder.push_vertex(position);
    });
    for triangle in &triangles.triangles {
        builder.push_face(triangle).expect("indices are those of the vertices");
    }
    builder.build()
}

/// Counts where `COUNTED` is set. Elsewhere it does nothing, so that what is timed is the bare list.
#[derive(Default)]
pub(super) struct Reads<const COUNTED: bool>(Cell<u64>);

impl<const COUNTED: bool> Reads<COUNTED> {
    /// Hands on an index that has been read.
    #[inline]
    pub(super) fn note(&self, index: u32) -> u32 {
        if COUNTED {
            self.0.set(self.0.get() + 1);
        }
        index
    }

    pub(super) fn count(&self) -> u64 {
        self.0.get()
    }
}

/// A list whose elements consist of indices.
pub(super) struct List<T, const COUNTED: bool> {
    elements: Vec<T>,
    reads: Reads<COUNTED>,
}

impl<T, const COUNTED: bool> List<T, COUNTED> {
    pub(super) fn new(elements: Vec<T>) -> Self {
        Self { elements, reads: Reads::default() }
    }

    /// Reads those indices of an element that `part` picks.
    #[inline]
    pub(super) fn read<const N: usize>(&self, element: u32, part: impl Fn(&T) -> [u32; N]) -> [u32; N] {
        part(&self.elements[element as usize]).map(|index| self.reads.note(index))
    }

    pub(super) fn bytes(&self) -> usize {
        byte_count(&self.elements)
    }

    pub(super) fn reads(&self) -> u64 {
        self.reads.count()
    }
}

impl<const COUNTED: bool> List<u32, COUNTED> {
    /// Reads an index.
    #[inline]
    pub(super) fn at(&self, element: u32) -> u32 {
        self.read(element, |&index| [index])[0]
    }
}

/// For each key its values, in the order in which they were given.
pub(super) struct Groups<const COUNTED: bool> {
    starts: Vec<u32>,
    values: Vec<u32>,
    reads: Reads<COUNTED>,
}

impl<const COUNTED: bool> Groups<COUNTED> {
    /// Of pairs of a key below `count` and a value.
    pub(super) fn new(count: usize, pairs: impl Iterator<Item = [u32; 2]> + Clone) -> Self {
        let mut starts = vec![0; count + 1];
        for [key, _] in pairs.clone() {
            starts[key as usize + 1] += 1;
        }
        for key in 0..count {
            starts[key + 1] += starts[key];
        }
        let mut next = starts.clone();
        let mut values = vec![0; starts[count] as usize];
        for [key, value] in pairs {
            values[next[key as usize] as usize] = value;
            next[key as usize] += 1;
        }
        Self { starts, values, reads: Reads::default() }
    }

    /// The values of a key. Each counts as read when the iterator reaches it; where they begin and end does not count.
    #[inline]
    pub(super) fn of(&self, key: u32) -> impl Iterator<Item = u32> + Clone + '_ {
        let [from, to] = [0, 1].map(|i| self.starts[key as usize + i] as usize);
        self.values[from..to].iter().map(|&value| self.reads.note(value))
    }

    pub(super) fn reads(&self) -> u64 {
        self.reads.count()
    }

    pub(super) fn bytes(&self) -> usize {
        byte_count(&self.starts) + byte_count(&self.values)
    }
}

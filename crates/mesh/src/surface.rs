//! How the faces of a mesh join at their edges: where a surface is open, turned or not a surface. Here are
//! also its topology (what stays the same when a surface is bent) and its size.

use std::collections::HashMap;

use trigon_math::{DVec3, Vec3};

use super::Mesh;
use super::edges::NO_EDGE;

/// How the faces at an edge join.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EdgeJoin {
    /// No face is there.
    Loose,
    /// One face: the surface ends here.
    Open,
    /// Two faces that run along the edge in opposite directions: the inside of a surface.
    Closed,
    /// Two faces that run along it in the same direction: one of them shows its inside.
    Turned,
    /// Three faces or more: this is no surface.
    NonManifold,
}

impl EdgeJoin {
    /// From the sides of faces at the edge: for each, in which of the edge's two directions its face runs
    /// along it.
    #[must_use]
    pub fn of(mut sides: impl Iterator<Item = bool>) -> Self {
        match [sides.next(), sides.next(), sides.next()] {
            [None, ..] => Self::Loose,
            [Some(_), None, _] => Self::Open,
            [Some(one), Some(other), None] if one == other => Self::Turned,
            [Some(_), Some(_), None] => Self::Closed,
            _ => Self::NonManifold,
        }
    }
}

/// What a mesh is as a surface. Vertices at the same position count as one, because files split
/// vertices where attributes differ.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Surface {
    /// Edges of one face, by the indices of their vertices, the smaller one first; in ascending order.
    pub open_edges: Vec<[u32; 2]>,
    /// Edges of two faces that run along them in the same direction, likewise.
    pub turned_edges: Vec<[u32; 2]>,
    /// Edges of three or more faces, likewise.
    pub non_manifold_edges: Vec<[u32; 2]>,
    /// The volume of the largest closed part with consistent winding, in cubic units of the mesh:
    /// negative if it is inside out, 0 if there is none.
    pub volume: f64,
}

/// A side of a face: an edge, and how the face runs along it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Side {
    edge: [u32; 2],
    face: u32,
    is_ascending: bool,
}

impl Mesh {
    /// Finds how the faces join. Takes time in proportion to the number of corners and its logarithm.
    ///
    /// ```
    /// use trigon_mesh::{MeshBuilder, primitives};
    /// use trigon_mesh::math::Vec3;
    ///
    /// let closed = primitives::cube(2.0).surface();
    /// assert_eq!((closed.open_edges.len(), closed.volume), (0, 8.0));
    ///
    /// let mut builder = MeshBuilder::new();
    /// for corner in [Vec3::ZERO, Vec3::X, Vec3::Y] {
    ///     builder.push_vertex(corner);
    /// }
    /// builder.push_face(&[0, 1, 2])?;
    /// assert_eq!(builder.build().surface().open_edges, [[0, 1], [0, 2], [1, 2]]);
    /// # Ok::<(), trigon_mesh::MeshError>(())
    /// ```
    #[must_use]
    pub fn surface(&self) -> Surface {
        let mut parts = Components::new(self.face_count());
        let mut surface = Surface {
            open_edges: Vec::new(),
            turned_edges: Vec::new(),
            non_manifold_edges: Vec::new(),
            volume: 0.0,
        };
        for sides in sides(self).chunk_by(|one, other| one.edge == other.edge) {
            let edge = sides[0].edge;
            let join = EdgeJoin::of(sides.iter().map(|side| side.is_ascending));
            match join {
                EdgeJoin::Loose | EdgeJoin::Closed => {}
                EdgeJoin::Open => surface.open_edges.push(edge),
                EdgeJoin::Turned => surface.turned_edges.push(edge),
                EdgeJoin::NonManifold => surface.non_manifold_edges.push(edge),
            }
            parts.add(sides, join);
        }
        surface.volume = parts.largest_volume(self);
        surface
    }
}

/// All sides of faces that have a length, by edge.
fn sides(mesh: &Mesh) -> Vec<Side> {
    let points = welded(mesh);
    let mut sides = Vec::with_capacity(mesh.corner_count());
    for (face, index) in (0..mesh.face_count()).zip(0..) {
        let vertices = mesh.face_vertices(face);
        let next = vertices.iter().cycle().skip(1);
        for (&from, &to) in vertices.iter().zip(next) {
            let [from, to] = [from, to].map(|vertex| points[vertex as usize]);
            if from != to {
                let edge = [from.min(to), from.max(to)];
                sides.push(Side { edge, face: index, is_ascending: from < to });
            }
        }
    }
    sides.sort_unstable();
    sides
}

/// For each vertex the first one at the same position.
fn welded(mesh: &Mesh) -> Vec<u32> {
    let mut first: HashMap<[u32; 3], u32> = HashMap::new();
    let at = |(position, index): (&Vec3, u32)| {
        // 0 and −0 are the same position.
        let key = position.to_array().map(|coordinate| (coordinate + 0.0).to_bits());
        *first.entry(key).or_insert(index)
    };
    mesh.positions().iter().zip(0..).map(at).collect()
}

/// Connected faces.
struct Components {
    /// For each face another of its part, or itself.
    parents: Vec<usize>,
    /// Whether a face has an edge that closes nothing.
    is_open: Vec<bool>,
}

impl Components {
    fn new(faces: usize) -> Self {
        Self { parents: (0..faces).collect(), is_open: vec![false; faces] }
    }

    /// Takes the faces at one edge.
    fn add(&mut self, sides: &[Side], join: EdgeJoin) {
        if let (EdgeJoin::Closed | EdgeJoin::Turned, [one, other]) = (join, sides) {
            self.join(one.face as usize, other.face as usize);
        }
        if join != EdgeJoin::Closed {
            sides.iter().for_each(|side| self.is_open[side.face as usize] = true);
        }
    }

    fn root(&mut self, mut face: usize) -> usize {
        while self.parents[face] != face {
            self.parents[face] = self.parents[self.parents[face]];
            face = self.parents[face];
        }
        face
    }

    fn join(&mut self, one: usize, other: usize) {
        let (one, other) = (self.root(one), self.root(other));
        self.parents[one.max(other)] = one.min(other);
    }

    /// The volume of the largest closed part, negative if it is inside out.
    fn largest_volume(&mut self, mesh: &Mesh) -> f64 {
        let faces = self.parents.len();
        let (mut volumes, mut open) = (vec![0.0; faces], vec![false; faces]);
        // Relative to a point of the mesh, so that a distant position costs no digits.
        let origin = mesh.positions().first().copied().unwrap_or_default().as_dvec3();
        for face in 0..faces {
            let root = self.root(face);
            volumes[root] += cone(mesh, face, origin) / 6.0;
            open[root] |= self.is_open[face];
        }
        let closed = volumes.into_iter().zip(open).filter(|(_, open)| !open).map(|(volume, _)| volume);
        closed.fold(0.0, |largest: f64, volume| if volume.abs() > largest.abs() { volume } else { largest })
    }
}

/// Six times the volume between a face and a point: a fan of triangles gives the same as any other
/// triangulation.
fn cone(mesh: &Mesh, face: usize, origin: DVec3) -> f64 {
    let at = |vertex: u32| mesh.positions()[vertex as usize].as_dvec3() - origin;
    let vertices = mesh.face_vertices(face);
    let first = at(vertices[0]);
    vertices[1..].windows(2).map(|pair| first.dot(at(pair[0]).cross(at(pair[1])))).sum()
}

/// The corners that leave along an edge, for each edge of the faces: the first
/// two, and how many there are.
pub(crate) struct EdgeCorners {
    pub(crate) corners: Vec<[u32; 2]>,
    pub(crate) counts: Vec<u32>,
}

impl Mesh {
    /// Euler's characteristic, vertices minus edges plus faces: 2 for every solid without a hole
    /// through it, 0 for a torus, the sum over the parts if there are several.
    pub fn euler_characteristic(&self) -> i64 {
        self.vertex_count() as i64 - self.edge_count() as i64 + self.face_count() as i64
    }

    /// Whether the faces enclose a volume without gaps: there are faces, and every edge of theirs
    /// belongs to exactly two, in opposite directions.
    pub fn is_closed(&self) -> bool {
        let meeting = self.edge_corners();
        let opposed = |[a, b]: &[u32; 2]| {
            let vertices = self.corner_vertices();
            vertices[*a as usize] != vertices[*b as usize]
        };
        self.face_count() > 0
            && meeting.counts.iter().all(|&count| count == 2)
            && meeting.corners.iter().all(opposed)
    }

    /// The area of all faces in square metres; for a non-planar face, that of its area vector.
    pub fn surface_area(&self) -> f64 {
        (0..self.face_count()).map(|face| self.face_area_vector(face).length()).sum()
    }

    /// The volume inside the faces in cubic metres, by the divergence theorem over the
    /// triangulation. Negative if the faces point inwards. Meaningless unless the mesh [is
    /// closed](Mesh::is_closed).
    pub fn volume(&self) -> f64 {
        let corner = |corner: u32| self.position(self.corner_vertices()[corner as usize]);
        let origin = self.positions().first().map_or(DVec3::ZERO, |p| p.as_dvec3());
        let of_tetrahedron = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|c| corner(c) - origin);
            a.dot(b.cross(c)) / 6.0
        };
        self.triangulation().triangles.iter().map(of_tetrahedron).sum()
    }

    pub(crate) fn edge_corners(&self) -> EdgeCorners {
        let mut corners = vec![[NO_EDGE; 2]; self.face_edge_count()];
        let mut counts = vec![0u32; self.face_edge_count()];
        for corner in 0..self.corner_count() {
            let Some(edge) = self.corner_edge(corner) else { continue };
            let count = &mut counts[edge as usize];
            if let Some(slot) = corners[edge as usize].get_mut(*count as usize) {
                *slot = corner as u32;
            }
            *count += 1;
        }
        EdgeCorners { corners, counts }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{MeshBuilder, primitives};

    /// Triangles over these vertices.
    fn triangles(positions: &[Vec3], faces: &[[u32; 3]]) -> Mesh {
        let mut builder = MeshBuilder::new();
        for &position in positions {
            builder.push_vertex(position);
        }
        for face in faces {
            builder.push_face(face).expect("a triangle");
        }
        builder.build()
    }

    #[test]
    fn a_fan_of_three_faces_is_no_surface() {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_Y];
        let surface = triangles(&corners, &[[0, 1, 2], [1, 0, 3], [0, 1, 4]]).surface();
        assert_eq!(surface.non_manifold_edges, [[0, 1]], "three faces share it");
        assert_eq!(surface.open_edges, [[0, 2], [0, 3], [0, 4], [1, 2], [1, 3], [1, 4]], "all others");
    }

    #[test]
    fn vertices_at_one_position_join() {
        // A square of two triangles that share no vertex, as STL and seams of texture coordinates have it.
        let [a, b, c, d] = [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::new(-0.0, 1.0, 0.0)];
        let surface =
            triangles(&[a, b, c, Vec3::new(-0.0, 0.0, -0.0), c, d], &[[0, 1, 2], [3, 4, 5]]).surface();
        assert_eq!(surface.open_edges, [[0, 1], [0, 5], [1, 2], [2, 5]], "the outline, not the diagonal");
        assert_eq!((surface.turned_edges.len(), surface.volume), (0, 0.0), "one sheet");
    }

    #[test]
    fn a_turned_face_and_an_inner_side_are_told() {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y];
        assert_eq!(triangles(&corners, &[[0, 1, 2], [0, 3, 2]]).surface().turned_edges, [[0, 2]], "mixed");
        let mut cube = primitives::cube(2.0);
        cube.flip_faces();
        assert_eq!(cube.surface().volume, -8.0, "inside out");
    }
}

//! Quads among the faces of a mesh.

use super::Quads;
use crate::Mesh;

/// Quads that are computed at a time.
const LANES: usize = 4;

/// Some quads of a mesh. All are placed before the first of them is computed: a processor waits when it reads several
/// numbers at once that it has just written one by one.
#[derive(Debug)]
pub struct QuadGroup {
    numbers: Vec<u32>,
    quads: [Quads<LANES>; Self::MOST / LANES],
}

impl Default for QuadGroup {
    fn default() -> Self {
        Self { numbers: Vec::with_capacity(Self::MOST), quads: [Quads::NONE; Self::MOST / LANES] }
    }
}

impl QuadGroup {
    /// How many faces a group can take.
    pub const MOST: usize = 256;

    /// Takes the quads among some faces of a mesh, and calls back with the places of all others in the list.
    ///
    /// # Panics
    ///
    /// If there are more than [`QuadGroup::MOST`] faces, or one of them does not exist.
    pub fn fill(
        &mut self,
        mesh: &Mesh,
        faces: impl Iterator<Item = u32> + Clone,
        mut other: impl FnMut(usize),
    ) {
        mesh.prefetch_faces(faces.clone());
        self.numbers.clear();
        for (number, face) in faces.enumerate() {
            match *mesh.face_vertices(face as usize) {
                // Most faces of most meshes.
                [a, b, c, d] => {
                    let at = self.numbers.len();
                    self.numbers.push(number as u32);
                    let corners = [a, b, c, d].map(|vertex| mesh.positions()[vertex as usize]);
                    self.quads[at / LANES].place(at % LANES, corners);
                }
                _ => other(number),
            }
        }
    }

    /// The quads, side by side, each with its place in the list of faces. Those without a place are none of them.
    pub fn iter(&self) -> impl Iterator<Item = (&[u32], &Quads<LANES>)> {
        self.numbers.chunks(LANES).zip(&self.quads)
    }
}

//! Quads among the faces of a mesh.

use trigon_math::Vec3;

use super::Quads;

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

    /// Takes the corners of those faces in a list that are quads, and calls back with the places of all others.
    ///
    /// # Panics
    ///
    /// If there are more than [`QuadGroup::MOST`] faces.
    pub fn fill(&mut self, faces: impl Iterator<Item = Option<[Vec3; 4]>>, mut other: impl FnMut(usize)) {
        self.numbers.clear();
        for (number, corners) in faces.enumerate() {
            // Most faces of most meshes.
            let Some(corners) = corners else {
                other(number);
                continue;
            };
            let at = self.numbers.len();
            self.numbers.push(number as u32);
            self.quads[at / LANES].place(at % LANES, corners);
        }
    }

    /// The quads, side by side, each with its place in the list of faces. Those without a place are none of them.
    pub fn iter(&self) -> impl Iterator<Item = (&[u32], &Quads<LANES>)> {
        self.numbers.chunks(LANES).zip(&self.quads)
    }
}

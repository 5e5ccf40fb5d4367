//! Quads among the faces of a mesh.

use trigon_math::Vec3;

use super::Quads;

/// Quads that are computed at a time.
const LANES: usize = 4;

/// Those of some faces of a mesh that are quads. All are placed before the first of them is computed: a processor waits
/// when it reads several numbers at once that it has just written one by one.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct QuadGroup {
    /// The places of the quads in the list of faces, increasing.
    numbers: Vec<u32>,
    /// Those of the other faces.
    others: Vec<u32>,
    quads: Vec<Quads<LANES>>,
}

impl QuadGroup {
    /// How many faces a group has at most.
    pub const MOST: usize = 256;

    /// Takes the corners of those faces in a list that are quads.
    pub(crate) fn fill(&mut self, faces: impl Iterator<Item = Option<[Vec3; 4]>>) {
        self.numbers.clear();
        self.others.clear();
        for (number, corners) in (0..).zip(faces) {
            // Most faces of most meshes.
            let Some(corners) = corners else {
                self.others.push(number);
                continue;
            };
            let at = self.numbers.len();
            self.numbers.push(number);
            if at / LANES == self.quads.len() {
                self.quads.push(Quads::NONE);
            }
            self.quads[at / LANES].place(at % LANES, corners);
        }
    }

    /// Moves a corner of one of the quads, which are counted without the other faces.
    pub(crate) fn move_corner(&mut self, quad: usize, corner: usize, place: Vec3) {
        self.quads[quad / LANES].move_corner(quad % LANES, corner, place);
    }

    /// The places of the quads in the list of faces, increasing.
    pub(crate) fn numbers(&self) -> &[u32] {
        &self.numbers
    }

    /// The places of all other faces, increasing.
    pub(crate) fn others(&self) -> &[u32] {
        &self.others
    }

    /// The quads, side by side, each with its place in the list of faces. Those without a place are none of them.
    pub fn iter(&self) -> impl Iterator<Item = (&[u32], &Quads<LANES>)> {
        self.numbers.chunks(LANES).zip(&self.quads)
    }
}

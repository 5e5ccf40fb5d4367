//! The face that each face of a result came from.
//!
//! Operations copy the flags of faces with their marks. So a number in the bits of flags that have no meaning goes with each
//! face into its parts and copies, whatever the operation is, and changes nothing else.

use crate::edit_mesh::EditMesh;
use crate::ids::{FaceId, NONE};
use crate::records::ALIVE;

/// The lowest bit of the numbers, above all flags.
const FIRST_BIT: u32 = 6;
/// Faces with larger ids have no number.
const MOST: u32 = u32::MAX >> FIRST_BIT;

impl EditMesh {
    /// Gives each face the number of itself.
    pub(super) fn number_origins(&mut self) {
        for (index, record) in (1..=MOST).zip(self.faces.write_all()) {
            if record.flags & ALIVE != 0 {
                record.flags |= index << FIRST_BIT;
            }
        }
    }

    /// The face with the number that a face has; [`NONE`] if it has none, because an operation made it between others.
    pub(super) fn face_origin(&self, face: FaceId) -> FaceId {
        FaceId((self.faces[face.0].flags >> FIRST_BIT).checked_sub(1).unwrap_or(NONE))
    }

    /// Takes the numbers away.
    pub(super) fn clear_origins(&mut self) {
        for record in self.faces.write_all() {
            record.flags &= (1 << FIRST_BIT) - 1;
        }
    }
}

//! Reverses many faces at once.

use fixedbitset::FixedBitSet;

use crate::edit_mesh::EditMesh;
use crate::ids::NONE;
use crate::records::{CornerRecord, EdgeRecord};

impl EditMesh {
    /// Turns over all of these faces: the same as [`Self::flip_face`] for each, to the last bit, in one pass over
    /// all corners and edges. Theirs are written to new lists, and the old ones are what undo needs.
    pub(crate) fn flip_together(&mut self, is_turned: &FixedBitSet) {
        let old = self.corners.values();
        // A corner of a face that turns over leaves its place in an edge's ring to the one that follows it.
        let successor = |corner: u32| match old.get(corner as usize) {
            Some(record) if is_turned.contains(record.face as usize) => record.next,
            _ => corner,
        };
        let corners = listed(old, |record| turned_over(record, old, is_turned, successor));
        let edges = listed(self.edges.values(), |edge| {
            // The list of slots that are free has its links elsewhere.
            EdgeRecord { corner: successor(edge.corner), ..*edge }
        });
        let turned: Vec<u32> = (0u32..)
            .zip(old)
            .filter(|(_, record)| is_turned.contains(record.face as usize))
            .map(|(corner, _)| corner)
            .collect();
        for layer in &mut self.corner_layers {
            layer.turn_over_all(&turned);
        }
        self.corners.replace(corners);
        self.edges.replace(edges);
    }
}

/// What becomes of a corner. If its own face turns over, it leaves along the edge that led to it, in the place of
/// the corner before it.
fn turned_over(
    record: &CornerRecord,
    old: &[CornerRecord],
    is_turned: &FixedBitSet,
    successor: impl Fn(u32) -> u32,
) -> CornerRecord {
    if record.face == NONE {
        return *record;
    }
    if !is_turned.contains(record.face as usize) {
        let [radial_next, radial_previous] = [record.radial_next, record.radial_previous].map(successor);
        return CornerRecord { radial_next, radial_previous, ..*record };
    }
    let side = &old[record.previous as usize];
    CornerRecord {
        edge: side.edge,
        next: record.previous,
        previous: record.next,
        radial_next: successor(side.radial_next),
        radial_previous: successor(side.radial_previous),
        ..*record
    }
}

/// A list of what becomes of each, with as much room for more as [`crate::column::Column::with_room`] gives.
fn listed<T>(old: &[T], become_of: impl Fn(&T) -> T) -> Vec<T> {
    let mut list = Vec::with_capacity(old.len() + old.len() / 8);
    list.extend(old.iter().map(become_of));
    list
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::ids::FaceId;
    use crate::tests::meshes;

    proptest! {
        #[test]
        fn faces_turned_together_are_as_those_turned_one_by_one(
            start in meshes(), turns in prop::collection::vec(any::<bool>(), 1..40), deleted in any::<prop::sample::Index>(),
        ) {
            let (mut mesh, _) = EditMesh::from_mesh(&start);
            prop_assume!(mesh.face_count() > 0);
            // Slots that are free have to stay as they are.
            mesh.remove_face(FaceId(deleted.index(mesh.face_count()) as u32)).expect("it exists");
            let faces: Vec<FaceId> = mesh.faces().zip(turns.iter().cycle()).filter(|(_, turn)| **turn).map(|(face, _)| face).collect();
            let mut one_by_one = mesh.clone();
            faces.iter().try_for_each(|&face| one_by_one.flip_face(face)).expect("they exist");
            let before = mesh.clone();
            let is_turned: FixedBitSet = faces.iter().map(|face| face.0 as usize).collect();
            let ((), mut difference) = mesh.transaction(|mesh| {
                mesh.flip_together(&is_turned);
                Ok::<_, crate::Refusal>(())
            }).expect("nothing refuses");
            prop_assert!(mesh == one_by_one);
            prop_assert_eq!(mesh.check_structure(), Ok(()));
            difference.apply(&mut mesh);
            prop_assert!(mesh == before);
        }
    }
}

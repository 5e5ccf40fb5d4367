//! Pins: texture coordinates that unwrapping leaves where they are.

use super::delete::require;
use crate::edit_mesh::EditMesh;
use crate::ids::CornerId;
use crate::refusal::Refusal;

impl EditMesh {
    /// Pins the texture coordinates of corners: unwrapping lays out the rest of their islands around them, and packing
    /// leaves these islands where they are. Returns how many were free.
    ///
    /// # Errors
    /// None is given, or one does not exist; there is no such set, or it is not among the first
    /// [`Self::MOST_PINNED_SETS`].
    pub fn pin_uvs(&mut self, uv_set: usize, corners: &[CornerId]) -> Result<usize, Refusal> {
        self.change_pins(uv_set, corners, true)
    }

    /// Frees the texture coordinates of corners. Returns how many were pinned.
    ///
    /// # Errors
    /// Those of [`Self::pin_uvs`].
    pub fn unpin_uvs(&mut self, uv_set: usize, corners: &[CornerId]) -> Result<usize, Refusal> {
        self.change_pins(uv_set, corners, false)
    }

    fn change_pins(
        &mut self,
        uv_set: usize,
        corners: &[CornerId],
        is_pinned: bool,
    ) -> Result<usize, Refusal> {
        const OPERATION: &str = "pinning texture coordinates";
        if uv_set >= self.uv_set_count() {
            let reason = "there are no such texture coordinates; unwrap the faces first";
            return Err(Refusal::NotPossible { operation: OPERATION, reason });
        }
        if uv_set >= Self::MOST_PINNED_SETS {
            let (parameter, range) = ("the set of texture coordinates", "0 to 31");
            return Err(Refusal::OutOfRange { parameter, value: uv_set as f64, range });
        }
        require(corners, OPERATION, "at least one corner")?;
        corners.iter().try_for_each(|&corner| self.check_corner(corner))?;
        let mut changed = 0;
        for &corner in corners {
            changed += usize::from(self.is_uv_pinned(uv_set, corner) != is_pinned);
            self.set_uv_pinned(uv_set, corner, is_pinned);
        }
        Ok(changed)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::DVec3;
    use trigon_mesh::primitives;

    use super::*;
    use crate::tests::{check_operation, meshes};
    use crate::{ExtrudeOffset, FaceId};

    fn all_corners(mesh: &EditMesh) -> Vec<CornerId> {
        mesh.corners().collect()
    }

    #[test]
    fn pins_are_counted_per_set_and_refused_without_it() {
        let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let corners = all_corners(&cube);
        while cube.uv_set_count() < 33 {
            cube.add_uv_set(cube.uv_set_count()).expect("room");
        }
        assert_eq!(cube.pin_uvs(1, &corners[..3]), Ok(3));
        assert_eq!(cube.pin_uvs(1, &corners[..4]), Ok(1), "the fourth");
        assert_eq!(cube.unpin_uvs(0, &corners), Ok(0), "the other set has none");
        assert_eq!(cube.unpin_uvs(1, &corners), Ok(4));
        assert_eq!(cube.pin_uvs(31, &corners), Ok(24), "the last one");
        let before = cube.clone();
        assert!(cube.pin_uvs(0, &[]).is_err(), "nothing given");
        assert!(cube.pin_uvs(32, &corners).is_err() && cube.pin_uvs(33, &corners).is_err(), "no such set");
        assert!(cube.pin_uvs(0, &[corners[0], CornerId(24)]).is_err(), "there are 24");
        assert!(cube == before, "nothing was done");
    }

    /// The first pin adds only a layer; the history left such changes out, so that they were never undone.
    #[test]
    fn what_only_adds_a_layer_is_a_change() {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::grid(2.0, 2.0, 2, 1));
        let sets = mesh.uv_set_count();
        let corners = all_corners(&mesh);
        let first = mesh.clone();
        let ((), mut added) = mesh.transaction(|mesh| mesh.add_uv_set(sets)).expect("room");
        let (_, mut pinned) = mesh.transaction(|mesh| mesh.pin_uvs(sets, &corners)).expect("they exist");
        assert!(!added.is_empty() && !pinned.is_empty(), "both changed something");
        pinned.apply(&mut mesh);
        added.apply(&mut mesh);
        assert!(mesh == first && !added.is_empty() && !pinned.is_empty(), "and still do");
    }

    /// What copies corners copies their pins; between a pinned corner and a free one nothing is pinned.
    #[test]
    fn operations_carry_pins() {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::grid(2.0, 2.0, 2, 1));
        mesh.add_uv_set(0).expect("room");
        let faces: Vec<FaceId> = mesh.faces().collect();
        let pinned: Vec<CornerId> = mesh.face_corners(faces[0]).collect();
        mesh.pin_uvs(0, &pinned).expect("a face");
        let count = |mesh: &EditMesh| mesh.corners().filter(|&corner| mesh.is_uv_pinned(0, corner)).count();
        let mut finer = mesh.clone();
        let edges: Vec<_> = finer.edges().collect();
        finer.subdivide(&edges, 1).expect("edges");
        assert_eq!((finer.face_count(), count(&finer)), (8, 16), "all corners in the pinned face");
        let mut smooth = mesh.clone();
        smooth.catmull_clark(1).expect("room");
        assert_eq!((smooth.face_count(), count(&smooth)), (8, 16), "the same");
        let mut one = mesh.clone();
        one.unpin_uvs(0, &pinned[1..]).expect("they are pinned");
        one.catmull_clark(1).expect("room");
        assert_eq!(count(&one), 1, "none between it and its neighbours");
        let mut joined = EditMesh::from_mesh(&primitives::cube(1.0)).0;
        joined.join_mesh(&mesh, &trigon_math::DAffine3::IDENTITY).expect("room");
        assert_eq!(count(&joined), 4, "those that came");
        let mut extruded = mesh.clone();
        extruded.extrude_region(&faces, ExtrudeOffset::By(DVec3::Y)).expect("faces");
        assert!(count(&extruded) >= 4, "{}", count(&extruded));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        #[test]
        fn pinning_is_undone_and_saved(start in meshes(), bits in any::<u64>(), free in any::<bool>()) {
            let (mut mesh, _) = EditMesh::from_mesh(&start);
            let all = all_corners(&mesh);
            mesh.add_uv_set(0).expect("room");
            if free {
                mesh.pin_uvs(0, &all).expect("they exist");
            }
            let some: Vec<CornerId> =
                all.into_iter().filter(|corner| bits >> (corner.index() % 64) & 1 != 0).collect();
            let done = check_operation(&mesh, |mesh| match free {
                true => mesh.unpin_uvs(0, &some),
                false => mesh.pin_uvs(0, &some),
            });
            let Some((after, count)) = done.map_err(TestCaseError::fail)? else { return Ok(()) };
            prop_assert_eq!(count, some.len());
            let (mesh, map) = after.to_mesh();
            let (again, _) = EditMesh::from_mesh_and_data(&mesh, &after.edit_data(&map)).expect("they fit");
            for (new, &old) in (0..).map(CornerId).zip(&map.corners) {
                prop_assert_eq!(again.is_uv_pinned(0, new), after.is_uv_pinned(0, old));
                prop_assert_eq!(after.is_uv_pinned(0, old), some.contains(&old) != free);
            }
        }
    }
}

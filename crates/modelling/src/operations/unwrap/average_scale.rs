//! Islands of texture coordinates in even scale, each where it is.

use trigon_math::{DAffine2, DVec2};

use super::charts::UvChart;
use super::islands::uv_charts;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, FaceId};
use crate::refusal::Refusal;

/// An island that is scaled.
struct ScaledIsland {
    corners: Vec<CornerId>,
    /// In the image.
    uv_area: f64,
    /// In square metres.
    surface_area: f64,
}

impl EditMesh {
    /// Scales the islands of faces about the middles of their boxes so that their areas in the image are proportional to
    /// those on the surface, and add up to as much as before. Islands with pinned coordinates, and those without area in
    /// the image, are unchanged. Returns how many islands were scaled.
    ///
    /// # Errors
    /// No face is given, one does not exist; there is no such set; or texture coordinates or positions are not finite.
    pub fn average_uv_island_scale(&mut self, faces: &[FaceId], uv_set: usize) -> Result<usize, Refusal> {
        const OPERATION: &str = "averaging the scale of islands";
        let not_possible = |reason| Err(Refusal::NotPossible { operation: OPERATION, reason });
        self.check_faces(faces, OPERATION)?;
        if uv_set >= self.uv_set_count() {
            return not_possible("there are no such texture coordinates; unwrap the faces first");
        }
        let charts = uv_charts(self, faces, uv_set).into_iter();
        let is_free = |chart: &UvChart| !chart.corners.iter().any(|at| self.is_uv_pinned(uv_set, at.corner));
        let islands: Vec<ScaledIsland> = charts
            .filter(is_free)
            .map(|chart| self.sized(&chart, uv_set))
            .filter(|island| island.uv_area != 0.0)
            .collect();
        let uv_area: f64 = islands.iter().map(|island| island.uv_area).sum();
        let surface_area: f64 = islands.iter().map(|island| island.surface_area).sum();
        if !uv_area.is_finite() || !surface_area.is_finite() {
            return not_possible("a texture coordinate or position is not finite; unwrap the faces first");
        }
        self.whole(|mesh| {
            for island in &islands {
                let scale = (island.surface_area / surface_area * uv_area / island.uv_area).sqrt();
                let center = mesh.uv_center(uv_set, &island.corners).expect("it has corners");
                let about = DAffine2::from_translation(center)
                    * DAffine2::from_scale(DVec2::splat(scale))
                    * DAffine2::from_translation(-center);
                mesh.transform_uvs(uv_set, &island.corners, &about)?;
            }
            Ok(islands.len())
        })
    }

    fn sized(&self, chart: &UvChart, uv_set: usize) -> ScaledIsland {
        let mut layout = vec![DVec2::ZERO; chart.points.len()];
        for at in &chart.corners {
            layout[at.vertex as usize] = self.uv(uv_set, at.corner).expect("the set exists").as_dvec2();
        }
        let corners = chart.corners.iter().map(|at| at.corner).collect();
        ScaledIsland { corners, uv_area: chart.layout_area(&layout), surface_area: chart.area() }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::Vec2;
    use trigon_mesh::primitives;

    use super::*;
    use crate::tests::check_operation;

    /// The area in the image of a quad, by its diagonals.
    fn uv_area(mesh: &EditMesh, face: FaceId) -> f64 {
        let uvs: Vec<DVec2> =
            mesh.face_corners(face).map(|corner| mesh.uv(0, corner).expect("set").as_dvec2()).collect();
        (uvs[2] - uvs[0]).perp_dot(uvs[3] - uvs[1]).abs() / 2.0
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        /// Six sides of a box, each an island of its own size, one of them pinned.
        #[test]
        fn areas_become_proportional(
            sizes in prop::array::uniform6(0.1f32..3.0),
            edges in prop::array::uniform3(0.2f32..4.0),
            pinned in 0usize..6,
        ) {
            let (mut mesh, _) = EditMesh::from_mesh(&primitives::cube(1.0));
            for vertex in mesh.vertices().collect::<Vec<_>>() {
                mesh.set_position(vertex, mesh.position(vertex) * trigon_math::Vec3::from(edges));
            }
            mesh.add_uv_set(0).expect("room");
            let faces: Vec<FaceId> = mesh.faces().collect();
            for (&face, (size, left)) in faces.iter().zip(sizes.into_iter().zip([0.0, 10.0, 20.0, 30.0, 40.0, 50.0])) {
                let square = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
                for (corner, at) in mesh.face_corners(face).collect::<Vec<_>>().into_iter().zip(square) {
                    mesh.set_uv(0, corner, at * size + Vec2::new(left, 1.0));
                }
            }
            let held = mesh.face_corners(faces[pinned]).next().expect("four");
            mesh.pin_uvs(0, &[held]).expect("one");
            let scaled = check_operation(&mesh, |mesh| mesh.average_uv_island_scale(&faces, 0));
            let (after, count) = scaled.map_err(TestCaseError::fail)?.expect("possible");
            prop_assert_eq!(count, 5);
            let others: Vec<FaceId> = faces.iter().copied().filter(|&face| face != faces[pinned]).collect();
            let sum = |mesh: &EditMesh| others.iter().map(|&face| uv_area(mesh, face)).sum::<f64>();
            prop_assert!((sum(&after) / sum(&mesh) - 1.0).abs() < 1e-4, "as much as before");
            let ratio = |face| uv_area(&after, face) / after.face_area(face);
            for &face in &others {
                // Coordinates of up to 60 are rounded to f32: 2⁻¹⁹ of sides of at least 0.05.
                prop_assert!((ratio(face) / ratio(others[0]) - 1.0).abs() < 1e-3);
                let corners: Vec<CornerId> = mesh.face_corners(face).collect();
                let [before, now] = [&mesh, &after].map(|mesh| mesh.uv_center(0, &corners).expect("four"));
                prop_assert!(before.distance(now) < 1e-5, "{} to {}", before, now);
            }
            for corner in mesh.face_corners(faces[pinned]) {
                prop_assert_eq!(mesh.uv(0, corner), after.uv(0, corner));
            }
        }
    }
}

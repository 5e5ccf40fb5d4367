//! Texture coordinates by projection from an axis: onto a cylinder or a sphere around it.

use std::f64::consts::{PI, TAU};

use trigon_math::{Bounds3, DVec2, DVec3, Vec2, elementary, unit_or_zero};

use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, FaceId};
use crate::refusal::Refusal;

/// A projection onto a cylinder, which the image surrounds once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CylinderProjection {
    /// A point on the axis at the middle of the image, in metres; `None`: the centre of the faces' bounding box.
    pub center: Option<DVec3>,
    /// The upward direction of the axis; of any length but zero.
    pub axis: DVec3,
    /// The height of the image in metres, above 0; `None`: that of the faces along the axis.
    pub height: Option<f64>,
}

impl Default for CylinderProjection {
    /// Around the faces, upright.
    fn default() -> Self {
        Self { center: None, axis: DVec3::Y, height: None }
    }
}

/// A projection onto a sphere: the image goes around once, and from pole to pole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SphereProjection {
    /// The centre, in metres; `None`: the centre of the faces' bounding box.
    pub center: Option<DVec3>,
    /// Towards the upper pole; of any length but zero.
    pub axis: DVec3,
}

impl Default for SphereProjection {
    /// Around the faces, upright.
    fn default() -> Self {
        Self { center: None, axis: DVec3::Y }
    }
}

/// A frame around an axis.
struct Around {
    center: DVec3,
    axis: DVec3,
    /// The direction at the middle of the image's width.
    front: DVec3,
    right: DVec3,
}

impl Around {
    fn new(mesh: &EditMesh, faces: &[FaceId], center: Option<DVec3>, axis: DVec3) -> Result<Self, Refusal> {
        let axis = unit_or_zero(axis);
        if axis == DVec3::ZERO {
            let reason = "the axis has no direction";
            return Err(Refusal::NotPossible { operation: OPERATION, reason });
        }
        let center = center.unwrap_or_else(|| {
            let vertices = faces.iter().flat_map(|&face| mesh.face_vertices(face));
            let bounds = Bounds3::from_points(vertices.map(|vertex| mesh.point(vertex)));
            bounds.center().unwrap_or(DVec3::ZERO)
        });
        if let Some(value) = center.to_array().into_iter().find(|value| !value.is_finite()) {
            return Err(Refusal::OutOfRange { parameter: "the centre", value, range: "a finite number" });
        }
        // Along an upright axis the front is +z; along z it is −y.
        let towards = if axis.z.abs() < 0.9 { DVec3::Z } else { DVec3::NEG_Y };
        let right = unit_or_zero(axis.cross(towards));
        Ok(Self { center, axis, front: right.cross(axis), right })
    }

    /// Where a point is around the axis, in turns from the front to the right; `None` on the axis.
    fn turns(&self, point: DVec3) -> Option<f64> {
        let from_center = point - self.center;
        let [x, y] = [self.front, self.right].map(|direction| direction.dot(from_center));
        // Within rounding of positions it has no direction.
        let least = 1e-6 * from_center.length();
        (x.abs() > least || y.abs() > least).then(|| elementary::atan2(y, x) / TAU)
    }

    fn height(&self, point: DVec3) -> f64 {
        self.axis.dot(point - self.center)
    }

    /// The u of each corner of a face, without a jump within it. Corners on the axis have the mean of the others.
    fn across(&self, points: &[DVec3]) -> Vec<f64> {
        let turns: Vec<Option<f64>> = points.iter().map(|&point| self.turns(point)).collect();
        let middle = points.iter().sum::<DVec3>() / points.len() as f64;
        let reference = self.turns(middle).or_else(|| turns.iter().copied().flatten().next()).unwrap_or(0.0);
        let near = |turns: f64| turns - (turns - reference).round();
        let known: Vec<f64> = turns.iter().copied().flatten().map(near).collect();
        let mean = if known.is_empty() { reference } else { known.iter().sum::<f64>() / known.len() as f64 };
        turns.into_iter().map(|turns| 0.5 + turns.map_or(mean, near)).collect()
    }
}

const OPERATION: &str = "projecting texture coordinates";

impl EditMesh {
    /// Gives the corners of faces texture coordinates by projecting their vertices onto a cylinder: u goes around the
    /// axis once, from the back by the front, v along it. No face has a jump: coordinates at the back go beyond 0 and
    /// 1. If there are `uv_set` sets, one is added, with zero at all other corners. Given tangents are unchanged.
    ///
    /// # Errors
    /// No face is given, one does not exist; there are fewer than `uv_set` sets; or a parameter is out of range.
    pub fn project_uvs_on_cylinder(
        &mut self,
        faces: &[FaceId],
        uv_set: usize,
        projection: &CylinderProjection,
    ) -> Result<(), Refusal> {
        self.check_faces(faces, OPERATION)?;
        let around = Around::new(self, faces, projection.center, projection.axis)?;
        let height = projection.height.unwrap_or_else(|| {
            let vertices = faces.iter().flat_map(|&face| self.face_vertices(face));
            let greatest = vertices
                .fold(0.0, |greatest: f64, vertex| greatest.max(around.height(self.point(vertex)).abs()));
            if greatest > 0.0 && greatest.is_finite() { 2.0 * greatest } else { 1.0 }
        });
        if !(height > 0.0 && height.is_finite()) {
            let (parameter, range) = ("the height of the image", "above 0 and finite");
            return Err(Refusal::OutOfRange { parameter, value: height, range });
        }
        self.write_around(faces, uv_set, &around, |point| 0.5 - around.height(point) / height)
    }

    /// Gives the corners of faces texture coordinates by projecting their vertices onto a sphere: u goes around the
    /// axis once, from the back by the front, v from the upper pole to the lower. Otherwise as
    /// [`Self::project_uvs_on_cylinder`].
    ///
    /// # Errors
    /// No face is given, one does not exist; there are fewer than `uv_set` sets; or a parameter is out of range.
    pub fn project_uvs_on_sphere(
        &mut self,
        faces: &[FaceId],
        uv_set: usize,
        projection: &SphereProjection,
    ) -> Result<(), Refusal> {
        self.check_faces(faces, OPERATION)?;
        let around = Around::new(self, faces, projection.center, projection.axis)?;
        self.write_around(faces, uv_set, &around, |point| {
            let height = around.height(point);
            let from_axis = point - around.center - around.axis * height;
            elementary::atan2(from_axis.length(), height) / PI
        })
    }

    fn write_around(
        &mut self,
        faces: &[FaceId],
        uv_set: usize,
        around: &Around,
        v: impl Fn(DVec3) -> f64,
    ) -> Result<(), Refusal> {
        self.add_uv_set(uv_set)?;
        let (mut corners, mut points): (Vec<CornerId>, Vec<DVec3>) = (Vec::new(), Vec::new());
        for &face in faces {
            corners.clear();
            corners.extend(self.face_corners(face));
            points.clear();
            points.extend(corners.iter().map(|&corner| self.point(self.corner_vertex(corner))));
            for ((&corner, &point), u) in corners.iter().zip(&points).zip(around.across(&points)) {
                let uv = DVec2::new(u, v(point)).as_vec2();
                self.set_uv(uv_set, corner, if uv.is_finite() { uv } else { Vec2::ZERO });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_mesh::primitives;

    use super::*;
    use crate::tests::{check_operation, meshes};

    fn uvs(mesh: &EditMesh, face: FaceId) -> Vec<Vec2> {
        mesh.face_corners(face).filter_map(|corner| mesh.uv(0, corner)).collect()
    }

    /// The area in an image with v upwards, by the shoelace formula.
    fn area(uvs: &[Vec2]) -> f32 {
        uvs.iter().enumerate().map(|(i, a)| uvs[(i + 1) % uvs.len()].perp_dot(*a) / 2.0).sum()
    }

    #[test]
    fn the_side_of_a_cylinder_shows_the_image_once() {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::cylinder(2.0, 3.0, 16));
        let sides: Vec<FaceId> = mesh.faces().filter(|&face| mesh.face_size(face) == 4).collect();
        mesh.project_uvs_on_cylinder(&sides, 0, &CylinderProjection::default()).expect("possible");
        let areas: Vec<f32> = sides.iter().map(|&face| area(&uvs(&mesh, face))).collect();
        assert!(
            areas.iter().all(|area| (area - 1.0 / 16.0).abs() < 1e-6),
            "sixteenths, not mirrored: {areas:?}"
        );
        let front = mesh.corners().find(|&corner| mesh.point(mesh.corner_vertex(corner)).z > 1.99);
        if let Some(uv) = front.and_then(|corner| mesh.uv(0, corner)).filter(|uv| *uv != Vec2::ZERO) {
            assert!((uv.x - 0.5).abs() < 1e-6, "the front is in the middle: {uv}");
        }
    }

    #[test]
    fn a_sphere_shows_the_image_from_pole_to_pole() {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::uv_sphere(1.0, 12, 8));
        let faces: Vec<FaceId> = mesh.faces().collect();
        mesh.project_uvs_on_sphere(&faces, 0, &SphereProjection::default()).expect("possible");
        for &face in &faces {
            let uvs = uvs(&mesh, face);
            // A quad is a twelfth by an eighth; a triangle at a pole half of that, its tip in the middle.
            let expected = if uvs.len() == 4 { 1.0 / 96.0 } else { 1.0 / 192.0 };
            assert!((area(&uvs) - expected).abs() < 1e-6, "{} of {uvs:?}", area(&uvs));
        }
    }

    proptest! {
        /// No face has a jump, coordinates are finite, and undo gives the same bytes.
        #[test]
        fn no_face_has_a_jump(start in meshes(), axis in prop::array::uniform3(-1.0f64..1.0), is_sphere in any::<bool>()) {
            let (mesh, _) = EditMesh::from_mesh(&start);
            let faces: Vec<FaceId> = mesh.faces().collect();
            let axis = DVec3::from(axis);
            let done = check_operation(&mesh, |mesh| match is_sphere {
                true => mesh.project_uvs_on_sphere(&faces, 0, &SphereProjection { axis, ..Default::default() }),
                false => mesh.project_uvs_on_cylinder(&faces, 0, &CylinderProjection { axis, ..Default::default() }),
            });
            if let Some((after, ())) = done.map_err(TestCaseError::fail)? {
                for &face in &faces {
                    let uvs = uvs(&after, face);
                    prop_assert!(uvs.iter().all(|uv| uv.is_finite()));
                    let across = |uv: &Vec2| uv.x;
                    let low = uvs.iter().map(across).fold(f32::INFINITY, f32::min);
                    let high = uvs.iter().map(across).fold(f32::NEG_INFINITY, f32::max);
                    prop_assert!(high - low <= 1.0 + 1e-5, "{:?}", uvs);
                }
            }
        }
    }
}

//! Texture coordinates by projection: along one direction, or for each face along the axis that is closest
//! to its normal.

use trigon_math::{DAffine3, DVec2, DVec3, Vec2, unit_or_zero};

use crate::column::Column;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, FaceId};
use crate::layers::{Layer, LayerKind, LayerValues};
use crate::refusal::Refusal;

/// A projection along a direction, like that of a slide projector.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanarProjection {
    /// The point at the centre of the image, in metres.
    pub center: DVec3,
    /// Towards the viewer; of any length but zero.
    pub normal: DVec3,
    /// The upward direction in the image; need not be perpendicular to the normal.
    pub up: DVec3,
    /// The height of the image in metres, above 0.
    pub height: f64,
    /// Its aspect ratio, width divided by height, above 0.
    pub aspect: f64,
}

impl Default for PlanarProjection {
    /// A square of a metre about the origin, seen from the front.
    fn default() -> Self {
        Self { center: DVec3::ZERO, normal: DVec3::Z, up: DVec3::Y, height: 1.0, aspect: 1.0 }
    }
}

/// A projection onto the six sides of a box, each face onto the side that it faces most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoxProjection {
    /// The point at the centre of each side's image, in metres.
    pub center: DVec3,
    /// The height of the image in metres, above 0.
    pub height: f64,
    /// Its aspect ratio, width divided by height, above 0.
    pub aspect: f64,
}

impl Default for BoxProjection {
    /// A cube of a metre about the origin.
    fn default() -> Self {
        Self { center: DVec3::ZERO, height: 1.0, aspect: 1.0 }
    }
}

/// From a position to texture coordinates: (0, 0) is the upper left corner of the image.
struct Projector {
    center: DVec3,
    right: DVec3,
    up: DVec3,
    size: DVec2,
}

impl Projector {
    fn uv(&self, point: DVec3) -> Vec2 {
        let from_center = point - self.center;
        let [x, y] = [self.right, self.up].map(|axis| axis.dot(from_center));
        DVec2::new(0.5 + x / self.size.x, 0.5 - y / self.size.y).as_vec2()
    }
}

impl EditMesh {
    /// Gives the corners of faces texture coordinates by projecting their vertices along a
    /// direction. Coordinates are outside 0 to 1 where the mesh is larger than the image. If there
    /// are `uv_set` sets, one is added, with zero at all other corners. Given tangents are
    /// unchanged.
    ///
    /// # Errors
    /// No face is given, one does not exist; there are fewer than `uv_set` sets; a parameter is out
    /// of range, or the normal and up are parallel.
    pub fn project_uvs(
        &mut self,
        faces: &[FaceId],
        uv_set: usize,
        projection: &PlanarProjection,
    ) -> Result<(), Refusal> {
        self.project_uvs_mapped(faces, uv_set, projection, &DAffine3::IDENTITY)
    }

    /// [`Self::project_uvs`] with a projection in another space, to which `map` leads from that of the mesh.
    ///
    /// # Errors
    /// Those of [`Self::project_uvs`].
    pub fn project_uvs_mapped(
        &mut self,
        faces: &[FaceId],
        uv_set: usize,
        projection: &PlanarProjection,
        map: &DAffine3,
    ) -> Result<(), Refusal> {
        let &PlanarProjection { center, normal, up, height, aspect } = projection;
        let right = unit_or_zero(unit_or_zero(up).cross(unit_or_zero(normal)));
        if right == DVec3::ZERO {
            let reason = "normal and up are parallel, or one of them is zero";
            return Err(Refusal::NotPossible { operation: "projecting texture coordinates", reason });
        }
        let size = check_image(center, height, aspect)?;
        let up = unit_or_zero(normal).cross(right);
        let projector = Projector { center, right, up, size };
        self.write_uvs(faces, uv_set, |mesh, _, corner| {
            projector.uv(map.transform_point3(mesh.point(mesh.corner_vertex(corner))))
        })
    }

    /// Gives the corners of faces texture coordinates by projecting each face along the axis that it mostly
    /// faces (the first of several: x, y, z), so that the image is not mirrored when seen from outside. The
    /// image is upright on the four sides; up is −z on the top, and z on the bottom. Otherwise as
    /// [`Self::project_uvs`].
    ///
    /// # Errors
    /// No face is given, one does not exist; there are fewer than `uv_set` sets; or a parameter
    /// is out of range.
    pub fn project_uvs_on_box(
        &mut self,
        faces: &[FaceId],
        uv_set: usize,
        projection: &BoxProjection,
    ) -> Result<(), Refusal> {
        let &BoxProjection { center, height, aspect } = projection;
        let size = check_image(center, height, aspect)?;
        self.write_uvs(faces, uv_set, |mesh, normal, corner| {
            let [right, up] = side_of_box(normal);
            Projector { center, right, up, size }.uv(mesh.point(mesh.corner_vertex(corner)))
        })
    }

    /// Writes the result of a function for each corner, given the normal of its face.
    fn write_uvs(
        &mut self,
        faces: &[FaceId],
        uv_set: usize,
        uv: impl Fn(&Self, DVec3, CornerId) -> Vec2,
    ) -> Result<(), Refusal> {
        self.check_faces(faces, "projecting texture coordinates")?;
        self.add_uv_set(uv_set)?;
        let mut uvs = Vec::new();
        for &face in faces {
            let normal = self.face_normal(face);
            uvs.clear();
            uvs.extend(self.face_corners(face).map(|corner| (corner, uv(self, normal, corner))));
            uvs.iter().for_each(|&(corner, uv)| self.set_uv(uv_set, corner, uv));
        }
        Ok(())
    }

    /// Refuses a set of texture coordinates beyond the next one.
    pub(super) fn check_uv_set(&self, uv_set: usize) -> Result<(), Refusal> {
        if uv_set > self.uv_set_count() {
            let (parameter, range) = ("the set of texture coordinates", "at most one more than there are");
            return Err(Refusal::OutOfRange { parameter, value: uv_set as f64, range });
        }
        Ok(())
    }

    /// Adds a set of texture coordinates after the others if this is the number of the next one.
    pub(super) fn add_uv_set(&mut self, uv_set: usize) -> Result<(), Refusal> {
        self.check_uv_set(uv_set)?;
        if uv_set == self.uv_set_count() {
            let values = LayerValues::Vec2(Column::new(vec![Vec2::ZERO; self.corner_capacity()]));
            self.corner_layers.push(Layer { kind: LayerKind::Uv, values });
        }
        Ok(())
    }
}

/// Right and up in the image on the side of a box that a face with this normal faces most.
fn side_of_box(normal: DVec3) -> [DVec3; 2] {
    let size = normal.abs();
    if size.x >= size.y && size.x >= size.z {
        [DVec3::NEG_Z * normal.x.signum(), DVec3::Y]
    } else if size.y >= size.z {
        [DVec3::X, DVec3::NEG_Z * normal.y.signum()]
    } else {
        [DVec3::X * normal.z.signum(), DVec3::Y]
    }
}

/// The size of an image, if all of it is in range.
fn check_image(center: DVec3, height: f64, aspect: f64) -> Result<DVec2, Refusal> {
    let positive = |parameter, value: f64| {
        if value > 0.0 && value.is_finite() {
            return Ok(());
        }
        Err(Refusal::OutOfRange { parameter, value, range: "above 0 and finite" })
    };
    positive("the height of the image", height)?;
    positive("the aspect of the image", aspect)?;
    if let Some(value) = center.to_array().into_iter().find(|value| !value.is_finite()) {
        return Err(Refusal::OutOfRange { parameter: "the centre", value, range: "a finite number" });
    }
    Ok(DVec2::new(height * aspect, height))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_mesh::{Attributes, primitives};

    use super::*;
    use crate::tests::meshes;

    fn bare_cube() -> (EditMesh, Vec<FaceId>) {
        let mut cube = primitives::cube(2.0);
        cube.set_attributes(Attributes::default()).expect("nothing has a length");
        let (cube, _) = EditMesh::from_mesh(&cube);
        let faces = cube.faces().collect();
        (cube, faces)
    }

    #[test]
    fn each_side_of_a_cube_shows_the_whole_image_the_right_way_round() {
        let (mut cube, faces) = bare_cube();
        let projection = BoxProjection { height: 2.0, ..BoxProjection::default() };
        cube.project_uvs_on_box(&faces, 0, &projection).expect("a set is added");
        assert_eq!(cube.uv_set_count(), 1, "the first set");
        for &face in &faces {
            let uvs: Vec<Vec2> = cube.face_corners(face).filter_map(|corner| cube.uv(0, corner)).collect();
            let mut area = 0.0;
            for (i, a) in uvs.iter().enumerate() {
                let b = uvs[(i + 1) % uvs.len()];
                area += (a.x * b.y - a.y * b.x) / 2.0;
                assert!(
                    [0.0, 1.0].contains(&a.x) && [0.0, 1.0].contains(&a.y),
                    "{a} is a corner of the image"
                );
            }
            // v points down: what is counter-clockwise from outside has a negative area.
            assert_eq!(area, -1.0, "all of the image, not mirrored, on {face}");
        }
    }

    #[test]
    fn a_planar_projection_shows_what_is_seen_from_there() {
        let (mut cube, faces) = bare_cube();
        let seen_from_above = PlanarProjection {
            center: DVec3::X,
            normal: DVec3::Y * 2.0,
            up: DVec3::new(0.0, 1.0, -1.0),
            height: 4.0,
            aspect: 0.5,
        };
        cube.project_uvs(&faces, 0, &seen_from_above).expect("a set is added");
        for corner in cube.corners() {
            let point = cube.point(cube.corner_vertex(corner));
            let expected = DVec2::new(0.5 + (point.x - 1.0) / 2.0, 0.5 + point.z / 4.0).as_vec2();
            assert_eq!(cube.uv(0, corner), Some(expected), "at {point}");
        }
    }

    #[test]
    fn a_mapped_projection_is_that_of_the_moved_mesh() {
        let map = DAffine3::from_scale_rotation_translation(
            DVec3::new(1.0, 2.0, 4.0),
            trigon_math::DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2),
            DVec3::new(0.5, 0.0, -1.0),
        );
        let (mut cube, faces) = bare_cube();
        let mut moved = cube.clone();
        let vertices: Vec<_> = moved.vertices().collect();
        for vertex in vertices {
            let at = map.transform_point3(moved.point(vertex)).as_vec3();
            moved.set_position(vertex, at);
        }
        let projection =
            PlanarProjection { normal: DVec3::new(1.0, 2.0, 3.0), ..PlanarProjection::default() };
        cube.project_uvs_mapped(&faces, 0, &projection, &map).expect("possible");
        moved.project_uvs(&faces, 0, &projection).expect("possible");
        for corner in cube.corners() {
            let [here, there] = [&cube, &moved].map(|mesh| mesh.uv(0, corner).expect("it was added"));
            assert!(here.abs_diff_eq(there, 1e-6), "{here} and {there}");
        }
    }

    #[test]
    fn what_makes_no_image_is_refused() {
        let (mut cube, faces) = bare_cube();
        let before = cube.clone();
        let square = PlanarProjection::default();
        assert!(cube.project_uvs(&faces, 1, &square).is_err(), "there is no first set");
        assert!(cube.project_uvs(&[], 0, &square).is_err(), "no face");
        assert!(
            cube.project_uvs(&faces, 0, &PlanarProjection { up: DVec3::Z, ..square }).is_err(),
            "one line"
        );
        assert!(
            cube.project_uvs(&faces, 0, &PlanarProjection { aspect: 0.0, ..square }).is_err(),
            "no width"
        );
        assert!(cube == before, "nothing was done");
    }

    proptest! {
        /// A set that was added is gone when it is undone, and is back when it is redone.
        #[test]
        fn a_set_is_added_and_undone(start in meshes(), uv_set in 0usize..2) {
            let (mut mesh, _) = EditMesh::from_mesh(&start);
            let faces: Vec<FaceId> = mesh.faces().collect();
            prop_assume!(!faces.is_empty());
            let before = mesh.clone();
            let projection = BoxProjection::default();
            let ((), mut difference) = mesh
                .transaction(|mesh| mesh.project_uvs_on_box(&faces, uv_set, &projection))
                .expect("there is one set");
            prop_assert_eq!(mesh.check_structure(), Ok(()));
            prop_assert_eq!(mesh.uv_set_count(), uv_set + 1);
            let after = mesh.clone();
            difference.apply(&mut mesh);
            prop_assert!(mesh == before);
            difference.apply(&mut mesh);
            prop_assert!(mesh == after);
        }
    }
}

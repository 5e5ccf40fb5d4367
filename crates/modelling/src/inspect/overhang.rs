//! Findings about faces that a printer would have to print in the air.

use trigon_math::{DVec3, angle};

use crate::edit_mesh::EditMesh;
use crate::ids::{FaceId, VertexId};

/// Which faces overhang.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OverhangSettings {
    /// Away from the build plate, in the space of the mesh; any length but zero.
    pub up: DVec3,
    /// A face overhangs whose normal is nearer to straight down than this, in radians. 0 to π/2: with a larger angle
    /// walls overhang, too, and at 45° a chamfer of 45° does not.
    pub angle: f64,
    /// Faces no higher than this above the lowest vertex lie on the build plate, in metres.
    pub plate_within: f64,
}

impl Default for OverhangSettings {
    /// +Y up, 45°, a hundredth of a millimetre.
    fn default() -> Self {
        Self { up: DVec3::Y, angle: std::f64::consts::FRAC_PI_4, plate_within: 1e-5 }
    }
}

/// A face at the limit does not overhang: what rounding its corners to f32 changes of its angle, with a margin; radians.
const AT_THE_LIMIT: f64 = 1e-6;

impl EditMesh {
    /// The faces that look down so far that nothing below holds them while they are printed, but for those on the build
    /// plate. In ascending order. None has no area; there are none if up is zero or not finite.
    #[must_use]
    pub fn overhanging_faces(&self, settings: &OverhangSettings) -> Vec<FaceId> {
        let Some(up) = settings.up.try_normalize() else { return Vec::new() };
        let height = |vertex: VertexId| self.point(vertex).dot(up);
        let vertices = self.faces().flat_map(|face| self.face_vertices(face));
        let plate = vertices.map(height).fold(f64::INFINITY, f64::min) + settings.plate_within;
        let overhangs = |face: &FaceId| {
            let normal = self.face_normal(*face);
            normal != DVec3::ZERO
                && angle(normal, -up) < settings.angle - AT_THE_LIMIT
                && self.face_vertices(*face).any(|vertex| height(vertex) > plate)
        };
        self.faces().filter(overhangs).collect()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::Vec3;
    use trigon_mesh::primitives;

    use super::*;

    /// A square with sides of integers, whose area vector is an integer, too.
    fn square(right: [i64; 3], ahead: [i64; 3]) -> EditMesh {
        let mut mesh = EditMesh::new();
        let at = |place: [i64; 3]| Vec3::from_array(place.map(|value| value as f32));
        let sum = [0, 1, 2].map(|axis| right[axis] + ahead[axis]);
        let corners = [[0; 3], right, sum, ahead].map(|place| mesh.add_vertex(at(place)).expect("room"));
        mesh.add_face(&corners).expect("a square");
        // Something below it, so that it does not lie on the plate.
        let low =
            [[0, -99, 0], [1, -99, 0], [0, -99, 1]].map(|place| mesh.add_vertex(at(place)).expect("room"));
        mesh.add_face(&low).expect("a triangle");
        mesh
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        /// Against integers: the normal n is within 45° of down if −n.y is positive and 2 n.y² > n². Within 60° it is if
        /// 4 n.y² > n².
        #[test]
        fn overhangs_are_those_of_exact_numbers(
            right in prop::array::uniform3(-9i64..9),
            ahead in prop::array::uniform3(-9i64..9),
            is_wide: bool,
        ) {
            let [[a, b, c], [d, e, f]] = [right, ahead];
            let normal = [b * f - c * e, c * d - a * f, a * e - b * d];
            prop_assume!(normal != [0; 3]);
            let squared: i64 = normal.iter().map(|value| value * value).sum();
            let factor = if is_wide { 4 } else { 2 };
            let expected = normal[1] < 0 && factor * normal[1] * normal[1] > squared;
            let angle = if is_wide { std::f64::consts::FRAC_PI_3 } else { std::f64::consts::FRAC_PI_4 };
            let settings = OverhangSettings { angle, ..OverhangSettings::default() };
            let found = square(right, ahead).overhanging_faces(&settings);
            prop_assert_eq!(found.contains(&FaceId(0)), expected);
        }
    }

    #[test]
    fn a_box_stands_on_its_plate_and_overhangs_on_a_corner() {
        let (cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let with =
            |up: DVec3| cube.overhanging_faces(&OverhangSettings { up, ..OverhangSettings::default() });
        assert_eq!(with(DVec3::Y), [], "its only face that looks down lies on the plate");
        // On an edge both faces below are at exactly 45°; turned a little further one is steeper.
        assert_eq!(with(DVec3::new(0.0, 1.0, 1.0)), [], "at the limit");
        assert_eq!(with(DVec3::new(0.0, 1.0, 0.99)).len(), 1, "one of them");
        assert_eq!(with(DVec3::ZERO), [], "no direction");
        let wide = OverhangSettings { up: DVec3::ONE, angle: 0.96, ..OverhangSettings::default() };
        // On a corner three faces look down at arccos(1/√3) = 0.9553.
        assert_eq!(cube.overhanging_faces(&wide).len(), 3, "on a corner");
    }
}

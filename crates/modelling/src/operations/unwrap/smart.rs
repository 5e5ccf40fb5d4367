//! Smart projection: faces that look in similar directions are projected along one.

use std::f64::consts::PI;

use trigon_math::{DVec2, DVec3, elementary, unit_or_zero};

use super::charts::{UvChart, charts};
use super::injective::is_injective;
use super::islands::{Island, PackSettings, check_margin};
use super::{UnwrapSettings, Unwrapped, lay_flat};
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, FaceId};
use crate::numbering::{Numbering, sorted_once};
use crate::refusal::Refusal;

/// Parameters of [`EditMesh::smart_project_uvs`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SmartProjection {
    /// The set of texture coordinates, from 0; the next one is added if it does not exist.
    pub uv_set: usize,
    /// The greatest angle between a face's normal and the direction from which it is projected, in radians: 5° to 89°.
    pub angle_limit: f64,
    /// The distance of islands from one another and from the border of the image, in sides of the image; at least 0.
    pub margin: f64,
}

impl Default for SmartProjection {
    /// 66°, as in Blender, and a margin of a hundredth.
    fn default() -> Self {
        Self { uv_set: 0, angle_limit: 66.0 / 180.0 * PI, margin: 0.01 }
    }
}

const OPERATION: &str = "projecting texture coordinates";

/// Angles are rounded: faces that meet a limit exactly belong together.
const COSINE_ROUNDING: f64 = 1e-9;

impl EditMesh {
    /// Divides faces into groups by the directions of their normals, projects each connected part of a group along its
    /// direction, and packs them into the image with areas in proportion. Seams cut, too. A part that would overlap
    /// itself is unwrapped instead. Any surface can be laid out so, closed or not. If there are `uv_set` sets, one is
    /// added, with zero at all other corners. Given tangents are unchanged.
    ///
    /// # Errors
    /// No face is given, one does not exist; there are fewer than `uv_set` sets; a parameter is out of range; a
    /// position is not finite; or memory is not sufficient.
    pub fn smart_project_uvs(
        &mut self,
        faces: &[FaceId],
        settings: &SmartProjection,
    ) -> Result<Unwrapped, Refusal> {
        let &SmartProjection { uv_set, angle_limit, margin } = settings;
        self.check_faces(faces, OPERATION)?;
        self.check_uv_set(uv_set)?;
        check_margin(margin)?;
        if !(5.0 / 180.0 * PI..=89.0 / 180.0 * PI).contains(&angle_limit) {
            let (parameter, range) = ("the angle limit", "5° to 89° (in radians)");
            return Err(Refusal::OutOfRange { parameter, value: angle_limit, range });
        }
        let faces = sorted_once(faces.to_vec());
        let groups = NormalGroups::new(self, &faces, elementary::cos(angle_limit));
        let joins = |edge, corners: [CornerId; 2]| {
            let [a, b] = corners.map(|corner| groups.number(self.corner_face(corner)));
            !self.is_seam(edge) && a == b
        };
        let mut islands = Vec::new();
        for chart in charts(self, &faces, joins) {
            if !chart.points.iter().all(|point| point.is_finite()) {
                let reason = "a vertex has no finite position; move it";
                return Err(Refusal::NotPossible { operation: OPERATION, reason });
            }
            let direction = groups.direction(self.corner_face(chart.corners[0].corner));
            let mut layout = projected(&chart, direction);
            if chart.is_disc_with_holes() && !is_injective(&chart, &layout) {
                let unwrapping = UnwrapSettings::default();
                (layout, _) =
                    lay_flat(&chart, &unwrapping, self.memory).map_err(|error| self.no_layout(error))?;
            }
            islands.push(Island::with_area_of(chart, layout));
        }
        let packing = PackSettings { margin, ..PackSettings::default() };
        let mut unwrapped = Unwrapped { islands: islands.len(), ..Unwrapped::default() };
        unwrapped.turned_over = self.write_islands(islands, uv_set, &packing)?;
        Ok(unwrapped)
    }
}

/// A chart seen from a direction.
fn projected(chart: &UvChart, direction: DVec3) -> Vec<DVec2> {
    let (right, up) = direction.any_orthonormal_pair();
    chart.points.iter().map(|point| DVec2::new(right.dot(*point), up.dot(*point))).collect()
}

/// Faces by the direction from which they are projected.
struct NormalGroups {
    directions: Vec<DVec3>,
    numbering: Numbering,
    /// By position of the face: the number of its direction.
    group: Vec<u32>,
}

/// A face whose direction is wanted.
struct Facing {
    normal: DVec3,
    area: f64,
    group: u32,
    /// The cosine of the angle to the nearest direction so far.
    cosine: f64,
}

impl NormalGroups {
    /// The first direction is that of the largest face, the others are those of faces that are farthest from all
    /// directions so far, until all faces are within the limit. Each is replaced by the mean of the normals within the
    /// limit of it, if that is within the limit, too.
    fn new(mesh: &EditMesh, faces: &[FaceId], least_cosine: f64) -> Self {
        let facing = |&face: &FaceId| {
            let vector = mesh.face_area_vector(face);
            Facing {
                normal: unit_or_zero(vector),
                area: vector.length(),
                group: 0,
                cosine: f64::NEG_INFINITY,
            }
        };
        let mut all: Vec<Facing> = faces.iter().map(facing).collect();
        let least_cosine = least_cosine - COSINE_ROUNDING;
        let mut directions: Vec<DVec3> = Vec::new();
        while let Some(seed) = next_seed(&all, least_cosine) {
            let within = |face: &&Facing| face.normal.dot(seed) >= least_cosine;
            let sum: DVec3 = all.iter().filter(within).map(|face| face.normal * face.area).sum();
            let mean = unit_or_zero(sum);
            let direction = if mean.dot(seed) >= least_cosine { mean } else { seed };
            let number = directions.len() as u32;
            directions.push(direction);
            for face in &mut all {
                let cosine = face.normal.dot(direction);
                if cosine > face.cosine {
                    (face.cosine, face.group) = (cosine, number);
                }
            }
        }
        if directions.is_empty() {
            // No face has an area.
            directions.push(DVec3::Z);
        }
        let indices: Vec<u32> = faces.iter().map(|face| face.index()).collect();
        let numbering = Numbering::new(&indices, mesh.face_capacity());
        Self { directions, numbering, group: all.iter().map(|face| face.group).collect() }
    }

    fn number(&self, face: FaceId) -> u32 {
        self.numbering.get(face.index()).map_or(0, |position| self.group[position])
    }

    fn direction(&self, face: FaceId) -> DVec3 {
        self.directions[self.number(face) as usize]
    }
}

/// The normal of the face that is farthest from all directions, if it is not within the limit; of several the largest,
/// then the first.
fn next_seed(all: &[Facing], least_cosine: f64) -> Option<DVec3> {
    let mut best: Option<&Facing> = None;
    for face in all.iter().filter(|face| face.normal != DVec3::ZERO && face.cosine < least_cosine) {
        let is_better = best.is_none_or(|best| {
            face.cosine < best.cosine || (face.cosine == best.cosine && face.area > best.area)
        });
        if is_better {
            best = Some(face);
        }
    }
    best.map(|face| face.normal)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_mesh::primitives;

    use super::super::tests::{all_triangles, check_layout};
    use super::*;
    use crate::tests::{check_operation, meshes};

    fn projected(start: &trigon_mesh::Mesh, settings: &SmartProjection) -> (EditMesh, Unwrapped) {
        let (mut mesh, _) = EditMesh::from_mesh(start);
        let faces: Vec<FaceId> = mesh.faces().collect();
        let unwrapped = mesh.smart_project_uvs(&faces, settings).expect("any surface can be");
        (mesh, unwrapped)
    }

    #[test]
    fn closed_surfaces_are_laid_out_without_overlaps() {
        let solids = [
            (primitives::cube(2.0), 6),
            (primitives::icosphere(1.0, 2), 0),
            (primitives::torus(2.0, 0.5, 16, 8), 0),
            (primitives::cylinder(1.0, 2.0, 12), 0),
        ];
        for (solid, islands) in solids {
            for degrees in [30.0f64, 66.0, 89.0] {
                let settings =
                    SmartProjection { angle_limit: degrees.to_radians(), ..SmartProjection::default() };
                let (mesh, unwrapped) = projected(&solid, &settings);
                assert_eq!(unwrapped.turned_over, 0, "at {degrees}");
                assert!(islands == 0 || unwrapped.islands == islands, "{} at {degrees}", unwrapped.islands);
                check_layout(&all_triangles(&mesh)).expect("no overlap");
            }
        }
    }

    #[test]
    fn a_smaller_angle_makes_more_islands() {
        let sphere = primitives::icosphere(1.0, 2);
        let islands = |degrees: f64| {
            let settings =
                SmartProjection { angle_limit: degrees.to_radians(), ..SmartProjection::default() };
            projected(&sphere, &settings).1.islands
        };
        assert!(islands(20.0) > islands(50.0) && islands(50.0) > islands(85.0), "fewer and fewer");
        let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let faces: Vec<FaceId> = cube.faces().collect();
        for angle_limit in [0.0, 1.6, f64::NAN] {
            let settings = SmartProjection { angle_limit, ..SmartProjection::default() };
            assert!(cube.smart_project_uvs(&faces, &settings).is_err(), "{angle_limit} is out of range");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        /// Every mesh can be projected, and undo gives the same bytes.
        #[test]
        fn any_mesh_is_projected(start in meshes(), degrees in 5.0f64..89.0) {
            let (mesh, _) = EditMesh::from_mesh(&start);
            let faces: Vec<FaceId> = mesh.faces().collect();
            prop_assume!(!faces.is_empty());
            let settings = SmartProjection { angle_limit: degrees.to_radians(), ..SmartProjection::default() };
            let done = check_operation(&mesh, |mesh| mesh.smart_project_uvs(&faces, &settings));
            prop_assert!(done.map_err(TestCaseError::fail)?.is_some());
        }
    }
}

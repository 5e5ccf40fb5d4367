//! Which side of faces is outside: turning them over, and finding it out for whole parts.

use fixedbitset::FixedBitSet;
use trigon_math::DVec3;

use super::super::edit_mesh::EditMesh;
use super::super::ids::{CornerId, FaceId};
use super::super::refusal::Refusal;

/// A part whose volume is less than this share of its area times its size counts as flat: that is
/// what rounding to f32 makes of a plane, with room to spare.
const FLAT: f64 = 1e-6;

/// What recalculating normals did.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct RecalculatedNormals {
    /// The faces that were turned over, in the order in which they were reached.
    pub turned: Vec<FaceId>,
    /// At how many edges the two faces still run in the same direction: a surface with one side,
    /// as a Möbius strip, has some whatever is turned.
    pub conflicts: usize,
}

impl EditMesh {
    /// Turns faces over, so that their other side is outside: [`Self::flip_face`] for each. Normals
    /// that were given for their corners point the other way then.
    ///
    /// # Errors
    /// None is given, or one does not exist.
    pub fn flip_faces(&mut self, faces: &[FaceId]) -> Result<(), Refusal> {
        self.check_faces(faces, "flipping faces")?;
        let mut seen = FixedBitSet::with_capacity(self.face_capacity());
        faces.iter().filter(|face| !seen.put(face.0 as usize)).try_for_each(|&face| self.flip_face(face))
    }

    /// Turns faces over where that is needed for each connected part to look the same way, and
    /// for that way to be outside. Given normals of faces that are turned point the other way
    /// then.
    ///
    /// Faces are connected over edges where exactly two sides of faces meet, both of the given faces. Of
    /// a part, outside is where its volume is positive: that is exact for closed parts, each by
    /// itself (also a cavity looks away from what it encloses). Of an open part it is the volume
    /// between the surface and the mean of its corners, so that a bowl looks outwards. A part
    /// that is flat looks to the side to which most of its area looked before.
    ///
    /// # Errors
    /// None is given, or one does not exist.
    pub fn recalculate_normals(&mut self, faces: &[FaceId]) -> Result<RecalculatedNormals, Refusal> {
        self.check_faces(faces, "recalculating normals")?;
        let parts = Parts::find(self, faces);
        for &face in &parts.turned {
            self.flip_face(face)?;
        }
        // Each was seen from both of its faces.
        Ok(RecalculatedNormals { turned: parts.turned, conflicts: parts.conflicts / 2 })
    }

    /// The other corner that leaves along the edge of a corner, where there are exactly two.
    fn opposite(&self, corner: CornerId) -> Option<CornerId> {
        let other = self.radial_next(corner);
        (other != corner && self.radial_next(other) == corner).then_some(other)
    }
}

/// The search for parts and their outsides.
struct Parts {
    is_given: FixedBitSet,
    is_reached: FixedBitSet,
    /// Faces that run against the first of their part.
    is_against: FixedBitSet,
    turned: Vec<FaceId>,
    conflicts: usize,
}

impl Parts {
    fn find(mesh: &EditMesh, faces: &[FaceId]) -> Self {
        let none = || FixedBitSet::with_capacity(mesh.face_capacity());
        let mut parts = Self {
            is_given: none(),
            is_reached: none(),
            is_against: none(),
            turned: Vec::new(),
            conflicts: 0,
        };
        for face in faces {
            parts.is_given.insert(face.0 as usize);
        }
        let mut part = Vec::new();
        for &face in faces {
            if !parts.is_reached.put(face.0 as usize) {
                part.clear();
                part.push(face);
                parts.reach(mesh, &mut part);
                parts.choose_side(mesh, &part);
            }
        }
        parts
    }

    /// Finds all faces of the part of the first one, and how they run.
    fn reach(&mut self, mesh: &EditMesh, part: &mut Vec<FaceId>) {
        let mut next = 0;
        while let Some(&face) = part.get(next) {
            next += 1;
            let is_against = self.is_against.contains(face.0 as usize);
            for corner in mesh.face_corners(face) {
                let Some(opposite) = mesh.opposite(corner) else { continue };
                let other = mesh.corner_face(opposite);
                if other == face || !self.is_given.contains(other.0 as usize) {
                    continue;
                }
                let runs_the_same_way = mesh.corner_vertex(corner) == mesh.corner_vertex(opposite);
                let other_is_against = is_against != runs_the_same_way;
                if !self.is_reached.put(other.0 as usize) {
                    self.is_against.set(other.0 as usize, other_is_against);
                    part.push(other);
                } else if self.is_against.contains(other.0 as usize) != other_is_against {
                    self.conflicts += 1;
                }
            }
        }
    }

    fn choose_side(&mut self, mesh: &EditMesh, part: &[FaceId]) {
        let size = PartSize::of(mesh, part, &self.is_against);
        let looks_inwards = if size.volume.abs() > size.rounding {
            size.volume < 0.0
        } else {
            size.area_against > size.area_along
        };
        let is_turned = |face: &FaceId| self.is_against.contains(face.0 as usize) != looks_inwards;
        self.turned.extend(part.iter().copied().filter(is_turned));
    }
}

/// How large a part is if all of its faces run as the first one does.
struct PartSize {
    volume: f64,
    /// A volume up to this is that of a flat part.
    rounding: f64,
    area_along: f64,
    area_against: f64,
}

impl PartSize {
    fn of(mesh: &EditMesh, part: &[FaceId], is_against: &FixedBitSet) -> Self {
        let center = mean_corner(mesh, part);
        let mut size = Self { volume: 0.0, rounding: 0.0, area_along: 0.0, area_against: 0.0 };
        let mut reach = 0.0f64;
        for &face in part {
            let area_vector = mesh.face_area_vector(face);
            if !area_vector.is_finite() {
                continue;
            }
            // The cones from the centre over the triangles of the face's fan: they share its first
            // corner, so their area vectors add up to the face's.
            let first = mesh.face_vertices(face).next().map_or(center, |vertex| mesh.point(vertex));
            let cone = (first - center).dot(area_vector) / 3.0;
            reach = reach.max(first.distance_squared(center));
            if is_against.contains(face.0 as usize) {
                size.volume -= cone;
                size.area_against += area_vector.length();
            } else {
                size.volume += cone;
                size.area_along += area_vector.length();
            }
        }
        size.rounding = FLAT * (size.area_along + size.area_against) * reach.sqrt();
        size
    }
}

/// The mean of the faces' first corners, as far as they are finite.
fn mean_corner(mesh: &EditMesh, part: &[FaceId]) -> DVec3 {
    let corners = part.iter().filter_map(|&face| mesh.face_vertices(face).next());
    let finite = corners.map(|vertex| mesh.point(vertex)).filter(|point| point.is_finite());
    let (sum, count) = finite.fold((DVec3::ZERO, 0.0), |(sum, count), point| (sum + point, count + 1.0));
    if count > 0.0 { sum / count } else { DVec3::ZERO }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::Vec3;

    use super::super::super::tests::meshes;
    use super::*;
    use crate::edit::VertexId;
    use crate::{Mesh, primitives};

    fn editable(mesh: &Mesh) -> (EditMesh, Vec<FaceId>) {
        let (mesh, _) = EditMesh::from_mesh(mesh);
        let faces = mesh.faces().collect();
        (mesh, faces)
    }

    #[test]
    fn a_closed_part_looks_outwards_whatever_was_turned() {
        for solid in [primitives::cube(2.0), primitives::torus(2.0, 0.5, 8, 6), primitives::icosphere(1.0, 2)]
        {
            let (mut mesh, faces) = editable(&solid);
            assert_eq!(mesh.recalculate_normals(&faces), Ok(RecalculatedNormals::default()), "it is right");
            let some: Vec<FaceId> = faces.iter().copied().filter(|face| face.0 % 3 == 1).collect();
            for turned in [&faces, &some, &faces[1..].to_vec()] {
                mesh.flip_faces(turned).expect("they exist");
                let mut result = mesh.recalculate_normals(&faces).expect("they exist");
                result.turned.sort_unstable();
                assert_eq!((&result.turned, result.conflicts), (turned, 0), "those that were turned");
                assert!(mesh.to_mesh().0.volume() > 0.0 && mesh.to_mesh().0.is_closed(), "a solid");
            }
        }
    }

    #[test]
    fn a_flat_part_looks_where_most_of_it_looked() {
        let (mut grid, faces) = editable(&primitives::grid(3.0, 3.0, 3, 3));
        let normal = grid.face_normal(faces[0]);
        grid.flip_faces(&faces[..4]).expect("they exist");
        assert_eq!(grid.recalculate_normals(&faces).expect("they exist").turned.len(), 4, "four of nine");
        assert!(faces.iter().all(|&face| grid.face_normal(face) == normal), "as before");
        grid.flip_faces(&faces[..5]).expect("they exist");
        assert_eq!(grid.recalculate_normals(&faces).expect("they exist").turned.len(), 4, "the other four");
        assert!(faces.iter().all(|&face| grid.face_normal(face) == -normal), "as most of them");
    }

    #[test]
    fn a_bowl_looks_outwards() {
        let (mut bowl, faces) = editable(&primitives::uv_sphere(1.0, 12, 8));
        let upper: Vec<FaceId> =
            faces.iter().copied().filter(|&face| bowl.face_center(face).y > 0.0).collect();
        bowl.delete_faces(&upper).expect("they exist");
        let faces: Vec<FaceId> = bowl.faces().collect();
        bowl.flip_faces(&faces).expect("they exist");
        assert_eq!(bowl.recalculate_normals(&faces).expect("they exist").turned.len(), faces.len(), "all");
        assert!(
            faces.iter().all(|&face| bowl.face_normal(face).dot(bowl.face_center(face)) > 0.0),
            "outwards"
        );
    }

    #[test]
    fn a_strip_with_one_side_is_left_with_a_conflict() {
        let mut mesh = EditMesh::new();
        let around = 8;
        let vertices: Vec<[VertexId; 2]> = (0..around)
            .map(|i| {
                let turn = std::f64::consts::TAU * f64::from(i) / f64::from(around);
                let (sin, cos) = trigon_math::elementary::sin_cos(turn);
                let (lift, inwards) = trigon_math::elementary::sin_cos(turn / 2.0);
                [-0.3, 0.3].map(|side| {
                    let radius = 1.0 + side * inwards;
                    let place = DVec3::new(radius * cos, side * lift, radius * sin).as_vec3();
                    mesh.add_vertex(place).expect("room")
                })
            })
            .collect();
        for i in 0..around as usize {
            let [a, b] = vertices[i];
            let [c, d] =
                if i + 1 < vertices.len() { vertices[i + 1] } else { [vertices[0][1], vertices[0][0]] };
            mesh.add_face(&[a, c, d, b]).expect("four vertices");
        }
        let faces: Vec<FaceId> = mesh.faces().collect();
        assert_eq!(mesh.recalculate_normals(&faces).expect("they exist").conflicts, 1, "at one edge");
    }

    #[test]
    fn a_place_that_is_not_a_number_does_not_spoil_the_rest() {
        let (mut sphere, faces) = editable(&primitives::icosphere(1.0, 2));
        sphere.flip_faces(&faces).expect("they exist");
        sphere.set_position(VertexId(0), Vec3::NAN);
        assert_eq!(sphere.recalculate_normals(&faces).expect("they exist").turned.len(), faces.len(), "all");
    }

    proptest! {
        /// Afterwards all two-sided edges run in opposite directions, but for the conflicts; where there
        /// are none a second time turns nothing; undone, all is as it was.
        #[test]
        fn parts_look_one_way(start in meshes(), flips in prop::collection::vec(any::<bool>(), 40)) {
            let (mut mesh, faces) = editable(&start);
            prop_assume!(!faces.is_empty());
            for (&face, _) in faces.iter().zip(&flips).filter(|(_, flip)| **flip) {
                mesh.flip_face(face).expect("it exists");
            }
            let before = mesh.clone();
            let (result, mut difference) =
                mesh.transaction(|mesh| mesh.recalculate_normals(&faces)).expect("they exist");
            prop_assert_eq!(mesh.check_structure(), Ok(()));
            let conflicts = mesh.edges().filter(|&edge| mesh.edge_pair(edge).is_some_and(|[one, two]| {
                mesh.corner_face(one) != mesh.corner_face(two) && mesh.corner_vertex(one) == mesh.corner_vertex(two)
            }));
            prop_assert_eq!(conflicts.count(), result.conflicts);
            let again = mesh.clone().recalculate_normals(&faces).expect("they exist");
            prop_assert!(result.conflicts > 0 || again.turned.is_empty(), "{:?}", again.turned);
            difference.apply(&mut mesh);
            prop_assert!(mesh == before);
        }
    }
}

//! Orientation of faces: flipping them, and determining it for whole parts.

use fixedbitset::FixedBitSet;
use trigon_math::DVec3;

use crate::edit_mesh::EditMesh;
use crate::ids::FaceId;
use crate::numbering::is_more_than_one_of;
use crate::refusal::Refusal;

/// A part whose volume is less than this fraction of its area times its size counts as flat: that
/// is what rounding to f32 makes of a plane, with some margin.
const FLAT: f64 = 1e-6;

/// The result of recalculating normals.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct RecalculatedNormals {
    /// The flipped faces, in the order of discovery.
    pub turned: Vec<FaceId>,
    /// The number of edges at which the two faces still run in the same direction: a one-sided
    /// surface, such as a Möbius strip, always has some.
    pub conflicts: usize,
}

impl EditMesh {
    /// Flips faces, so that their other side is outside: [`Self::flip_face`] for each. Given
    /// normals of their corners are reversed.
    ///
    /// # Errors
    /// None is given, or one does not exist.
    pub fn flip_faces(&mut self, faces: &[FaceId]) -> Result<(), Refusal> {
        self.check_faces(faces, "flipping faces")?;
        let mut listed = FixedBitSet::with_capacity(self.face_capacity());
        let mut faces = faces.to_vec();
        faces.retain(|face| !listed.put(face.0 as usize));
        self.flip_each(&faces)
    }

    /// Flips faces, each of which is given once.
    fn flip_each(&mut self, faces: &[FaceId]) -> Result<(), Refusal> {
        /// From one face of so many on, one pass over all of them costs less than one flip each.
        const MANY: usize = 8;
        if is_more_than_one_of(MANY, faces.len(), self.face_count()) {
            self.flip_together(&faces.iter().map(|face| face.0 as usize).collect());
            return Ok(());
        }
        faces.iter().try_for_each(|&face| self.flip_face(face))
    }

    /// Flips faces as needed so that each connected part is consistently oriented and points
    /// outwards. Given normals of flipped faces are reversed.
    ///
    /// Faces are connected across edges where exactly two sides of faces meet, both of the given faces. The
    /// outside of a part is where its volume is positive: that is exact for closed parts, each by itself
    /// (also a cavity faces away from what it encloses). For an open part it is the volume between the
    /// surface and the mean of its faces' first corners, so that a bowl faces outwards. A flat part faces the
    /// side to which most of its area faced before.
    ///
    /// # Errors
    /// None is given, or one does not exist.
    pub fn recalculate_normals(&mut self, faces: &[FaceId]) -> Result<RecalculatedNormals, Refusal> {
        self.check_faces(faces, "recalculating normals")?;
        let parts = PartSearch::find(self, faces);
        self.flip_each(&parts.turned)?;
        // Each was found from both of its faces.
        Ok(RecalculatedNormals { turned: parts.turned, conflicts: parts.conflicts / 2 })
    }
}

/// The search for parts and their outsides.
struct PartSearch {
    is_given: FixedBitSet,
    is_reached: FixedBitSet,
    /// Faces that run against the first of their part.
    is_against: FixedBitSet,
    turned: Vec<FaceId>,
    conflicts: usize,
}

impl PartSearch {
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
                let size = parts.reach(mesh, &mut part);
                parts.choose_side(&size, &part);
            }
        }
        parts
    }

    /// Finds all faces of the part of the first one, their orientation, and their volume.
    fn reach(&mut self, mesh: &EditMesh, part: &mut Vec<FaceId>) -> PartSize {
        let start = mesh.face_vertices(part[0]).next().map_or(DVec3::ZERO, |vertex| mesh.point(vertex));
        let mut size = PartSize::new(if start.is_finite() { start } else { DVec3::ZERO });
        let mut next = 0;
        while let Some(&face) = part.get(next) {
            next += 1;
            let is_against = self.is_against.contains(face.0 as usize);
            let mut fan = TriangleFan::default();
            for corner in mesh.face_corners(face) {
                let here = &mesh.corners[corner.0];
                fan.add(mesh.positions[here.vertex].as_dvec3());
                // Where exactly two sides meet, each is the one after the other.
                let across = &mesh.corners[here.radial_next];
                let other = FaceId(across.face);
                let is_pair = across.radial_next == corner.0 && other != face;
                if !is_pair || !self.is_given.contains(other.0 as usize) {
                    continue;
                }
                let other_is_against = is_against != (here.vertex == across.vertex);
                if !self.is_reached.put(other.0 as usize) {
                    self.is_against.set(other.0 as usize, other_is_against);
                    part.push(other);
                } else if self.is_against.contains(other.0 as usize) != other_is_against {
                    self.conflicts += 1;
                }
            }
            size.add(&fan, is_against);
        }
        size
    }

    fn choose_side(&mut self, size: &PartSize, part: &[FaceId]) {
        let volume = size.volume();
        let looks_inwards =
            if volume.abs() > size.rounding() { volume < 0.0 } else { size.area_against > size.area_along };
        let is_turned = |face: &FaceId| self.is_against.contains(face.0 as usize) != looks_inwards;
        self.turned.extend(part.iter().copied().filter(is_turned));
    }
}

/// The triangles of a face from its first corner.
#[derive(Default)]
struct TriangleFan {
    first: Option<DVec3>,
    last: DVec3,
    /// Twice the area vector.
    doubled: DVec3,
}

impl TriangleFan {
    fn add(&mut self, point: DVec3) {
        let Some(first) = self.first else {
            self.first = Some(point);
            return;
        };
        let from_first = point - first;
        self.doubled += self.last.cross(from_first);
        self.last = from_first;
    }
}

/// The volume of a part if all of its faces run like the first one.
struct PartSize {
    /// Positions are relative to it: a corner of the part.
    origin: DVec3,
    /// Three times the volume between the surface and the origin.
    cones: f64,
    /// The sum of all area vectors: zero for a closed part.
    area_vector: DVec3,
    area_along: f64,
    area_against: f64,
    /// The sum of the faces' first corners, how many these are, and the largest squared distance.
    corners: DVec3,
    count: f64,
    reach: f64,
}

impl PartSize {
    fn new(origin: DVec3) -> Self {
        Self {
            origin,
            cones: 0.0,
            area_vector: DVec3::ZERO,
            area_along: 0.0,
            area_against: 0.0,
            corners: DVec3::ZERO,
            count: 0.0,
            reach: 0.0,
        }
    }

    fn add(&mut self, fan: &TriangleFan, is_against: bool) {
        let Some(first) = fan.first.filter(|_| fan.doubled.is_finite()) else { return };
        let first = first - self.origin;
        let area = fan.doubled.length() * 0.5;
        let area_vector = if is_against { fan.doubled * -0.5 } else { fan.doubled * 0.5 };
        // All triangles of the fan share its first corner, so that their cones add up to that of its area
        // vector.
        self.cones += first.dot(area_vector);
        self.area_vector += area_vector;
        *if is_against { &mut self.area_against } else { &mut self.area_along } += area;
        self.corners += first;
        self.count += 1.0;
        self.reach = self.reach.max(first.length_squared());
    }

    /// The volume between the surface and the mean of the faces' first corners.
    fn volume(&self) -> f64 {
        let center = if self.count > 0.0 { self.corners / self.count } else { DVec3::ZERO };
        (self.cones - center.dot(self.area_vector)) / 3.0
    }

    /// A volume up to this counts as flat.
    fn rounding(&self) -> f64 {
        FLAT * (self.area_along + self.area_against) * self.reach.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::Vec3;
    use trigon_mesh::{Mesh, primitives};

    use super::*;
    use crate::VertexId;
    use crate::tests::meshes;

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
                    let point = DVec3::new(radius * cos, side * lift, radius * sin).as_vec3();
                    mesh.add_vertex(point).expect("room")
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
        /// Afterwards all two-sided edges run in opposite directions, except for the conflicts; if there are
        /// none, a second run flips nothing; undo restores everything.
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

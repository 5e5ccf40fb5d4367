//! Groups of faces that lie in one plane, each of which can be one face: a disc whose outline visits no vertex twice.
//!
//! A group grows by a face at a time, whose sides along the group are one chain and which touches the group nowhere
//! else; so it stays a disc. A flat area with a hole becomes at least two groups, which meet between the hole
//! and the outline.

use smallvec::SmallVec;
use trigon_math::DVec3;

use super::super::region::Region;
use super::super::tables::IndexTable;
use super::merge::FaceGroups;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, FaceId};
use crate::records::{SEAM, SHARP};

/// Faces with more corners are tested when no other one is left, because a test takes time in proportion to these.
const MANY_CORNERS: usize = 64;

/// So often they are tested for each group.
const MOST_SWEEPS: usize = 8;

/// The search for groups.
pub(super) struct Discs<'a> {
    mesh: &'a EditMesh,
    region: &'a Region,
    normals: Vec<DVec3>,
    /// The smallest cosine of the angle between the normals of a face and of the first one of its group.
    least_cosine: f64,
    /// From faces to the number of their group.
    numbers: IndexTable,
    /// From vertices to the number of the last group that has them.
    vertices: IndexTable,
}

/// A group that grows.
struct Disc {
    number: u32,
    normal: DVec3,
    /// In the order in which they were added.
    faces: Vec<FaceId>,
    /// The number of sides of its outline.
    sides: usize,
}

impl<'a> Discs<'a> {
    pub(super) fn new(mesh: &'a EditMesh, region: &'a Region, least_cosine: f64) -> Self {
        let count = region.faces.len();
        Self {
            mesh,
            region,
            normals: region.faces.iter().map(|&face| mesh.unit_normal(face)).collect(),
            least_cosine,
            numbers: IndexTable::new(mesh.face_capacity(), count),
            vertices: IndexTable::new(mesh.vertex_capacity(), region.corner_count(mesh)),
        }
    }

    /// The groups around the faces with the lowest ids that are in none yet; some consist of one face.
    pub(super) fn find(mut self) -> FaceGroups {
        let mut groups = Vec::new();
        for (seed, &normal) in self.region.faces.iter().zip(&self.normals.clone()) {
            if self.numbers.get(seed.0).is_some() || normal == DVec3::ZERO {
                continue;
            }
            let number = groups.len() as u32;
            let mut disc = Disc { number, normal, faces: Vec::new(), sides: self.mesh.face_size(*seed) };
            self.add(&mut disc, *seed);
            self.grow(&mut disc);
            disc.faces.sort_unstable();
            groups.push(disc.faces);
        }
        FaceGroups { groups, numbers: self.numbers }
    }

    fn add(&mut self, disc: &mut Disc, face: FaceId) {
        self.numbers.insert(face.0, disc.number);
        for vertex in self.mesh.face_vertices(face) {
            self.vertices.insert(vertex.0, disc.number);
        }
        disc.faces.push(face);
    }

    fn grow(&mut self, disc: &mut Disc) {
        let mut waiting = disc.faces.clone();
        let mut large: Vec<FaceId> = Vec::new();
        for _ in 0..MOST_SWEEPS {
            while let Some(face) = waiting.pop() {
                let corners: SmallVec<[CornerId; 8]> = self.mesh.face_corners(face).collect();
                for corner in corners {
                    let other = self.mesh.corner_face(self.mesh.radial_next(corner));
                    if self.mesh.face_size(other) > MANY_CORNERS {
                        large.push(other);
                    } else if self.try_to_add(disc, other) {
                        waiting.push(other);
                    }
                }
            }
            large.sort_unstable();
            large.dedup();
            let added = large.extract_if(.., |face| self.try_to_add(disc, *face));
            waiting.extend(added);
            if waiting.is_empty() {
                break;
            }
        }
    }

    fn try_to_add(&mut self, disc: &mut Disc, face: FaceId) -> bool {
        let normal = self.region.faces.binary_search(&face).map_or(DVec3::ZERO, |index| self.normals[index]);
        let is_flat = normal != DVec3::ZERO && normal.dot(disc.normal) >= self.least_cosine;
        if !is_flat || self.numbers.get(face.0).is_some() {
            return false;
        }
        let Some(shared) = self.shared_chain(disc.number, face) else { return false };
        let sides = disc.sides + self.mesh.face_size(face) - 2 * shared;
        if sides < 3 {
            return false;
        }
        disc.sides = sides;
        self.add(disc, face);
        true
    }

    /// How many sides of a face are along a group, if these are one chain that may go, and it touches the
    /// group nowhere else.
    fn shared_chain(&self, number: u32, face: FaceId) -> Option<usize> {
        let mesh = self.mesh;
        let corners: SmallVec<[CornerId; 8]> = mesh.face_corners(face).collect();
        let mut is_shared: SmallVec<[bool; 8]> = SmallVec::with_capacity(corners.len());
        for &corner in &corners {
            let edge = mesh.corner_edge(corner);
            let other = mesh.corner_face(mesh.radial_next(corner));
            let is_between = self.numbers.get(other.0) == Some(number) && mesh.merging_pair(edge).is_some();
            if is_between && !mesh.may_dissolve(corner) {
                return None;
            }
            is_shared.push(is_between);
        }
        let before = |i: usize| is_shared[if i == 0 { corners.len() - 1 } else { i - 1 }];
        let chains = (0..corners.len()).filter(|&i| is_shared[i] && !before(i)).count();
        let is_touched = |i: usize| self.vertices.get(mesh.corner_vertex(corners[i]).0) == Some(number);
        let touches = (0..corners.len()).any(|i| !is_shared[i] && !before(i) && is_touched(i));
        (chains == 1 && !touches).then(|| is_shared.iter().filter(|&&shared| shared).count())
    }
}

impl EditMesh {
    /// Whether nothing but the faces' directions speaks for the edge along which a corner leaves, which is between
    /// two faces.
    fn may_dissolve(&self, corner: CornerId) -> bool {
        let is_marked = self.edges[self.corner_edge(corner).0].flags & (SEAM | SHARP) != 0;
        let material = |corner| self.material(self.corner_face(corner));
        !is_marked && material(corner) == material(self.radial_next(corner))
    }
}

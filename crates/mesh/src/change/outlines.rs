//! Where the corners of the quads around a change are.

use rayon::prelude::*;
use trigon_math::Vec3;

use super::face_normals::PIECE;
use crate::Mesh;
use crate::quads::QuadGroup;

/// If more than one in so many faces lies around a change, their corners are not kept: little is saved where the faces
/// are neighbours in memory.
const MANY: usize = 4;

/// Groups that a thread takes at a time.
const GROUPS: usize = PIECE / QuadGroup::MOST;

/// The corners of the quads around the elements of a change. They lie all over the memory, so they are kept side by side
/// while the same elements change, ready to be computed with, and only those are written that move.
#[derive(Debug, Clone, Default)]
pub struct Outlines {
    /// All faces with a vertex that was moved, increasing.
    faces: Vec<u32>,
    /// Of each [`QuadGroup::MOST`] of these faces. Empty if they are not kept.
    groups: Vec<MovingGroup>,
    /// The moved vertices, increasing, and where they are now.
    moved: Vec<u32>,
    places: Vec<Vec3>,
    version: u64,
}

/// Some quads, and those of their corners that move, in their order.
#[derive(Debug, Clone, Default)]
struct MovingGroup {
    quads: QuadGroup,
    moving: Vec<MovingCorner>,
}

/// A corner of a quad at which a moved vertex lies.
#[derive(Debug, Clone, Copy)]
struct MovingCorner {
    /// The number of the quad among those of its group.
    quad: u16,
    /// 0 to 3.
    corner: u8,
    /// The place of the vertex in the list of those that were moved.
    vertex: u32,
}

impl Outlines {
    /// Of the faces around other vertices; both increase.
    pub(super) fn replace(&mut self, mesh: &Mesh, faces: &[u32], moved: &[u32]) {
        *self = Self { faces: faces.to_vec(), version: self.version + 1, ..Self::default() };
        if faces.len() * MANY > mesh.face_count() {
            return;
        }
        self.moved = moved.to_vec();
        let group = |faces: &[u32]| MovingGroup::new(mesh, faces, moved);
        self.groups = faces.par_chunks(QuadGroup::MOST).with_min_len(GROUPS).map(group).collect();
    }

    /// Takes the new places of the vertices that move.
    pub(super) fn update(&mut self, mesh: &Mesh) {
        self.places.clear();
        self.places.extend(self.moved.iter().map(|&vertex| mesh.positions()[vertex as usize]));
        let Self { groups, places, .. } = self;
        groups.par_iter_mut().with_min_len(GROUPS).for_each(|group| group.update(places));
    }

    /// Changes whenever the faces are others.
    #[must_use]
    pub fn version(&self) -> u64 {
        self.version
    }

    /// The place of a face in the list, if it is one of the faces.
    #[must_use]
    pub fn place_of(&self, face: u32) -> Option<usize> {
        self.faces.binary_search(&face).ok()
    }

    /// How many faces there are.
    #[must_use]
    pub fn face_count(&self) -> usize {
        self.faces.len()
    }

    /// The quads among [`QuadGroup::MOST`] of the faces, or among those that are left of them: `number` counts these
    /// groups. They are gathered in `room` if they are not kept.
    ///
    /// # Panics
    ///
    /// If there are no faces for that group.
    pub fn group<'g>(&'g self, mesh: &Mesh, number: usize, room: &'g mut QuadGroup) -> &'g QuadGroup {
        if let Some(group) = self.groups.get(number) {
            return &group.quads;
        }
        let faces = &self.faces[number * QuadGroup::MOST..];
        let faces = faces[..faces.len().min(QuadGroup::MOST)].iter();
        mesh.prefetch_faces(faces.clone().copied());
        room.fill(faces.map(|&face| quad(mesh, face)));
        room
    }
}

impl MovingGroup {
    fn new(mesh: &Mesh, faces: &[u32], moved: &[u32]) -> Self {
        let mut group = Self::default();
        mesh.prefetch_faces(faces.iter().copied());
        group.quads.fill(faces.iter().map(|&face| quad(mesh, face)));
        for (quad, &number) in (0..).zip(group.quads.numbers()) {
            for (corner, vertex) in (0..).zip(mesh.face_vertices(faces[number as usize] as usize)) {
                if let Ok(vertex) = moved.binary_search(vertex) {
                    group.moving.push(MovingCorner { quad, corner, vertex: vertex as u32 });
                }
            }
        }
        group
    }

    fn update(&mut self, places: &[Vec3]) {
        for &MovingCorner { quad, corner, vertex } in &self.moving {
            self.quads.move_corner(quad.into(), corner.into(), places[vertex as usize]);
        }
    }
}

/// The corners of a quad.
fn quad(mesh: &Mesh, face: u32) -> Option<[Vec3; 4]> {
    let corners: [u32; 4] = mesh.face_vertices(face as usize).try_into().ok()?;
    Some(corners.map(|vertex| mesh.positions()[vertex as usize]))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::{MeshChange, primitives};

    proptest! {
        /// As in a drag of a few vertices, or of so many that nothing is kept, of quads and triangles.
        #[test]
        fn outlines_follow_the_vertices_that_move(
            moved in prop::collection::btree_set(0..90_u32, 1..70),
            places in prop::collection::vec(prop::array::uniform3(-2.0_f32..2.0), 3),
        ) {
            let mut mesh = primitives::uv_sphere(1.0, 11, 9);
            let moved: Vec<u32> = moved.into_iter().filter(|&vertex| (vertex as usize) < mesh.vertex_count()).collect();
            let is_moved = |face: &u32| mesh.face_vertices(*face as usize).iter().any(|vertex| moved.contains(vertex));
            let faces: Vec<u32> = (0..mesh.face_count() as u32).filter(is_moved).collect();
            let mut outlines = Outlines::default();
            outlines.replace(&mesh, &faces, &moved);
            prop_assert_eq!(outlines.groups.is_empty(), faces.len() * MANY > mesh.face_count());
            for place in places {
                let to = |&vertex: &u32| (vertex, Vec3::from_array(place) * vertex as f32);
                let positions = moved.iter().map(to).collect();
                mesh.change(&MeshChange { positions, ..MeshChange::default() }).expect("they exist");
                outlines.update(&mesh);
                prop_assert_eq!(outlines.face_count(), faces.len());
                for (number, faces) in faces.chunks(QuadGroup::MOST).enumerate() {
                    let (mut room, mut expected) = (QuadGroup::default(), QuadGroup::default());
                    expected.fill(faces.iter().map(|&face| quad(&mesh, face)));
                    prop_assert_eq!(outlines.group(&mesh, number, &mut room), &expected, "group {}", number);
                }
                for (place, &face) in faces.iter().enumerate() {
                    prop_assert_eq!(outlines.place_of(face), Some(place));
                }
            }
        }
    }
}

//! Where the corners of the quads around a change are.

use std::ops::Range;

use trigon_math::Vec3;

use crate::Mesh;

/// If more than one in so many faces lies around a change, their corners are not kept: little is saved where the faces
/// are neighbours in memory.
const MANY: usize = 4;

/// The corners of the quads around the elements of a change. They lie all over the memory, so they are kept side by side
/// while the same elements change, and only those are written that move.
#[derive(Debug, Clone, Default)]
pub struct Outlines {
    /// All faces with a vertex that was moved, increasing.
    faces: Vec<u32>,
    /// The corners of each, if it is a quad. Empty if they are not kept.
    quads: Vec<Option<[Vec3; 4]>>,
    /// The corners of these quads that move, in their order.
    moving: Vec<MovingCorner>,
    /// The moved vertices, increasing, and where they are now.
    moved: Vec<u32>,
    places: Vec<Vec3>,
    version: u64,
}

/// A corner of a quad at which a moved vertex lies.
#[derive(Debug, Clone, Copy)]
struct MovingCorner {
    /// The place of the quad in its list.
    quad: u32,
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
        self.quads = faces.iter().map(|&face| quad(mesh, face)).collect();
        for (quad, &face) in (0..).zip(faces).filter(|(quad, _)| self.quads[*quad as usize].is_some()) {
            for (corner, vertex) in (0..).zip(mesh.face_vertices(face as usize)) {
                if let Ok(vertex) = moved.binary_search(vertex) {
                    self.moving.push(MovingCorner { quad, corner, vertex: vertex as u32 });
                }
            }
        }
    }

    /// Takes the new places of the vertices that move.
    pub(super) fn update(&mut self, mesh: &Mesh) {
        self.places.clear();
        self.places.extend(self.moved.iter().map(|&vertex| mesh.positions()[vertex as usize]));
        for &MovingCorner { quad, corner, vertex } in &self.moving {
            if let Some(corners) = &mut self.quads[quad as usize] {
                corners[usize::from(corner)] = self.places[vertex as usize];
            }
        }
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

    /// The corners of the faces at these places that are quads.
    pub(super) fn quads<'o>(
        &'o self,
        mesh: &'o Mesh,
        places: Range<usize>,
    ) -> impl Iterator<Item = Option<[Vec3; 4]>> + 'o {
        if self.quads.is_empty() {
            mesh.prefetch_faces(self.faces[places.clone()].iter().copied());
        }
        places.map(move |place| self.quad(mesh, place))
    }

    /// The corners of the face at a place, if it is a quad.
    ///
    /// # Panics
    ///
    /// If there is no such place.
    #[must_use]
    pub fn quad(&self, mesh: &Mesh, place: usize) -> Option<[Vec3; 4]> {
        if self.quads.is_empty() { quad(mesh, self.faces[place]) } else { self.quads[place] }
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
            prop_assert_eq!(outlines.quads.is_empty(), faces.len() * MANY > mesh.face_count());
            for place in places {
                let to = |&vertex: &u32| (vertex, Vec3::from_array(place) * vertex as f32);
                let positions = moved.iter().map(to).collect();
                mesh.change(&MeshChange { positions, ..MeshChange::default() }).expect("they exist");
                outlines.update(&mesh);
                for (place, &face) in faces.iter().enumerate() {
                    prop_assert_eq!(outlines.place_of(face), Some(place));
                    prop_assert_eq!(outlines.quad(&mesh, place), quad(&mesh, face));
                }
            }
        }
    }
}

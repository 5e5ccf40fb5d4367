//! The vertices and elements of an OBJ, as long lists.

use trigon_math::{DVec3, Vec2, Vec3};

use super::index::Counts;

/// What a file holds, or a piece of it.
#[derive(Debug, Default)]
pub(crate) struct Content {
    pub(crate) positions: Vec<DVec3>,
    /// sRGB from 0 to 1, NaN where the file has no finite number; empty while no
    /// vertex has a colour.
    pub(crate) colors: Vec<Vec3>,
    /// v counted downwards, as everywhere in trigon.
    pub(crate) coordinates: Vec<Vec2>,
    pub(crate) normals: Vec<Vec3>,
    /// How many corners each element has: 1 for points, 2 for edges.
    pub(crate) arities: Vec<u32>,
    /// The position of each corner.
    pub(crate) position_indices: Vec<u32>,
    /// [`NONE`](super::index::NONE) where a corner has none; empty when the file has none.
    pub(crate) coordinate_indices: Vec<u32>,
    /// Likewise.
    pub(crate) normal_indices: Vec<u32>,
}

impl Content {
    /// Makes room for the vertices of a file.
    pub(crate) fn reserve(&mut self, total: Counts) {
        self.positions.reserve_exact(total.positions);
        self.coordinates.reserve_exact(total.coordinates);
        self.normals.reserve_exact(total.normals);
    }

    /// Moves what a later piece holds to the end.
    pub(crate) fn append(&mut self, mut later: Self) {
        if !later.colors.is_empty() || !self.colors.is_empty() {
            self.colors.resize(self.positions.len(), WHITE);
            later.colors.resize(later.positions.len(), WHITE);
            self.colors.append(&mut later.colors);
        }
        self.positions.append(&mut later.positions);
        self.coordinates.append(&mut later.coordinates);
        self.normals.append(&mut later.normals);
        self.arities.append(&mut later.arities);
        self.position_indices.append(&mut later.position_indices);
        self.coordinate_indices.append(&mut later.coordinate_indices);
        self.normal_indices.append(&mut later.normal_indices);
    }
}

/// Of vertices without a colour, where others have one.
pub(super) const WHITE: Vec3 = Vec3::ONE;

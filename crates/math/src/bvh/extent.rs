//! Boxes while a tree is made.

use glam::Vec3;

/// A box; empty if its sides are in the wrong order.
#[derive(Clone, Copy)]
pub(super) struct Extent {
    pub(super) min: Vec3,
    pub(super) max: Vec3,
}

impl Extent {
    pub(super) const EMPTY: Self = Self { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };

    pub(super) fn add(&mut self, min: Vec3, max: Vec3) {
        self.min = Vec3::select(min.cmplt(self.min), min, self.min);
        self.max = Vec3::select(max.cmpgt(self.max), max, self.max);
    }

    /// Half the surface area; 0 if it is empty.
    pub(super) fn half_area(&self) -> f32 {
        let size = self.max - self.min;
        if size.x >= 0.0 { size.x * size.y + size.y * size.z + size.z * size.x } else { 0.0 }
    }
}

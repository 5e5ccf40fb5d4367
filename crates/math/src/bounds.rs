//! Axis-aligned boxes.

use glam::{DAffine3, DVec3};

/// An axis-aligned bounding box.
///
/// Empty if `min > max` on some axis. The user keeps `min` and `max` free of NaN; the constructors
/// do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds3 {
    /// The smallest coordinate on each axis.
    pub min: DVec3,
    /// The largest coordinate on each axis.
    pub max: DVec3,
}

impl Bounds3 {
    /// Contains no point; the neutral element of [`Bounds3::union`].
    pub const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// The smallest box that contains the points; NaN coordinates are skipped.
    #[must_use]
    pub fn from_points(points: impl IntoIterator<Item = DVec3>) -> Self {
        let mut bounds = Self::EMPTY;
        for point in points {
            bounds.include(point);
        }
        bounds
    }

    /// Extends the box to contain a point; NaN coordinates are skipped.
    pub fn include(&mut self, point: DVec3) {
        self.min = select(point.cmplt(self.min), point, self.min);
        self.max = select(point.cmpgt(self.max), point, self.max);
    }

    /// The smallest box that contains both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self {
            min: select(other.min.cmplt(self.min), other.min, self.min),
            max: select(other.max.cmpgt(self.max), other.max, self.max),
        }
    }

    /// Whether it contains no point. A box of zero size still contains a point.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.min.cmpgt(self.max).any()
    }

    /// Whether a point is inside or on the boundary, exactly.
    #[must_use]
    pub fn contains(&self, point: DVec3) -> bool {
        self.min.cmple(point).all() && point.cmple(self.max).all()
    }

    /// The centre; `None` for an empty box.
    #[must_use]
    pub fn center(&self) -> Option<DVec3> {
        // Halved before the sum, which therefore cannot overflow.
        (!self.is_empty()).then(|| self.min * 0.5 + self.max * 0.5)
    }

    /// The extent on each axis; zero for an empty box.
    #[must_use]
    pub fn size(&self) -> DVec3 {
        if self.is_empty() { DVec3::ZERO } else { self.max - self.min }
    }

    /// The eight corners; bit 0 of the index selects `max.x`, bit 1 `max.y`,
    /// bit 2 `max.z`.
    #[must_use]
    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|index| {
            let pick = |axis: usize| {
                let side = if index >> axis & 1 == 1 { self.max } else { self.min };
                side[axis]
            };
            DVec3::new(pick(0), pick(1), pick(2))
        })
    }

    /// The box around the transformed box; an empty one stays empty.
    ///
    /// It contains `transform.transform_point3(p)` for every finite `p` inside, rounding included. Each
    /// coordinate of the image is a sum of products, so its rounded value is monotone in each coordinate of
    /// `p` and extreme at a corner.
    #[must_use]
    pub fn transformed(&self, transform: &DAffine3) -> Self {
        if self.is_empty() {
            return Self::EMPTY;
        }
        Self::from_points(self.corners().map(|corner| transform.transform_point3(corner)))
    }
}

/// Per axis `a` where the mask is set, otherwise `b`. Comparisons instead of `min` and `max`, whose
/// results for NaN and ±0 differ between machines.
fn select(mask: glam::BVec3, a: DVec3, b: DVec3) -> DVec3 {
    DVec3::select(mask, a, b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;
    use proptest::prelude::*;

    fn vector(range: std::ops::Range<f64>) -> impl Strategy<Value = DVec3> {
        [range.clone(), range.clone(), range].prop_map(DVec3::from_array)
    }

    #[test]
    fn an_empty_box_stays_empty() {
        assert!(Bounds3::EMPTY.is_empty(), "no point inside");
        assert_eq!(Bounds3::EMPTY.center(), None, "no middle");
        assert_eq!(Bounds3::EMPTY.size(), DVec3::ZERO, "no extent");
        let moved = Bounds3::EMPTY.transformed(&DAffine3::from_translation(DVec3::X));
        assert_eq!(moved, Bounds3::EMPTY, "moved");
        assert_eq!(Bounds3::EMPTY.union(Bounds3::EMPTY), Bounds3::EMPTY, "united");
    }

    #[test]
    fn one_point_is_a_box_of_no_size() {
        let bounds = Bounds3::from_points([DVec3::ONE]);
        assert!(!bounds.is_empty(), "it holds its point");
        assert_eq!(bounds.size(), DVec3::ZERO, "and nothing else");
        assert_eq!(bounds.center(), Some(DVec3::ONE), "in the middle");
    }

    #[test]
    fn a_coordinate_that_is_no_number_is_skipped() {
        let bounds = Bounds3::from_points([DVec3::new(f64::NAN, 1.0, 2.0), DVec3::new(3.0, f64::NAN, 1.0)]);
        assert_eq!(bounds.min, DVec3::new(3.0, 1.0, 1.0), "least");
        assert_eq!(bounds.max, DVec3::new(3.0, 1.0, 2.0), "greatest");
    }

    #[test]
    fn the_middle_of_huge_boxes_is_finite() {
        let bounds = Bounds3 { min: DVec3::splat(f64::MAX / 2.0), max: DVec3::splat(f64::MAX) };
        assert!(bounds.center().unwrap().is_finite(), "no overflow");
    }

    #[test]
    fn corners_follow_their_bits() {
        let bounds = Bounds3::from_points([DVec3::ZERO, DVec3::new(1.0, 2.0, 4.0)]);
        for (index, corner) in bounds.corners().into_iter().enumerate() {
            assert_eq!(corner.element_sum(), index as f64, "corner {index}");
        }
    }

    proptest! {
        #[test]
        fn a_transformed_box_holds_every_transformed_point(
            a in vector(-1e6..1e6), b in vector(-1e6..1e6), weights in vector(0.0..1.0),
            scale in vector(-3.0..3.0), axis in vector(-1.0..1.0), angle in -4.0..4.0_f64,
            translation in vector(-1e9..1e9),
        ) {
            let Some(axis) = axis.try_normalize() else { return Ok(()) };
            let rotation = DQuat::from_axis_angle(axis, angle);
            let transform = DAffine3::from_scale_rotation_translation(scale, rotation, translation);
            let bounds = Bounds3::from_points([a, b]);
            // Clamped by comparisons: rounding could leave the box.
            let point = (bounds.min + weights * bounds.size()).clamp(bounds.min, bounds.max);
            let image = bounds.transformed(&transform);
            prop_assert!(image.contains(transform.transform_point3(point)));
        }

        #[test]
        fn a_union_holds_both(points in prop::collection::vec(vector(-9.0..9.0), 1..9), cut in 0..9_usize) {
            let cut = cut.min(points.len());
            let (first, second) = points.split_at(cut);
            let whole = Bounds3::from_points(points.iter().copied());
            let parts = Bounds3::from_points(first.iter().copied())
                .union(Bounds3::from_points(second.iter().copied()));
            prop_assert_eq!(parts, whole);
            prop_assert!(points.iter().all(|&p| whole.contains(p)));
        }
    }
}

//! Regions of an image, and which points and pixels lie in them.

use std::ops::Range;

use trigon_camera::Viewport;
use trigon_math::DVec2;

use super::lasso::Lasso;

/// A part of an image, in pixels: the origin is the upper left corner, y points down, and pixel (i,
/// j) has its centre at (i + 0.5, j + 0.5). Parts beyond the image's borders are ignored. A region
/// with a coordinate that is not finite is empty.
#[derive(Clone, Debug, PartialEq)]
pub enum Region {
    /// The pixel that contains this point.
    Point(DVec2),
    /// The points with `min ≤ point < max` in both coordinates, so that neighbouring
    /// rectangles share none.
    Rectangle {
        /// The left and upper border.
        min: DVec2,
        /// The right and lower border.
        max: DVec2,
    },
    /// The points within a distance, in `f64`.
    Circle {
        /// The middle.
        center: DVec2,
        /// Pixels. A negative one contains nothing.
        radius: f64,
    },
    /// The points inside a polygon by the even-odd rule. Its last corner is joined to its first,
    /// and its sides may cross. The side of a point relative to an edge is decided exactly; of
    /// points on an edge, one side of it counts as inside, so that neighbouring polygons share
    /// none.
    Lasso(Vec<DVec2>),
}

/// A region prepared for an image.
pub(super) struct Area<'r> {
    shape: AreaShape<'r>,
    /// The pixels around it, all of them in the image.
    pub(super) columns: Range<u32>,
    /// As the columns.
    pub(super) rows: Range<u32>,
}

enum AreaShape<'r> {
    Rectangle { min: DVec2, max: DVec2 },
    Circle { center: DVec2, radius_squared: f64 },
    Lasso(Lasso<'r>),
}

impl<'r> Area<'r> {
    pub(super) fn new(region: &'r Region, viewport: Viewport) -> Self {
        let (min, max) = bounds(region);
        let is_usable = min.is_finite() && max.is_finite();
        let pixels = |min: f64, max: f64, size: u32| {
            // The casts saturate: beyond the image all is one.
            let end = if is_usable { (max.floor() as u32).saturating_add(1).min(size) } else { 0 };
            if max < 0.0 { 0..0 } else { (min.floor() as u32).min(end)..end }
        };
        let columns = pixels(min.x, max.x, viewport.width);
        let rows = pixels(min.y, max.y, viewport.height);
        let shape = match region {
            Region::Point(_) => AreaShape::Rectangle { min, max: min + DVec2::ONE },
            &Region::Rectangle { min, max } => AreaShape::Rectangle { min, max },
            &Region::Circle { center, radius } => {
                AreaShape::Circle { center, radius_squared: radius * radius }
            }
            Region::Lasso(corners) => {
                AreaShape::Lasso(Lasso::new(if is_usable { corners } else { &[] }, &rows))
            }
        };
        Self { shape, columns, rows }
    }

    /// Whether no pixel of the image is near it.
    pub(super) fn is_empty(&self) -> bool {
        self.columns.is_empty() || self.rows.is_empty()
    }

    /// Whether a point of the image lies in the region. One that is no number does not.
    pub(super) fn contains(&self, point: DVec2) -> bool {
        let within = |at: f64, pixels: &Range<u32>| at >= pixels.start.into() && at < pixels.end.into();
        within(point.x, &self.columns) && within(point.y, &self.rows) && self.shape.contains(point)
    }

    /// The pixels of a row whose centres lie in the region, from left to right.
    pub(super) fn runs(&self, row: u32) -> Vec<Range<u32>> {
        if let AreaShape::Lasso(lasso) = &self.shape {
            return lasso.runs(row, &self.columns);
        }
        // The others are convex.
        let mut inside = self.columns.clone().filter(|&column| self.contains(center(column, row)));
        let Some(first) = inside.next() else { return Vec::new() };
        let last = self.columns.clone().rev().find(|&column| self.contains(center(column, row)));
        std::iter::once(first..last.unwrap_or(first) + 1).collect()
    }
}

impl AreaShape<'_> {
    fn contains(&self, point: DVec2) -> bool {
        match self {
            Self::Rectangle { min, max } => point.cmpge(*min).all() && point.cmplt(*max).all(),
            Self::Circle { center, radius_squared } => point.distance_squared(*center) <= *radius_squared,
            Self::Lasso(lasso) => lasso.contains(point),
        }
    }
}

/// A box around a region; not finite where that is empty.
fn bounds(region: &Region) -> (DVec2, DVec2) {
    match region {
        Region::Point(point) => (point.floor(), point.floor()),
        &Region::Rectangle { min, max } => (min, max),
        &Region::Circle { center, radius } if radius >= 0.0 => (center - radius, center + radius),
        Region::Circle { .. } => (DVec2::NAN, DVec2::NAN),
        Region::Lasso(corners) if corners.iter().all(|corner| corner.is_finite()) => {
            corners.iter().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(min, max), &corner| {
                (min.min(corner), max.max(corner))
            })
        }
        Region::Lasso(_) => (DVec2::NAN, DVec2::NAN),
    }
}

/// The centre of a pixel.
pub(super) fn center(column: u32, row: u32) -> DVec2 {
    DVec2::new(f64::from(column) + 0.5, f64::from(row) + 0.5)
}

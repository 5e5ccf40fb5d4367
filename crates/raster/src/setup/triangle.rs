//! The record of a triangle that is ready for its tiles.

use trigon_math::{FixedPoint, orientation_fixed};

/// A vertex on the sub-sample grid.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ScreenVertex {
    pub(crate) point: FixedPoint,
    /// Reversed depth.
    pub(crate) depth: f32,
    /// 1/w, > 0.
    pub(crate) inverse_w: f32,
}

/// What a triangle is part of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Triangle,
    Line,
    SquarePoint,
    /// Half of the square around a disc.
    RoundPoint,
}

/// How the vertices of a set-up triangle come from the corners of the
/// primitive that was recorded.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Corners {
    /// Vertex `i` is corner `[i]`.
    Whole([u8; 3]),
    /// Cut: the weights of the corners are in the frame's table at this index.
    Cut {
        /// Index into the table.
        weights: u32,
        /// The corner that column `i` of the weights is for.
        order: [u8; 3],
    },
}

/// A triangle with an area and, perhaps, samples inside; 64 bytes.
///
/// Its vertices are sorted by (y, x), so that nothing that is computed from
/// them depends on the order in which the corners were given.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SetupTriangle {
    pub(crate) vertices: [ScreenVertex; 3],
    /// Index of the draw in the pass.
    pub(crate) draw: u32,
    /// Index of the triangle, segment or point in the draw.
    pub(crate) primitive: u32,
    pub(crate) corners: Corners,
    pub(crate) kind: Kind,
    pub(crate) front_facing: bool,
}

/// A rectangle of samples, ends included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SampleBounds {
    pub(crate) x: [i32; 2],
    pub(crate) y: [i32; 2],
}

#[cfg(test)]
impl SetupTriangle {
    /// For tests: a front-facing triangle at points in 1/256 sample.
    pub(crate) fn on_grid(points: [[i32; 2]; 3]) -> Self {
        use trigon_math::{Fixed, FixedPoint};
        let vertex = |[x, y]: [i32; 2]| ScreenVertex {
            point: FixedPoint::new(Fixed::from_raw(x), Fixed::from_raw(y)),
            depth: 0.5,
            inverse_w: 1.0,
        };
        Self {
            vertices: points.map(vertex),
            draw: 0,
            primitive: 0,
            corners: Corners::Whole([0, 1, 2]),
            kind: Kind::Triangle,
            front_facing: true,
        }
    }
}

impl SetupTriangle {
    /// Twice the area in units of the grid, signed: positive if the sorted
    /// vertices run clockwise on the screen.
    #[inline]
    pub(crate) fn doubled_area(&self) -> i64 {
        let [a, b, c] = &self.vertices;
        orientation_fixed(a.point, b.point, c.point)
    }

    /// The samples within the triangle's bounding box; `None` if there are
    /// none on the whole plane.
    #[inline]
    pub(crate) fn sample_bounds(&self) -> Option<SampleBounds> {
        let [a, b, c] = self.vertices.map(|v| [v.point.x.raw(), v.point.y.raw()]);
        let axis = |i: usize| samples_between(a[i].min(b[i]).min(c[i]), a[i].max(b[i]).max(c[i]));
        Some(SampleBounds { x: axis(0)?, y: axis(1)? })
    }
}

/// The first and the last sample whose centre lies within `low..=high` in units
/// of the grid.
#[inline]
fn samples_between(low: i32, high: i32) -> Option<[i32; 2]> {
    let first = (low + 127) >> 8;
    let last = (high - 128) >> 8;
    (first <= last).then_some([first, last])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_sit_at_half() {
        assert_eq!(samples_between(0, 256), Some([0, 0]), "one pixel holds one centre");
        assert_eq!(samples_between(128, 128), Some([0, 0]), "a centre itself");
        assert_eq!(samples_between(129, 383), None, "between two centres");
        assert_eq!(samples_between(-128, 384), Some([-1, 1]), "both ends count");
    }

    #[test]
    fn the_record_stays_small() {
        assert!(size_of::<SetupTriangle>() <= 72, "{} bytes", size_of::<SetupTriangle>());
    }
}

//! The record of a line or a point for the tiles: a quadrilateral of two triangles.
//!
//! One record and one entry in each tile represent both triangles. A triangle is built from the record when a caller
//! needs it.
//!
//! [`Stroke`] says how much of a pixel an anti-aliased line or point covers. A line is the set of points within half its width of its segment. It is round at both ends, so joined segments
//! form one shape without gaps. Its coverage of a pixel follows from the distance `d` of the sample from the segment, as
//! the overlap of pixel and line on an axis across the line: `min(w, 1, w/2 + 1/2 - d)`, not below 0, with w the width,
//! all in pixels. For a line along an axis this is the exact area. Summed across the line it is w, also for widths
//! below 1. (K. Turkowski, "Anti-Aliasing through the Use of Coordinate Transformations", 1982, with a box in place of
//! his filter; S. Gupta and R. Sproull, "Filtering Edges for Gray-Scale Displays", 1981, for coverage from distance.)
//!
//! A round point is a line without length; below one pixel its coverage falls with the square of its size. For a square
//! point the exact area is used: the product of the overlaps on both axes.

use super::triangle::{Corners, CutWeights, Kind, SetupTriangle, sorted};
use crate::simd::{InlineMap, LANES, Simd, inlined, lanes_of, prelude::*};
use crate::tile_buffer::lane_point;
use crate::vertex::ScreenVertex;
use fearless_simd::f64x8;

/// A quadrilateral around a segment or a point.
///
/// If its outline is sharp, the two sides across it are parallel to an axis. Its corners wind the
/// same way whatever its triangles, which share the diagonal from the first corner of the
/// first end to the second of the other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quad {
    /// x and y in 1/256 pixel, the two corners of each end: `[[a, b], [d, c]]`. Once around, their
    /// order is a, b, c, d, so that a and d lie on one side of the segment, b and c on the other.
    pub(crate) corners: [[[i32; 2]; 2]; 2],
    /// Reversed depths of the ends.
    pub(crate) depths: [f32; 2],
    pub(crate) inverse_w: [f32; 2],
    /// The primitive's ordinal in the frame.
    pub(crate) ordinal: u32,
    /// What few have, by its index among the chunk's details.
    pub(crate) detail: Option<DetailIndex>,
    pub(crate) kind: Kind,
    pub(crate) ends: Ends,
}

/// Which vertices of the primitive the ends of a [`Quad`] belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ends {
    /// Those of a segment, in their order.
    InOrder,
    /// Those of a segment, the second first.
    Swapped,
    /// Both the only one of a point.
    Point,
}

/// What only cut and anti-aliased lines and points have.
#[derive(Clone, Copy, Debug)]
pub(crate) struct QuadDetail {
    /// For each end the weights of the segment's vertices, that of the first end first.
    pub(crate) weights: [[f32; 3]; 2],
    /// What an anti-aliased one covers.
    pub(crate) stroke: Option<Stroke>,
}

impl QuadDetail {
    /// The weights of an uncut segment.
    pub(crate) const WHOLE: [[f32; 3]; 2] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
}

/// An index among a chunk's [`QuadDetail`]s, one more than it is: so that no index takes no
/// memory.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DetailIndex(std::num::NonZeroU32);

impl DetailIndex {
    /// An index that fits 32 bits.
    pub(crate) fn new(index: usize) -> Option<Self> {
        u32::try_from(index + 1).ok().and_then(std::num::NonZeroU32::new).map(Self)
    }

    /// The index.
    pub(crate) fn get(self) -> usize {
        self.0.get() as usize - 1
    }
}

/// The corners of both triangles, each by its end and its side.
const HALVES: [[[usize; 2]; 3]; 2] = [[[0, 0], [0, 1], [1, 1]], [[0, 0], [1, 1], [1, 0]]];

impl Quad {
    /// One of its two triangles.
    pub(crate) fn half(&self, half: usize) -> SetupTriangle {
        let (vertices, order) = self.sorted(half);
        let corners = match self.ends {
            Ends::InOrder => Corners::Ends([0, 1, 1]),
            Ends::Swapped => Corners::Ends([1, 0, 0]),
            Ends::Point => Corners::Whole([0; 3]),
        };
        SetupTriangle {
            vertices: order.map(|i| vertices[i]),
            ordinal: self.ordinal,
            corners,
            kind: self.kind,
            front_facing: true,
        }
    }

    /// The weights of the segment's vertices at the vertices of one of its triangles, from
    /// those at its ends; `None` for a point.
    pub(crate) fn weights(&self, half: usize, ends: [[f32; 3]; 2]) -> Option<CutWeights> {
        let (_, order) = self.sorted(half);
        (self.ends != Ends::Point).then(|| order.map(|i| ends[HALVES[half][i][0]]))
    }

    /// The vertices of one of its triangles and their order.
    #[inline(always)]
    pub(crate) fn sorted(&self, half: usize) -> ([ScreenVertex; 3], [usize; 3]) {
        let vertices = HALVES[half].each(
            #[inline(always)]
            |[end, side]| {
                let [x, y] = self.corners[end][side];
                ScreenVertex([x, y, self.depths[end].to_bits() as i32, self.inverse_w[end].to_bits() as i32])
            },
        );
        (vertices, sorted(vertices))
    }

    /// The least and the greatest coordinate of an axis in 1/256 pixel.
    #[inline(always)]
    pub(crate) fn extent(&self, axis: usize) -> [i32; 2] {
        let [[a, b], [c, d]] = self.corners;
        let [a, b, c, d] = [a[axis], b[axis], c[axis], d[axis]];
        [a.min(b).min(c.min(d)), a.max(b).max(c.max(d))]
    }

    /// The greatest depth.
    #[inline(always)]
    pub(crate) fn nearest(&self) -> f32 {
        let [a, b] = self.depths;
        if b > a { b } else { a }
    }
}

/// What shape a stroke has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    Line,
    Round,
    Square,
}

/// The exact position of an anti-aliased line or point on the grid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stroke {
    /// Its first end in 1/256 pixel.
    start: [i32; 2],
    /// The unit vector to the other end; along x where there is none.
    direction: [f64; 2],
    /// In pixels.
    length: f64,
    width: f64,
    form: Form,
}

impl Stroke {
    /// A line between two ends in 1/256 pixel, of a width in pixels.
    pub(crate) fn line([start, end]: [[i32; 2]; 2], width: f64) -> Self {
        let [x, y] = [0, 1].map(|axis| f64::from(end[axis] - start[axis]));
        let length = (x * x + y * y).sqrt();
        let direction = if length > 0.0 { [x / length, y / length] } else { [1.0, 0.0] };
        Self { start, direction, length: length / 256.0, width, form: Form::Line }
    }

    /// A point of a size in pixels.
    pub(crate) fn point(center: [i32; 2], width: f64, form: Form) -> Self {
        Self { form, ..Self::line([center; 2], width) }
    }

    /// How far it reaches from its segment, in 1/256 pixel.
    pub(crate) fn reach(width: f64) -> f64 {
        (width + 1.0) * 128.0
    }

    /// The unit vector along it.
    pub(crate) fn direction(&self) -> [f64; 2] {
        self.direction
    }

    /// What shape it has.
    pub(crate) fn form(&self) -> Form {
        self.form
    }

    /// What it covers of the pixels around eight samples, the first of which is
    /// given: [`Self::coverage_at`] of each.
    #[inline(always)]
    pub(crate) fn coverage<S: Simd>(&self, simd: S, first: [i32; 2]) -> [f32; LANES] {
        let splat = inlined(
            #[inline(always)]
            |value: f64| f64x8::splat(simd, value),
        );
        let position = inlined(
            #[inline(always)]
            |axis: usize| {
                let positions: [f64; LANES] = lanes_of(
                    #[inline(always)]
                    |lane| f64::from(lane_point(first, lane)[axis] - self.start[axis]),
                );
                f64x8::simd_from(simd, positions) * splat(1.0 / 256.0)
            },
        );
        let (x, y) = (position(0), position(1));
        let overlaps = match self.form {
            Form::Square => self.overlaps(simd, x.abs()) * self.overlaps(simd, y.abs()),
            Form::Line => self.overlaps(simd, self.distances(simd, [x, y])),
            Form::Round => self.overlaps(simd, self.distances(simd, [x, y])) * splat(self.most()),
        };
        let overlaps: [f64; LANES] = overlaps.into();
        lanes_of(
            #[inline(always)]
            |lane| overlaps[lane] as f32,
        )
    }

    /// [`Self::distance`] of eight points.
    #[inline(always)]
    fn distances<S: Simd>(&self, simd: S, [x, y]: [f64x8<S>; 2]) -> f64x8<S> {
        let [dx, dy] = self.direction;
        let (along, across) = (x * dx + y * dy, x * dy - y * dx);
        let (none, length) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, self.length));
        let (is_before, is_past) = (along.simd_lt(none), along.simd_gt(length));
        let beyond = is_before.select(along, along - length);
        let around_end = (beyond * beyond + across * across).sqrt();
        (is_before | is_past).select(around_end, across.abs())
    }

    /// [`Self::overlap`] at eight distances.
    #[inline(always)]
    fn overlaps<S: Simd>(&self, simd: S, distance: f64x8<S>) -> f64x8<S> {
        let (none, most) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, self.most()));
        let overlap = f64x8::splat(simd, 0.5 * (self.width + 1.0)) - distance;
        let overlap = overlap.simd_gt(most).select(most, overlap);
        overlap.simd_lt(none).select(none, overlap)
    }

    /// What it covers of the pixel around a sample, 0 to 1.
    #[inline(always)]
    pub(crate) fn coverage_at(&self, point: [i32; 2]) -> f64 {
        let [x, y] = [0, 1].map(|axis| f64::from(point[axis] - self.start[axis]) / 256.0);
        match self.form {
            Form::Square => self.overlap(x.abs()) * self.overlap(y.abs()),
            Form::Line => self.overlap(self.distance([x, y])),
            Form::Round => self.overlap(self.distance([x, y])) * self.most(),
        }
    }

    /// The distance of a point, relative to the first end, from the segment.
    #[inline(always)]
    fn distance(&self, [x, y]: [f64; 2]) -> f64 {
        let [dx, dy] = self.direction;
        let (along, across) = (x * dx + y * dy, x * dy - y * dx);
        let beyond = if along < 0.0 {
            along
        } else if along > self.length {
            along - self.length
        } else {
            return across.abs();
        };
        (beyond * beyond + across * across).sqrt()
    }

    /// The greatest overlap: no more than a pixel.
    #[inline(always)]
    fn most(&self) -> f64 {
        if self.width < 1.0 { self.width } else { 1.0 }
    }

    /// How long a part of a pixel at this distance lies within the width.
    #[inline(always)]
    fn overlap(&self, distance: f64) -> f64 {
        let most = self.most();
        let overlap = 0.5 * (self.width + 1.0) - distance;
        if overlap < 0.0 {
            0.0
        } else if overlap > most {
            most
        } else {
            overlap
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use trigon_math::at_level;
    use trigon_math::simd::Token;

    /// What a wireframe of 1.5 million edges takes is a multiple of it.
    #[test]
    fn a_record_fits_a_line_of_the_cache() {
        assert!(size_of::<Quad>() <= 64, "{} bytes", size_of::<Quad>());
    }

    proptest! {
        #[test]
        fn eight_are_covered_like_each(
            ends in prop::array::uniform2(prop::array::uniform2(-3000..3000_i32)),
            first in prop::array::uniform2(-20..20_i32),
            width in prop_oneof![0.0_f64..9.0, Just(1.0)],
            form in prop_oneof![Just(Form::Line), Just(Form::Round), Just(Form::Square)],
        ) {
            let stroke = match form {
                Form::Line => Stroke::line(ends, width),
                Form::Round | Form::Square => Stroke::point(ends[0], width, form),
            };
            let first = first.map(|at| at * 128);
            let eight = at_level!(Token::best(), simd => stroke.coverage(simd, first));
            let each = lanes_of(|lane| stroke.coverage_at(lane_point(first, lane)) as f32);
            prop_assert_eq!(eight.map(f32::to_bits), each.map(f32::to_bits));
        }

        /// Along an axis the line is the exact area, so pixels across it add up to
        /// its width wherever it lies.
        #[test]
        fn across_an_axis_the_width_is_kept(offset in 0..256_i32, width in 0.0_f64..9.0) {
            let stroke = Stroke::line([[0, offset], [100_000, offset]], width);
            let sum: f64 = (-8..9).map(|row| stroke.coverage_at([50_000, row * 256])).sum();
            prop_assert!((sum - width).abs() < 1e-12, "{sum} instead of {width}");
        }

        #[test]
        fn a_square_point_has_its_area(offset in [0..256_i32, 0..256_i32], width in 0.0_f64..9.0) {
            let stroke = Stroke::point(offset, width, Form::Square);
            let rows = |x: i32| (-8..9).map(move |y| stroke.coverage_at([x * 256, y * 256]));
            let sum: f64 = (-8..9).flat_map(rows).sum();
            prop_assert!((sum - width * width).abs() < 1e-11, "{sum} instead of the square of {width}");
        }
    }

    #[test]
    fn ends_are_round_and_points_fade() {
        let line = Stroke::line([[0, 0], [2560, 0]], 2.0);
        for (point, expected) in [([1280, 0], 1.0), ([1280, 256], 0.5), ([2816, 0], 0.5), ([2560, 512], 0.0)]
        {
            assert_eq!(line.coverage_at(point), expected, "at {point:?}");
        }
        let dot = Stroke::point([0, 0], 0.5, Form::Round);
        assert_eq!(dot.coverage_at([0, 0]), 0.25, "the square of its size");
    }
}

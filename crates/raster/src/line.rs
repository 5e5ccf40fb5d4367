//! Lines: a segment becomes a parallelogram of two triangles, in one record. The same exact rule as for triangles
//! decides which samples it covers.
//!
//! The parallelogram spans the width across the minor direction and ends with cuts along it. So a line one pixel
//! wide has one pixel in each step of its major direction, as in Direct3D and OpenGL.
//!
//! An anti-aliased line is a rectangle around all pixels that it covers in part. How much it covers of each is
//! computed sample by sample (see [`Stroke`](crate::primitive::Stroke)).

use crate::Smoothing;
use crate::primitive::{Ends, Kind, Quad, QuadDetail, Stroke};
use crate::setup::Setup;
use crate::vertex::{ScreenVertex, nearer};
use trigon_math::{ClipVertex, Fixed, clip_segment};

/// The widest line and largest point in pixels.
pub(crate) const SIZE_MAX: f32 = 4096.0;

/// A width or size that can be drawn: within 1 and [`SIZE_MAX`] pixels.
pub(crate) fn drawable_size(size: f32) -> f32 {
    if size > SIZE_MAX {
        SIZE_MAX
    } else if size > 1.0 {
        size
    } else {
        1.0
    }
}

/// An anti-aliased width or size: within 0 and [`SIZE_MAX`] pixels, and 1 for what
/// is no number.
pub(crate) fn smooth_size(size: f32) -> f32 {
    if size >= 1.0 || size.is_nan() {
        drawable_size(size)
    } else if size > 0.0 {
        size
    } else {
        0.0
    }
}

/// How far a line or point extends from its middle along an axis of its own, in units of the grid: half its
/// size, or, if anti-aliased, as far as it covers any part of a pixel; and one unit more, so that snapping
/// cuts nothing off.
pub(crate) fn half_size(size: f32, smoothing: Smoothing, supersampling: u32) -> f64 {
    match smoothing {
        Smoothing::Sharp => f64::from(drawable_size(size)) * f64::from(supersampling) * 128.0,
        Smoothing::AntiAliased => {
            Stroke::reach(f64::from(smooth_size(size)) * f64::from(supersampling)) + 1.0
        }
    }
}

/// How a draw's segments look.
#[derive(Clone, Copy)]
pub(crate) struct LineStyle {
    /// The width in pixels of the grid, if it is anti-aliased.
    smooth: Option<f64>,
    /// See [`half_size`].
    half_width: f64,
    /// Whether each step of the major direction gets exactly one pixel.
    single: bool,
    depth_bias: f32,
}

impl LineStyle {
    pub(crate) fn new(
        width: f32,
        smoothing: Smoothing,
        depth_bias: f32,
        supersampling: u32,
        multisampled: bool,
    ) -> Self {
        let smooth = f64::from(smooth_size(width)) * f64::from(supersampling);
        let smooth = (smoothing == Smoothing::AntiAliased).then_some(smooth);
        let half_width = half_size(width, smoothing, supersampling);
        let single = drawable_size(width) == 1.0 && supersampling == 1 && !multisampled;
        Self { smooth, half_width, single, depth_bias }
    }
}

impl Setup<'_> {
    /// One segment of a draw of lines.
    pub(crate) fn segment(&mut self, primitive: u32, indices: [u32; 2], style: LineStyle) {
        let [a, b] = indices.map(|index| self.vertices.outcode(index));
        let planes = a.union(b);
        if planes.is_invalid() {
            self.chunk.stats.invalid += 1;
        } else if a.intersection(b).hides_wide() {
            self.chunk.stats.outside += 1;
        } else if planes.cuts() {
            self.chunk.stats.clipped += 1;
            let positions = indices.map(|index| self.vertices.position(index));
            let ends = clip_segment(positions, &self.volume);
            let screen =
                |end: ClipVertex<2>| Some((ScreenVertex::of(end.position, self.grid.viewport)?, end.weights));
            match ends.map(|[a, b]| (screen(a), screen(b))) {
                Some((Some(a), Some(b))) => self.parallelogram(primitive, by_index(indices, [a, b]), style),
                _ => self.chunk.stats.outside += 1,
            }
        } else {
            let [a, b] = indices.map(|index| *self.vertices.get(index));
            let ends = [(a, [1.0, 0.0]), (b, [0.0, 1.0])];
            self.parallelogram(primitive, by_index(indices, ends), style);
        }
    }

    /// What lies around a segment.
    fn parallelogram(&mut self, primitive: u32, mut ends: [(ScreenVertex, [f32; 2]); 2], style: LineStyle) {
        // From the upper end to the lower, and from the smaller index where both
        // lie on one point: then nothing below depends on which end was given first.
        let key = |(end, _): &(ScreenVertex, [f32; 2])| {
            let [x, y] = end.raw();
            (y, x)
        };
        if key(&ends[1]) < key(&ends[0]) {
            ends.swap(0, 1);
        }
        // Columns of the weights in the order of the ends, too.
        let swapped = ends[0].1[0] < ends[1].1[0];
        let weights = ends.map(|(_, [a, b])| if swapped { [b, a, 0.0] } else { [a, b, 0.0] });
        let points = ends.map(|(end, _)| end.raw());
        let stroke = style.smooth.map(|width| Stroke::line(points, width));
        let corners = match &stroke {
            Some(stroke) => rectangle(points, stroke, style.half_width),
            None => outline(points, style),
        };
        let Some(corners) = corners else {
            self.chunk.stats.outside += 1;
            return;
        };
        let is_plain = stroke.is_none() && weights == QuadDetail::WHOLE;
        let detail = if is_plain { None } else { self.chunk.keep(QuadDetail { weights, stroke }) };
        self.push_quad(Quad {
            corners,
            depths: ends.map(|(end, _)| nearer(end.depth(), style.depth_bias)),
            inverse_w: ends.map(|(end, _)| end.inverse_w()),
            ordinal: self.first + primitive,
            detail,
            kind: if stroke.is_some() { Kind::Stroke } else { Kind::Line },
            ends: if swapped { Ends::Swapped } else { Ends::InOrder },
        });
    }
}

/// The ends of a segment in the order of their vertices' indices.
fn by_index<T>(indices: [u32; 2], [a, b]: [T; 2]) -> [T; 2] {
    if indices[0] > indices[1] { [b, a] } else { [a, b] }
}

/// The two corners of each end of a segment, in the order of [`Quad::corners`].
type SegmentCorners = [[[i32; 2]; 2]; 2];

/// The corners of the parallelogram around a segment, across the minor direction. `None` if one
/// does not fit the grid.
fn outline([from, to]: [[i32; 2]; 2], style: LineStyle) -> Option<SegmentCorners> {
    let span = [to[0] - from[0], to[1] - from[1]].map(f64::from);
    let major = if span[0].abs() >= span[1].abs() { 0 } else { 1 };
    let minor = 1 - major;
    let degenerate = span == [0.0; 2];
    let slope = if degenerate { 0.0 } else { span[minor] / span[major] };
    // How far the cut ends lie from the middle, and how far the segment is
    // prolonged, so that its corners meet those of a segment at a right angle.
    let across = if style.single || degenerate {
        style.half_width
    } else {
        let length = (span[0] * span[0] + span[1] * span[1]).sqrt();
        style.half_width * length / span[major].abs()
    };
    let along = if span[major] < 0.0 { -style.half_width } else { style.half_width };
    let corners = |end: [i32; 2], along: f64| {
        let position = on_grid(f64::from(end[major]) + along)?;
        let middle = f64::from(end[minor]) + along * slope;
        let sides = [on_grid(middle - across)?, on_grid(middle + across)?];
        Some(sides.map(|side| if major == 0 { [position, side] } else { [side, position] }))
    };
    Some([corners(from, -along)?, corners(to, along)?])
}

/// The corners of the rectangle around an anti-aliased segment.
fn rectangle(ends: [[i32; 2]; 2], stroke: &Stroke, reach: f64) -> Option<SegmentCorners> {
    let [dx, dy] = stroke.direction().map(|v| v * reach);
    let corner = |[x, y]: [i32; 2], along: f64, across: f64| {
        let x = f64::from(x) + along * dx - across * dy;
        let y = f64::from(y) + along * dy + across * dx;
        Some([on_grid(x)?, on_grid(y)?])
    };
    let [from, to] = ends;
    Some([
        [corner(from, -1.0, -1.0)?, corner(from, -1.0, 1.0)?],
        [corner(to, 1.0, -1.0)?, corner(to, 1.0, 1.0)?],
    ])
}

/// A coordinate in 1/256 pixel, rounded as [`Fixed::from_f64`](trigon_math::Fixed::from_f64) does,
/// without the call that this takes where processors of all kinds are served.
#[inline(always)]
fn on_grid(raw: f64) -> Option<i32> {
    // Adding it rounds to whole numbers, ties to even, and leaves them in the low bits.
    const ROUND: f64 = 1.5 * (1_u64 << 52) as f64;
    // And a half, which is rounded down to it.
    const LIMIT: f64 = ((Fixed::LIMIT as i64) << Fixed::FRACTION_BITS) as f64 + 0.5;
    (raw.abs() <= LIMIT).then(|| (raw + ROUND).to_bits() as i32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn places_on_the_grid_are_those_of_fixed(raw in -2e9_f64..2e9, halves in any::<i32>(), far: f64) {
            for raw in [raw, f64::from(halves) / 2.0, far] {
                let fixed = Fixed::from_f64(raw / 256.0).map(Fixed::raw);
                prop_assert_eq!(on_grid(raw), fixed, "{}", raw);
            }
        }
    }
}

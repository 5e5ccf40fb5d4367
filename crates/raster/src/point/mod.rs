//! Points are squares. For a disc, tiles also compare the distance from the centre; for an anti-aliased point, they
//! compute its coverage (see [`Stroke`](crate::primitive::Stroke)). Most points are drawn from their vertices
//! ([`PlainPoints`]); each of the others gets a record.

mod plain;

pub(crate) use plain::{PlainPoints, sampled_pixels};

use crate::line::{half_size, smooth_size};
use crate::primitive::{DetailIndex, Ends, Form, Kind, Quad, QuadDetail, Stroke};
use crate::setup::Setup;
use crate::vertex::{ScreenVertex, nearer};
use crate::{PointShape, Smoothing};

/// How a draw's points look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PointStyle {
    /// Half the size, in units of the grid.
    half: i32,
    kind: Kind,
    /// The size in pixels of the grid, if it is anti-aliased.
    smooth: Option<f64>,
    depth_bias: f32,
}

impl PointStyle {
    pub(crate) fn new(
        size: f32,
        smoothing: Smoothing,
        shape: PointShape,
        depth_bias: f32,
        supersampling: u32,
    ) -> Self {
        let smooth = f64::from(smooth_size(size)) * f64::from(supersampling);
        let smooth = (smoothing == Smoothing::AntiAliased).then_some(smooth);
        let half = half_size(size, smoothing, supersampling);
        let kind = match shape {
            PointShape::Round => Kind::RoundPoint,
            PointShape::Square => Kind::SquarePoint,
        };
        Self { half: half.round() as i32, kind, smooth, depth_bias }
    }

    /// The square around a point.
    fn square(&self, ordinal: u32, center: ScreenVertex, detail: Option<DetailIndex>) -> Quad {
        let ([column, row], half) = (center.raw(), self.half);
        // Within the guard band and the largest size, nothing leaves the grid.
        let corner = |x: i32, y: i32| [column + x * half, row + y * half];
        Quad {
            corners: [[corner(-1, -1), corner(1, -1)], [corner(-1, 1), corner(1, 1)]],
            depths: [nearer(center.depth(), self.depth_bias); 2],
            inverse_w: [center.inverse_w(); 2],
            ordinal,
            detail,
            kind: if self.smooth.is_some() { Kind::Stroke } else { self.kind },
            ends: Ends::Point,
        }
    }
}

impl Setup<'_> {
    /// One point of a draw of points.
    pub(crate) fn point(&mut self, primitive: u32, index: u32, style: PointStyle) {
        let outcode = self.vertices.outcode(index);
        if outcode.is_invalid() {
            self.chunk.stats.invalid += 1;
        } else if outcode.cuts() || outcode.hides_wide() {
            self.chunk.stats.outside += 1;
        } else {
            self.square(primitive, *self.vertices.get(index), style);
        }
    }

    fn square(&mut self, primitive: u32, center: ScreenVertex, style: PointStyle) {
        let detail = style.smooth.and_then(|size| {
            let form = if style.kind == Kind::RoundPoint { Form::Round } else { Form::Square };
            let stroke = Some(Stroke::point(center.raw(), size, form));
            self.chunk.keep(QuadDetail { weights: QuadDetail::WHOLE, stroke })
        });
        self.push_quad(style.square(self.first + primitive, center, detail));
    }
}

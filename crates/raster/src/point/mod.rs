//! Points become squares of one record each; for a disc the tile looks at the
//! distance from the centre, and for anti-aliased ones at what they cover (see
//! [`Stroke`]).

use crate::line::{Form, Stroke, half_size, smooth_size};
use crate::setup::{Ends, Kind, Quad, QuadDetail, Setup};
use crate::vertex::{ScreenVertex, nearer};
use crate::{Outline, PointShape};

/// How a draw's points look.
#[derive(Clone, Copy)]
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
        (size, outline): (f32, Outline),
        shape: PointShape,
        depth_bias: f32,
        supersampling: u32,
    ) -> Self {
        let smooth = f64::from(smooth_size(size)) * f64::from(supersampling);
        let smooth = (outline == Outline::AntiAliased).then_some(smooth);
        let half = half_size((size, outline), supersampling);
        let kind = match shape {
            PointShape::Round => Kind::RoundPoint,
            PointShape::Square => Kind::SquarePoint,
        };
        Self { half: half.round() as i32, kind, smooth, depth_bias }
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

    fn square(&mut self, primitive: u32, centre: ScreenVertex, style: PointStyle) {
        let [column, row] = centre.raw();
        let PointStyle { half, .. } = style;
        // Within the guard band and the largest size, nothing leaves the grid.
        let corner = |x: i32, y: i32| [column + x * half, row + y * half];
        let detail = style.smooth.and_then(|size| {
            let form = if style.kind == Kind::RoundPoint { Form::Round } else { Form::Square };
            let stroke = Some(Stroke::point([column, row], size, form));
            self.chunk.keep(QuadDetail { weights: QuadDetail::WHOLE, stroke })
        });
        self.push_quad(Quad {
            corners: [[corner(-1, -1), corner(1, -1)], [corner(-1, 1), corner(1, 1)]],
            depths: [nearer(centre.depth(), style.depth_bias); 2],
            inverse_w: [centre.inverse_w(); 2],
            ordinal: self.first + primitive,
            detail,
            kind: if style.smooth.is_some() { Kind::Stroke } else { style.kind },
            ends: Ends::Point,
        });
    }
}

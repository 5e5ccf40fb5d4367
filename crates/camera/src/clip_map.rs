//! The common form of every projection: six numbers and a kind. Matrices, projecting, unprojecting
//! and fitting all use it, so they always agree.

use trigon_math::{DMat4, DVec2, DVec3, DVec4};

/// How the distance from the eye enters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Divide by the distance: `w = -z`.
    Perspective,
    /// No division: `w = 1`.
    Parallel,
}

/// Camera space to clip space. With `d = -z` the distance along the line of sight:
///
/// | | perspective | parallel |
/// |---|---|---|
/// | x, y in device coordinates | `scale · xy / d − shift` | `scale · xy − shift` |
/// | depth | `depth_offset / d − depth_scale` | `depth_offset − depth_scale · d` |
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ClipMap {
    pub(crate) kind: Kind,
    pub(crate) scale: DVec2,
    pub(crate) shift: DVec2,
    pub(crate) depth_scale: f64,
    pub(crate) depth_offset: f64,
}

impl ClipMap {
    /// A perspective with reversed depth: 1 at `near`, 0 at `far`. The ratio
    /// form neither overflows for a far plane at 1e300 nor needs a special
    /// case for one at infinity.
    pub(crate) fn perspective(scale: DVec2, shift: DVec2, near: f64, far: Option<f64>) -> Self {
        let ratio = far.map_or(0.0, |far| near / far);
        let span = 1.0 - ratio;
        Self { kind: Kind::Perspective, scale, shift, depth_scale: ratio / span, depth_offset: near / span }
    }

    /// A parallel projection with reversed depth.
    pub(crate) fn parallel(scale: DVec2, near: f64, far: f64) -> Self {
        let span = far - near;
        Self {
            kind: Kind::Parallel,
            scale,
            shift: DVec2::ZERO,
            depth_scale: 1.0 / span,
            depth_offset: far / span,
        }
    }

    /// As a matrix for column vectors.
    pub(crate) fn matrix(&self) -> DMat4 {
        let Self { scale, shift, depth_scale, depth_offset, .. } = *self;
        let x = DVec4::new(scale.x, 0.0, 0.0, 0.0);
        let y = DVec4::new(0.0, scale.y, 0.0, 0.0);
        match self.kind {
            Kind::Perspective => DMat4::from_cols(
                x,
                y,
                DVec4::new(shift.x, shift.y, depth_scale, -1.0),
                DVec4::new(0.0, 0.0, depth_offset, 0.0),
            ),
            Kind::Parallel => DMat4::from_cols(
                x,
                y,
                DVec4::new(0.0, 0.0, depth_scale, 0.0),
                DVec4::new(-shift.x, -shift.y, depth_offset, 1.0),
            ),
        }
    }

    /// Device coordinates of a point in camera space; `None` at or behind the
    /// eye, and where the result would not be finite.
    pub(crate) fn project(&self, point: DVec3) -> Option<DVec2> {
        let xy = point.truncate();
        let ndc = match self.kind {
            Kind::Perspective if -point.z > 0.0 => self.scale * xy / -point.z - self.shift,
            Kind::Perspective => return None,
            Kind::Parallel => self.scale * xy - self.shift,
        };
        ndc.is_finite().then_some(ndc)
    }

    /// Depth of a point in camera space; `None` at or behind the eye, and
    /// where the result would not be finite.
    pub(crate) fn depth(&self, point: DVec3) -> Option<f64> {
        let distance = -point.z;
        let depth = match self.kind {
            Kind::Perspective if distance > 0.0 => self.depth_offset / distance - self.depth_scale,
            Kind::Perspective => return None,
            Kind::Parallel => self.depth_offset - self.depth_scale * distance,
        };
        depth.is_finite().then_some(depth)
    }

    /// Distance along the line of sight at which the depth is `depth`; `None`
    /// at and beyond infinity.
    pub(crate) fn distance(&self, depth: f64) -> Option<f64> {
        let distance = match self.kind {
            Kind::Perspective => self.depth_offset / (depth + self.depth_scale),
            Kind::Parallel => (self.depth_offset - depth) / self.depth_scale,
        };
        let good = distance.is_finite() && (distance > 0.0 || self.kind == Kind::Parallel);
        good.then_some(distance)
    }

    /// The point in camera space at this distance that is drawn at `ndc`.
    pub(crate) fn at_distance(&self, ndc: DVec2, distance: f64) -> DVec3 {
        let xy = (ndc + self.shift) / self.scale;
        match self.kind {
            Kind::Perspective => (xy * distance).extend(-distance),
            Kind::Parallel => xy.extend(-distance),
        }
    }
}

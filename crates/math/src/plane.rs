//! A plane in space.

use glam::DVec3;

/// An oriented plane: the points `p` with `normal · p + offset = 0`. The
/// normal has unit length, so distances are in the unit of the points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    normal: DVec3,
    offset: f64,
}

impl Plane {
    /// The plane through a point. The normal need not have unit length.
    ///
    /// `None` if the normal is zero or anything is not finite.
    #[must_use]
    pub fn from_point_and_normal(point: DVec3, normal: DVec3) -> Option<Self> {
        let normal = normal.try_normalize()?;
        Self { normal, offset: -normal.dot(point) }.checked()
    }

    /// The plane through three points in counter-clockwise order, seen from the side to which the
    /// normal points.
    ///
    /// `None` if they lie on a line (as far as `f64` can tell) or anything is
    /// not finite.
    #[must_use]
    pub fn through(a: DVec3, b: DVec3, c: DVec3) -> Option<Self> {
        Self::from_point_and_normal(a, (b - a).cross(c - a))
    }

    /// The plane where `coefficients · p + constant = 0`, scaled so that the
    /// normal has unit length.
    ///
    /// `None` if the coefficients are zero (a plane at infinity) or anything is
    /// not finite.
    #[must_use]
    pub fn from_equation(coefficients: DVec3, constant: f64) -> Option<Self> {
        let normal = coefficients.try_normalize()?;
        Self { normal, offset: constant / coefficients.length() }.checked()
    }

    /// The unit normal.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// The distance of the origin: positive on the normal's side.
    #[must_use]
    pub fn offset(&self) -> f64 {
        self.offset
    }

    /// The distance of a point, positive on the normal's side, rounded.
    #[must_use]
    pub fn signed_distance(&self, point: DVec3) -> f64 {
        self.normal.dot(point) + self.offset
    }

    fn checked(self) -> Option<Self> {
        (self.normal.is_finite() && self.offset.is_finite()).then_some(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_normal_points_to_where_the_points_run_counter_clockwise() {
        let plane =
            Plane::through(DVec3::new(0.0, 0.0, 2.0), DVec3::new(3.0, 0.0, 2.0), DVec3::new(0.0, 5.0, 2.0))
                .unwrap();
        assert_eq!(plane.normal(), DVec3::Z, "counter-clockwise seen from +z");
        assert_eq!(plane.offset(), -2.0, "the origin is behind");
        assert_eq!(plane.signed_distance(DVec3::new(7.0, 8.0, 5.0)), 3.0, "in front");
    }

    #[test]
    fn an_equation_is_scaled_to_distances() {
        let plane = Plane::from_equation(DVec3::new(0.0, -4.0, 0.0), 8.0).unwrap();
        assert_eq!(plane.signed_distance(DVec3::ZERO), 2.0, "two below y = 2");
        assert_eq!(plane.signed_distance(DVec3::Y * 2.0), 0.0, "on the plane");
    }

    #[test]
    fn what_is_no_plane_is_none() {
        assert_eq!(Plane::through(DVec3::ZERO, DVec3::X, DVec3::X * 2.0), None, "a line");
        assert_eq!(Plane::from_equation(DVec3::ZERO, 1.0), None, "at infinity");
        assert_eq!(Plane::from_point_and_normal(DVec3::NAN, DVec3::X), None, "not finite");
        assert_eq!(Plane::from_equation(DVec3::X, f64::INFINITY), None, "not finite");
    }
}

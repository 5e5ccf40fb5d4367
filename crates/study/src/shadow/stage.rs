//! A ball of one metre's radius above a floor of four by four metres.

use trigon_math::DVec3;

/// Towards the light; of length 1.
pub(super) const LIGHT: DVec3 = DVec3::new(2.0 / 7.0, 6.0 / 7.0, 3.0 / 7.0);

/// The middle of the ball.
pub(super) const BALL: DVec3 = DVec3::new(0.4, 1.2, 0.6);

/// Two directions across the light.
pub(super) fn across() -> [DVec3; 2] {
    let one = LIGHT.cross(DVec3::X).normalize();
    [one, LIGHT.cross(one)]
}

/// The place on the floor, in metres from its middle, of a pixel's centre.
pub(super) fn point(place: [usize; 2], side: usize) -> [f64; 2] {
    place.map(|part| ((part as f64 + 0.5) / side as f64 - 0.5) * 4.0)
}

/// In space.
pub(super) fn on_floor([x, z]: [f64; 2]) -> DVec3 {
    DVec3::new(x, 0.0, z)
}

/// Whether the ray to the light passes the ball: its middle is then as near to the ray as
/// the radius.
pub(super) fn exact(point: [f64; 2]) -> f64 {
    let to_ball = BALL - on_floor(point);
    let beside = to_ball - LIGHT * to_ball.dot(LIGHT);
    f64::from(u8::from(beside.length_squared() >= 1.0))
}

//! How far from the origin may a model be? Positions and camera in `f32` in world space,
//! against positions relative to the camera, subtracted in `f64` before they are rounded.

#[cfg(test)]
mod tests;

use crate::random::Random;
use trigon_math::{DMat3, DVec3, Mat4, elementary};

/// A way to hold places.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Coordinates {
    /// Places and the camera's matrix in `f32`, in world space.
    World,
    /// The camera is subtracted in `f64`, the rest is `f32`.
    CameraRelative,
}

/// Pixels for a metre at one metre's distance: a picture 1,000 pixels wide, 53 degrees
/// wide.
const SCALE: f64 = 1000.0;

impl Coordinates {
    /// Both.
    pub const ALL: [Self; 2] = [Self::World, Self::CameraRelative];

    /// The name in tables and plots.
    pub fn name(self) -> &'static str {
        match self {
            Self::World => "world space, f32",
            Self::CameraRelative => "relative to the camera",
        }
    }

    /// How far a point is from where it should be on the picture, in pixels: the most of
    /// 1,000 points about three metres before a camera that stands `offset` metres from
    /// the origin, a whole number, on each axis.
    pub fn worst_error(self, offset: f64) -> f64 {
        let mut random = Random::new(11);
        let base = DVec3::splat(offset);
        let errors = (0..1000).map(|_| {
            // On a grid that any of the offsets leaves exact in f64.
            let mut local = |low, high| (random.between(low, high) * 1024.0).round() / 1024.0;
            let point = DVec3::new(local(-1.0, 1.0), local(-1.0, 1.0), local(-4.0, -3.0));
            let eye = DVec3::new(local(-0.1, 0.1), local(-0.1, 0.1), local(-0.1, 0.1));
            let [x, y] = self.place(base + point, base + eye);
            let right = on_picture(turn() * (point - eye));
            elementary::hypot(x - right[0], y - right[1])
        });
        errors.fold(0.0, f64::max)
    }

    /// Where a point is on the picture.
    fn place(self, point: DVec3, eye: DVec3) -> [f64; 2] {
        let turn = turn();
        let seen = match self {
            Self::World => {
                let eye = eye.as_vec3();
                let view = Mat4::from_mat3(turn.as_mat3()) * Mat4::from_translation(-eye);
                view.transform_point3(point.as_vec3())
            }
            Self::CameraRelative => turn.as_mat3() * (point - eye).as_vec3(),
        };
        on_picture(seen.as_dvec3())
    }
}

/// The camera looks a little aside, so that matrices are no simple ones.
fn turn() -> DMat3 {
    DMat3::from_cols(DVec3::new(0.96, 0.0, 0.28), DVec3::Y, DVec3::new(-0.28, 0.0, 0.96))
}

/// In pixels from the middle.
fn on_picture(seen: DVec3) -> [f64; 2] {
    [seen.x / -seen.z, seen.y / -seen.z].map(|part| part * SCALE)
}

//! How far from the origin may a model be? Positions and camera in `f32` in world space, compared with
//! positions relative to the camera that are subtracted in `f64` before rounding.

#[cfg(test)]
mod tests;

use std::hint::black_box;
use trigon_math::{DMat3, DMat4, DVec3, Mat4, SplitMix64, Vec3, elementary};

/// How positions are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Coordinates {
    /// Positions and the camera's matrix in `f32`, in world space.
    World,
    /// The camera is subtracted in `f64`, the rest is `f32`.
    CameraRelative,
}

/// Pixels per metre at a distance of one metre: an image 1,000 pixels wide, 53 degrees wide.
const SCALE: f64 = 1000.0;

impl Coordinates {
    /// Both.
    pub const ALL: [Self; 2] = [Self::World, Self::CameraRelative];

    /// The name in tables and plots.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::World => "world space, f32",
            Self::CameraRelative => "relative to the camera",
        }
    }

    /// The largest error of a point's position on the image, in pixels, among 1,000 points about three metres
    /// in front of a camera that stands `offset` metres from the origin along each axis. `offset` is an
    /// integer.
    pub fn worst_error(self, offset: f64) -> f64 {
        let view = View::new(self, offset);
        let seen = view.points.iter().map(|&point| view.matrix().transform_point3(point));
        let errors = seen.zip(&view.right).map(|(seen, right)| {
            let [x, y] = on_image(seen.as_dvec3());
            elementary::hypot(x - right[0], y - right[1])
        });
        errors.fold(0.0, f64::max)
    }

    /// Returns a closure that computes the matrix of the points' node and transforms all points, repeatedly.
    #[must_use]
    pub fn repeated(self, offset: f64) -> Box<dyn FnMut()> {
        let view = View::new(self, offset);
        let mut seen = vec![Vec3::ZERO; POINTS];
        Box::new(move || {
            let matrix = black_box(&view).matrix();
            for (seen, &point) in seen.iter_mut().zip(&view.points) {
                *seen = matrix.transform_point3(point);
            }
            black_box(&seen);
        })
    }
}

/// The number of points.
pub const POINTS: usize = 1000;

/// Points in front of a camera, as they are stored.
struct View {
    way: Coordinates,
    /// In world space, or relative to their node.
    points: Vec<Vec3>,
    node: DVec3,
    eye: DVec3,
    /// The exact positions of the points on the image.
    right: Vec<[f64; 2]>,
}

impl View {
    fn new(way: Coordinates, offset: f64) -> Self {
        let mut random = SplitMix64::new(11);
        // On a grid on which sums with any of the offsets are exact in f64.
        let mut local = |low, high| (random.between(low, high) * 1024.0).round() / 1024.0;
        let eye = DVec3::new(local(-0.1, 0.1), local(-0.1, 0.1), local(-0.1, 0.1));
        let points: Vec<DVec3> =
            (0..POINTS).map(|_| DVec3::new(local(-1.0, 1.0), local(-1.0, 1.0), local(-4.0, -3.0))).collect();
        let node = DVec3::splat(offset);
        let stored = |point: &DVec3| match way {
            Coordinates::World => (node + point).as_vec3(),
            Coordinates::CameraRelative => point.as_vec3(),
        };
        Self {
            way,
            points: points.iter().map(stored).collect(),
            node,
            eye: node + eye,
            right: points.iter().map(|point| on_image(turn() * (point - eye))).collect(),
        }
    }

    /// From stored points to camera space.
    fn matrix(&self) -> Mat4 {
        match self.way {
            Coordinates::World => {
                Mat4::from_mat3(turn().as_mat3()) * Mat4::from_translation(-self.eye.as_vec3())
            }
            Coordinates::CameraRelative => {
                (DMat4::from_mat3(turn()) * DMat4::from_translation(self.node - self.eye)).as_mat4()
            }
        }
    }
}

/// The camera looks slightly sideways, so that no matrix is trivial.
fn turn() -> DMat3 {
    DMat3::from_cols(DVec3::new(0.96, 0.0, 0.28), DVec3::Y, DVec3::new(-0.28, 0.0, 0.96))
}

/// In pixels from the centre.
fn on_image(seen: DVec3) -> [f64; 2] {
    [seen.x / -seen.z, seen.y / -seen.z].map(|part| part * SCALE)
}

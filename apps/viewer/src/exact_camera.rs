//! A camera as one word, exactly: every number is written so that it is read back with the same bits.

use std::fmt;
use std::str::FromStr;

use trigon_camera::{Camera, CameraError, PixelCenters, Projection, Viewport};
use trigon_math::{DQuat, DVec2, DVec3};

/// A camera, and how far away what it turns about is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ExactCamera {
    pub(crate) camera: Camera,
    pub(crate) distance: f64,
}

/// How it is written.
const FORM: &str =
    "write the word that Ctrl+C in the window copies: position/orientation/distance/projection";

impl fmt::Display for ExactCamera {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Camera { position, orientation, projection } = self.camera;
        let (kind, shape) = match projection {
            Projection::Perspective { vertical_fov, .. } => ("perspective", vec![vertical_fov]),
            Projection::Orthographic { height, .. } => ("orthographic", vec![height]),
            Projection::Frustum { left, right, bottom, top, .. } => {
                ("frustum", vec![left, right, bottom, top])
            }
            Projection::Pinhole { focal, center, size, .. } => {
                ("pinhole", vec![focal.x, focal.y, center.x, center.y, size.x, size.y])
            }
        };
        let planes = [projection.near(), projection.far().unwrap_or(f64::INFINITY)];
        let [position, orientation] = [&position.to_array()[..], &orientation.to_array()[..]].map(list);
        write!(f, "{position}/{orientation}/{}/{kind},{},{}", self.distance, list(&shape), list(&planes))
    }
}

fn list(numbers: &[f64]) -> String {
    numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(",")
}

impl FromStr for ExactCamera {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts: Vec<&str> = text.split('/').collect();
        let [position, orientation, distance, projection] = parts[..] else { return Err(FORM.to_owned()) };
        let (kind, shape) = projection.split_once(',').ok_or(FORM)?;
        let position = DVec3::from_array(numbers(position)?);
        let orientation = DQuat::from_array(numbers(orientation)?);
        let [distance] = numbers(distance)?;
        let is_somewhere = position.is_finite() && distance.is_finite() && distance > 0.0;
        if !(is_somewhere && orientation.is_normalized()) {
            return Err(format!("the camera is nowhere, or turned by no rotation; {FORM}"));
        }
        let projection = projection_of(kind, shape)?.map_err(|error| format!("{error}; {FORM}"))?;
        Ok(Self { camera: Camera { position, orientation, projection }, distance })
    }
}

fn projection_of(kind: &str, shape: &str) -> Result<Result<Projection, CameraError>, String> {
    let far = |far: f64| far.is_finite().then_some(far);
    Ok(match kind {
        "perspective" => {
            let [fov, near, last] = numbers(shape)?;
            Projection::perspective(fov, near, far(last))
        }
        "orthographic" => {
            let [height, near, last] = numbers(shape)?;
            Projection::orthographic(height, near, last)
        }
        "frustum" => {
            let [left, right, bottom, top, near, last] = numbers(shape)?;
            Projection::frustum(left, right, bottom, top, near, far(last))
        }
        "pinhole" => {
            let [fx, fy, cx, cy, width, height, near, last] = numbers(shape)?;
            // A size in pixels is a whole number; what is none becomes 0, which is refused.
            let image = Viewport { width: width as u32, height: height as u32 };
            let (focal, center) = (DVec2::new(fx, fy), DVec2::new(cx, cy));
            Projection::pinhole(focal, center, image, PixelCenters::AtHalves, near)
                .and_then(|pinhole| pinhole.with_planes(near, far(last)))
        }
        _ => return Err(FORM.to_owned()),
    })
}

fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let read: Option<Vec<f64>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    read.and_then(|read| read.try_into().ok()).ok_or_else(|| FORM.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cameras_keep_their_bits() {
        let projections = [
            Projection::perspective(30f64.to_radians(), 0.1, None),
            Projection::perspective(1.0 / 3.0, 1e-7, Some(1e9)),
            Projection::orthographic(0.1 + 0.2, -3.0, 7.0),
            Projection::frustum(-0.1, 0.3, -0.2, 0.2, 0.7, None),
        ];
        for projection in projections {
            let projection = projection.expect("in range");
            let camera = Camera::look_at(DVec3::new(1.0 / 3.0, -2e-9, 1e8), DVec3::ONE, DVec3::Y);
            let exact = ExactCamera { camera: camera.with_projection(projection), distance: 0.1 + 0.7 };
            assert_eq!(exact.to_string().parse(), Ok(exact), "{exact}");
        }
    }

    #[test]
    fn what_is_no_camera_is_refused() {
        for text in [
            "",
            "1,2,3",
            "1,2,3/0,0,0,1/5/perspective",
            "1,2,3/0,0,0,2/5/perspective,1,0.1,inf",
            "NaN,2,3/0,0,0,1/5/perspective,1,0.1,inf",
            "1,2,3/0,0,0,1/0/perspective,1,0.1,inf",
            "1,2,3/0,0,0,1/5/perspective,9,0.1,inf",
            "1,2,3/0,0,0,1/5/fisheye,1,0.1,inf",
        ] {
            assert!(text.parse::<ExactCamera>().is_err(), "{text:?}");
        }
    }
}

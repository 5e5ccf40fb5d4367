//! `transforms.json` of NeRF programs (instant-ngp, nerfstudio): poses from the camera to the world in OpenGL's
//! convention, and one lens for all frames or one for each.

use serde_json::Value;
use trigon_camera::{Camera, CameraAxes, FisheyeLens, PixelCenters, Projection, Viewport};
use trigon_math::{DVec2, elementary};

use super::entry::pixels;
use super::pose::affine;
use super::{CameraDraft, CameraView, UNPLACED_NEAR};
use crate::error::Location;

/// Reads the frames of a file. An error has the number of its frame.
pub(super) fn read(
    file: &Value,
    frames: &[Value],
    draft: &mut CameraDraft<'_>,
) -> Result<(), (usize, String)> {
    for (index, frame) in frames.iter().enumerate() {
        let lens = Lens { frame, file };
        let view = lens.view(draft.image).map_err(|what| (index, what))?;
        if view.lens.is_none() && lens.is_distorted() {
            draft.warnings.push(
                Location::Item("frame", index),
                "lens distortion (k1, k2, p1, p2 …) is not drawn",
                "undistort the photographs (colmap image_undistorter), or expect their edges to differ",
            );
        }
        draft.views.push(view);
    }
    Ok(())
}

/// A frame and its lens: what it does not say itself, the file says for all.
struct Lens<'a> {
    frame: &'a Value,
    file: &'a Value,
}

impl Lens<'_> {
    fn number(&self, name: &str) -> Result<Option<f64>, String> {
        let value = self.frame.get(name).or_else(|| self.file.get(name));
        let Some(value) = value else { return Ok(None) };
        let number = value.as_f64().filter(|number| number.is_finite());
        number.map(Some).ok_or_else(|| format!("its `{name}` is {value}, not a number"))
    }

    fn is_distorted(&self) -> bool {
        let names = ["k1", "k2", "k3", "k4", "p1", "p2"];
        names
            .into_iter()
            .any(|name| self.number(name).is_ok_and(|value| value.is_some_and(|value| value != 0.0)))
    }

    fn view(&self, usual: Viewport) -> Result<CameraView, String> {
        let model = self.frame.get("camera_model").or_else(|| self.file.get("camera_model"));
        let is_fisheye = match model.and_then(Value::as_str) {
            Some("OPENCV_FISHEYE") => true,
            Some(model) if !is_pinhole(model) => {
                return Err(format!(
                    "the lens \"{model}\" is not supported: pinhole cameras and OPENCV_FISHEYE are"
                ));
            }
            _ => false,
        };
        let matrix = self.frame.get("transform_matrix").ok_or("it has no `transform_matrix`")?;
        let pose = affine(matrix)?;
        let size = (pixels("w", self.number("w")?)?, pixels("h", self.number("h")?)?);
        let (image, has_own_size) = match size {
            (Some(width), Some(height)) => (Viewport { width, height }, true),
            _ => (usual, false),
        };
        let lens = if is_fisheye { Some(self.fisheye(image)?) } else { None };
        let projection = if is_fisheye { Projection::default() } else { self.projection(image)? };
        let name = self.frame.get("file_path").and_then(Value::as_str).unwrap_or_default().to_owned();
        let camera = Camera::from_pose(&pose, CameraAxes::OpenGl, projection);
        let camera = camera.map_err(|error| error.to_string())?;
        Ok(CameraView { name, camera, lens, image, has_own_size, has_clip_planes: false })
    }

    fn projection(&self, image: Viewport) -> Result<Projection, String> {
        let size = image.size();
        let of_angle =
            |angle: Option<f64>, pixels: f64| angle.map(|angle| 0.5 * pixels / elementary::tan(0.5 * angle));
        let (x, y) = (self.number("fl_x")?, self.number("fl_y")?);
        let x = x.or(of_angle(self.number("camera_angle_x")?, size.x));
        let y = y.or(of_angle(self.number("camera_angle_y")?, size.y));
        let focal = match (x, y) {
            (Some(x), Some(y)) => DVec2::new(x, y),
            (Some(one), None) | (None, Some(one)) => DVec2::splat(one),
            (None, None) => return Err("it needs `fl_x` or `camera_angle_x`".to_owned()),
        };
        Projection::pinhole(focal, self.center(image)?, image, PixelCenters::AtHalves, UNPLACED_NEAR)
            .map_err(|error| error.to_string())
    }

    fn center(&self, image: Viewport) -> Result<DVec2, String> {
        let middle = image.size() * 0.5;
        let center = |name, middle| self.number(name).map(|center| center.unwrap_or(middle));
        Ok(DVec2::new(center("cx", middle.x)?, center("cy", middle.y)?))
    }

    /// An angle says nothing of its focal lengths, because it does not tell where the lens ends.
    fn fisheye(&self, image: Viewport) -> Result<FisheyeLens, String> {
        let focal = match (self.number("fl_x")?, self.number("fl_y")?) {
            (Some(x), Some(y)) => DVec2::new(x, y),
            (Some(one), None) | (None, Some(one)) => DVec2::splat(one),
            (None, None) => return Err("its fisheye lens needs `fl_x`".to_owned()),
        };
        let mut distortion = [0.0; 4];
        for (slot, name) in distortion.iter_mut().zip(["k1", "k2", "k3", "k4"]) {
            *slot = self.number(name)?.unwrap_or(0.0);
        }
        FisheyeLens::new(focal, self.center(image)?, image, PixelCenters::AtHalves, distortion)
            .map_err(|error| error.to_string())
    }
}

/// Whether a camera model is a pinhole, but for its distortion.
fn is_pinhole(model: &str) -> bool {
    ["SIMPLE_PINHOLE", "PINHOLE", "SIMPLE_RADIAL", "RADIAL", "OPENCV"].contains(&model)
}

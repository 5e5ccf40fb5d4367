//! Trigon's own camera files, and what `--json` of the viewer writes.

use serde_json::Value;
use trigon_camera::{
    Camera, CameraAxes, CameraError, FisheyeLens, Intrinsics, PixelCenters, Projection, Viewport,
};
use trigon_math::{DQuat, DVec2, DVec3};

use super::pose::{affine, unit};
use super::{CameraDraft, CameraView, UNPLACED_NEAR};
use crate::error::Location;

/// The members of a camera; others are told of.
const MEMBERS: [&str; 20] = [
    "name",
    "width",
    "height",
    "convention",
    "pixel_centers",
    "pose",
    "world_to_camera",
    "position",
    "rotation",
    "K",
    "fisheye",
    "fov",
    "fov_radians",
    "vertical_fov",
    "vertical_fov_radians",
    "view_height",
    "frustum",
    "near",
    "far",
    "projection",
];

/// Those that say where a camera is, and those that say what its lens is. Members of one camera replace those that the
/// file has for all, whichever they are.
const POSES: [&str; 4] = ["pose", "world_to_camera", "position", "rotation"];
const LENSES: [&str; 5] = ["vertical_fov_radians", "vertical_fov", "view_height", "frustum", "K"];

/// Reads the cameras of a file. An error has the number of its camera.
pub(super) fn read(
    file: &Value,
    cameras: &[Value],
    draft: &mut CameraDraft<'_>,
) -> Result<(), (usize, String)> {
    for (index, camera) in cameras.iter().enumerate() {
        // What `--json` writes says much about an image besides its camera.
        let members = camera.as_object().filter(|members| !members.contains_key("camera"));
        let members = members.into_iter().flat_map(|members| members.keys());
        for member in members.filter(|member| !MEMBERS.contains(&member.as_str())) {
            let what = format!("the member `{member}` of a camera is unknown and ignored");
            draft.warnings.push(
                Location::Item("camera", index),
                what,
                "check its spelling (docs/cameras.md)",
            );
        }
        let entry = Entry { inner: camera.get("camera").unwrap_or(camera), outer: camera, file };
        let view = entry.view(draft.image).map_err(|what| (index, what))?;
        draft.views.push(view);
    }
    Ok(())
}

/// A camera of the file: what it does not say itself, the file says for all.
struct Entry<'a> {
    /// The object `camera`, if what `--json` wrote has one.
    inner: &'a Value,
    outer: &'a Value,
    file: &'a Value,
}

impl Entry<'_> {
    fn member(&self, name: &str) -> Option<&Value> {
        [self.inner, self.outer, self.file]
            .into_iter()
            .find_map(|object| object.get(name))
            .filter(|value| !value.is_null())
    }

    /// What the nearest object says that has one of these members: nothing of the others.
    fn nearest(&self, members: &[&str]) -> Self {
        let has_one = |object: &&Value| {
            members.iter().any(|member| object.get(member).is_some_and(|value| !value.is_null()))
        };
        let object = [self.inner, self.outer, self.file].into_iter().find(has_one).unwrap_or(self.inner);
        Self { inner: object, outer: object, file: object }
    }

    fn number(&self, name: &str) -> Result<Option<f64>, String> {
        let Some(value) = self.member(name) else { return Ok(None) };
        let number = value.as_f64().filter(|number| number.is_finite());
        number.map(Some).ok_or_else(|| format!("its `{name}` is {value}, not a number"))
    }

    fn numbers<const N: usize>(&self, name: &str) -> Result<Option<[f64; N]>, String> {
        let Some(value) = self.member(name) else { return Ok(None) };
        let numbers: Option<Vec<f64>> =
            value.as_array().and_then(|list| list.iter().map(Value::as_f64).collect());
        let numbers = numbers.and_then(|numbers| numbers.try_into().ok());
        numbers.map(Some).ok_or_else(|| format!("its `{name}` is not a list of {N} numbers"))
    }

    /// One of two words, the first by default.
    fn word(&self, name: &str, words: [&str; 2]) -> Result<bool, String> {
        match self.member(name).map(Value::as_str) {
            None => Ok(false),
            Some(Some(word)) if words.contains(&word) => Ok(word == words[1]),
            Some(_) => Err(format!("its `{name}` is neither \"{}\" nor \"{}\"", words[0], words[1])),
        }
    }

    fn view(&self, usual: Viewport) -> Result<CameraView, String> {
        if !self.outer.is_object() {
            return Err("it is no object".to_owned());
        }
        let size = (pixels("width", self.number("width")?)?, pixels("height", self.number("height")?)?);
        let (image, has_own_size) = match size {
            (Some(width), Some(height)) => (Viewport { width, height }, true),
            (None, None) => (usual, false),
            _ => return Err("it has one of `width` and `height`, but not both".to_owned()),
        };
        let axes = match self.word("convention", ["opengl", "opencv"])? {
            true => CameraAxes::OpenCv,
            false => CameraAxes::OpenGl,
        };
        let (near, far) = (self.number("near")?, self.number("far")?);
        let lens = self.fisheye(image, axes)?;
        let projection = match lens {
            Some(_) => Projection::default(),
            None => self.projection(image, axes)?,
        };
        let projection = match near {
            None => projection,
            Some(near) => projection.with_planes(near, far).map_err(|error| error.to_string())?,
        };
        let camera = self.camera(axes, projection)?;
        let name = self.outer.get("name").and_then(Value::as_str).unwrap_or_default().to_owned();
        Ok(CameraView { name, camera, lens, image, has_own_size, has_clip_planes: near.is_some() })
    }

    fn camera(&self, axes: CameraAxes, projection: Projection) -> Result<Camera, String> {
        let pose = self.nearest(&POSES);
        let (position, rotation) = (pose.numbers("position")?, pose.numbers("rotation")?);
        let camera = match (pose.member("pose"), pose.member("world_to_camera"), position, rotation) {
            (Some(pose), None, None, None) => Camera::from_pose(&affine(pose)?, axes, projection),
            (None, Some(pose), None, None) => Camera::from_extrinsics(&affine(pose)?, axes, projection),
            (None, None, Some(position), Some(rotation)) => {
                let (position, orientation) =
                    (DVec3::from_array(position), unit(DQuat::from_array(rotation))?);
                let orientation = match axes {
                    CameraAxes::OpenGl => orientation,
                    // Half a turn about X exchanges the conventions.
                    CameraAxes::OpenCv => orientation * DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0),
                };
                Ok(Camera { position, orientation, projection })
            }
            _ => {
                return Err(
                    "it needs one of `pose`, `world_to_camera`, or `position` with `rotation`".to_owned()
                );
            }
        };
        camera.map_err(|error| error.to_string())
    }

    /// The projection; with near and far planes of no meaning, but for a frustum.
    fn projection(&self, image: Viewport, axes: CameraAxes) -> Result<Projection, String> {
        let lens = self.nearest(&LENSES);
        let projection = match () {
            () if let Some(angle) = lens.number("vertical_fov_radians")? => {
                Projection::perspective(angle, UNPLACED_NEAR, None)
            }
            () if let Some(angle) = lens.number("vertical_fov")? => {
                Projection::perspective(angle.to_radians(), UNPLACED_NEAR, None)
            }
            () if let Some(height) = lens.number("view_height")? => {
                Projection::orthographic(height, -UNPLACED_NEAR, UNPLACED_NEAR)
            }
            () if let Some([left, right, bottom, top]) = lens.numbers("frustum")? => {
                // Its sides are those of the near plane.
                let near = self.number("near")?.ok_or("its `frustum` needs `near`")?;
                Projection::frustum(left, right, bottom, top, near, None)
            }
            () if let Some(matrix) = lens.member("K") => self.pinhole(matrix, image, axes)?,
            () => return Err("it needs one of `K`, `vertical_fov`, `view_height` or `frustum`".to_owned()),
        };
        projection.map_err(|error| error.to_string())
    }

    fn pinhole(
        &self,
        matrix: &Value,
        image: Viewport,
        axes: CameraAxes,
    ) -> Result<Result<Projection, CameraError>, String> {
        let Intrinsics { focal, center } = intrinsics(matrix)?;
        Ok(Projection::pinhole(focal, center, image, self.pixel_centers(axes)?, UNPLACED_NEAR))
    }

    /// The lens of a `K` with `fisheye`, the coefficients of its distortion.
    fn fisheye(&self, image: Viewport, axes: CameraAxes) -> Result<Option<FisheyeLens>, String> {
        let lens = self.nearest(&LENSES);
        let Some(distortion) = lens.numbers("fisheye")? else { return Ok(None) };
        let matrix = lens.member("K").ok_or("its `fisheye` needs `K`")?;
        let Intrinsics { focal, center } = intrinsics(matrix)?;
        let found = FisheyeLens::new(focal, center, image, self.pixel_centers(axes)?, distortion);
        let found = match (lens.number("fov_radians")?, lens.number("fov")?) {
            (None, None) => found,
            (Some(fov), _) => found.and_then(|found| found.with_fov(fov)),
            (None, Some(fov)) => found.and_then(|found| found.with_fov(fov.to_radians())),
        };
        found.map(Some).map_err(|error| error.to_string())
    }

    fn pixel_centers(&self, axes: CameraAxes) -> Result<PixelCenters, String> {
        let is_at_integers = match axes {
            CameraAxes::OpenGl => self.word("pixel_centers", ["halves", "integers"])?,
            CameraAxes::OpenCv => !self.word("pixel_centers", ["integers", "halves"])?,
        };
        Ok(if is_at_integers { PixelCenters::AtIntegers } else { PixelCenters::AtHalves })
    }
}

/// A matrix K by rows.
fn intrinsics(matrix: &Value) -> Result<Intrinsics, String> {
    let rows: Option<Vec<Vec<f64>>> = matrix.as_array().and_then(|rows| {
        rows.iter().map(|row| row.as_array()?.iter().map(Value::as_f64).collect()).collect()
    });
    let rows = rows.unwrap_or_default();
    let [[fx, skew, cx], [zero, fy, cy], last] =
        square(&rows).ok_or("its `K` is not a matrix of 3 by 3 numbers")?;
    if [skew, zero] != [0.0; 2] || last != [0.0, 0.0, 1.0] {
        return Err("its `K` is not [fx 0 cx, 0 fy cy, 0 0 1]; skew is not supported".to_owned());
    }
    Ok(Intrinsics { focal: DVec2::new(fx, fy), center: DVec2::new(cx, cy) })
}

fn square(rows: &[Vec<f64>]) -> Option<[[f64; 3]; 3]> {
    let rows: Option<Vec<[f64; 3]>> = rows.iter().map(|row| row.as_slice().try_into().ok()).collect();
    rows?.try_into().ok()
}

/// A whole number of pixels.
pub(super) fn pixels(name: &str, size: Option<f64>) -> Result<Option<u32>, String> {
    let Some(size) = size else { return Ok(None) };
    let is_size = size.fract() == 0.0 && (1.0..=f64::from(u32::MAX)).contains(&size);
    if is_size {
        Ok(Some(size as u32))
    } else {
        Err(format!("its `{name}` is {size}, not a number of pixels"))
    }
}

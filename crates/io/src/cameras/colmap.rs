//! COLMAP's text model: `cameras.txt` has the lenses, `images.txt` the poses from the world to the camera, in OpenCV's
//! convention with the centre of the first pixel at (0.5, 0.5). <https://colmap.github.io/format.html>

use std::collections::HashMap;
use std::path::Path;

use trigon_camera::{Camera, CameraAxes, FisheyeLens, PixelCenters, Projection, Viewport};
use trigon_math::{DAffine3, DMat3, DQuat, DVec2, DVec3};

use super::entry::pixels;
use super::pose::unit;
use super::{CameraDraft, CameraView, UNPLACED_NEAR};
use crate::error::{LoadError, LoadErrorKind, Location};

/// A lens, and the image that it makes.
#[derive(Clone, Copy)]
struct ColmapLens {
    projection: Projection,
    fisheye: Option<FisheyeLens>,
    image: Viewport,
}

/// Reads the model in a folder.
pub(super) fn read(folder: &Path, draft: &mut CameraDraft<'_>) -> Result<(), LoadError> {
    let [cameras, images] = ["cameras.txt", "images.txt"].map(|name| folder.join(name));
    if !cameras.is_file() && folder.join("cameras.bin").is_file() {
        return Err(LoadError::new(
            LoadErrorKind::Unsupported,
            folder,
            "its COLMAP model is binary",
            "write it as text: colmap model_converter --input_path . --output_path . --output_type TXT",
        ));
    }
    let located = |path: &Path, line: usize, what: String| {
        let error = LoadError::malformed(path, what, "export the model again as text, or correct the line");
        LoadError { location: Location::Line(line as u64), ..error }
    };
    let mut lenses = HashMap::new();
    for (line, text) in lines(&draft.text(&cameras)?).filter(|(_, text)| !text.is_empty()) {
        let (id, lens, is_distorted) = lens(text).map_err(|what| located(&cameras, line, what))?;
        lenses.insert(id, lens);
        if is_distorted {
            let what = "lens distortion is not drawn";
            let remedy =
                "undistort the photographs (colmap image_undistorter), or expect their edges to differ";
            draft.warnings.push_about(&cameras, Location::Line(line as u64), what, remedy);
        }
    }
    // Each image has two lines: its pose, and its points, of which there may be none.
    let text = draft.text(&images)?;
    let mut lines = lines(&text);
    while let Some((line, text)) = lines.next() {
        if text.is_empty() {
            continue;
        }
        let view = view(text, &lenses).map_err(|what| located(&images, line, what))?;
        draft.views.push(view);
        lines.next();
    }
    Ok(())
}

/// The lines of a file that are no comments, numbered from 1.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let all = text.lines().map(str::trim).enumerate().map(|(index, line)| (index + 1, line));
    all.filter(|(_, line)| !line.starts_with('#'))
}

/// A line `CAMERA_ID MODEL WIDTH HEIGHT PARAMETERS…`, and whether the lens distorts.
fn lens(line: &str) -> Result<(u64, ColmapLens, bool), String> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let [id, model, width, height, parameters @ ..] = &words[..] else {
        return Err("a camera has an id, a model, a width, a height and parameters".to_owned());
    };
    let id = id.parse().map_err(|_| format!("\"{id}\" is no id of a camera"))?;
    let size = |name, word| pixels(name, Some(number(word)?)).map(Option::unwrap_or_default);
    let image = Viewport { width: size("width", width)?, height: size("height", height)? };
    let parameters: Vec<f64> = parameters.iter().map(|word| number(word)).collect::<Result<_, _>>()?;
    // How many focal lengths the model has, and how many parameters for distortion.
    let (focal_count, distortion_count) = match *model {
        "SIMPLE_PINHOLE" => (1, 0),
        "PINHOLE" => (2, 0),
        "SIMPLE_RADIAL" => (1, 1),
        "RADIAL" => (1, 2),
        "OPENCV" => (2, 4),
        "FULL_OPENCV" => (2, 8),
        "SIMPLE_RADIAL_FISHEYE" => (1, 1),
        "RADIAL_FISHEYE" => (1, 2),
        "OPENCV_FISHEYE" => (2, 4),
        other => {
            return Err(format!(
                "the lens \"{other}\" is not supported: pinhole cameras are, and the fisheye lenses OPENCV_FISHEYE, RADIAL_FISHEYE and SIMPLE_RADIAL_FISHEYE"
            ));
        }
    };
    if parameters.len() != focal_count + 2 + distortion_count {
        return Err(format!(
            "{model} has {} parameters, not {}",
            focal_count + 2 + distortion_count,
            parameters.len()
        ));
    }
    let (focal, rest) = parameters.split_at(focal_count);
    let (center, distortion) = rest.split_at(2);
    let focal = DVec2::new(focal[0], focal[focal_count - 1]);
    let center = DVec2::new(center[0], center[1]);
    if model.ends_with("FISHEYE") {
        // The models with fewer parameters are OPENCV_FISHEYE without its higher terms.
        let mut terms = [0.0; 4];
        terms[..distortion_count].copy_from_slice(distortion);
        let lens = FisheyeLens::new(focal, center, image, PixelCenters::AtHalves, terms);
        let fisheye = Some(lens.map_err(|error| error.to_string())?);
        return Ok((id, ColmapLens { projection: Projection::default(), fisheye, image }, false));
    }
    let projection = Projection::pinhole(focal, center, image, PixelCenters::AtHalves, UNPLACED_NEAR);
    let projection = projection.map_err(|error| error.to_string())?;
    let is_distorted = distortion.iter().any(|parameter| *parameter != 0.0);
    Ok((id, ColmapLens { projection, fisheye: None, image }, is_distorted))
}

/// A line `IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME`.
fn view(line: &str, lenses: &HashMap<u64, ColmapLens>) -> Result<CameraView, String> {
    // A name may contain spaces.
    let words: Vec<&str> = line.split_whitespace().collect();
    let [_, pose @ .., _, _] = words.get(..10).unwrap_or_default() else {
        return Err("an image has an id, four numbers of a quaternion, three of a translation, the id of a camera and a name".to_owned());
    };
    let mut numbers = [0.0; 7];
    for (slot, word) in numbers.iter_mut().zip(pose) {
        *slot = number(word)?;
    }
    let [w, x, y, z, translation @ ..] = numbers;
    let rotation = DMat3::from_quat(unit(DQuat::from_xyzw(x, y, z, w))?);
    let pose = DAffine3 { matrix3: rotation, translation: DVec3::from_array(translation) };
    let id = words[8];
    let lens = id.parse().ok().and_then(|id: u64| lenses.get(&id));
    let lens = lens.ok_or_else(|| format!("there is no camera \"{id}\" in cameras.txt"))?;
    let camera = Camera::from_extrinsics(&pose, CameraAxes::OpenCv, lens.projection);
    Ok(CameraView {
        name: words[9..].join(" "),
        camera: camera.map_err(|error| error.to_string())?,
        lens: lens.fisheye,
        image: lens.image,
        has_own_size: true,
        has_clip_planes: false,
    })
}

fn number(word: &str) -> Result<f64, String> {
    let number = word.parse().ok().filter(|number: &f64| number.is_finite());
    number.ok_or_else(|| format!("\"{word}\" is not a number"))
}

//! Camera files: the views of a data set. `entry` reads trigon's own JSON, `nerf` the `transforms.json` of NeRF
//! programs, `colmap` COLMAP's text model. `docs/cameras.md` describes each.

mod colmap;
mod entry;
mod nerf;
mod pose;
#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};

use serde_json::Value;
use trigon_camera::{Camera, FisheyeCamera, FisheyeLens, Viewport};

use crate::error::{LoadError, LoadErrorKind, Location};
use crate::folder::{Folder, to_the_end};
use crate::options::Limits;
use crate::rows::plain_text;
use crate::warning::{Warning, Warnings};

/// The most views of one file.
const MOST_VIEWS: usize = 1_000_000;

/// The near plane of a view until it is placed.
const UNPLACED_NEAR: f64 = 1.0;

/// A camera of a camera file, and the image that it takes.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraView {
    /// The name in the file, usually that of the photograph; empty if there is none.
    pub name: String,
    /// The camera. If there is a `lens`, only its pose means something.
    pub camera: Camera,
    /// A fisheye lens, in place of the camera's projection: see [`CameraView::fisheye`].
    pub lens: Option<FisheyeLens>,
    /// The size of the image: the file's, or the one that [`load_cameras`] was given.
    pub image: Viewport,
    /// Whether the size is the file's.
    pub has_own_size: bool,
    /// Whether the clip planes are the file's. If not, they mean nothing: place them by
    /// [`Camera::with_clip_planes`].
    pub has_clip_planes: bool,
}

impl CameraView {
    /// The fisheye camera that it is, if it has such a lens.
    #[must_use]
    pub fn fisheye(&self) -> Option<FisheyeCamera> {
        Some(FisheyeCamera::at(&self.camera, self.lens?))
    }
}

/// What is in a camera file.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct CameraFile {
    /// The views, in the order of the file; at least one.
    pub views: Vec<CameraView>,
    /// What was ignored, such as lens distortion.
    pub warnings: Vec<Warning>,
    /// Every file that was read.
    pub files: Vec<PathBuf>,
}

/// Reads the cameras of a file, or of a folder with a text model of COLMAP. Views whose image the file does not
/// measure are for an image of size `image`.
///
/// # Errors
/// The file cannot be read, is none of the three formats, has no view or more than a million, or has a view that
/// is no camera: a pose that is no rotation, a focal length that is not positive, a lens of an unknown model.
pub fn load_cameras(
    path: impl AsRef<Path>,
    image: Viewport,
    limits: &Limits,
) -> Result<CameraFile, LoadError> {
    let path = path.as_ref();
    let named_after_colmap =
        path.file_name().is_some_and(|name| name == "images.txt" || name == "cameras.txt");
    let folder = path.parent().filter(|_| named_after_colmap);
    let mut draft =
        CameraDraft { image, limits, warnings: Warnings::about(path), views: Vec::new(), files: Vec::new() };
    match folder.or(path.is_dir().then_some(path)) {
        Some(folder) => colmap::read(folder, &mut draft)?,
        None => json(path, &mut draft)?,
    }
    match draft.views.len() {
        0 => Err(LoadError::new(LoadErrorKind::Empty, path, "it has no camera", "add one")),
        count if count > MOST_VIEWS => {
            Err(LoadError::limit(path, format!("it has {count} cameras, more than {MOST_VIEWS}")))
        }
        _ => Ok(CameraFile { views: draft.views, warnings: draft.warnings.into_list(), files: draft.files }),
    }
}

/// What was read so far.
struct CameraDraft<'a> {
    /// The size of images that have none in the file.
    image: Viewport,
    limits: &'a Limits,
    warnings: Warnings,
    views: Vec<CameraView>,
    files: Vec<PathBuf>,
}

impl CameraDraft<'_> {
    /// The text of a file.
    fn text(&mut self, path: &Path) -> Result<String, LoadError> {
        let bytes = Folder::none(self.limits).read_model(path, &to_the_end)?;
        self.files.push(path.to_owned());
        Ok(String::from_utf8_lossy(&plain_text(&bytes)).into_owned())
    }
}

/// Reads a JSON file: `frames` are NeRF's, `cameras` or `views` ours.
fn json(path: &Path, draft: &mut CameraDraft<'_>) -> Result<(), LoadError> {
    const FORMS: &str = "write a list `cameras` (docs/cameras.md has the members), NeRF's `frames`, or name a folder with COLMAP's cameras.txt and images.txt";
    let text = draft.text(path)?;
    let file: Value = serde_json::from_str(&text)
        .map_err(|error| LoadError::malformed(path, format!("it is no JSON ({error})"), FORMS))?;
    let list = |name: &str| file.get(name).and_then(Value::as_array);
    let located = |kind: &'static str| {
        move |(index, what): (usize, String)| {
            let error = LoadError::malformed(path, what, "correct it; docs/cameras.md has the members");
            LoadError { location: Location::Item(kind, index), ..error }
        }
    };
    if let Some(frames) = list("frames") {
        return nerf::read(&file, frames, draft).map_err(located("frame"));
    }
    let cameras = list("cameras").or_else(|| list("views")).map(Vec::as_slice);
    // A line of --json describes one image.
    let single = file.get("camera").map(|_| std::slice::from_ref(&file));
    let Some(cameras) = cameras.or(single) else {
        return Err(LoadError::malformed(path, "it has no list of cameras", FORMS));
    };
    entry::read(&file, cameras, draft).map_err(located("camera"))
}

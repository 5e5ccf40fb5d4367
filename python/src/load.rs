//! Scenes and cameras from files.

use std::path::PathBuf;

use pyo3::prelude::*;
use trigon_camera::{UpAxis, Viewport};
use trigon_io::{CameraView, Limits, LoadOptions};

use crate::camera::PyCamera;
use crate::errors::{load_error, value_error, warn};
use crate::scene::PyScene;

/// Loads a model: OBJ, glTF, GLB, PLY, STL, OFF or 3MF.
///
/// What is missing or wrong in the file and could be left out is a `TrigonWarning`. `up` is the axis that points up,
/// such as "+Z", if it is not that of the format.
///
/// >>> import tempfile, pathlib, trigon3d
/// >>> path = pathlib.Path(tempfile.mkdtemp()) / "triangle.obj"
/// >>> _ = path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
/// >>> trigon3d.load(path).bounds
/// [(0.0, 0.0, 0.0), (1.0, 1.0, 0.0)]
#[pyfunction]
#[pyo3(signature = (path, *, up=None))]
pub(crate) fn load(py: Python<'_>, path: PathBuf, up: Option<&str>) -> PyResult<PyScene> {
    let up: Option<UpAxis> = up.map(str::parse).transpose().map_err(value_error)?;
    let loaded = py.detach(|| {
        let options = LoadOptions { up, ..LoadOptions::default() };
        trigon_io::load(path, &options)
    });
    let loaded = loaded.map_err(load_error)?;
    warn(py, &loaded.warnings)?;
    Ok(PyScene::new(loaded.scene))
}

/// The name of a view, its camera, and the width and height of its image.
type NamedView = (String, PyCamera, (u32, u32));

/// Reads a camera file: trigon's JSON, NeRF's transforms.json, or a folder with COLMAP's text model.
///
/// Returns a list of tuples (name, camera, (width, height)). Views whose image the file does not measure are for an
/// image of `width` × `height`.
#[pyfunction]
#[pyo3(signature = (path, width=640, height=480))]
pub(crate) fn load_cameras(
    py: Python<'_>,
    path: PathBuf,
    width: u32,
    height: u32,
) -> PyResult<Vec<NamedView>> {
    let file = trigon_io::load_cameras(path, Viewport { width, height }, &Limits::default());
    let file = file.map_err(load_error)?;
    warn(py, &file.warnings)?;
    let view = |view: CameraView| {
        let CameraView { camera, lens, has_clip_planes, .. } = view;
        let camera = PyCamera { camera, lens, has_clip_planes };
        (view.name, camera, (view.image.width, view.image.height))
    };
    Ok(file.views.into_iter().map(view).collect())
}

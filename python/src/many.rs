//! Many views of one scene: frame after frame, or arrays that are filled.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyIterator};
use trigon_scene::Frame;

use crate::camera::PyCamera;
use crate::errors::value_error;
use crate::frame::PyFrame;
use crate::options::Options;
use crate::scene::PyScene;
use crate::targets::{FrameSize, Targets};

/// A camera of a list, and the size of its image if the list says it.
struct View {
    camera: PyCamera,
    size: Option<[u32; 2]>,
}

impl View {
    /// A `Camera`, or a tuple of name, camera and size.
    fn new(item: &Bound<'_, PyAny>) -> PyResult<Self> {
        if let Ok(camera) = item.cast::<PyCamera>() {
            return Ok(Self { camera: camera.get().clone(), size: None });
        }
        let (_, camera, (width, height)): (Bound<'_, PyAny>, Bound<'_, PyCamera>, (u32, u32)) =
            item.extract().map_err(|_| {
                PyTypeError::new_err("cameras are Camera objects, or tuples (name, camera, (width, height))")
            })?;
        Ok(Self { camera: camera.get().clone(), size: Some([width, height]) })
    }
}

#[pymethods]
impl PyScene {
    /// Draws what each camera sees, with the named arguments of `render`.
    ///
    /// Cameras are `Camera` objects, or tuples (name, camera, (width, height)) as `load_cameras` returns them; with
    /// these, `width` and `height` may be left out.
    ///
    /// Without `out` this is an iterator: each frame is drawn when it is asked for. With `out`, a dict of NumPy arrays
    /// (cameras, height, width, …) by names of outputs, all frames are drawn into them, and `out` is returned. The
    /// arrays have the types of `Frame`'s, are contiguous and writable, and may be a `numpy.memmap`; others raise
    /// ValueError before anything is drawn. Threads and memory are kept from one frame to the next.
    ///
    /// >>> import numpy, trigon3d
    /// >>> scene = trigon3d.Scene()
    /// >>> _ = scene.add_mesh([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], [[0, 1, 2]])
    /// >>> frames = scene.render_many(scene.surround(3), 64, 48, outputs=("depth",))
    /// >>> [frame.depth.shape for frame in frames]
    /// [(48, 64), (48, 64), (48, 64)]
    /// >>> out = {"color": numpy.empty((3, 48, 64, 4), numpy.uint8), "object_ids": numpy.empty((3, 48, 64), numpy.int32)}
    /// >>> filled = scene.render_many(scene.surround(3), out=out)
    /// >>> filled is out, int(out["object_ids"].max())
    /// (True, 0)
    #[pyo3(signature = (cameras, width=None, height=None, *, out=None, **named))]
    fn render_many<'py>(
        slf: &Bound<'py, Self>,
        cameras: &Bound<'py, PyAny>,
        width: Option<u32>,
        height: Option<u32>,
        out: Option<&Bound<'py, PyDict>>,
        named: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = slf.py();
        let size = match (width, height) {
            (Some(width), Some(height)) => Some([width, height]),
            (None, None) => None,
            _ => return Err(value_error("width and height are given together, or neither")),
        };
        let Some(out) = out else {
            let [width, height] = size.unwrap_or([1, 1]);
            let options = Options::new(width, height, named)?;
            let (scene, cameras) = (slf.clone().unbind(), cameras.try_iter()?.unbind());
            return Ok(Bound::new(py, Frames { scene, cameras, size, options })?.into_any());
        };
        let targets = Targets::new(out)?;
        let FrameSize { frames, width, height } = targets.size;
        if size.is_some_and(|size| size != [width, height]) {
            return Err(value_error(format!("out has room for images of {width} × {height} pixels")));
        }
        let mut options = Options::new(width, height, named)?;
        if named.is_some_and(|named| named.contains("outputs").unwrap_or(true)) {
            return Err(value_error("out says which outputs are drawn; leave outputs away"));
        }
        options.ask_for(&targets.names())?;
        // Before the scene is held: cameras may come from code that changes it.
        let views = views(cameras, frames)?;
        slf.try_borrow()?.fill(py, &views, &options, &targets)?;
        Ok(out.clone().into_any())
    }
}

/// As many views as there is room for.
fn views(cameras: &Bound<'_, PyAny>, room: usize) -> PyResult<Vec<View>> {
    // One more is enough to see that there are too many.
    let views: Vec<View> = cameras
        .try_iter()?
        .take(room.saturating_add(1))
        .map(|item| View::new(&item?))
        .collect::<PyResult<_>>()?;
    if views.len() == room {
        return Ok(views);
    }
    let found = if views.len() > room { "more".to_owned() } else { views.len().to_string() };
    Err(value_error(format!("out has room for {room} frames, but there are {found} cameras")))
}

impl PyScene {
    fn fill(&self, py: Python<'_>, views: &[View], options: &Options, targets: &Targets<'_>) -> PyResult<()> {
        let mut frame = Frame::default();
        for (index, view) in views.iter().enumerate() {
            py.check_signals()?;
            self.draw_through(py, Some(&view.camera), options, &mut frame)?;
            targets.put(index, &frame)?;
        }
        Ok(())
    }
}

/// Draws a frame for each camera when it is asked for.
#[pyclass(name = "FrameIterator", module = "trigon3d")]
struct Frames {
    scene: Py<PyScene>,
    cameras: Py<PyIterator>,
    size: Option<[u32; 2]>,
    options: Options,
}

#[pymethods]
impl Frames {
    fn __iter__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __next__(&mut self, py: Python<'_>) -> PyResult<Option<PyFrame>> {
        let Some(item) = self.cameras.bind(py).clone().next() else { return Ok(None) };
        let view = View::new(&item?)?;
        let size = self.size.or(view.size);
        let size = size.ok_or_else(|| value_error("these cameras have no sizes; give width and height"))?;
        self.options.resize(size)?;
        self.scene.try_borrow(py)?.frame(py, Some(&view.camera), &self.options).map(Some)
    }
}

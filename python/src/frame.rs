//! Finished images as NumPy arrays.

use std::path::{Path, PathBuf};

use bytemuck::allocation::try_cast_vec;
use numpy::{Element, PyReadonlyArray3};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use trigon_io::{Pixels, encode_png, write_png};
use trigon_scene::Frame;

use crate::arrays::shaped;
use crate::errors::{load_error, value_error};

/// A finished image. Outputs that were not asked for are `None`.
///
/// Rows run from the top. The arrays own their memory; nothing was copied.
///
/// | output | shape, type | background |
/// |---|---|---|
/// | color | (h, w, 4) uint8: sRGB, straight alpha | the background's colour |
/// | radiance | (h, w, 4) float32: linear light, premultiplied | the background's light |
/// | depth | (h, w) float32: distance along the view axis, through a fisheye lens from the eye; in units of the scene | inf |
/// | object_ids, face_ids, material_ids, triangle_ids | (h, w) int32 | -1 |
/// | barycentrics, positions, normals, geometric_normals, albedo | (h, w, 3) float32 | 0 |
/// | uvs | (h, w, 2) float32 | 0 |
#[pyclass(name = "Frame", module = "trigon3d", frozen, get_all)]
pub(crate) struct PyFrame {
    width: u32,
    height: u32,
    color: Option<Py<PyAny>>,
    radiance: Option<Py<PyAny>>,
    depth: Option<Py<PyAny>>,
    object_ids: Option<Py<PyAny>>,
    face_ids: Option<Py<PyAny>>,
    material_ids: Option<Py<PyAny>>,
    triangle_ids: Option<Py<PyAny>>,
    barycentrics: Option<Py<PyAny>>,
    positions: Option<Py<PyAny>>,
    normals: Option<Py<PyAny>>,
    geometric_normals: Option<Py<PyAny>>,
    uvs: Option<Py<PyAny>>,
    albedo: Option<Py<PyAny>>,
}

impl PyFrame {
    pub(crate) fn new(py: Python<'_>, frame: Frame) -> PyResult<Self> {
        let size = [frame.height as usize, frame.width as usize];
        let image = Image { py, size };
        Ok(Self {
            width: frame.width,
            height: frame.height,
            color: image.of((!frame.color.is_empty()).then_some(frame.color), 4)?,
            radiance: image.vectors::<_, f32>(frame.radiance, 4)?,
            depth: image.of(frame.depth, 1)?,
            object_ids: image.vectors::<_, i32>(frame.object_ids, 1)?,
            face_ids: image.vectors::<_, i32>(frame.face_ids, 1)?,
            material_ids: image.vectors::<_, i32>(frame.material_ids, 1)?,
            triangle_ids: image.vectors::<_, i32>(frame.triangle_ids, 1)?,
            barycentrics: image.vectors::<_, f32>(frame.barycentrics, 3)?,
            positions: image.vectors::<_, f32>(frame.positions, 3)?,
            normals: image.vectors::<_, f32>(frame.normals, 3)?,
            geometric_normals: image.vectors::<_, f32>(frame.geometric_normals, 3)?,
            uvs: image.vectors::<_, f32>(frame.uvs, 2)?,
            albedo: image.vectors::<_, f32>(frame.albedo, 3)?,
        })
    }

    fn colors<'py>(&self, py: Python<'py>) -> PyResult<PyReadonlyArray3<'py, u8>> {
        let color = self.color.as_ref().ok_or_else(|| value_error("this frame has no color"))?;
        color.extract(py)
    }
}

/// Makes arrays of the image's size.
struct Image<'py> {
    py: Python<'py>,
    size: [usize; 2],
}

impl Image<'_> {
    fn of<T: Element>(&self, numbers: Option<Vec<T>>, channels: usize) -> PyResult<Option<Py<PyAny>>> {
        let Some(numbers) = numbers else { return Ok(None) };
        let [height, width] = self.size;
        let shape = [height, width, channels];
        let shape = if channels == 1 { &shape[..2] } else { &shape[..] };
        Ok(Some(shaped(self.py, numbers, shape)?.unbind()))
    }

    /// Vectors as their numbers, in the same memory.
    fn vectors<V: bytemuck::NoUninit, T: Element + bytemuck::AnyBitPattern>(
        &self,
        vectors: Option<Vec<V>>,
        channels: usize,
    ) -> PyResult<Option<Py<PyAny>>> {
        let numbers: Option<Vec<T>> = vectors
            .map(|vectors| try_cast_vec(vectors).map_err(|(error, _)| value_error(error)))
            .transpose()?;
        self.of(numbers, channels)
    }
}

#[pymethods]
impl PyFrame {
    /// Writes the colours to a PNG file, atomically.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let color = self.colors(py)?;
        let bytes = color.as_slice().map_err(value_error)?;
        write_png(Path::new(&path), self.width, self.height, Pixels::Rgba8(bytes)).map_err(load_error)
    }

    /// The colours as the bytes of a PNG file, the same as `save` writes.
    fn to_png<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let color = self.colors(py)?;
        let bytes = color.as_slice().map_err(value_error)?;
        let mut png = Vec::new();
        encode_png(&mut png, self.width, self.height, Pixels::Rgba8(bytes)).map_err(load_error)?;
        Ok(PyBytes::new(py, &png))
    }

    fn __repr__(&self) -> String {
        format!("Frame({} × {})", self.width, self.height)
    }
}

//! NumPy arrays of Python's that are filled with frames.

use numpy::{
    Element, PyArrayDyn, PyArrayMethods, PyReadwriteArrayDyn, PyUntypedArray, PyUntypedArrayMethods,
};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use trigon_scene::Frame;

use crate::errors::value_error;
use crate::options::OUTPUTS;

/// Arrays for the outputs of several frames, each of (frames, height, width), or with channels as a fourth axis.
pub(crate) struct Targets<'py> {
    arrays: Vec<(&'static str, Bound<'py, PyAny>)>,
    pub(crate) size: FrameSize,
}

/// How many frames of which size arrays have room for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) struct FrameSize {
    pub(crate) frames: usize,
    pub(crate) width: u32,
    pub(crate) height: u32,
}

impl<'py> Targets<'py> {
    /// Of a dict of arrays by the names of outputs. All are checked here, before anything is drawn.
    pub(crate) fn new(out: &Bound<'py, PyDict>) -> PyResult<Self> {
        let mut arrays = Vec::new();
        for (key, array) in out {
            let key: String =
                key.extract().map_err(|_| value_error("the keys of out are names of outputs"))?;
            let name = OUTPUTS.into_iter().find(|name| *name == key).ok_or_else(|| {
                value_error(format!("there is no output {key:?}; there are {}", OUTPUTS.join(", ")))
            })?;
            arrays.push((name, array));
        }
        let Some((name, first)) = arrays.first() else { return Err(value_error("out has no arrays")) };
        let size = FrameSize::of(name, first)?;
        // Held at once, so that arrays that share memory are found.
        let held = arrays.iter().map(|(name, array)| Held::new(name, array, size));
        held.collect::<PyResult<Vec<_>>>()?;
        Ok(Self { arrays, size })
    }

    pub(crate) fn names(&self) -> Vec<&'static str> {
        self.arrays.iter().map(|(name, _)| *name).collect()
    }

    /// Copies a frame's outputs to where the frame with this number belongs. The arrays are checked again: since the
    /// last frame, another thread may have given them another shape.
    pub(crate) fn put(&self, index: usize, frame: &Frame) -> PyResult<()> {
        for (name, array) in &self.arrays {
            let numbers = Numbers::of(frame, name).expect("what was asked for is drawn");
            Held::new(name, array, self.size)?.put(index, &numbers)?;
        }
        Ok(())
    }
}

impl FrameSize {
    fn of(name: &str, array: &Bound<'_, PyAny>) -> PyResult<Self> {
        let shape = untyped(name, array)?.shape();
        let (Some(&frames), Some(&height), Some(&width)) = (shape.first(), shape.get(1), shape.get(2)) else {
            return Err(value_error(format!(
                "out[{name:?}] has the shape {shape:?}, but needs (frames, height, width, …)"
            )));
        };
        let side = |side: usize| {
            let too_large =
                || value_error(format!("out[{name:?}] has the shape {shape:?}: no image is so large"));
            u32::try_from(side).map_err(|_| too_large())
        };
        Ok(Self { frames, width: side(width)?, height: side(height)? })
    }
}

fn untyped<'a, 'py>(name: &str, array: &'a Bound<'py, PyAny>) -> PyResult<&'a Bound<'py, PyUntypedArray>> {
    array.cast::<PyUntypedArray>().map_err(|_| value_error(format!("out[{name:?}] is no NumPy array")))
}

/// An array that is being written.
enum Held<'py> {
    Bytes(PyReadwriteArrayDyn<'py, u8>),
    Floats(PyReadwriteArrayDyn<'py, f32>),
    Ids(PyReadwriteArrayDyn<'py, i32>),
}

impl<'py> Held<'py> {
    fn new(name: &str, array: &Bound<'py, PyAny>, size: FrameSize) -> PyResult<Self> {
        let FrameSize { frames, width, height } = size;
        let channels = match name {
            "color" | "radiance" => 4,
            "uvs" => 2,
            "barycentrics" | "positions" | "normals" | "geometric_normals" | "albedo" => 3,
            _ => 1,
        };
        let expected = [frames, height as usize, width as usize, channels];
        let expected = if channels == 1 { &expected[..3] } else { &expected[..] };
        let untyped = untyped(name, array)?;
        if untyped.shape() != expected {
            let found = untyped.shape();
            return Err(value_error(format!(
                "out[{name:?}] has the shape {found:?}, but needs {expected:?}: frames, height, width, channels"
            )));
        }
        if !untyped.is_c_contiguous() {
            return Err(value_error(format!("out[{name:?}] is not contiguous in the order of its axes")));
        }
        match name {
            "color" => held(name, array, "uint8").map(Self::Bytes),
            _ if name.ends_with("_ids") => held(name, array, "int32").map(Self::Ids),
            _ => held(name, array, "float32").map(Self::Floats),
        }
    }

    fn put(&mut self, index: usize, numbers: &Numbers<'_>) -> PyResult<()> {
        match (self, numbers) {
            (Self::Bytes(array), Numbers::Bytes(numbers)) => put(array, index, numbers),
            (Self::Floats(array), Numbers::Floats(numbers)) => put(array, index, numbers),
            (Self::Ids(array), Numbers::Ids(numbers)) => put(array, index, numbers),
            _ => unreachable!("both types follow from the name of the output"),
        }
    }
}

fn held<'py, T: Element>(
    name: &str,
    array: &Bound<'py, PyAny>,
    numpy_type: &str,
) -> PyResult<PyReadwriteArrayDyn<'py, T>> {
    let typed = array.cast::<PyArrayDyn<T>>().map_err(|_| {
        let found = untyped(name, array).map_or_else(|_| String::new(), |array| array.dtype().to_string());
        value_error(format!("out[{name:?}] holds {found}, but needs {numpy_type}"))
    })?;
    let mut held = typed.try_readwrite().map_err(|error| value_error(format!("out[{name:?}]: {error}")))?;
    held.as_slice_mut().map_err(|error| value_error(format!("out[{name:?}]: {error}")))?;
    Ok(held)
}

fn put<T: Element + Copy>(
    array: &mut PyReadwriteArrayDyn<'_, T>,
    index: usize,
    numbers: &[T],
) -> PyResult<()> {
    let all = array.as_slice_mut().map_err(value_error)?;
    let room = all.chunks_exact_mut(numbers.len()).nth(index).expect("the shape was checked");
    room.copy_from_slice(numbers);
    Ok(())
}

/// The numbers of one output of a frame.
enum Numbers<'f> {
    Bytes(&'f [u8]),
    Floats(&'f [f32]),
    Ids(&'f [i32]),
}

impl<'f> Numbers<'f> {
    fn of(frame: &'f Frame, name: &str) -> Option<Self> {
        fn floats<V: bytemuck::NoUninit>(vectors: Option<&Vec<V>>) -> Option<Numbers<'_>> {
            vectors.map(|vectors| Numbers::Floats(bytemuck::cast_slice(vectors)))
        }
        let ids = |ids: &'f Option<Vec<u32>>| ids.as_ref().map(|ids| Self::Ids(bytemuck::cast_slice(ids)));
        match name {
            "color" => Some(Self::Bytes(&frame.color)),
            "radiance" => floats(frame.radiance.as_ref()),
            "depth" => floats(frame.depth.as_ref()),
            "object_ids" => ids(&frame.object_ids),
            "face_ids" => ids(&frame.face_ids),
            "material_ids" => ids(&frame.material_ids),
            "triangle_ids" => ids(&frame.triangle_ids),
            "barycentrics" => floats(frame.barycentrics.as_ref()),
            "positions" => floats(frame.positions.as_ref()),
            "normals" => floats(frame.normals.as_ref()),
            "geometric_normals" => floats(frame.geometric_normals.as_ref()),
            "uvs" => floats(frame.uvs.as_ref()),
            "albedo" => floats(frame.albedo.as_ref()),
            _ => None,
        }
    }
}

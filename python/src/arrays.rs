//! NumPy arrays as lists of vectors, checked, and the other way.

use numpy::{Element, PyArray1, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use trigon_math::{DAffine3, DMat3, DVec3, Vec2, Vec3, Vec4, color};

use crate::errors::value_error;

/// Anything like an array of rows of numbers, as one of the element type.
fn rows<'py, T: Element>(
    value: &Bound<'py, PyAny>,
    name: &str,
    numpy_type: &str,
) -> PyResult<PyReadonlyArray2<'py, T>> {
    let numpy = value.py().import("numpy")?;
    let array = numpy.call_method1("asarray", (value,))?;
    let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
    let shape: Vec<usize> = array.getattr("shape")?.extract()?;
    if shape.len() != 2 {
        return Err(value_error(format!("{name} has the shape {shape:?}, but needs two dimensions")));
    }
    if !"fiub".contains(&kind) {
        let found = array.getattr("dtype")?;
        return Err(value_error(format!("{name} holds {found}, not numbers")));
    }
    // A copy where the type or the order of memory is another one.
    let array = numpy.call_method1("ascontiguousarray", (array, numpy_type))?;
    array.extract()
}

/// Rows of `N` finite numbers.
fn finite<const N: usize>(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<[f32; N]>> {
    let array = rows::<f32>(value, name, "float32")?;
    let [count, width] = [array.shape()[0], array.shape()[1]];
    if width != N {
        return Err(value_error(format!("{name} has the shape ({count}, {width}), but needs (n, {N})")));
    }
    let numbers = array.as_slice().map_err(value_error)?;
    let rows = numbers.as_chunks::<N>().0.to_vec();
    match rows.iter().position(|row| row.iter().any(|number| !number.is_finite())) {
        Some(row) => Err(value_error(format!("{name}[{row}] is not finite in 32 bits: {:?}", rows[row]))),
        None => Ok(rows),
    }
}

/// Points or directions.
pub(crate) fn vectors(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<Vec3>> {
    Ok(finite::<3>(value, name)?.into_iter().map(Vec3::from_array).collect())
}

/// Texture coordinates.
pub(crate) fn coordinates(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<Vec2>> {
    Ok(finite::<2>(value, name)?.into_iter().map(Vec2::from_array).collect())
}

/// Colours in sRGB, bytes from 0 to 255 or numbers from 0 to 1, with or without alpha, as linear light.
pub(crate) fn colors(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<Vec4>> {
    let array = value.py().import("numpy")?.call_method1("asarray", (value,))?;
    let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
    let scale = if kind == "f" { 1.0 } else { 1.0 / 255.0 };
    let width = array.getattr("shape")?.extract::<Vec<usize>>()?.get(1).copied();
    let rows: Vec<[f32; 4]> = match width {
        Some(4) => finite::<4>(&array, name)?,
        _ => finite::<3>(&array, name)?.into_iter().map(|[r, g, b]| [r, g, b, 1.0 / scale]).collect(),
    };
    let linear = |[r, g, b, a]: [f32; 4]| {
        let [r, g, b] = [r, g, b].map(|channel| color::srgb_to_linear(channel * scale));
        Vec4::new(r, g, b, a * scale)
    };
    Ok(rows.into_iter().map(linear).collect())
}

/// One colour in sRGB as linear light: three numbers from 0 to 1, or four with alpha.
pub(crate) fn color(value: &[f32], name: &str) -> PyResult<Vec4> {
    let rgba = match *value {
        [r, g, b] => [r, g, b, 1.0],
        [r, g, b, a] => [r, g, b, a],
        _ => return Err(value_error(format!("{name} has {} numbers, not 3 or 4", value.len()))),
    };
    if rgba.iter().any(|channel| !(0.0..=1.0).contains(channel)) {
        return Err(value_error(format!("{name} is {rgba:?}, but channels go from 0 to 1 (sRGB)")));
    }
    let [r, g, b, a] = rgba;
    Ok(Vec3::from_array([r, g, b].map(color::srgb_to_linear)).extend(a))
}

/// The faces of a mesh, one after the other.
pub(crate) struct Faces {
    /// The vertices of all corners.
    pub(crate) corners: Vec<u32>,
    /// The number of corners of each face; `None` if all are triangles.
    pub(crate) sizes: Option<Vec<usize>>,
}

/// Faces as rows of an array (triangles, quads …), or as a list of lists of any lengths.
pub(crate) fn faces(value: &Bound<'_, PyAny>, vertex_count: usize) -> PyResult<Faces> {
    let numpy = value.py().import("numpy")?;
    let is_array = value.is_instance(&numpy.getattr("ndarray")?)?;
    let indices = if is_array { None } else { Some(value.extract::<Vec<Vec<i64>>>()?) };
    let vertex = |index: i64, face: usize| {
        let known = u32::try_from(index).ok().filter(|index| (*index as usize) < vertex_count);
        known.ok_or_else(|| {
            value_error(format!("faces[{face}] names vertex {index}, but there are {vertex_count} vertices"))
        })
    };
    if let Some(polygons) = indices {
        let mut faces = Faces { corners: Vec::new(), sizes: None };
        for (face, polygon) in polygons.iter().enumerate() {
            for &index in polygon {
                faces.corners.push(vertex(index, face)?);
            }
        }
        let is_triangular = polygons.iter().all(|polygon| polygon.len() == 3);
        faces.sizes = (!is_triangular).then(|| polygons.iter().map(Vec::len).collect());
        return Ok(faces);
    }
    let kind: String = value.getattr("dtype")?.getattr("kind")?.extract()?;
    if !"iu".contains(&kind) {
        return Err(value_error(format!("faces hold {}, not whole numbers", value.getattr("dtype")?)));
    }
    let array = rows::<i64>(value, "faces", "int64")?;
    let [count, width] = [array.shape()[0], array.shape()[1]];
    if width < 3 {
        return Err(value_error(format!(
            "faces have the shape ({count}, {width}), but need 3 corners or more"
        )));
    }
    let numbers = array.as_slice().map_err(value_error)?;
    let corners = numbers.iter().enumerate().map(|(corner, &index)| vertex(index, corner / width));
    let corners: Vec<u32> = corners.collect::<PyResult<_>>()?;
    Ok(Faces { corners, sizes: (width != 3).then(|| vec![width; count]) })
}

/// A matrix of 4 by 4, or 3 by 4.
pub(crate) fn affine(value: &Bound<'_, PyAny>, name: &str) -> PyResult<DAffine3> {
    let array = rows::<f64>(value, name, "float64")?;
    let shape = [array.shape()[0], array.shape()[1]];
    if shape != [4, 4] && shape != [3, 4] {
        return Err(value_error(format!("{name} has the shape {shape:?}, but needs (4, 4) or (3, 4)")));
    }
    let numbers = array.as_slice().map_err(value_error)?;
    let (rows, _) = numbers.as_chunks::<4>();
    if rows.get(3).is_some_and(|last| *last != [0.0, 0.0, 0.0, 1.0]) {
        return Err(value_error(format!(
            "the last row of {name} is not 0 0 0 1; transpose it if it is stored by columns"
        )));
    }
    let column = |index: usize| DVec3::new(rows[0][index], rows[1][index], rows[2][index]);
    let matrix =
        DAffine3 { matrix3: DMat3::from_cols(column(0), column(1), column(2)), translation: column(3) };
    if matrix.is_finite() { Ok(matrix) } else { Err(value_error(format!("{name} is not finite"))) }
}

/// A matrix as 4 by 4 numbers.
pub(crate) fn matrix<'py>(py: Python<'py>, matrix: &DAffine3) -> PyResult<Bound<'py, PyAny>> {
    let rows = matrix.matrix3.transpose();
    let mut numbers = Vec::with_capacity(16);
    for (row, shift) in [rows.x_axis, rows.y_axis, rows.z_axis].into_iter().zip(matrix.translation.to_array())
    {
        numbers.extend(row.to_array());
        numbers.push(shift);
    }
    numbers.extend([0.0, 0.0, 0.0, 1.0]);
    shaped(py, numbers, &[4, 4])
}

/// Numbers as an array that owns them, in a shape.
pub(crate) fn shaped<'py, T: Element>(
    py: Python<'py>,
    numbers: Vec<T>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyAny>> {
    Ok(PyArray1::from_vec(py, numbers).reshape(shape.to_vec())?.into_any())
}

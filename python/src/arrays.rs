//! NumPy arrays as lists of vectors, checked, and the other way.

use numpy::{Element, PyArray1, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::conversion::FromPyObjectOwned;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyList, PyString, PyTuple};
use trigon_io::Limits;
use trigon_math::{DAffine3, DMat3, DVec3, Vec2, Vec3, Vec4, color};

use crate::errors::value_error;

/// An array of rows of numbers that is not yet copied.
struct Table<'py> {
    name: String,
    array: Bound<'py, PyAny>,
    /// Rows and columns.
    shape: [usize; 2],
    /// NumPy's letter of the type.
    kind: String,
}

impl<'py> Table<'py> {
    /// Anything like an array.
    fn new(value: &Bound<'py, PyAny>, name: &str) -> PyResult<Self> {
        // Its class is NumPy's own, so that what it says of itself is true.
        let array = value.py().import("numpy")?.call_method1("asarray", (value,))?;
        let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
        let shape: Vec<usize> = array.getattr("shape")?.extract()?;
        let &[rows, columns] = &shape[..] else {
            return Err(value_error(format!("{name} has the shape {shape:?}, but needs two dimensions")));
        };
        if !"fiub".contains(&kind) {
            let found = array.getattr("dtype")?;
            return Err(value_error(format!("{name} holds {found}, not numbers")));
        }
        Ok(Self { name: name.to_owned(), array, shape: [rows, columns], kind })
    }

    /// Refuses more than so many rows. A view of a few bytes can pretend any number of them, and would be copied.
    fn at_most(&self, rows: usize) -> PyResult<()> {
        if self.shape[0] <= rows {
            return Ok(());
        }
        Err(value_error(format!("{} has {} rows; the limit is {rows}", self.name, self.shape[0])))
    }

    /// The numbers in another type, row after row.
    fn numbers<T: Element + Copy>(&self, numpy_type: &str) -> PyResult<Vec<T>> {
        let numpy = self.array.py().import("numpy")?;
        // A copy where the type, the order or the alignment of memory is another one.
        let array = numpy.call_method1("require", (&self.array, numpy_type, ["C", "A"]))?;
        let array: PyReadonlyArray2<'_, T> = array.extract()?;
        if array.shape() != self.shape {
            return Err(value_error(format!("{} was changed by another thread meanwhile", self.name)));
        }
        Ok(array.as_slice().map_err(value_error)?.to_vec())
    }

    /// An error about the number of columns.
    fn wrong_shape(&self, needed: &str) -> PyErr {
        let [rows, columns] = self.shape;
        value_error(format!("{} has the shape ({rows}, {columns}), but needs {needed}", self.name))
    }
}

/// Rows of `N` finite numbers.
fn finite<const N: usize>(table: &Table<'_>) -> PyResult<Vec<[f32; N]>> {
    if table.shape[1] != N {
        return Err(table.wrong_shape(&format!("(n, {N})")));
    }
    table.at_most(Limits::default().corners)?;
    let rows = table.numbers::<f32>("float32")?.as_chunks::<N>().0.to_vec();
    match rows.iter().position(|row| row.iter().any(|number| !number.is_finite())) {
        Some(row) => {
            Err(value_error(format!("{}[{row}] is not finite in 32 bits: {:?}", table.name, rows[row])))
        }
        None => Ok(rows),
    }
}

/// The points of a mesh or a cloud.
pub(crate) fn vertices(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<Vec3>> {
    let table = Table::new(value, name)?;
    table.at_most(Limits::default().vertices)?;
    Ok(finite::<3>(&table)?.into_iter().map(Vec3::from_array).collect())
}

/// Directions.
pub(crate) fn vectors(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<Vec3>> {
    Ok(finite::<3>(&Table::new(value, name)?)?.into_iter().map(Vec3::from_array).collect())
}

/// Points in double precision, which need not be finite.
pub(crate) fn points(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<DVec3>> {
    let table = Table::new(value, name)?;
    if table.shape[1] != 3 {
        return Err(table.wrong_shape("(n, 3)"));
    }
    table.at_most(Limits::default().corners)?;
    Ok(table
        .numbers::<f64>("float64")?
        .as_chunks::<3>()
        .0
        .iter()
        .map(|&row| DVec3::from_array(row))
        .collect())
}

/// Texture coordinates.
pub(crate) fn coordinates(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<Vec2>> {
    Ok(finite::<2>(&Table::new(value, name)?)?.into_iter().map(Vec2::from_array).collect())
}

/// Colours in sRGB, bytes from 0 to 255 or numbers from 0 to 1, with or without alpha, as linear light.
pub(crate) fn colors(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<Vec4>> {
    let table = Table::new(value, name)?;
    let scale = if table.kind == "f" { 1.0 } else { 1.0 / 255.0 };
    let rows: Vec<[f32; 4]> = match table.shape[1] {
        4 => finite::<4>(&table)?,
        _ => finite::<3>(&table)?.into_iter().map(|[r, g, b]| [r, g, b, 1.0 / scale]).collect(),
    };
    let linear = |[r, g, b, a]: [f32; 4]| {
        let [r, g, b] = [r, g, b].map(|channel| color::srgb_to_linear(channel * scale));
        Vec4::new(r, g, b, a * scale)
    };
    Ok(rows.into_iter().map(linear).collect())
}

/// The three or four numbers of one colour in sRGB.
pub(crate) struct Channels(Vec<f32>);

impl<'py> FromPyObject<'_, 'py> for Channels {
    type Error = PyErr;

    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        // Five are enough to see that there are too many.
        items(&value, "a colour", 5).map(Self)
    }
}

impl Channels {
    /// White.
    pub(crate) fn white() -> Self {
        Self(vec![1.0; 3])
    }

    /// Every channel of this strength.
    pub(crate) fn grey(strength: f32) -> Self {
        Self(vec![strength; 3])
    }

    /// As linear light.
    pub(crate) fn linear(&self, name: &str) -> PyResult<Vec4> {
        let rgba = match self.0[..] {
            [r, g, b] => [r, g, b, 1.0],
            [r, g, b, a] => [r, g, b, a],
            _ => return Err(value_error(format!("{name} has {} numbers, not 3 or 4", self.0.len()))),
        };
        if rgba.iter().any(|channel| !(0.0..=1.0).contains(channel)) {
            return Err(value_error(format!("{name} is {rgba:?}, but channels go from 0 to 1 (sRGB)")));
        }
        let [r, g, b, a] = rgba;
        Ok(Vec3::from_array([r, g, b].map(color::srgb_to_linear)).extend(a))
    }
}

/// The items of anything that can be iterated, `most` of them. What it says of its length is not believed.
pub(crate) fn items<'py, T: FromPyObjectOwned<'py>>(
    value: &Bound<'py, PyAny>,
    name: &str,
    most: usize,
) -> PyResult<Vec<T>> {
    if value.is_instance_of::<PyString>() {
        return Err(PyTypeError::new_err(format!("{name} is a text, not a list")));
    }
    value.try_iter()?.take(most).map(|item| item?.extract().map_err(Into::into)).collect()
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
    let vertex = |index: i64, face: usize| {
        let known = u32::try_from(index).ok().filter(|index| (*index as usize) < vertex_count);
        known.ok_or_else(|| {
            value_error(format!("faces[{face}] names vertex {index}, but there are {vertex_count} vertices"))
        })
    };
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        return listed_faces(value, vertex);
    }
    let table = Table::new(value, "faces")?;
    if !"iu".contains(&table.kind) {
        let found = table.array.getattr("dtype")?;
        return Err(value_error(format!("faces hold {found}, not whole numbers")));
    }
    let [count, width] = table.shape;
    if width < 3 {
        return Err(value_error(format!(
            "faces have the shape ({count}, {width}), but need 3 corners or more"
        )));
    }
    table.at_most(Limits::default().corners / width)?;
    let numbers = table.numbers::<i64>("int64")?;
    let corners = numbers.into_iter().enumerate().map(|(corner, index)| vertex(index, corner / width));
    let corners: Vec<u32> = corners.collect::<PyResult<_>>()?;
    Ok(Faces { corners, sizes: (width != 3).then(|| vec![width; count]) })
}

/// Faces as a list of lists.
fn listed_faces(value: &Bound<'_, PyAny>, vertex: impl Fn(i64, usize) -> PyResult<u32>) -> PyResult<Faces> {
    let most = Limits::default().corners;
    let (mut corners, mut sizes) = (Vec::new(), Vec::new());
    for (face, polygon) in value.try_iter()?.enumerate() {
        let polygon: Vec<i64> = items(&polygon?, "a face", most - corners.len() + 1)?;
        for &index in &polygon {
            corners.push(vertex(index, face)?);
        }
        sizes.push(polygon.len());
        if corners.len() > most || sizes.len() > most {
            return Err(value_error(format!("faces have more than {most} corners")));
        }
    }
    let is_triangular = sizes.iter().all(|size| *size == 3);
    Ok(Faces { corners, sizes: (!is_triangular).then_some(sizes) })
}

/// A matrix of 4 by 4, or 3 by 4.
pub(crate) fn affine(value: &Bound<'_, PyAny>, name: &str) -> PyResult<DAffine3> {
    let table = Table::new(value, name)?;
    if table.shape != [4, 4] && table.shape != [3, 4] {
        return Err(table.wrong_shape("(4, 4) or (3, 4)"));
    }
    let numbers = table.numbers::<f64>("float64")?;
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

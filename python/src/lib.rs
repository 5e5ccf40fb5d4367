//! Python bindings of trigon: scenes from files and arrays, cameras, and frames as NumPy arrays.

mod arrays;
mod camera;
mod errors;
mod facts;
mod frame;
mod frontier;
mod load;
mod many;
mod material;
mod options;
mod pick;
mod pixel;
mod scene;
mod targets;

use pyo3::prelude::*;

/// The compiled part of `trigon3d`.
#[pymodule]
fn _trigon3d(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<camera::PyCamera>()?;
    module.add_class::<frame::PyFrame>()?;
    module.add_class::<material::PyMaterial>()?;
    module.add_class::<scene::PyScene>()?;
    module.add_function(wrap_pyfunction!(load::load, module)?)?;
    module.add_function(wrap_pyfunction!(load::load_cameras, module)?)?;
    module.add_function(wrap_pyfunction!(options::set_threads, module)?)?;
    errors::register(module)
}

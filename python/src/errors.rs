//! Exceptions and warnings.

use std::ffi::CString;
use std::fmt::Display;

use pyo3::PyErr;
use pyo3::create_exception;
use pyo3::exceptions::{PyException, PyUserWarning};
use pyo3::prelude::*;

create_exception!(trigon3d, TrigonError, PyException, "Anything that trigon could not do.");
create_exception!(
    trigon3d,
    LoadError,
    TrigonError,
    "A file could not be used. The message names the file, the location in it and a remedy."
);
create_exception!(trigon3d, RenderError, TrigonError, "An image could not be drawn.");
create_exception!(
    trigon3d,
    TrigonWarning,
    PyUserWarning,
    "Something in a file is missing or wrong, and the rest was used."
);

/// Adds the classes to the module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    module.add("TrigonError", py.get_type::<TrigonError>())?;
    module.add("LoadError", py.get_type::<LoadError>())?;
    module.add("RenderError", py.get_type::<RenderError>())?;
    module.add("TrigonWarning", py.get_type::<TrigonWarning>())
}

/// A file could not be used.
pub(crate) fn load_error(error: impl Display) -> PyErr {
    LoadError::new_err(error.to_string())
}

/// An image could not be drawn.
pub(crate) fn render_error(error: impl Display) -> PyErr {
    RenderError::new_err(error.to_string())
}

/// An argument is out of range.
pub(crate) fn value_error(error: impl Display) -> PyErr {
    pyo3::exceptions::PyValueError::new_err(error.to_string())
}

/// Passes warnings on as Python's. A filter may turn them into exceptions.
pub(crate) fn warn(py: Python<'_>, warnings: impl IntoIterator<Item = impl Display>) -> PyResult<()> {
    let category = py.get_type::<TrigonWarning>();
    for warning in warnings {
        // Messages have no control characters.
        let message = CString::new(warning.to_string()).map_err(value_error)?;
        PyErr::warn(py, &category, &message, 1)?;
    }
    Ok(())
}

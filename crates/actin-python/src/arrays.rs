//! Conversion between numpy arrays and Rust buffers.

use numpy::{
    PyArray1, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods, ToPyArray,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Numbers in C order with a shape.
#[derive(Debug)]
pub(crate) struct Block {
    pub(crate) values: Vec<f64>,
    pub(crate) shape: Vec<usize>,
}

impl Block {
    pub(crate) fn new(values: Vec<f64>, shape: &[usize]) -> Self {
        Self {
            values,
            shape: shape.to_vec(),
        }
    }

    /// Converts to a read-only array without copying.
    pub(crate) fn into_python(self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        let array = PyArray1::from_vec(py, self.values).reshape(self.shape)?;
        let array = array.into_any();
        array.getattr("flags")?.setattr("writeable", false)?;
        Ok(array.unbind())
    }
}

/// Converts to a read-only, one-dimensional array.
pub(crate) fn column(py: Python<'_>, values: Vec<f64>) -> PyResult<Py<PyAny>> {
    let length = values.len();
    Block::new(values, &[length]).into_python(py)
}

/// Converts to a read-only array of integers.
pub(crate) fn indices(py: Python<'_>, values: &[i64]) -> PyResult<Py<PyAny>> {
    let array = values.to_pyarray(py).into_any();
    array.getattr("flags")?.setattr("writeable", false)?;
    Ok(array.unbind())
}

/// Reads numbers in C order from any array or nested lists.
pub(crate) fn read(
    object: &Bound<'_, PyAny>,
    name: &str,
    shape: &[Option<usize>],
) -> PyResult<(Vec<f64>, Vec<usize>)> {
    let numpy = object.py().import("numpy")?;
    let made = numpy.call_method1("ascontiguousarray", (object, "float64"))?;
    let array = made.cast::<PyArrayDyn<f64>>()?;
    let found: PyReadonlyArrayDyn<'_, f64> = array.readonly();
    let given = found.shape().to_vec();
    let fits = given.len() == shape.len()
        && given
            .iter()
            .zip(shape)
            .all(|(n, rule)| rule.is_none_or(|rule| rule == *n));
    if !fits {
        let wanted = shape
            .iter()
            .map(|n| n.map_or("any".into(), |n| n.to_string()));
        let wanted: Vec<String> = wanted.collect();
        return Err(PyValueError::new_err(format!(
            "{name} must have shape ({}), not {given:?}",
            wanted.join(", ")
        )));
    }
    let values = found.as_slice()?.to_vec();
    if let Some(place) = values.iter().position(|value| !value.is_finite()) {
        return Err(PyValueError::new_err(format!(
            "{name} must be finite, but element {place} is {}",
            values[place]
        )));
    }
    Ok((values, given))
}

/// Reads three numbers.
pub(crate) fn vector(object: &Bound<'_, PyAny>, name: &str) -> PyResult<[f64; 3]> {
    let (values, _) = read(object, name, &[Some(3)])?;
    Ok([values[0], values[1], values[2]])
}

/// Reads rows of three numbers.
pub(crate) fn vectors(object: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<[f64; 3]>> {
    let (values, _) = read(object, name, &[None, Some(3)])?;
    Ok(values.chunks_exact(3).map(|v| [v[0], v[1], v[2]]).collect())
}

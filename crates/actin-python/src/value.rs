//! Conversion of scene values from and to Python.

use actin_sim::SceneValue;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyMapping, PyString};

/// Converts dictionaries, sequences, numpy arrays, numbers, strings, paths and `None`.
pub(crate) fn from_python(object: &Bound<'_, PyAny>) -> PyResult<SceneValue> {
    if object.is_none() {
        return Ok(SceneValue::None);
    }
    if let Ok(value) = object.cast::<PyBool>() {
        return Ok(SceneValue::Bool(value.is_true()));
    }
    if object.is_instance_of::<PyInt>() {
        return whole(object);
    }
    if object.is_instance_of::<PyFloat>() {
        return Ok(SceneValue::Number(object.extract()?));
    }
    if let Ok(text) = object.cast::<PyString>() {
        return Ok(SceneValue::Text(text.to_str()?.to_owned()));
    }
    if let Ok(mapping) = object.cast::<PyMapping>() {
        return keys(mapping);
    }
    for (name, of) in [("tolist", "an array"), ("__fspath__", "a path")] {
        if object.hasattr(name)? {
            let inner = object.call_method0(name)?;
            if inner.is(object) {
                return Err(PyTypeError::new_err(format!(
                    "{of} that converts to itself"
                )));
            }
            return from_python(&inner);
        }
    }
    let elements = object.try_iter().map_err(|_| {
        let kind = object.get_type();
        PyTypeError::new_err(format!("a scene holds no {kind}"))
    })?;
    let list: PyResult<Vec<SceneValue>> = elements.map(|element| from_python(&element?)).collect();
    list.map(SceneValue::List)
}

fn whole(object: &Bound<'_, PyAny>) -> PyResult<SceneValue> {
    let signed = object.extract::<i64>().map(i128::from);
    let value = signed.or_else(|_| object.extract::<u64>().map(i128::from))?;
    Ok(SceneValue::Whole(value))
}

fn keys(mapping: &Bound<'_, PyMapping>) -> PyResult<SceneValue> {
    let mut all = Vec::new();
    for item in mapping.items()? {
        let (key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
        let key: String = key
            .extract()
            .map_err(|_| PyTypeError::new_err(format!("keys of a scene are strings, not {key}")))?;
        all.push((key, from_python(&value)?));
    }
    Ok(SceneValue::Keys(all))
}

/// Converts to dictionaries, lists, numbers and strings.
pub(crate) fn to_python<'py>(py: Python<'py>, value: &SceneValue) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        SceneValue::None => py.None().into_bound(py),
        SceneValue::Bool(value) => PyBool::new(py, *value).to_owned().into_any(),
        SceneValue::Whole(value) => match i64::try_from(*value) {
            Ok(value) => value.into_pyobject(py)?.into_any(),
            Err(_) => u64::try_from(*value)?.into_pyobject(py)?.into_any(),
        },
        SceneValue::Number(value) => PyFloat::new(py, *value).into_any(),
        SceneValue::Text(value) => PyString::new(py, value).into_any(),
        SceneValue::List(values) => {
            let all: PyResult<Vec<_>> = values.iter().map(|value| to_python(py, value)).collect();
            PyList::new(py, all?)?.into_any()
        }
        SceneValue::Keys(values) => {
            let dictionary = PyDict::new(py);
            for (key, value) in values {
                dictionary.set_item(key, to_python(py, value)?)?;
            }
            dictionary.into_any()
        }
    })
}

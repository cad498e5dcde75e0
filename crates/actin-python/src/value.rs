//! Conversion of scene values from and to Python.

use actin_sim::{SceneKind as Kind, SceneValue};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyMapping, PyString};

/// Converts dictionaries, sequences, numpy arrays, numbers, strings, paths and `None`.
pub(crate) fn from_python(object: &Bound<'_, PyAny>) -> PyResult<SceneValue> {
    if object.is_none() {
        return Ok(Kind::None.into());
    }
    if let Ok(value) = object.cast::<PyBool>() {
        return Ok(Kind::Bool(value.is_true()).into());
    }
    if object.is_instance_of::<PyInt>() {
        return whole(object);
    }
    if object.is_instance_of::<PyFloat>() {
        return Ok(Kind::Number(object.extract()?).into());
    }
    if let Ok(text) = object.cast::<PyString>() {
        return Ok(Kind::Text(text.to_str()?.to_owned()).into());
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
    list.map(|values| Kind::List(values).into())
}

fn whole(object: &Bound<'_, PyAny>) -> PyResult<SceneValue> {
    let signed = object.extract::<i64>().map(i128::from);
    let value = signed.or_else(|_| object.extract::<u64>().map(i128::from))?;
    Ok(Kind::Whole(value).into())
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
    Ok(SceneValue::keys(all))
}

/// Converts to dictionaries, lists, numbers and strings. A choice with keys becomes a dictionary with its name as the only key.
pub(crate) fn to_python<'py>(py: Python<'py>, value: &SceneValue) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value.kind() {
        Kind::Bool(value) => PyBool::new(py, *value).to_owned().into_any(),
        Kind::Whole(value) => match i64::try_from(*value) {
            Ok(value) => value.into_pyobject(py)?.into_any(),
            Err(_) => u64::try_from(*value)?.into_pyobject(py)?.into_any(),
        },
        Kind::Number(value) => PyFloat::new(py, *value).into_any(),
        Kind::Text(value) | Kind::Name(value) => PyString::new(py, value).into_any(),
        Kind::List(values) => list(py, values)?,
        Kind::Group(None, values) => group(py, values)?,
        Kind::Group(Some(name), values) => {
            let dictionary = PyDict::new(py);
            dictionary.set_item(name, group(py, values)?)?;
            dictionary.into_any()
        }
        Kind::None | Kind::Invalid | Kind::Removed => py.None().into_bound(py),
    })
}

fn list<'py>(py: Python<'py>, values: &[SceneValue]) -> PyResult<Bound<'py, PyAny>> {
    let all: PyResult<Vec<_>> = values.iter().map(|value| to_python(py, value)).collect();
    Ok(PyList::new(py, all?)?.into_any())
}

/// Converts values with keys to a dictionary, others to a list.
fn group<'py>(py: Python<'py>, values: &[SceneValue]) -> PyResult<Bound<'py, PyAny>> {
    if !values.is_empty() && values.iter().all(|value| value.key().is_none()) {
        return list(py, values);
    }
    let dictionary = PyDict::new(py);
    for value in values {
        if let Some(key) = value.key() {
            dictionary.set_item(key, to_python(py, value)?)?;
        }
    }
    Ok(dictionary.into_any())
}

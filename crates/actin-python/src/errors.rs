//! Conversion of Rust errors to the exceptions of `actin_filaments/errors.py`.

use actin_integrate::RunFailure;
use actin_rundir::RunDirectoryError;
use actin_sim::{SceneError, SceneProblem, SceneText};
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

/// Creates an exception of `actin_filaments.errors` with attributes.
pub(crate) fn raise(
    py: Python<'_>,
    class: &str,
    message: &str,
    attributes: &Bound<'_, PyDict>,
) -> PyErr {
    let made = py
        .import("actin_filaments.errors")
        .and_then(|errors| errors.getattr(class))
        .and_then(|class| class.call1((message,)))
        .and_then(|error| {
            for (name, value) in attributes {
                error.setattr(name.cast_into::<pyo3::types::PyString>()?, value)?;
            }
            Ok(error)
        });
    made.map_or_else(|error| error, PyErr::from_value)
}

/// Sets step, time, body and term of a failure as attributes.
pub(crate) fn locate(
    attributes: &Bound<'_, PyDict>,
    failure: &RunFailure,
    body: &str,
) -> PyResult<()> {
    attributes.set_item("step", failure.step)?;
    attributes.set_item("time_ns", failure.time)?;
    attributes.set_item("body", body)?;
    attributes.set_item("term", failure.term)
}

/// Converts a problem of a scene without text.
pub(crate) fn problem(py: Python<'_>, problem: &SceneProblem) -> PyErr {
    let attributes = PyDict::new(py);
    let set = attributes
        .set_item("key", &problem.key)
        .and_then(|()| attributes.set_item("value", &problem.value))
        .and_then(|()| attributes.set_item("rule", &problem.rule));
    match set {
        Ok(()) => raise(py, "SceneError", &problem.to_string(), &attributes),
        Err(error) => error,
    }
}

/// Text of a scene and its file.
#[derive(Debug)]
pub(crate) struct Source {
    pub(crate) text: SceneText,
    /// Path before line and column in messages, with a colon; empty without a file.
    pub(crate) file: String,
}

/// Converts a problem of a scene, with its position in the text if there is one.
pub(crate) fn placed(py: Python<'_>, source: Option<&Source>, found: &SceneProblem) -> PyErr {
    let Some(Source { text, file }) = source else {
        return problem(py, found);
    };
    let error = text.locate(found);
    let attributes = PyDict::new(py);
    let set = attributes
        .set_item("key", &found.key)
        .and_then(|()| attributes.set_item("value", &found.value))
        .and_then(|()| attributes.set_item("rule", &found.rule))
        .and_then(|()| attributes.set_item("line", error.line))
        .and_then(|()| attributes.set_item("column", error.column));
    match set {
        Ok(()) => raise(py, "SceneError", &format!("{file}{error}"), &attributes),
        Err(error) => error,
    }
}

/// Converts all mistakes of a text to an exception about the first.
pub(crate) fn mistakes(py: Python<'_>, source: &Source, first: SceneError) -> PyErr {
    let Source { text, file } = source;
    let mut all = text.mistakes();
    if all.is_empty() {
        all.push(first);
    }
    let lines: Vec<String> = all
        .iter()
        .map(|mistake| format!("{file}{mistake}"))
        .collect();
    let each = all.iter().zip(&lines);
    let each: Vec<PyErr> = each
        .map(|(mistake, line)| of_text(py, text, mistake, line))
        .collect();
    let whole = of_text(py, text, &all[0], &lines.join("\n"));
    let list = PyList::new(py, each.iter().map(|error| error.value(py)));
    match list.and_then(|list| whole.value(py).setattr("mistakes", list)) {
        Ok(()) => whole,
        Err(error) => error,
    }
}

/// Converts an error of bytes that are not text.
pub(crate) fn unread(py: Python<'_>, file: &str, mistake: &SceneError) -> PyErr {
    of_text(
        py,
        &SceneText::new(""),
        mistake,
        &format!("{file}{mistake}"),
    )
}

fn of_text(py: Python<'_>, text: &SceneText, mistake: &SceneError, message: &str) -> PyErr {
    let attributes = PyDict::new(py);
    let set = attributes
        .set_item("key", text.key(mistake))
        .and_then(|()| attributes.set_item("rule", &mistake.message))
        .and_then(|()| attributes.set_item("line", mistake.line))
        .and_then(|()| attributes.set_item("column", mistake.column))
        .and_then(|()| attributes.set_item("meant", mistake.suggestion.as_deref()));
    match set {
        Ok(()) => raise(py, "SceneError", message, &attributes),
        Err(error) => error,
    }
}

/// Converts an error of a run directory.
pub(crate) fn directory(error: &RunDirectoryError) -> PyErr {
    match error {
        RunDirectoryError::Checkpoint(error) => value(error),
        error => PyOSError::new_err(error.to_string()),
    }
}

pub(crate) fn value(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

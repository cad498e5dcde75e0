//! Least-squares fits of Python functions and of linear models.

use crate::arrays::{Block, column, read};
use crate::errors;
use actin_fit::{
    Bounds, Data, FitError, Goodness, LevenbergMarquardt, Mat, Model, Observations, Precision,
    Starts, Status,
};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::PyArithmeticError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::cell::RefCell;

/// A Python function evaluated at all points at once. The variable of a point is its index.
struct Function<'py> {
    of: Bound<'py, PyAny>,
    jacobian: Option<Bound<'py, PyAny>>,
    x: Bound<'py, PyAny>,
    points: usize,
    parameters: usize,
    /// Parameters and values of the last call.
    values: RefCell<(Vec<f64>, Vec<f64>)>,
    /// Parameters and derivatives of the last call, in the order of points.
    derivatives: RefCell<(Vec<f64>, Vec<f64>)>,
    error: RefCell<Option<PyErr>>,
}

/// Relative step of central differences: the cube root of the machine epsilon.
const STEP: f64 = 6e-6;

/// Number of random starts without a given start.
const DRAWN: usize = 8;

/// Relative difference in chi squared within which two minima are considered equal.
const SAME: f64 = 1e-6;

impl<'py> Function<'py> {
    fn new(
        of: Bound<'py, PyAny>,
        jacobian: Option<Bound<'py, PyAny>>,
        x: Bound<'py, PyAny>,
        (points, parameters): (usize, usize),
    ) -> Self {
        Self {
            of,
            jacobian,
            x,
            points,
            parameters,
            values: RefCell::default(),
            derivatives: RefCell::default(),
            error: RefCell::default(),
        }
    }

    fn call(&self, p: &[f64]) -> PyResult<Vec<f64>> {
        let parameters = PyArray1::from_slice(self.x.py(), p);
        let found = self.of.call1((&self.x, parameters))?;
        raw(&found, "the function", &[self.points])
    }

    fn slopes(&self, p: &[f64]) -> PyResult<Vec<f64>> {
        if let Some(jacobian) = &self.jacobian {
            let parameters = PyArray1::from_slice(self.x.py(), p);
            let found = jacobian.call1((&self.x, parameters))?;
            return raw(&found, "the jacobian", &[self.points, self.parameters]);
        }
        let mut all = vec![0.0; self.points * self.parameters];
        for j in 0..self.parameters {
            let h = STEP * p[j].abs().max(STEP);
            let at = |sign: f64| {
                let mut moved = p.to_vec();
                moved[j] += sign * h;
                self.call(&moved).map(|values| (moved[j], values))
            };
            let ((upper, above), (lower, below)) = (at(1.0)?, at(-1.0)?);
            for i in 0..self.points {
                all[i * self.parameters + j] = (above[i] - below[i]) / (upper - lower);
            }
        }
        Ok(all)
    }

    /// Returns the cached or new result; `None` after a Python exception.
    fn cached(
        &self,
        p: &[f64],
        cache: &RefCell<(Vec<f64>, Vec<f64>)>,
        find: impl FnOnce() -> PyResult<Vec<f64>>,
    ) -> bool {
        if self.error.borrow().is_some() {
            return false;
        }
        if cache.borrow().0 != p {
            match find() {
                Ok(found) => *cache.borrow_mut() = (p.to_vec(), found),
                Err(error) => {
                    *self.error.borrow_mut() = Some(error);
                    return false;
                }
            }
        }
        true
    }
}

/// Reads an array of a shape; the numbers need not be finite.
fn raw(object: &Bound<'_, PyAny>, name: &str, shape: &[usize]) -> PyResult<Vec<f64>> {
    let numpy = object.py().import("numpy")?;
    let made = numpy.call_method1("ascontiguousarray", (object, "float64"))?;
    let found: Vec<usize> = made.getattr("shape")?.extract()?;
    if found != shape {
        return Err(errors::value(format!(
            "{name} must return shape {shape:?}, not {found:?}"
        )));
    }
    let flat = made.call_method1("reshape", (-1,))?;
    Ok(flat
        .cast::<PyArray1<f64>>()?
        .readonly()
        .as_slice()?
        .to_vec())
}

/// Converts a variable to the index of its point.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "indices of points are whole numbers"
)]
fn number(x: &[f64]) -> usize {
    x[0] as usize
}

impl Model for Function<'_> {
    fn parameters(&self) -> usize {
        self.parameters
    }

    fn value(&self, x: &[f64], p: &[f64]) -> f64 {
        if self.cached(p, &self.values, || self.call(p)) {
            self.values.borrow().1[number(x)]
        } else {
            f64::NAN
        }
    }

    fn gradient(&self, x: &[f64], p: &[f64], gradient: &mut [f64]) {
        if self.cached(p, &self.derivatives, || self.slopes(p)) {
            let start = number(x) * self.parameters;
            let row = &self.derivatives.borrow().1[start..start + self.parameters];
            gradient.copy_from_slice(row);
        } else {
            gradient.fill(f64::NAN);
        }
    }
}

fn observations(
    y: &Bound<'_, PyAny>,
    deviations: Option<&Bound<'_, PyAny>>,
) -> PyResult<Observations> {
    let (values, _) = read(y, "y", &[None])?;
    let all = Observations::new(&values).map_err(errors::value)?;
    let Some(deviations) = deviations else {
        return Ok(all);
    };
    let deviations = match deviations.extract::<f64>() {
        Ok(one) => vec![one; values.len()],
        Err(_) => read(deviations, "deviations", &[Some(values.len())])?.0,
    };
    all.with_deviations(&deviations).map_err(errors::value)
}

fn refused(error: &FitError) -> PyErr {
    match error {
        FitError::NoConvergence { .. }
        | FitError::NoSingularValues { .. }
        | FitError::Lost { .. } => PyArithmeticError::new_err(error.to_string()),
        _ => errors::value(error),
    }
}

/// Fits `function(x, p)`, an array with the shape of `y`, by the Levenberg-Marquardt method.
///
/// - `start`: initial parameters.
/// - `bounds`: lower and upper bounds of each parameter.
/// - `drawn`: number of random starts between the bounds in addition to `start` (8 without `start`).
/// - `jacobian`: `jacobian(x, p)`, `[points, parameters]`; by default finite differences.
/// - `deviations`: standard deviations of `y`, one or one each.
///
/// Raises `ValueError` for invalid data, `ArithmeticError` if no search converges.
#[pyfunction]
#[pyo3(signature = (function, x, y, start = None, *, bounds = None, deviations = None, jacobian = None, drawn = 0,
    seed = 1))]
#[expect(clippy::too_many_arguments, reason = "keywords in Python")]
pub(crate) fn fit(
    py: Python<'_>,
    function: Bound<'_, PyAny>,
    x: Bound<'_, PyAny>,
    y: &Bound<'_, PyAny>,
    start: Option<&Bound<'_, PyAny>>,
    bounds: Option<Vec<(f64, f64)>>,
    deviations: Option<&Bound<'_, PyAny>>,
    jacobian: Option<Bound<'_, PyAny>>,
    drawn: usize,
    seed: u64,
) -> PyResult<Py<PyAny>> {
    let start = start
        .map(|start| read(start, "start", &[None]))
        .transpose()?;
    let start = start.map(|(start, _)| start);
    let given = start.as_ref().map(Vec::len);
    let given = given.or(bounds.as_ref().map(Vec::len));
    let none = || errors::value("provide a start, or bounds from which to draw starts");
    let parameters = given.ok_or_else(none)?;
    let bounds = match bounds {
        Some(bounds) => Bounds::new(&bounds).map_err(|error| refused(&error))?,
        None => Bounds::none(parameters),
    };
    let starts = match &start {
        Some(start) => Starts::at(start).and_random(drawn, seed),
        None => Starts::random(drawn.max(DRAWN), seed),
    };
    let observed = observations(y, deviations)?;
    let model = Function::new(function, jacobian, x, (observed.len(), parameters));
    let found = search(model, observed, &bounds, &starts)?;
    let statuses = found.statuses.iter().map(|&status| word(status)).collect();
    let agreeing = (found.agreeing_starts(SAME), found.starts.len());
    let quality = (&found.precision, &found.goodness);
    report(py, &found.parameters, quality, (statuses, agreeing))
}

fn word(status: Status) -> &'static str {
    match status {
        Status::Determined => "Determined",
        Status::Weak => "Weak",
        Status::Undetermined => "Undetermined",
        Status::AtLowerBound => "AtLowerBound",
        Status::AtUpperBound => "AtUpperBound",
        Status::Held => "Held",
    }
}

/// Fits a function; an exception that it has raised takes precedence.
fn search(
    model: Function<'_>,
    observed: Observations,
    bounds: &Bounds,
    starts: &Starts,
) -> PyResult<actin_fit::Fit> {
    let numbers: Vec<f64> = (0..observed.len()).map(|i| i as f64).collect();
    let data = Data::new(&numbers, observed).map_err(|error| refused(&error))?;
    let found = LevenbergMarquardt::default().fit(&model, &data, bounds, starts);
    match model.error.into_inner() {
        Some(error) => Err(error),
        None => found.map_err(|error| refused(&error)),
    }
}

/// Fits a linear combination of the columns of `design`, `[points, parameters]`, by QR decomposition.
#[pyfunction]
#[pyo3(signature = (design, y, *, deviations = None))]
pub(crate) fn fit_linear(
    py: Python<'_>,
    design: &Bound<'_, PyAny>,
    y: &Bound<'_, PyAny>,
    deviations: Option<&Bound<'_, PyAny>>,
) -> PyResult<Py<PyAny>> {
    let observed = observations(y, deviations)?;
    let (values, shape) = read(design, "design", &[Some(observed.len()), None])?;
    let columns = shape[1];
    let design = Mat::from_fn(shape[0], columns, |i, j| values[i * columns + j]);
    let found =
        actin_fit::fit_linear(design.as_ref(), &observed).map_err(|error| refused(&error))?;
    let quality = (&found.precision, &found.goodness);
    report(
        py,
        &found.parameters,
        quality,
        (vec!["Determined"; columns], (1, 1)),
    )
}

fn report(
    py: Python<'_>,
    parameters: &[f64],
    (precision, goodness): (&Precision, &Goodness),
    (statuses, (agreeing, starts)): (Vec<&str>, (usize, usize)),
) -> PyResult<Py<PyAny>> {
    let count = parameters.len();
    let errors = (0..count).map(|j| precision.standard_error(j).unwrap_or(f64::NAN));
    let pairs = (0..count).flat_map(|i| (0..count).map(move |j| (i, j)));
    let covariance: Vec<f64> = pairs.map(|(i, j)| precision.covariance[(i, j)]).collect();
    let arguments = PyDict::new(py);
    arguments.set_item("parameters", column(py, parameters.to_vec())?)?;
    arguments.set_item("errors", column(py, errors.collect())?)?;
    arguments.set_item(
        "covariance",
        Block::new(covariance, &[count, count]).into_python(py)?,
    )?;
    arguments.set_item("residuals", column(py, goodness.residuals.clone())?)?;
    arguments.set_item("statuses", statuses)?;
    arguments.set_item("chi_squared", goodness.chi_squared)?;
    arguments.set_item("degrees_of_freedom", goodness.degrees_of_freedom)?;
    arguments.set_item("condition", precision.condition)?;
    arguments.set_item("agreeing_starts", agreeing)?;
    arguments.set_item("starts", starts)?;
    let class = py.import("actin_filaments.results")?.getattr("Fit")?;
    Ok(class.call((), Some(&arguments))?.unbind())
}

//! Loads from a Python function.

use crate::arrays::{Block, read};
use crate::terms::rows;
use actin_mechanics::{
    Coordinates, Interaction, Loads, Matrix3, SecondOrder, State, Stiffness, Vector3, Vectors,
    rotation,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyFloat;
use std::sync::{Arc, Mutex, PoisonError};

/// Step of central differences (rad), and relative to the largest coordinate of a point: the cube root of the
/// machine precision.
const DIFFERENCE: f64 = 6e-6;

/// Blocks of second derivatives, each with the indices of two bodies.
type Blocks = Vec<([usize; 2], Matrix3)>;

/// Result of the function in one state.
struct Evaluated {
    /// Time, positions, velocities, orientations and angular momenta.
    at: Vec<f64>,
    force: Vec<f64>,
    /// Torques (body frame).
    torque: Vec<Vector3>,
    /// Energy, or a function without arguments that returns it.
    energy: Option<Py<PyAny>>,
    stiffness: Option<Blocks>,
}

/// Loads from a Python function of all bodies.
///
/// The function is called once for each state. Exceptions end steps and solves.
pub(crate) struct Callback {
    /// Name of the term.
    name: &'static str,
    function: Py<PyAny>,
    /// `true` if differences of the loads replace a missing stiffness.
    has_differences: bool,
    is_conservative: bool,
    /// Pairs of bodies with stiffness blocks, which are the same in all states.
    pairs: Option<Vec<[usize; 2]>>,
    last: Mutex<Option<Evaluated>>,
    error: Arc<Mutex<Option<PyErr>>>,
}

impl std::fmt::Debug for Callback {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Callback").finish_non_exhaustive()
    }
}

impl Callback {
    /// Creates the term from `force(position)`, both `[n, 3]`, and `energy(position)`. Exceptions are stored in
    /// `error`.
    pub(crate) fn of_positions(
        py: Python<'_>,
        (force, energy): (Py<PyAny>, Option<Py<PyAny>>),
        has_differences: bool,
        error: Arc<Mutex<Option<PyErr>>>,
    ) -> PyResult<Self> {
        let is_conservative = energy.is_some();
        let module = py.import("actin_filaments._loads")?;
        let function = module.call_method1("of_positions", (force, energy))?;
        Ok(Self {
            name: "field",
            function: function.unbind(),
            has_differences,
            is_conservative,
            pairs: None,
            last: Mutex::default(),
            error,
        })
    }

    /// Creates the term from `function(bodies)`, which is called in the present state to read whether it returns an
    /// energy and stiffness blocks.
    pub(crate) fn new(
        py: Python<'_>,
        name: &'static str,
        function: Py<PyAny>,
        has_differences: bool,
        state: &State,
        error: Arc<Mutex<Option<PyErr>>>,
    ) -> PyResult<Self> {
        let mut made = Self {
            name,
            function,
            has_differences,
            is_conservative: false,
            pairs: None,
            last: Mutex::default(),
            error,
        };
        let first = made.evaluate(py, state)?;
        made.is_conservative = first.energy.is_some();
        made.pairs = first.stiffness.as_deref().map(pairs);
        *made.last() = Some(first);
        Ok(made)
    }

    /// Returns what an equilibrium requires and the function does not return.
    pub(crate) fn lacks(&self) -> Option<&'static str> {
        if !self.is_conservative {
            return Some(
                "the function of a field returns no energy, which an equilibrium requires",
            );
        }
        self.second_order().is_none().then_some(
            "the function of a field returns no stiffness: return the blocks, or add it with differences=True, which \
             calls the function six times for each body and iteration",
        )
    }

    fn last(&self) -> std::sync::MutexGuard<'_, Option<Evaluated>> {
        self.last.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn note(&self, error: PyErr) {
        let mut first = self.error.lock().unwrap_or_else(PoisonError::into_inner);
        first.get_or_insert(error);
    }

    /// Uses the result in a state. The function is called without holding the lock, since it may release the
    /// interpreter.
    fn with<T>(
        &self,
        state: &State,
        used: impl FnOnce(Python<'_>, &Evaluated) -> PyResult<T>,
    ) -> Option<T> {
        let is_same = |last: &Evaluated| numbers(state).eq(last.at.iter().copied());
        let known = self.last().take().filter(is_same);
        let found = Python::attach(|py| {
            let evaluated = known.map_or_else(|| self.evaluate(py, state), Ok)?;
            let result = used(py, &evaluated)?;
            *self.last() = Some(evaluated);
            Ok(result)
        });
        found.map_err(|error| self.note(error)).ok()
    }

    fn evaluate(&self, py: Python<'_>, state: &State) -> PyResult<Evaluated> {
        let module = py.import("actin_filaments._loads")?;
        let result = self.function.bind(py).call1((bodies(&module, state)?,))?;
        let loads = module.call_method1("to_loads", (result,))?;
        let given = |name: &str| -> PyResult<Option<Bound<'_, PyAny>>> {
            Ok(Some(loads.getattr(name)?).filter(|value| !value.is_none()))
        };
        let (points, frames) = (state.points.len(), state.frames.len());
        let values = |name: &str, count: usize| match given(name)? {
            None => Ok(vec![0.0; 3 * count]),
            Some(values) => {
                let shape = [Some(count), Some(3)];
                read(&values, &format!("the {name} of a field"), &shape).map(|(values, _)| values)
            }
        };
        let torque = values("torque", frames)?;
        let torque = torque.chunks_exact(3).enumerate().map(|(i, t)| {
            let q = state.frames.orientation.get(i);
            q.inverse_transform_vector(&Vector3::new(t[0], t[1], t[2]))
        });
        let stiffness = given("stiffness")?.map(|given| blocks(&given, points + frames));
        Ok(Evaluated {
            at: numbers(state).collect(),
            force: values("force", points)?,
            torque: torque.collect(),
            energy: given("energy")?.map(Bound::unbind),
            stiffness: stiffness.transpose()?,
        })
    }

    /// Pushes the blocks that the function returns.
    fn add_given(&self, state: &State, stiffness: &mut Stiffness, expected: &[[usize; 2]]) {
        let coordinates = coordinates(state);
        self.with(state, |_, evaluated| {
            let given = evaluated.stiffness.as_deref().unwrap_or_default();
            if pairs(given) != expected {
                let rule = "the stiffness of a field must have blocks for the same pairs of bodies in all states";
                return Err(PyValueError::new_err(rule));
            }
            for ([a, b], block) in given {
                stiffness.push(coordinates[*a], coordinates[*b], *block);
            }
            Ok(())
        });
    }

    /// Pushes central differences of the loads for all pairs of bodies.
    fn add_differences(&self, state: &State, stiffness: &mut Stiffness) {
        let coordinates = coordinates(state);
        let largest = state.points.position.iter().map(|x| x.amax());
        let length = largest.fold(0.0, f64::max);
        let length = DIFFERENCE * if length > 0.0 { length } else { 1.0 };
        let mut moved = state.clone();
        let mut columns = Vec::with_capacity(3 * coordinates.len());
        for &body in &coordinates {
            for axis in 0..3 {
                let step = match body {
                    Coordinates::Point(_) => length,
                    Coordinates::Frame(_) => DIFFERENCE,
                };
                let ends = [step, -step].map(|step| {
                    displace(&mut moved, state, body, Vector3::ith(axis, step));
                    self.with(&moved, |_, evaluated| Ok(evaluated.all()))
                });
                displace(&mut moved, state, body, Vector3::zeros());
                let [Some(plus), Some(minus)] = ends else {
                    return;
                };
                let slopes = plus.iter().zip(&minus).map(|(p, m)| (m - p) / (2.0 * step));
                columns.push(slopes.collect::<Vec<Vector3>>());
            }
        }
        let derivative = |a: usize, b: usize| {
            Matrix3::from_columns(&[0, 1, 2].map(|axis| columns[3 * b + axis][a]))
        };
        for a in 0..coordinates.len() {
            for b in a..coordinates.len() {
                let block = (derivative(a, b) + derivative(b, a).transpose()) * 0.5;
                stiffness.push(coordinates[a], coordinates[b], block);
            }
        }
    }
}

impl Evaluated {
    /// Forces, then torques.
    fn all(&self) -> Vec<Vector3> {
        let forces = self.force.chunks_exact(3).map(Vector3::from_column_slice);
        forces.chain(self.torque.iter().copied()).collect()
    }
}

/// Moves one body from its place in `state`.
fn displace(moved: &mut State, state: &State, body: Coordinates, by: Vector3) {
    match body {
        Coordinates::Point(i) => {
            let place = state.points.position.get(i) + by;
            moved.points.position.set(i, place);
        }
        Coordinates::Frame(i) => {
            let turned = state.frames.orientation.get(i) * rotation::exp(by);
            moved.frames.orientation.set(i, turned);
        }
    }
}

/// Points, then frames.
fn coordinates(state: &State) -> Vec<Coordinates> {
    let points = (0..state.points.len()).map(Coordinates::Point);
    let frames = (0..state.frames.len()).map(Coordinates::Frame);
    points.chain(frames).collect()
}

fn pairs(blocks: &[([usize; 2], Matrix3)]) -> Vec<[usize; 2]> {
    blocks.iter().map(|(pair, _)| *pair).collect()
}

/// Time and motion of all bodies, which identify a state.
fn numbers(state: &State) -> impl Iterator<Item = f64> + '_ {
    let (points, frames) = (&state.points, &state.frames);
    let vectors = [&points.position, &points.velocity, &frames.angular_momentum];
    let vectors = vectors.into_iter().flat_map(Vectors::iter);
    let turns = frames.orientation.iter().flat_map(|q| [q.w, q.i, q.j, q.k]);
    let all = vectors.flat_map(|v| [v.x, v.y, v.z]).chain(turns);
    std::iter::once(state.time).chain(all)
}

/// Creates the argument of the function.
fn bodies<'py>(module: &Bound<'py, PyModule>, state: &State) -> PyResult<Bound<'py, PyAny>> {
    let py = module.py();
    let turns = state.frames.orientation.iter();
    let turns = turns.flat_map(|q| [q.w, q.i, q.j, q.k]).collect();
    let turns = Block::new(turns, &[state.frames.len(), 4]).into_python(py)?;
    module.getattr("Bodies")?.call1((
        state.time,
        rows(py, &state.points.position)?,
        rows(py, &state.points.velocity)?,
        turns,
        rows(py, &state.frames.angular_momentum)?,
    ))
}

/// Reads `(a, b, blocks)`, arrays of indices and `[k, 3, 3]`.
fn blocks(given: &Bound<'_, PyAny>, bodies: usize) -> PyResult<Blocks> {
    let rule = "the stiffness of a field must be (a, b, blocks): two lists of bodies and an array [k, 3, 3]";
    let (a, b, blocks): (Vec<usize>, Vec<usize>, Bound<'_, PyAny>) =
        given.extract().map_err(|_| PyValueError::new_err(rule))?;
    let shape = [Some(a.len()), Some(3), Some(3)];
    let (values, _) = read(&blocks, "the stiffness of a field", &shape)?;
    if a.len() != b.len() {
        return Err(PyValueError::new_err(rule));
    }
    if let Some(body) = a.iter().chain(&b).find(|body| **body >= bodies) {
        return Err(PyValueError::new_err(format!(
            "the stiffness of a field has a block of body {body}, but there are {bodies} points and frames"
        )));
    }
    let blocks = values.chunks_exact(9).map(Matrix3::from_row_slice);
    Ok(a.into_iter()
        .zip(b)
        .map(|(a, b)| [a, b])
        .zip(blocks)
        .collect())
}

impl Interaction for Callback {
    fn term(&self) -> &'static str {
        self.name
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        self.with(state, |_, evaluated| {
            for (i, f) in evaluated.force.chunks_exact(3).enumerate() {
                loads.force.add(i, Vector3::new(f[0], f[1], f[2]));
            }
            for (i, torque) in evaluated.torque.iter().enumerate() {
                loads.torque.add(i, *torque);
            }
            Ok(())
        });
    }

    fn elements(&self) -> usize {
        1
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        energies[0] = 0.0;
        if !self.is_conservative {
            return;
        }
        let energy = self.with(state, |py, evaluated| match &evaluated.energy {
            None => Err(PyValueError::new_err(
                "a field must return its energy in all states or in none",
            )),
            Some(energy) if energy.bind(py).is_callable() => energy.call0(py)?.extract(py),
            Some(energy) => energy
                .bind(py)
                .call_method0("__float__")?
                .cast::<PyFloat>()?
                .extract(),
        });
        energies[0] = energy.unwrap_or(0.0);
    }

    fn is_conservative(&self) -> bool {
        self.is_conservative
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        (self.has_differences || self.pairs.is_some()).then_some(self)
    }
}

impl SecondOrder for Callback {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        match &self.pairs {
            Some(pairs) => self.add_given(state, stiffness, pairs),
            None => self.add_differences(state, stiffness),
        }
    }
}

//! Time steps and equilibria of a `System`.

use crate::errors;
use crate::system::{Clock, System};
use crate::watch::Watch;
use actin_equilibrium::{
    Equilibrium, Layout, Newton, NewtonFailure, NewtonOptions, Residual, SolveError,
};
use actin_integrate::{
    Bath, Composition, Drag, Moment, Observer, Pause, Run, RunFailure, Stepper, largest_frequency,
    stable_step,
};
use actin_mechanics::State;
use actin_sim::{Task, solver};
use pyo3::exceptions::{PyArithmeticError, PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, PoisonError};

/// Ends the steps after a signal or an exception of a Python callback.
struct InterruptObserver {
    watch: Watch,
    raised: Arc<Mutex<Option<PyErr>>>,
}

impl InterruptObserver {
    fn has_raised(&self) -> bool {
        let raised = self.raised.lock();
        raised.unwrap_or_else(PoisonError::into_inner).is_some()
    }
}

impl Observer for InterruptObserver {
    fn observe(&mut self, _moment: &mut Moment<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn pause(&mut self, _pause: &Pause<'_>) -> ControlFlow<()> {
        if self.has_raised() || self.watch.is_interrupted() {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}

#[pymethods]
impl System {
    /// Makes time steps of length `h`, by default half the longest stable time step.
    ///
    /// - `scheme`: splitting method.
    /// - `drag`: damping rates of velocities and of angular momenta.
    /// - `thermal_energy`: k T of the noise that balances the drag; `seed` is 1 by default.
    ///
    /// Settings are kept for later calls. The default `h` is estimated again after bodies, terms or clamps have
    /// been added and after `scheme` has changed. `step(a)` and `step(b)` together equal `step(a + b)` bitwise.
    /// Ctrl-C ends the steps. For a `Brownian` scene, `h` is the only setting: fluid and noise are those of the scene.
    ///
    /// Raises `RunFailed` if the motion diverges. The system then is in the last valid state, at `steps` and
    /// `time`.
    #[pyo3(signature = (number = 1, *, h = None, scheme = None, drag = None, thermal_energy = None, seed = None))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn step(
        &mut self,
        py: Python<'_>,
        number: u64,
        h: Option<f64>,
        scheme: Option<&str>,
        drag: Option<[f64; 2]>,
        thermal_energy: Option<f64>,
        seed: Option<u64>,
    ) -> PyResult<()> {
        let has_settings = scheme.is_some() || drag.is_some() || thermal_energy.is_some();
        if self.is_overdamped() && (has_settings || seed.is_some()) {
            let rule =
                "scheme, drag, thermal_energy and seed of a Brownian scene are set in its task";
            return Err(PyValueError::new_err(rule));
        }
        self.settings.drag = drag.unwrap_or(self.settings.drag);
        if let Some(energy) = thermal_energy {
            self.settings.thermal_energy = (energy > 0.0).then_some(energy);
        }
        self.settings.seed = seed.unwrap_or(self.settings.seed);
        self.settings.scheme = self.scheme(scheme)?;
        self.settings.step = h.or(self.settings.step);
        let h = self.settings.step.map_or_else(|| self.default_step(), Ok)?;
        let run = self.plan(h, number)?;
        let mut looker = InterruptObserver {
            watch: Watch::new(None),
            raised: Arc::clone(&self.error),
        };
        self.prepare_stepper()?;
        let (mechanics, stepper) = (&mut self.mechanics, &mut self.stepper);
        let ended = py.detach(|| {
            let stepper = stepper.as_mut().map(|own| own as &mut dyn Stepper);
            run.execute_from(None, stepper, mechanics, &mut [&mut looker])
        });
        match ended {
            Ok(outcome) => {
                self.clock.steps += outcome.steps;
                self.raise()?;
                looker.watch.into_error().map_or(Ok(()), Err)
            }
            Err(failure) => {
                self.clock.steps = failure.last_good_step;
                self.raise()?;
                Err(self.failed(py, &failure))
            }
        }
    }

    /// Returns the longest stable time step of a method at the current stiffness, times `safety`.
    #[pyo3(signature = (scheme = None, safety = actin_integrate::SAFETY))]
    fn stable_step(&self, scheme: Option<&str>, safety: f64) -> PyResult<f64> {
        let scheme = self.scheme(scheme)?;
        let frequency = largest_frequency(&self.mechanics);
        self.raise()?;
        let frequency = frequency.map_err(errors::value)?;
        stable_step(scheme, frequency, safety).map_err(errors::value)
    }

    /// Moves the system to a nearby stable equilibrium by Newton's method, and sets velocities to zero.
    ///
    /// - `force`, `torque`: tolerances of the residual on free bodies.
    /// - `turn_length`: displacement that counts as much as a rotation of 1 rad.
    ///
    /// A scene with the task `Equilibrium` uses its own settings. Raises `RunFailed`.
    #[pyo3(signature = (*, force = 1e-8, torque = 1e-8, iterations = 2000, turn_length = 1.0))]
    fn equilibrium(
        &mut self,
        py: Python<'_>,
        force: f64,
        torque: f64,
        iterations: usize,
        turn_length: f64,
    ) -> PyResult<Py<PyAny>> {
        let options = NewtonOptions {
            tolerance: Residual { force, torque },
            iterations,
            turn_length,
            ..NewtonOptions::default()
        };
        if let Some(rule) = self.missing_for_equilibrium() {
            return Err(PyValueError::new_err(rule));
        }
        let mut newton = self.newton(options)?;
        let saddles = self.settings_of_equilibrium().map_or_else(
            || actin_sim::Equilibrium::default().leave_saddles,
            |settings| settings.leave_saddles,
        );
        let mut state = self.state().clone();
        let mut watch = Watch::new(None);
        let interactions = self.mechanics.interactions();
        let solved = py.detach(|| {
            newton.minimize_observed(&mut state, interactions, saddles, &mut |_| {
                if watch.is_interrupted() {
                    return ControlFlow::Break(());
                }
                ControlFlow::Continue(())
            })
        });
        self.raise()?;
        state.stop();
        self.mechanics.state_mut().copy_motion_from(&state);
        match solved {
            Ok(found) => certificate(py, &found),
            Err(failure) => Err(unsolved(py, &failure, watch.into_error())),
        }
    }
}

pub(crate) fn read_scheme(name: &str) -> PyResult<&'static Composition> {
    Composition::by_name(name).map_err(errors::value)
}

impl System {
    /// Returns the method with a name, or the current one.
    fn scheme(&self, name: Option<&str>) -> PyResult<&'static Composition> {
        name.map_or(Ok(self.settings.scheme), read_scheme)
    }

    /// Returns `true` if the system has only the bodies of its scene.
    pub(crate) fn has_bodies_of_scene(&self) -> bool {
        let count = |state: &State| (state.points.len(), state.frames.len());
        let assembly = self.assembly.as_ref();
        assembly.is_some_and(|built| count(built.system.state()) == count(self.state()))
    }

    fn is_overdamped(&self) -> bool {
        let assembly = self.assembly.as_ref();
        assembly.is_some_and(|assembly| matches!(assembly.scene.task, Task::Brownian(_)))
    }

    /// Creates the stepper of overdamped motion, if the scene needs one and there is none.
    fn prepare_stepper(&mut self) -> PyResult<()> {
        let (Some(assembly), Some(estimate), None) =
            (&self.assembly, &self.estimate, &self.stepper)
        else {
            return Ok(());
        };
        if self.is_overdamped() && !self.has_bodies_of_scene() {
            return Err(PyValueError::new_err(
                "bodies that were added to a Brownian scene have no friction: add them to the scene",
            ));
        }
        let stepper = estimate.overdamped_stepper(assembly, &self.mechanics);
        self.stepper = stepper.transpose().map_err(errors::value)?;
        Ok(())
    }

    /// Plans `number` steps of length `h`.
    fn plan(&mut self, h: f64, number: u64) -> PyResult<Run> {
        let [translational, rotational] = self.settings.drag;
        let drag = Drag::new(translational, rotational).map_err(errors::value)?;
        let run = Run::new(self.settings.scheme, h, number).map_err(errors::value)?;
        self.clock.set_step(h);
        let Clock { steps, offset, .. } = self.clock;
        let run = run.continuing_from(steps).with_time_offset(offset);
        if self.is_overdamped() {
            // Long steps could let filaments pass through each other within a few steps.
            return run.checking_every(1).map_err(errors::value);
        }
        match self.settings.thermal_energy {
            None => Ok(run.with_drag(drag).without_merged_steps()),
            Some(energy) => {
                let bath = Bath::new(drag, energy, self.settings.seed).map_err(errors::value)?;
                Ok(run.with_bath(bath))
            }
        }
    }

    /// Returns the default time step, estimated if necessary.
    fn default_step(&mut self) -> PyResult<f64> {
        let scheme = self.settings.scheme;
        let known = self.settings.estimated.filter(|(of, _)| *of == scheme);
        let step = match known {
            Some((_, step)) => step,
            None => self.stable_step(None, actin_integrate::SAFETY)?,
        };
        self.settings.estimated = Some((scheme, step));
        Ok(step)
    }

    /// Returns the settings of the scene, if its task is an equilibrium.
    fn settings_of_equilibrium(&self) -> Option<&actin_sim::Equilibrium> {
        match &self.assembly.as_ref()?.scene.task {
            Task::Equilibrium(settings) => Some(settings),
            _ => None,
        }
    }

    /// Creates the solver for the free bodies.
    fn newton(&self, options: NewtonOptions) -> PyResult<Newton> {
        if let (Some(assembly), Some(settings)) = (&self.assembly, self.settings_of_equilibrium())
            && self.state().points.len() == assembly.points.len()
        {
            return solver(assembly, settings).map_err(errors::value);
        }
        Newton::new(Layout::free(self.state()), options).map_err(errors::value)
    }

    /// Returns the exception for a failed step.
    fn failed(&self, py: Python<'_>, failure: &RunFailure) -> PyErr {
        let body = match &self.assembly {
            Some(assembly) => assembly.describe(failure.body),
            None => failure.body.to_string(),
        };
        let attributes = PyDict::new(py);
        match errors::locate(&attributes, failure, &body) {
            Ok(()) => errors::raise(py, "RunFailed", &failure.to_string(), &attributes),
            Err(error) => error,
        }
    }
}

/// Converts the certificate of an equilibrium.
fn certificate(py: Python<'_>, found: &Equilibrium) -> PyResult<Py<PyAny>> {
    let Some(counts) = found.certificate else {
        return Err(PyValueError::new_err("the equilibrium has no certificate"));
    };
    let arguments = PyDict::new(py);
    arguments.set_item("negative_eigenvalues", counts.negative)?;
    arguments.set_item("unresolved_eigenvalues", counts.unresolved)?;
    arguments.set_item("resolution", counts.resolution)?;
    arguments.set_item("residual_force", found.residual.force)?;
    arguments.set_item("residual_torque", found.residual.torque)?;
    arguments.set_item("iterations", found.work.iterations)?;
    let class = py
        .import("actin_filaments.results")?
        .getattr("Certificate")?;
    Ok(class.call((), Some(&arguments))?.unbind())
}

/// Returns the exception for a failed or interrupted solve.
fn unsolved(py: Python<'_>, failure: &NewtonFailure, interrupted: Option<PyErr>) -> PyErr {
    match (&failure.cause, interrupted) {
        (SolveError::Interrupted, Some(error)) => error,
        (SolveError::Interrupted, None) => PyKeyboardInterrupt::new_err("interrupted"),
        _ => {
            let attributes = PyDict::new(py);
            let message = failure.to_string();
            match attributes.set_item("step", failure.history.len()) {
                Ok(()) => errors::raise(py, "RunFailed", &message, &attributes),
                Err(_) => PyArithmeticError::new_err(message),
            }
        }
    }
}

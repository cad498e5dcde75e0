//! `System`: bodies and interactions assembled by hand or from a scene. `advance.rs` contains time steps and
//! equilibria.

use crate::arrays::{read, vector, vectors};
use crate::callback::Callback;
use crate::driven::{Motion, Motions, along_path};
use crate::errors;
use crate::rod::{Rod, RodArguments};
use crate::scene::Scene;
use crate::terms::{Applied, Term};
use actin_brownian::Brownian;
use actin_integrate::Composition;
use actin_mechanics::{
    ControlId, Drive, Interaction, Point, PointLoad, Slider, State, System as Mechanics, Vector3,
    Weight,
};
use actin_sim::{Assembly, Estimate, Plan, Task};
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex};

/// Default settings of time steps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Settings {
    pub(crate) scheme: &'static Composition,
    /// Time step as set by the caller or the scene.
    pub(crate) step: Option<f64>,
    /// Default time step with its scheme; `None` until it is needed, and after bodies, terms or clamps have changed.
    pub(crate) estimated: Option<(&'static Composition, f64)>,
    /// Damping rates, translational and rotational.
    pub(crate) drag: [f64; 2],
    /// Thermal energy; `None` without noise.
    pub(crate) thermal_energy: Option<f64>,
    pub(crate) seed: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            scheme: &actin_integrate::PEFRL,
            step: None,
            estimated: None,
            drag: [0.0; 2],
            thermal_energy: None,
            seed: 1,
        }
    }
}

/// Number of steps and time.
///
/// The time is a product instead of a sum, so that it does not depend on the number of calls.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Clock {
    pub(crate) steps: u64,
    /// Length of the current steps.
    h: f64,
    /// Time of step 0 extrapolated with the current step length.
    pub(crate) offset: f64,
}

impl Clock {
    pub(crate) fn time(&self) -> f64 {
        self.offset + self.steps as f64 * self.h
    }

    /// Changes the step length.
    pub(crate) fn set_step(&mut self, h: f64) {
        // Before the first step, the time is 0.
        if self.steps > 0 && h.to_bits() != self.h.to_bits() {
            self.offset = self.time() - self.steps as f64 * h;
        }
        self.h = h;
    }
}

/// Points, frames and interactions that are assembled and advanced step by step.
///
/// Points have positions `[n, 3]` and velocities; frames have orientations `[m, 4]` (w, x, y, z; body to lab)
/// and angular momenta (body frame). Any consistent units can be used; scenes use nm, pN and ns. Arrays are
/// read-only copies: assign a whole array to change the state.
#[pyclass(module = "actin_filaments")]
#[derive(Debug)]
pub(crate) struct System {
    pub(crate) mechanics: Mechanics,
    pub(crate) terms: BTreeMap<usize, Term>,
    pub(crate) applied: Arc<Applied>,
    pub(crate) motions: Motions,
    pub(crate) settings: Settings,
    /// Scene that the system was created from.
    pub(crate) assembly: Option<Arc<Assembly>>,
    pub(crate) scene: Option<Arc<Py<Scene>>>,
    /// Controls of the loads added here or of the loads of the scene.
    pub(crate) factors: Vec<ControlId>,
    pub(crate) clock: Clock,
    /// Exception of a Python callback during a step.
    pub(crate) error: Arc<Mutex<Option<PyErr>>>,
    /// Terms of Python functions, by number.
    pub(crate) callbacks: BTreeMap<usize, Arc<Callback>>,
    /// Numbers of terms that can be removed.
    pub(crate) removable: BTreeSet<usize>,
    /// Time step of the scene.
    pub(crate) estimate: Option<Estimate>,
    /// Stepper of overdamped motion, once it has been used.
    pub(crate) stepper: Option<Brownian>,
}

impl System {
    fn from_parts(state: State, terms: Vec<Term>) -> Self {
        let applied = Arc::new(Applied::default());
        let terms = terms.into_iter().chain([Term::Applied(applied.clone())]);
        let mut system = Self {
            mechanics: Mechanics::new(State::default(), Vec::new()),
            terms: terms.enumerate().collect(),
            applied,
            motions: Motions::default(),
            settings: Settings::default(),
            assembly: None,
            scene: None,
            factors: Vec::new(),
            clock: Clock::default(),
            error: Arc::default(),
            callbacks: BTreeMap::new(),
            removable: BTreeSet::new(),
            estimate: None,
            stepper: None,
        };
        system.renew(state);
        system
    }

    /// Replaces the state, which can have more bodies, and keeps the terms.
    pub(crate) fn renew(&mut self, state: State) {
        let terms = self.terms.values().cloned();
        let terms = terms.map(|term| -> Box<dyn Interaction> { Box::new(term) });
        let time = state.time;
        self.mechanics = Mechanics::new(state, terms.collect());
        self.settings.estimated = None;
        self.stepper = None;
        if !self.motions.is_empty() {
            self.mechanics.set_drive(Box::new(self.motions.clone()));
            let state = self.mechanics.state_mut();
            state.time = time;
            self.motions.place(state, time);
        }
    }

    /// Adds a term; returns its number.
    pub(crate) fn push(&mut self, term: Term) -> usize {
        let number = self.terms.last_key_value().map_or(0, |(last, _)| last + 1);
        self.terms.insert(number, term);
        number
    }

    /// Adds a term that `make` creates for the state.
    fn add<T>(
        &mut self,
        make: impl FnOnce(&mut State) -> PyResult<(Option<Term>, T)>,
    ) -> PyResult<T> {
        let mut state = self.mechanics.state().clone();
        let (term, made) = make(&mut state)?;
        if let Some(term) = term {
            self.push(term);
        }
        self.renew(state);
        Ok(made)
    }

    pub(crate) fn state(&self) -> &State {
        self.mechanics.state()
    }

    pub(crate) fn point(&self, i: usize) -> PyResult<usize> {
        let count = self.state().points.len();
        let error = || PyIndexError::new_err(format!("there are {count} points, but no point {i}"));
        if i < count { Ok(i) } else { Err(error()) }
    }

    pub(crate) fn frame(&self, i: usize) -> PyResult<usize> {
        let count = self.state().frames.len();
        let error = || PyIndexError::new_err(format!("there are {count} frames, but no frame {i}"));
        if i < count { Ok(i) } else { Err(error()) }
    }
}

fn settings_of(assembly: &Assembly, estimate: Option<&Estimate>) -> PyResult<Settings> {
    let step = estimate.map(|estimate| estimate.time_step_ns);
    match &assembly.scene.task {
        Task::Equilibrium(_) => Ok(Settings::default()),
        Task::Dynamics(task) if task.drag.fluid().is_none() => {
            let scheme = actin_sim::composition(task.integrator);
            let is_set = task.time_step_ns.is_some();
            Ok(Settings {
                scheme,
                step: step.filter(|_| is_set),
                estimated: step.map(|step| (scheme, step)),
                drag: task.drag.rates().into(),
                thermal_energy: task.thermal.map(|thermal| thermal.energy_pn_nm()),
                seed: task.thermal.map_or(1, |thermal| thermal.seed),
            })
        }
        Task::Brownian(task) => Ok(Settings {
            step,
            seed: task.seed,
            ..Settings::default()
        }),
        Task::Dynamics(_) => Err(PyValueError::new_err(
            "a System supports the fluid of Brownian, not of Dynamics: use run",
        )),
    }
}

fn read_times(times: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    let (times, _) = read(times, "times", &[None])?;
    let ascend = times.windows(2).all(|pair| pair[0] < pair[1]);
    if times.len() < 2 || times[0] != 0.0 || !ascend {
        let rule = "times must ascend from 0, and at least two are required";
        return Err(PyValueError::new_err(rule));
    }
    Ok(times)
}

/// Reads a vector for each time, by default zero.
fn read_along(
    object: Option<&Bound<'_, PyAny>>,
    name: &str,
    times: usize,
) -> PyResult<Vec<Vector3>> {
    let Some(object) = object else {
        return Ok(vec![Vector3::zeros(); times]);
    };
    let (values, _) = read(object, name, &[Some(times), Some(3)])?;
    let rows = values.chunks_exact(3);
    Ok(rows.map(Vector3::from_column_slice).collect())
}

#[pymethods]
impl System {
    #[new]
    fn new() -> Self {
        Self::from_parts(State::default(), Vec::new())
    }

    /// Creates the system of a scene in its initial state, with the method, time step, drag and noise of its task.
    ///
    /// In a motion, steps follow load factors over time and the path of the scene. For equilibria, `set_path` moves
    /// along the path. Steps of a `Brownian` scene have its fluid and its noise.
    #[staticmethod]
    pub(crate) fn from_scene(py: Python<'_>, scene: &Bound<'_, Scene>) -> PyResult<Self> {
        let source = scene.clone().unbind();
        let scene = scene.get();
        let assembly = scene.build(py)?;
        let refused = |key: &str, rule: &str| {
            Err(errors::problem(
                py,
                &actin_sim::SceneProblem::new(key, "", rule),
            ))
        };
        if assembly.scene.filament.sections.following().is_some() {
            let rule = "time-dependent sections are supported by `actin run` only";
            return refused("filament.sections", rule);
        }
        let mut linkers = assembly.scene.linkers.iter();
        if linkers.any(|linker| linker.kinetics.is_some()) {
            return refused("linkers", "kinetics are supported by actin.run only");
        }
        let plan = py.detach(|| Plan::new(&assembly));
        let plan = plan.map_err(|problem| scene.refuse(py, &problem))?;
        let estimate = plan.estimate().copied();
        let settings = settings_of(&assembly, estimate.as_ref())?;
        let count = assembly.system.interactions().len();
        let terms = (0..count).map(|i| Term::OfScene(Arc::clone(&assembly), i));
        let mut system = Self::from_parts(assembly.system.state().clone(), terms.collect());
        if !matches!(assembly.scene.task, Task::Equilibrium(_)) {
            system.motions.of_scene = assembly.drive_in_time().map(Arc::from);
            system.renew(assembly.system.state().clone());
        }
        system.settings = settings;
        system.estimate = estimate;
        system.factors = assembly.load_controls().to_vec();
        system.assembly = Some(assembly);
        system.scene = Some(Arc::new(source));
        Ok(system)
    }

    /// Adds points `[k, 3]` at rest, with one mass for all or one each. Returns the index of the first.
    fn add_points(
        &mut self,
        position: &Bound<'_, PyAny>,
        mass: &Bound<'_, PyAny>,
    ) -> PyResult<usize> {
        let places = vectors(position, "position")?;
        let masses = match mass.extract::<f64>() {
            Ok(mass) => vec![mass; places.len()],
            Err(_) => read(mass, "mass", &[Some(places.len())])?.0,
        };
        if let Some(mass) = masses.iter().find(|m| !(m.is_normal() && **m > 0.0)) {
            return Err(PyValueError::new_err(format!(
                "mass must be positive, not {mass}"
            )));
        }
        self.add(|state| {
            let first = state.points.len();
            for (place, mass) in places.into_iter().zip(masses) {
                let position = place.into();
                state.points.push(Point { position, mass });
            }
            Ok((None, first))
        })
    }

    /// Adds a Cosserat rod along nodes `[k + 1, 3]`, with k segments and a frame on each.
    ///
    /// - `shear`: rigidities S1, S2 (shear) and S3 (stretch), in units of force.
    /// - `bend`: rigidities B1, B2 (bending) and B3 (twist), in units of force times area.
    /// - `lengths`: rest lengths of segments; by default the distances between nodes.
    /// - `normal`: approximate direction of the first axis of the first frame, which is transported along the nodes
    ///   without twist.
    /// - `rest_shape`: `"placed"` makes the given shape stress-free.
    /// - `rigid_segments`: adds the rotational inertia of rigid segments, which allows longer time steps.
    #[pyo3(signature = (
        nodes, *, shear, bend, mass_per_length, area, lengths = None, normal = None, start = None, end = None,
        rest_shape = "straight", rigid_segments = false,
    ))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn add_rod(
        &mut self,
        nodes: &Bound<'_, PyAny>,
        shear: &Bound<'_, PyAny>,
        bend: &Bound<'_, PyAny>,
        mass_per_length: f64,
        area: f64,
        lengths: Option<&Bound<'_, PyAny>>,
        normal: Option<&Bound<'_, PyAny>>,
        start: Option<&str>,
        end: Option<&str>,
        rest_shape: &str,
        rigid_segments: bool,
    ) -> PyResult<Rod> {
        let arguments = RodArguments {
            nodes: vectors(nodes, "nodes")?,
            shear: vector(shear, "shear")?,
            bend: vector(bend, "bend")?,
            section: [mass_per_length, area],
            lengths: lengths
                .map(|lengths| read(lengths, "lengths", &[None]).map(|(values, _)| values))
                .transpose()?,
            normal: normal.map(|normal| vector(normal, "normal")).transpose()?,
            clamps: [start, end],
            rest_shape,
            rigid_segments,
        };
        self.add(|state| arguments.put(state))
    }

    /// Adds the weight of all points. Returns the index of its factor.
    fn add_weight(&mut self, acceleration: &Bound<'_, PyAny>) -> PyResult<usize> {
        let acceleration = vector(acceleration, "acceleration")?;
        let control = self.add(|state| {
            let weight = Weight::new(state, acceleration.into()).map_err(errors::value)?;
            let control = weight.control();
            Ok((Some(Term::Own(Arc::new(weight))), control))
        })?;
        self.factors.push(control);
        Ok(self.factors.len() - 1)
    }

    /// Adds a force of constant direction, divided equally among points. Returns the index of its factor.
    fn add_force(&mut self, points: Vec<usize>, force: &Bound<'_, PyAny>) -> PyResult<usize> {
        let force = vector(force, "force")?;
        if points.is_empty() {
            return Err(PyValueError::new_err("points must name at least one"));
        }
        points.iter().try_for_each(|&i| self.point(i).map(drop))?;
        let control = self.add(|state| {
            let load = PointLoad::shared(state, &points, force.into()).map_err(errors::value)?;
            let control = load.control();
            Ok((Some(Term::Own(Arc::new(load))), control))
        })?;
        self.factors.push(control);
        Ok(self.factors.len() - 1)
    }

    /// Sets additional forces on points, `[n, 3]`, replacing those of earlier calls.
    fn apply_force(&mut self, force: &Bound<'_, PyAny>) -> PyResult<()> {
        let count = self.state().points.len();
        let (values, _) = read(force, "force", &[Some(count), Some(3)])?;
        let rows = values.chunks_exact(3).map(|f| [f[0], f[1], f[2]]);
        self.applied.set_force(rows.collect());
        self.mechanics.state_mut();
        Ok(())
    }

    /// Sets additional torques on frames, lab frame, `[m, 3]`, replacing those of earlier calls.
    fn apply_torque(&mut self, torque: &Bound<'_, PyAny>) -> PyResult<()> {
        let count = self.state().frames.len();
        let (values, _) = read(torque, "torque", &[Some(count), Some(3)])?;
        let rows = values.chunks_exact(3).map(|t| [t[0], t[1], t[2]]);
        self.applied.set_torque(rows.collect());
        self.mechanics.state_mut();
        Ok(())
    }

    /// Fixes points and frames at their current positions and orientations, and ends their prescribed motion.
    #[pyo3(signature = (points = Vec::new(), frames = Vec::new()))]
    fn hold(&mut self, points: Vec<usize>, frames: Vec<usize>) -> PyResult<()> {
        self.take_from_drives(&points, &frames)?;
        let state = self.mechanics.state_mut();
        for i in points {
            state.points.hold(i);
        }
        for i in frames {
            state.frames.hold(i);
        }
        Ok(())
    }

    /// Releases fixed points and frames, at rest.
    #[pyo3(signature = (points = Vec::new(), frames = Vec::new()))]
    fn release(&mut self, points: Vec<usize>, frames: Vec<usize>) -> PyResult<()> {
        self.take_from_drives(&points, &frames)?;
        let state = self.mechanics.state_mut();
        for i in points {
            state.points.release(i);
        }
        for i in frames {
            state.frames.release(i);
        }
        Ok(())
    }

    /// Prescribes a rigid motion of points and frames.
    ///
    /// - `times`: times since now, ascending from 0. Between them, displacement and rotation vector are
    ///   interpolated linearly; after the last, the bodies are fixed.
    /// - `displacement`: `[t, 3]`, relative to the current positions.
    /// - `rotation`: rotation vectors `[t, 3]` (rad, lab frame), relative to the current orientations.
    /// - `about`: centre of rotation, which moves with the displacement; by default the first point.
    /// - `slides`: direction along which the points slide freely as one body.
    #[pyo3(signature = (times, *, points = Vec::new(), frames = Vec::new(), displacement = None, rotation = None,
        about = None, slides = None))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn drive(
        &mut self,
        times: &Bound<'_, PyAny>,
        points: Vec<usize>,
        frames: Vec<usize>,
        displacement: Option<&Bound<'_, PyAny>>,
        rotation: Option<&Bound<'_, PyAny>>,
        about: Option<&Bound<'_, PyAny>>,
        slides: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let times = read_times(times)?;
        let displacements = read_along(displacement, "displacement", times.len())?;
        let rotations = read_along(rotation, "rotation", times.len())?;
        self.hold(points.clone(), frames.clone())?;
        let first = points.first().map(|&i| self.state().points.position.get(i));
        let about = about
            .map(|about| vector(about, "about").map(Vector3::from))
            .transpose()?;
        let free = match slides {
            None => Vec::new(),
            Some(slides) => self.slide(&points, vector(slides, "slides")?.into())?,
        };
        let state = self.mechanics.state();
        let motion = Motion {
            begin: state.time,
            about: about.or(first).unwrap_or_else(Vector3::zeros),
            points: points
                .iter()
                .map(|&i| (i, state.points.position.get(i)))
                .collect(),
            frames: frames
                .iter()
                .map(|&i| (i, state.frames.orientation.get(i)))
                .collect(),
            times,
            displacements,
            rotations,
            free,
        };
        self.motions.own.push(motion);
        self.renew(self.state().clone());
        Ok(())
    }

    /// Sets loads and clamps to their values after `u` stages of the path, for a scene of equilibria.
    fn set_path(&mut self, u: f64) -> PyResult<()> {
        let assembly = self.assembly.clone();
        let Some(assembly) = assembly.filter(|assembly| !assembly.drive.is_still()) else {
            return Err(PyValueError::new_err(
                "set_path requires a System of a scene with a path",
            ));
        };
        if self.motions.of_scene.is_some() {
            return Err(PyValueError::new_err(
                "the path of a motion follows the time of its steps: use step, or a scene with the task Equilibrium",
            ));
        }
        let stages = assembly.drive.stages() as f64;
        if !(0.0..=stages).contains(&u) {
            return Err(PyValueError::new_err(format!(
                "u must be from 0 to {stages}, not {u}"
            )));
        }
        along_path(&assembly, self.mechanics.state_mut(), u);
        Ok(())
    }

    /// Sets the factor of a load, by its index in the scene or as returned when it was added.
    fn set_factor(&mut self, load: usize, factor: f64) -> PyResult<()> {
        let count = self.factors.len();
        let control = self.factors.get(load).copied();
        let control = control.ok_or_else(|| {
            PyIndexError::new_err(format!(
                "there are {count} loads with factors, but no load {load}"
            ))
        })?;
        if self.is_driven(control) {
            return Err(PyValueError::new_err(format!(
                "the factor of load {load} follows the time of the steps, from the scene: \
                 change it there"
            )));
        }
        self.mechanics.state_mut().controls[control] = factor;
        Ok(())
    }
}

impl System {
    /// Returns whether the scene sets a control at every step.
    fn is_driven(&self, control: ControlId) -> bool {
        self.motions.of_scene.as_ref().is_some_and(|drive| {
            let mut state = self.state().clone();
            state.controls[control] = f64::NAN;
            drive.place(&mut state, self.clock.time());
            !state.controls[control].is_nan()
        })
    }

    /// Ends the prescribed motion of points and frames. Returns an error for bodies in clamps of the scene.
    fn take_from_drives(&mut self, points: &[usize], frames: &[usize]) -> PyResult<()> {
        points.iter().try_for_each(|&i| self.point(i).map(drop))?;
        frames.iter().try_for_each(|&i| self.frame(i).map(drop))?;
        if let (Some(_), Some(assembly)) = (&self.motions.of_scene, &self.assembly) {
            for clamp in &assembly.clamps {
                let point = points.iter().find(|i| clamp.points.contains(i));
                let frame = frames.iter().find(|i| clamp.frames.contains(i));
                let body = point.map(|i| ("point", i)).or(frame.map(|i| ("frame", i)));
                if let Some((kind, i)) = body {
                    return Err(PyValueError::new_err(format!(
                        "{kind} {i} belongs to a clamp of the scene: change the clamp in the scene"
                    )));
                }
            }
        }
        self.settings.estimated = None;
        self.motions.take(points, frames);
        if !self.motions.is_empty() {
            self.renew(self.state().clone());
        }
        Ok(())
    }

    /// Lets fixed points slide along a direction as one body; returns the unit vector.
    fn slide(&mut self, points: &[usize], direction: Vector3) -> PyResult<Vec<Vector3>> {
        let unit = direction.try_normalize(0.0);
        let unit = unit.ok_or_else(|| PyValueError::new_err("slides must have a direction"))?;
        if points.is_empty() {
            return Err(PyValueError::new_err("slides requires at least one point"));
        }
        let mut state = self.mechanics.state().clone();
        state.sliders.push(Slider {
            points: points.to_vec(),
            directions: vec![unit],
            mass: points.iter().map(|&i| state.points.mass(i)).sum(),
        });
        self.renew(state);
        Ok(vec![unit])
    }

    /// Raises the exception of a Python callback, if any.
    pub(crate) fn raise(&self) -> PyResult<()> {
        let mut error = self
            .error
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        error.take().map_or(Ok(()), Err)
    }
}

//! Linkers, loads from Python functions, and copies of a `System`.

use crate::arrays::vector;
use crate::callback::Callback;
use crate::errors;
use crate::rod::Rod;
use crate::system::System;
use crate::terms::{Applied, Term};
use actin_coupling::{Anchor, Linker, LinkerEnd, RodPlace, Site};
use actin_mechanics::{Interaction, Spring, Springs, State, System as Mechanics};
use pyo3::exceptions::{PyIndexError, PyKeyError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use std::sync::Arc;

/// Place on a rod or on a filament of the scene, with the arc length.
#[derive(Debug, FromPyObject)]
enum Place<'py> {
    OnRod(PyRef<'py, Rod>, f64),
    OnFilament(usize, f64),
}

impl System {
    fn site(&self, place: &Bound<'_, PyAny>) -> PyResult<Site> {
        let wanted = "a place must be (rod, s) or (index of a filament of the scene, s)";
        let place: Place<'_> = place.extract().map_err(|_| PyTypeError::new_err(wanted))?;
        match place {
            Place::OnRod(rod, s) => {
                let length = rod.layout.length();
                if !(0.0..=length).contains(&s) {
                    let rule = format!("s must be from 0 to {length}, not {s}");
                    return Err(PyValueError::new_err(rule));
                }
                let place = RodPlace::on_axis(&rod.layout, &rod.layout.node_positions(), s);
                Site::on_rod(&rod.layout, place).map_err(errors::value)
            }
            Place::OnFilament(filament, s) => {
                let assembly = self.assembly.as_ref();
                let count = assembly.map_or(0, |assembly| assembly.filaments.len());
                match assembly.filter(|_| filament < count) {
                    None => Err(PyIndexError::new_err(format!(
                        "there are {count} filaments of a scene, but no filament {filament}"
                    ))),
                    Some(assembly) => assembly.axis_site(filament, s).map_err(errors::value),
                }
            }
        }
    }
}

#[pymethods]
impl System {
    /// Adds springs between pairs of points. Returns a number for `remove`.
    fn add_springs(
        &mut self,
        pairs: Vec<[usize; 2]>,
        stiffness: f64,
        rest_length: f64,
    ) -> PyResult<usize> {
        let spring = |points| Spring {
            points,
            stiffness,
            rest_length,
        };
        let springs = Springs::new(self.state(), pairs.into_iter().map(spring).collect());
        Ok(self.push_own(springs.map_err(errors::value)?))
    }

    /// Adds a linker: a spring between two places on axes of filaments, or between a place and a fixed point. Returns a
    /// number for `remove`.
    ///
    /// - `place`, `to`: `(rod, s)`, or `(index of a filament of the scene, s)` with the arc length `s`; `to` can also be
    ///   a fixed position `[3]`.
    #[pyo3(signature = (place, to, *, stiffness, rest_length = 0.0))]
    fn add_linker(
        &mut self,
        place: &Bound<'_, PyAny>,
        to: &Bound<'_, PyAny>,
        stiffness: f64,
        rest_length: f64,
    ) -> PyResult<usize> {
        let site = self.site(place)?;
        let end = match vector(to, "to") {
            Ok(position) => LinkerEnd::Anchor(Anchor::fixed(position.into())),
            Err(_) => LinkerEnd::Site(self.site(to)?),
        };
        let linker = Linker::new(site, end, stiffness, rest_length).map_err(errors::value)?;
        if rest_length > 0.0 && linker.extension(self.state()) + rest_length <= 0.0 {
            return Err(PyValueError::new_err(
                "a linker with a rest length needs two different ends",
            ));
        }
        Ok(self.push_own(linker))
    }

    /// Adds forces on points as a function of all positions, `[n, 3]` to `[n, 3]`, and optionally their energy.
    /// Returns a number for `remove`.
    ///
    /// - `differences`: as in `add_loads`.
    #[pyo3(signature = (force, energy = None, *, differences = false))]
    fn add_field(
        &mut self,
        py: Python<'_>,
        force: Py<PyAny>,
        energy: Option<Py<PyAny>>,
        differences: bool,
    ) -> PyResult<usize> {
        let error = Arc::clone(&self.error);
        let field = Callback::of_positions(py, (force, energy), differences, error)?;
        Ok(self.push_callback(field))
    }

    /// Adds the loads of `function(bodies)`, where `bodies` has `time`, `position`, `velocity`, `quaternion` and
    /// `angular_momentum`. Returns a number for `remove`.
    ///
    /// The function returns `Loads`, or an array of forces `[n, 3]`. It is called once for each evaluation of the loads:
    /// once a step by position Verlet, four times by PEFRL, several times in an equilibrium or a `Brownian` step, which
    /// require energy and stiffness. It is called here as well, with the present state.
    ///
    /// - `differences`: computes a missing stiffness from differences of the loads, in six calls for each body.
    /// - `name`: name of the term in `energies`.
    #[pyo3(signature = (function, *, differences = false, name = "field"))]
    fn add_loads(
        &mut self,
        py: Python<'_>,
        function: Py<PyAny>,
        differences: bool,
        name: &str,
    ) -> PyResult<usize> {
        let error = Arc::clone(&self.error);
        // Names of terms are static: a user-defined name remains in memory.
        let name: &'static str = match name {
            "field" => "field",
            name => name.to_owned().leak(),
        };
        let field = Callback::new(py, name, function, differences, self.state(), error)?;
        Ok(self.push_callback(field))
    }

    /// Removes springs, a linker, a field or loads, by the number returned when they were added.
    fn remove(&mut self, number: usize) -> PyResult<()> {
        if !self.removable.remove(&number) {
            return Err(PyKeyError::new_err(format!(
                "no springs, linker, field or loads with the number {number}"
            )));
        }
        self.terms.remove(&number);
        self.callbacks.remove(&number);
        self.renew(self.state().clone());
        Ok(())
    }

    /// Returns an independent copy in the present state. Functions of fields are shared.
    fn copy(&self) -> Self {
        let applied = Arc::new(Applied::default());
        let [force, torque] = self.applied.loads();
        applied.set_force(force);
        applied.set_torque(torque);
        let mut terms = self.terms.clone();
        for term in terms.values_mut() {
            if let Term::Applied(_) = term {
                *term = Term::Applied(Arc::clone(&applied));
            }
        }
        let mut copy = Self {
            mechanics: Mechanics::new(State::default(), Vec::new()),
            terms,
            applied,
            motions: self.motions.clone(),
            settings: self.settings,
            assembly: self.assembly.clone(),
            scene: self.scene.clone(),
            factors: self.factors.clone(),
            clock: self.clock,
            error: Arc::clone(&self.error),
            estimate: self.estimate,
            stepper: None,
            callbacks: self.callbacks.clone(),
            removable: self.removable.clone(),
        };
        copy.renew(self.state().clone());
        copy.settings.estimated = self.settings.estimated;
        copy
    }

    fn __copy__(&self) -> Self {
        self.copy()
    }

    #[pyo3(signature = (memo, /))]
    fn __deepcopy__(&self, memo: &Bound<'_, PyAny>) -> Self {
        let _ = memo;
        self.copy()
    }
}

impl System {
    fn push_own(&mut self, term: impl Interaction + 'static) -> usize {
        let number = self.push(Term::Own(Arc::new(term)));
        self.removable.insert(number);
        self.renew(self.state().clone());
        number
    }

    fn push_callback(&mut self, field: Callback) -> usize {
        let field = Arc::new(field);
        let number = self.push(Term::Own(field.clone()));
        self.removable.insert(number);
        self.callbacks.insert(number, field);
        self.renew(self.state().clone());
        number
    }

    /// Returns what an equilibrium requires and a function of a field does not return.
    pub(crate) fn missing_for_equilibrium(&self) -> Option<&'static str> {
        self.callbacks.values().find_map(|field| field.lacks())
    }
}

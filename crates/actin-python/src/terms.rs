//! Interactions of a `System`.

use crate::arrays::Block;
use actin_mechanics::{
    Approach, Coordinates, Interaction, Loads, RandomStress, SecondOrder, State, Stiffness,
    Vector3, Vectors,
};
use actin_sim::Assembly;
use pyo3::prelude::*;
use std::sync::{Arc, PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard};

/// An interaction shared by several systems.
#[derive(Clone, Debug)]
pub(crate) enum Term {
    Own(Arc<dyn Interaction>),
    /// Loads set from Python.
    Applied(Arc<Applied>),
    /// An interaction of a scene, by index.
    OfScene(Arc<Assembly>, usize),
}

impl Term {
    fn inner(&self) -> &dyn Interaction {
        match self {
            Self::Own(term) => term.as_ref(),
            Self::Applied(applied) => applied.as_ref(),
            Self::OfScene(assembly, i) => assembly.system.interactions()[*i].as_ref(),
        }
    }
}

impl Interaction for Term {
    fn term(&self) -> &'static str {
        self.inner().term()
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        self.inner().add_loads(state, loads);
    }

    fn elements(&self) -> usize {
        self.inner().elements()
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        self.inner().write_energies(state, energies);
    }

    fn is_conservative(&self) -> bool {
        self.inner().is_conservative()
    }

    fn count_turns(&self, state: &mut State) {
        self.inner().count_turns(state);
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        self.inner().second_order()
    }

    fn random_stress(&self) -> Option<&dyn RandomStress> {
        self.inner().random_stress()
    }

    fn passes_through(&self, from: &State, to: &State) -> Option<Coordinates> {
        self.inner().passes_through(from, to)
    }

    fn approaches(&self, from: &State, to: &State) -> Vec<Approach> {
        self.inner().approaches(from, to)
    }
}

/// Forces and torques on the first bodies; zero for others.
#[derive(Debug, Default)]
struct Set {
    force: Vec<[f64; 3]>,
    torque: Vec<[f64; 3]>,
}

/// User-defined forces on points and torques on frames (lab frame), with the term name `applied`.
#[derive(Debug, Default)]
pub(crate) struct Applied {
    loads: RwLock<Set>,
}

impl Applied {
    fn read(&self) -> RwLockReadGuard<'_, Set> {
        self.loads.read().unwrap_or_else(PoisonError::into_inner)
    }

    fn write(&self) -> RwLockWriteGuard<'_, Set> {
        self.loads.write().unwrap_or_else(PoisonError::into_inner)
    }

    /// Forces and torques.
    pub(crate) fn loads(&self) -> [Vec<[f64; 3]>; 2] {
        let Set { force, torque } = &*self.read();
        [force.clone(), torque.clone()]
    }

    /// Sets the forces on the first points; forces on other points are zero.
    pub(crate) fn set_force(&self, force: Vec<[f64; 3]>) {
        self.write().force = force;
    }

    /// Sets the torques on the first frames.
    pub(crate) fn set_torque(&self, torque: Vec<[f64; 3]>) {
        self.write().torque = torque;
    }
}

impl Interaction for Applied {
    fn term(&self) -> &'static str {
        "applied"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        let Set { force, torque } = &*self.read();
        for (i, &f) in force.iter().enumerate() {
            loads.force.add(i, f.into());
        }
        for (i, &t) in torque.iter().enumerate() {
            let q = state.frames.orientation.get(i);
            loads.torque.add(i, q.inverse_transform_vector(&t.into()));
        }
    }

    fn elements(&self) -> usize {
        1
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        let Set { force, .. } = &*self.read();
        let work = force.iter().enumerate().map(|(i, &f)| {
            let f: Vector3 = f.into();
            f.dot(&state.points.position.get(i))
        });
        energies[0] = -work.sum::<f64>();
    }

    /// Constant forces have a potential; torques of constant direction have none.
    fn is_conservative(&self) -> bool {
        let Set { torque, .. } = &*self.read();
        torque.iter().flatten().all(|t| *t == 0.0)
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }
}

impl SecondOrder for Applied {
    /// Constant forces have no stiffness.
    fn add_stiffness(&self, _state: &State, _stiffness: &mut Stiffness) {}
}

/// Converts vectors to a read-only array with one row each.
pub(crate) fn rows<'py>(py: Python<'py>, vectors: &Vectors) -> PyResult<Bound<'py, PyAny>> {
    let values: Vec<f64> = vectors.iter().flat_map(|v| [v.x, v.y, v.z]).collect();
    let rows = Block::new(values, &[vectors.len(), 3]).into_python(py)?;
    Ok(rows.into_bound(py))
}

//! Observers: what they are shown and when.

use crate::{Checkpoint, Pause};
use actin_mechanics::{Interaction, Residual, State, System};
use std::ops::ControlFlow;

/// A synchronised state of a run: positions and momenta belong to the same time.
///
/// Energies and loads are evaluated when asked for, and only then.
#[derive(Debug)]
pub struct Moment<'a> {
    /// Steps since step 0.
    pub step: u64,
    /// Time since step 0 (ns).
    pub time: f64,
    system: &'a mut System,
}

impl<'a> Moment<'a> {
    /// The present state of `system` as a moment of a run.
    pub fn new(step: u64, time: f64, system: &'a mut System) -> Self {
        Self { step, time, system }
    }

    /// The state.
    pub fn state(&self) -> &State {
        self.system.state()
    }

    /// The interactions, in the order of [`energies`](Self::energies).
    pub fn interactions(&self) -> &[Box<dyn Interaction>] {
        self.system.interactions()
    }

    /// Energy of each interaction (pN nm).
    pub fn energies(&self) -> Vec<f64> {
        self.system.energies()
    }

    /// Energy of all interactions (pN nm).
    pub fn potential_energy(&self) -> f64 {
        self.system.potential_energy()
    }

    /// Kinetic energy of the free bodies (pN nm).
    pub fn kinetic_energy(&self) -> f64 {
        self.system.state().kinetic_energy()
    }

    /// Largest loads on free bodies; evaluates the loads if they are not current.
    pub fn residual(&mut self) -> Residual {
        self.system.residual()
    }
}

/// Observes a run, and may end it.
///
/// Implemented by every closure of the shape of [`observe`](Self::observe).
pub trait Observer {
    /// Looks at a moment; [`ControlFlow::Break`] ends the run there.
    fn observe(&mut self, moment: &mut Moment<'_>) -> ControlFlow<()>;

    /// May change the state after an observation, the last one excepted: push it off a saddle, for
    /// instance. `at_rest` says whether the stop rule is met. Returns whether the run goes on even so.
    ///
    /// A change is part of what a checkpoint keeps.
    fn intervene(&mut self, _time: f64, _at_rest: bool, _system: &mut System) -> bool {
        false
    }

    /// Is there at every check of the state, after the observation if there is one at that step:
    /// the places at which a run can be left and taken up again. [`ControlFlow::Break`] ends the
    /// run there.
    fn pause(&mut self, _pause: &Pause<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    /// Is told that the run has come to its end, by its last step or its stop rule, and where: a run
    /// that is resumed from there ends there again, with the same outcome.
    fn finish(&mut self, _end: &Pause<'_>) {}

    /// Is told that the run has failed, and where the last good state was.
    fn fail(&mut self, _last_good: &Checkpoint) {}
}

impl<F: FnMut(&mut Moment<'_>) -> ControlFlow<()>> Observer for F {
    fn observe(&mut self, moment: &mut Moment<'_>) -> ControlFlow<()> {
        self(moment)
    }
}

use crate::{Checkpoint, Pause};
use actin_mechanics::{Residual, State, System};
use std::ops::ControlFlow;

/// Synchronised state of a run, with positions and momenta at the same time.
///
/// Energies and loads are evaluated on demand.
#[derive(Debug)]
pub struct Moment<'a> {
    /// Steps since step 0.
    pub step: u64,
    /// Time since step 0 (ns).
    pub time: f64,
    system: &'a mut System,
}

impl<'a> Moment<'a> {
    /// Creates a moment from the present state of `system`.
    pub fn new(step: u64, time: f64, system: &'a mut System) -> Self {
        Self { step, time, system }
    }

    /// State of the system.
    pub fn state(&self) -> &State {
        self.system.state()
    }

    /// Energy of each interaction, in the order of the system (pN nm).
    pub fn energies(&self) -> Vec<f64> {
        self.system.energies()
    }

    /// Total energy of the interactions (pN nm).
    pub fn potential_energy(&self) -> f64 {
        self.system.potential_energy()
    }

    /// Kinetic energy of the free bodies (pN nm).
    pub fn kinetic_energy(&self) -> f64 {
        self.system.state().kinetic_energy()
    }

    /// Largest loads on free bodies. Evaluates the loads if they are not current.
    pub fn residual(&mut self) -> Residual {
        self.system.residual()
    }
}

/// Observer of a run.
///
/// Implemented for closures with the signature of [`observe`](Self::observe).
pub trait Observer {
    /// Observes a moment; [`ControlFlow::Break`] ends the run.
    fn observe(&mut self, moment: &mut Moment<'_>) -> ControlFlow<()>;

    /// Can change the state after an observation, except the last one. `at_rest` is `true` if the
    /// stop rule is met. Returns `true` to continue the run nevertheless. Checkpoints include the
    /// changes.
    fn intervene(&mut self, _time: f64, _at_rest: bool, _system: &mut System) -> bool {
        false
    }

    /// Called at every check of the state, after the observation of that step. Runs can be
    /// interrupted and resumed here; [`ControlFlow::Break`] ends the run.
    fn pause(&mut self, _pause: &Pause<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    /// Called at the end of a run by its last step or stop rule. A run resumed from there ends with
    /// the same outcome.
    fn finish(&mut self, _end: &Pause<'_>) {}

    /// Called with the last sound state after a failure.
    fn fail(&mut self, _last_good: &Checkpoint) {}
}

impl<F: FnMut(&mut Moment<'_>) -> ControlFlow<()>> Observer for F {
    fn observe(&mut self, moment: &mut Moment<'_>) -> ControlFlow<()> {
        self(moment)
    }
}

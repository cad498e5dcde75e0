//! One run of a candidate: its records and its time, including the assembly.

use super::model_error;
use crate::run::InterruptibleTrajectory;
use crate::scene::{Scene, SceneProblem, Task};
use crate::{Assembly, Plan, Record, RunError, StableStates};
use std::time::{Duration, Instant};
use thiserror::Error;

/// Time (s) below which runs are repeated; the shortest time counts.
const SHORT_S: f64 = 0.05;

const REPEATS: usize = 2;

#[derive(Clone, Copy)]
pub(super) struct Limits<'a> {
    /// Longest time.
    pub budget: Option<Duration>,
    /// Largest number of records.
    pub records: Option<usize>,
    /// Returns true after an interruption by the user.
    pub is_interrupted: &'a dyn Fn() -> bool,
}

impl Limits<'_> {
    pub(super) const NONE: Limits<'static> = Limits {
        budget: None,
        records: None,
        is_interrupted: &|| false,
    };
}

pub(super) struct RunResult {
    pub assembly: Assembly,
    /// Compared records.
    pub records: Vec<Record>,
    /// Time of assembly and run (s).
    pub wall_s: f64,
    /// Number of force evaluations.
    pub evaluations: u64,
    /// Stable states of an equilibrium, if the scene asks for them.
    pub states: Option<StableStates>,
    /// True if the time limit ended the run.
    pub is_cut: bool,
}

impl RunResult {
    /// Returns the last record.
    ///
    /// # Panics
    /// If a limit ended the run before its first record.
    pub(super) fn last(&self) -> &Record {
        self.records.last().expect("a completed run has a record")
    }
}

#[derive(Clone, Debug, Error)]
pub(super) enum TrialFailure {
    #[error("interrupted")]
    Interrupted,
    #[error(transparent)]
    Refused(#[from] SceneProblem),
    #[error("{0}")]
    Failed(String),
}

impl TrialFailure {
    /// Returns the problem of sections that depend on the failed run.
    pub(super) fn into_problem(self, rule: &str) -> SceneProblem {
        match self {
            Self::Refused(problem) => problem,
            failure => SceneProblem::new("filament.sections", "", format!("{rule}: {failure}")),
        }
    }
}

/// Assembles and runs a scene; repeats short runs for their time.
pub(super) fn run(scene: &Scene, limits: Limits<'_>) -> Result<RunResult, TrialFailure> {
    let mut first = run_once(scene, limits)?;
    if first.wall_s < SHORT_S {
        for _ in 0..REPEATS {
            first.wall_s = first.wall_s.min(run_once(scene, limits)?.wall_s);
        }
    }
    Ok(first)
}

pub(super) fn run_once(scene: &Scene, limits: Limits<'_>) -> Result<RunResult, TrialFailure> {
    let began = Instant::now();
    let assembly = Assembly::build(scene)?;
    let plan = Plan::new(&assembly)?;
    let mut is_cut = false;
    let mut sink = InterruptibleTrajectory::new(|records: &[Record]| {
        is_cut |= limits.budget.is_some_and(|budget| began.elapsed() > budget);
        let has_enough = limits.records.is_some_and(|most| records.len() >= most);
        is_cut || has_enough || (limits.is_interrupted)()
    });
    let outcome = plan.execute(None, &mut sink, model_error);
    let records = sink.trajectory.records;
    let wall_s = began.elapsed().as_secs_f64();
    if (limits.is_interrupted)() {
        return Err(TrialFailure::Interrupted);
    }
    let outcome = outcome.map_err(|error| match error {
        RunError::Refused(problem) => TrialFailure::Refused(problem),
        error @ RunError::Failed(_) => TrialFailure::Failed(error.to_string()),
    })?;
    let records = compared(scene, records);
    Ok(RunResult {
        assembly,
        records,
        wall_s,
        evaluations: outcome.force_evaluations,
        states: outcome.equilibrium.and_then(|report| report.states),
        is_cut,
    })
}

/// Returns the records that all resolutions have in common: all records of a motion, the last record of a motion with a
/// stop rule, and the ends of the stages of a path.
fn compared(scene: &Scene, mut records: Vec<Record>) -> Vec<Record> {
    let is_last_only = match &scene.task {
        Task::Equilibrium(_) => scene.path.is_empty(),
        Task::Dynamics(dynamics) => dynamics.stop.is_some(),
        Task::Brownian(_) => false,
    };
    if is_last_only {
        let last = records.pop();
        return last.into_iter().collect();
    }
    let is_stage_end = |record: &Record| {
        let parameter = record.at.path();
        parameter
            .is_none_or(|parameter| parameter > 0.5 && (parameter - parameter.round()).abs() < 1e-9)
    };
    records.retain(is_stage_end);
    records
}

//! One run of a candidate: its records and the time that a user waits for them.

use crate::scene::{Scene, SceneProblem, Task};
use crate::{Assembly, Counts, Plan, Record, RunError, Sink};
use std::time::{Duration, Instant};

/// Runs shorter than this (s) are repeated, and the shortest time counts.
const SHORT_S: f64 = 0.05;

/// How often they are repeated.
const REPEATS: usize = 2;

/// What ends a run before its end.
#[derive(Clone, Copy)]
pub(super) struct Limits<'a> {
    /// Time after which it is broken off.
    pub budget: Option<Duration>,
    /// Records after which it has done enough.
    pub records: Option<usize>,
    /// Whether the user wants all to end.
    pub is_interrupted: &'a dyn Fn() -> bool,
}

/// A run that came to its end, or to as many records as were wanted, or to its budget.
pub(super) struct Ran {
    pub assembly: Assembly,
    /// Those that are compared.
    pub records: Vec<Record>,
    pub counts: Counts,
    /// Time from the scene to its last record (s).
    pub wall_s: f64,
    /// Evaluations of all loads.
    pub evaluations: u64,
    /// Whether it was broken off at its budget.
    pub is_cut: bool,
}

/// Why there is nothing to compare.
#[derive(Clone, Debug)]
pub(super) enum Unusable {
    Interrupted,
    Refused(SceneProblem),
    Failed(String),
}

/// Builds and runs a scene.
pub(super) fn run(scene: &Scene, limits: Limits<'_>) -> Result<Ran, Unusable> {
    let mut first = run_once(scene, limits)?;
    if first.wall_s < SHORT_S {
        for _ in 0..REPEATS {
            first.wall_s = first.wall_s.min(run_once(scene, limits)?.wall_s);
        }
    }
    Ok(first)
}

/// The same without repeats.
pub(super) fn run_once(scene: &Scene, limits: Limits<'_>) -> Result<Ran, Unusable> {
    let began = Instant::now();
    let assembly = Assembly::build(scene).map_err(Unusable::Refused)?;
    let plan = Plan::new(&assembly).map_err(Unusable::Refused)?;
    let mut kept = Kept {
        limits,
        began,
        records: Vec::new(),
        is_cut: false,
    };
    let outcome = plan.run_into(&mut kept);
    let Kept {
        records, is_cut, ..
    } = kept;
    let wall_s = began.elapsed().as_secs_f64();
    if (limits.is_interrupted)() {
        return Err(Unusable::Interrupted);
    }
    let outcome = outcome.map_err(|error| match error {
        RunError::Refused(problem) => Unusable::Refused(problem),
        error @ RunError::Failed(_) => Unusable::Failed(error.to_string()),
    })?;
    let records = compared(scene, records);
    let counts = assembly.counts();
    Ok(Ran {
        assembly,
        records,
        counts,
        wall_s,
        evaluations: outcome.force_evaluations,
        is_cut,
    })
}

/// The records that every resolution has: those of a motion, the last of one that stops at rest, and of a path the ends
/// of its stages.
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

struct Kept<'a> {
    limits: Limits<'a>,
    began: Instant,
    records: Vec<Record>,
    is_cut: bool,
}

impl Sink for Kept<'_> {
    fn record(&mut self, record: &Record) {
        self.records.push(record.clone());
    }

    fn is_interrupted(&mut self) -> bool {
        let budget = self.limits.budget;
        self.is_cut |= budget.is_some_and(|budget| self.began.elapsed() > budget);
        let has_enough = self
            .limits
            .records
            .is_some_and(|most| self.records.len() >= most);
        self.is_cut || has_enough || (self.limits.is_interrupted)()
    }
}

impl std::fmt::Display for Unusable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Interrupted => write!(f, "interrupted"),
            Self::Refused(problem) => write!(f, "{problem}"),
            Self::Failed(cause) => write!(f, "{cause}"),
        }
    }
}

//! Cost of accuracy in a scene: error and time of cheaper candidates, measured against every monomer.
//!
//! [`trade`] runs the reference: the scene with every monomer and quadrature bonds (`resolution.rs`), a motion at half of
//! its default step. The candidates of `ladder.rs` follow. `measure.rs` defines the compared quantities. Errors are
//! measured, not estimated, and hold for this scene only.

mod branches;
mod ladder;
mod measure;
mod model_error;
mod reference;
mod resolution;
mod run;
mod sample;
mod section_choice;
mod study;
mod table;

pub use branches::OtherState;
pub use measure::{Item, Measure};
pub(crate) use model_error::model_error;
pub use section_choice::build;
pub use study::trade;

use crate::Counts;
use crate::scene::{Scene, SceneProblem};
use std::time::Duration;
use thiserror::Error;

/// Largest error of the reference itself, as a fraction of the wanted error.
const SETTLED: f64 = 1.0 / 3.0;

/// Options of a trade.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Compared quantities. An empty list selects the observables of the scene and the tip displacements, or the heights
    /// if no tip is free.
    pub measures: Vec<Measure>,
    /// Largest accepted relative error; greater than 0, below 1.
    pub error: f64,
    /// Longest time of one run.
    pub budget: Duration,
    /// Fractions of the loads, shifts and turns at which models within the error run again; each positive.
    pub load_shares: Vec<f64>,
    /// Includes finer meshes and other laws.
    pub is_all: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            measures: Vec::new(),
            error: 0.02,
            budget: Duration::from_mins(1),
            load_shares: vec![0.5],
            is_all: false,
        }
    }
}

/// Callbacks of a trade.
#[expect(
    missing_debug_implementations,
    reason = "functions have nothing to show"
)]
pub struct TradeCallbacks<'a> {
    /// Receives the name of each run before it starts.
    pub report: &'a dyn Fn(&str),
    /// Returns true if the trade should end early with its results so far.
    pub is_interrupted: &'a dyn Fn() -> bool,
}

impl TradeCallbacks<'_> {
    /// Callbacks without effect.
    pub const NONE: TradeCallbacks<'static> = TradeCallbacks {
        report: &|_| {},
        is_interrupted: &|| false,
    };
}

/// Failure of a trade.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum TradeError {
    /// Invalid scene or options.
    #[error(transparent)]
    Refused(#[from] SceneProblem),
    /// The reference has no result.
    #[error("the reference, {name}, fails: {cause}")]
    ReferenceFails {
        /// Name of the reference.
        name: String,
        /// Cause of the failure.
        cause: String,
    },
    /// Interruption before the end of the reference.
    #[error("interrupted before the reference was known")]
    Interrupted,
}

/// Errors and times of the candidates of a scene.
#[derive(Clone, Debug)]
pub struct Trade {
    /// Options of the trade.
    pub options: Options,
    /// Reference of all errors.
    pub reference: Reference,
    /// Compared numbers and vectors, in the order of the errors.
    pub items: Vec<Item>,
    /// Exclusions from the comparison: one sentence each, with the reason.
    pub left_out: Vec<String>,
    /// Candidates in the order of their runs.
    pub candidates: Vec<Candidate>,
    /// Root mean square error of three filaments with 64 sampled bonds per interface, for each item. `None` without these
    /// runs.
    pub scatter: Option<Vec<Option<f64>>>,
    /// Index of the fastest candidate within the wanted error; `None` if the reference is faster or no candidate meets it.
    pub best: Option<usize>,
    /// Total run time divided by the time of the reference: for the reference and the candidates, and for all runs with
    /// other loads and sampled bonds.
    pub runs_of_reference: [f64; 2],
}

/// Reference of a trade.
#[derive(Clone, Debug)]
pub struct Reference {
    /// Name, from resolution, step and integrator.
    pub name: String,
    /// The scene.
    pub scene: Scene,
    /// Number of bodies.
    pub counts: Counts,
    /// Run time (s).
    pub wall_s: f64,
    /// Relative discretisation error of the reference for each item, measured against every monomer at the default step
    /// or against the next coarser reference. `None` if unknown.
    pub own_errors: Vec<Option<f64>>,
    /// Fraction of its records within the budget.
    pub share: f64,
    /// True if all of `own_errors` are at most a third of the wanted error.
    pub is_settled: bool,
}

/// A cheaper way to run the scene.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Name, from resolution, step and integrator.
    pub name: String,
    /// The scene.
    pub scene: Scene,
    /// Number of bodies.
    pub counts: Counts,
    /// Run time (s).
    pub wall_s: f64,
    /// Relative error of each item; `None` if the records differ from the reference in number.
    pub errors: Vec<Option<f64>>,
    /// Standard error of each relative error; zero without heat.
    pub standard_errors: Vec<f64>,
    /// Pairs of load fraction and largest error at these loads.
    pub at_loads: Vec<(f64, f64)>,
    /// Stable state of the reference on whose branch the candidate lies, if it is not the reference itself.
    pub other_state: Option<OtherState>,
    /// Reason for a missing result.
    pub failure: Option<String>,
}

impl Candidate {
    /// Returns the largest sum of error and standard error at the loads of the scene; infinite if an error is unknown.
    pub fn error(&self) -> f64 {
        let all = self.errors.iter().zip(&self.standard_errors);
        let sums = all.map(|(error, standard)| error.map(|error| error + standard));
        worst(&sums.collect::<Vec<_>>())
    }

    /// Returns the largest error at all tested loads.
    pub fn worst_error(&self) -> f64 {
        let at_loads = self.at_loads.iter().map(|(_, error)| *error);
        at_loads.fold(self.error(), f64::max)
    }
}

impl Trade {
    /// Returns the fastest scene within the wanted error.
    pub fn best_scene(&self) -> &Scene {
        self.best
            .map_or(&self.reference.scene, |best| &self.candidates[best].scene)
    }

    /// Returns the time of every monomer at the default step (s), the baseline of speed-ups.
    pub fn usual_s(&self) -> f64 {
        let usual = self.candidates.first();
        usual
            .filter(|first| first.name.starts_with(study::USUAL) && first.failure.is_none())
            .map_or(self.reference.wall_s, |first| first.wall_s)
    }
}

fn worst(errors: &[Option<f64>]) -> f64 {
    let errors = errors.iter().map(|error| error.unwrap_or(f64::INFINITY));
    errors.fold(0.0, f64::max)
}

//! What accuracy costs in a scene: every monomer as the reference, cheaper candidates beside it, each run and timed.
//!
//! [`trade`] runs the scene with every monomer and weighted bonds, a motion at half of its step (`resolution.rs`), and
//! then the candidates of `ladder.rs`. What is compared, and how, is in `measure.rs`. Errors are those of this scene;
//! nothing is estimated.

mod chosen;
mod ladder;
mod measure;
mod model_error;
mod reference;
mod resolution;
mod run;
mod sample;
mod study;
mod table;

pub use chosen::{Chosen, choose};
pub use measure::{Item, Measure};
pub(crate) use model_error::model_error;
pub use model_error::{ModelError, Scatter};
/// The error of a number, with how it scatters, or why they are not known.
pub(crate) type Judged = Result<(ModelError, Scatter), SceneProblem>;
pub(crate) use resolution::weighted;
pub use study::trade;

use crate::Counts;
use crate::scene::{Scene, SceneProblem};
use std::time::Duration;
use thiserror::Error;

/// What a trade is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// What candidates are compared by; by default what the scene observes, and its tips, or where no tip is free its
    /// heights.
    pub measures: Vec<Measure>,
    /// Largest relative error that is wanted; greater than 0, below 1.
    pub error: f64,
    /// Longest time of one run.
    pub budget: Duration,
    /// Shares of the loads, shifts and turns at which candidates that meet the error are judged, too; each positive.
    pub load_shares: Vec<f64>,
    /// Whether finer meshes and other laws are tried.
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

/// Who follows a trade.
#[expect(
    missing_debug_implementations,
    reason = "functions have nothing to show"
)]
pub struct Watch<'a> {
    /// Told what runs next.
    pub says: &'a dyn Fn(&str),
    /// Asked whether to end with what there is.
    pub is_interrupted: &'a dyn Fn() -> bool,
}

impl Watch<'_> {
    /// Nobody.
    pub const NOBODY: Watch<'static> = Watch {
        says: &|_| {},
        is_interrupted: &|| false,
    };
}

/// Why there is no trade.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum TradeError {
    /// The scene, or what is asked of it, is refused.
    #[error(transparent)]
    Refused(#[from] SceneProblem),
    /// The reference finds no result.
    #[error("the reference, {name}, fails: {cause}")]
    ReferenceFails {
        /// Which.
        name: String,
        /// Why.
        cause: String,
    },
    /// It was interrupted before the reference was known.
    #[error("interrupted before the reference was known")]
    Interrupted,
}

/// What accuracy costs in a scene.
#[derive(Clone, Debug)]
pub struct Trade {
    /// What was asked for.
    pub options: Options,
    /// What candidates are compared with.
    pub reference: Reference,
    /// What they are compared by, in the order of their errors.
    pub items: Vec<Item>,
    /// What is not compared, and why, a sentence each.
    pub left_out: Vec<String>,
    /// The candidates in the order in which they ran.
    pub candidates: Vec<Candidate>,
    /// By how much filaments with 64 bonds drawn for each interface differ from the mean one: the root mean square of
    /// the errors of three; none where none ran.
    pub scatter: Option<Vec<Option<f64>>>,
    /// The candidate that meets the wanted error in the least time; none where only the reference does.
    pub best: Option<usize>,
    /// Time over that of the reference: of the reference with the candidates, and with other loads and drawn bonds, too.
    pub runs_of_reference: [f64; 2],
}

/// What candidates are compared with.
#[derive(Clone, Debug)]
pub struct Reference {
    /// How it is resolved and stepped.
    pub name: String,
    /// The scene.
    pub scene: Scene,
    /// Its bodies.
    pub counts: Counts,
    /// Its time (s).
    pub wall_s: f64,
    /// What it is itself off by, of each item: against the same at the usual step, or the next coarser reference; none
    /// where that is not known.
    pub own_errors: Vec<Option<f64>>,
    /// Share of its records that it came to within the budget.
    pub share: f64,
    /// Whether its own errors are at most a third of the wanted error.
    pub is_settled: bool,
}

/// A cheaper way to run the scene.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// How it is resolved and stepped.
    pub name: String,
    /// The scene.
    pub scene: Scene,
    /// Its bodies.
    pub counts: Counts,
    /// Its time (s).
    pub wall_s: f64,
    /// Relative error of each item; none where it has other records.
    pub errors: Vec<Option<f64>>,
    /// Standard error of each of these: zero without heat.
    pub standard_errors: Vec<f64>,
    /// The largest error at each share of the loads that was tried.
    pub at_loads: Vec<(f64, f64)>,
    /// Why it has no result, if it has none.
    pub failure: Option<String>,
}

impl Candidate {
    /// The largest of its errors at the loads of the scene, each with its standard error; infinite where one is not known.
    pub fn error(&self) -> f64 {
        let all = self.errors.iter().zip(&self.standard_errors);
        let sums = all.map(|(error, standard)| error.map(|error| error + standard));
        worst(&sums.collect::<Vec<_>>())
    }

    /// The largest of its errors at all loads at which it was tried.
    pub fn worst_error(&self) -> f64 {
        let at_loads = self.at_loads.iter().map(|(_, error)| *error);
        at_loads.fold(self.error(), f64::max)
    }
}

impl Trade {
    /// The scene that meets the wanted error in the least time.
    pub fn best_scene(&self) -> &Scene {
        self.best
            .map_or(&self.reference.scene, |best| &self.candidates[best].scene)
    }

    /// Time of every monomer at the usual step (s), beside which others are faster.
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

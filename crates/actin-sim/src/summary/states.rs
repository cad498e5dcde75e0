//! Stable states in `summary.json`.

use super::FilamentSummary;
use crate::{Assembly, Outcome, StableState};
use serde::{Deserialize, Serialize};
use std::fmt;

/// Energy difference that counts as zero (pN nm).
const ROUNDING: f64 = 1e-3;

/// Stable states of a search, sorted by energy.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StatesSummary {
    /// States, including the result of the run.
    pub found: Vec<StateSummary>,
    /// Number of starts without a valid stable state. Lost turns and violations of model limits
    /// count too.
    pub lost: usize,
}

/// Stable state of a search.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StateSummary {
    /// Potential energy relative to the result of the run (pN nm).
    pub above_result_pn_nm: f64,
    /// Number of starts that led to this state.
    pub starts: usize,
    /// True for the result of the run.
    pub is_result: bool,
    /// Filaments, in the order of the scene.
    pub filaments: Vec<FilamentSummary>,
}

impl StatesSummary {
    pub(super) fn from_outcome(assembly: &Assembly, outcome: &Outcome) -> Option<Self> {
        let states = outcome.equilibrium.as_ref()?.states.as_ref()?;
        let one = |state: &StableState| StateSummary {
            above_result_pn_nm: state.above_result_pn_nm,
            starts: state.starts,
            is_result: state.is_result,
            filaments: FilamentSummary::all(assembly, &state.record),
        };
        Some(Self {
            found: states.states.iter().map(one).collect(),
            lost: states.lost,
        })
    }

    /// Energy of the result above the lowest state (pN nm).
    pub(super) fn result_above_lowest_pn_nm(&self) -> f64 {
        self.found
            .first()
            .map_or(0.0, |lowest| -lowest.above_result_pn_nm)
    }
}

impl fmt::Display for StatesSummary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (found, lost) = (self.found.len(), self.lost);
        let starts = lost + self.found.iter().map(|state| state.starts).sum::<usize>();
        write!(
            f,
            "{found} stable state(s) from {starts} random starts ({lost} failed); the result is "
        )?;
        match self.result_above_lowest_pn_nm() {
            above if above > ROUNDING => write!(f, "{above:.4} pN nm above the lowest"),
            _ => write!(f, "the lowest"),
        }
    }
}

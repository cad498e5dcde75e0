//! The stable states of a scene, in `summary.json`.

use super::FilamentSummary;
use crate::{Assembly, Outcome, StableState};
use serde::{Deserialize, Serialize};
use std::fmt;

/// Energy (pN nm) by which equal states may differ.
const ROUNDING: f64 = 1e-3;

/// Stable states that were looked for, that of least energy first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StatesSummary {
    /// The states; the result of the run is one of them.
    pub found: Vec<StateSummary>,
    /// Starts that led to no stable state, or to one that lost a turn or left the model's use on the way.
    pub lost: usize,
}

/// One of several stable states.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StateSummary {
    /// Potential energy less that of the result (pN nm).
    pub above_result_pn_nm: f64,
    /// How many starts led to it.
    pub starts: usize,
    /// Whether it is the result of the run.
    pub is_result: bool,
    /// Its filaments, in the order of the scene.
    pub filaments: Vec<FilamentSummary>,
}

impl StatesSummary {
    /// Those of an outcome; none where none were looked for.
    pub(super) fn of(assembly: &Assembly, outcome: &Outcome) -> Option<Self> {
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

    /// How far the result is above the state of least energy (pN nm).
    pub fn result_above_lowest_pn_nm(&self) -> f64 {
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
            "{found} stable state(s) from {starts} random starts, of which {lost} led nowhere; of those found the result is "
        )?;
        match self.result_above_lowest_pn_nm() {
            above if above > ROUNDING => write!(f, "{above:.4} pN nm above the lowest"),
            _ => write!(f, "the lowest"),
        }
    }
}

//! Summary of a run: numbers of the last record, means and worst cases. Its fields are the keys of
//! `summary.json`.

mod compute;
mod energy;
mod filament;
mod following;
mod linkers;
mod numbers;
mod states;
mod statistics;
mod thermal;
mod warnings;

pub use energy::EnergySummary;
pub(crate) use filament::reported_tip;
pub use filament::{EndReaction, EndReactions, FilamentSummary, ShapeSummary};
pub use following::FollowingSummary;
pub use linkers::LinkerSummary;
pub use states::{StateSummary, StatesSummary};
pub use thermal::ThermalSummary;

use crate::{
    Assembly, Counts, LawExtrapolation, ModelLimitExceeded, ObservableSummary, Outcome, SaddlePush,
    Status, StepError, UnstableTwist,
};
use crate::{ModelError, Scatter, SectionChoice};
use actin_assembly::Note;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Final results of a run. Field names are the keys of `summary.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Title of the scene.
    pub scene: String,
    /// Status of the run.
    pub status: Status,
    /// Reason of a failure; key only after a failure.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub failure: String,
    /// Numbers of bodies and elements.
    pub counts: Counts,
    /// Simulated time (ns); `None` for equilibria.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_ns: Option<f64>,
    /// Position of the last record on the path of equilibria, in stages; `None` for motions in
    /// time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub path: Option<f64>,
    /// Time step (ns); `None` for equilibria.
    pub time_step_ns: Option<f64>,
    /// Largest frequency at the start (rad/ns); `None` for equilibria.
    pub largest_frequency_rad_per_ns: Option<f64>,
    /// Stability of the equilibrium, or of the rest state of a motion. `None` for motions that are
    /// not at rest or have a heat bath, and for loads without a potential.
    pub stability: Option<StabilitySummary>,
    /// Number of saddles that the run reached and moved away from.
    #[serde(default)]
    pub saddles_left: usize,
    /// Perturbations of a motion at saddles; key only if there are any.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pushes: Vec<SaddlePush>,
    /// Number of sudden jumps of a path of equilibria.
    #[serde(default)]
    pub jumps: usize,
    /// Energies (pN nm).
    pub energy_pn_nm: EnergySummary,
    /// Position of the tip of filament 0 (nm, lab frame): its end, or its start if the end is
    /// clamped and the start is free.
    pub tip_nm: [f64; 3],
    /// Displacement of that tip from the initial state (nm, lab frame).
    pub tip_displacement_nm: [f64; 3],
    /// Reactions at the clamped ends of filament 0.
    pub end_reactions: EndReactions,
    /// Results of each filament, in the order of the scene.
    #[serde(default)]
    pub filaments: Vec<FilamentSummary>,
    /// Texts of all notes and warnings.
    #[serde(default)]
    pub notes: Vec<String>,
    /// Warnings with their codes.
    #[serde(default)]
    pub warnings: Vec<Note>,
    /// Largest excess over the data range of each rod law; results there are extrapolated.
    ///
    /// The worst of all records for a run, otherwise of the last record. In a heat bath, one entry
    /// per quantity with its frequency.
    pub beyond_range: Vec<LawExtrapolation>,
    /// Violations of the limits of the model, the worst of all records; the run has then failed.
    #[serde(default)]
    pub beyond_use: Vec<ModelLimitExceeded>,
    /// Segments with unstable twist, one for each rod; empty in a heat bath.
    ///
    /// The worst of all records for a run, otherwise of the last record.
    #[serde(default)]
    pub unstable_twist: Vec<UnstableTwist>,
    /// Terms whose mean energy differs in steps of half the length.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub step_errors: Vec<StepError>,
    /// Linkers, in the order of the scene.
    #[serde(default)]
    pub linkers: Vec<LinkerSummary>,
    /// Observables by column of `observables.csv`: values of the last record and, in a heat bath,
    /// means. Key only with observables.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub observables: BTreeMap<String, ObservableSummary>,
    /// Smallest distance between surfaces of repelling filaments or walls (nm); negative if they
    /// overlap. Key only below a quarter of a radius.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub smallest_gap_nm: Option<f64>,
    /// Twist, writhe, link and largest distance from the axis of filament 0.
    pub shape: ShapeSummary,
    /// Residual forces of the last record.
    pub residual: ResidualSummary,
    /// Estimated round-off of the residual if the tolerance of the equilibrium is smaller; `None`
    /// if the tolerance was reached.
    #[serde(default)]
    pub residual_floor: Option<ResidualSummary>,
    /// Thermal motion; `None` without a temperature.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thermal: Option<ThermalSummary>,
    /// Switches of cells; key only for adaptive sections. Means are then in the directories of the
    /// stretches.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub following: Option<FollowingSummary>,
    /// Lowest eigenvalue of the stiffness; `None` unless requested for an equilibrium.
    pub lowest_stiffness_eigenvalue: Option<f64>,
    /// Other stable states; key only if requested for an equilibrium.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub states: Option<StatesSummary>,
    /// Estimated errors of the resolution.
    #[serde(flatten)]
    pub accuracy: AccuracySummary,
    /// Computational work.
    pub work: WorkSummary,
    /// Elapsed time (s).
    pub wall_s: f64,
    /// Version of this crate.
    pub version: String,
    /// Version of the format of a run directory; 1 if the key is missing.
    #[serde(default = "first_format")]
    pub format: u32,
    /// Seed of the bond anchors of filament 0.
    pub seed: u64,
}

fn first_format() -> u32 {
    1
}

/// Stability of an equilibrium from the eigenvalues of its stiffness.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StabilitySummary {
    /// True if all eigenvalues exceed the resolution: a minimum of the energy.
    pub stable: bool,
    /// Number of negative eigenvalues; positive at a saddle.
    pub negative_eigenvalues: usize,
    /// Number of neutral modes, with eigenvalues below the resolution.
    pub unresolved_eigenvalues: usize,
    /// Smallest magnitude of resolved eigenvalues (pN/nm).
    pub resolution_pn_per_nm: f64,
}

/// Largest loads on free bodies.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ResidualSummary {
    /// Largest force on a free point (pN).
    pub force_pn: f64,
    /// Largest torque on a free frame (pN nm).
    pub torque_pn_nm: f64,
}

/// Computational work of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct WorkSummary {
    /// Time steps.
    pub steps: u64,
    /// Evaluations of all loads.
    pub force_evaluations: u64,
    /// Newton iterations; zero in dynamics.
    pub newton_iterations: u64,
}

/// Estimated errors of the resolution.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AccuracySummary {
    /// Error of the requested quantity of an equilibrium; key only if requested.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub model_error: Option<ModelError>,
    /// Scatter of that quantity among filaments with sampled bonds; key only if known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drawn_bonds: Option<Scatter>,
    /// Choice of automatic sections; key only if sections were chosen in this run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub resolution: Option<SectionChoice>,
}

impl AccuracySummary {
    fn new(assembly: &Assembly, outcome: &Outcome) -> Self {
        Self {
            model_error: outcome.model_error(),
            drawn_bonds: outcome.scatter(),
            resolution: assembly.chosen.clone(),
        }
    }
}

impl Summary {
    /// Current version of the format of a run directory; increase it if old programs would misread
    /// a file.
    pub const FORMAT: u32 = 1;

    /// Numbers by key, for checks that they are finite: `tip_nm[0]`, `filaments[0].elastic_pn_nm`.
    pub fn numbers(&self) -> Vec<(String, f64)> {
        numbers::of(self)
    }
}

#[cfg(test)]
mod tests;

//! `summary.json`: the last record of a run in numbers. Each observable has a file of its own, with its keys,
//! how it is found and its numbers, which must be finite.

mod compute;
mod energy;
mod linkers;
mod pushes;
mod reactions;
mod shape;
mod states;
mod thermal;
mod warnings;

pub use energy::EnergySummary;
pub use linkers::LinkerSummary;
pub use reactions::{EndReaction, EndReactions};
pub use shape::ShapeSummary;
pub use states::{StateSummary, StatesSummary};

pub(super) use thermal::LateKinetic;
pub use thermal::ThermalSummary;

use super::{FollowingSummary, RunDirectoryError, finite::ensure_finite};
use crate::notes::Note;
use crate::trade::{Chosen, ModelError, Scatter};
use crate::{
    Assembly, BeyondRange, BeyondUse, Counts, ObservableSummary, Outcome, SaddlePush, Status,
    UnstableTwist,
};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What a run ended with. Field names are the keys of `summary.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Title of the scene.
    pub scene: String,
    /// How the run ended.
    pub status: Status,
    /// Why the run failed, in words; no key unless it did.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub failure: String,
    /// Number of bodies and elements.
    #[serde(with = "CountKeys")]
    pub counts: Counts,
    /// Simulated time (ns); none of an equilibrium.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_ns: Option<f64>,
    /// Where on the path of equilibria the last record stands, in stages; none of a motion in time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub path: Option<f64>,
    /// Time step (ns); none of an equilibrium.
    pub time_step_ns: Option<f64>,
    /// Largest frequency found at the start (rad/ns); none of an equilibrium.
    pub largest_frequency_rad_per_ns: Option<f64>,
    /// Whether the equilibrium is stable, or that in which a motion has come to rest; none of a motion
    /// that has not, that is in a heat bath, or whose loads have no potential.
    pub stability: Option<StabilitySummary>,
    /// How many saddles were left, on the whole path or in the whole motion.
    #[serde(default)]
    pub saddles_left: usize,
    /// How a motion was pushed off saddles; no key where it was not.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pushes: Vec<SaddlePush>,
    /// How often a path of equilibria went on from where a sudden jump led.
    #[serde(default)]
    pub jumps: usize,
    /// Energies.
    pub energy_pn_nm: EnergySummary,
    /// Position of the tip of filament 0 (nm, lab frame): that of its end, or that of its start if
    /// the end is clamped and the start is free.
    pub tip_nm: [f64; 3],
    /// Displacement of that tip from the state as built (nm, lab frame).
    pub tip_displacement_nm: [f64; 3],
    /// What holds the clamped ends of filament 0.
    pub end_reactions: EndReactions,
    /// The same of every filament, in the order of the scene.
    #[serde(default)]
    pub filaments: Vec<FilamentSummary>,
    /// Texts of all notes on the scene and the run, warnings included.
    #[serde(default)]
    pub notes: Vec<String>,
    /// Warnings with their codes.
    #[serde(default)]
    pub warnings: Vec<Note>,
    /// Where rods left the data behind their laws, the worst of all records in a run's summary (of
    /// the last record in one computed alone); there the numbers rest on the laws' continuation.
    /// In a heat bath one entry for each quantity, with how often it occurs.
    pub beyond_range: Vec<BeyondRange>,
    /// Where the model does not apply, the worst of all records; a run with any has failed.
    #[serde(default)]
    pub beyond_use: Vec<BeyondUse>,
    /// Where the force along a rod makes its twist unstable, the worst of all records in a run's
    /// summary (of the last record in one computed alone); never in a heat bath.
    #[serde(default)]
    pub unstable_twist: Vec<UnstableTwist>,
    /// What the linkers do, in the order of the scene.
    #[serde(default)]
    pub linkers: Vec<LinkerSummary>,
    /// What the scene observes, by the columns of `observables.csv`: the last record, and in a heat bath means;
    /// no key where nothing is observed.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub observables: BTreeMap<String, ObservableSummary>,
    /// Distance of the two surfaces nearest to each other (nm), of filaments that repel or of walls;
    /// negative where one is in the other. No key unless two are within a quarter of a radius.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub smallest_gap_nm: Option<f64>,
    /// Twist, writhe, link and distance from the axis of filament 0.
    pub shape: ShapeSummary,
    /// How far from an equilibrium the last record is.
    pub residual: ResidualSummary,
    /// What rounding leaves of the residual (estimate), where an equilibrium ends there since its
    /// tolerance is below that; none where the tolerance is met.
    #[serde(default)]
    pub residual_floor: Option<ResidualSummary>,
    /// Thermal motion; none unless the scene has a temperature.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thermal: Option<ThermalSummary>,
    /// What switches of cells did; no key where sections do not follow the motion. Means are then those of stretches, in
    /// their directories.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub following: Option<FollowingSummary>,
    /// Lowest eigenvalue of the stiffness; none unless an equilibrium was asked for it.
    pub lowest_stiffness_eigenvalue: Option<f64>,
    /// Stable states, where an equilibrium was asked for others; no key where it was not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub states: Option<StatesSummary>,
    /// What is known of the error of the resolution.
    #[serde(flatten)]
    pub accuracy: AccuracySummary,
    /// What the run cost in work.
    pub work: WorkSummary,
    /// What the run cost in time (s).
    pub wall_s: f64,
    /// Version of this crate.
    pub version: String,
    /// Seed of the bond anchors of filament 0.
    pub seed: u64,
}

/// What one filament of a scene ended with.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FilamentSummary {
    /// Number of its bodies and elements.
    #[serde(with = "CountKeys")]
    pub counts: Counts,
    /// Position of its tip (nm, lab frame).
    pub tip_nm: [f64; 3],
    /// Displacement of its tip from the state as built (nm, lab frame).
    pub tip_displacement_nm: [f64; 3],
    /// What holds its clamped ends.
    pub end_reactions: EndReactions,
    /// Elastic energy of its sections and junctions (pN nm); linkers belong to no filament.
    pub elastic_pn_nm: f64,
    /// Its shape.
    pub shape: ShapeSummary,
    /// Seed of its bond anchors.
    pub seed: u64,
}

/// What the eigenvalues of the stiffness say of an equilibrium.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StabilitySummary {
    /// Whether all eigenvalues are positive beyond doubt: a minimum of the energy.
    pub stable: bool,
    /// Number of negative eigenvalues: more than none is a saddle.
    pub negative_eigenvalues: usize,
    /// Number of neutral modes: eigenvalues that cannot be distinguished from zero.
    pub unresolved_eigenvalues: usize,
    /// Below this magnitude eigenvalues cannot be told from zero (pN/nm).
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

/// Work that a run took.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct WorkSummary {
    /// Time steps.
    pub steps: u64,
    /// Evaluations of all loads.
    pub force_evaluations: u64,
    /// Newton iterations; none in dynamics.
    pub newton_iterations: u64,
}

/// The keys of [`Counts`] in the file.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Counts")]
struct CountKeys {
    monomers: usize,
    bonds: usize,
    segments: usize,
    junctions: usize,
    dofs: usize,
}

/// What is known of the error of the resolution.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AccuracySummary {
    /// The error of the number that an equilibrium was asked for it; no key where it was not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub model_error: Option<ModelError>,
    /// How filaments with drawn bonds scatter in that number; no key where it is not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drawn_bonds: Option<Scatter>,
    /// How sections were chosen; no key where the scene has them, also after it was resumed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub resolution: Option<Chosen>,
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
    /// Refuses numbers that are not finite: JSON has no way to write them.
    ///
    /// # Errors
    /// The first such number, with its key.
    pub(super) fn ensure_finite(&self, file: &str) -> Result<(), RunDirectoryError> {
        for (key, value) in self.scalars() {
            ensure_finite(file, &key, &[], [value])?;
        }
        for (key, vector) in vectors(self.tip_nm, self.tip_displacement_nm, &self.end_reactions) {
            ensure_finite(file, key, &[3], vector)?;
        }
        for (i, filament) in self.filaments.iter().enumerate() {
            filament.ensure_finite(file, &format!("filaments[{i}]"))?;
        }
        for (i, linker) in self.linkers.iter().enumerate() {
            linker.ensure_finite(file, &format!("linkers[{i}]"))?;
        }
        Ok(())
    }

    fn scalars(&self) -> Vec<(String, f64)> {
        let mut scalars: Vec<_> = [
            ("wall_s", self.wall_s),
            ("residual.force_pn", self.residual.force_pn),
            ("residual.torque_pn_nm", self.residual.torque_pn_nm),
        ]
        .map(|(key, value)| (key.to_owned(), value))
        .into();
        scalars.extend(self.energy_pn_nm.scalars());
        let steps = [
            ("time_ns", self.time_ns),
            ("path", self.path),
            ("time_step_ns", self.time_step_ns),
            ("smallest_gap_nm", self.smallest_gap_nm),
            (
                "largest_frequency_rad_per_ns",
                self.largest_frequency_rad_per_ns,
            ),
        ];
        scalars.extend(
            steps
                .into_iter()
                .filter_map(|(k, v)| Some((k.to_owned(), v?))),
        );
        let thermal = self
            .thermal
            .and_then(|thermal| thermal.kinetic_temperature_k);
        let key = "thermal.kinetic_temperature_k".to_owned();
        scalars.extend(thermal.map(|kelvin| (key, kelvin)));
        scalars.extend(self.shape.scalars());
        let observed = self.observables.iter();
        scalars.extend(observed.flat_map(|(name, one)| one.scalars(name)));
        scalars.extend(self.pushes.iter().enumerate().flat_map(pushes::scalars));
        let eigenvalue = self.lowest_stiffness_eigenvalue.into_iter();
        scalars.extend(eigenvalue.map(|value| ("lowest_stiffness_eigenvalue".to_owned(), value)));
        scalars
    }
}

impl FilamentSummary {
    fn ensure_finite(&self, file: &str, key: &str) -> Result<(), RunDirectoryError> {
        for (name, vector) in vectors(self.tip_nm, self.tip_displacement_nm, &self.end_reactions) {
            ensure_finite(file, &format!("{key}.{name}"), &[3], vector)?;
        }
        let energy = ("elastic_pn_nm".to_owned(), self.elastic_pn_nm);
        for (name, value) in self.shape.scalars().chain([energy]) {
            ensure_finite(file, &format!("{key}.{name}"), &[], [value])?;
        }
        Ok(())
    }
}

/// Vectors of a filament under their keys.
fn vectors(
    tip_nm: [f64; 3],
    tip_displacement_nm: [f64; 3],
    reactions: &EndReactions,
) -> Vec<(&'static str, [f64; 3])> {
    let mut vectors = vec![
        ("tip_nm", tip_nm),
        ("tip_displacement_nm", tip_displacement_nm),
    ];
    vectors.extend(reactions.vectors());
    vectors
}

#[cfg(test)]
mod tests;

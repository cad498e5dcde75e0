//! One row of the outcome, the same in JSON, CSV and pictures.

use super::observe::Errors;
use serde::Serialize;
use std::fs;
use std::path::Path;

/// One setting of one scene. What does not apply is null in JSON and empty in CSV.
///
/// Errors are relative, against the same filament with every monomer resolved at the same azimuth of
/// its lattice (in a motion, against the same motion in far smaller steps): rms over the azimuths,
/// and for sizes the mean of signed differences (`bias_...`). `scatter_...` is the standard
/// deviation of fully resolved filaments over samplings of 64 drawn bonds, relative to its mean.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub(super) struct Row {
    pub scene: String,
    /// What is varied.
    pub factor: String,
    pub setting: String,
    /// Stretches of monomers (nm).
    pub monomers_nm: String,
    pub law: String,
    pub segment_nm: f64,
    pub bonds_per_interface: usize,
    pub weight: String,
    pub attached: usize,
    /// Whether segments have the rotary inertia of rigid pieces of rod.
    pub rigid_segments: bool,
    pub azimuths: usize,
    pub bonds: usize,
    /// Segments of rods and bonds of junctions.
    pub elements: usize,
    pub dofs: usize,
    pub integrator: Option<String>,
    pub time_step_ns: Option<f64>,
    /// Of a motion: those that it took; of an equilibrium: mean over azimuths, all starts.
    pub force_evaluations: Option<f64>,
    /// Evaluations times bonds and elements.
    pub element_evaluations: Option<f64>,
    pub newton_steps: Option<f64>,
    /// Evaluations that 1 ns of motion takes.
    pub evaluations_per_ns: Option<f64>,
    /// Cost of a motion, of the reference as 1: bonds and elements that are evaluated in a ns.
    pub cost_motion: Option<f64>,
    /// The same in measured time.
    pub time_motion: Option<f64>,
    /// How many times as long every monomer with 64 drawn bonds takes.
    pub drawn_over_time: Option<f64>,
    /// Newton's time of the reference as 1, measured; of a damped motion, that of Newton as 1.
    pub time_relative: Option<f64>,
    pub time_s: Option<f64>,
    pub error_displacement: Option<f64>,
    pub error_energy: Option<f64>,
    pub error_force: Option<f64>,
    pub error_torque: Option<f64>,
    pub error_local: Option<f64>,
    pub bias_displacement: Option<f64>,
    pub bias_energy: Option<f64>,
    pub bias_force: Option<f64>,
    pub bias_torque: Option<f64>,
    pub bias_local: Option<f64>,
    pub scatter_displacement: Option<f64>,
    pub scatter_energy: Option<f64>,
    pub scatter_force: Option<f64>,
    pub scatter_torque: Option<f64>,
    pub scatter_local: Option<f64>,
    /// Samplings whose equilibrium is not certified as a minimum.
    pub doubtful: usize,
    /// Samplings without an equilibrium: the path broke off.
    pub failed: usize,
    /// Whether no other row of the scene has both less cost and less error of the displacement.
    pub on_front: bool,
}

impl Row {
    pub(super) fn with_errors(self, rms: Errors, bias: Errors, scatter: Errors) -> Self {
        Self {
            error_displacement: rms.displacement,
            error_energy: rms.energy,
            error_force: rms.force,
            error_torque: rms.torque,
            error_local: rms.local,
            bias_displacement: bias.displacement,
            bias_energy: bias.energy,
            bias_force: bias.force,
            bias_torque: bias.torque,
            bias_local: bias.local,
            scatter_displacement: scatter.displacement,
            scatter_energy: scatter.energy,
            scatter_force: scatter.force,
            scatter_torque: scatter.torque,
            scatter_local: scatter.local,
            ..self
        }
    }

    /// Every number that is there.
    #[cfg(test)]
    pub(super) fn numbers(&self) -> Vec<f64> {
        let value = serde_json::to_value(self).unwrap_or_default();
        let entries = value.as_object().into_iter().flatten();
        entries.filter_map(|(_, v)| v.as_f64()).collect()
    }
}

/// Writes `tradeoff.json` and `tradeoff.csv`.
pub(super) fn write(rows: &[Row], out: &Path) -> Result<(), String> {
    let json = serde_json::to_string_pretty(rows).map_err(|e| e.to_string())?;
    let path = out.join("tradeoff.json");
    fs::write(&path, json + "\n").map_err(|e| format!("{}: {e}", path.display()))?;
    let path = out.join("tradeoff.csv");
    let mut csv = csv::Writer::from_path(&path).map_err(|e| e.to_string())?;
    for row in rows {
        csv.serialize(row).map_err(|e| e.to_string())?;
    }
    csv.flush().map_err(|e| e.to_string())
}

//! Scatter of energy and loads over drawn bonds.

use super::checks::statistics;
use super::filament::{self, PERIOD};
use crate::Tell;
use actin_sim::ellipsoid::CellResponse;
use rayon::prelude::*;
use std::fmt::Write as _;
use std::path::Path;

/// A strain at which filaments are compared.
#[derive(Debug)]
pub(super) struct State {
    pub(super) name: &'static str,
    /// Curvature (rad/nm), twist (rad/nm), shear, stretch beyond that of the free filament of this twist,
    /// angle between curvature and shear (deg).
    pub(super) strain: [f64; 5],
}

/// A state with its strains.
const fn state(name: &'static str, strain: [f64; 5]) -> State {
    State { name, strain }
}

/// The states.
pub(super) const STATES: [State; 10] = [
    state("bent", [5e-3, 0.0, 0.0, 0.0, 0.0]),
    state("over-twisted", [0.0, 0.02, 0.0, 0.0, 0.0]),
    state("under-twisted", [0.0, -0.02, 0.0, 0.0, 0.0]),
    state("sheared", [0.0, 0.0, 0.01, 0.0, 0.0]),
    state("stretched", [0.0, 0.0, 0.0, 1e-3, 0.0]),
    state("stretched and sheared", [0.0, 0.0, 0.01, 1e-3, 0.0]),
    state("twisted and sheared", [0.0, 0.01, 0.01, 0.0, 0.0]),
    state("bent and stretched", [5e-3, 0.0, 0.0, 5e-4, 0.0]),
    state("bent, sheared, stretched", [5e-3, 0.0, 5e-3, 3e-4, 0.0]),
    state("all", [5e-3, -0.01, 5e-3, 3e-4, 60.0]),
];

/// Responses of so many samplings of drawn bonds, in each state.
pub(super) fn of_drawn(samplings: u64, monomers: usize) -> Result<Vec<Vec<CellResponse>>, String> {
    (1..=samplings)
        .into_par_iter()
        .map(|seed| {
            let cell = filament::drawn(seed, monomers)?;
            STATES.iter().map(|state| state.relax(&cell, 0.0)).collect()
        })
        .collect()
}

/// Prints and writes the mean filament beside drawn bonds.
pub(super) fn run(out: &Path, samplings: u64, tell: Tell<'_>) -> Result<(), String> {
    let cell = filament::mean()?;
    let all = of_drawn(samplings, 2 * PERIOD)?;
    let names = [
        "energy (pN)",
        "m1",
        "m2",
        "m3 (pN nm)",
        "n1",
        "n2",
        "n3 (pN)",
    ];
    let mut table = format!("| state | {} |\n", names.join(" | "));
    let _ = writeln!(table, "| --- |{}", " ---: |".repeat(names.len()));
    for (k, state) in STATES.iter().enumerate() {
        let mean = state.relax(&cell, 0.0)?;
        let _ = write!(table, "| {} |", state.name);
        for number in 0..7 {
            let pick = |r: &CellResponse| match number {
                0 => r.energy,
                n => r.loads[n - 1],
            };
            let drawn: Vec<f64> = all.iter().map(|one| pick(&one[k])).collect();
            let (average, deviation) = statistics(&drawn);
            let _ = write!(
                table,
                " {:.4}; {average:.4} +- {deviation:.4} |",
                pick(&mean)
            );
        }
        table.push('\n');
    }
    tell(format_args!("{table}"));
    let path = out.join("scatter.md");
    std::fs::write(&path, table).map_err(|e| format!("{}: {e}", path.display()))
}

//! The mean filament at a temperature: mean loads of its cells under held strain, beside relaxed cells and the
//! thermal motion of filaments.
//!
//! Numbers of the free filament are in `table.rs`, loads for fits in `grid.rs`, the law in `law.rs`.

mod grid;
mod law;
mod natural;
mod table;

use actin_sim::BOLTZMANN_PN_NM_PER_K;
use actin_sim::ellipsoid::Heat;
use std::path::Path;

/// Share of accepted trajectories: means do not depend on it.
const ACCEPTANCE: f64 = 0.8;
/// The seed; points are told apart by their streams.
const SEED: u64 = 1;

/// Prints and writes table and grid.
pub(super) fn run(out: &Path, temperature_k: f64, quick: bool) -> Result<(), String> {
    if !(temperature_k > 0.0 && temperature_k.is_finite()) {
        return Err(format!("temperature {temperature_k} K: must be above 0"));
    }
    let kt = BOLTZMANN_PN_NM_PER_K * temperature_k;
    let rows = grid::compute(out, kt, quick)?;
    // A quick run has too few for a law.
    if !quick {
        law::run(out, temperature_k, &rows)?;
    }
    table::run(out, kt, quick)
}

/// Sampling of one point.
fn heat(kt: f64, samples: usize, stream: u64) -> Heat {
    Heat {
        kt,
        samples,
        acceptance: ACCEPTANCE,
        seed: SEED,
        stream,
    }
}

//! The mean filament at a temperature: mean loads of cells under prescribed strain, compared with relaxed cells and
//! with the thermal motion of filaments.

mod grid;
mod law;
mod natural;
mod table;

use actin_cosserat::Homogenised;
use actin_sim::BOLTZMANN_PN_NM_PER_K;
use actin_sim::ellipsoid::Heat;
use std::path::Path;

/// Target acceptance rate of trajectories, which does not affect means.
const ACCEPTANCE: f64 = 0.8;
const SEED: u64 = 1;

pub(super) fn run(out: &Path, temperature_k: f64, quick: bool) -> Result<(), String> {
    if !(temperature_k > 0.0 && temperature_k.is_finite()) {
        return Err(format!("temperature {temperature_k} K: must be above 0"));
    }
    let kt = BOLTZMANN_PN_NM_PER_K * temperature_k;
    let rows = grid::compute(out, kt, quick)?;
    // A quick run has too few points for a law.
    if !quick {
        law::run(out, temperature_k, &rows)?;
    }
    table::run(out, kt, quick)
}

/// Law at a temperature, from samples in a separate folder.
pub(super) fn law(out: &Path, temperature_k: f64) -> Result<Homogenised, String> {
    let out = out.join(format!("{temperature_k}_k"));
    let rows = grid::compute(&out, BOLTZMANN_PN_NM_PER_K * temperature_k, false)?;
    law::fit(&rows)
}

fn heat(kt: f64, samples: usize, stream: u64) -> Heat {
    Heat {
        kt,
        samples,
        acceptance: ACCEPTANCE,
        seed: SEED,
        stream,
    }
}

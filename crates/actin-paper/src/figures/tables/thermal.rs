//! Persistence length from thermal motion, with and without the factor 1.4 on rigidities.

use super::ensemble::Kind;
use crate::figures::draft::Draft;
use crate::measure::{far_lengths, turns_in_bath};
use actin_integrate::POSITION_VERLET;
use actin_sim::{Filament, Monomers, Section, ellipsoid_constants as monomer};

/// Filaments of each kind, for a standard error of 2 to 3 %.
const FILAMENTS: u64 = 32;
/// Length (nm), and ratio of the time step to the stability limit.
const LENGTH_NM: f64 = 110.0;
const SHARE: f64 = 0.4;

/// Rows for the default rigidities and for the published rigidities of the interfaces.
pub(super) fn rows(draft: &mut Draft<'_>) -> Result<(), String> {
    let scaled = Kind::DEFAULT.monomers(0);
    let scale = monomer::RIGIDITY_SCALE;
    let unscaled = Monomers {
        lateral_rigidity_pn_per_nm: scaled.lateral_rigidity_pn_per_nm / scale,
        longitudinal_rigidity_pn_per_nm: scaled.longitudinal_rigidity_pn_per_nm / scale,
        ..scaled.clone()
    };
    for (quantity, monomers) in [
        ("persistence_length_um/thermal", scaled),
        ("persistence_length_unscaled_um/thermal", unscaled),
    ] {
        let (length, error) = persistence_length_um(draft, &monomers)?;
        let note = format!(
            "slope of -ln <cos theta> between 22 and 66 nm at 298 K; {FILAMENTS} free filaments of 110 nm, 64 \
             sampled bonds, 400 samples each, standard error {error:.2}; position Verlet at 0.4 times its stability \
             limit; tolerance: half a digit and twice the standard error"
        );
        draft.scattered(quantity, "um", (length, error), note);
    }
    Ok(())
}

/// Persistence length at 298 K and its standard error (um), from free filaments with different noise and bonds.
fn persistence_length_um(draft: &Draft<'_>, monomers: &Monomers) -> Result<(f64, f64), String> {
    let replicas: Vec<u64> = (0..FILAMENTS).collect();
    let all = draft.solve(&replicas, |&replica| {
        let filament = Filament {
            monomers: Monomers {
                seed: replica,
                ..monomers.clone()
            },
            ..Filament::new(vec![Section::ellipsoids(0.0, LENGTH_NM)])
        };
        turns_in_bath(filament, (&POSITION_VERLET, SHARE), replica)
    })?;
    let [(length, error), _] = far_lengths(&all, monomers.rise_nm);
    Ok((1e-3 * length, 1e-3 * error))
}

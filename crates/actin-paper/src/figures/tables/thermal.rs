//! The persistence length from thermal motion, of monomers as they are and without the factor 1.4.

use super::ensemble::Kind;
use crate::figures::Run;
use crate::measure::{Turns, far_lengths, turns_in_bath};
use actin_draw::report::Row;
use actin_integrate::POSITION_VERLET;
use actin_sim::{Filament, Monomers, Section, ellipsoid_constants as monomer};
use rayon::prelude::*;

/// Filaments of each kind: a standard error of 2 to 3 %.
const FILAMENTS: u64 = 32;
/// Length (nm), and time step over the stability limit.
const LENGTH_NM: f64 = 110.0;
const SHARE: f64 = 0.4;

/// Two rows, beside the lengths that the paper expects of the one and reports of the other.
pub(super) fn rows(Run { progress, .. }: Run<'_>) -> Result<Vec<Row>, String> {
    progress.expect(2 * usize::try_from(FILAMENTS).unwrap_or(0));
    let scaled = Kind::DEFAULT.monomers(0);
    let scale = monomer::RIGIDITY_SCALE;
    let unscaled = Monomers {
        lateral_rigidity_pn_per_nm: scaled.lateral_rigidity_pn_per_nm / scale,
        longitudinal_rigidity_pn_per_nm: scaled.longitudinal_rigidity_pn_per_nm / scale,
        ..scaled.clone()
    };
    let expected = "which the paper expects with the factor 1.4";
    let reported =
        "interfaces of the published rigidity, of which the paper cites a simulated length";
    let row = |quantity, monomers: &Monomers, paper, what| {
        let (length, error) = persistence_length_um(monomers, || progress.done())?;
        let note = format!(
            "slope of -ln <cos theta> between 22 and 66 nm at 298 K, {what}; {FILAMENTS} free filaments of \
             110 nm, 64 drawn bonds, 400 samples of each, standard error {error:.2}; position Verlet at \
             0.4 of its limit; tolerance: half a digit and twice the standard error"
        );
        let row = Row::measured("table4", quantity, "um", length, note);
        Ok::<Row, String>(row.against_printed(paper, error))
    };
    Ok(vec![
        row("persistence_length_um/thermal", &scaled, "9.8", expected)?,
        row(
            "persistence_length_unscaled_um/thermal",
            &unscaled,
            "7.0",
            reported,
        )?,
    ])
}

/// Persistence length (um) of monomers at 298 K with its standard error, from free filaments
/// that differ in their noise and in the sampling of their bonds.
fn persistence_length_um(
    monomers: &Monomers,
    done: impl Fn() + Sync,
) -> Result<(f64, f64), String> {
    let section = Section::Ellipsoids {
        from_nm: 0.0,
        to_nm: LENGTH_NM,
        altered: None,
    };
    let replica = |replica: u64| {
        let filament = Filament {
            monomers: Monomers {
                seed: replica,
                ..monomers.clone()
            },
            ..Filament::new(vec![section.clone()])
        };
        turns_in_bath(filament, (&POSITION_VERLET, SHARE), replica)
    };
    let all: Vec<Turns> = (0..FILAMENTS)
        .into_par_iter()
        .map(replica)
        .inspect(|_| done())
        .collect::<Result<_, _>>()?;
    let [(length, error), _] = far_lengths(&all, monomers.rise_nm);
    Ok((1e-3 * length, 1e-3 * error))
}

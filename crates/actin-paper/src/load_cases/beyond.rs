//! Errors of cantilevers beyond the data of `Homogenised`, which the extrapolation warning quotes.

use super::case::{Case, Group};
use super::ends::of_mean_filament;
use super::filament::FilamentModel;
use super::solve::scene;
use crate::ProgressSink;
use crate::measure::follow;
use crate::statistics::sample;
use actin_draw::report::save;
use actin_sim::{End, RodLaw};
use rayon::prelude::*;
use std::fmt::Write as _;
use std::path::Path;

/// Lengths of the cantilevers (rises): 62, 100, 160, 220, 303 nm.
const RISES: [f64; 5] = [22.5, 36.5, 58.5, 80.5, 110.5];
/// Transverse tip forces (pN).
const FORCES_PN: [f64; 7] = [1.0, 2.0, 3.0, 4.0, 5.0, 7.0, 10.0];
const AZIMUTHS: u32 = 6;
const GROUPS: usize = 5;
/// Folder of the committed table, which the program includes.
const COMMITTED: &str = "crates/actin-assembly/src";
const FILE: &str = "extrapolation.csv";

/// A quantity that exceeds its range.
struct Excess {
    quantity: String,
    value: f64,
    of_mean: f64,
    of_one_azimuth: f64,
}

/// Writes `extrapolation.csv`; with `write` also into the folder of the committed table.
pub(super) fn run(out: &Path, write: bool, tell: ProgressSink<'_>) -> Result<(), String> {
    let table = computed(out)?;
    tell(format_args!("{table}"));
    save(out, FILE, &table)?;
    if write {
        save(&crate::workspace_root().join(COMMITTED), FILE, &table)?;
    }
    Ok(())
}

fn computed(out: &Path) -> Result<String, String> {
    let all = RISES.par_iter().map(|&rises| excesses(out, rises));
    let all = all.collect::<Result<Vec<_>, String>>()?;
    Ok(table(all.into_iter().flatten().collect()))
}

/// Excess strains and errors under each force, for a rod with segments of 10 nm.
fn excesses(out: &Path, rises: f64) -> Result<Vec<Excess>, String> {
    let name = format!("{rises} rises, beyond");
    let case = Case::forces(Group::Beside, name, rises, (None, 0.0, &FORCES_PN));
    let monomers = of_mean_filament(out, &case, AZIMUTHS)?;
    let (scene, _) = scene(&case, &FilamentModel::coarse(&RodLaw::Homogenised));
    let ends = follow(&scene).map_err(|e| e.to_string())?;
    if let Some(ended) = ends.ended {
        return Err(ended.to_string());
    }
    let start = ends.assembly.tip_nm(&ends.assembly.rest, End::End).x;
    let mut all = Vec::new();
    for (force, stop) in FORCES_PN.iter().zip(&ends.stops) {
        let tip = ends.assembly.tip_nm(&stop.state, End::End).x - start;
        let name = format!("tip at {force} pN (nm)");
        let tips: Vec<f64> = monomers.iter().filter_map(|m| m.value(&name)).collect();
        let error = |of: f64| (tip / of - 1.0).abs();
        let of_mean = error(sample(tips.iter().copied()).mean);
        let of_one_azimuth = sample(tips.into_iter().map(error)).high;
        for beyond in ends.assembly.beyond_range(&stop.state) {
            all.push(Excess {
                quantity: beyond.quantity,
                value: beyond.value,
                of_mean,
                of_one_azimuth,
            });
        }
    }
    let is_whole = monomers.iter().all(|m| m.values.len() == FORCES_PN.len());
    let lost = || format!("{}: no equilibrium at some of the forces", case.name);
    is_whole.then_some(all).ok_or_else(lost)
}

/// Largest errors up to each excess, for groups of about equal size.
fn table(mut all: Vec<Excess>) -> String {
    all.sort_by(|a, b| a.value.abs().total_cmp(&b.value.abs()));
    let mut text = "quantity,up_to,of_mean,of_one_azimuth\n".to_owned();
    for quantity in ["shear", "curvature", "stretch"] {
        let own: Vec<&Excess> = all.iter().filter(|e| e.quantity == quantity).collect();
        let size = own.len().div_ceil(GROUPS).max(1);
        let (mut of_mean, mut of_one_azimuth) = (0.0, 0.0);
        for group in own.chunks(size) {
            for excess in group {
                of_mean = f64::max(of_mean, excess.of_mean);
                of_one_azimuth = f64::max(of_one_azimuth, excess.of_one_azimuth);
            }
            let up_to = group.last().map_or(f64::NAN, |e| e.value);
            _ = writeln!(
                text,
                "{quantity},{up_to:.4},{of_mean:.4},{of_one_azimuth:.4}"
            );
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The warnings of the program quote errors of the present law. The bound is the rounding of
    /// four decimals.
    #[test]
    fn the_committed_errors_come_out_again() {
        let folder = tempfile::tempdir().unwrap();
        let committed = crate::workspace_root().join(COMMITTED).join(FILE);
        let committed = std::fs::read_to_string(committed).unwrap();
        let again = computed(folder.path()).unwrap();
        assert_eq!(again.lines().count(), committed.lines().count());
        for (new, old) in again.lines().zip(committed.lines()) {
            for (a, b) in new.split(',').zip(old.split(',')) {
                let both = a.parse::<f64>().ok().zip(b.parse::<f64>().ok());
                let is_equal = both.map_or(a == b, |(a, b)| (a - b).abs() < 1.5e-4);
                assert!(is_equal, "{new}, committed {old}");
            }
        }
    }
}

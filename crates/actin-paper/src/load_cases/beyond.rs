//! Errors of cantilevers that leave the data of `Homogenised`: the numbers that the warning gives.

use super::bound::Group;
use super::case::{Case, Kind};
use super::ends::of_mean_filament;
use super::filament::{Made, RISE_NM, Rod};
use super::solve::course;
use crate::Tell;
use crate::measure::follow;
use actin_draw::report::save;
use actin_sim::{End, RodLaw};
use rayon::prelude::*;
use std::fmt::Write as _;
use std::path::Path;

/// From the wall to the load, less half a rise: 62, 100, 160, 220, 303 nm.
const RISES: [u32; 5] = [22, 36, 58, 80, 110];
/// Forces across the tip (pN).
const FORCES_PN: [f64; 7] = [1.0, 2.0, 3.0, 4.0, 5.0, 7.0, 10.0];
/// Azimuths of the lattice.
const AZIMUTHS: u32 = 6;
/// Rows of each quantity.
const GROUPS: usize = 5;
/// Where the program reads them.
const COMMITTED: &str = "crates/actin-sim/src/assembly";
const FILE: &str = "extrapolation.csv";

/// A quantity that a cantilever takes beyond its range.
struct Excess {
    quantity: String,
    value: f64,
    of_mean: f64,
    of_one_azimuth: f64,
}

/// Measures, and writes `extrapolation.csv`; with `write` also where the program reads it.
///
/// # Errors
/// A rod or monomers without an equilibrium, and a file that cannot be written.
pub(super) fn run(out: &Path, write: bool, tell: Tell<'_>) -> Result<(), String> {
    let folder = out.join("monomers");
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let all = RISES.par_iter().map(|&rises| excesses(&folder, rises));
    let all = all
        .collect::<Result<Vec<_>, String>>()?
        .into_iter()
        .flatten();
    let table = table(all.collect());
    tell(format_args!("{table}"));
    save(out, FILE, &table)?;
    if write {
        save(&crate::workspace_root().join(COMMITTED), FILE, &table)?;
    }
    Ok(())
}

/// What a rod of segments of 10 nm takes beyond the data of its law, and its errors, under each force.
fn excesses(folder: &Path, rises: u32) -> Result<Vec<Excess>, String> {
    let case = Case {
        group: Group::Beside,
        name: format!("{rises} rises, beyond"),
        kind: Kind::Cantilever {
            rises,
            tension_pn: 0.0,
            forces_pn: FORCES_PN.to_vec(),
        },
    };
    let monomers = of_mean_filament(folder, &case, AZIMUTHS)?;
    let rod = Made::Rod(Rod::coarse(&RodLaw::Homogenised));
    let ends = follow(&course(&case.kind).scene(&rod)).map_err(|e| e.to_string())?;
    if let Some(ended) = ends.ended {
        return Err(ended.to_string());
    }
    let start = ends.assembly.tip_nm(&ends.assembly.rest, End::End).x;
    let mut all = Vec::new();
    for (force, stop) in FORCES_PN.iter().zip(&ends.stops) {
        let tip = ends.assembly.tip_nm(&stop.state, End::End).x - start;
        let name = format!("tip at {force} pN (nm)");
        let tips: Vec<f64> = monomers.iter().filter_map(|m| m.value(&name)).collect();
        let mean = tips.iter().sum::<f64>() / tips.len() as f64;
        let error = |of: f64| (tip / of - 1.0).abs();
        let of_one_azimuth = tips.iter().copied().map(error).fold(f64::NAN, f64::max);
        for beyond in ends.assembly.beyond_range(&stop.state) {
            all.push(Excess {
                quantity: beyond.quantity,
                value: beyond.value,
                of_mean: error(mean),
                of_one_azimuth,
            });
        }
    }
    let length = (f64::from(rises) + 0.5) * RISE_NM;
    let whole = monomers.iter().all(|m| m.values.len() == FORCES_PN.len());
    whole
        .then_some(all)
        .ok_or_else(|| format!("{length:.0} nm of monomers: not every force was reached"))
}

/// For each quantity groups of about equal size by value, with the largest errors up to there.
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

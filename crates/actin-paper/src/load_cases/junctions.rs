//! Whether a junction of rod and monomers has an end effect of its own: guided beams that are half rod, between
//! those that are all rod and those that are all monomers.

use super::Law;
use super::bound::Group;
use super::case::{Case, guided};
use super::filament::{Made, RISE_NM, Rod};
use super::solve::{Found, solve};
use std::fmt::Write as _;
use std::path::Path;

/// Spans, in rises, and tensions (pN).
const SPANS: [u32; 4] = [11, 15, 22, 33];
const TENSIONS_PN: [f64; 2] = [0.0, 10.0];

/// What guided beams of one kind do at each force (nm/pN), over azimuths.
fn mean(case: &Case, azimuths: u32, made: impl Fn(f64) -> Made) -> Result<Vec<f64>, String> {
    let at = |k: u32| solve(case, &made(f64::from(k) * 360.0 / f64::from(azimuths)));
    let found: Vec<Found> = (0..azimuths).map(at).collect::<Result<_, String>>()?;
    let of = |k: usize| found.iter().map(|f| f.values[k].1).sum::<f64>() / found.len() as f64;
    let reached = found.iter().map(|f| f.values.len()).min().unwrap_or(0);
    Ok((0..reached).map(of).collect())
}

/// A table of errors: of rods as a whole, of half rods, and how far the latter are from the mean of the former and
/// monomers.
///
/// # Errors
/// Monomers without an equilibrium, and a folder that cannot be written.
pub(super) fn page(folder: &Path, (name, law): &Law, azimuths: u32) -> Result<String, String> {
    let mut text = format!(
        "\n### Junctions, {name}\n\nErrors of a guided beam of rod, and of one that is half rod; in brackets from the mean of \
         rod and monomers.\n\n| span | tension | force | rod | half rod |\n| ---: | ---: | ---: | ---: | ---: |\n"
    );
    let all = SPANS.into_iter().flat_map(|n| TENSIONS_PN.map(|t| (n, t)));
    for (rises, tension) in all {
        let case = guided(Group::Beside, rises, tension);
        let monomers = super::ends::of_mean_filament(folder, &case, azimuths)?;
        let nm = f64::from(rises) * RISE_NM;
        let rod = Rod::fine(law);
        let whole = mean(&case, 1, |_| Made::Rod(rod.clone()))?;
        let half = mean(&case, azimuths, |azimuth_deg| Made::Mixed {
            rod: rod.clone(),
            stretches: vec![[0.0, 0.5 * nm]],
            azimuth_deg,
        })?;
        for (k, (whole, half)) in whole.iter().zip(&half).enumerate() {
            let of = |found: &Found| found.values[k].1;
            let exact = monomers.iter().map(of).sum::<f64>() / monomers.len() as f64;
            let error = |value: f64, exact: f64| 100.0 * (value / exact - 1.0);
            _ = writeln!(
                text,
                "| {nm:.0} nm | {tension} pN | {} | {:+.1} % | {:+.1} % ({:+.1} %) |",
                monomers[0].values[k].0.replace("nm/pN at ", ""),
                error(*whole, exact),
                error(*half, exact),
                error(*half, 0.5 * (whole + exact)),
            );
        }
    }
    Ok(text)
}

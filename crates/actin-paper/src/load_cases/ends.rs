//! Errors of rods at short spans, from 25 to 151 nm, and of guided beams that are half rod; writes
//! `ends.md`.

use super::case::{Case, Group, Loading, azimuths_deg};
use super::filament::FilamentModel;
use super::solve::{CaseSolution, solve};
use super::{Law, cached};
use crate::ProgressSink;
use crate::statistics::sample;
use actin_draw::report::save;
use actin_sim::{FreeTranslation, RodLaw};
use rayon::prelude::*;
use std::fmt::Write as _;
use std::path::Path;

const SPANS: [f64; 6] = [9.0, 11.0, 15.0, 22.0, 33.0, 55.0];
/// Number of azimuths over which the mean filament is averaged.
const AZIMUTHS: u32 = 8;
/// Spans (rises) and tensions (pN) of beams that are half rod.
const HALVED: [f64; 4] = [11.0, 15.0, 22.0, 33.0];
const HALVED_PULL_PN: [f64; 2] = [0.0, 10.0];

/// Measures all laws and writes `ends.md`.
pub(super) fn run(out: &Path, laws: &[Law], tell: ProgressSink<'_>) -> Result<(), String> {
    let mut text = String::from("# Ends\n");
    for (name, law) in laws {
        _ = writeln!(text, "\n## {name}\n\n{}", spans(out, law)?);
        _ = writeln!(text, "### Junctions, {name}\n\n{}", halves(out, law)?);
    }
    tell(format_args!("{text}"));
    save(out, "ends.md", &text)
}

/// Cases of one span with the names of their loads.
fn cases(rises: f64) -> [(&'static str, Case); 6] {
    let name = |load: &str| format!("{rises} rises, {load}");
    let guided = |tension| Case::guided(Group::Beside, rises, tension);
    let turns_deg = vec![-120.0, -40.0, -10.0, 10.0, 40.0, 120.0];
    let twisted = Loading::Twisted { turns_deg };
    let twisted = Case::new(Group::Beside, name("twisted"), rises, twisted);
    let pulled = (Some(FreeTranslation::AlongAxis), 0.0, &[10.0][..]);
    let pulled = Case::forces(Group::Beside, name("pulled"), rises, pulled);
    let loads = (None, 0.0, &[0.5][..]);
    let cantilever = Case::forces(Group::Beside, name("cantilever"), rises + 0.5, loads);
    [
        ("guided, no tension", guided(0.0)),
        ("guided, 5 pN", guided(5.0)),
        ("guided, 10 pN", guided(10.0)),
        ("twisted", twisted),
        ("pulled", pulled),
        ("cantilever", cantilever),
    ]
}

/// Table of errors by load and span for a rod with short segments, ± half the range of the mean
/// filament over azimuths.
fn spans(out: &Path, law: &RodLaw) -> Result<String, String> {
    let columns = SPANS.par_iter().map(|&rises| {
        let errors = cases(rises).into_iter().map(|(load, case)| {
            let monomers = of_mean_filament(out, &case, AZIMUTHS)?;
            let rod = solve(&case, &FilamentModel::fine(law))?;
            let names = rod.values.iter().map(|(name, _)| name);
            let names = names.filter(|name| !name.starts_with("dL/L"));
            let cell = |name: &String| {
                let (mean, range) = mean_of(&monomers, name);
                let error = rod.value(name).map_or(f64::NAN, |rod| rod / mean - 1.0);
                let half = (range > 0.0).then(|| format!(" ± {:.0}", 50.0 * range));
                let text = format!("{:+.1} %{}", 100.0 * error, half.unwrap_or_default());
                (format!("| {load} | {name} |"), text)
            };
            Ok(names.map(cell).collect::<Vec<_>>())
        });
        Ok(errors.collect::<Result<Vec<_>, String>>()?.concat())
    });
    let columns = columns.collect::<Result<Vec<_>, String>>()?;
    let mut text = String::from("| load | quantity |");
    for case in SPANS.map(|rises| Case::guided(Group::Beside, rises, 0.0)) {
        _ = write!(text, " {:.0} nm |", case.length_nm());
    }
    _ = writeln!(text, "\n| --- | --- |{}", " ---: |".repeat(SPANS.len()));
    for (k, (name, _)) in columns[0].iter().enumerate() {
        text += name;
        for column in &columns {
            let cell = column.get(k).map_or("none", |(_, cell)| cell);
            _ = write!(text, " {cell} |");
        }
        text.push('\n');
    }
    Ok(text)
}

/// Table of errors of guided beams that are rod and half rod; in brackets the error against the
/// mean of rod and monomers.
fn halves(out: &Path, law: &RodLaw) -> Result<String, String> {
    let mut text = String::from(
        "| span | tension | force | rod | half rod |\n| ---: | ---: | ---: | ---: | ---: |\n",
    );
    let all = HALVED
        .into_iter()
        .flat_map(|n| HALVED_PULL_PN.map(|t| (n, t)));
    for (rises, tension) in all {
        let case = Case::guided(Group::Beside, rises, tension);
        let nm = case.length_nm();
        let monomers = of_mean_filament(out, &case, AZIMUTHS)?;
        let whole = solve(&case, &FilamentModel::fine(law))?;
        let half = azimuths_deg(AZIMUTHS).into_iter().map(|azimuth_deg| {
            let rods = vec![[0.0, 0.5 * nm]];
            let made = FilamentModel::mean(azimuth_deg).with_rods(law, rods);
            solve(&case, &made.with_short_segments())
        });
        let half = half.collect::<Result<Vec<CaseSolution>, String>>()?;
        for (name, whole) in &whole.values {
            let (exact, _) = mean_of(&monomers, name);
            let (half, _) = mean_of(&half, name);
            let error = |value: f64, exact: f64| 100.0 * (value / exact - 1.0);
            _ = writeln!(
                text,
                "| {nm:.0} nm | {tension} pN | {} | {:+.1} % | {:+.1} % ({:+.1} %) |",
                name.replace("nm/pN at ", ""),
                error(*whole, exact),
                error(half, exact),
                error(half, 0.5 * (whole + exact)),
            );
        }
    }
    Ok(text)
}

/// Mean of a quantity, and its range over its mean.
fn mean_of(found: &[CaseSolution], name: &str) -> (f64, f64) {
    let s = sample(found.iter().filter_map(|found| found.value(name)));
    (s.mean, s.spread().abs())
}

/// The mean filament at equidistant azimuths; axisymmetric cases have one azimuth.
pub(super) fn of_mean_filament(
    out: &Path,
    case: &Case,
    azimuths: u32,
) -> Result<Vec<CaseSolution>, String> {
    let is_across = match &case.loading {
        Loading::Forces { far_end, .. } => *far_end != Some(FreeTranslation::AlongAxis),
        _ => false,
    };
    let azimuths = azimuths_deg(if is_across { azimuths } else { 1 });
    let mean = |azimuth_deg: f64| {
        cached(
            Some(&super::folder(out)?),
            case,
            &FilamentModel::mean(azimuth_deg),
        )?
        .0
    };
    azimuths.into_iter().map(mean).collect()
}

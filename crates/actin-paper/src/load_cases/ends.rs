//! Whether ends explain what a rod is off by: at spans from 25 to 160 nm, the length that is missing from a rod
//! if it is to do what monomers do.
//!
//! A rod of segments so short that they do not matter is made shorter or longer by `x` nm between the same
//! loads: forces, or turns of its ends. The `x` at which it agrees is sought for each load and span, and one
//! for all spans of a kind.

use super::bound::Group;
use super::case::{Case, Kind, guided};
use super::filament::{Made, RISE_NM, Rod};
use super::solve::{Found, solve};
use super::{Law, junctions, store};
use crate::Tell;
use actin_draw::report::{save, write_csv};
use actin_sim::RodLaw;
use rayon::prelude::*;
use std::fmt::Write as _;
use std::path::Path;

/// Spans, in rises: 25, 30, 41, 60, 90, 151 nm.
const SPANS: [u32; 6] = [9, 11, 15, 22, 33, 55];
/// Lengths that are tried (nm): from `FROM` on, `STEP` apart.
const FROM: f64 = -4.0;
const STEP: f64 = 1.0;
const TRIED: usize = 15;
/// Azimuths of the lattice over which the mean filament is averaged.
const AZIMUTHS: u32 = 8;

/// One quantity of one span: of monomers, and of rods by what they are shortened.
#[derive(Clone, Debug)]
struct Line {
    kind: &'static str,
    span_nm: f64,
    quantity: String,
    monomers: f64,
    /// Half the difference of the largest and the smallest value over azimuths, over the mean.
    scatter: f64,
    /// By length left out; none where there is no equilibrium.
    rods: Vec<Option<f64>>,
}

/// Measures all laws; writes `ends.csv` and `ends.md`.
///
/// # Errors
/// A file that cannot be written, and monomers without an equilibrium.
pub(super) fn run(out: &Path, laws: &[Law], tell: Tell<'_>) -> Result<(), String> {
    let folder = out.join("monomers");
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let cases = cases();
    let (mut text, mut table) = (String::from("# Ends\n"), Vec::new());
    for (name, law) in laws {
        let lines = cases
            .par_iter()
            .map(|(kind, case)| lines(&folder, kind, case, law));
        let lines = lines.collect::<Result<Vec<_>, String>>()?.concat();
        table.extend(lines.iter().map(|line| line.cells(name)));
        text += &page(name, &lines);
        text += &junctions::page(&folder, &(name.clone(), law.clone()), AZIMUTHS)?;
    }
    tell(format_args!("{text}"));
    save(out, "ends.md", &text)?;
    let header = [
        "law",
        "load",
        "span_nm",
        "quantity",
        "monomers",
        "rod",
        "error",
        "missing_nm",
    ];
    write_csv(out, "ends.csv", &header, table)
}

/// Cases by the kind of load that may have an end correction of its own.
fn cases() -> Vec<(&'static str, Case)> {
    SPANS.into_iter().flat_map(cases_of).collect()
}

fn cases_of(rises: u32) -> Vec<(&'static str, Case)> {
    let case = |load: &'static str, kind: Kind| {
        let own = Case {
            group: Group::Beside,
            name: format!("{rises} rises, {load}"),
            kind,
        };
        (load, own)
    };
    let stretched = |turn_deg: f64, force: f64| Kind::Stretched {
        rises,
        turn_deg,
        forces_pn: vec![force],
    };
    let twisted = Kind::Twisted {
        rises,
        turns_deg: vec![10.0, -10.0, 40.0, -40.0, 120.0, -120.0],
    };
    let cantilever = Kind::Cantilever {
        rises,
        tension_pn: 0.0,
        forces_pn: vec![0.5],
    };
    vec![
        ("guided, no tension", guided(Group::Beside, rises, 0.0)),
        ("guided, 5 pN", guided(Group::Beside, rises, 5.0)),
        ("guided, 10 pN", guided(Group::Beside, rises, 10.0)),
        case("twisted", twisted),
        case("pulled", stretched(0.0, 10.0)),
        case("pulled, over-twisted", stretched(80.0, 10.0)),
        case("pulled, under-twisted", stretched(-80.0, 10.0)),
        case("pushed", stretched(0.0, -10.0)),
        case("cantilever", cantilever),
    ]
}

fn span_nm(case: &Case) -> f64 {
    match case.kind {
        Kind::Cantilever { rises, .. } => (f64::from(rises) + 0.5) * RISE_NM,
        Kind::Guided { rises, .. }
        | Kind::Twisted { rises, .. }
        | Kind::Stretched { rises, .. } => f64::from(rises) * RISE_NM,
        Kind::Linked { .. } | Kind::Buckled { .. } => f64::NAN,
    }
}

/// What the mean filament does at each azimuth.
pub(super) fn of_mean_filament(
    folder: &Path,
    case: &Case,
    azimuths: u32,
) -> Result<Vec<Found>, String> {
    let mean = |k: u32| {
        let azimuth_deg = f64::from(k) * 360.0 / f64::from(azimuths);
        store::kept(Some(folder), case, &Made::Mean { azimuth_deg })?.0
    };
    (0..azimuths).map(mean).collect()
}

/// All quantities of a case.
fn lines(
    folder: &Path,
    kind: &'static str,
    case: &Case,
    law: &RodLaw,
) -> Result<Vec<Line>, String> {
    let is_across = matches!(case.kind, Kind::Guided { .. } | Kind::Cantilever { .. });
    let azimuths = if is_across { AZIMUTHS } else { 1 };
    let monomers = of_mean_filament(folder, case, azimuths)?;
    let rod = |k: usize| {
        let made = Rod {
            shorter_nm: FROM + k as f64 * STEP,
            ..Rod::fine(law)
        };
        solve(case, &Made::Rod(made)).ok()
    };
    let rods: Vec<Option<Found>> = (0..TRIED).map(rod).collect();
    let span_nm = span_nm(case);
    // Rigidities refer to the length of the rod; couples and displacements at the same loads are compared.
    let is_rigidity = matches!(case.kind, Kind::Twisted { .. } | Kind::Stretched { .. });
    let names = monomers[0].values.iter().map(|(name, _)| name);
    let names = names.filter(|name| !name.starts_with("dL/L"));
    let line = |name: &String| {
        let of_monomers = monomers.iter().filter_map(|found| found.value(name));
        let of_monomers: Vec<f64> = of_monomers.collect();
        let mean = of_monomers.iter().sum::<f64>() / of_monomers.len() as f64;
        let of_rod = |(k, found): (usize, &Option<Found>)| {
            let length = span_nm - (FROM + k as f64 * STEP);
            let scale = if is_rigidity { span_nm / length } else { 1.0 };
            Some(found.as_ref()?.value(name)? * scale)
        };
        Line {
            kind,
            span_nm,
            quantity: name.clone(),
            monomers: mean,
            scatter: 0.5 * super::mixed::spread(&of_monomers).unwrap_or_default(),
            rods: rods.iter().enumerate().map(of_rod).collect(),
        }
    };
    Ok(names.map(line).collect())
}

impl Line {
    /// Logarithm of rod over monomers, by length left out (nm); none where signs differ.
    fn logarithms(&self) -> Vec<(f64, Option<f64>)> {
        let ratio = |rod: f64| (rod / self.monomers).ln();
        let rods = self.rods.iter().enumerate();
        rods.map(|(k, rod)| {
            let logarithm = rod.map(ratio).filter(|l| l.is_finite());
            (FROM + k as f64 * STEP, logarithm)
        })
        .collect()
    }

    /// The rod as long as the monomers.
    fn rod(&self) -> Option<f64> {
        let logarithms = self.logarithms();
        let at = logarithms.iter().position(|(x, _)| x.abs() < 0.5 * STEP)?;
        self.rods[at]
    }

    /// The length nearest to zero at which rod and monomers agree (nm).
    fn missing_nm(&self) -> Option<f64> {
        let logarithms = self.logarithms();
        let crossing = |pair: &[(f64, Option<f64>)]| {
            let ((x, a), (y, b)) = (pair[0], pair[1]);
            let (a, b) = (a?, b?);
            (a * b <= 0.0 && (a - b).abs() > 0.0).then(|| x + (y - x) * a / (a - b))
        };
        let all = logarithms.windows(2).filter_map(crossing);
        all.min_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    fn cells(&self, law: &str) -> Vec<String> {
        let number = |value: Option<f64>| value.map_or(String::new(), |v| format!("{v:.6e}"));
        vec![
            law.to_owned(),
            self.kind.to_owned(),
            format!("{:.2}", self.span_nm),
            self.quantity.clone(),
            number(Some(self.monomers)),
            number(self.rod()),
            number(self.rod().map(|rod| rod / self.monomers - 1.0)),
            number(self.missing_nm()),
        ]
    }
}

/// Errors and missing lengths by span, and what one length for all spans leaves.
fn page(law: &str, lines: &[Line]) -> String {
    let mut text = format!(
        "\n## {law}\n\nError of the rod, ± half the range of monomers over \
         azimuths, and in brackets the length missing (nm).\n\n"
    );
    let spans: Vec<f64> = SPANS.iter().map(|&n| f64::from(n) * RISE_NM).collect();
    let names: Vec<String> = spans.iter().map(|nm| format!("{nm:.0} nm")).collect();
    _ = writeln!(
        text,
        "| load | quantity | {} | one length (nm) | rms without | rms with |\n| --- | --- |{} ---: | ---: | ---: |",
        names.join(" | "),
        " ---: |".repeat(names.len())
    );
    let mut loads: Vec<(&str, &str)> = Vec::new();
    for line in lines {
        let load = (line.kind, line.quantity.as_str());
        if !loads.contains(&load) {
            loads.push(load);
        }
    }
    for (kind, quantity) in loads {
        let own = lines
            .iter()
            .filter(|l| (l.kind, &*l.quantity) == (kind, quantity));
        let own: Vec<&Line> = own.collect();
        let cells: Vec<String> = own.iter().map(|line| cell(line)).collect();
        let (best, without, with) = one_length(&own);
        _ = writeln!(
            text,
            "| {kind} | {quantity} | {} | {best:.1} | {:.1} % | {:.1} % |",
            cells.join(" | "),
            100.0 * without,
            100.0 * with
        );
    }
    text
}

fn cell(line: &Line) -> String {
    let error = line.rod().map(|rod| 100.0 * (rod / line.monomers - 1.0));
    let error = error.map_or("none".to_owned(), |e| format!("{e:+.1} %"));
    let missing = line.missing_nm();
    let missing = missing.map_or("none".to_owned(), |x| format!("{x:+.1}"));
    let scatter = (line.scatter > 0.0).then(|| format!(" ± {:.0}", 100.0 * line.scatter));
    format!("{error}{} ({missing})", scatter.unwrap_or_default())
}

/// The length (nm) with the least root mean square of logarithms over the spans that have one, what is left
/// without and with it. Not numbers where no length is solved for all spans.
fn one_length(lines: &[&Line]) -> (f64, f64, f64) {
    let all: Vec<Vec<(f64, Option<f64>)>> = lines.iter().map(|line| line.logarithms()).collect();
    let rms = |k: usize| {
        let values: Option<Vec<f64>> = all.iter().map(|line| line[k].1).collect();
        let squares: f64 = values?.iter().map(|v| v * v).sum();
        Some((squares / all.len() as f64).sqrt())
    };
    let length = |k: usize| FROM + k as f64 * STEP;
    let solved = (0..TRIED).filter_map(|k| Some((length(k), rms(k)?)));
    let solved: Vec<(f64, f64)> = solved.collect();
    let without = solved.iter().find(|(x, _)| x.abs() < 0.5 * STEP);
    let best = solved.iter().min_by(|a, b| a.1.total_cmp(&b.1));
    let (x, with) = best.copied().unwrap_or((f64::NAN, f64::NAN));
    (x, without.map_or(f64::NAN, |w| w.1), with)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A beam of compliance `(L - x)^3` beside one that lacks 3 nm.
    #[test]
    fn a_length_that_is_missing_is_found() {
        let line = |span_nm: f64| Line {
            kind: "guided",
            span_nm,
            quantity: "nm/pN".to_owned(),
            monomers: (span_nm - 3.0).powi(3),
            scatter: 0.0,
            rods: (0..TRIED)
                .map(|k| Some((span_nm - FROM - k as f64 * STEP).powi(3)))
                .collect(),
        };
        let lines = [line(40.0), line(90.0)];
        assert!((lines[0].missing_nm().unwrap() - 3.0).abs() < 1e-9);
        let (x, without, with) = one_length(&lines.each_ref());
        assert!((x - 3.0).abs() < 1e-9 && with < 1e-12 && without > 0.1);
    }
}

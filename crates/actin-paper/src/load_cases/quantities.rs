//! Comparison of one law with monomers, for a report.

use super::case::{self, Bound, Group};
use super::filament;
use super::row::Row;
use super::{monomers, of_law, write};
use actin_draw::report::{self, Origin};
use std::path::Path;

/// The load case, the quantity, and the result of the rod against the mean filament. For shapes the
/// result is the distance of centre lines, for mixed filaments the spread.
pub(crate) type ComparedQuantity = (String, String, report::Row);

/// Runs all load cases of a law with segments of 10 nm and draws `load-cases.svg`. A quick run
/// omits trajectories, whose numbers depend on rounding. `done` is called after each filament of
/// monomers.
pub(crate) fn compared(
    name: &str,
    quick: bool,
    out: &Path,
    done: &(dyn Fn() + Sync),
) -> Result<Vec<ComparedQuantity>, String> {
    let law = filament::law(name)?;
    let cases = case::all(quick);
    let monomers = monomers(None, &cases, quick, &|_| done())?;
    let rows = of_law(&(name.to_owned(), law), &cases, &monomers, (quick, true));
    write::picture(out, &rows)?;
    let mut all: Vec<ComparedQuantity> = rows.iter().filter_map(of_row).collect();
    let unsolved = (rows.len() - all.len()) as f64;
    let note = "quantities of cases in which the rod has no equilibrium";
    let unsolved = judged(("", unsolved, note.to_owned()), Some((0.0, 0.0)));
    all.push(("all".to_owned(), "unsolved".to_owned(), unsolved));
    Ok(all)
}

fn judged((unit, ours, note): (&'static str, f64, String), to: Option<(f64, f64)>) -> report::Row {
    let row = report::Row::measured("law", "", unit, ours, note);
    match to {
        Some((expected, largest)) => row
            .with_paper_value(expected, largest)
            .with_origin(Origin::Bound),
        None => row,
    }
}

/// `None` without an equilibrium of the rod.
fn of_row(row: &Row) -> Option<ComparedQuantity> {
    let mean = row.mean.map(|sampled| sampled.mean);
    let relative = |bound: f64| (row.rod, mean.map(|m| (m, bound * m.abs())));
    let (rod, to) = match row.bound {
        Bound::Relative(bound) => relative(bound),
        Bound::Scatter => relative(row.scatter?),
        Bound::Distance(bound) | Bound::Spread(bound) => (row.error_mean, Some((0.0, bound))),
        Bound::Open => (row.rod, None),
    };
    let judged = judged((unit(row), rod?, note(row, mean)), to);
    Some((row.case.clone(), row.quantity.clone(), judged))
}

fn unit(row: &Row) -> &'static str {
    match (row.bound, row.quantity.as_str()) {
        (Bound::Spread(_), _) => "",
        (Bound::Distance(_), _) => "nm",
        (_, "persistence length") => "um",
        (_, "C") => "pN nm^2",
        (_, name) if name.starts_with("nm/pN") => "nm/pN",
        (_, name) => {
            let units = ["pN nm^2", "pN nm", "pN", "nm"];
            let is_own = |unit: &&str| name.ends_with(&format!("({unit})"));
            units.into_iter().find(is_own).unwrap_or("")
        }
    }
}

fn note(row: &Row, mean: Option<f64>) -> String {
    let mut parts = Vec::new();
    if let Some(drawn) = row.drawn {
        parts.push(format!(
            "drawn filaments {:.4}, sd {:.2e}, {} of them",
            drawn.mean, drawn.deviation, drawn.count
        ));
    }
    if row.bound == Bound::Open && row.group == Group::Beside {
        parts.extend(mean.map(|mean| format!("mean filament {mean:.4}, no bound")));
    }
    parts.extend((!row.note.is_empty()).then(|| row.note.clone()));
    parts.join("; ")
}

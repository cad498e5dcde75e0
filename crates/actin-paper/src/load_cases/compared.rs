//! One law beside monomers, for a report: numbers with what is expected of them. Nothing is kept on disk but the
//! picture.

use super::case::{self, Bound, Group};
use super::filament;
use super::row::Row;
use super::{Effort, monomers, of_law, picture};
use std::path::Path;

/// A number of a rod, and what monomers have.
#[derive(Clone, Debug)]
pub(crate) struct Compared {
    /// The load case.
    pub case: String,
    /// What is compared.
    pub quantity: String,
    /// Its unit.
    pub unit: &'static str,
    /// The rod's; of shapes the distance from monomers, of mixed filaments the spread.
    pub rod: f64,
    /// That of the mean filament; zero for distances and spreads, none where nothing is asked.
    pub monomers: Option<f64>,
    /// How far they may be apart.
    pub largest_difference: Option<f64>,
    /// Drawn filaments, and what else to know.
    pub note: String,
}

/// All load cases of a law, with segments of 10 nm; draws `load-cases.svg`. A quick run leaves out motion, whose
/// numbers depend on rounding. `done` is told of each filament of monomers.
///
/// # Errors
/// A law that scenes do not know, and a file that cannot be written.
pub(crate) fn compared(
    name: &str,
    quick: bool,
    out: &Path,
    done: &(dyn Fn() + Sync),
) -> Result<Vec<Compared>, String> {
    let law = filament::law(name)?;
    let cases = case::all(quick);
    let monomers = monomers(None, &cases, quick, &|_| done())?;
    let effort = Effort {
        quick,
        only_coarse: true,
    };
    let rows = of_law(&(name.to_owned(), law), &cases, &monomers, effort);
    picture::draw(out, &rows)?;
    let mut all: Vec<Compared> = rows.iter().filter_map(of_row).collect();
    all.push(unsolved(rows.len() - all.len()));
    Ok(all)
}

/// How many numbers the rod has not, for want of an equilibrium.
fn unsolved(count: usize) -> Compared {
    Compared {
        case: "all".to_owned(),
        quantity: "unsolved".to_owned(),
        unit: "",
        rod: count as f64,
        monomers: Some(0.0),
        largest_difference: Some(0.0),
        note: "quantities of cases in which the rod has no equilibrium".to_owned(),
    }
}

/// None where the rod has no equilibrium.
fn of_row(row: &Row) -> Option<Compared> {
    let mean = row.mean.map(|sampled| sampled.mean);
    let relative = |bound: f64| (row.rod, mean, mean.map(|m| bound * m.abs()));
    let absolute = |bound: f64| (row.error_mean, Some(0.0), Some(bound));
    let (rod, monomers, largest_difference) = match row.bound {
        Bound::Relative(bound) => relative(bound),
        Bound::Scatter => relative(row.scatter?),
        Bound::Distance(bound) | Bound::Spread(bound) => absolute(bound),
        Bound::Open => (row.rod, None, None),
    };
    Some(Compared {
        case: row.case.clone(),
        quantity: row.quantity.clone(),
        unit: unit(row),
        rod: rod?,
        monomers,
        largest_difference,
        note: note(row, mean),
    })
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

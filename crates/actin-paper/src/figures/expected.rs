//! Expected numbers and verdicts.
//!
//! `data/expected.csv` holds numbers to compare rows with, `data/claims.csv` the paper's verbal statements with
//! their bounds. One rule sets all bounds (`data/page.ron` states it): it depends on the expectation, not on
//! the result.

use super::draft::Measured;
use crate::published::table;
use actin_draw::report::{DEVIATIONS, Origin, Row, printed};
use serde::Deserialize;
use std::sync::LazyLock;

/// Share by which two numbers differ where the paper itself speaks of a difference.
pub(super) const DIFFERENCE: f64 = 0.1;

/// A number to compare a row with.
#[derive(Debug, Deserialize)]
struct Expected {
    artefact: String,
    quantity: String,
    /// The printed text, whose last digit sets the tolerance; empty if the line is a note only.
    #[serde(rename = "expected")]
    number: String,
    /// Largest difference that passes; half a unit of the last digit and twice the standard deviation of a
    /// sample if it is `digits`. Without it the number is shown and judges nothing.
    tolerance: String,
    origin: Origin,
    /// Put before the note of the row.
    reason: String,
}

/// A statement of the paper that follows from rows of one artefact.
#[derive(Debug, Deserialize)]
struct Claim {
    artefact: String,
    quantity: String,
    unit: String,
    measure: Measure,
    /// Names of rows, separated by blanks; `*` matches a number and selects rows by ascending number.
    rows: String,
    /// A reference number of the measure.
    reference: Option<f64>,
    holds: Holds,
    bound: Option<f64>,
    statement: String,
}

/// A number that is computed from some rows.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Measure {
    /// The number of the only row.
    Value,
    /// The first over the last.
    Ratio,
    /// Largest minus smallest.
    Range,
    /// [`Measure::Range`] over the mean.
    Spread,
    /// Share of the steps between neighbours that go up.
    Rising,
    /// Largest difference from the reference over the reference.
    Relative,
}

/// When a claim holds.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Holds {
    AtMost,
    AtLeast,
    /// The number is shown and judges nothing.
    Unjudged,
}

/// The bound of a statement.
#[derive(Clone, Copy, Debug)]
pub(super) enum Bound {
    AtMost(f64),
    AtLeast(f64),
    None,
}

static EXPECTED: LazyLock<Vec<Expected>> =
    LazyLock::new(|| table(include_str!("../../data/expected.csv")));
static CLAIMS: LazyLock<Vec<Claim>> =
    LazyLock::new(|| table(include_str!("../../data/claims.csv")));

/// The rows of an artefact with their verdicts, and the claims that follow from them. Claims whose
/// rows are missing in a run are omitted.
pub(super) fn judged(artefact: &'static str, measured: Vec<Measured>) -> Vec<Row> {
    let mut rows: Vec<Row> = measured.into_iter().map(Measured::judged).collect();
    let claims = CLAIMS.iter().filter(|claim| claim.artefact == artefact);
    let claims: Vec<Row> = claims.filter_map(|c| c.row(artefact, &rows)).collect();
    rows.extend(claims);
    rows
}

impl Measured {
    fn judged(self) -> Row {
        let Self { row, sd } = self;
        let of_row = |e: &&Expected| e.artefact == row.artefact && e.quantity == row.quantity;
        EXPECTED
            .iter()
            .find(of_row)
            .map_or(row.clone(), |e| e.judge(row, sd))
    }
}

impl Expected {
    fn judge(&self, row: Row, sd: f64) -> Row {
        let note = match (self.reason.as_str(), row.note.as_str()) {
            ("", note) | (note, "") => note.to_owned(),
            (reason, note) => format!("{reason}; {note}"),
        };
        let row = Row { note, ..row };
        if self.number.is_empty() {
            return row;
        }
        let (expected, half) = printed(&self.number);
        let row = match self.tolerance.as_str() {
            "" => row.beside(expected, self.origin),
            "digits" => row.against(expected, half + DEVIATIONS * sd),
            other => row.against(expected, other.parse().expect("a tolerance is a number")),
        };
        row.of(self.origin)
    }
}

impl Claim {
    fn row(&'static self, artefact: &'static str, rows: &[Row]) -> Option<Row> {
        let mut values = Vec::new();
        for pattern in self.rows.split(' ') {
            let chosen = select(pattern, rows);
            if chosen.is_empty() {
                return None;
            }
            values.extend(chosen);
        }
        let ours = self.measure.of(&values, self.reference)?;
        let bound = match (self.holds, self.bound) {
            (Holds::AtMost, Some(bound)) => Bound::AtMost(bound),
            (Holds::AtLeast, Some(bound)) => Bound::AtLeast(bound),
            _ => Bound::None,
        };
        Some(claim(
            artefact,
            &self.quantity,
            &self.unit,
            ours,
            bound,
            &*self.statement,
        ))
    }
}

/// A statement of the paper as a number, with a verdict if there is a bound.
pub(super) fn claim(
    artefact: &'static str,
    quantity: &str,
    unit: &'static str,
    ours: f64,
    bound: Bound,
    statement: impl Into<String>,
) -> Row {
    let (limit, pass, words) = match bound {
        Bound::AtMost(limit) => (
            Some(limit),
            Some(ours <= limit),
            "holds up to the tolerance",
        ),
        Bound::AtLeast(limit) => (
            Some(limit),
            Some(ours >= limit),
            "holds from the tolerance on",
        ),
        Bound::None => (None, None, "not judged"),
    };
    let note = format!("the paper: {}; {words}", statement.into());
    Row {
        tolerance: limit,
        pass,
        origin: pass.map(|_| Origin::Words),
        ..Row::measured(artefact, format!("claim/{quantity}"), unit, ours, note)
    }
}

/// Numbers of the rows that match a pattern, by ascending number at the `*`.
fn select(pattern: &str, rows: &[Row]) -> Vec<f64> {
    let Some((before, after)) = pattern.split_once('*') else {
        let found = rows.iter().find(|row| row.quantity == pattern);
        return found.map(|row| row.ours).into_iter().collect();
    };
    let numbered = rows.iter().filter_map(|row| {
        let name = row.quantity.strip_prefix(before)?.strip_suffix(after)?;
        Some((name.parse::<u32>().ok()?, row.ours))
    });
    let mut all: Vec<(u32, f64)> = numbered.collect();
    all.sort_by_key(|(number, _)| *number);
    all.into_iter().map(|(_, value)| value).collect()
}

impl Measure {
    /// The number; `None` if there are too few values.
    fn of(self, values: &[f64], reference: Option<f64>) -> Option<f64> {
        let sample = crate::statistics::sample(values.iter().copied());
        let is_family = !matches!(self, Self::Value);
        if is_family && values.len() < 2 {
            return None;
        }
        Some(match self {
            Self::Value => values[0],
            Self::Ratio => values[0] / values[values.len() - 1],
            Self::Range => sample.range(),
            Self::Spread => sample.spread(),
            Self::Rising => {
                let steps = values.windows(2);
                let up = steps.clone().filter(|pair| pair[1] > pair[0]).count();
                up as f64 / steps.count() as f64
            }
            Self::Relative => {
                let reference = reference?;
                f64::max(sample.high / reference - 1.0, 1.0 - sample.low / reference)
            }
        })
    }
}

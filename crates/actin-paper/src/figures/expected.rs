//! Expected numbers and verdicts.
//!
//! `data/expected.csv` contains expected numbers, `data/claims.csv` verbal statements of the paper with their bounds.
//! `data/page.ron` states the rule for all bounds. It depends on the expectation, not on the result.

use crate::published::table;
use actin_draw::report::{DEVIATIONS, Origin, Row, printed};
use serde::Deserialize;
use std::sync::LazyLock;

/// Row with the standard deviation of a single sample, which widens the bounds of printed numbers.
#[derive(Clone, Debug)]
pub(super) struct MeasuredRow {
    pub row: Row,
    pub sd: f64,
}

/// Relative size that the paper reports as a difference (Figure 7).
pub(super) const DIFFERENCE: f64 = 0.1;

#[derive(Debug, Deserialize)]
struct Expected {
    artefact: String,
    quantity: String,
    /// Number as printed; its last digit sets the tolerance. Empty if the line contains only a note.
    #[serde(rename = "expected")]
    number: String,
    /// Largest difference that passes. `digits` is half a unit of the last digit and twice the standard deviation of a
    /// sample. Empty if the number is shown without a verdict.
    tolerance: String,
    origin: Origin,
    reason: String,
}

/// Verbal statement of the paper, evaluated from rows of one artefact.
#[derive(Debug, Deserialize)]
struct Claim {
    artefact: String,
    quantity: String,
    unit: String,
    measure: Measure,
    /// Names of rows, separated by spaces. `*` matches a number and selects rows in ascending order of it.
    rows: String,
    reference: Option<f64>,
    holds: Holds,
    bound: Option<f64>,
    statement: String,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Measure {
    /// Value of a single row.
    Value,
    /// First value divided by the last.
    Ratio,
    /// Largest minus smallest value.
    Range,
    /// [`Measure::Range`] divided by the mean.
    Spread,
    /// Share of increasing steps between neighbours.
    Rising,
    /// Largest difference from the reference, divided by the reference.
    Relative,
}

/// Meaning of the tolerance of a claim.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Holds {
    AtMost,
    AtLeast,
    /// Shown without a verdict.
    Unjudged,
}

/// Largest or smallest value of a claim; `None` without a verdict.
pub(super) type Bound = Option<(Holds, f64)>;

static EXPECTED: LazyLock<Vec<Expected>> =
    LazyLock::new(|| table(include_str!("../../data/expected.csv")));
static CLAIMS: LazyLock<Vec<Claim>> =
    LazyLock::new(|| table(include_str!("../../data/claims.csv")));

/// Rows of an artefact with verdicts, followed by its claims. Claims with missing rows are omitted.
pub(super) fn judged(artefact: &'static str, measured: Vec<MeasuredRow>) -> Vec<Row> {
    let mut rows: Vec<Row> = measured.into_iter().map(MeasuredRow::judged).collect();
    let claims = CLAIMS.iter().filter(|claim| claim.artefact == artefact);
    let claims: Vec<Row> = claims.filter_map(|c| c.row(artefact, &rows)).collect();
    rows.extend(claims);
    rows
}

impl MeasuredRow {
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
            "" => row.with_reference(expected, self.origin),
            "digits" => row.with_paper_value(expected, half + DEVIATIONS * sd),
            other => {
                row.with_paper_value(expected, other.parse().expect("a tolerance is a number"))
            }
        };
        row.with_origin(self.origin)
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
        let bound = self.bound.map(|bound| (self.holds, bound));
        let (quantity, unit, statement) = (&self.quantity, &self.unit, &*self.statement);
        Some(claim(artefact, quantity, unit, ours, bound, statement))
    }
}

pub(super) fn claim(
    artefact: &'static str,
    quantity: &str,
    unit: &'static str,
    ours: f64,
    bound: Bound,
    statement: impl Into<String>,
) -> Row {
    let (pass, words) = match bound {
        Some((Holds::AtMost, limit)) => (Some(ours <= limit), "the tolerance is an upper bound"),
        Some((Holds::AtLeast, limit)) => (Some(ours >= limit), "the tolerance is a lower bound"),
        Some((Holds::Unjudged, _)) | None => (None, "not judged"),
    };
    let note = format!("the paper: {}; {words}", statement.into());
    Row {
        tolerance: pass.and(bound).map(|(_, limit)| limit),
        pass,
        origin: pass.map(|_| Origin::Words),
        ..Row::measured(artefact, format!("claim/{quantity}"), unit, ours, note)
    }
}

/// Values of the rows that match a pattern, in ascending order of the number at `*`.
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
    /// Evaluates the measure; `None` if there are too few values.
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

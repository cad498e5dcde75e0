//! Tables of a sweep: all runs, and all points with means and standard errors.

use crate::files::{self, RUNS, TABLE};
use crate::summary::summary;
use crate::{SweepDirectory, SweepError, ValidatedSweep, chosen};
use serde_json::Value;

/// Status of a run that has not ended.
const UNFINISHED: &str = "unfinished";

#[derive(Debug)]
pub(crate) struct Table<'a> {
    opened: &'a ValidatedSweep,
    rows: Vec<Row>,
}

#[derive(Debug)]
pub(crate) struct Row {
    status: String,
    /// Reason of the failure, or missing results; empty for a successful run.
    pub(crate) failure: String,
    warnings: String,
    /// Values of the results; `None` if missing.
    results: Vec<Option<Value>>,
}

impl Row {
    fn unfinished(results: usize) -> Self {
        Self {
            status: UNFINISHED.to_owned(),
            failure: String::new(),
            warnings: String::new(),
            results: vec![None; results],
        }
    }

    pub(crate) fn new(summary: &Value, names: &[String]) -> Self {
        let text = |key: &str| summary[key].as_str().unwrap_or_default().to_owned();
        let status = text("status");
        let counts = status != "failed";
        let found = |name: &String| {
            let value = chosen::find(summary, name).filter(|_| counts);
            value.filter(|value| !value.is_null()).cloned()
        };
        let results: Vec<_> = names.iter().map(found).collect();
        let curvature_difference = names.iter().zip(&results);
        let curvature_difference =
            curvature_difference.filter(|(_, result)| counts && result.is_none());
        let curvature_difference: Vec<&str> = curvature_difference
            .map(|(name, _)| name.as_str())
            .collect();
        let failure = if curvature_difference.is_empty() {
            text("failure")
        } else {
            format!(
                "its summary has no value of {}",
                curvature_difference.join(", ")
            )
        };
        let warnings = summary["warnings"].as_array().into_iter().flatten();
        let mut codes: Vec<&str> = warnings.filter_map(|w| w["code"].as_str()).collect();
        codes.dedup();
        Self {
            status,
            failure,
            warnings: codes.join(" "),
            results,
        }
    }
}

impl<'a> Table<'a> {
    pub(crate) fn new(opened: &'a ValidatedSweep, directory: &SweepDirectory) -> Self {
        let results = &opened.sweep.results;
        let row = |run| match summary(&directory.run(run)) {
            Some(summary) => Row::new(&summary, results),
            None => Row::unfinished(results.len()),
        };
        let rows = (0..opened.design.len()).map(row).collect();
        Self { opened, rows }
    }

    pub(crate) fn write(&self, directory: &SweepDirectory) -> Result<(), SweepError> {
        files::replace(directory.path(), RUNS, &self.runs())?;
        files::replace(directory.path(), TABLE, &self.points())
    }

    fn runs(&self) -> Vec<u8> {
        let (design, sweep) = (&self.opened.design, &self.opened.sweep);
        let head = words(&["run", "point"])
            .chain(design.keys.iter().cloned())
            .chain(words(&["seed", "status"]))
            .chain(sweep.results.iter().cloned())
            .chain(words(&["failure", "warnings"]));
        let rows = self.rows.iter().enumerate().map(|(index, row)| {
            let run = design.run(index);
            let seed = run.seed.map_or_else(String::new, |seed| seed.to_string());
            let cell =
                |value: &Option<Value>| value.as_ref().map_or_else(String::new, Value::to_string);
            let numbers = [run.index, run.point].map(|n| n.to_string()).into_iter();
            numbers
                .chain(design.points[run.point].iter().cloned())
                .chain([seed, row.status.clone()])
                .chain(row.results.iter().map(cell))
                .chain([row.failure.clone(), row.warnings.clone()])
                .collect::<Vec<_>>()
        });
        files::csv(std::iter::once(head.collect()).chain(rows))
    }

    /// Returns the table of points: means over the runs with a result, and standard errors. Other runs count as
    /// failed.
    fn points(&self) -> Vec<u8> {
        let (design, sweep) = (&self.opened.design, &self.opened.sweep);
        let both = |name: &String| [name.clone(), format!("{name} error")];
        let head = words(&["point"])
            .chain(design.keys.iter().cloned())
            .chain(words(&["runs", "failed"]))
            .chain(sweep.results.iter().flat_map(both))
            .chain(words(&["failure"]));
        let chunks = self.rows.chunks(design.runs_of_point()).enumerate();
        let rows = chunks.map(|(point, rows)| {
            let failed = rows.iter().filter(|row| !row.failure.is_empty());
            let first = failed.clone().next().map(|row| row.failure.clone());
            let ended = rows.iter().filter(|row| row.status != UNFINISHED);
            let counts = [ended.count(), failed.count()].map(|n| n.to_string());
            let results = (0..sweep.results.len()).flat_map(|k| {
                let numbers = rows
                    .iter()
                    .filter_map(|row| chosen::number(row.results[k].as_ref()?));
                mean_and_error(&numbers.collect::<Vec<_>>())
            });
            std::iter::once(point.to_string())
                .chain(design.points[point].iter().cloned())
                .chain(counts)
                .chain(results)
                .chain([first.unwrap_or_default()])
                .collect::<Vec<_>>()
        });
        files::csv(std::iter::once(head.collect()).chain(rows))
    }
}

fn words(names: &[&str]) -> impl Iterator<Item = String> {
    names
        .iter()
        .map(ToString::to_string)
        .collect::<Vec<_>>()
        .into_iter()
}

/// Returns mean and standard error; empty if there are too few numbers.
fn mean_and_error(numbers: &[f64]) -> [String; 2] {
    let count = numbers.len() as f64;
    let mean = numbers.iter().sum::<f64>() / count;
    let squares: f64 = numbers.iter().map(|x| (x - mean).powi(2)).sum();
    let error = (squares / (count - 1.0) / count).sqrt();
    [mean, error].map(|value| {
        if value.is_finite() {
            format!("{value:?}")
        } else {
            String::new()
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1, 2, 3: mean 2, variance 1, error 1/sqrt(3).
    #[test]
    fn means_have_standard_errors() {
        let [mean, error] = mean_and_error(&[1.0, 2.0, 3.0]);
        assert_eq!(mean, "2.0");
        let error: f64 = error.parse().unwrap();
        assert!((error - 1.0 / 3.0_f64.sqrt()).abs() < 1e-15);
        assert_eq!(mean_and_error(&[5.0]), ["5.0".to_owned(), String::new()]);
        assert_eq!(mean_and_error(&[]), [String::new(), String::new()]);
    }
}

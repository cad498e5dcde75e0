//! Means of observed quantities over a run in a heat bath, for `summary.json`.

use super::{derived_length, network, observed_columns};
use crate::statistics::{BlockAverages, Estimate};
use crate::{Assembly, At};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Summary of one column of `observables.csv`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ObservableSummary {
    /// Value at the last record; `None` if not defined.
    pub last: Option<f64>,
    /// Mean over the records after the burn-in; `None` without thermal noise.
    #[serde(flatten, default, skip_serializing_if = "Option::is_none")]
    pub mean: Option<MeanSummary>,
}

/// Mean over the records after the burn-in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MeanSummary {
    /// Mean; `None` without records.
    pub mean: Option<f64>,
    /// Standard error from block averages; a lower bound if the plateau is not reached.
    pub error: Option<f64>,
    /// `true` if the error reaches a plateau with growing block length.
    pub levelled_off: bool,
    /// Records per block at the plateau; `None` if it is not reached.
    pub block_records: Option<u64>,
    /// Number of independent samples with the same error; an upper bound if the plateau is not
    /// reached.
    pub independent_samples: Option<f64>,
    /// Number of records with a value after the burn-in.
    pub records: u64,
    /// Length derived from the mean of a tangent correlation.
    #[serde(flatten, default, skip_serializing_if = "Option::is_none")]
    pub derived: Option<DerivedLength>,
}

/// Persistence length with its standard error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct DerivedLength {
    /// Persistence length (nm); `None` unless the mean correlation is between 0 and 1.
    pub persistence_length_nm: Option<f64>,
    /// Standard error (nm), from the standard error of the correlation.
    pub persistence_length_error_nm: Option<f64>,
}

/// Running averages of all columns.
pub(crate) struct Averages<'a> {
    assembly: &'a Assembly,
    /// Start of the averages (ns); `None` without thermal noise.
    from_ns: Option<f64>,
    columns: Vec<BlockAverages>,
    /// Period of a column (ns), whose blocks are whole periods.
    periods: Vec<Option<f64>>,
    last: Vec<f64>,
}

/// Returns `true` after a whole number of periods, at least one, up to rounding.
fn ends_period(periods: f64) -> bool {
    let whole = periods.round();
    whole >= 1.0 && (periods - whole).abs() < 1e-6
}

impl<'a> Averages<'a> {
    pub(crate) fn new(assembly: &'a Assembly) -> Self {
        let names = observed_columns(assembly).into_iter();
        let periods: Vec<_> = names
            .map(|name| network::period_ns(&assembly.scene, &name))
            .collect();
        Self {
            from_ns: assembly.scene.burn_in(),
            columns: vec![BlockAverages::default(); periods.len()],
            periods,
            assembly,
            last: Vec::new(),
        }
    }

    /// Summary of all columns from a single record.
    pub(crate) fn of_one(
        assembly: &'a Assembly,
        (at, observed): (At, &[f64]),
    ) -> BTreeMap<String, ObservableSummary> {
        let mut all = Self::new(assembly);
        all.add(at.value(), observed);
        all.end()
    }

    /// Number of columns.
    pub(crate) fn width(&self) -> usize {
        self.columns.len()
    }

    pub(crate) fn add(&mut self, time_ns: f64, row: &[f64]) {
        if let Some(from) = self.from_ns.filter(|from| time_ns >= *from) {
            let columns = self.columns.iter_mut().zip(&self.periods).zip(row);
            for ((column, period), value) in columns.filter(|(_, value)| value.is_finite()) {
                column.push_part(*value);
                if period.is_none_or(|period| ends_period((time_ns - from) / period)) {
                    column.end_block();
                }
            }
        }
        self.last = row.to_vec();
    }

    pub(crate) fn end(self) -> BTreeMap<String, ObservableSummary> {
        let names = observed_columns(self.assembly).into_iter().enumerate();
        let one = |(i, name): (usize, String)| {
            let last = self.last.get(i).copied().filter(|value| value.is_finite());
            let summary = ObservableSummary {
                last,
                mean: self.from_ns.map(|_| self.mean(&name, &self.columns[i])),
            };
            (name, summary)
        };
        names.map(one).collect()
    }

    fn mean(&self, name: &str, averages: &BlockAverages) -> MeanSummary {
        let Some(Estimate {
            mean,
            values,
            error,
            block,
            independent,
        }) = averages.estimate()
        else {
            return MeanSummary {
                derived: derived_length(self.assembly, name, (f64::NAN, None)),
                ..MeanSummary::default()
            };
        };
        MeanSummary {
            mean: Some(mean),
            error,
            levelled_off: block.is_some(),
            block_records: block,
            independent_samples: Some(independent),
            records: values,
            derived: derived_length(self.assembly, name, (mean, error)),
        }
    }
}

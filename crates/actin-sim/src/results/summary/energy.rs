//! Energies in `summary.json`.

use crate::results::energies::{Totals, distinct, sum_where};
use crate::{Assembly, Record};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Energies of one record (pN nm).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EnergySummary {
    /// Sum of potential and kinetic energy.
    pub total: f64,
    /// Energy of all interactions.
    pub potential: f64,
    /// Energy of all interactions except loads.
    pub elastic: f64,
    /// Kinetic energy of the free bodies.
    pub kinetic: f64,
    /// Energy of each kind of interaction, by name.
    #[serde(flatten)]
    pub terms: BTreeMap<String, f64>,
}

impl EnergySummary {
    pub(super) fn new(assembly: &Assembly, record: &Record) -> Self {
        let terms = &assembly.terms;
        let row = record.row();
        let totals = Totals::new(terms, &row);
        let names = distinct(terms, |term| term.name);
        let of_name = |name: &'static str| {
            let energy = sum_where(terms, &row, |term| term.name == name);
            (name.to_owned(), energy)
        };
        Self {
            total: totals.total,
            potential: totals.potential,
            elastic: totals.elastic,
            kinetic: totals.kinetic,
            terms: names.into_iter().map(of_name).collect(),
        }
    }

    pub(super) fn scalars(&self) -> impl Iterator<Item = (String, f64)> {
        let sums = [
            ("total", self.total),
            ("potential", self.potential),
            ("elastic", self.elastic),
            ("kinetic", self.kinetic),
        ];
        let terms = self
            .terms
            .iter()
            .map(|(name, value)| (name.as_str(), *value));
        let all = sums.into_iter().chain(terms);
        all.map(|(key, value)| (format!("energy_pn_nm.{key}"), value))
    }
}

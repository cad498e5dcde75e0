//! Energies in `summary.json`.

use crate::{Assembly, EnergyTotals, Record};
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
        let energies = &record.energies_pn_nm;
        let totals = EnergyTotals::new(&assembly.terms, energies, record.kinetic_pn_nm);
        let mut terms = BTreeMap::new();
        for (term, energy) in assembly.terms.iter().zip(energies) {
            // Adding to -0.0 preserves the sign of a term of -0.0.
            *terms.entry(term.name.to_owned()).or_insert(-0.0) += energy;
        }
        Self {
            total: totals.total,
            potential: totals.potential,
            elastic: totals.elastic,
            kinetic: totals.kinetic,
            terms,
        }
    }
}

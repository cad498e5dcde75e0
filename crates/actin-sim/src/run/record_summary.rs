//! Summary of the records of a run, with running diagnostics.

use super::Record;
use super::slip::LinkWatch;
use super::step_check::StepComparisons;
use crate::observe::{Memory, View, observed_values};
use crate::{Assembly, ModelLimitExceeded};
use actin_assembly::{RangeWatch, TwistRecords, worst};
use serde::{Deserialize, Serialize};

/// Summary of the records of a run, including the last record.
#[derive(Clone, Debug)]
pub struct RecordSummary {
    /// Running statistics.
    pub carried: RunStatistics,
    /// Last record.
    pub last: Option<Record>,
}

/// Running statistics of the records, stored in checkpoints.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct RunStatistics {
    /// Number of records.
    pub count: usize,
    pub(super) links: LinkWatch,
    pub(super) beyond_use: Vec<ModelLimitExceeded>,
    pub(super) ranges: RangeWatch,
    pub(super) twist: TwistRecords,
    observed: Memory,
    pub(super) steps: StepComparisons,
}

impl RecordSummary {
    /// Creates the summary of a run of `assembly` without records.
    pub fn new(assembly: &Assembly) -> Self {
        let mut start = assembly.system.state().clone();
        // Without a path, the caller sets held ends.
        if !assembly.drive.is_still() {
            assembly.drive.place(&mut start, 0.0);
        }
        Self {
            carried: RunStatistics {
                count: 0,
                links: LinkWatch::new(assembly, &start),
                beyond_use: Vec::new(),
                ranges: RangeWatch::new(assembly),
                twist: TwistRecords::new(assembly),
                observed: Memory::new(assembly),
                steps: StepComparisons::default(),
            },
            last: None,
        }
    }

    /// Creates the summary of a run that continues after a switch of cells with a first record.
    /// Statistics that do not depend on the resolution are kept.
    pub(crate) fn behind_switch(&self, assembly: &Assembly, first: Record) -> Self {
        let mut recorded = Self::new(assembly);
        recorded.carried.links = self.carried.links.clone();
        recorded.carried.observed = self.carried.observed.clone();
        recorded.carried.links.follow(assembly, &first);
        recorded.push(assembly, first);
        recorded
    }

    /// Returns the number of records.
    pub fn count(&self) -> usize {
        self.carried.count
    }

    pub(super) fn push(&mut self, assembly: &Assembly, mut record: Record) -> &Record {
        let all = &mut self.carried;
        let energies = (record.energies_pn_nm.as_slice(), record.kinetic_pn_nm);
        let view = View::new(assembly, (record.at, &record.state), energies);
        let observed = observed_values(&view, &mut all.observed);
        record.row.booked = assembly.booked(&record.state);
        record.row.observed = observed;
        let beyond = assembly.beyond_use(&record.state);
        all.beyond_use = worst(all.beyond_use.drain(..).chain(beyond).collect::<Vec<_>>());
        all.ranges.add(assembly, &record.state);
        all.twist.add(assembly, &record.state);
        all.count += 1;
        self.last.insert(record)
    }
}

impl RunStatistics {
    /// Returns `true` if the statistics belong to the same observers and filaments.
    pub fn fits(&self, other: &Self) -> bool {
        self.observed.fits(&other.observed)
            && self.links.fits(&other.links)
            && self.twist.fits(&other.twist)
    }
}

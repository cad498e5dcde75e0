//! Input of exports.

use actin_sim::mechanics::State;
use actin_sim::{At, Trajectory};
use std::borrow::Cow;
use std::io;

/// States in the order of records. A read error ends the iteration.
pub type StateStream<'a> = Box<dyn Iterator<Item = io::Result<Cow<'a, State>>> + 'a>;

/// States of a run, in memory or read from files, which can be iterated repeatedly.
pub trait RecordedStates {
    /// Returns the time or path parameter of each record.
    fn at(&self) -> Vec<At>;

    /// Iterates over the states of all records.
    fn states(&self) -> StateStream<'_>;
}

impl RecordedStates for Trajectory {
    fn at(&self) -> Vec<At> {
        self.records.iter().map(|record| record.at).collect()
    }

    fn states(&self) -> StateStream<'_> {
        let records = self.records.iter();
        Box::new(records.map(|record| Ok(Cow::Borrowed(&record.state))))
    }
}

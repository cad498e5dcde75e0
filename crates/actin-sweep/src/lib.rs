//! Sweeps: runs of one scene for many values of its keys and many seeds, and a table of results.
//!
//! - [`Sweep`] is read from RON.
//! - [`ValidatedSweep`] is a sweep validated with its scene; its [`Design`] lists all runs.
//! - [`SweepDirectory`] contains a run directory for each run.
//! - [`SweepDirectory::run_all`] makes the missing runs in parallel and writes the table.
//!
//! Each run has one thread, and the table is computed from the summaries of all runs in order. Results are therefore
//! independent of the number of threads and of interruptions.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod chosen;
mod design;
mod directory;
mod engine;
mod error;
mod files;
mod open;
mod random;
mod rules;
mod run;
mod settings;
mod snakemake;
mod summary;
mod sweep;
mod table;

pub use actin_sim as sim;
pub use design::{Design, Run};
pub use directory::SweepDirectory;
pub use engine::{Progress, SweepOutcome};
pub use error::SweepError;
pub use open::{SweepCost, ValidatedSweep};
pub use settings::Settings;
pub use sweep::{Axis, Plan, Ron, Samples, Scale, Span, Sweep, Value};

/// Returns the JSON schema of sweep files.
pub fn schema() -> serde_json::Value {
    schemars::schema_for!(Sweep).to_value()
}

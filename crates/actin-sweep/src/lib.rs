//! Sweeps: one scene, keys that are varied, seeds that are sampled, and one table of results.
//!
//! A [`Sweep`] is read from RON; [`Opened`] checks it with its scene and knows its [`Design`], all runs in
//! order; a [`SweepDirectory`] holds a run directory for each, and its [`carry_out`](SweepDirectory::carry_out)
//! makes the runs that are missing on any number of threads and writes the table. What a run does is the
//! business of `actin-sim`; no physics is here.
//!
//! Nothing depends on the number of threads or on interruptions: each run has one thread, and the table is made
//! from the summaries of all runs in order.

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
mod snakemake;
mod sweep;
mod table;

pub use actin_sim as sim;
pub use design::{Design, Run};
pub use directory::SweepDirectory;
pub use engine::{Ended, Progress, Settings};
pub use error::SweepError;
pub use open::{Opened, Priced};
pub use sweep::{Axis, Plan, Ron, Samples, Scale, Span, Sweep, Value};

/// The keys of sweep files as a JSON schema.
#[cfg(feature = "schema")]
pub fn schema() -> serde_json::Value {
    schemars::schema_for!(Sweep).to_value()
}

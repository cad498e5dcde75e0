//! `checkpoint.bin` and `records.bin`: a run that can be resumed.
//!
//! | file | holds |
//! |---|---|
//! | `checkpoint.bin` | program, scene, where the run stands, how many records there are |
//! | `records.bin` | the records made so far, one after the other; only ever appended to |
//!
//! Everything is little-endian; floating-point numbers are their bits. `checkpoint.bin` is replaced
//! as a whole, after the records that it counts have reached the disk, so that a run that is killed
//! at any moment leaves the last checkpoint or the one before. What each byte is stands in
//! `docs/numerics.md`.

mod bytes;
mod checkpoints;
mod error;
mod file;

mod log;
mod position;

pub use checkpoints::Checkpoints;
pub use error::{CheckpointError, Damage};

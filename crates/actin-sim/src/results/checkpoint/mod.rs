//! `checkpoint.bin` and `records.bin`: a run that can be resumed.
//!
//! | file | holds |
//! |---|---|
//! | `checkpoint.bin` | program, scene, where the run stands, how many records there are |
//! | `records.bin` | the records made so far, one after the other; only ever appended to |
//!
//! Both are in the format of `postcard`, in which floating-point numbers are their bits, behind a header and
//! with checksums. `checkpoint.bin` is replaced as a whole, after the records that it counts have reached the disk, so that a run that is killed
//! at any moment leaves the last checkpoint or the one before. `docs/numerics.md` tells more.

mod checkpoints;
mod error;
mod file;
mod log;
mod stored;
mod wire;

pub use checkpoints::Checkpoints;
pub use error::{CheckpointError, Damage};

//! Formats of `checkpoint.bin` and `records.bin`, from which a run can be resumed.
//!
//! | file | contents |
//! |---|---|
//! | `checkpoint.bin` | program, scene, position of the run, number of records |
//! | `records.bin` | all records in order, append-only |
//!
//! `checkpoint.bin` is replaced as a whole after its records have reached the disk. A run killed at
//! any time therefore leaves the last checkpoint or the previous one. See `docs/numerics.md`.
//!
//! Headers are little-endian and checksums are CRC-32 (IEEE). Contents are values in the order of
//! their types, in the format of [postcard](https://postcard.jamesmunns.com/wire-format) 1.0: `f64`
//! as eight bytes, counts as varints, lists and texts after their length.
//!
//! | `checkpoint.bin` | bytes |
//! |---|---|
//! | `ACTINCKP` | 8 |
//! | version of the format | 4 |
//! | length of the contents | 8 |
//! | checksum of the contents | 4 |
//! | checksum of the 24 bytes above | 4 |
//! | contents: program version, resolved scene, elapsed time (s), number of records and their checksum, `RunPosition`, state of observers and monitors, last record | |
//!
//! `records.bin` begins with `ACTINREC`, followed by records of equal length:
//!
//! - time or path parameter, kinetic energy, residual force and torque, energies of the terms,
//!   observables;
//! - motion, unless disabled by `output`;
//! - checksum of all records up to this one.
//!
//! Records after those counted by the checkpoint are removed when the run is resumed.

mod checkpoints;
mod extension;
mod file;
mod log;
mod stored;
mod wire;

pub use checkpoints::{Checkpoints, Existing, OpenedRun};

use actin_sim::Status;

/// End of the run in a directory.
enum Ending {
    /// The run of the same scene has ended.
    Same(Status),
    /// A motion of this scene with a shorter duration is completed.
    Shorter(String),
}

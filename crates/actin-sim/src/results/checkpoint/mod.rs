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
//!
//! Headers are little-endian and checksums CRC-32 (IEEE); contents are values in the order of their types, in
//! the format of [postcard](https://postcard.jamesmunns.com/wire-format) 1.0: `f64` as eight bytes, counts as varints,
//! lists and texts after their length.
//!
//! | `checkpoint.bin` | bytes |
//! |---|---|
//! | `ACTINCKP` | 8 |
//! | version of the format, 4 | 4 |
//! | length of the contents | 8 |
//! | checksum of the contents | 4 |
//! | checksum of the 24 bytes above | 4 |
//! | contents: version of the program, resolved scene, wall time (s), number of records and their checksum, `RunPosition`, what observers and other watches remember, the last record | |
//!
//! `records.bin` is `ACTINREC` and then records of one length: time or path parameter, kinetic energy, residual force and
//! torque, energies of the terms, observables, motion unless `output` drops it, and the checksum of all records up to it. Records are appended as they are taken,
//! and results are written by reading them back one by one. The log reaches the disk before the checkpoint that counts its records; anything behind these is cut off when the run is resumed.

mod checkpoints;
mod error;
mod file;
mod log;
mod stored;
mod wire;

pub use checkpoints::Checkpoints;
pub use error::{CheckpointError, Damage};

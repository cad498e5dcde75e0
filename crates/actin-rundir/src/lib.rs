//! Files of a run: a directory of common formats that is written, read and resumed.
//!
//! A [`RunDirectory`] receives the results of a run. [`Checkpoints`] is the sink of a run that can
//! be resumed. A [`FinishedRun`] rebuilds the scene of a directory and reads its states; [`StoredStates`] are
//! read for a known assembly. A [`FollowedDirectory`] holds a motion with switches of cells.
//!
//! | file | contents | opens with |
//! |---|---|---|
//! | `scene.ron` | the scene with all defaults written out | `actin run` |
//! | `energies.csv` | energies and residuals of every record | any program |
//! | `observables.csv` | observables of every record | any program |
//! | `profile.csv` | last record along each filament: position, curvature, twist, energy | any program |
//! | `states.npz` | state of every record | numpy |
//! | `other_states.npz` | stable states of a search, in the format of `states.npz` with their index as `path` | numpy |
//! | `vtk/NNNN.vtp`, `run.pvd` | every record as a picture | `ParaView`, pyvista |
//! | `open_in_paraview.py` | script that shows monomers as ellipsoids and rods as tubes | `ParaView` |
//! | `summary.json` | numbers of the last record | any program |
//! | `records.bin` | records of an unfinished run | `actin run --resume` |
//! | `checkpoint.bin` | position of an unfinished run | `actin run --resume` |
//! | `end.bin`, `end_rows.bin` | end of a completed motion and rows of its records | `actin run --resume` with a longer duration |
//! | `actin-run.json` | manifest: names of the files that may be replaced or removed | any program |
//! | `.actin-run.lock` | process number during a run, otherwise empty | any program |
//!
//! Records are read from `records.bin` one at a time, once for each array and file, so memory use
//! does not grow with their number. Results with values that are not finite are refused.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod atomic;
mod build;
mod checkpoint;
mod damage;
mod difference;
mod directory;
mod energies;
mod error;
mod events;
mod export;
mod finished;
#[cfg(test)]
mod fixture;
mod json;
mod lock;
mod manifest;
mod names;
mod observables;
mod profile;
mod staged;
mod states;
mod stretches;
mod table;
mod write;

pub use actin_export::Format;
pub use actin_sim as sim;
pub use atomic::replace_file;
pub use build::build;
pub use checkpoint::{Checkpoints, Existing, OpenedRun};
pub use damage::{CheckpointError, Damage};
pub use difference::{Difference, first_difference};
pub use directory::RunDirectory;
pub use error::RunDirectoryError;
pub use export::{default_export_path, export};
pub use finished::FinishedRun;
pub use lock::RunLock;
pub use states::{StateArray, StateIter, StoredStates};
pub use stretches::FollowedDirectory;

use actin_sim::{Assembly, Task};

/// Name of the coordinate of records: time (ns) or, for equilibria, the path (in stages).
fn clock(assembly: &Assembly) -> &'static str {
    match assembly.scene.task {
        Task::Dynamics(_) | Task::Brownian(_) => "time_ns",
        Task::Equilibrium(_) => "path",
    }
}

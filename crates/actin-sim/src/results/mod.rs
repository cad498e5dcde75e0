//! What a run leaves behind: a directory of files that other programs open.
//!
//! | file | holds | opens with |
//! |---|---|---|
//! | `scene.ron` | the scene, every default written out | `actin run` |
//! | `energies.csv` | energies and residuals of every record | anything |
//! | `observables.csv` | what the scene observes, of every record | anything |
//! | `profile.csv` | the last record along each filament: place, curvature, twist, energy | anything |
//! | `states.npz` | every record's state | numpy |
//! | `other_states.npz` | stable states that were looked for, as `states.npz`; in place of the path it counts | numpy |
//! | `vtk/NNNN.vtp`, `run.pvd` | every record as a picture | `ParaView`, pyvista |
//! | `open_in_paraview.py` | monomers as ellipsoids, rods as tubes | `ParaView` |
//! | `summary.json` | the last record in numbers | anything |
//! | `records.bin` | the records of a run that has not ended, from which the rest is written | `actin run --resume` |
//! | `checkpoint.bin` | where such a run stands | `actin run --resume` |
//! | `actin-run.json` | the names of all these files: only what it lists is ever replaced or removed | anything |
//! | `.actin-run.lock` | nothing; while a run goes on, the number of its process | anything |
//!
//! Records are read back from `records.bin` one by one, once for each array and file, so that memory does
//! not grow with their number. Only this module knows file formats; nothing here computes physics beyond
//! sums: shapes come from [`crate::shape`]. Nothing that is not finite is ever written.

mod atomic;
mod checkpoint;
mod difference;
mod directory;
mod energies;
mod error;
mod events;
mod finished;
mod finite;
#[cfg(test)]
mod fixture;
mod followed;
mod lock;
mod manifest;
mod names;
mod observables;
mod profile;
mod review;
mod staged;
mod states;
mod stored;
mod summary;
mod vtk;
mod write;

pub use atomic::replace_file;
pub use checkpoint::{CheckpointError, Checkpoints, Damage};
pub use difference::{Difference, first_difference};
pub use directory::RunDirectory;
pub use error::RunDirectoryError;
pub use finished::{FinishedRun, FinishedRunError};
pub use followed::{FollowedDirectory, FollowingSummary};
pub use lock::RunLock;
pub use stored::{StateIter, StoredStates};
pub use summary::{
    AccuracySummary, EndReaction, EndReactions, EnergySummary, FilamentSummary, LinkerSummary,
    ResidualSummary, ShapeSummary, StabilitySummary, StateSummary, StatesSummary, Summary,
    ThermalSummary, WorkSummary,
};

use crate::{Assembly, Task};

/// What records are counted by: time (ns), or the path of equilibria, which counts stages.
fn clock(assembly: &Assembly) -> &'static str {
    match assembly.scene.task {
        Task::Dynamics(_) | Task::Brownian(_) => "time_ns",
        Task::Equilibrium(_) => "path",
    }
}

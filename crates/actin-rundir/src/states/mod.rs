//! `states.npz`: states of all records as numpy arrays.
//!
//! | array | shape | contents |
//! |---|---|---|
//! | `time_ns`, or `path` of equilibria | [T] | time, or position on the path in stages |
//! | `position_nm`, `velocity_nm_per_ns` | [T, points, 3] | lab frame |
//! | `centre_line_nm` | [T, points, 3] | centre line: positions of nodes, monomer centres shifted to the axis |
//! | `quaternion` | [T, frames, 4] | orientation, body to lab, in order w, x, y, z |
//! | `angular_momentum` | [T, frames, 3] | body frame, pN nm ns |
//! | `s_nm`, `kind` | [points] | arc length at rest, code of [`BodyKind`](actin_sim::BodyKind) |
//! | `kind_names` | [kinds] | names of the codes |
//! | `filament` | [points] | index of the filament |
//! | `frame_s_nm`, `frame_kind`, `frame_filament` | [frames] | the same for frames |
//!
//! Entries are stored without compression and may exceed 4 GiB.

mod arrays;
mod read;
mod write;

pub use read::{StateIter, StoredStates};
pub use write::StateArray;
pub(crate) use write::write;

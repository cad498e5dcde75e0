//! Resolution that follows a motion: cells of a filament become monomers while a run goes on, and a rod again.
//!
//! [`Follower`] is what to call first: it runs a scene whose `sections` are `Following(..)`. Such a run is a chain of
//! [`Stretch`]es, each an ordinary scene with sections of its own that begins where the one before was left.
//! [`Criterion`] says where monomers are needed (`criterion.rs`; its own is a type of the user's). At a switch
//! ([`Switch`]) bodies that stay keep every bit of their motion, and those that come are made from the
//! cross-sections of those that go (`field.rs`), settle by themselves (`settling.rs`), and get the momenta of those that go
//! (`transfer.rs`, `momentum.rs`). What the switch does to the energy is booked. Motion without inertia has no momenta.
//!
//! Which monomers there can be, and how they are bonded, does not depend on when they are resolved. Quasi-harmonic interfaces are
//! those of the run of monomers in which they stand, as in any scene: of two cells side by side they are sampled as one.
//!
//! All stretches have one time step, which suits the finer of rod and monomers. Whether overdamped steps of it are by midpoints or with
//! random stress is settled for each stretch by what relaxes fastest in it, as for any scene: both leave strains their
//! energy to 1 % where they are taken.

mod cells;
mod chain;
mod criterion;
mod field;
mod momentum;
mod settling;
mod transfer;

pub(crate) use cells::Cells;
pub use chain::{Beginning, Followed, Follower, Left, Next, Ran, Stretch};
pub use criterion::{Cell, Criterion, FilamentState, Wish};
pub use transfer::Switch;

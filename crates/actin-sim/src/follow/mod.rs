//! Resolution that follows a motion: cells of a filament switch between rod and monomers during a
//! run.
//!
//! [`Follower`] runs a scene whose `sections` are `Following(..)`. The run is a chain of
//! [`Stretch`]es. Each stretch is an ordinary scene with explicit sections that starts at the end
//! of the previous stretch. A [`Criterion`] selects the cells that need monomers; users can
//! implement it.
//!
//! At a [`Switch`], bodies outside the switched cells keep their motion bitwise. New bodies are
//! placed on the cross-sections of the old ones (`field.rs`), settle (`settling.rs`), and receive
//! the momenta of the old ones (`transfer.rs`, `momentum.rs`). The energy change of the switch is
//! recorded. Overdamped motion has no momenta.
//!
//! Positions and bonds of monomers do not depend on the time of the switch. Quasi-harmonic
//! interfaces are sampled for the whole run of monomers, as in any scene: two neighbouring cells
//! are sampled together.
//!
//! All stretches share one time step, suitable for both rods and monomers. Overdamped steps use
//! midpoints or random stress depending on the fastest relaxation of each stretch; both give
//! strains their thermal energy to 1 % where they apply.

mod chain;
mod criterion;
mod field;
mod momentum;
mod settling;
mod transfer;

pub use chain::{
    AdaptiveMotion, CompletedStretch, Follower, NextStretch, Stretch, StretchEnd, StretchStart,
};
pub use criterion::{Cell, Criterion, FilamentState, ResolutionRequest};
pub use transfer::Switch;

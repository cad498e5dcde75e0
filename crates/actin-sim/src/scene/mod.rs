//! The scene file: its types, how it is read, and what it refuses.
//!
//! Reading happens in two steps. RON gives the types below and refuses unknown or missing keys;
//! [`validate`] then checks what numbers may be. Both report line and column.

pub(crate) mod fitted;
mod law;
mod linker;
mod locate;
mod magnitude;
mod model;
mod problem;
mod read;
mod types;
mod validate;

pub use law::{
    BendLaw, RodLaw, RodLaws, ShearLaw, StretchLaw, TwistLaw, TwistRise, TwistStretchLaw,
};
pub use linker::Linker;
pub use model::{Anchors, ForceLaw, JunctionModel, JunctionWeight, Material, Monomers, RodModel};
pub use problem::{Problem, SceneError};
pub use types::{
    Clamp, Drag, Dynamics, End, Equilibrium, Filament, Hold, Integrator, Load, Scene, Section,
    Setting, Slides, Stage, StopRule, Task,
};
pub(crate) use validate::{MOST_BODIES, MOST_BONDS, validate};

//! Scenes of actin filaments at two resolutions: read, assembled, run and written.
//!
//! A [`Scene`] says what a filament is made of, what holds and loads it, and what is asked of it.
//! [`Assembly::build`] turns it into bodies and interactions; [`run`] integrates it; a
//! [`RunDirectory`] keeps what came out. This is the only crate that knows all the models; the
//! models do not know each other.
//!
//! The filament starts at the lab origin and runs along +z when it is built; azimuth 0 is +x.
//! Units: nm, pN, ns, rad (degrees where a key says so); mass in ag = 1e-21 kg = pN ns^2/nm.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

pub mod advice;
mod assembly;
pub mod cost;
pub mod measure;
mod results;
mod run;
mod scene;
pub mod shape;

pub use actin_cosserat::constants as rod_constants;
pub use actin_ellipsoid::constants as ellipsoid_constants;
pub use assembly::{
    Assembly, BeyondRange, BodyKind, Clamped, Counts, Drive, FrameInfo, JunctionBond, Part,
    PointInfo, Reaction, Resolution, SectionSpan, Term,
};
pub use results::{RunDirectory, RunDirectoryError, RunStatus, StabilitySummary, Summary};
pub use run::{
    EquilibriumReport, Estimate, Progress, Record, RunError, RunReport, Trajectory, estimate, run,
};
pub use scene::fitted::laws as fitted_laws;
pub use scene::{
    Anchors, BendLaw, Clamp, Drag, Dynamics, End, Equilibrium, Filament, ForceLaw, Hold,
    Integrator, JunctionModel, JunctionWeight, Linker, Load, Material, Monomers, Problem, RodLaw,
    RodLaws, RodModel, Scene, SceneError, Section, Setting, ShearLaw, Slides, Stage, StopRule,
    StretchLaw, Task, TwistLaw, TwistRise, TwistStretchLaw,
};

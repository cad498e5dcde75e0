//! Assembly and simulation of scenes of actin filaments at two resolutions.
//!
//! A [`Scene`] describes filaments, clamps, loads, linkers and the task. [`Assembly::build`]
//! creates its bodies and interactions; [`build`] also chooses automatic sections. [`Solve::solve`] runs a scene in memory;
//! a [`Plan`] selects the time step and runs it into a
//! [`Sink`]: memory, or the run directory of `actin-rundir`. The [`Outcome`] holds the status and cost. An
//! [`Ensemble`] runs replicas of a scene in parallel. This is the only crate that depends on all
//! models; the models do not depend on each other.
//!
//! Unless its scene places it elsewhere, a filament starts at the lab origin and runs along +z,
//! with azimuth 0 at +x. Units: nm, pN, ns, rad (degrees in keys with `deg`); mass in ag = 1e-21 kg
//! = pN ns^2/nm.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

#[cfg(test)]
extern crate self as actin_sim;

mod codes;
mod cost;
mod ensemble;
mod error;
mod execute;
pub mod follow;
mod loads;
mod memory;
mod notes;
mod observe;
mod run;
pub mod shape;
mod solution;
pub mod statistics;
mod summary;
pub mod trade;

// Crates whose types are in the API of this one.
pub use actin_assembly::{
    Assembly, At, BodyKind, Clamped, Counts, Drive, EnergyExchange, FilamentSpan, Fluctuations,
    FrameInfo, JunctionBond, LawExtrapolation, LinkerEvent, LinkerEventKind, MeasuredError,
    ModelLimitExceeded, Note, Part, PointInfo, Reaction, Resolution, SectionChoice, SectionSpan,
    Term, UnstableTwist,
};
pub use actin_cosserat as cosserat;
pub use actin_cosserat::constants as rod_constants;
pub use actin_coupling as coupling;
pub use actin_ellipsoid as ellipsoid;
pub use actin_ellipsoid::constants as ellipsoid_constants;
pub use actin_equilibrium as equilibrium;
pub use actin_integrate as integrate;
pub use actin_mechanics as mechanics;
use actin_scene as scene;
pub use actin_scene::fitted_laws;
pub use actin_scene::schema;
pub use actin_scene::{
    Acceleration, Adaptive, AdaptiveResolution, Anchors, BOLTZMANN_PN_NM_PER_K, Bead, BendLaw,
    Breaking, Brownian, Catch, Clamp, Couple, CouplePerLength, Cuboid, Cylinder, DragModel,
    DragRates, Dynamics, End, Equilibrium, Factor, Filament, Flow, Fluid, Force, ForceLaw,
    ForcePerLength, Forming, FreeTranslation, Hinge, Hold, Imperfection, Integrator, Interfaces,
    JunctionModel, JunctionWeight, Kinetics, Linker, LinkerSite, Load, Material, MonomerChanges,
    Monomers, Observable, Output, Override, PeriodicBox, Plane, Point, Quantity, RandomPart,
    RefinementCriterion, Repulsion, Roaming, RodChanges, RodLaw, RodLaws, RodModel, RotaryInertia,
    Scene, SceneError, SceneKind, SceneProblem, SceneText, SceneValue, Section, Sections, Setting,
    Shape, ShearLaw, Side, Sphere, Stage, Start, Stepping, StopTolerances, StretchLaw, Target,
    Task, Thermal, TimeCourse, TwistLaw, TwistRise, TwistStretchLaw, WallName, Water,
};
pub use actin_scene::{ParseReport, read_all, read_ron, to_ron};

pub use cost::{Cost, Timing};
pub use ensemble::{Ensemble, EnsembleError, Replica};
pub use error::SimError;
pub use observe::{DerivedLength, MeanSummary, ObservableSummary, observed_columns};
pub use run::{
    EnergyTotals, EquilibriumReport, Estimate, FailedRun, Failure, HingeSlip, LongestStep,
    ModelError, MotionPosition, Outcome, PathPosition, Plan, Progress, Record, RecordIter,
    RecordSummary, Records, RecordsError, RelaxationTimes, ResolutionSwitch, Row, RunError,
    RunPosition, RunStatistics, SaddlePush, SavedRun, Scatter, Sink, Slip, SolveReport,
    StableState, StableStates, Status, StepError, StoredRecord, Trajectory, composition,
    near_equilibrium, path_options, solver,
};
pub use solution::{Solution, Solve};
pub use summary::{
    AccuracySummary, EndReaction, EndReactions, EnergySummary, FilamentSummary, FollowingSummary,
    LinkerSummary, ResidualSummary, ShapeSummary, StabilitySummary, StateSummary, StatesSummary,
    Summary, ThermalSummary, WorkSummary,
};
pub use trade::build;

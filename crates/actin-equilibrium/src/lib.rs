//! Equilibria of points and frames by Newton's method with sparse stiffness matrices and
//! certificates of stability.
//!
//! [`relax`] moves a state to an equilibrium in one call. A [`Layout`] selects the unknowns and
//! their order, [`Newton`] minimises the potential energy over them, and [`Path`] follows
//! equilibria while controls (loads, clamps) change in steps. [`ImplicitSolver`] solves the linear
//! equations of an implicit time step.
//!
//! Units are nm, pN and rad.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

#[cfg(doctest)]
#[doc = include_str!("../../../docs/how-to/rust.md")]
struct WriteAnInteraction;

mod assemble;
mod band;
mod certificate;
mod chain;
mod descent;
mod direction;
mod evaluation;
mod factor;
mod gradients;
mod history;
mod implicit;
mod layout;
mod links;
mod load_scale;
mod mode;
mod motion;
mod nearest;
mod newton;
mod options;
mod outcome;
mod path;
mod path_observer;
mod path_options;
mod pattern;
mod relax;
mod search;
mod ties;

pub use assemble::MatrixParts;
pub use certificate::{Certificate, Stability};
pub use history::{Iteration, SolverWork, Verdict};
pub use implicit::{ImplicitSolver, Selection};
pub use layout::{BodyOrder, Layout, LayoutError};
pub use mode::Mode;
pub use motion::{ComponentStep, StepSize};
pub use nearest::Nearest;
pub use newton::Newton;
pub use newton::Push;
pub use options::{NewtonOptions, OptionsError};
pub use outcome::{Convergence, Equilibrium, NewtonFailure, SolveError};
pub use path::{Path, PathEnd, PathError, PathFailure};
pub use path_observer::{PathCheckpoint, PathObserver, PathPoint, Snap};
pub use path_options::{Jumps, PathOptions, Saddles};
pub use relax::{EquilibriumError, relax};
pub use search::{KnownEquilibrium, Search, SearchObserver, SearchResult, StableEquilibrium};

/// Points, frames, loads and interactions.
pub use actin_mechanics as mechanics;
pub use actin_mechanics::{
    Coordinates, Interaction, LoadError, Loads, Matrix3, Point, PointLoad, Residual, SecondOrder,
    Spring, Springs, State, Stiffness, Vector3, Weight,
};

//! Equilibria of points and frames: Newton on a sparse stiffness, certified.
//!
//! [`relax`] moves a state to an equilibrium in one call. What it is made of can be used alone: a
//! [`Layout`] says what may move and in what order unknowns stand. [`Newton`] minimises the
//! potential energy of interactions over it, and certifies what it finds. [`Path`] does so
//! along a path of controls. [`ImplicitSolver`] is the linear solve of a time step that is implicit in
//! the stiffness.
//!
//! This crate knows nothing of what the points and frames stand for. Units are nm, pN and rad.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

#[cfg(doctest)]
#[doc = include_str!("../../../docs/how-to/write-an-interaction.md")]
struct WriteAnInteraction;

mod assemble;
mod band;
mod certificate;
mod certify;
mod chain;
mod descent;
mod direction;
mod evaluation;
mod factor;
mod gradients;
mod group;
mod history;
mod implicit;
mod layout;
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
mod saddle;
mod search;
mod ties;

pub use certificate::{Certificate, Stability};
pub use group::{Group, Pivot};
pub use history::{Iteration, SolverWork, Verdict};
pub use implicit::ImplicitSolver;
pub use layout::{BodyOrder, Layout, LayoutError};
pub use mode::Mode;
pub use motion::StepSize;
pub use nearest::Nearest;
pub use newton::Newton;
pub use options::{NewtonOptions, OptionsError};
pub use outcome::{Convergence, Equilibrium, NewtonFailure, SolveError};
pub use path::{Path, PathEnd, PathError, PathFailure};
pub use path_observer::{PathCheckpoint, PathObserver, PathPoint};
pub use path_options::{Jumps, PathOptions, Saddles};
pub use relax::{EquilibriumError, relax};
pub use saddle::Push;
pub use search::{Distinct, Found, Known, Search, SearchObserver};

/// The crate of points, frames, loads and interactions whose equilibria are found.
pub use actin_mechanics as mechanics;
pub use actin_mechanics::{
    Coordinates, Interaction, LoadError, Loads, Matrix3, Point, PointLoad, Residual, SecondOrder,
    Spring, Springs, State, Stiffness, Vector3, Weight,
};

//! Integrators and the run loop.

mod bath;
mod checkpoint;
mod common;
mod drag;
mod energy;
mod failure;
mod frequency;
mod run;
mod schemes;
mod tops;

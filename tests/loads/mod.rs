//! Loads, ends and sections of scenes against theory: where loads act, how they change in time, which of them
//! have an energy.
//!
//! Bounds were set before results were seen; orders and limits are printed with `--nocapture`.

mod accepted;
mod common;
mod ends;
mod motion;
mod rods;
mod sections;
mod shapes;
mod statics;

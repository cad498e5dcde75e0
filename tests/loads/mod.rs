//! Loads, ends and sections of scenes against theory. Tolerances were set before the results;
//! `--nocapture` prints orders and limits.

mod accepted;
mod common;
mod ends;
mod motion;
mod rods;
mod sections;
mod shapes;
mod statics;

//! Loads, ends and sections of scenes against theory. Tolerances were set before the results;
//! orders and limits are printed with `--nocapture`.

mod accepted;
mod common;
mod ends;
mod motion;
mod rods;
mod sections;
mod shapes;
mod statics;

//! Overdamped motion.

mod chain;
mod common;
mod equilibrium;
mod langevin;
mod long_waves;
mod motion;

//! Overdamped motion.

mod chain;
mod common;
mod equilibrium;
mod hydrodynamics;
mod langevin;
mod long_waves;
mod motion;

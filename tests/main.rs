//! Tests across crates: scenes against theory, other methods and their own files.

mod checkpoints;
mod common;
mod dynamics;
mod equilibria;
mod follow;
mod loads;
mod readme_examples;
mod statics;
mod theory;
mod trade;
mod waves;

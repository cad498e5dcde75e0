//! Statics of assembled filaments, from a scene to an equilibrium: what crosses crates.
//!
//! Each file makes one argument. `common` holds scenes and their relaxation, and no assertion
//! but that the equilibrium was reached.

mod balance;
mod boundaries;
mod clamps;
mod common;
mod independence;
mod rest;
mod scenes;
mod timoshenko;

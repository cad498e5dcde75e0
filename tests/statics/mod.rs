//! Statics of assembled filaments, from a scene to an equilibrium.

mod balance;
mod boundaries;
mod clamps;
mod common;
mod independence;
mod rest;
mod scenes;
mod timoshenko;

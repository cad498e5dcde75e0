//! Interrupted and resumed runs, and damaged files.

mod common;
mod cost;
mod damaged;
mod disk;
mod extended;
mod observed;
mod resumed;

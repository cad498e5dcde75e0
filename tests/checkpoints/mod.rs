//! Interrupted and resumed runs, and damaged files.

mod common;
mod damaged;
mod disk;
mod extended;
mod observed;
mod resumed;

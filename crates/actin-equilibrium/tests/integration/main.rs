//! Integration tests of equilibria, paths and certificates.

mod certificate;
mod common;
mod cost;
mod newton;
mod path;
mod relax;
mod saddle;
mod search;
mod sliders;
mod stiffness;
mod tension;

//! Integration tests of equilibria, paths and certificates.

mod certificate;
mod common;
mod cost;
mod groups;
mod newton;
mod path;
mod relax;
mod saddle;
mod search;
mod stiffness;
mod tension;

//! Reproduction of the paper of Gunaratne, Floyd, Ni, Papoian and Erban (arXiv 2203.01284).
//!
//! - [`measure`]: protocols that measure the rigidities of a filament of any resolution. Start here.
//! - [`figures`]: the ten figures and five tables of the paper, computed and compared.
//! - [`committed`]: comparison of rows with the committed reports.
//! - [`fit`]: rod laws fitted to measured rows.
//! - [`cells`]: periodic cells of monomers under strains and loads.
//! - [`load_cases`]: comparison of rods with monomers in load cases.
//!
//! Scenes and committed numbers are read from the folders `scenarios` and `docs` of the workspace.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

pub mod cells;
mod centre_line;
mod charts;
pub mod committed;
pub mod figures;
pub mod fit;
pub mod load_cases;
pub mod measure;
mod palette;
mod published;
mod run;
mod statistics;

use std::fmt;
use std::path::{Path, PathBuf};

/// Receives the lines that a task prints while it runs.
pub(crate) type ProgressSink<'a> = &'a (dyn Fn(fmt::Arguments<'_>) + Sync);

/// Root folder of the workspace.
///
/// # Panics
/// If this crate does not lie two folders below the workspace.
pub fn workspace_root() -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    folder
        .ancestors()
        .nth(2)
        .expect("this crate lies two folders below the workspace")
        .to_path_buf()
}

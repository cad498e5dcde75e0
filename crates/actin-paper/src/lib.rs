//! The paper of Gunaratne, Floyd, Ni, Papoian and Erban (arXiv 2203.01284), computed again.
//!
//! - [`measure`]: protocols that read rigidities off a filament of any resolution. Start here.
//! - [`figures`]: the paper's ten figures and five tables, computed and compared, as pictures, tables and
//!   a page.
//! - [`committed`]: how rows differ from those that the documents were written from.
//! - [`fit`]: laws of the rod fitted to measured rows.
//! - [`cells`]: periodic cells of monomers under strains and loads.
//! - [`load_cases`]: how far rods under a law are from monomers, load case by load case.
//!
//! Scenes and committed numbers are those of the workspace that the crate was built in: `scenarios` and
//! `docs`. How pictures and pages look is decided in `actin-draw`, how scenes run in `actin-sim`.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

pub mod cells;
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
pub type Tell<'a> = &'a (dyn Fn(fmt::Arguments<'_>) + Sync);

/// The folder of the workspace that this crate was built in.
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

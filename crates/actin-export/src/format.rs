//! Formats that hold a whole run in one file.

use crate::gsd::write_gsd;
use crate::simularium::{simularium_meshes, write_simularium};
use crate::{Particles, RecordedStates};
use actin_sim::Assembly;
use std::io::{self, Seek, Write};

/// File format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// GSD with the schema of HOOMD: OVITO, `MDAnalysis`, HOOMD-blue, freud.
    Gsd,
    /// JSON of the Simularium viewer, which refers to meshes in other files.
    Simularium,
}

impl Format {
    /// Returns the file name extension.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Gsd => "gsd",
            Self::Simularium => "simularium",
        }
    }

    /// Returns the meshes that belong next to the file: names that begin with `prefix`, and contents.
    pub fn meshes(self, assembly: &Assembly, prefix: &str) -> Vec<(String, String)> {
        match self {
            Self::Gsd => Vec::new(),
            Self::Simularium => simularium_meshes(&Particles::new(assembly), prefix),
        }
    }

    /// Writes a run, which refers to its [`meshes`](Self::meshes) with the same `prefix`.
    ///
    /// # Errors
    /// If the states cannot be read, or `out` returns an error.
    pub fn write(
        self,
        assembly: &Assembly,
        states: &dyn RecordedStates,
        prefix: &str,
        out: &mut (impl Write + Seek),
    ) -> io::Result<()> {
        let particles = Particles::new(assembly);
        match self {
            Self::Gsd => write_gsd(&particles, states, out),
            Self::Simularium => write_simularium(particles, states, prefix, out),
        }
    }
}

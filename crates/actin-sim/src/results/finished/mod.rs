//! A finished run, read back: its scene, built again, and its [stored states](super::StoredStates).

mod error;

pub use error::FinishedRunError;

use super::names::SCENE;
use super::{RunDirectory, RunDirectoryError, StateIter, StoredStates};
use crate::{Assembly, At, Scene};
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A run directory, opened to read its states.
#[derive(Debug)]
pub struct FinishedRun {
    path: PathBuf,
    assembly: Assembly,
    stored: StoredStates,
}

impl FinishedRun {
    /// Opens a run directory and builds its scene again.
    ///
    /// # Errors
    /// A directory without a scene or without states, a scene that this version refuses, states that are
    /// damaged or of other bodies than the scene has.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, FinishedRunError> {
        let path = path.as_ref().to_owned();
        let scene = read_scene(&path)?;
        let assembly = Assembly::build(&scene).map_err(|problem| FinishedRunError::Problem {
            path: path.join(SCENE),
            problem,
        })?;
        let stored = RunDirectory::existing(&path).stored_states(&assembly)?;
        match stored {
            None => Err(FinishedRunError::NoStates { path }),
            Some(stored) => Ok(Self {
                path,
                assembly,
                stored,
            }),
        }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Its scene, built.
    pub fn assembly(&self) -> &Assembly {
        &self.assembly
    }

    /// Number of records.
    pub fn count(&self) -> usize {
        self.at().len()
    }

    /// When each record was taken, or where on the path.
    pub fn at(&self) -> &[At] {
        self.stored.at()
    }

    /// The states of all records in order.
    ///
    /// # Errors
    /// An array that is missing or does not fit.
    pub fn states(&self) -> Result<StateIter<'_, Range<usize>>, RunDirectoryError> {
        self.stored.states(&self.assembly, 0..self.count())
    }
}

fn read_scene(path: &Path) -> Result<Scene, FinishedRunError> {
    let file = path.join(SCENE);
    if !file.exists() {
        return Err(FinishedRunError::NotARun { path: path.into() });
    }
    let bytes = fs::read(&file).map_err(FinishedRunError::io(&file))?;
    let refused = |error| FinishedRunError::Scene { path: file, error };
    let text = Scene::text(bytes);
    text.and_then(|text| Scene::from_ron(&text))
        .map_err(refused)
}

#[cfg(test)]
mod tests;

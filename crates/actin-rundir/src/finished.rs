//! Finished runs: the rebuilt scene and its [stored states](StoredStates).

use crate::names::SCENE;
use crate::{RunDirectory, RunDirectoryError, StateIter, StoredStates};
use actin_sim::mechanics::State;
use actin_sim::{Assembly, At, Scene, SceneError};
use std::fs;
use std::ops::Range;
use std::path::Path;

/// A finished run, opened to read its states.
#[derive(Debug)]
pub struct FinishedRun {
    assembly: Assembly,
    stored: StoredStates,
}

impl FinishedRun {
    /// Opens a run directory and rebuilds its scene.
    ///
    /// # Errors
    /// The directory has no scene or no states, this version refuses the scene, or the states are
    /// damaged or do not belong to the scene.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, RunDirectoryError> {
        let path = path.as_ref().to_owned();
        let scene = read_scene(&path)?;
        let assembly = actin_sim::build(&scene)
            .map_err(|problem| RunDirectoryError::Problem(path.join(SCENE), problem))?;
        let stored = RunDirectory::existing(&path).stored_states(&assembly)?;
        match stored {
            None => Err(RunDirectoryError::NoStates(path)),
            Some(stored) => Ok(Self { assembly, stored }),
        }
    }

    /// Assembly of the scene.
    pub fn assembly(&self) -> &Assembly {
        &self.assembly
    }

    /// Number of records.
    pub fn count(&self) -> usize {
        self.at().len()
    }

    /// Time or path position of each record.
    pub(crate) fn at(&self) -> &[At] {
        self.stored.at()
    }

    /// Reads the state of the last record.
    ///
    /// # Errors
    /// An array is missing or has the wrong shape.
    pub fn last_state(&self) -> Result<State, RunDirectoryError> {
        let last = self.count().checked_sub(1);
        let mut states = self.stored.states(&self.assembly, last)?;
        // Runs have at least one record.
        states
            .next()
            .unwrap_or_else(|| Ok(self.assembly.rest.clone()))
    }

    /// Reads the states of all records in order.
    ///
    /// # Errors
    /// An array is missing or has the wrong shape.
    pub fn states(&self) -> Result<StateIter<'_, Range<usize>>, RunDirectoryError> {
        self.stored.states(&self.assembly, 0..self.count())
    }
}

fn read_scene(path: &Path) -> Result<Scene, RunDirectoryError> {
    let file = path.join(SCENE);
    if !file.exists() {
        return Err(RunDirectoryError::NotARun(path.into()));
    }
    let bytes = fs::read(&file).map_err(RunDirectoryError::io(&file))?;
    let scene = Scene::text(bytes).and_then(|text| Scene::from_ron(&text));
    scene.map_err(|error| {
        RunDirectoryError::Scene(SceneError {
            file: Some(file),
            ..error
        })
    })
}

#[cfg(test)]
mod tests;

//! A finished run, read back: its scene, built again, and the states that `states.npz` holds.
//!
//! [`FinishedRun::open`] reads a run directory; [`FinishedRun::states`] goes through its records one by one, so
//! that memory does not grow with their number. Numbers come back to the bit. What `states.npz` does not hold
//! is placed as the scene has it at that time: the ends and anchors that its path moves, the factors of loads.

mod arrays;
mod error;

pub use error::FinishedRunError;

use super::clock;
use super::names::{SCENE, STATES};
use crate::assembly::Ramp;
use crate::{Assembly, At, Scene};
use actin_mechanics::{Drive, Quaternions, State, Vectors};
use arrays::{Array, Arrays};
use std::fs;
use std::path::{Path, PathBuf};

/// Arc lengths closer than this (nm) are the same: far above round-off, far below any change of a scene.
const SAME_PLACE_NM: f64 = 1e-6;

/// A run directory, opened to read its states.
#[derive(Debug)]
pub struct FinishedRun {
    path: PathBuf,
    assembly: Assembly,
    times: Vec<f64>,
    arrays: Arrays,
}

impl FinishedRun {
    /// Opens a run directory and builds its scene again.
    ///
    /// # Errors
    /// A directory without a scene or without states, a scene that this version refuses, an array that is
    /// missing, damaged or of other bodies than the scene has.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, FinishedRunError> {
        let path = path.as_ref().to_owned();
        let scene = read_scene(&path)?;
        let assembly = Assembly::build(&scene).map_err(|problem| FinishedRunError::Problem {
            path: path.join(SCENE),
            problem,
        })?;
        let file = path.join(STATES);
        if !file.exists() {
            return Err(FinishedRunError::NoStates { path });
        }
        let arrays = Arrays::open(file)?;
        let times = arrays.open_array(clock(&assembly), None, &[])?.read_all()?;
        let run = Self {
            path,
            assembly,
            times,
            arrays,
        };
        // Opened once, so that what does not fit is refused now and not half way.
        run.states()?;
        run.ensure_own_scene()?;
        Ok(run)
    }

    /// Refuses states of other bodies than those of the scene, if they are as many.
    fn ensure_own_scene(&self) -> Result<(), FinishedRunError> {
        let places = self.arrays.open_array("s_nm", None, &[])?.read_all()?;
        let own = self.assembly.points.iter().map(|point| point.s_nm);
        let differ = |(read, own): (f64, f64)| (read - own).abs() > SAME_PLACE_NM;
        if places.into_iter().zip(own).any(differ) {
            return Err(FinishedRunError::Array {
                path: self.path.join(STATES),
                name: "s_nm".to_owned(),
                reason: format!("is not that of {SCENE}, which was changed"),
            });
        }
        Ok(())
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
        self.times.len()
    }

    /// Times (ns) of a motion, path parameters of equilibria.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// When a record was taken, or where on the path.
    ///
    /// # Panics
    /// If there is no such record.
    pub fn at(&self, record: usize) -> At {
        let value = self.times[record];
        match clock(&self.assembly) {
            "path" => At::Path(value),
            _ => At::Time(value),
        }
    }

    /// The states of all records in order.
    ///
    /// # Errors
    /// An array that is missing or does not fit.
    pub fn states(&self) -> Result<FinishedStates<'_>, FinishedRunError> {
        let (points, frames) = (self.assembly.points.len(), self.assembly.frames.len());
        let array = |name, shape: &[usize]| self.arrays.open_array(name, Some(self.count()), shape);
        Ok(FinishedStates {
            run: self,
            next: 0,
            ramp: Ramp::of(&self.assembly),
            position: array("position_nm", &[points, 3])?,
            velocity: array("velocity_nm_per_ns", &[points, 3])?,
            quaternion: array("quaternion", &[frames, 4])?,
            angular_momentum: array("angular_momentum", &[frames, 3])?,
        })
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

/// The states of a run, one after the other.
#[derive(Debug)]
pub struct FinishedStates<'a> {
    run: &'a FinishedRun,
    next: usize,
    ramp: Option<Ramp>,
    position: Array,
    velocity: Array,
    quaternion: Array,
    angular_momentum: Array,
}

impl FinishedStates<'_> {
    /// The next state, as built but for what is read.
    fn read(&mut self) -> Result<State, FinishedRunError> {
        let mut state = self.run.assembly.rest.clone();
        match self.run.at(self.next) {
            At::Path(u) => self.run.assembly.drive.place(&mut state, u),
            At::Time(time) => {
                if let Some(ramp) = &self.ramp {
                    ramp.place(&mut state, time);
                }
                state.time = time;
            }
        }
        fill(&mut state.points.position, &mut self.position)?;
        fill(&mut state.points.velocity, &mut self.velocity)?;
        turn(&mut state.frames.orientation, &mut self.quaternion)?;
        let angular_momentum = &mut state.frames.angular_momentum;
        fill(angular_momentum, &mut self.angular_momentum)?;
        Ok(state)
    }
}

impl Iterator for FinishedStates<'_> {
    type Item = Result<State, FinishedRunError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.next == self.run.count() {
            return None;
        }
        let state = self.read();
        // Behind an error there is nothing that could be trusted.
        self.next = if state.is_ok() {
            self.next + 1
        } else {
            self.run.count()
        };
        Some(state)
    }
}

fn fill(vectors: &mut Vectors, array: &mut Array) -> Result<(), FinishedRunError> {
    for i in 0..vectors.len() {
        (vectors.x[i], vectors.y[i], vectors.z[i]) = (array.next()?, array.next()?, array.next()?);
    }
    Ok(())
}

fn turn(turns: &mut Quaternions, array: &mut Array) -> Result<(), FinishedRunError> {
    for i in 0..turns.len() {
        (turns.w[i], turns.x[i]) = (array.next()?, array.next()?);
        (turns.y[i], turns.z[i]) = (array.next()?, array.next()?);
    }
    Ok(())
}

#[cfg(test)]
mod tests;

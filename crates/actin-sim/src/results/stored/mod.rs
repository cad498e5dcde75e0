//! States read back from `states.npz` of a run directory, one by one, so that memory does not grow with their number.
//!
//! Places, velocities and orientations are in the file and come back to the bit; what a scene moves from outside
//! (factors of loads, anchors, held ends) follows from its path and time, and which linkers hold from `events.csv`.

mod arrays;
mod events;

use super::names::{EVENTS, SCENE, STATES};
use super::{RunDirectory, RunDirectoryError, clock};
use crate::{Assembly, At};
use actin_mechanics::{Quaternions, State, Vectors};
use arrays::{Array, Arrays};
use events::Event;

/// How far from 1 the length of a quaternion may be that was written as a unit.
const UNIT: f64 = 1e-6;
/// Arc lengths closer than this (nm) are the same: far above round-off, far below any change of a scene.
const SAME_PLACE_NM: f64 = 1e-6;

/// The states of a run, in its directory; they are read when asked for.
#[derive(Debug)]
pub struct StoredStates {
    arrays: Arrays,
    at: Vec<At>,
    events: Vec<Event>,
}

impl RunDirectory {
    /// The states that `states.npz` holds of the run of this assembly; none where there is no such file.
    ///
    /// # Errors
    /// A file that cannot be read, that is damaged, or that holds other bodies.
    pub fn stored_states(
        &self,
        assembly: &Assembly,
    ) -> Result<Option<StoredStates>, RunDirectoryError> {
        let path = self.path.join(STATES);
        if !path.exists() {
            return Ok(None);
        }
        let arrays = Arrays::open(path)?;
        let clock = clock(assembly);
        let at_of = if clock == "path" { At::Path } else { At::Time };
        let at = arrays.open_array(clock, None, &[])?.read_all()?;
        let events = match assembly.kinetics {
            Some(_) => events::read(&self.path.join(EVENTS))?,
            None => Vec::new(),
        };
        let stored = StoredStates {
            arrays,
            at: at.into_iter().map(at_of).collect(),
            events,
        };
        // Opened once, so that what does not fit is refused now and not half way.
        stored.states(assembly, [])?;
        stored.ensure_own_scene(assembly)?;
        Ok(Some(stored))
    }
}

impl StoredStates {
    /// When, or where on the path, each state was recorded.
    pub fn at(&self) -> &[At] {
        &self.at
    }

    /// The states of records `which`, which ascend, of the run of this assembly.
    ///
    /// # Errors
    /// An array that is missing or does not fit.
    pub fn states<'a, I>(
        &'a self,
        assembly: &'a Assembly,
        which: I,
    ) -> Result<StateIter<'a, I::IntoIter>, RunDirectoryError>
    where
        I: IntoIterator<Item = usize>,
    {
        let (points, frames) = (assembly.points.len(), assembly.frames.len());
        let array = |name, shape: &[usize]| {
            let records = Some(self.at.len());
            self.arrays.open_array(name, records, shape)
        };
        Ok(StateIter {
            stored: self,
            assembly,
            which: which.into_iter(),
            next: 0,
            position: array("position_nm", &[points, 3])?,
            velocity: array("velocity_nm_per_ns", &[points, 3])?,
            quaternion: array("quaternion", &[frames, 4])?,
            angular_momentum: array("angular_momentum", &[frames, 3])?,
        })
    }

    /// Refuses states of other bodies than those of the scene, if they are as many.
    fn ensure_own_scene(&self, assembly: &Assembly) -> Result<(), RunDirectoryError> {
        let places = self.arrays.open_array("s_nm", None, &[])?.read_all()?;
        let own = assembly.points.iter().map(|point| point.s_nm);
        let differ = |(read, own): (f64, f64)| (read - own).abs() > SAME_PLACE_NM;
        if places.into_iter().zip(own).any(differ) {
            return Err(RunDirectoryError::OtherBodies {
                path: self.arrays.path().to_owned(),
                reason: format!("s_nm is not that of {SCENE}, which was changed"),
            });
        }
        Ok(())
    }
}

/// States of a run, one after the other.
#[derive(Debug)]
pub struct StateIter<'a, I> {
    stored: &'a StoredStates,
    assembly: &'a Assembly,
    which: I,
    /// The record that the arrays stand at.
    next: usize,
    position: Array,
    velocity: Array,
    quaternion: Array,
    angular_momentum: Array,
}

impl<I> StateIter<'_, I> {
    /// The state of a record that is not yet behind, as built but for what is read.
    fn read(&mut self, record: usize) -> Result<State, RunDirectoryError> {
        let mut state = self.assembly.rest.clone();
        self.skip(record - self.next)?;
        self.next = record + 1;
        let at = self.stored.at[record];
        self.assembly.place_controls(&mut state, at);
        if let At::Time(time_ns) = at {
            state.time = time_ns;
            events::replay(&self.stored.events, self.assembly, &mut state, time_ns);
        }
        fill(&mut state.points.position, &mut self.position)?;
        fill(&mut state.points.velocity, &mut self.velocity)?;
        turn(&mut state.frames.orientation, &mut self.quaternion)?;
        let angular_momentum = &mut state.frames.angular_momentum;
        fill(angular_momentum, &mut self.angular_momentum)?;
        Ok(state)
    }

    /// Goes over so many records.
    fn skip(&mut self, records: usize) -> Result<(), RunDirectoryError> {
        let (points, frames) = (self.assembly.points.len(), self.assembly.frames.len());
        self.position.skip(3 * points * records)?;
        self.velocity.skip(3 * points * records)?;
        self.quaternion.skip(4 * frames * records)?;
        self.angular_momentum.skip(3 * frames * records)
    }
}

impl<I: Iterator<Item = usize>> Iterator for StateIter<'_, I> {
    type Item = Result<State, RunDirectoryError>;

    fn next(&mut self) -> Option<Self::Item> {
        // Behind an error there is nothing that could be trusted.
        let records = self.stored.at.len();
        let ahead = self.next..records;
        let record = self.which.next().filter(|record| ahead.contains(record))?;
        let state = self.read(record);
        if state.is_err() {
            self.next = records;
        }
        Some(state)
    }
}

fn fill(vectors: &mut Vectors, array: &mut Array) -> Result<(), RunDirectoryError> {
    for i in 0..vectors.len() {
        (vectors.x[i], vectors.y[i], vectors.z[i]) = (array.next()?, array.next()?, array.next()?);
    }
    Ok(())
}

fn turn(turns: &mut Quaternions, array: &mut Array) -> Result<(), RunDirectoryError> {
    for i in 0..turns.len() {
        let [w, x, y, z] = [array.next()?, array.next()?, array.next()?, array.next()?];
        let length = (w * w + x * x + y * y + z * z).sqrt();
        if (length - 1.0).abs() > UNIT {
            return Err(array.damaged(&format!("a quaternion has the length {length} and not 1")));
        }
        (turns.w[i], turns.x[i], turns.y[i], turns.z[i]) = (w, x, y, z);
    }
    Ok(())
}

#[cfg(test)]
mod tests;

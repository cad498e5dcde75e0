//! Stored states, read from `states.npz` one at a time.
//!
//! Positions, velocities and orientations are exact. Controls (load factors, anchors, driven ends)
//! follow from the scene and the time or path, bound linkers from `events.csv`.

use super::arrays::{Array, Arrays};
use crate::names::{EVENTS, SCENE, STATES};
use crate::{RunDirectory, RunDirectoryError, clock, events};
use actin_sim::mechanics::{Quaternions, State, Vectors};
use actin_sim::{Assembly, At, LinkerEvent};

/// Maximum deviation of the norm of a quaternion from 1.
const UNIT: f64 = 1e-6;
/// Tolerance for equal arc lengths (nm): far above round-off, far below changes of a scene.
const SAME_PLACE_NM: f64 = 1e-6;

/// States of a run, read on demand.
#[derive(Debug)]
pub struct StoredStates {
    arrays: Arrays,
    at: Vec<At>,
    events: Vec<LinkerEvent>,
}

impl RunDirectory {
    /// Opens the states of a run of `assembly`; `None` without `states.npz`.
    ///
    /// # Errors
    /// The file is unreadable or damaged, or contains other bodies.
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
        let events = if assembly.has_events() {
            events::read(&self.path.join(EVENTS))?
        } else {
            Vec::new()
        };
        let stored = StoredStates {
            arrays,
            at: at.into_iter().map(at_of).collect(),
            events,
        };
        // Reports arrays of the wrong shape before reading starts.
        stored.states(assembly, [])?;
        stored.ensure_own_scene(assembly)?;
        Ok(Some(stored))
    }
}

impl StoredStates {
    /// Time or path position of each record.
    pub fn at(&self) -> &[At] {
        &self.at
    }

    /// Reads the states of records `which`, in ascending order.
    ///
    /// # Errors
    /// An array is missing or has the wrong shape.
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

    /// Refuses states whose arc lengths differ from the scene.
    fn ensure_own_scene(&self, assembly: &Assembly) -> Result<(), RunDirectoryError> {
        let places = self.arrays.open_array("s_nm", None, &[])?.read_all()?;
        let own = assembly.points.iter().map(|point| point.s_nm);
        let differ = |(read, own): (f64, f64)| (read - own).abs() > SAME_PLACE_NM;
        if places.into_iter().zip(own).any(differ) {
            return Err(RunDirectoryError::OtherBodies {
                path: self.arrays.path().to_owned(),
                reason: format!("s_nm does not match {SCENE}, which was changed after the run"),
            });
        }
        Ok(())
    }
}

/// Iterator over states of a run.
#[derive(Debug)]
pub struct StateIter<'a, I> {
    stored: &'a StoredStates,
    assembly: &'a Assembly,
    which: I,
    next: usize,
    position: Array,
    velocity: Array,
    quaternion: Array,
    angular_momentum: Array,
}

impl<I> StateIter<'_, I> {
    /// Reads the state of a record at or after the current position.
    fn read(&mut self, record: usize) -> Result<State, RunDirectoryError> {
        let mut state = self.assembly.rest.clone();
        self.skip(record - self.next)?;
        self.next = record + 1;
        let at = self.stored.at[record];
        let events = &self.stored.events;
        self.assembly.restore_controls(&mut state, at, events);
        if let At::Time(time_ns) = at {
            state.time = time_ns;
        }
        fill(&mut state.points.position, &mut self.position)?;
        fill(&mut state.points.velocity, &mut self.velocity)?;
        turn(&mut state.frames.orientation, &mut self.quaternion)?;
        let angular_momentum = &mut state.frames.angular_momentum;
        fill(angular_momentum, &mut self.angular_momentum)?;
        Ok(state)
    }

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
        // Ends the iteration after an error.
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
            return Err(array.damaged(&format!("a quaternion has the norm {length} instead of 1")));
        }
        (turns.w[i], turns.x[i], turns.y[i], turns.z[i]) = (w, x, y, z);
    }
    Ok(())
}

#[cfg(test)]
#[path = "read_tests.rs"]
mod tests;

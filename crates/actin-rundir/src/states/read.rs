//! Stored states, read from `states.npz` one at a time.
//!
//! Positions, velocities and orientations are exact. Controls (load factors, anchors, driven ends)
//! follow from the scene and the time or path, bound linkers from `events.csv`.

use super::arrays::{Array, Arrays};
use super::write::{ANGULAR_MOMENTUM, POSITION, QUATERNION, StateArray, VELOCITY};
use crate::names::{EVENTS, SCENE, STATES};
use crate::{RunDirectory, RunDirectoryError, clock, events};
use actin_sim::mechanics::{State, Vector3, Vectors};
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
        self.ensure_known_format()?;
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
        let records = Some(self.at.len());
        let array = |array: StateArray| {
            self.arrays
                .open_array(array.name, records, &array.shape(assembly))
        };
        Ok(StateIter {
            stored: self,
            assembly,
            which: which.into_iter(),
            next: 0,
            position: array(POSITION)?,
            velocity: array(VELOCITY)?,
            quaternion: array(QUATERNION)?,
            angular_momentum: array(ANGULAR_MOMENTUM)?,
        })
    }

    /// Refuses states whose arc lengths differ from the scene.
    fn ensure_own_scene(&self, assembly: &Assembly) -> Result<(), RunDirectoryError> {
        let places = self.arrays.open_array("s_nm", None, &[])?.read_all()?;
        let own = assembly.points.iter().map(|point| point.s_nm);
        let differ = |(read, own): (f64, f64)| (read - own).abs() > SAME_PLACE_NM;
        if places.into_iter().zip(own).any(differ) {
            let reason = format!("s_nm does not match {SCENE}, which was changed after the run");
            let path = self.arrays.path().to_owned();
            return Err(RunDirectoryError::OtherBodies(path, reason));
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
        let skipped = record - std::mem::replace(&mut self.next, record + 1);
        let at = self.stored.at[record];
        let events = &self.stored.events;
        self.assembly.restore_controls(&mut state, at, events);
        if let At::Time(time_ns) = at {
            state.time = time_ns;
        }
        state.points.position = vectors(&self.position.record(skipped)?);
        state.points.velocity = vectors(&self.velocity.record(skipped)?);
        state.frames.angular_momentum = vectors(&self.angular_momentum.record(skipped)?);
        let quaternions = self.quaternion.record(skipped)?;
        let turns = &mut state.frames.orientation;
        for (i, q) in quaternions.chunks_exact(4).enumerate() {
            let norm = q.iter().map(|c| c * c).sum::<f64>().sqrt();
            if (norm - 1.0).abs() > UNIT {
                let reason = format!("a quaternion has the norm {norm} instead of 1");
                return Err(self.quaternion.damaged(&reason));
            }
            (turns.w[i], turns.x[i], turns.y[i], turns.z[i]) = (q[0], q[1], q[2], q[3]);
        }
        Ok(state)
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

fn vectors(components: &[f64]) -> Vectors {
    let vectors = components.chunks_exact(3);
    vectors.map(|v| Vector3::new(v[0], v[1], v[2])).collect()
}

//! States read back from `states.npz` of a run directory.
//!
//! Places and orientations are in the file; what a scene moves from outside (factors of loads, anchors)
//! follows from its path and time, and which linkers hold from `events.csv`. Velocities are read too, so that a
//! state is whole.

use super::names::{EVENTS, STATES};
use super::{RunDirectory, RunDirectoryError, clock};
use crate::{Assembly, At, Happening};
use actin_mechanics::{State, UnitQuaternion, Vector3};
use nalgebra::Quaternion;
use std::fs::File;
use std::path::{Path, PathBuf};
use zip::ZipArchive;

/// How far from 1 the length of a quaternion may be that was written as a unit.
const UNIT: f64 = 1e-6;

/// The states of a run, in its directory; they are read when asked for.
#[derive(Clone, Debug)]
pub struct StoredStates<'a> {
    assembly: &'a Assembly,
    path: PathBuf,
    at: Vec<At>,
    events: Vec<Event>,
}

/// What happened to a linker.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Event {
    time_ns: f64,
    linker: usize,
    what: Happening,
    at_nm: f64,
}

impl RunDirectory {
    /// The states that `states.npz` holds of the run of this assembly; none where there is no such file.
    ///
    /// # Errors
    /// A file that cannot be read, that is damaged, or that holds other numbers of bodies.
    pub fn stored_states<'a>(
        &self,
        assembly: &'a Assembly,
    ) -> Result<Option<StoredStates<'a>>, RunDirectoryError> {
        let path = self.path.join(STATES);
        if !path.exists() {
            return Ok(None);
        }
        let at = numbers(&path, clock(assembly), &[])?.1;
        let is_motion = clock(assembly) == "time_ns";
        let at_of = if is_motion { At::Time } else { At::Path };
        let events = match assembly.kinetics {
            Some(_) => events(&self.path.join(EVENTS))?,
            None => Vec::new(),
        };
        Ok(Some(StoredStates {
            assembly,
            path,
            at: at.into_iter().map(at_of).collect(),
            events,
        }))
    }
}

impl StoredStates<'_> {
    /// When, or where on the path, each state was recorded.
    pub fn at(&self) -> &[At] {
        &self.at
    }

    /// The states of records `which`, which ascend.
    ///
    /// # Errors
    /// As [`RunDirectory::stored_states`].
    pub fn read(&self, which: &[usize]) -> Result<Vec<State>, RunDirectoryError> {
        let (points, frames) = (self.assembly.points.len(), self.assembly.frames.len());
        let field = |name, bodies: usize, components: usize| {
            let expected = [self.at.len(), bodies, components];
            chosen(&self.path, name, expected, which)
        };
        let places = field("position_nm", points, 3)?;
        let velocities = field("velocity_nm_per_ns", points, 3)?;
        let turns = field("quaternion", frames, 4)?;
        let momenta = field("angular_momentum", frames, 3)?;
        let mut states = Vec::with_capacity(which.len());
        for (k, &record) in which.iter().enumerate() {
            let mut state = self.assembly.rest.clone();
            self.place_controls(&mut state, self.at[record]);
            for (i, v) in vectors(&places, k, points).enumerate() {
                state.points.position.set(i, v);
            }
            for (i, v) in vectors(&velocities, k, points).enumerate() {
                state.points.velocity.set(i, v);
            }
            for (i, v) in vectors(&momenta, k, frames).enumerate() {
                state.frames.angular_momentum.set(i, v);
            }
            let turns = turns[4 * frames * k..4 * frames * (k + 1)].chunks_exact(4);
            for (i, q) in turns.enumerate() {
                let turn = self.unit(record, i, q)?;
                state.frames.orientation.set(i, turn);
            }
            states.push(state);
        }
        Ok(states)
    }

    /// The orientation of frame `i`.
    fn unit(
        &self,
        record: usize,
        i: usize,
        q: &[f64],
    ) -> Result<UnitQuaternion, RunDirectoryError> {
        let q = Quaternion::new(q[0], q[1], q[2], q[3]);
        if (q.norm() - 1.0).abs() < UNIT {
            return Ok(UnitQuaternion::new_normalize(q));
        }
        let norm = q.norm();
        let reason = format!("quaternion[{record}, {i}] has the length {norm} and not 1");
        Err(damaged(&self.path, reason))
    }

    /// Puts what is set from outside where it was at that time or place.
    fn place_controls(&self, state: &mut State, at: At) {
        self.assembly.place_controls(state, at);
        let (Some(kinetics), At::Time(time_ns)) = (&self.assembly.kinetics, at) else {
            return;
        };
        for event in self.events.iter().take_while(|e| e.time_ns <= time_ns) {
            let Some((linker, places_nm)) = kinetics.linker(event.linker) else {
                continue;
            };
            match event.what {
                Happening::Broke | Happening::Left => linker.release(state),
                Happening::Formed | Happening::Stepped => {
                    let distance = |place: &usize| (places_nm[*place] - event.at_nm).abs();
                    let nearest =
                        (0..places_nm.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
                    linker.bind(state, nearest.unwrap_or(0));
                }
            }
        }
    }
}

fn vectors(values: &[f64], record: usize, bodies: usize) -> impl Iterator<Item = Vector3> + '_ {
    let all = values[3 * bodies * record..3 * bodies * (record + 1)].chunks_exact(3);
    all.map(|v| Vector3::new(v[0], v[1], v[2]))
}

/// The records `which` of an array of this shape.
fn chosen(
    path: &Path,
    name: &str,
    shape: [usize; 3],
    which: &[usize],
) -> Result<Vec<f64>, RunDirectoryError> {
    let each = shape[1] * shape[2];
    let mut values = Vec::with_capacity(each * which.len());
    let mut wanted = which.iter().copied().peekable();
    let mut index = 0;
    for_each(path, name, &shape, |value| {
        let record = index / each;
        while wanted.next_if(|&next| next < record).is_some() {}
        if wanted.peek() == Some(&record) {
            values.push(value);
        }
        index += 1;
    })?;
    let is_finite = values.iter().all(|value: &f64| value.is_finite());
    if values.len() < each * which.len() || !is_finite {
        return Err(damaged(
            path,
            format!("{name} holds too few finite numbers"),
        ));
    }
    Ok(values)
}

/// A whole array with its shape, which is `shape` unless that is empty.
fn numbers(
    path: &Path,
    name: &str,
    shape: &[usize],
) -> Result<(Vec<usize>, Vec<f64>), RunDirectoryError> {
    let mut values = Vec::new();
    let shape = for_each(path, name, shape, |value| values.push(value))?;
    Ok((shape, values))
}

/// Hands on the numbers of an array, one by one; its shape.
fn for_each(
    path: &Path,
    name: &str,
    expected: &[usize],
    mut take: impl FnMut(f64),
) -> Result<Vec<usize>, RunDirectoryError> {
    let refused = |reason: String| damaged(path, reason);
    let file = File::open(path).map_err(RunDirectoryError::io(path))?;
    let mut archive = ZipArchive::new(std::io::BufReader::new(file))
        .map_err(|error| refused(error.to_string()))?;
    let entry = archive.by_name(&format!("{name}.npy"));
    let entry = entry.map_err(|error| refused(format!("{name}: {error}")))?;
    let in_array = |error: std::io::Error| refused(format!("{name}: {error}"));
    let array = npyz::NpyFile::new(std::io::BufReader::new(entry)).map_err(in_array)?;
    let shape: Vec<usize> = array
        .shape()
        .iter()
        .map(|&n| usize::try_from(n).unwrap_or(usize::MAX))
        .collect();
    if !expected.is_empty() && shape != expected {
        return Err(refused(format!(
            "{name} has the shape {shape:?} where this scene has {expected:?}"
        )));
    }
    let values = array
        .data::<f64>()
        .map_err(|error| refused(format!("{name}: {error}")))?;
    for value in values {
        take(value.map_err(in_array)?);
    }
    Ok(shape)
}

/// The events of a run, in order.
fn events(path: &Path) -> Result<Vec<Event>, RunDirectoryError> {
    let refused = |error: csv::Error| damaged(path, error.to_string());
    let mut reader = csv::Reader::from_path(path).map_err(refused)?;
    let mut all = Vec::new();
    for (row, record) in reader.records().enumerate() {
        let record = record.map_err(refused)?;
        let cell = |i: usize| record.get(i).unwrap_or_default();
        let what = [
            Happening::Broke,
            Happening::Formed,
            Happening::Stepped,
            Happening::Left,
        ];
        let what = what.into_iter().find(|what| what.to_string() == cell(2));
        let event = (cell(0).parse(), cell(1).parse(), what, cell(4).parse());
        let (Ok(time_ns), Ok(linker), Some(what), Ok(at_nm)) = event else {
            return Err(damaged(path, format!("row {} is no event", row + 1)));
        };
        all.push(Event {
            time_ns,
            linker,
            what,
            at_nm,
        });
    }
    Ok(all)
}

fn damaged(path: &Path, reason: String) -> RunDirectoryError {
    RunDirectoryError::Damaged {
        path: path.to_owned(),
        reason,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::fixture;
    use crate::results::states::States;

    /// A directory with the states of a made-up run, and that run.
    fn written(assembly: &Assembly) -> (tempfile::TempDir, crate::Trajectory) {
        let folder = tempfile::tempdir().unwrap();
        let trajectory = fixture::trajectory(assembly);
        let mut file = File::create(folder.path().join(STATES)).unwrap();
        States::new(assembly).write(&trajectory, &mut file).unwrap();
        (folder, trajectory)
    }

    /// What was written comes back: places to the last bit, turns to round-off of their normalisation.
    #[test]
    fn states_come_back() {
        let assembly = fixture::clamped_start();
        let (folder, trajectory) = written(&assembly);
        let directory = RunDirectory::existing(folder.path());
        let stored = directory.stored_states(&assembly).unwrap().unwrap();
        assert!(
            stored
                .at()
                .iter()
                .eq(trajectory.records.iter().map(|r| &r.at))
        );
        let states = stored.read(&[0, 2]).unwrap();
        for (state, k) in states.iter().zip([0, 2]) {
            let expected = &trajectory.records[k].state;
            assert_eq!(state.points.position, expected.points.position);
            assert_eq!(state.points.velocity, expected.points.velocity);
            let angular = |s: &State| s.frames.angular_momentum.clone();
            assert_eq!(angular(state), angular(expected));
            for i in 0..assembly.frames.len() {
                let turns = [state, expected].map(|s| s.frames.orientation.get(i));
                assert!((turns[0].coords - turns[1].coords).norm() < 1e-15);
            }
        }
    }

    /// Half a file, another scene's, and none.
    #[test]
    fn what_cannot_be_read_is_refused() {
        let assembly = fixture::clamped_start();
        let (folder, _) = written(&assembly);
        let directory = RunDirectory::existing(folder.path());
        let pair = fixture::pair();
        let other = directory.stored_states(&pair).unwrap().unwrap();
        let message = other.read(&[0]).unwrap_err().to_string();
        assert!(message.contains("position_nm has the shape"), "{message}");
        let path = folder.path().join(STATES);
        let bytes = std::fs::read(&path).unwrap();
        std::fs::write(&path, &bytes[..bytes.len() / 2]).unwrap();
        let message = directory.stored_states(&assembly).unwrap_err().to_string();
        assert!(message.contains("states.npz is damaged"), "{message}");
        std::fs::remove_file(&path).unwrap();
        assert!(directory.stored_states(&assembly).unwrap().is_none());
    }
}

//! Extension of completed motions to longer durations.
//!
//! `end.bin` has the format of `checkpoint.bin`, `end_rows.bin` the format of `records.bin` without
//! states, which are in `states.npz`.

use super::file::{Contents, Identity, same_scene};
use super::log::{RecordLog, Tally};
use super::stored::Form;
use super::{Checkpoints, Ending};
use crate::Damage;
use crate::atomic::replace_durably;
use crate::difference::{Difference, first_difference};
use crate::manifest::{Manifest, remove_if_there};
use crate::names::{CHECKPOINT, END, END_ROWS, SCENE};
use crate::{RunDirectory, RunDirectoryError};
use actin_sim::{Plan, Records, RunPosition, Scene, Status, StoredRecord, Task};
use std::borrow::Cow;
use std::fs;
use std::io::Write;
use std::path::Path;

impl RunDirectory {
    /// Returns the end of a finished run; `None` without results.
    ///
    /// # Errors
    /// The results belong to another scene.
    pub(super) fn ending(&self, plan: &Plan<'_>) -> Result<Option<Ending>, RunDirectoryError> {
        self.ensure_known_format()?;
        let path = self.path.join(SCENE);
        let (Ok(summary), Ok(scene)) = (self.summary(), fs::read_to_string(&path)) else {
            return Ok(None);
        };
        let given = plan.scene().to_ron();
        Ok(match summary.status {
            Status::Interrupted => None,
            status if scene == given => Some(Ending::Same(status)),
            status => {
                let refused = |damage: Damage| damage.of(&path);
                let is_completed = status == Status::Completed;
                let Some(longer) = longer(&scene, plan.scene()).filter(|_| is_completed) else {
                    same_scene(&scene, &given).map_err(refused)?;
                    return Ok(None);
                };
                if let Some(Difference { line, kept, given }) = first_difference(&longer, &given) {
                    let reason = format!(
                        "line {line} of the resolved scene was {kept:?} and would be {given:?}; \
                         run {} with --set for the duration",
                        path.display()
                    );
                    return Err(refused(Damage::Extension(reason)).into());
                }
                Some(Ending::Shorter(scene))
            }
        })
    }
}

/// Replaces duration and burn-in of a scene by the values of a scene with a longer duration.
fn longer(scene: &str, given: &Scene) -> Option<String> {
    let mut scene = Scene::from_ron(scene).ok()?;
    let (duration, longer) = match (&mut scene.task, &given.task) {
        (Task::Dynamics(one), Task::Dynamics(given)) => (&mut one.duration_ns, given.duration_ns),
        (Task::Brownian(one), Task::Brownian(given)) => (&mut one.duration_ms, given.duration_ms),
        _ => return None,
    };
    if *duration >= longer {
        return None;
    }
    *duration = longer;
    scene.burn_in_ns = given.burn_in_ns;
    Some(scene.to_ron())
}

impl Checkpoints {
    /// Keeps the end of a motion.
    pub(super) fn keep_end(&self) -> Result<(), RunDirectoryError> {
        let folder = self.directory.path();
        let mut manifest = Manifest::own(folder)?;
        manifest.add([END, END_ROWS]);
        manifest.write(folder)?;
        let mut rows = rows(folder, Tally::default(), &self.identity);
        for record in self.log.iter() {
            rows.push(record.map_err(RunDirectoryError::io(folder))?);
        }
        let path = folder.join(CHECKPOINT);
        let contents = self.identity.read(&path);
        let contents = Contents {
            // In the summary only, so that equal runs have equal files.
            wall_s: 0.0,
            ..contents.map_err(|damage| damage.of(&path))?
        };
        write(&self.identity, &folder.join(END), &mut rows, contents)
    }

    /// Writes the checkpoint of a motion that continues the completed motion of `scene`.
    pub(super) fn extend(
        &mut self,
        plan: &Plan<'_>,
        scene: String,
    ) -> Result<(), RunDirectoryError> {
        let folder = self.directory.path();
        let path = folder.join(END);
        let refused = |damage: Damage| damage.of(&path);
        let identity = Identity {
            scene,
            ..self.identity.clone()
        };
        let contents = Contents {
            wall_s: self.directory.summary()?.wall_s,
            ..identity.read(&path).map_err(refused)?
        };
        check(plan, &contents).map_err(refused)?;
        let rows = rows(folder, contents.records, &identity);
        let stored = if self.identity.form.has_states {
            self.directory.stored_states(plan.assembly())?
        } else {
            None
        };
        let count = rows.count();
        let states = stored.as_ref().map(|s| s.states(plan.assembly(), 0..count));
        let mut states = states.transpose()?;
        for record in rows.iter() {
            let state = states.as_mut().and_then(Iterator::next).transpose()?;
            let record = StoredRecord {
                state: state.map(Cow::Owned),
                ..record.map_err(RunDirectoryError::io(folder))?
            };
            if record.state.is_none() && self.identity.form.has_states {
                let what = "states.npz does not contain the states of all records";
                return Err(refused(Damage::Extension(what.into())).into());
            }
            self.log.push(record);
        }
        let path = folder.join(CHECKPOINT);
        write(&self.identity, &path, &mut self.log, contents)?;
        [END, END_ROWS]
            .iter()
            .try_for_each(|name| remove_if_there(&folder.join(name)))
    }
}

/// Refuses motions that would have continued differently.
fn check(plan: &Plan<'_>, contents: &Contents<'_>) -> Result<(), Damage> {
    let RunPosition::Motion(position) = &*contents.position else {
        return Ok(());
    };
    let every = plan.estimate().map_or(1, |e| e.steps_between_records);
    if !position.checkpoint.here.step.is_multiple_of(every) {
        let what = "the duration was not a multiple of the interval of records";
        return Err(Damage::Extension(what.into()));
    }
    match &plan.scene().task {
        Task::Dynamics(dynamics) if dynamics.leave_saddles > 0 => {
            let what = "with leave_saddles, the end of a motion depends on its duration";
            Err(Damage::Extension(what.into()))
        }
        _ => Ok(()),
    }
}

fn rows(folder: &Path, tally: Tally, identity: &Identity) -> RecordLog {
    let form = Form {
        has_states: false,
        ..identity.form.clone()
    };
    RecordLog::new(folder.join(END_ROWS), tally, &form, None)
}

/// Writes `contents` with the records of `log`.
fn write(
    identity: &Identity,
    path: &Path,
    log: &mut RecordLog,
    contents: Contents<'_>,
) -> Result<(), RunDirectoryError> {
    let records = log.sync(log.count()).map_err(RunDirectoryError::io(path))?;
    let bytes = identity.encode(&Contents {
        records,
        ..contents
    });
    replace_durably(path, |out| out.write_all(&bytes)).map_err(RunDirectoryError::io(path))
}

//! Checkpoints of a run in its directory.

use super::Ending;
use super::file::{Contents, Identity};
use super::log::{RecordLog, Tally};
use super::stored::Stored;
use crate::RunDirectoryError;
use crate::atomic::replace_durably;
use crate::directory::RunDirectory;
use crate::lock::RunLock;
use crate::manifest::remove_if_there;
use crate::names::{CHECKPOINT, RECORDS};
use crate::{CheckpointError, Damage};
use actin_sim::{
    Plan, Record, RecordIter, RecordSummary, Records, RunPosition, SavedRun, Sink, Status,
};
use std::borrow::Cow;
use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Treatment of an existing run directory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Existing {
    /// A directory that is not empty is refused.
    Refuse,
    /// An earlier run is replaced.
    Overwrite,
    /// An interrupted run is continued. A completed motion is extended if the scene differs in a
    /// longer duration only.
    Resume,
}

/// Run directory after [`Checkpoints::open`].
#[derive(Debug)]
pub enum OpenedRun {
    /// The run begins or continues.
    Begun {
        /// Position of an interrupted run; `None` for a new run.
        saved: Option<Box<SavedRun>>,
        /// Lock, to be held until the end of the run.
        lock: RunLock,
    },
    /// The run to be resumed is finished.
    Finished(Status),
}

/// Sink of a run directory, which writes records and checkpoints.
///
/// Checkpoints are written at an interval of time, on interruption and at the end of the run.
/// Memory holds at most one buffer of records. If a checkpoint cannot be written, the previous one
/// stays and writing is repeated after the interval.
#[derive(Debug)]
pub struct Checkpoints {
    pub(super) directory: RunDirectory,
    pub(super) identity: Identity,
    pub(super) log: RecordLog,
    every: Duration,
    last: Instant,
    interrupted: Arc<AtomicBool>,
    warn: fn(&CheckpointError),
    last_failed: bool,
}

impl Checkpoints {
    /// Creates the sink of a plan in `directory`, with a checkpoint interval `every`.
    ///
    /// Setting `interrupted` interrupts the run. `warn` is called when a checkpoint cannot be
    /// written.
    pub fn new(
        directory: &RunDirectory,
        plan: &Plan<'_>,
        every: Duration,
        interrupted: Arc<AtomicBool>,
        warn: fn(&CheckpointError),
    ) -> Self {
        let identity = Identity::new(plan);
        let records = directory.path.join(RECORDS);
        Self {
            directory: directory.clone(),
            log: RecordLog::new(records, Tally::default(), &identity.form, None),
            identity,
            every,
            last: Instant::now(),
            interrupted,
            warn,
            last_failed: false,
        }
    }

    /// Opens the directory of a run and locks it. A new run begins with its scene.
    ///
    /// # Errors
    /// The directory or its checkpoint is refused; see [`RunDirectory::create`] and
    /// [`resume`](Self::resume).
    pub fn open(
        &mut self,
        plan: &Plan<'_>,
        existing: Existing,
    ) -> Result<OpenedRun, RunDirectoryError> {
        let directory = self.directory.clone();
        let is_resumed = || existing == Existing::Resume && directory.has_checkpoint();
        let ended = || match existing {
            Existing::Resume if !directory.has_checkpoint() => directory.ending(plan),
            _ => Ok(None),
        };
        // Checked before locking: a finished run is not written to.
        let before = ended()?;
        if let Some(Ending::Same(status)) = before {
            return Ok(OpenedRun::Finished(status));
        }
        let lock = if is_resumed() || before.is_some() {
            RunLock::acquire(directory.path())?
        } else {
            // A run that was killed before its first checkpoint or results is replaced.
            let is_left = existing == Existing::Resume && directory.is_unfinished();
            let overwrite = existing == Existing::Overwrite || is_left;
            RunDirectory::create_locked(directory.path(), overwrite)?.1
        };
        // Another run may have ended before the lock was taken.
        match ended()? {
            Some(Ending::Same(status)) => return Ok(OpenedRun::Finished(status)),
            Some(Ending::Shorter(scene)) => self.extend(plan, scene)?,
            None => {}
        }
        let saved = if is_resumed() {
            let saved = self.resume(plan)?;
            directory.reopen()?;
            Some(Box::new(saved))
        } else {
            directory.write_scene(plan.scene())?;
            None
        };
        Ok(OpenedRun::Begun { saved, lock })
    }

    /// Reads the checkpoint of an interrupted run, for [`resume_into`](Plan::resume_into).
    ///
    /// # Errors
    /// The checkpoint or its records are missing or damaged, or belong to another scene or version.
    pub fn resume(&mut self, plan: &Plan<'_>) -> Result<SavedRun, CheckpointError> {
        let path = self.directory.path.join(CHECKPOINT);
        let damaged = |damage: Damage| damage.of(&path);
        let contents = self.identity.read(&path).map_err(damaged)?;
        let (records, form) = (contents.records, &self.identity.form);
        let none = RecordSummary::new(plan.assembly());
        let saved = contents.saved(&none, form).map_err(damaged)?;
        let path = self.directory.path.join(RECORDS);
        self.log = RecordLog::new(path.clone(), records, form, saved.recorded.last.as_ref());
        // Reports unreadable records before the run continues.
        let mut records = self.log.read().map_err(|damage| damage.of(&path))?;
        records.try_for_each(|record| record.map(drop).map_err(|damage| damage.of(&path)))?;
        Ok(saved)
    }

    /// Returns true if the last attempt to write a checkpoint failed.
    pub fn last_failed(&self) -> bool {
        self.last_failed
    }

    /// Removes the checkpoint after the results were [written](RunDirectory::write) to the disk.
    /// The end of a completed motion is kept for an extension.
    ///
    /// # Errors
    /// A refusal of the file system.
    pub fn finish(&self, status: Status) -> Result<(), RunDirectoryError> {
        if status == Status::Completed && !self.last_failed {
            self.keep_end()?;
        }
        self.directory.remove_checkpoint()
    }

    fn write(
        &mut self,
        position: &RunPosition,
        recorded: &RecordSummary,
        wall_s: f64,
    ) -> Result<(), CheckpointError> {
        let [path, log] = [CHECKPOINT, RECORDS].map(|name| self.directory.path.join(name));
        let synced = self.log.sync(recorded.count());
        let records = synced.map_err(|error| Damage::from(error).of(&log))?;
        let last = recorded.last.as_ref();
        let bytes = self.identity.encode(&Contents {
            wall_s,
            records,
            position: Cow::Borrowed(position),
            carried: Cow::Borrowed(&recorded.carried),
            last: last.map(|last| Stored::new(&last.row, Some(&last.state))),
        });
        let replaced = replace_durably(&path, |out| out.write_all(&bytes));
        replaced.map_err(|error| Damage::from(error).of(&path))
    }
}

impl Sink for Checkpoints {
    fn record(&mut self, record: &Record) {
        self.log.push(record.as_stored());
    }

    fn is_interrupted(&mut self) -> bool {
        self.interrupted.load(Ordering::Relaxed)
    }

    fn is_checkpoint_due(&mut self) -> bool {
        self.last.elapsed() >= self.every
    }

    fn checkpoint(&mut self, position: &RunPosition, recorded: &RecordSummary, wall_s: f64) {
        let outcome = self.write(position, recorded, wall_s);
        self.last_failed = outcome.is_err();
        if let Err(error) = outcome {
            (self.warn)(&error);
        }
        self.last = Instant::now();
    }
}

/// All records, including those before the run was resumed.
impl Records for Checkpoints {
    fn count(&self) -> usize {
        self.log.count()
    }

    fn iter(&self) -> RecordIter<'_> {
        self.log.iter()
    }
}

impl RunDirectory {
    /// Opens the directory of a run to be resumed, without changing it.
    pub fn existing(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into() }
    }

    /// Returns true if the directory contains a checkpoint.
    pub fn has_checkpoint(&self) -> bool {
        self.path.join(CHECKPOINT).exists()
    }

    /// Removes the checkpoint after the results were [written](RunDirectory::write) to the disk.
    ///
    /// # Errors
    /// A refusal of the file system.
    pub fn remove_checkpoint(&self) -> Result<(), RunDirectoryError> {
        for name in [CHECKPOINT, RECORDS] {
            remove_if_there(&self.path.join(name))?;
        }
        Ok(())
    }
}

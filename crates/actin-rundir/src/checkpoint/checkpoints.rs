//! Checkpoints of a run in its directory.

use super::file::{Contents, Identity, same_scene};
use super::log::{RecordLog, Tally};
use super::stored::Stored;
use super::{CheckpointError, Damage};
use crate::RunDirectoryError;
use crate::atomic::replace_durably;
use crate::directory::RunDirectory;
use crate::manifest::remove_if_there;
use crate::names::{CHECKPOINT, RECORDS, SCENE, SUMMARY};
use actin_sim::{
    Plan, Record, RecordIter, RecordSummary, Records, RowIter, RunPosition, SavedRun, Sink, Status,
    Summary,
};
use std::borrow::Cow;
use std::fs;
use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Sink of a run directory, which writes records and checkpoints.
///
/// Checkpoints are written at an interval of time, on interruption and at the end of the run.
/// Memory holds at most one buffer of records. If a checkpoint cannot be written, the previous one
/// stays and writing is repeated after the interval.
#[derive(Debug)]
pub struct Checkpoints {
    path: PathBuf,
    identity: Identity,
    log: RecordLog,
    every: Duration,
    last: Instant,
    interrupted: Arc<AtomicBool>,
    written: u64,
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
            path: directory.path.join(CHECKPOINT),
            log: RecordLog::new(records, Tally::default(), &identity.form, None),
            identity,
            every,
            last: Instant::now(),
            interrupted,
            written: 0,
            warn,
            last_failed: false,
        }
    }

    /// Reads the checkpoint of an interrupted run, for [`resume_into`](Plan::resume_into).
    ///
    /// # Errors
    /// The checkpoint or its records are missing or damaged, or belong to another scene or version.
    pub fn resume(&mut self, plan: &Plan<'_>) -> Result<SavedRun, CheckpointError> {
        let damaged = |damage: Damage| damage.of(&self.path);
        let contents = self.identity.read(&self.path).map_err(damaged)?;
        let (records, form) = (contents.records, &self.identity.form);
        let none = RecordSummary::new(plan.assembly());
        let saved = contents.saved(&none, form).map_err(damaged)?;
        let path = self.path.with_file_name(RECORDS);
        self.log = RecordLog::new(path.clone(), records, form, saved.recorded.last.as_ref());
        // Reports unreadable records before the run continues.
        for stored in self.log.read().map_err(|damage| damage.of(&path))? {
            stored.map_err(|damage| damage.of(&path))?;
        }
        Ok(saved)
    }

    /// Returns true if the last attempt to write a checkpoint failed.
    pub fn last_failed(&self) -> bool {
        self.last_failed
    }

    fn write(
        &mut self,
        position: &RunPosition,
        recorded: &RecordSummary,
        wall_s: f64,
    ) -> Result<(), CheckpointError> {
        let log = self.path.with_file_name(RECORDS);
        let synced = self.log.sync(recorded.count());
        let records = synced.map_err(|error| Damage::from(error).of(&log))?;
        let bytes = self.identity.encode(&Contents {
            wall_s,
            records,
            position: Cow::Borrowed(position),
            carried: Cow::Borrowed(&recorded.carried),
            last: recorded.last.as_ref().map(|last| Stored::new(last, true)),
        });
        let replaced = replace_durably(&self.path, |out| out.write_all(&bytes));
        replaced.map_err(|error| Damage::from(error).of(&self.path))
    }
}

impl Sink for Checkpoints {
    fn record(&mut self, record: &Record) {
        self.log.push(record);
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
        match outcome {
            Ok(()) => self.written += 1,
            Err(error) => (self.warn)(&error),
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

    fn rows(&self) -> RowIter<'_> {
        self.log.rows()
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

    /// Returns the status of a finished run of this plan; `None` without results.
    ///
    /// # Errors
    /// The results belong to another scene.
    pub fn ending(&self, plan: &Plan<'_>) -> Result<Option<Status>, CheckpointError> {
        let read = |name| fs::read_to_string(self.path.join(name)).ok();
        let (Some(summary), Some(scene)) = (read(SUMMARY), read(SCENE)) else {
            return Ok(None);
        };
        let Ok(summary) = serde_json::from_str::<Summary>(&summary) else {
            return Ok(None);
        };
        if summary.status == Status::Interrupted {
            return Ok(None);
        }
        let path = self.path.join(SCENE);
        same_scene(&scene, &plan.scene().to_ron()).map_err(|damage| damage.of(&path))?;
        Ok(Some(summary.status))
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

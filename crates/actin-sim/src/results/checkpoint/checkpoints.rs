//! Checkpoints of a run in its directory: when they are written, and what is left at the end.

use super::file::{Contents, Identity, same_scene};
use super::log::{RecordLog, Tally};
use super::stored::Stored;
use super::{CheckpointError, Damage};
use crate::results::atomic::replace_durably;
use crate::results::directory::RunDirectory;
use crate::results::manifest::remove_if_there;
use crate::results::names::{CHECKPOINT, RECORDS, SCENE, SUMMARY};
use crate::results::{RunDirectoryError, Summary};
use crate::run::{
    Plan, Record, RecordIter, Recorded, Records, RowIter, RunPosition, Saved, Sink, Status,
};
use std::borrow::Cow;
use std::fs;
use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// The sink of a run directory: writes records to the disk as they are taken, and checkpoints at an interval
/// of time and when the run is interrupted or ends. It holds no more than a buffer of records in memory.
///
/// A checkpoint that cannot be written leaves the one before as it was and is tried again after the
/// interval.
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
    /// The sink in `directory` of a plan, with a checkpoint every `every`. The run is interrupted as soon
    /// as `interrupted` is set; `warn` is told of checkpoints that cannot be written.
    pub fn new(
        directory: &RunDirectory,
        plan: &Plan<'_>,
        every: Duration,
        interrupted: Arc<AtomicBool>,
        warn: fn(&CheckpointError),
    ) -> Self {
        let identity = Identity::of(plan);
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

    /// Reads what the directory keeps of the run of this plan, from where
    /// [`resume_into`](Plan::resume_into) goes on.
    ///
    /// # Errors
    /// If there is no checkpoint, or one that is damaged, of another scene or of another program.
    pub fn resume(&mut self, plan: &Plan<'_>) -> Result<Saved, CheckpointError> {
        let damaged = |damage: Damage| damage.of(&self.path);
        let contents = self.identity.read(&self.path).map_err(damaged)?;
        let (records, form) = (contents.records, &self.identity.form);
        let none = Recorded::new(plan.assembly());
        let saved = contents.saved(&none, form).map_err(damaged)?;
        let path = self.path.with_file_name(RECORDS);
        self.log = RecordLog::new(path.clone(), records, form, saved.recorded.last.as_ref());
        // What cannot be read is found now and not when the run has ended.
        for stored in self.log.read().map_err(|damage| damage.of(&path))? {
            stored.map_err(|damage| damage.of(&path))?;
        }
        Ok(saved)
    }

    /// Checkpoints written so far.
    pub fn written(&self) -> u64 {
        self.written
    }

    /// Whether the last attempt to write a checkpoint failed.
    pub fn last_failed(&self) -> bool {
        self.last_failed
    }

    fn write(
        &mut self,
        position: &RunPosition,
        recorded: &Recorded,
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

    fn checkpoint(&mut self, position: &RunPosition, recorded: &Recorded, wall_s: f64) {
        let outcome = self.write(position, recorded, wall_s);
        self.last_failed = outcome.is_err();
        match outcome {
            Ok(()) => self.written += 1,
            Err(error) => (self.warn)(&error),
        }
        self.last = Instant::now();
    }
}

/// All records taken so far, those before the run was resumed included.
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
    /// The directory of a run that is to be resumed; nothing in it is touched.
    pub fn existing(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into() }
    }

    /// Whether the directory keeps a checkpoint.
    pub fn has_checkpoint(&self) -> bool {
        self.path.join(CHECKPOINT).exists()
    }

    /// How the run of this plan ended whose results are in the directory, if it has ended.
    ///
    /// # Errors
    /// If they are those of another scene.
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

    /// Removes the checkpoint of a run whose results have been [written](RunDirectory::write), and so
    /// are on the disk.
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

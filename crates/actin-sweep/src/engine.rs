//! All runs of a sweep, on any number of threads.

use crate::run::{State, make, summary};
use crate::table::{Row, Table};
use crate::{Opened, SweepDirectory, SweepError};
use actin_sim::{CheckpointError, RunDirectory};
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// How the runs of a sweep are made.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Runs that are made at the same time, each on one thread; as many as there are cores by default.
    pub jobs: Option<NonZeroUsize>,
    /// Time between checkpoints of a run.
    pub checkpoint_every: Duration,
    /// Set, it ends all runs as soon as they can, with checkpoints.
    pub interrupted: Arc<AtomicBool>,
    /// Told of checkpoints that could not be written or read; the runs go on.
    pub warn: fn(&CheckpointError),
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            jobs: None,
            checkpoint_every: Duration::from_mins(1),
            interrupted: Arc::default(),
            warn: |_| (),
        }
    }
}

/// How far a sweep has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Runs that have ended, those of before included.
    pub ended: usize,
    /// Runs that had ended before.
    pub before: usize,
    /// Runs that are to be made.
    pub of: usize,
}

/// How a sweep ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ended {
    /// Runs that have ended.
    pub ended: usize,
    /// Runs among them that failed or lack a result.
    pub failed: usize,
    /// Runs that were to be made.
    pub of: usize,
}

impl Ended {
    /// Whether runs are left.
    pub fn is_interrupted(&self) -> bool {
        self.ended < self.of
    }
}

impl SweepDirectory {
    /// Makes all runs that have not ended, and writes `runs.csv` and `table.csv`. If it is interrupted, runs that have
    /// not ended are `unfinished` there.
    ///
    /// The tables of all runs are the same, to the byte, on any number of threads, and however often the sweep was
    /// interrupted or killed on the way.
    ///
    /// # Errors
    /// Another process that makes the runs of this directory, results that cannot be written; runs that have
    /// ended stay. A run that fails is no error.
    pub fn carry_out(
        &self,
        opened: &Opened,
        settings: &Settings,
        progress: &(dyn Fn(Progress) + Sync),
    ) -> Result<Ended, SweepError> {
        let _lock = self.lock()?;
        let all: Vec<usize> = (0..opened.design.len()).collect();
        let ended = self.make_runs(opened, &all, settings, progress)?;
        Table::new(opened, self).write(self)?;
        Ok(ended)
    }

    /// Makes the runs of these numbers that have not ended, and no table. Several processes may do so at the same
    /// time, each for others.
    ///
    /// # Errors
    /// As [`carry_out`](Self::carry_out), or a run that is not there.
    pub fn make_runs(
        &self,
        opened: &Opened,
        runs: &[usize],
        settings: &Settings,
        progress: &(dyn Fn(Progress) + Sync),
    ) -> Result<Ended, SweepError> {
        let count = opened.design.len();
        let mut runs = runs.to_vec();
        runs.sort_unstable();
        runs.dedup();
        if let Some(&run) = runs.iter().find(|&&run| run >= count) {
            return Err(SweepError::NoRun { run, runs: count });
        }
        let is_left = |run: &usize| summary(&self.run(*run)).is_none();
        let left: Vec<usize> = runs.iter().copied().filter(is_left).collect();
        self.remove_checkpoints(&runs, &left)?;
        let before = runs.len() - left.len();
        let of = runs.len();
        let report = |ended| progress(Progress { ended, before, of });
        report(before);
        let crew = Crew {
            opened,
            directory: self,
            left: &left,
            settings,
            next: AtomicUsize::new(0),
            error: Mutex::default(),
            ended: AtomicUsize::new(before),
        };
        let ended = crew.make_all(&report)?;
        let has_failed = |run: &&usize| {
            let results = &opened.sweep.results;
            let summary = summary(&self.run(**run));
            summary.is_some_and(|summary| !Row::of(&summary, results).failure.is_empty())
        };
        let failed = runs.iter().filter(has_failed).count();
        Ok(Ended { ended, failed, of })
    }
}

impl SweepDirectory {
    /// Removes what is left of checkpoints of runs that were killed when their results were on the disk.
    fn remove_checkpoints(&self, runs: &[usize], left: &[usize]) -> Result<(), SweepError> {
        // Both in the same order.
        let mut left = left.iter().peekable();
        for run in runs {
            if left.next_if_eq(&run).is_some() {
                continue;
            }
            let directory = RunDirectory::existing(self.run(*run));
            if directory.has_checkpoint() {
                directory.remove_checkpoint()?;
            }
        }
        Ok(())
    }
}

fn threads(settings: &Settings) -> usize {
    let cores = || std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
    settings.jobs.map_or_else(cores, NonZeroUsize::get)
}

/// What the threads of a sweep share.
struct Crew<'a> {
    opened: &'a Opened,
    directory: &'a SweepDirectory,
    left: &'a [usize],
    settings: &'a Settings,
    next: AtomicUsize,
    error: Mutex<Option<SweepError>>,
    ended: AtomicUsize,
}

impl Crew<'_> {
    /// Makes all runs that are left; returns how many have ended.
    fn make_all(self, report: &(impl Fn(usize) + Sync)) -> Result<usize, SweepError> {
        std::thread::scope(|scope| {
            for _ in 0..threads(self.settings).min(self.left.len()) {
                scope.spawn(|| self.work(report));
            }
        });
        let error = self.error.into_inner();
        match error.unwrap_or_else(PoisonError::into_inner) {
            None => Ok(self.ended.into_inner()),
            Some(error) => Err(error),
        }
    }

    /// Makes one run after the other until none is left, or all are to end.
    fn work(&self, report: &(impl Fn(usize) + Sync)) {
        let interrupted = &self.settings.interrupted;
        while !interrupted.load(Ordering::Relaxed) {
            let Some(&index) = self.left.get(self.next.fetch_add(1, Ordering::Relaxed)) else {
                return;
            };
            let run = self.opened.design.run(index);
            match make(self.opened, self.directory, run, self.settings) {
                Ok(State::Ended) => report(self.ended.fetch_add(1, Ordering::Relaxed) + 1),
                Ok(State::Interrupted) => {}
                Err(error) => {
                    let mut first = self.error.lock().unwrap_or_else(PoisonError::into_inner);
                    first.get_or_insert(error);
                    // The others keep what they have.
                    interrupted.store(true, Ordering::Relaxed);
                }
            }
        }
    }
}

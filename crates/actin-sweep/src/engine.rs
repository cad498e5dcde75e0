//! Parallel execution of the runs of a sweep.

use crate::run::{State, make};
use crate::settings::Settings;
use crate::summary::summary;
use crate::table::{Row, Table};
use crate::{SweepDirectory, SweepError, ValidatedSweep};
use actin_rundir::RunDirectory;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Progress of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Number of runs that have ended, including earlier executions.
    pub ended: usize,
    /// Number of runs that ended in earlier executions.
    pub before: usize,
    /// Number of requested runs.
    pub of: usize,
}

/// Outcome of an execution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SweepOutcome {
    /// Number of runs that have ended.
    pub ended: usize,
    /// Number of runs that failed or lack a result.
    pub failed: usize,
    /// Number of requested runs.
    pub of: usize,
}

impl SweepOutcome {
    /// Returns whether some runs have not ended.
    pub fn is_interrupted(&self) -> bool {
        self.ended < self.of
    }
}

impl SweepDirectory {
    /// Makes all runs that have not ended, and writes `runs.csv` and `table.csv`.
    ///
    /// After an interruption, the tables list the remaining runs as `unfinished`. The final tables are bitwise
    /// independent of the number of threads and of interruptions.
    ///
    /// # Errors
    /// If another process makes the runs of this directory, or results cannot be written. Failed runs are rows of the
    /// tables, not errors.
    pub fn run_all(
        &self,
        opened: &ValidatedSweep,
        settings: &Settings,
        progress: &(dyn Fn(Progress) + Sync),
    ) -> Result<SweepOutcome, SweepError> {
        let _lock = self.lock()?;
        let all: Vec<usize> = (0..opened.design.len()).collect();
        let ended = self.make_runs(opened, &all, settings, progress)?;
        Table::new(opened, self).write(self)?;
        Ok(ended)
    }

    /// Makes the given runs that have not ended, without tables. Several processes can make different runs
    /// concurrently.
    ///
    /// # Errors
    /// Errors of [`run_all`](Self::run_all), or an invalid index.
    pub fn make_runs(
        &self,
        opened: &ValidatedSweep,
        runs: &[usize],
        settings: &Settings,
        progress: &(dyn Fn(Progress) + Sync),
    ) -> Result<SweepOutcome, SweepError> {
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
        let crew = WorkerPool {
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
            summary.is_some_and(|summary| !Row::new(&summary, results).failure.is_empty())
        };
        let failed = runs.iter().filter(has_failed).count();
        Ok(SweepOutcome { ended, failed, of })
    }
}

impl SweepDirectory {
    fn remove_checkpoints(&self, runs: &[usize], left: &[usize]) -> Result<(), SweepError> {
        // `left` is a subsequence of `runs`.
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

struct WorkerPool<'a> {
    opened: &'a ValidatedSweep,
    directory: &'a SweepDirectory,
    left: &'a [usize],
    settings: &'a Settings,
    next: AtomicUsize,
    error: Mutex<Option<SweepError>>,
    ended: AtomicUsize,
}

impl WorkerPool<'_> {
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

    fn work(&self, report: &(impl Fn(usize) + Sync)) {
        let interrupted = &self.settings.interrupted;
        while !interrupted.load(Ordering::Relaxed) {
            let Some(&index) = self.left.get(self.next.fetch_add(1, Ordering::Relaxed)) else {
                return;
            };
            let run = self.opened.design.run(index);
            match make(self.opened, self.directory, run, self.settings) {
                Ok(State::Finished) => report(self.ended.fetch_add(1, Ordering::Relaxed) + 1),
                Ok(State::Interrupted) => {}
                Err(error) => {
                    let mut first = self.error.lock().unwrap_or_else(PoisonError::into_inner);
                    first.get_or_insert(error);
                    // Other runs stop with checkpoints.
                    interrupted.store(true, Ordering::Relaxed);
                }
            }
        }
    }
}

//! Worker threads that run replicas.

use super::sink::ReplicaStop;
use super::{Ensemble, EnsembleError};
use crate::RunError;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

pub(super) struct ReplicaPool<'a, F, T> {
    ensemble: &'a Ensemble<'a>,
    /// Runs a replica, unless stopped.
    make: &'a F,
    /// Next replica.
    next: AtomicUsize,
    /// First replica with an error. Later replicas are no longer needed; earlier ones may still
    /// fail.
    first_failed: AtomicUsize,
    made: Mutex<FinishedReplicas<T>>,
}

struct FinishedReplicas<T> {
    /// Observations of each replica.
    observed: Vec<Option<T>>,
    /// First error in the order of the replicas.
    error: Option<(usize, RunError)>,
}

impl<'a, F, T: Send> ReplicaPool<'a, F, T>
where
    F: Fn(usize, &ReplicaStop<'_>) -> Result<Option<T>, RunError> + Sync,
{
    pub(super) fn new(ensemble: &'a Ensemble<'a>, make: &'a F) -> Self {
        let count = ensemble.seeds.len();
        Self {
            ensemble,
            make,
            next: AtomicUsize::new(0),
            first_failed: AtomicUsize::new(usize::MAX),
            made: Mutex::new(FinishedReplicas {
                observed: (0..count).map(|_| None).collect(),
                error: None,
            }),
        }
    }

    pub(super) fn work_all(self) -> Result<Vec<T>, EnsembleError> {
        std::thread::scope(|scope| {
            for _ in 1..self.threads() {
                scope.spawn(|| self.work());
            }
            self.work();
        });
        let made = self.made.into_inner();
        let made = made.unwrap_or_else(PoisonError::into_inner);
        if let Some((index, error)) = made.error {
            let seed = self.ensemble.seeds[index];
            return Err(EnsembleError::Replica { index, seed, error });
        }
        let all: Option<Vec<T>> = made.observed.into_iter().collect();
        Ok(all.expect("only replicas after a failed one are stopped"))
    }

    /// Number of threads: the requested number or the number of cores, at most the number of
    /// replicas.
    fn threads(&self) -> usize {
        let cores = || std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
        let wanted = self.ensemble.threads.map_or_else(cores, NonZeroUsize::get);
        wanted.min(self.ensemble.seeds.len())
    }

    fn work(&self) {
        loop {
            let index = self.next.fetch_add(1, Ordering::Relaxed);
            let stop = ReplicaStop {
                index,
                first_failed: &self.first_failed,
            };
            if index >= self.ensemble.seeds.len() || stop.is_set() {
                return;
            }
            match (self.make)(index, &stop) {
                Ok(None) => {}
                Ok(Some(observed)) => self.keep(index, observed),
                Err(error) => self.fail(index, error),
            }
        }
    }

    fn keep(&self, index: usize, observed: T) {
        self.made().observed[index] = Some(observed);
    }

    fn fail(&self, index: usize, error: RunError) {
        let mut made = self.made();
        if index < self.first_failed.fetch_min(index, Ordering::Relaxed) {
            made.error = Some((index, error));
        }
    }

    fn made(&self) -> MutexGuard<'_, FinishedReplicas<T>> {
        self.made.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

//! Calls on several threads, up to the first error.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Calls `make` with every index below `count` and returns the results in the order of the indices.
///
/// `make` also receives a query that returns `true` after the failure of a call with a smaller
/// index. Only then it may return `None`.
///
/// # Errors
/// The smallest index with an error, and this error.
pub(super) fn on_threads<T: Send, E: Send>(
    threads: usize,
    count: usize,
    make: impl Fn(usize, &dyn Fn() -> bool) -> Result<Option<T>, E> + Sync,
) -> Result<Vec<T>, (usize, E)> {
    let next = AtomicUsize::new(0);
    let first_failed = AtomicUsize::new(usize::MAX);
    let made = Mutex::new(BTreeMap::new());
    let work = || loop {
        let index = next.fetch_add(1, Ordering::Relaxed);
        let is_stopped = || first_failed.load(Ordering::Relaxed) < index;
        if index >= count || is_stopped() {
            return;
        }
        let result = make(index, &is_stopped);
        if result.is_err() {
            first_failed.fetch_min(index, Ordering::Relaxed);
        }
        let mut made = made.lock().unwrap_or_else(PoisonError::into_inner);
        made.insert(index, result);
    };
    std::thread::scope(|scope| {
        for _ in 1..threads {
            scope.spawn(work);
        }
        work();
    });
    let made = made.into_inner().unwrap_or_else(PoisonError::into_inner);
    let results = made.into_iter().map(|(index, result)| {
        let observed = result.map_err(|error| (index, error));
        observed.transpose()
    });
    results.flatten().collect()
}

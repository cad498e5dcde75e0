//! Work on uncoupled ranges of unknowns, on all threads of the current pool of `rayon`.
//!
//! Ranges do not depend on the number of threads, and results are returned in their order. Sums are
//! therefore equal to the bit for any number of threads.

use rayon::prelude::*;
use std::ops::Range;

/// Smallest number of unknowns of a task. Shorter tasks take less time than their distribution.
pub(crate) const TASK: usize = 1500;

/// Results of `work` for all items, in order. Work on few `unknowns` in total is done on this thread.
pub fn map<T: Send, R: Send>(
    items: Vec<T>,
    unknowns: usize,
    work: impl Fn(T) -> R + Sync + Send,
) -> Vec<R> {
    if items.len() < 2 || unknowns < 2 * TASK || rayon::current_num_threads() < 2 {
        return items.into_iter().map(work).collect();
    }
    items.into_par_iter().map(work).collect()
}

/// Does `work` on a thread of the pool, which shares later parallel work without delay.
pub fn enter<R: Send>(work: impl FnOnce() -> R + Send) -> R {
    if rayon::current_num_threads() < 2 || rayon::current_thread_index().is_some() {
        return work();
    }
    rayon::join(work, || ()).0
}

/// Result of `work` on this thread alone, for callers that use all cores already.
pub fn on_one_thread<R>(work: impl FnOnce() -> R) -> R {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1);
    // Fails within a pool, which limits the number of threads itself.
    let pool = pool.use_current_thread().build();
    let result = work();
    drop(pool);
    result
}

/// Slices of `all` at disjoint ascending ranges.
pub(crate) fn slices<'a, T>(
    all: &'a mut [T],
    ranges: impl Iterator<Item = Range<usize>>,
) -> impl Iterator<Item = &'a mut [T]> {
    let (mut rest, mut start) = (all, 0);
    ranges.map(move |range| {
        let (_, later) = std::mem::take(&mut rest).split_at_mut(range.start - start);
        let (own, later) = later.split_at_mut(range.len());
        (rest, start) = (later, range.end);
        own
    })
}

/// Ranges of unknowns within one task, ascending.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Task(Vec<Range<usize>>);

impl Task {
    /// Distributes `ranges` to tasks that begin at `starts` (ascending). No range is coupled to
    /// unknowns beyond a start.
    pub(crate) fn divide(ranges: &[Range<usize>], starts: &[usize]) -> Vec<Self> {
        let mut tasks: Vec<Self> = Vec::new();
        let mut last = usize::MAX;
        for range in ranges {
            let mut start = range.start;
            while start < range.end {
                let task = starts.partition_point(|&first| first <= start);
                let end = starts
                    .get(task)
                    .map_or(range.end, |&next| next.min(range.end));
                if task != last {
                    tasks.push(Self(Vec::new()));
                    last = task;
                }
                let own = tasks.last_mut().expect("a task was pushed");
                own.0.push(start..end);
                start = end;
            }
        }
        tasks
    }

    pub(crate) fn ranges(&self) -> &[Range<usize>] {
        &self.0
    }

    /// Number of unknowns of tasks.
    pub(crate) fn unknowns(tasks: &[Self]) -> usize {
        let ranges = tasks.iter().flat_map(Self::ranges);
        ranges.map(Range::len).sum()
    }

    /// Range from the first to the last unknown.
    pub(crate) fn hull(&self) -> Range<usize> {
        let ends = self.0.first().zip(self.0.last());
        ends.map_or(0..0, |(first, last)| first.start..last.end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_divided_at_starts() {
        let tasks = Task::divide(&[1..4, 5..7, 9..12], &[0, 3, 10]);
        let ranges: Vec<_> = tasks.iter().map(|task| task.ranges().to_vec()).collect();
        assert_eq!(ranges, [vec![1..3], vec![3..4, 5..7, 9..10], vec![10..12]]);
        let mut all: Vec<usize> = (0..12).collect();
        let own = slices(&mut all, tasks.iter().map(Task::hull));
        let first_and_last = own.map(|own| [own[0], own[own.len() - 1]]);
        assert_eq!(Vec::from_iter(first_and_last), [[1, 2], [3, 9], [10, 11]]);
    }
}

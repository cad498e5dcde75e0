//! Design of a sweep: its points and runs.

use crate::random::{self, between};
use crate::sweep::{Axis, Samples, Sweep};
use actin_sim::Override;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Points and seeds of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// Varied keys.
    pub keys: Vec<String>,
    /// Values of the keys at each point, in RON.
    pub points: Vec<Vec<String>>,
    /// Seeds of the runs of each point; empty for one run with the seeds of the scene.
    pub seeds: Vec<u64>,
}

/// A run of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Run {
    /// Index of the run, from 0.
    pub index: usize,
    /// Index of the point, from 0.
    pub point: usize,
    /// Seed of the run; `None` for the seeds of the scene.
    pub seed: Option<u64>,
}

impl Design {
    pub(crate) fn new(sweep: &Sweep) -> Self {
        let mut points = vec![Vec::new()];
        for axis in &sweep.vary {
            let rows = axis.rows();
            let combined = points
                .iter()
                .flat_map(|point| rows.iter().map(move |row| [&point[..], row].concat()));
            points = combined.collect();
        }
        let seeds = sweep.samples.as_ref().map_or_else(Vec::new, Samples::seeds);
        Self {
            keys: sweep
                .vary
                .iter()
                .flat_map(Axis::keys)
                .map(str::to_owned)
                .collect(),
            points,
            seeds,
        }
    }

    /// Returns the number of runs of each point.
    pub fn runs_of_point(&self) -> usize {
        self.seeds.len().max(1)
    }

    /// Returns the number of runs.
    pub fn len(&self) -> usize {
        self.points.len() * self.runs_of_point()
    }

    /// Returns whether there are no runs. A valid sweep has at least one.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns a run by its index.
    pub(crate) fn run(&self, index: usize) -> Run {
        let of_point = self.runs_of_point();
        Run {
            index,
            point: index / of_point,
            seed: self.seeds.get(index % of_point).copied(),
        }
    }

    /// Selects at most `most` points, in order. The points are divided into `most` equal parts and one of each is
    /// drawn; the first and the last point are included. The selection is deterministic.
    pub(crate) fn sample_points(&self, most: usize) -> Vec<usize> {
        let count = self.points.len();
        if count <= most {
            return (0..count).collect();
        }
        let mut random = ChaCha8Rng::seed_from_u64(0);
        let part = |k: usize| k * count / most;
        let mut drawn: Vec<usize> = (0..most)
            .map(|k| random.random_range(part(k)..part(k + 1)))
            .collect();
        drawn[0] = 0;
        drawn[most - 1] = count - 1;
        drawn
    }

    /// Returns the overrides of a point.
    pub(crate) fn overrides(&self, point: usize) -> impl Iterator<Item = Override> {
        let pairs = self.keys.iter().zip(&self.points[point]);
        pairs.map(|(key, value)| Override {
            key: key.clone(),
            value: value.clone(),
        })
    }
}

impl Samples {
    fn seeds(&self) -> Vec<u64> {
        (0..self.number as u64)
            .map(|sample| self.first_seed.wrapping_add(sample))
            .collect()
    }
}

impl Axis {
    pub(crate) fn keys(&self) -> Vec<&str> {
        match self {
            Self::List { key, .. } | Self::Grid { key, .. } => vec![key],
            Self::Rows { keys, .. } => keys.iter().map(String::as_str).collect(),
            Self::Random { over, .. } => over.iter().map(|span| span.key.as_str()).collect(),
        }
    }

    pub(crate) fn len(&self) -> usize {
        match self {
            Self::List { values, .. } => values.len(),
            Self::Grid { number, .. } | Self::Random { number, .. } => *number,
            Self::Rows { rows, .. } => rows.len(),
        }
    }

    pub(crate) fn rows(&self) -> Vec<Vec<String>> {
        match self {
            Self::List { values, .. } => values.iter().map(|v| vec![v.0.clone()]).collect(),
            Self::Rows { rows, .. } => rows
                .iter()
                .map(|row| row.iter().map(|value| value.0.clone()).collect())
                .collect(),
            Self::Grid {
                from,
                to,
                number,
                scale,
                ..
            } => {
                let share = |i: usize| i as f64 / (number - 1) as f64;
                let number = |i| between((*from, *to), *scale, share(i));
                let all = 0..self.len();
                all.map(|i| vec![format!("{:?}", number(i))]).collect()
            }
            Self::Random {
                number,
                seed,
                plan,
                over,
            } => random::points(*number, *seed, *plan, over),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_of_many_points_are_drawn() {
        let design = |count: usize| Design {
            keys: Vec::new(),
            points: vec![Vec::new(); count],
            seeds: Vec::new(),
        };
        assert_eq!(design(3).sample_points(3), [0, 1, 2]);
        let drawn = design(1_000_000).sample_points(1000);
        assert_eq!((drawn.len(), drawn[0], drawn[999]), (1000, 0, 999_999));
        assert!((0..1000).all(|k| drawn[k] / 1000 == k));
        // Not every thousandth point, which would have the same value on the last axis of a grid.
        let last: std::collections::BTreeSet<_> = drawn.iter().map(|k| k % 1000).collect();
        assert!(last.len() > 500, "{}", last.len());
    }
}

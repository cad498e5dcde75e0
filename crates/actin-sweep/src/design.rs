//! The design of a sweep: all its runs, in order.

use crate::random::{self, between};
use crate::sweep::{Axis, Samples, Sweep};
use actin_sim::Override;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// All points of a sweep, and the seeds with which each is run.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// Keys that are varied, in order.
    pub keys: Vec<String>,
    /// Their values, point by point, as a scene writes them.
    pub points: Vec<Vec<String>>,
    /// Seeds of the runs of a point; one run with those of the scene if there is none.
    pub seeds: Vec<u64>,
}

/// One run of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Run {
    /// Its number, from 0.
    pub index: usize,
    /// Its point, from 0.
    pub point: usize,
    /// What seeds are set to; none where the scene's own are kept.
    pub seed: Option<u64>,
}

impl Design {
    /// That of a sweep whose rules hold.
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

    /// Number of runs of each point.
    pub fn runs_of_point(&self) -> usize {
        self.seeds.len().max(1)
    }

    /// Number of all runs.
    pub fn len(&self) -> usize {
        self.points.len() * self.runs_of_point()
    }

    /// Whether there is no run, which cannot be.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// A run by its number.
    pub fn run(&self, index: usize) -> Run {
        let of_point = self.runs_of_point();
        Run {
            index,
            point: index / of_point,
            seed: self.seeds.get(index % of_point).copied(),
        }
    }

    /// At most `most` points, in order: all, or one drawn from each of `most` equal parts, the first and the last
    /// point among them. The same design gives the same points.
    pub(crate) fn drawn(&self, most: usize) -> Vec<usize> {
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

    /// What a point sets.
    pub fn overrides(&self, point: usize) -> impl Iterator<Item = Override> {
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
    /// The keys that it varies.
    pub(crate) fn keys(&self) -> Vec<&str> {
        match self {
            Self::List { key, .. } | Self::Grid { key, .. } => vec![key],
            Self::Rows { keys, .. } => keys.iter().map(String::as_str).collect(),
            Self::Random { over, .. } => over.iter().map(|span| span.key.as_str()).collect(),
        }
    }

    /// How many values it has for each of them.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::List { values, .. } => values.len(),
            Self::Grid { number, .. } | Self::Random { number, .. } => *number,
            Self::Rows { rows, .. } => rows.len(),
        }
    }

    /// Values of its keys, point by point.
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

    /// A million points cost as many builds as a thousand: the first, the last, one of each part.
    #[test]
    fn of_many_points_few_are_drawn() {
        let design = |count: usize| Design {
            keys: Vec::new(),
            points: vec![Vec::new(); count],
            seeds: Vec::new(),
        };
        assert_eq!(design(3).drawn(3), [0, 1, 2]);
        let drawn = design(1_000_000).drawn(1000);
        assert_eq!((drawn.len(), drawn[0], drawn[999]), (1000, 0, 999_999));
        assert!((0..1000).all(|k| drawn[k] / 1000 == k));
        // Not every thousandth: a grid whose last axis has a thousand values shows more than one of them.
        let last: std::collections::BTreeSet<_> = drawn.iter().map(|k| k % 1000).collect();
        assert!(last.len() > 500, "{}", last.len());
    }
}

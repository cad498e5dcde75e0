//! Values of a scene from one run or, in heat, means over seeds with standard errors.

use super::measure::{Measurer, Values};
use super::run::{Limits, RunResult, TrialFailure, run, run_once};
use crate::Counts;
use crate::scene::{RandomPart, Scene};

pub(super) const SEEDS: u64 = 4;

pub(super) struct Sample {
    /// Time of one run (s); in heat the mean over seeds.
    pub wall_s: f64,
    pub values: Values,
    /// Standard error of each item, in its unit; zero without heat.
    pub standard_errors: Vec<f64>,
    /// Result of the last run.
    pub last_run: RunResult,
}

impl Sample {
    /// Runs a scene once or, in heat, with [`SEEDS`] seeds.
    pub(super) fn new(
        scene: &Scene,
        measurer: &Measurer,
        limits: Limits<'_>,
    ) -> Result<Self, TrialFailure> {
        if scene.thermal().is_none() {
            let last_run = run(scene, limits)?;
            let values = measurer.values(&last_run.assembly, &last_run.records);
            return Ok(Self::from_runs(last_run.wall_s, &[values], last_run));
        }
        let mut all = Vec::new();
        let mut wall_s = 0.0;
        let mut seed = 1;
        loop {
            let mut seeded = scene.clone();
            for drawn in RandomPart::ALL {
                seeded.reseed(drawn, seed);
            }
            let last_run = run_once(&seeded, limits)?;
            wall_s += last_run.wall_s / SEEDS as f64;
            all.push(measurer.values(&last_run.assembly, &last_run.records));
            if last_run.is_cut || seed == SEEDS {
                return Ok(Self::from_runs(wall_s, &all, last_run));
            }
            seed += 1;
        }
    }

    fn from_runs(wall_s: f64, all: &[Values], last_run: RunResult) -> Self {
        let (values, standard_errors) = mean(all);
        Self {
            wall_s,
            values,
            standard_errors,
            last_run,
        }
    }

    pub(super) fn counts(&self) -> Counts {
        self.last_run.assembly.counts()
    }
}

/// Returns the means over runs and the standard error of each item.
///
/// The standard error of a vector is the root of the sum of `variance / number of runs` over its components.
fn mean(runs: &[Values]) -> (Values, Vec<f64>) {
    let count = runs.len() as f64;
    let items = 0..runs[0].len();
    let of_item = |item: usize| {
        let mut mean = runs[0][item].clone();
        for (k, record) in mean.iter_mut().enumerate() {
            for (j, number) in record.iter_mut().enumerate() {
                *number = runs.iter().map(|run| run[item][k][j]).sum::<f64>() / count;
            }
        }
        let squares = runs.iter().flat_map(|run| run[item].iter().zip(&mean));
        let squares = squares.flat_map(|(one, mean)| one.iter().zip(mean));
        let sum: f64 = squares.map(|(x, mean)| (x - mean).powi(2)).sum();
        (mean, (sum / (count * (count - 1.0).max(1.0))).sqrt())
    };
    items.map(of_item).unzip()
}

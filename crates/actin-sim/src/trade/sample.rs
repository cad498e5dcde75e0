//! What is read off a scene that has run: the values of one run or, in heat, means over seeds with their errors.

use super::measure::{Measurer, Values};
use super::run::{Limits, Ran, Unusable, run, run_once};
use crate::Counts;
use crate::scene::{Drawn, Scene};

/// Runs of a scene in heat, each with other seeds.
pub(super) const SEEDS: u64 = 4;

/// Values of a scene.
pub(super) struct Sample {
    pub counts: Counts,
    /// Time of one run (s).
    pub wall_s: f64,
    /// Whether it was broken off at its budget.
    pub is_cut: bool,
    pub values: Values,
    /// Standard error of each item, in its unit; zero without heat.
    pub standard_errors: Vec<f64>,
    /// The run, of several the last.
    pub ran: Ran,
}

impl Sample {
    /// Runs a scene once or, in heat, with several seeds.
    pub(super) fn of(
        scene: &Scene,
        measurer: &Measurer,
        limits: Limits<'_>,
    ) -> Result<Self, Unusable> {
        if scene.thermal().is_some() {
            return Self::in_heat(scene, measurer, limits);
        }
        let ran = run(scene, limits)?;
        Ok(Self {
            counts: ran.counts,
            wall_s: ran.wall_s,
            is_cut: ran.is_cut,
            values: measurer.values(&ran.assembly, &ran.records),
            standard_errors: vec![0.0; measurer.items.len()],
            ran,
        })
    }

    fn in_heat(scene: &Scene, measurer: &Measurer, limits: Limits<'_>) -> Result<Self, Unusable> {
        let mut all = Vec::new();
        let mut wall_s = 0.0;
        let mut last = None;
        for seed in 1..=SEEDS {
            let mut seeded = scene.clone();
            for drawn in Drawn::ALL {
                seeded.reseed(drawn, seed);
            }
            let ran = run_once(&seeded, limits)?;
            wall_s += ran.wall_s / SEEDS as f64;
            all.push(measurer.values(&ran.assembly, &ran.records));
            let is_cut = ran.is_cut;
            last = Some(ran);
            if is_cut {
                break;
            }
        }
        let ran = last.expect("there is a seed");
        let (values, standard_errors) = mean(&all);
        Ok(Self {
            counts: ran.counts,
            wall_s,
            is_cut: ran.is_cut,
            values,
            standard_errors,
            ran,
        })
    }
}

/// Means over runs, and the standard error of each item: the root of the sum over its components of variance over
/// number.
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

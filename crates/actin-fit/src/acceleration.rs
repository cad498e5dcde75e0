//! The acceleration of a step: what the curvature of a model adds to its straight way.

use crate::problem::Linearisation;
use crate::step::{Damped, Step};
use faer::Mat;

/// Part of the step at which the residuals are probed.
const PART: f64 = 0.1;
/// Largest acceleration: twice its length over that of the step.
const LARGEST: f64 = 0.75;

/// Residuals before a step and after a part of it: they tell the second derivative along it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Probe<'a> {
    pub(crate) before: &'a [f64],
    pub(crate) after: &'a [f64],
    pub(crate) derivatives: &'a Mat<f64>,
}

impl Probe<'_> {
    /// The part of a step after which residuals are wanted.
    pub(crate) fn of(step: &[f64]) -> Vec<f64> {
        step.iter().map(|s| PART * s).collect()
    }

    /// Minus the second derivative of the model along the step, over deviations.
    fn second(&self, step: &[f64]) -> Vec<f64> {
        let rows = self.before.iter().zip(self.after).enumerate();
        rows.map(|(i, (before, after))| {
            let slopes = step.iter().enumerate();
            let slope: f64 = slopes.map(|(j, s)| self.derivatives[(i, j)] * s).sum();
            2.0 / PART * ((after - before) / PART + slope)
        })
        .collect()
    }
}

/// The step and half its acceleration, for the parameters that the step does not take to a bound.
/// `None` where the acceleration is too large for the length of the step, or not finite.
///
/// # Source
/// Transtrum and Sethna, arXiv 1201.5885.
pub(crate) fn accelerated(
    damped: &Damped<'_>,
    probe: &Probe<'_>,
    damping: f64,
    step: &Step,
) -> Option<Vec<f64>> {
    let second = probe.second(&step.values);
    let linear = Linearisation::new(probe.derivatives.as_ref(), &second)?;
    let problem = Damped {
        linear: &linear,
        ..*damped
    };
    let mut acceleration = vec![0.0; step.values.len()];
    let solved = problem.solve(damping, &step.inside, &acceleration);
    for (&j, a) in step.inside.iter().zip(solved) {
        acceleration[j] = a;
    }
    let length = damped.length(&step.values);
    let is_small = 2.0 * damped.length(&acceleration) <= LARGEST * length;
    let curved = step
        .values
        .iter()
        .zip(&acceleration)
        .map(|(s, a)| s + 0.5 * a);
    is_small.then(|| curved.collect())
}

use crate::problem::Linearisation;
use crate::step::{Damped, Step};
use faer::Mat;

/// Fraction of the step at which the residuals are evaluated.
const PART: f64 = 0.1;
/// Largest accepted acceleration: twice its length over the length of the step.
const LARGEST: f64 = 0.75;

/// Residuals before a step and after a fraction of it, for the second derivative along the step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Probe<'a> {
    pub(crate) before: &'a [f64],
    pub(crate) after: &'a [f64],
    pub(crate) derivatives: &'a Mat<f64>,
}

impl Probe<'_> {
    pub(crate) fn of(step: &[f64]) -> Vec<f64> {
        step.iter().map(|s| PART * s).collect()
    }

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

/// Adds half the acceleration to a step, for the parameters that stay within their bounds. Returns
/// `None` if the acceleration is not finite or too large relative to the step.
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

//! The bend of a step: what the curvature of a model adds to its straight way.

use crate::problem::Linearisation;
use crate::step::{Damped, Step};
use faer::Mat;

/// Part of the step at which the residuals are probed.
const PROBE: f64 = 0.1;
/// Largest bend, twice its length over that of the step.
const LARGEST_BEND: f64 = 0.75;

/// Residuals before a step and after a part of it: they tell the second derivative along it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Curving<'a> {
    pub(crate) before: &'a [f64],
    pub(crate) after: &'a [f64],
    pub(crate) derivatives: &'a Mat<f64>,
}

impl Curving<'_> {
    /// The part of a step after which the residuals are wanted.
    pub(crate) fn probe(step: &[f64]) -> Vec<f64> {
        step.iter().map(|s| PROBE * s).collect()
    }

    /// Minus the second derivative of the model along the step, over deviations.
    fn second(&self, step: &[f64]) -> Vec<f64> {
        let rows = self.before.iter().zip(self.after).enumerate();
        rows.map(|(i, (before, after))| {
            let slopes = step.iter().enumerate();
            let slope: f64 = slopes.map(|(j, s)| self.derivatives[(i, j)] * s).sum();
            2.0 / PROBE * ((after - before) / PROBE + slope)
        })
        .collect()
    }
}

/// The step and half its acceleration, for the parameters that the step does not take to a bound.
/// `None` where the acceleration is too large for the step's length or not finite.
///
/// # Source
/// Transtrum and Sethna, arXiv 1201.5885.
pub(crate) fn acceleration(
    damped: &Damped<'_>,
    curving: &Curving<'_>,
    damping: f64,
    step: &Step,
) -> Option<Vec<f64>> {
    let second = curving.second(&step.values);
    let linear = Linearisation::new(curving.derivatives.as_ref(), &second)?;
    let straight = vec![0.0; step.values.len()];
    let problem = Damped {
        linear: &linear,
        ..*damped
    };
    let mut bend = straight.clone();
    for (&j, a) in step
        .inside
        .iter()
        .zip(problem.solve(damping, &step.inside, &straight))
    {
        bend[j] = a;
    }
    let is_small = 2.0 * damped.length(&bend) <= LARGEST_BEND * damped.length(&step.values);
    let bent = step.values.iter().zip(&bend).map(|(s, a)| s + 0.5 * a);
    is_small.then(|| bent.collect())
}

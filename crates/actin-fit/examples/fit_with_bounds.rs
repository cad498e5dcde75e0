//! Fit of the height and position of a step within bounds, with standard errors.

use actin_fit::{Bounds, Data, FitError, LevenbergMarquardt, Model, Observations, Starts};

/// A step from 0 to `p0` at `p1`, of width 1: `p0 (1 + tanh(x - p1)) / 2`.
struct Step;

impl Model for Step {
    fn parameters(&self) -> usize {
        2
    }
    fn value(&self, x: &[f64], p: &[f64]) -> f64 {
        0.5 * p[0] * (1.0 + (x[0] - p[1]).tanh())
    }
    fn gradient(&self, x: &[f64], p: &[f64], gradient: &mut [f64]) {
        let t = (x[0] - p[1]).tanh();
        gradient[0] = 0.5 * (1.0 + t);
        gradient[1] = -0.5 * p[0] * (1.0 - t * t);
    }
}

fn main() -> Result<(), FitError> {
    // A step of height 6 at x = 1 with alternating errors of 0.1.
    let x = [-1.0, 0.0, 0.5, 1.5, 2.0, 3.0];
    let noise = [0.1, -0.1, 0.1, -0.1, 0.1, -0.1];
    let y: Vec<f64> = (0..6)
        .map(|i| Step.value(&[x[i]], &[6.0, 1.0]) + noise[i])
        .collect();
    let data = Data::new(&x, Observations::new(&y)?.with_deviations(&[0.1; 6])?)?;

    // Bounds of both parameters, and eight random starts within them.
    let bounds = Bounds::new(&[(0.0, 20.0), (-1.0, 3.0)])?;
    let fit = LevenbergMarquardt::default().fit(&Step, &data, &bounds, &Starts::random(8, 1))?;
    for (j, (name, truth)) in [("height", 6.0), ("place", 1.0)].into_iter().enumerate() {
        let (found, error) = (fit.parameters[j], fit.precision.standard_error(j).unwrap());
        println!("{name}: {found:.3} +- {error:.3}; the data were made with {truth}");
        assert!((found - truth).abs() < 2.0 * error);
    }
    Ok(())
}

#![allow(dead_code, reason = "each test file uses its part of this")]

use actin_fit::{
    Bounds, ClosureModel, Data, Fit, FitError, LevenbergMarquardt, Model, Observations, Starts,
};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// `f(k) = b0 + (b1 - b0) (1 + tanh((k - c) / w)) / 2`; parameters `b0, b1, c, w`.
pub(crate) struct Sigmoid;

impl Model for Sigmoid {
    fn parameters(&self) -> usize {
        4
    }

    fn value(&self, x: &[f64], p: &[f64]) -> f64 {
        p[0] + (p[1] - p[0]) * 0.5 * (1.0 + ((x[0] - p[2]) / p[3]).tanh())
    }

    fn gradient(&self, x: &[f64], p: &[f64], gradient: &mut [f64]) {
        let u = (x[0] - p[2]) / p[3];
        let t = u.tanh();
        let slope = 0.5 * (p[1] - p[0]) * (1.0 - t * t) / p[3];
        gradient[0] = 0.5 * (1.0 - t);
        gradient[1] = 0.5 * (1.0 + t);
        gradient[2] = -slope;
        gradient[3] = -slope * u;
    }
}

pub(crate) struct Gauss(ChaCha8Rng);

impl Gauss {
    pub(crate) fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    fn uniform(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Box and Muller, Ann. Math. Stat. 29 (1958) 610.
    pub(crate) fn next(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }
}

pub(crate) fn places(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..count)
        .map(|i| from + (to - from) * i as f64 / (count - 1) as f64)
        .collect()
}

pub(crate) fn values(model: &dyn Model, x: &[f64], p: &[f64]) -> Vec<f64> {
    x.iter().map(|x| model.value(&[*x], p)).collect()
}

pub(crate) fn clean(model: &dyn Model, x: &[f64], p: &[f64]) -> Data {
    let observations = Observations::new(&values(model, x, p)).unwrap();
    Data::new(x, observations).unwrap()
}

/// `p0 exp(-p1 x)`, with `p0` in units of `unit`.
pub(crate) fn decay(unit: f64) -> impl Model {
    ClosureModel::new(
        2,
        move |x, p| unit * p[0] * (-p[1] * x[0]).exp(),
        move |x, p, gradient| {
            gradient[0] = unit * (-p[1] * x[0]).exp();
            gradient[1] = -x[0] * p[0] * gradient[0];
        },
    )
}

pub(crate) fn fit(
    model: &dyn Model,
    data: &Data,
    bounds: &Bounds,
    start: &[f64],
) -> Result<Fit, FitError> {
    LevenbergMarquardt::default().fit(model, data, bounds, &Starts::at(start))
}

pub(crate) fn refused<T>(result: Result<T, FitError>) -> String {
    result.err().expect("this must be refused").to_string()
}

pub(crate) fn digits(a: f64, b: f64) -> f64 {
    -((a - b).abs() / b.abs()).max(1e-16).log10()
}

pub(crate) fn least_digits(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter()
        .zip(b)
        .map(|(a, b)| digits(*a, *b))
        .fold(16.0, f64::min)
}

pub(crate) fn errors(fit: &Fit) -> Vec<f64> {
    (0..fit.parameters.len())
        .map(|j| fit.precision.standard_error(j).unwrap())
        .collect()
}

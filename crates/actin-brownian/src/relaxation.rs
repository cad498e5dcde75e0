use crate::Friction;
use actin_equilibrium::{ImplicitSolver, Layout, SolveError};
use actin_mechanics::{System, Xorshift};
use nalgebra::{DMatrix, SymmetricEigen};

/// Maximum number of subspace iterations.
const ITERATIONS: usize = 60;

/// Relative tolerance of the rates.
const CONVERGED: f64 = 1e-8;

/// Tolerance of zero rates, relative to the highest requested rate.
const ZERO: f64 = 1e-12;

/// Additional vectors of the subspace.
const BEYOND: usize = 8;

/// Shift of all rates (1/ns) that avoids singular matrices for zero-stiffness modes.
const SHIFT: f64 = 1e-9;

const SEED: u64 = 17;

/// Small displacements from a state: eigenvalues of `K v = rate Z v` with the stiffness `K` and the
/// friction `Z`.
#[derive(Debug)]
pub struct Relaxation {
    stiffness: ImplicitSolver,
    fluid: ImplicitSolver,
}

impl Relaxation {
    /// Linearises `system` at its present state for the unknowns of `layout`.
    ///
    /// # Errors
    /// If an interaction has no potential or no second derivatives.
    pub fn new(system: &System, layout: Layout, friction: &Friction) -> Result<Self, SolveError> {
        ImplicitSolver::check(system.interactions())?;
        let state = system.state();
        // Both matrices use the same order of unknowns.
        let mut stiffness = ImplicitSolver::new(layout);
        stiffness.factorize(state, system.interactions(), &friction.times(SHIFT));
        let mut fluid = ImplicitSolver::new(stiffness.layout().clone());
        fluid.factorize(state, &[], &friction.times(1.0));
        Ok(Self { stiffness, fluid })
    }

    /// The `count` lowest rates (1/ns) in ascending order. Zero-stiffness modes have rates of about
    /// 1e-13 times the highest one. Rates of unstable modes are negative.
    pub fn lowest_rates(&mut self, count: usize) -> Vec<f64> {
        lowest(&mut self.stiffness, &self.fluid, count)
    }

    /// Lower bound of the highest rate (1/ns), accurate to about 1 %.
    pub fn highest_rate(&mut self) -> f64 {
        highest(&self.stiffness, &mut self.fluid)
    }
}

fn lowest(stiffness: &mut ImplicitSolver, fluid: &ImplicitSolver, count: usize) -> Vec<f64> {
    let n = stiffness.unknowns();
    let size = (count + BEYOND).min(n);
    let mut noise = Xorshift::new(SEED);
    let mut vectors: Vec<Vec<f64>> = (0..size)
        .map(|_| (0..n).map(|_| noise.sample()).collect())
        .collect();
    let mut rates: Vec<f64> = Vec::new();
    for _ in 0..ITERATIONS {
        for v in &mut vectors {
            *v = fluid.times(v);
            stiffness.solve(v);
        }
        orthonormalise(&mut vectors, fluid);
        let images: Vec<Vec<f64>> = vectors.iter().map(|v| stiffness.times(v)).collect();
        let projected = DMatrix::from_fn(size, size, |i, j| dot(&vectors[i], &images[j]));
        let eigen = SymmetricEigen::new(projected);
        let combined = (0..size).map(|k| {
            let weights = eigen.eigenvectors.column(k);
            let mut sum = vec![0.0; n];
            for (v, weight) in vectors.iter().zip(weights.iter()) {
                add_scaled(&mut sum, v, *weight);
            }
            sum
        });
        vectors = combined.collect();
        let before = rates;
        rates = eigen.eigenvalues.iter().map(|rate| rate - SHIFT).collect();
        rates.sort_by(f64::total_cmp);
        rates.truncate(count);
        if has_converged(&before, &rates) {
            break;
        }
    }
    rates
}

fn has_converged(before: &[f64], now: &[f64]) -> bool {
    let zero = ZERO * now.last().map_or(0.0, |rate| rate.abs());
    let is_settled = |(a, b): (&f64, &f64)| (a - b).abs() <= zero.max(CONVERGED * b.abs());
    before.len() == now.len() && before.iter().zip(now).all(is_settled)
}

fn orthonormalise(vectors: &mut [Vec<f64>], fluid: &ImplicitSolver) {
    for k in 0..vectors.len() {
        let (before, rest) = vectors.split_at_mut(k);
        let own = &mut rest[0];
        for _ in 0..2 {
            let image = fluid.times(own);
            let shares: Vec<f64> = before.iter().map(|v| dot(v, &image)).collect();
            for (v, share) in before.iter().zip(shares) {
                add_scaled(own, v, -share);
            }
            let norm = dot(own, &fluid.times(own)).sqrt();
            scale(own, 1.0 / norm);
        }
    }
}

fn highest(stiffness: &ImplicitSolver, fluid: &mut ImplicitSolver) -> f64 {
    let mut noise = Xorshift::new(SEED);
    let mut v: Vec<f64> = (0..stiffness.unknowns()).map(|_| noise.sample()).collect();
    let mut rate = 0.0;
    for _ in 0..2 * ITERATIONS {
        let norm = dot(&v, &fluid.times(&v)).sqrt();
        scale(&mut v, 1.0 / norm);
        let image = stiffness.times(&v);
        rate = dot(&v, &image);
        v = image;
        fluid.solve(&mut v);
    }
    rate - SHIFT
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn add_scaled(a: &mut [f64], b: &[f64], factor: f64) {
    for (a, b) in a.iter_mut().zip(b) {
        *a += factor * b;
    }
}

fn scale(a: &mut [f64], factor: f64) {
    for a in a {
        *a *= factor;
    }
}

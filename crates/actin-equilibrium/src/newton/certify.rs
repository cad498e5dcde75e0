//! Number of negative eigenvalues of the stiffness at an equilibrium.
//!
//! Eigenvalues refer to `K v = lambda M v` with the metric `M`: 1 for displacements (nm) and `l^2`
//! for rotations (rad), `l` the turn length. Their signs follow from the pivots of `K + s M` and
//! `K - s M` by Sylvester's law of inertia, where the resolution `s` bounds the error of
//! factorisation and coordinates.
//!
//! This bound is pessimistic for long filaments. Eigenvalues within `[-s, s]` are therefore counted
//! repeatedly with coordinates and matrix changed randomly by a few roundings. The count is
//! accepted if it never changes and no pivot is exactly zero.

use crate::certificate::{Certificate, Stability};
use crate::direction::Solver;
use crate::evaluation::Evaluation;
use crate::factor::Inertia;
use crate::newton::Newton;
use crate::outcome::SolveError;
use actin_mechanics::{Interaction, State, Xorshift};

pub(crate) fn certify(
    solver: &mut Solver,
    state: &State,
    interactions: &[Box<dyn Interaction>],
) -> Certificate {
    let changes = change(solver, state, interactions, &mut Xorshift::new(0), 1.0);
    let uncertainty = largest_row_sum(solver, changes);
    let mut certificate = count(solver, uncertainty);
    if certificate.unresolved > 0 {
        resolve(solver, state, interactions, &mut certificate);
    }
    certificate
}

impl Newton {
    /// Lowest eigenvalue of the stiffness at `state` that is not neutral (pN/nm), with relative
    /// accuracy 1e-9. Returns `None` if all are neutral. The certificate counts the neutral ones.
    ///
    /// # Errors
    /// If an interaction has no potential or no second derivatives.
    pub fn lowest_eigenvalue(
        &mut self,
        state: &State,
        interactions: &[Box<dyn Interaction>],
        certificate: &Certificate,
    ) -> Result<Option<f64>, SolveError> {
        let neutral = match certificate.stability() {
            Stability::Neutral { modes } => modes,
            Stability::Stable | Stability::Saddle { .. } => {
                let mode = self.lowest_mode(state, interactions)?;
                return Ok(mode.map(|mode| mode.eigenvalue));
            }
        };
        self.solver.prepare(state, interactions)?;
        Ok(first_above(
            &mut self.solver,
            neutral,
            certificate.resolution,
        ))
    }
}

/// Lowest eigenvalue above the `count` lowest ones, which are below `least`, by bisection.
fn first_above(solver: &mut Solver, count: usize, least: f64) -> Option<f64> {
    if count >= solver.layout.unknowns() {
        return None;
    }
    let mut has_more = |value: f64| solver.factorize(-value).negative > count;
    let mut bounds = [least, FASTER * least];
    while !has_more(bounds[1]) {
        bounds = bounds.map(|bound| FASTER * bound);
        if !bounds[1].is_finite() {
            return None;
        }
    }
    while bounds[1] > (1.0 + PRECISION) * bounds[0] {
        let middle = (bounds[0] * bounds[1]).sqrt();
        bounds[usize::from(has_more(middle))] = middle;
    }
    Some(bounds[1])
}

/// Counts eigenvalues; `uncertainty` bounds the row sums of the error.
fn count(solver: &mut Solver, uncertainty: f64) -> Certificate {
    let lightest = solver.lightest();
    let negative_pivots = solver.factorize(0.0).negative;
    let rounding = ROUNDINGS * f64::EPSILON;
    let largest = solver.assembly.largest_entry();
    let least = uncertainty.max(rounding * largest).max(f64::MIN_POSITIVE);
    let mut resolution = least / lightest;
    let mut attempt = 1;
    loop {
        let above = solver.factorize(resolution);
        let mut growth = solver.growth();
        let below = solver.factorize(-resolution);
        growth = growth.max(solver.growth());
        let error = rounding * growth / lightest;
        // Small pivot of an indefinite matrix.
        if error > GROWTH_ALLOWED * resolution && attempt < ATTEMPTS {
            resolution = error;
            attempt += 1;
            continue;
        }
        return Certificate {
            negative: above.negative,
            unresolved: below.negative.saturating_sub(above.negative),
            resolution: resolution.max(error),
            negative_pivots,
        };
    }
}

/// Accepts the number of negative pivots if random roundings do not change it. A Newton step first
/// reduces the residual, which would bias all repetitions equally.
fn resolve(
    solver: &mut Solver,
    state: &State,
    interactions: &[Box<dyn Interaction>],
    certificate: &mut Certificate,
) {
    let polished = polish(solver, state, interactions);
    let state = polished.as_ref().unwrap_or(state);
    let first = solver.factorize(0.0);
    let scales = solver.assembly.scales(&solver.layout);
    let mut noise = Xorshift::new(1);
    let bounds = certificate.negative..=certificate.negative + certificate.unresolved;
    let settles = |inertia: Inertia| {
        inertia.zero == 0
            && inertia.negative == first.negative
            && bounds.contains(&inertia.negative)
    };
    if !settles(first) {
        return;
    }
    for _ in 0..REALIZATIONS {
        let mut changed = change(solver, state, interactions, &mut noise, AMPLITUDE);
        let entries = solver.assembly.values.iter().zip(&scales);
        for (changed, (value, scale)) in changed.iter_mut().zip(entries) {
            *changed += value + AMPLITUDE * f64::EPSILON * noise.sample() * scale;
        }
        std::mem::swap(&mut solver.assembly.values, &mut changed);
        let inertia = solver.factorize(0.0);
        std::mem::swap(&mut solver.assembly.values, &mut changed);
        if !settles(inertia) {
            return;
        }
    }
    certificate.negative = first.negative;
    certificate.unresolved = 0;
}

/// Performs one step; `None` if the residual does not decrease.
fn polish(
    solver: &mut Solver,
    state: &State,
    interactions: &[Box<dyn Interaction>],
) -> Option<State> {
    let (residual, floor) = solver.residual_and_floor(state);
    let inertia = solver.factorize(0.0);
    solver.make_positive(inertia).ok()?;
    let step = solver.plain_step();
    let mut polished = state.clone();
    solver.layout.apply(&mut polished, &step, 1.0);
    let evaluation = Evaluation::new(interactions, &polished);
    solver.work.evaluations += 1;
    let after = solver.layout.residual(&evaluation.loads);
    if !(evaluation.is_finite() && after.is_within(&residual.max(&floor))) {
        return None;
    }
    solver.assemble(interactions, &polished, &evaluation.loads);
    Some(polished)
}

/// Change of the stiffness by `amplitude` roundings of each coordinate. For short bonds it exceeds
/// the rounding of the matrix.
fn change(
    solver: &mut Solver,
    state: &State,
    interactions: &[Box<dyn Interaction>],
    noise: &mut Xorshift,
    amplitude: f64,
) -> Vec<f64> {
    let mut step = vec![0.0; solver.layout.unknowns()];
    solver.layout.magnitudes(state, &mut step);
    for step in &mut step {
        *step *= amplitude * f64::EPSILON * noise.sample().signum();
    }
    let mut moved = state.clone();
    solver.layout.apply(&mut moved, &step, 1.0);
    solver.work.assemblies += 1;
    let before = solver.assembly.values.clone();
    let (assembly, layout) = (&mut solver.assembly, &mut solver.layout);
    assembly.update(interactions, &moved, layout);
    let changes = assembly.values.iter().zip(&before).map(|(a, b)| a - b);
    let changes = changes.collect();
    assembly.values = before;
    changes
}

fn largest_row_sum(solver: &mut Solver, mut matrix: Vec<f64>) -> f64 {
    let n = solver.layout.unknowns();
    let mut sums = vec![0.0; n];
    std::mem::swap(&mut solver.assembly.values, &mut matrix);
    solver.assembly.multiply_absolute(&vec![1.0; n], &mut sums);
    std::mem::swap(&mut solver.assembly.values, &mut matrix);
    sums.into_iter().fold(0.0, f64::max)
}

/// Bracketing factor.
const FASTER: f64 = 16.0;
const PRECISION: f64 = 1e-9;
/// Rounding error in units of the largest entry.
const ROUNDINGS: f64 = 8.0;
/// Largest growth factor considered accurate.
const GROWTH_ALLOWED: f64 = 16.0;
const ATTEMPTS: u32 = 4;
/// Repetitions; a zero eigenvalue passes all with a probability below 1 %.
const REALIZATIONS: usize = 8;
const AMPLITUDE: f64 = 4.0;

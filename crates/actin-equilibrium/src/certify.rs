//! Counts the negative eigenvalues of the stiffness at an equilibrium.
//!
//! Eigenvalues `lambda` are those of `K v = lambda M v` with `M` one for displacements (nm) and
//! `l^2` for turns (rad), `l` the turn length of the options. Their signs are counted by
//! Sylvester's law from the pivots of `K + s M` and `K - s M`, where `s`, the resolution, is the
//! error that factorisation and coordinates may have made: eigenvalues below `-s` are negative
//! beyond doubt. Those within `[-s, s]` are looked at more closely, since `s` is a bound for the
//! worst case, which long filaments, whose lowest eigenvalues fall with the fourth power of the
//! length, do not meet: the count is repeated with the coordinates and the matrix changed at
//! random by some roundings. If it never changes, and no pivot is exactly zero in any repetition, it
//! is taken; else they cannot be told from zero. A body that nothing acts on has as many eigenvalues
//! of exactly zero as it has unknowns: changes in proportion to them would leave them zero, and the
//! signs of their pivots mean nothing.

use crate::certificate::{Certificate, Stability};
use crate::direction::Solver;
use crate::evaluation::Evaluation;
use crate::factor::Inertia;
use crate::newton::Newton;
use crate::outcome::SolveError;
use actin_mechanics::{Interaction, State, Xorshift};

/// Counts the eigenvalues of the stiffness of the last assembly, made at `state`.
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
    /// The lowest eigenvalue of the stiffness at `state` that is not neutral (pN/nm), to 1e-9 of it; `None` if all
    /// are neutral. Neutral ones are counted by the `certificate` of the state.
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

/// The lowest eigenvalue of the stiffness of the last assembly above the `count` lowest, which are below `least`, by
/// bisection; `None` if there are no more.
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

/// Counts with a stiffness that is known up to `uncertainty` (largest sum of a row); three
/// factorisations, rarely more.
fn count(solver: &mut Solver, uncertainty: f64) -> Certificate {
    let lightest = solver.lightest();
    let negative_pivots = solver.factorize(0.0).negative;
    let rounding = ROUNDINGS * f64::EPSILON;
    let largest = solver.assembly.largest_entry();
    // A shift of zero would tell nothing: what is exactly zero is to lie between the two counts.
    let least = uncertainty.max(rounding * largest).max(f64::MIN_POSITIVE);
    let mut resolution = least / lightest;
    let mut attempt = 1;
    loop {
        let above = solver.factorize(resolution);
        let mut growth = solver.growth();
        let below = solver.factorize(-resolution);
        growth = growth.max(solver.growth());
        let error = rounding * growth / lightest;
        // An error above the resolution means that an indefinite matrix met a small pivot.
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

/// Takes the count of negative pivots where it is the same for all realisations of rounding, and no
/// pivot is zero in any.
///
/// Before that the residual is brought down by a step of Newton's method: what it leaves of a
/// zero eigenvalue is the same in all realisations and would pass for a sign.
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

/// One step from `state`, at which the stiffness is then assembled; `None`, with the assembly as
/// it was, if the step does not bring the residual down.
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
    let after = solver.layout.residual(&polished, &evaluation.loads);
    // What is at its floor already may rise a little.
    if !(evaluation.is_finite() && after.is_within(&residual.max(&floor))) {
        return None;
    }
    solver.assemble(interactions, &polished, &evaluation.loads);
    Some(polished)
}

/// How the stiffness changes when each coordinate changes by `amplitude` roundings.
///
/// A bond of length `l` turns rounding of its ends into a geometric stiffness of that times its
/// stiffness over `l`: with short bonds far more than the rounding of the matrix.
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
    let evaluation = Evaluation::new(interactions, &moved);
    solver.work.evaluations += 1;
    solver.work.assemblies += 1;
    let before = solver.assembly.values.clone();
    let (assembly, layout) = (&mut solver.assembly, &mut solver.layout);
    assembly.update(interactions, &moved, &evaluation.loads, layout);
    let changes = assembly.values.iter().zip(&before).map(|(a, b)| a - b);
    let changes = changes.collect();
    assembly.values = before;
    changes
}

/// The largest sum of absolute values in a row of a matrix of the present pattern.
fn largest_row_sum(solver: &mut Solver, mut matrix: Vec<f64>) -> f64 {
    let n = solver.layout.unknowns();
    let mut sums = vec![0.0; n];
    std::mem::swap(&mut solver.assembly.values, &mut matrix);
    solver.assembly.multiply_absolute(&vec![1.0; n], &mut sums);
    std::mem::swap(&mut solver.assembly.values, &mut matrix);
    sums.into_iter().fold(0.0, f64::max)
}

/// Factor by which bounds of an eigenvalue are moved apart.
const FASTER: f64 = 16.0;
/// Relative precision of an eigenvalue found by bisection.
const PRECISION: f64 = 1e-9;
/// Roundings of the largest entry that assembly and factorisation may have made.
const ROUNDINGS: f64 = 8.0;
/// Growth over the largest diagonal entry that is taken for accurate.
const GROWTH_ALLOWED: f64 = 16.0;
/// How often the interval of unresolved eigenvalues is widened.
const ATTEMPTS: u32 = 4;
/// How often a count is repeated with changed roundings. An eigenvalue of zero passes all of
/// them by chance once in some hundred times.
const REALIZATIONS: usize = 8;
/// Roundings by which coordinates and entries are changed then.
const AMPLITUDE: f64 = 4.0;

//! Assembly, factorisation and direction of a Newton step.

use crate::assemble::Assembly;
use crate::evaluation::Evaluation;
use crate::factor::{Factor, Inertia};
use crate::history::SolverWork;
use crate::layout::Layout;
use crate::motion::StepSize;
use crate::outcome::SolveError;
use actin_mechanics::Residual;
use actin_mechanics::{Interaction, Loads, State};

/// Growth factor of an insufficient regularisation.
const GROW: f64 = 8.0;
/// Ratio of the first regularisation to the negative curvature found.
const BEYOND: f64 = 2.0;
/// Divisor for the next initial guess.
const GUESS: f64 = GROW;
/// Maximum regularisation, relative to the largest diagonal entry.
const LIMIT: f64 = 1e3;
/// Ratio to the strain limit above which a step is regularised.
const TOO_LONG: f64 = 4.0;
/// Strain below which ties are not stiffened.
const SHORT: f64 = 1e-6;
/// Iterations for the stiffening and the motion of ties.
const ROUNDS: usize = 2;
/// Relative change of the stiffness of a tie that moves by its own length, initial guess.
const STIFFNESS_CHANGE: f64 = 0.3;
/// Minimum regularisation, in roundings of the largest diagonal entry.
const LEAST_ROUNDINGS: f64 = 4.0;
/// Minimum stiffening of a tie relative to the stiffest one, so that a single factor suffices.
const LEAST_SHARE: f64 = 0.01;
/// Minimum softness, relative to the largest diagonal entry.
const SOFTEST: f64 = 1e-6;
/// Minimum stiffening of the softest tie, relative to its softness.
const LEAST_STIFFENING: f64 = 0.03;
/// Initial stiffening of a search, relative to the last one.
const STIFFEST_DROP: f64 = 0.3;
/// Growth factor of an insufficient stiffening.
const STIFFEST_GROWTH: f64 = 3.0;

#[derive(Debug)]
pub(crate) struct Solver {
    pub(crate) layout: Layout,
    pub(crate) assembly: Assembly,
    factor: Option<Factor>,
    /// 1 for displacements, squared turn length for rotations.
    pub(crate) metric: Vec<f64>,
    turn_length: f64,
    pub(crate) reduced: Vec<f64>,
    rounding: Vec<f64>,
    pub(crate) work: SolverWork,
}

#[derive(Clone, Debug)]
pub(crate) struct Direction {
    pub(crate) step: Vec<f64>,
    pub(crate) extent: StepSize,
    /// `f . p`: initial rate of descent.
    pub(crate) slope: f64,
    /// `p . K p`.
    pub(crate) curvature: f64,
    pub(crate) negative_pivots: usize,
    pub(crate) regularization: f64,
    motions: Vec<f64>,
    pub(crate) cubic: f64,
}

impl Solver {
    pub(crate) fn new(layout: Layout, turn_length: f64) -> Self {
        Self {
            layout,
            assembly: Assembly::new(turn_length),
            factor: None,
            metric: Vec::new(),
            turn_length,
            reduced: Vec::new(),
            rounding: Vec::new(),
            work: SolverWork::default(),
        }
    }

    pub(crate) fn check(interactions: &[Box<dyn Interaction>]) -> Result<(), SolveError> {
        for interaction in interactions {
            if !interaction.is_conservative() {
                return Err(SolveError::NotConservative(interaction.term()));
            }
            if interaction.second_order().is_none() {
                return Err(SolveError::NoStiffness(interaction.term()));
            }
        }
        Ok(())
    }

    pub(crate) fn prepare(
        &mut self,
        state: &State,
        interactions: &[Box<dyn Interaction>],
    ) -> Result<(), SolveError> {
        Self::check(interactions)?;
        let evaluation = Evaluation::new(interactions, state);
        self.work.evaluations += 1;
        if !evaluation.is_finite() {
            return Err(SolveError::NotFinite);
        }
        self.assemble(interactions, state, &evaluation.loads);
        Ok(())
    }

    pub(crate) fn assemble(
        &mut self,
        interactions: &[Box<dyn Interaction>],
        state: &State,
        loads: &Loads,
    ) {
        let is_new = self.assembly.update(interactions, state, &mut self.layout);
        self.work.assemblies += 1;
        if is_new {
            let factor = Factor::new(&self.assembly.pattern().symbolic);
            self.work.symbolic_factorizations += 1;
            self.work.factor_entries = factor.entries() as u64;
            self.factor = Some(factor);
            self.metric = vec![0.0; self.layout.unknowns()];
            self.layout.metric(self.turn_length, &mut self.metric);
        }
        self.reduced.resize(self.layout.unknowns(), 0.0);
        self.layout.reduce(loads, &mut self.reduced);
    }

    /// Residual and its rounding error `eps |K| |u|`, where `u` is 1 for rotations.
    pub(crate) fn residual_and_floor(&mut self, state: &State) -> (Residual, Residual) {
        let mut magnitudes = vec![0.0; self.layout.unknowns()];
        self.layout.magnitudes(state, &mut magnitudes);
        self.rounding.resize(magnitudes.len(), 0.0);
        self.assembly
            .multiply_absolute(&magnitudes, &mut self.rounding);
        self.rounding.iter_mut().for_each(|r| *r *= f64::EPSILON);
        let floor = self.layout.largest(&self.rounding);
        (self.layout.largest(&self.reduced), floor)
    }

    /// Returns `true` if all loads are within the tolerance or `multiple` times their rounding
    /// error. The test is per body: rounding at a stiff joint must not stop the solve elsewhere.
    pub(crate) fn is_at_floor(&self, tolerance: &Residual, multiple: f64) -> bool {
        let rounding = (self.rounding.as_slice(), multiple);
        self.layout.are_within(&self.reduced, tolerance, rounding)
    }

    pub(crate) fn factorize(&mut self, shift: f64) -> Inertia {
        let factor = self.factor.as_mut().expect("the stiffness is assembled");
        self.work.factorizations += 1;
        factor.factorize(
            self.assembly.pattern().symbolic.as_ref(),
            &self.assembly.values,
            &self.metric,
            shift,
        )
    }

    /// Loads along motions without stiffness; `None` if the stiffness is indefinite.
    pub(crate) fn unresisted(&mut self) -> Option<Residual> {
        let shift = self.least_shift();
        if !self.factorize(shift).is_positive() {
            return None;
        }
        // (K + s M) p = f: s M p = f in the null space of K.
        let mut part = self.plain_step();
        for (part, mass) in part.iter_mut().zip(&self.metric) {
            *part *= shift * mass;
        }
        Some(self.layout.total(&part))
    }

    pub(crate) fn total(&self) -> Residual {
        self.layout.total(&self.reduced)
    }

    /// No negative eigenvalue beyond rounding.
    pub(crate) fn is_stable(&mut self) -> bool {
        let shift = self.least_shift();
        self.factorize(shift).is_positive()
    }

    /// Some eigenvalue is not positive beyond rounding.
    pub(crate) fn has_weak_mode(&mut self) -> bool {
        let shift = self.least_shift();
        !self.factorize(-shift).is_positive()
    }

    /// Smallest shift above the rounding error.
    fn least_shift(&self) -> f64 {
        let least = LEAST_ROUNDINGS * f64::EPSILON * self.largest_in_metric();
        least.max(f64::MIN_POSITIVE)
    }

    pub(crate) fn plain_step(&mut self) -> Vec<f64> {
        let mut step = self.reduced.clone();
        self.solve(&mut step);
        step
    }

    pub(crate) fn solve(&mut self, b: &mut [f64]) {
        let factor = self.factor.as_mut().expect("the stiffness is assembled");
        factor.solve(b);
    }

    /// Transforms white noise to a step whose covariance is the inverse of the factorised matrix.
    pub(crate) fn spread(&self, noise: &mut [f64]) {
        let factor = self.factor.as_ref().expect("the stiffness is assembled");
        factor.spread(noise);
    }

    /// Factorises with the smallest sufficient shift, starting from `inertia`.
    pub(crate) fn make_positive(&mut self, inertia: Inertia) -> Result<f64, SolveError> {
        self.make_positive_from(inertia, false, 0.0)
    }

    /// No shift is added if the loads meet no negative curvature: it could slow down the stretching
    /// of a rod by orders of magnitude.
    fn make_positive_for_loads(
        &mut self,
        inertia: Inertia,
        with_ties: bool,
        guess: f64,
    ) -> Result<f64, SolveError> {
        let factor = self.factor.as_ref().expect("the stiffness is assembled");
        let is_regular = inertia.doubtful == 0;
        if is_regular && inertia.negative > 0 && factor.is_positive_for(&self.reduced) {
            return Ok(0.0);
        }
        self.make_positive_from(inertia, with_ties, guess)
    }

    /// The first shift is at least `guess`.
    fn make_positive_from(
        &mut self,
        mut inertia: Inertia,
        with_ties: bool,
        guess: f64,
    ) -> Result<f64, SolveError> {
        let largest = self.largest_diagonal();
        let lightest = self.lightest();
        let least = LEAST_ROUNDINGS * f64::EPSILON * largest / lightest;
        let mut shift = 0.0;
        while !inertia.is_positive() {
            shift = (GROW * shift)
                .max(shift + self.beyond_curvature())
                .max(guess)
                .max(least);
            // Zero or overflowing stiffness would loop forever. The condition also rejects NaN.
            let is_worth_trying = shift > 0.0 && shift <= LIMIT * largest / lightest;
            if !(is_worth_trying && shift.is_finite()) {
                return Err(SolveError::NotFactorizable(shift));
            }
            inertia = if with_ties {
                self.factorize_with_ties(shift)
            } else {
                self.factorize(shift)
            };
        }
        Ok(shift)
    }

    /// Shift that removes the negative curvature of the last factorisation, if any.
    fn beyond_curvature(&self) -> f64 {
        let factor = self.factor.as_ref().expect("the stiffness is assembled");
        -BEYOND * factor.negative_curvature(&self.metric).unwrap_or(0.0)
    }

    /// Estimate of the largest eigenvalue.
    pub(crate) fn largest_in_metric(&self) -> f64 {
        self.assembly.largest_diagonal() / self.lightest()
    }

    pub(crate) fn lightest(&self) -> f64 {
        self.metric.iter().copied().fold(f64::INFINITY, f64::min)
    }

    pub(crate) fn floppy(&self) -> usize {
        let factor = self.factor.as_ref().expect("the stiffness is assembled");
        factor.floppy()
    }

    pub(crate) fn growth(&self) -> f64 {
        let factor = self.factor.as_ref().expect("the stiffness is assembled");
        factor.growth()
    }

    pub(crate) fn largest_diagonal(&self) -> f64 {
        let factor = self.factor.as_ref().expect("the stiffness is assembled");
        factor.largest_diagonal()
    }

    fn factorize_with_ties(&mut self, shift: f64) -> Inertia {
        let factor = self.factor.as_mut().expect("the stiffness is assembled");
        self.work.factorizations += 1;
        factor.factorize_sum(
            self.assembly.pattern().symbolic.as_ref(),
            (&self.assembly.values, &self.assembly.tie_values),
            &self.metric,
            shift,
        )
    }

    /// Newton direction; `plain` is the inertia of the current factorisation.
    ///
    /// Ties are stiffened in proportion to their motion if the step strains neighbours by much more
    /// than `strain`, or if `cubic` is positive; see [`crate::ties`].
    pub(crate) fn direction(
        &mut self,
        state: &State,
        plain: Inertia,
        (strain, cubic): (f64, f64),
    ) -> Result<Direction, SolveError> {
        let lengths = self.assembly.tie_lengths();
        let limits: Vec<f64> = lengths.iter().map(|length| strain * length).collect();
        if cubic > 0.0 && !plain.is_positive() {
            // The shift without ties does not apply with ties.
            return self.stiffened_direction(state, plain, cubic, (limits, 0.0));
        }
        let shift = self.make_positive_for_loads(plain, false, 0.0)?;
        let direction = self.solve_direction(state, plain, shift, &[]);
        let too_long = direction.extent.strain > TOO_LONG * strain;
        let cubic = if too_long {
            cubic.max(self.least_cubic())
        } else {
            cubic
        };
        if cubic == 0.0 || direction.extent.strain < SHORT {
            return Ok(direction);
        }
        let motions = direction.motions.iter().zip(&limits);
        let motions = motions.map(|(motion, limit)| motion.min(*limit)).collect();
        self.stiffened_direction(state, plain, cubic, (motions, shift / GUESS))
    }

    fn stiffened_direction(
        &mut self,
        state: &State,
        plain: Inertia,
        cubic: f64,
        (mut motions, mut guess): (Vec<f64>, f64),
    ) -> Result<Direction, SolveError> {
        let mut round = 1;
        loop {
            let weights: Vec<f64> = motions.iter().map(|motion| cubic * motion).collect();
            self.assembly.assemble_ties(state, &self.layout, &weights);
            let inertia = self.factorize_with_ties(0.0);
            let shift = self.make_positive_for_loads(inertia, true, guess)?;
            let direction = self.solve_direction(state, plain, shift, &weights);
            if round == ROUNDS {
                return Ok(Direction { cubic, ..direction });
            }
            for (motion, new) in motions.iter_mut().zip(&direction.motions) {
                // The geometric mean solves w = cubic r, w r = f in one iteration.
                *motion = (*motion * new).sqrt();
            }
            guess = shift / GUESS;
            round += 1;
        }
    }

    /// Newton direction with soft ties stiffened just enough for a positive definite stiffness. The
    /// search starts from a fraction of `stiffest` (pN/nm).
    pub(crate) fn composed_direction(
        &mut self,
        state: &State,
        stiffest: &mut f64,
    ) -> Option<Direction> {
        let plain = self.factorize(0.0);
        if plain.is_positive() {
            return Some(self.solve_direction(state, plain, 0.0, &[]));
        }
        let mut shares = self.assembly.giving_way();
        let most = shares.iter().copied().fold(0.0, f64::max);
        let most = most.max(SOFTEST * self.largest_diagonal());
        for share in &mut shares {
            *share = (*share / most).max(LEAST_SHARE);
        }
        let limit = LIMIT * self.largest_diagonal() / LEAST_SHARE;
        *stiffest = (STIFFEST_DROP * *stiffest).max(LEAST_STIFFENING * most);
        loop {
            let weights: Vec<f64> = shares.iter().map(|share| share * *stiffest).collect();
            self.assembly.assemble_ties(state, &self.layout, &weights);
            if self.factorize_with_ties(0.0).is_positive() {
                let direction = self.solve_direction(state, plain, 0.0, &weights);
                return Some(Direction {
                    regularization: *stiffest,
                    ..direction
                });
            }
            *stiffest *= STIFFEST_GROWTH;
            let is_worth_trying = *stiffest <= limit;
            if !is_worth_trying {
                return None;
            }
        }
    }

    /// Initial guess for the change of stiffness per motion of a tie.
    pub(crate) fn least_cubic(&self) -> f64 {
        let lengths = self.assembly.tie_lengths();
        let mean = lengths.iter().sum::<f64>() / lengths.len().max(1) as f64;
        STIFFNESS_CHANGE * self.largest_diagonal() / mean
    }

    fn solve_direction(
        &mut self,
        state: &State,
        plain: Inertia,
        shift: f64,
        weights: &[f64],
    ) -> Direction {
        let mut step = self.reduced.clone();
        self.solve(&mut step);
        let motions = self.assembly.ties().motions(&self.layout, state, &step);
        let slope = dot(&self.reduced, &step);
        // (K + T + mu M) p = f.
        let of_metric: f64 = step.iter().zip(&self.metric).map(|(p, m)| m * p * p).sum();
        let of_ties: f64 = weights.iter().zip(&motions).map(|(w, r)| w * r * r).sum();
        let strain = motions
            .iter()
            .zip(self.assembly.tie_lengths())
            .map(|(motion, length)| motion / length)
            .fold(0.0, f64::max);
        Direction {
            slope,
            curvature: slope - shift * of_metric - of_ties,
            extent: StepSize {
                strain,
                ..self.layout.step_extent(&step)
            },
            step,
            motions,
            negative_pivots: plain.negative,
            regularization: shift,
            cubic: 0.0,
        }
    }

    pub(crate) fn work_along(&self, loads: &Loads, step: &[f64]) -> f64 {
        let mut reduced = vec![0.0; step.len()];
        self.layout.reduce(loads, &mut reduced);
        dot(&reduced, step)
    }
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

//! Overdamped steps that are implicit in the stiffness.
//!
//! # The equation
//! Friction `Z(q)`, loads `f(q)` and thermal noise balance: `Z v = f + noise`, `v` the velocities of points
//! in the lab and the angular velocities of frames in their own axes. The equilibrium distribution is that of
//! Boltzmann with the measure of the places and of the rotations (Haar's) if the noise is read in the sense of
//! Stratonovich: with `Z v = f + sqrt(2 kT) B xi`, `B B^T = Z`, the drift that this reading lacks is
//! `kT sum_k b_k div b_k`, over the columns `b_k` of `Z^-1 B`. Friction of dashpots depends on orientations
//! only, in the same way whichever way the body faces. So a column that moves points has components that do not
//! depend on places, one that turns a frame has constant components in its axes, and divergences of both
//! vanish on places and rotations. No drift is left out.
//!
//! # The step
//! From `q_0` over `h` to `q_1`, with `d` the displacements and turns in between, `q_m` half of the way, all vectors
//! brought to the axes of `q_m`:
//!
//! `Z(q_m) d / h = (f(q_0) + f(q_1)) / 2 + sqrt(2 kT / h) B(q_m) xi`.
//!
//! It is the trapezoidal rule for the loads and the midpoint rule for friction and noise, and the same read backwards
//! but for the noise. It is solved by Newton's method; the Jacobian `Z/h + K/2` is a stiffness on the diagonal of which
//! friction is added.
//!
//! # What it gives
//! For loads that are linear, `f = -k x`: `x_1 = r x_0 + noise` with `r = (1 - z)/(1 + z)`,
//! `z = k h/(2 zeta)`, whose variance `kT/k` is exact at every step. Without noise it is of second order. With noise
//! means are of second order where friction is constant, of first where it turns with the bodies. Modes that
//! relax faster than a step, `z >> 1`, keep their equilibrium distribution, but change sign from
//! step to step and forget over `z/2` of them. The first steps are implicit altogether, `f(q_1)` alone, so
//! that what is out of balance at the start does not alternate for as long; what is left over then warms up over these steps.
//!
//! # Source
//! Trapezoidal rule: Crank and Nicolson, Proc. Camb. Phil. Soc. 43 (1947) 50; implicit steps at the start: Rannacher, Numer. Math. 43
//! (1984) 309. Drift: Hutter and Ottinger, J. Chem. Soc. Faraday Trans. 94 (1998) 1403.

use crate::Friction;
use crate::friction::Velocities;
use actin_equilibrium::{ImplicitSolver, Layout, SolveError, StepSize};
use actin_integrate::{Body, FailureKind, Noise, StepFailure, Stepper};
use actin_mechanics::{Loads, Split, State, System, Thermostat, Vector3, Vectors, rotation};
use thiserror::Error;

/// Parts the key of this noise from other uses of the same seed.
const PURPOSE: [u8; 8] = *b"brownian";

/// Steps at the start that are implicit altogether.
const DAMPED_STEPS: u64 = 4;

/// Longest turn (rad) that one iteration may ask for.
const LARGEST_TURN: f64 = 0.5;

/// When a step counts as solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepLimits {
    /// Largest displacement (nm) of the last iteration; positive.
    pub displacement: f64,
    /// Largest turn (rad) of the last iteration; positive.
    pub rotation: f64,
    /// Most iterations; at least 1.
    pub iterations: usize,
}

impl Default for StepLimits {
    fn default() -> Self {
        Self {
            displacement: 1e-5,
            rotation: 1e-6,
            iterations: 30,
        }
    }
}

/// Why there are no steps.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum BrownianError {
    /// An interaction has no potential or no second derivatives.
    #[error(transparent)]
    Interaction(#[from] SolveError),
    /// The thermal energy (pN nm) is negative or not finite.
    #[error("the thermal energy must be finite and not negative, got {0} pN nm")]
    ThermalEnergy(f64),
}

/// Makes overdamped steps of one system.
///
/// The noise is a function of the seed, the number of the step and the index of the dashpot.
#[derive(Debug)]
pub struct Brownian {
    friction: Friction,
    thermal_energy: f64,
    limits: StepLimits,
    solver: ImplicitSolver,
    noise: Noise,
    start: State,
    at_start: Loads,
    at_end: Loads,
    residual: Loads,
    velocities: Velocities,
    iterations: u64,
}

impl Brownian {
    /// Steps of `system` with what `layout` lets move, in `friction`, at the thermal energy `kT` (pN nm);
    /// at zero there is no noise. Where the order of unknowns is still to be found it is that of the present
    /// state.
    ///
    /// # Errors
    /// Interactions without a potential or second derivatives, a thermal energy that is none.
    pub fn new(
        system: &System,
        layout: Layout,
        friction: Friction,
        (thermal_energy, seed): (f64, u64),
    ) -> Result<Self, BrownianError> {
        if !(thermal_energy.is_finite() && thermal_energy >= 0.0) {
            return Err(BrownianError::ThermalEnergy(thermal_energy));
        }
        ImplicitSolver::check(system.interactions())?;
        let state = system.state();
        let loads = Loads::zeros(state);
        let mut solver = ImplicitSolver::new(layout);
        solver.factorize((state, &loads), system.interactions(), &friction.times(1.0));
        let elements = (friction.dashpots.len(), friction.turns.len());
        Ok(Self {
            noise: Noise::of_purpose(PURPOSE, seed, elements),
            velocities: Velocities {
                points: Vectors::zeros(state.points.len()),
                frames: Vectors::zeros(state.frames.len()),
                middle: state.frames.orientation.iter().collect(),
            },
            friction,
            thermal_energy,
            limits: StepLimits::default(),
            solver,
            start: state.clone(),
            at_start: loads.clone(),
            at_end: loads.clone(),
            residual: loads,
            iterations: 0,
        })
    }

    /// The same with other limits.
    #[must_use]
    pub fn with_limits(self, limits: StepLimits) -> Self {
        Self { limits, ..self }
    }

    /// Iterations, each with a factorisation, of all steps so far.
    pub fn iterations(&self) -> u64 {
        self.iterations
    }

    /// Moves `system` to the end of a step from `self.start`, of which the loads are known, with the share
    /// `theta` of the loads at the end.
    fn solve(&mut self, system: &mut System, h: f64, theta: f64) -> Result<(), StepFailure> {
        let added = 1.0 / (theta * h);
        let mut extent = StepSize::default();
        for _ in 0..self.limits.iterations {
            self.iterations += 1;
            self.at_end.clone_from(system.loads());
            self.find_residual(system.state(), h, theta);
            let at = (system.state(), &self.at_end);
            let friction = self.friction.times(added);
            self.solver.factorize(at, system.interactions(), &friction);
            let state = system.state_mut();
            extent = self.solver.advance(state, &self.residual, LARGEST_TURN);
            if extent.displacement <= self.limits.displacement
                && extent.rotation <= self.limits.rotation
            {
                return Ok(());
            }
        }
        Err(StepFailure {
            problem: FailureKind::NotConverged(extent.displacement),
            body: self.worst(system.state()),
        })
    }

    /// The body that has moved most in a step that failed.
    fn worst(&self, state: &State) -> Body {
        let moved = |i: usize| {
            let d = state.points.position.get(i) - self.start.points.position.get(i);
            let d = d.norm();
            if d.is_finite() { d } else { f64::INFINITY }
        };
        let points = 0..state.points.len();
        let worst = points.max_by(|&a, &b| moved(a).total_cmp(&moved(b)));
        worst.map_or(Body::Frame(0), Body::Point)
    }

    /// What is left of the balance at `state`, over the share of the loads there, in the axes of the
    /// middle.
    fn find_residual(&mut self, state: &State, h: f64, theta: f64) {
        self.find_velocities(state, h);
        let share = (1.0 - theta) / theta;
        let (f_0, f_1, out) = (&self.at_start, &self.at_end, &mut self.residual);
        for i in 0..f_1.force.len() {
            out.force.set(i, f_1.force.get(i) + f_0.force.get(i) * share);
        }
        for i in 0..f_1.torque.len() {
            let half = rotation::exp(self.velocities.frames.get(i) * (0.5 * h));
            let at_start = half.inverse_transform_vector(&f_0.torque.get(i));
            out.torque.set(i, half * f_1.torque.get(i) + at_start * share);
        }
        let strength = (2.0 * self.thermal_energy / h).sqrt();
        let noise = (strength, &self.noise.points, &self.noise.frames);
        let friction = &self.friction;
        friction.add_loads(&self.velocities, noise, 1.0 / theta, &mut self.residual);
    }

    /// Velocities over the step from its start to `state`.
    fn find_velocities(&mut self, state: &State, h: f64) {
        let (start, velocities) = (&self.start, &mut self.velocities);
        for i in 0..state.points.len() {
            let d: Vector3 = state.points.position.get(i) - start.points.position.get(i);
            velocities.points.set(i, d / h);
        }
        for i in 0..state.frames.len() {
            let q_0 = start.frames.orientation.get(i);
            let turn = rotation::log(q_0.inverse() * state.frames.orientation.get(i));
            velocities.frames.set(i, turn / h);
            velocities.middle[i] = q_0 * rotation::exp(0.5 * turn);
        }
    }
}

impl Stepper for Brownian {
    fn step(&mut self, system: &mut System, step: u64, h: f64) -> Result<(), StepFailure> {
        self.at_start.clone_from(system.loads());
        self.start.copy_motion_from(system.state());
        self.noise.draw_stream(step, (1.0, 1.0));
        // What is driven goes to the end of the step; free bodies have no velocity.
        system.drift(h);
        let theta = if step < DAMPED_STEPS { 1.0 } else { 0.5 };
        self.solve(system, h, theta)?;
        if system.has_step_end() {
            system.end_step(step + 1, h);
        }
        Ok(())
    }
}

//! Overdamped steps that are implicit in the stiffness.
//!
//! # The equation
//! Friction `Z(q)`, loads `f(q)` and thermal noise balance: `Z v = f + noise`, `v` the velocities of points
//! in the lab and the angular velocities of frames in their own axes. The equilibrium distribution is that of
//! Boltzmann with the measure of the places and of the rotations (Haar's) if the noise is read in the sense of
//! Stratonovich and a drift is added: with `Z v = f + sqrt(2 kT) B xi`, `B B^T = Z`, it is
//! `kT sum_k b_k div b_k`, over the columns `b_k` of `Z^-1 B`. Here it vanishes. A column that moves points has components
//! that depend on orientations, not on places; one that turns a frame has constant components in the axes of that
//! frame; so has one that moves a body of a point and a frame. Divergences of all of these are zero, on places and on
//! rotations. (That asks of dashpots with an arm that each is the only one on its point, or on the same frame as the others.)
//!
//! # The step
//! The implicit midpoint rule, in body axes: from `q_0` over `h`, with `d` displacements and turns over half of the
//! step, `q_m = q_0 exp(d)`, `q_1 = q_m exp(d)`, and
//!
//! `Z(q_m) 2 d / h = f(q_m) + sqrt(2 kT / h) B(q_m) xi`.
//!
//! Read backwards it is the same but for the noise. It is solved by Newton's method, whose matrix is the stiffness with
//! friction added, `K + 2 Z/h`.
//!
//! # What it gives
//! For loads that are linear, `f = -k x`: `x_1 = r x_0 + noise` with `r = (1 - z)/(1 + z)`,
//! `z = k h/(2 zeta)`, whose variance is `kT/k` at every step. Without noise it is of second order. With noise
//! means are of first order in the step where loads are not linear; the coefficient is that with which bodies turn in
//! a step: points go straight while frames turn by an angle `a`, which stretches what is between them by
//! `a^2/4`. Measured on free rods of actin in water at 298 K, stretch and shear have this much of their energy, and bending
//! and twist this:
//!
//! | segments (nm) | step (ns) | over the fastest relaxation | stretch, shear | bending, twist |
//! |---|---|---|---|---|
//! | 10 | 0.1 | 70 | 1.018 | 1.007 |
//! | 10 | 0.3 | 210 | 1.18 | 1.002 |
//! | 20 | 0.147 | 100 | 1.002 | 1.003 |
//! | 40 | 0.3 | 120 | 1.002 | 0.997 |
//! | 40 | 1 | 400 | 1.086 | 1.011 |
//!
//! (to 0.5 %, bending of 40 nm to 2 %); at three times the last step Newton's method no longer solves all steps. Modes that
//! relax faster than a step, `z >> 1`, keep their equilibrium distribution, but change sign from
//! step to step and forget over `z/2` of them. The first steps are implicit altogether, `f(q_1)` alone, so
//! that what is out of balance at the start does not alternate for as long; thermal motion that is as fast sets in over these
//! steps.
//!
//! # Source
//! Implicit steps at the start: Rannacher, Numer. Math. 43 (1984) 309. Drift: Hutter and Ottinger, J. Chem. Soc. Faraday Trans. 94 (1998) 1403.

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
            displacement: 1e-4,
            rotation: 1e-5,
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
    loads: Loads,
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
            },
            friction,
            thermal_energy,
            limits: StepLimits::default(),
            solver,
            start: state.clone(),
            residual: loads.clone(),
            loads,
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

    /// Moves the free bodies of `system` by what friction and noise allow within a time `h`, from
    /// `self.start`; the noise is that of a step of `of`. Loads, friction and noise are those of the end.
    fn solve(&mut self, system: &mut System, h: f64, of: f64) -> Result<(), StepFailure> {
        let strength = (2.0 * self.thermal_energy / of).sqrt();
        let mut extent = StepSize::default();
        for _ in 0..self.limits.iterations {
            self.iterations += 1;
            self.loads.clone_from(system.loads());
            let state = system.state();
            self.find_velocities(state, h);
            self.residual.clone_from(&self.loads);
            let noise = (strength, &self.noise.points, &self.noise.frames);
            let moving = (state, &self.velocities);
            self.friction.add_loads(moving, noise, &mut self.residual);
            let friction = self.friction.times(1.0 / h);
            let at = (state, &self.loads);
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

    /// Velocities over a time `h` from the start to `state`.
    fn find_velocities(&mut self, state: &State, h: f64) {
        let (start, velocities) = (&self.start, &mut self.velocities);
        for i in 0..state.points.len() {
            let moved = state.points.position.get(i) - start.points.position.get(i);
            velocities.points.set(i, moved / h);
        }
        for i in 0..state.frames.len() {
            velocities.frames.set(i, turn(start, state, i) / h);
        }
    }
}

/// The turn of frame `i` from one state to another (rad, body frame).
fn turn(from: &State, to: &State, i: usize) -> Vector3 {
    let q = from.frames.orientation.get(i);
    rotation::log(q.inverse() * to.frames.orientation.get(i))
}

impl Stepper for Brownian {
    fn step(&mut self, system: &mut System, step: u64, h: f64) -> Result<(), StepFailure> {
        self.start.copy_motion_from(system.state());
        self.noise.draw_stream(step, (1.0, 1.0));
        // What is driven goes on to the place of its time; free bodies have no velocity.
        if step < DAMPED_STEPS {
            system.drift(h);
            self.solve(system, h, h)?;
        } else {
            system.drift(0.5 * h);
            self.solve(system, 0.5 * h, h)?;
            self.solver.go_on(&self.start, system.state_mut());
            system.drift(0.5 * h);
        }
        if system.has_step_end() {
            system.end_step(step + 1, h);
        }
        Ok(())
    }
}

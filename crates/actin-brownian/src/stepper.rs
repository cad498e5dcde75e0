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
//! # Steps with random stress
//! From `q_0` over `h`, with the displacements and turns `d` from there to `q_1`,
//!
//! `Z(q_m) d / h = f(q_1) + sqrt(2 kT / h) B(q_0) xi + sum_e (de/dq)(q_1)^T s_e`,
//!
//! friction in the axes of frames half way, `q_m`, its noise in those of the start. The last term is the work of the step: a
//! random stress `s_e` on each element of strain `e`, of the covariance `kT C` with the element's stiffness `C` (see
//! [`RandomStress`](actin_mechanics::RandomStress)). For loads that are linear, `f = -k x`, with `z = k h / zeta`:
//!
//! `x_1 = x_0 / (1 + z) + noise` of the variance `kT/k (2 z + z^2) / (1 + z)^2`,
//!
//! so that the variance is `kT/k` at every step. `2 z` is the part of friction, `z^2` that of stress: what is
//! slow moves as it does without the stress, what relaxes within a step is drawn anew in each and does not remember. Stress
//! acts on strains, however far bodies turn in a step, and turns no frame of a rod about its own axis. So steps may be
//! thousands of times longer than stretch and shear take to relax. The slope of a mode's correlation is too small by `z/2`.
//!
//! Where strains can be chosen freely, as in an open chain with constant rigidities, steps without end would be exact;
//! so are steps without length. In between means are of first order in the step. Interactions without random stress (loads,
//! contact) are right in steps that resolve how their bodies relax against them, and too cold in longer ones.
//!
//! It is solved by Newton's method, whose matrix is the stiffness with friction, `K + Z/h`, and with what stresses add. The
//! first iteration leaves out what forces add to the stiffness. So do later ones if the matrix is not positive definite: at
//! first for springs, which give way across if compressed, then for the chains with negative pivots, then for all. Bodies of
//! a chain carry one another along, and its mean keeps its displacement. Where iterations grow, friction is added. A step is
//! solved when the rest is within the limits, or below a thousandth of the displacement of the first iteration.
//!
//! Rods that are isotropic about their axes spin by a radian in steps of some microseconds. Energies do not depend on the spin,
//! and stresses keep their directions in the lab. The matrix couples spins to spins alone, so that large spins do not slow the
//! iteration ([`Brownian::with_spinning_frames`]). Linked chains are solved by conjugate gradients,
//! with the factors of the single chains as preconditioner, where that costs less than a factorisation of the whole.
//!
//! Friction is that half way and its noise that of the start, as Fixman has it: the elements that are stiff make of the two a
//! mobility that depends on the shape, and with friction or noise of another place the drift that goes with it is lost.
//!
//! Measured on free rods (`cargo test --release -p actin-brownian --test integration long_waves:: -- --ignored --nocapture`): `1 - cos` of the angle
//! over one and over ten segments over its exact value, 400,000 steps each:
//!
//! | segments | step (ns) | one segment | ten segments |
//! | --- | --- | --- | --- |
//! | 12 of 40 nm | 100 | 0.9995 +- 0.0012 | 0.9843 +- 0.0079 |
//! | 12 of 40 nm | 300 | 0.9996 +- 0.0008 | 0.9952 +- 0.0049 |
//! | 12 of 40 nm | 1000 | 0.9988 +- 0.0006 | 0.9946 +- 0.0033 |
//! | 25 of 40 nm | 300 | 1.0018 +- 0.0015 | 0.9986 +- 0.0152 |
//! | 25 of 40 nm | 1389 | 0.9993 +- 0.0009 | 0.9878 +- 0.0093 |
//! | 12 of 100 nm | 4000 | 1.0012 +- 0.0012 | 0.9937 +- 0.0106 |
//!
//! # Steps without noise
//! An implicit step, `Z(q_1) d / h = f(q_1)`, over `h` to `a` and two over `h/2` to `b`, then as far again from `b` as it is from
//! `a` (Richardson's extrapolation, in body axes). Of second order; a mode of `z = k h / zeta` is multiplied by
//! `2/(1 + z/2)^2 - 1/(1 + z)`, so that what is stiff is at rest after each step, however long. A step that is not solved
//! goes in two halves.
//!
//! # Midpoint steps
//! With noise, where it is asked for: the implicit midpoint rule, in body axes. From `q_0` over `h`, with `d` displacements
//! and turns over half of the step, `q_m = q_0 exp(d)`, `q_1 = q_m exp(d)`, and
//!
//! `Z(q_m) 2 d / h = f(q_m) + sqrt(2 kT / h) B(q_m) xi`.
//!
//! Linear modes have `kT/k` at every step. Modes that relax faster than a step change sign
//! from step to step and forget over `z/4` of them. With noise, stretch and shear of
//! 40 nm are too warm by 0.2 % in steps of 0.3 ns, 8.6 % in 1 ns: bodies go straight while frames turn. The first steps are
//! implicit altogether, `f(q_1)`, so that what is out of balance at the start does not alternate for as long.
//!
//! # Source
//! Implicit steps at the start: Rannacher, Numer. Math. 43 (1984) 309. Noise of the start: Fixman, J. Chem. Phys. 69 (1978)
//! 1527. Drift: Hutter and Ottinger, J. Chem. Soc. Faraday Trans. 94 (1998) 1403.

use crate::friction::Velocities;
use crate::progress::Progress;
use crate::stress::{Added, Stresses};
use crate::{Flow, Friction};
use actin_equilibrium::{ImplicitSolver, Layout, SolveError, StepSize};
use actin_integrate::{Body, FailureKind, Noise, StepFailure, Stepper};
use actin_mechanics::{Loads, Split, State, System, Thermostat, Vector3, Vectors, rotation};
use thiserror::Error;

/// Parts the key of this noise from other uses of the same seed.
const PURPOSE: [u8; 8] = *b"brownian";

/// Midpoint steps at the start that are implicit altogether.
const DAMPED_STEPS: u64 = 4;

/// Longest turn (rad) that one iteration may ask for.
const LARGEST_TURN: f64 = 0.5;

/// How often a step that is not solved is halved.
const HALVINGS: u32 = 8;

/// Streams of noise of one step: one for each part of it.
const PARTS: u64 = 1 << (HALVINGS + 1);

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
            displacement: 1e-3,
            rotation: 1e-4,
            iterations: 60,
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

impl BrownianError {
    /// Refuses a thermal energy (pN nm) that is none.
    pub(crate) fn check_thermal_energy(thermal_energy: f64) -> Result<(), Self> {
        if thermal_energy.is_finite() && thermal_energy >= 0.0 {
            Ok(())
        } else {
            Err(Self::ThermalEnergy(thermal_energy))
        }
    }
}

/// Makes overdamped steps of one system.
///
/// The noise is a function of the seed, the number of the step and the index of the dashpot.
#[derive(Debug)]
pub struct Brownian {
    friction: Friction,
    flow: Flow,
    thermal_energy: f64,
    limits: StepLimits,
    solver: ImplicitSolver,
    noise: Noise,
    stresses: Stresses,
    /// Whether steps are those with random stress.
    has_stress: bool,
    /// Frames whose turns about their own axes couple to twist and friction alone.
    axial: Vec<usize>,
    /// Turn of each of these frames about its axis since the start of a step (rad); zero of others.
    spins: Vec<f64>,
    progress: Progress,
    start: State,
    /// Loads at the start, where heat is booked.
    before: Loads,
    /// The frames half way through a step with random stress.
    middle: State,
    /// The noise of friction in a step with random stress.
    random: Loads,
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
        BrownianError::check_thermal_energy(thermal_energy)?;
        ImplicitSolver::check(system.interactions())?;
        let state = system.state();
        let loads = Loads::zeros(state);
        let stresses = Stresses::new(system.interactions(), seed);
        let has_stress = thermal_energy > 0.0;
        let mut solver = ImplicitSolver::new(layout.with_conjugate_gradients());
        solver.factorize((state, &loads), system.interactions(), &friction.times(1.0));
        let elements = (friction.dashpots.len(), friction.turns.len());
        Ok(Self {
            noise: Noise::of_purpose(PURPOSE, seed, elements),
            stresses,
            has_stress,
            spins: vec![0.0; state.frames.len()],
            progress: Progress::default(),
            axial: Vec::new(),
            velocities: Velocities {
                points: Vectors::zeros(state.points.len()),
                frames: Vectors::zeros(state.frames.len()),
            },
            friction,
            flow: Flow::default(),
            thermal_energy,
            limits: StepLimits::default(),
            solver,
            start: state.clone(),
            middle: state.clone(),
            random: loads.clone(),
            before: loads.clone(),
            residual: loads.clone(),
            loads,
            iterations: 0,
        })
    }

    /// The same by midpoint steps: for elements whose strains are far from linear in thermal motion.
    #[must_use]
    pub fn by_midpoints(self) -> Self {
        Self {
            has_stress: false,
            ..self
        }
    }

    /// Lets frames of rods that are isotropic about their axes spin without effect on other unknowns. Frames must be bare: without
    /// bodies attached off their axes. A rod spins if all its frames are bare.
    #[must_use]
    pub fn with_spinning_frames(
        mut self,
        system: &System,
        is_bare: impl Fn(usize) -> bool,
    ) -> Self {
        self.axial = self.stresses.let_spin(system.interactions(), is_bare);
        self.solver.let_spin(&self.axial);
        self
    }

    /// The same in a fluid that flows. Steps have to be short against the inverse of the velocity gradient.
    #[must_use]
    pub fn in_flow(self, flow: Flow) -> Self {
        Self { flow, ..self }
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

    /// Begins a step of a time `h` here: half of the work of what is driven is booked at each end of it, where a ledger is
    /// kept.
    fn begin(&mut self, system: &mut System, h: f64) {
        self.start.copy_motion_from(system.state());
        if self.books_heat(system) {
            self.before.clone_from(system.loads());
        }
        system.book_work(0.5 * h);
    }

    /// Books what comes from outside in a step that has been made.
    fn book(&self, system: &mut System, h: f64) {
        system.book_work(0.5 * h);
        if self.books_heat(system) {
            system.book_overdamped_heat((&self.start, &self.before));
        }
    }

    /// Whether heat is booked: not with noise. What relaxes within a step then takes and gives about kT in each, so that a
    /// thousandth that the mean of two loads misses would add up to more than all else.
    fn books_heat(&self, system: &System) -> bool {
        system.keeps_ledger() && self.thermal_energy == 0.0
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
            self.find_velocities(state, h, 1.0);
            self.residual.clone_from(&self.loads);
            self.friction
                .add_loads(state, &self.velocities, &mut self.residual);
            let noise = (&self.noise.points, &self.noise.frames);
            self.friction
                .add_noise(state, strength, noise, &mut self.residual);
            let friction = self.friction.times(1.0 / h);
            let at = (state, &self.loads);
            self.solver.factorize(at, system.interactions(), &friction);
            let state = system.state_mut();
            extent = self.solver.advance(state, &self.residual, LARGEST_TURN);
            if self.limits.hold(&extent) {
                return Ok(());
            }
        }
        Err(self.failure(system, &extent))
    }

    /// The same with random stress; friction is that half way.
    fn solve_stressed(&mut self, system: &mut System, h: f64) -> Result<(), StepFailure> {
        let strength = (2.0 * self.thermal_energy / h).sqrt();
        let noise = (&self.noise.points, &self.noise.frames);
        self.random.clear();
        self.friction
            .add_noise(&self.start, strength, noise, &mut self.random);
        let mut extent = StepSize::default();
        self.progress = Progress::default();
        for _ in 0..self.limits.iterations {
            self.iterations += 1;
            self.loads.clone_from(system.loads());
            let (state, interactions) = (system.state(), system.interactions());
            self.find_middle(state);
            self.find_velocities(state, h, 0.5);
            self.residual.clone_from(&self.loads);
            for &i in &self.axial {
                self.spins[i] = spin(&self.start, state, i);
            }
            self.stresses.turn_back(interactions, &self.spins);
            self.stresses
                .add_loads(interactions, state, &mut self.residual);
            self.residual.add(&self.random);
            self.friction
                .add_loads(&self.middle, &self.velocities, &mut self.residual);
            let is_found = self.find_step(system, self.progress.friction() / h);
            extent = self.solver.advance_along(system.state_mut(), LARGEST_TURN);
            if self.progress.is_solved(extent, &self.limits) && is_found {
                return Ok(());
            }
        }
        Err(self.failure(system, &extent))
    }

    /// A step with random stress; one that is not solved goes in two halves, each with noise of its own, which are parts `2 part`
    /// and `2 part + 1` of the step.
    fn step_stressed(
        &mut self,
        system: &mut System,
        (step, part): (u64, u64),
        h: f64,
    ) -> Result<(), StepFailure> {
        let stream = step * PARTS + part;
        self.begin(system, h);
        self.noise.draw_stream(stream, (1.0, 1.0));
        self.stresses.draw(
            system.interactions(),
            &self.start,
            (self.thermal_energy, stream),
        );
        system.drift(h);
        let solved = self.solve_stressed(system, h);
        if solved.is_ok() {
            self.book(system, h);
        }
        if solved.is_ok() || 2 * part >= PARTS {
            return solved;
        }
        let start = self.start.clone();
        system.state_mut().copy_motion_from(&start);
        self.step_stressed(system, (step, 2 * part), 0.5 * h)?;
        self.step_stressed(system, (step, 2 * part + 1), 0.5 * h)
    }

    /// A step without noise; one that is not solved goes in two halves. `parts` is how many of it make up the whole step.
    fn step_without_noise(
        &mut self,
        system: &mut System,
        parts: u64,
        h: f64,
    ) -> Result<(), StepFailure> {
        self.begin(system, h);
        let start = self.start.clone();
        // Solves go back to the start, without losing the work booked there.
        self.start.controls.copy_from(&system.state().controls);
        let solved = self.solve_extrapolated(system, h);
        self.start.copy_motion_from(&start);
        if solved.is_ok() {
            self.book(system, h);
        }
        if solved.is_ok() || 2 * parts >= PARTS {
            return solved;
        }
        system.state_mut().copy_motion_from(&start);
        self.step_without_noise(system, 2 * parts, 0.5 * h)?;
        self.step_without_noise(system, 2 * parts, 0.5 * h)
    }

    /// An implicit step and two over its halves, extrapolated.
    fn solve_extrapolated(&mut self, system: &mut System, h: f64) -> Result<(), StepFailure> {
        system.drift(h);
        self.solve(system, h, h)?;
        self.middle.copy_motion_from(system.state());
        system.state_mut().copy_motion_from(&self.start);
        for _ in 0..2 {
            self.start.copy_motion_from(system.state());
            system.drift(0.5 * h);
            self.solve(system, 0.5 * h, 0.5 * h)?;
        }
        self.solver.go_on(&self.middle, system.state_mut());
        Ok(())
    }

    /// A midpoint step; the first ones are implicit altogether.
    fn step_by_midpoints(
        &mut self,
        system: &mut System,
        step: u64,
        h: f64,
    ) -> Result<(), StepFailure> {
        self.begin(system, h);
        self.noise.draw_stream(step, (1.0, 1.0));
        if step < DAMPED_STEPS {
            system.drift(h);
            self.solve(system, h, h)?;
        } else {
            system.drift(0.5 * h);
            self.solve(system, 0.5 * h, h)?;
            self.solver.go_on(&self.start, system.state_mut());
            system.drift(0.5 * h);
        }
        self.book(system, h);
        Ok(())
    }

    /// Finds the step of an iteration with the stiffness, what stresses add and friction times `factor`. Chains whose
    /// stiffness is not positive definite, and all in the first iteration, are without what forces add to it. Returns false if
    /// the equations are not solved.
    fn find_step(&mut self, system: &System, factor: f64) -> bool {
        let (state, interactions) = (system.state(), system.interactions());
        let friction = self.friction.times(factor).in_axes_of(&self.middle);
        self.stresses.balance_all(self.progress.is_first());
        loop {
            self.stresses.find_balance(interactions, state);
            let added = Added {
                friction,
                interactions,
                stresses: &self.stresses,
            };
            let at = (state, &self.loads);
            let is_positive = self.solver.factorize(at, interactions, &added);
            let worst = if is_positive {
                if self.solver.find_step(state, &self.residual) {
                    return true;
                }
                Vec::new()
            } else {
                self.solver.indefinite_frames()
            };
            if !self.stresses.balance_more(interactions, &worst) {
                return self.solver.find_step(state, &self.residual);
            }
        }
    }

    fn failure(&self, system: &System, extent: &StepSize) -> StepFailure {
        StepFailure {
            problem: FailureKind::NotConverged(extent.displacement),
            body: self.worst(system.state()),
        }
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

    /// Frames half way to `state`.
    fn find_middle(&mut self, state: &State) {
        for i in 0..state.frames.len() {
            let half = rotation::exp(turn(&self.start, state, i) * 0.5);
            let middle = self.start.frames.orientation.get(i) * half;
            self.middle.frames.orientation.set(i, middle);
        }
    }

    /// Velocities over a time `h` from the start to `state`, less those of the fluid at the share `way` of it.
    fn find_velocities(&mut self, state: &State, h: f64, way: f64) {
        let (start, velocities) = (&self.start, &mut self.velocities);
        let flows = self.flow != Flow::default();
        for i in 0..state.points.len() {
            let from = start.points.position.get(i);
            let moved = state.points.position.get(i) - from;
            let fluid = self.flow.velocity_at(from + moved * way);
            velocities.points.set(i, moved / h - fluid);
        }
        for i in 0..state.frames.len() {
            let turned = turn(start, state, i);
            let mut velocity = turned / h;
            if flows {
                let q = start.frames.orientation.get(i) * rotation::exp(turned * way);
                velocity -= self.flow.turning(q);
            }
            velocities.frames.set(i, velocity);
        }
    }
}

/// Turn of frame `i` from one state of a step to another (rad, body frame), up to a whole turn: quaternions change continuously
/// within a step, so that their signs tell a turn from its complement.
fn turn(from: &State, to: &State, i: usize) -> Vector3 {
    let q = from.frames.orientation.get(i).inverse() * to.frames.orientation.get(i);
    if q.w >= 0.0 {
        return rotation::log(q);
    }
    let sine = q.imag().norm();
    q.imag() * (2.0 * sine.atan2(q.w) / sine)
}

/// The turn of frame `i` about its third axis from one state to another (rad).
fn spin(from: &State, to: &State, i: usize) -> f64 {
    let q = from.frames.orientation.get(i).inverse() * to.frames.orientation.get(i);
    2.0 * q.k.atan2(q.w)
}

impl StepLimits {
    pub(crate) fn hold(&self, extent: &StepSize) -> bool {
        extent.displacement <= self.displacement && extent.rotation <= self.rotation
    }
}

impl Stepper for Brownian {
    fn step(&mut self, system: &mut System, step: u64, h: f64) -> Result<(), StepFailure> {
        // What is driven goes on to the place of its time; free bodies have no velocity.
        if self.thermal_energy == 0.0 {
            self.step_without_noise(system, 1, h)?;
        } else if self.has_stress {
            self.step_stressed(system, (step, 1), h)?;
        } else {
            self.step_by_midpoints(system, step, h)?;
        }
        if system.has_step_end() {
            system.end_step(step + 1, h);
        }
        Ok(())
    }
}

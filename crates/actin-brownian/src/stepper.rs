//! Overdamped steps that are implicit in the stiffness.
//!
//! # Equation of motion
//! ```text
//! Z v = f + sqrt(2 kT) B xi,   B B^T = Z
//! ```
//!
//! `Z(q)` is the friction, `f(q)` are the loads, and `v` are the velocities of points (lab frame)
//! and the angular velocities of frames (body axes). With these frictions and Stratonovich noise,
//! the Boltzmann distribution is stationary without a drift term. A dashpot with an arm must be the
//! only dashpot of its point, or have the same frame as the others.
//!
//! # Steps with random stress
//! ```text
//! Z(q_m) d / h = f(q_1) + sqrt(2 kT / h) B(q_0) xi + sum_e (de/dq)(q_1)^T s_e
//! ```
//!
//! `d` are the displacements and rotations from `q_0` to `q_1` in the time `h`, and `q_m` contains
//! the frames at half the step. `s_e` is a random stress of an element with strain `e`, of
//! covariance `kT C` for its stiffness `C` (see [`RandomStress`](actin_mechanics::RandomStress)). A
//! linear mode `f = -k x` with `z = k h / zeta` becomes
//!
//! ```text
//! x_1 = x_0 / (1 + z) + noise of variance (kT / k) (2 z + z^2) / (1 + z)^2
//! ```
//!
//! The variance is `kT/k` for any step; `2 z` is due to friction and `z^2` due to stress. The decay
//! rate of the correlation is too small by a factor of about `1 - z/2`. The random stress acts on
//! strains only and does not spin rods about their axes. Steps can be thousands of times longer
//! than the relaxation of stretch and shear.
//!
//! Means are exact in the limit of steps that resolve all relaxations. In long steps they are exact
//! for independent strains; otherwise their error is of first order in `h`. Interactions without
//! random stress (loads, contacts) need steps that resolve their relaxation.
//!
//! The friction is evaluated at half the step and its noise at the start (Fixman). This choice
//! includes the drift due to shape-dependent mobility of stiff elements.
//!
//! # Solution
//! Newton's method uses the matrix `K + Z/h` plus the contribution of the stresses. The first
//! iteration omits the geometric stiffness, the second one omits it for springs, and later ones omit
//! it in components, such as rods, whose matrix is not positive definite. Friction is added to a component if its
//! iterations grow. A component counts as solved if its next iteration is predicted to change the
//! energy by less than 1e-4 kT, and the loads confirm it. If at most half of the components are unsolved, only
//! these are iterated and the others are held. A step ends with an iteration of all components.
//!
//! With springs between components that are stiff compared with `Z/h`, the equations may have further solutions far
//! from the start. A step is halved if its displacement exceeds three times the displacement of its
//! first iteration.
//!
//! Rods that are isotropic about their axes spin by a radian in steps of microseconds, and by many
//! turns in steps of milliseconds. Energies do not depend on this spin, and the matrix does not
//! couple it to other unknowns ([`Brownian::with_spinning_frames`]). Linked chains are solved by
//! conjugate gradients if this is cheaper than a factorisation of the whole matrix. The
//! preconditioner consists of the factors of the single chains.
//!
//! # Accuracy
//! The table lists the mean of `1 - cos(angle)` between segments of free rods, relative to its
//! exact value. The last two columns are for segments at a distance of one and ten segments. Each
//! row is from 400,000 steps (`cargo test --release -p actin-brownian --test integration
//! long_waves:: -- --ignored --nocapture`):
//!
//! | segments | step (ns) | one segment | ten segments |
//! | --- | --- | --- | --- |
//! | 12 of 40 nm | 100 | 0.9995 +- 0.0012 | 0.9846 +- 0.0080 |
//! | 12 of 40 nm | 300 | 0.9996 +- 0.0008 | 0.9958 +- 0.0049 |
//! | 12 of 40 nm | 1000 | 0.9988 +- 0.0006 | 0.9956 +- 0.0031 |
//! | 25 of 40 nm | 300 | 1.0019 +- 0.0015 | 0.9997 +- 0.0152 |
//! | 25 of 40 nm | 1389 | 0.9994 +- 0.0009 | 0.9892 +- 0.0091 |
//! | 12 of 100 nm | 4000 | 1.0013 +- 0.0012 | 0.9949 +- 0.0094 |
//! | 2 of 400 nm | 1.84e6 | 0.9737 +- 0.0019 | |
//! | 12 of 400 nm | 1.84e6 | 1.0001 +- 0.0011 | 1.0054 +- 0.0060 |
//! | 12 of 400 nm | 6.1e4 | 1.0274 +- 0.0056 | 0.9839 +- 0.0367 |
//! | 2 of 1000 nm | 7.2e7 | 0.9439 +- 0.0017 | |
//! | 12 of 1000 nm | 7.2e7 | 0.9927 +- 0.0013 | 1.0031 +- 0.0061 |
//! | 12 of 1000 nm | 2.4e6 | 1.0323 +- 0.0046 | 1.0090 +- 0.0246 |
//!
//! Segments above a fiftieth of the persistence length (200 nm) have errors of up to 0.6 times this
//! ratio. In shorter steps, rods of many such segments bend too far by the same order, because
//! steps that resolve bending but not stretch and twist sample rods in which these are rigid.
//! For constant mobility `M`, the density of states then has the factor `sqrt(det(J M J^T))`,
//! with the derivatives `J` of stretches and twists. Two segments of 1000 nm with isotropic friction
//! have 1.0247 +- 0.0022 in steps of 2e5 ns; this factor gives 1.0195 (test
//! `stretch_and_twist_are_rigid_in_long_steps` in the same module).
//!
//! # Steps without noise
//! Richardson extrapolation, in body axes, from one implicit step over `h` and two implicit steps
//! over `h/2`. An implicit step over `h` solves `Z(q_1) d / h = f(q_1)`. The order is two. A mode
//! with `z = k h / zeta` is multiplied by `2/(1 + z/2)^2 - 1/(1 + z)`, so that stiff modes relax in
//! one step. A step that does not converge is halved.
//!
//! # Midpoint steps
//! The optional implicit midpoint rule with noise, in body axes: `d` are displacements and
//! rotations over half the step, `q_m = q_0 exp(d)` and `q_1 = q_m exp(d)`.
//!
//! ```text
//! Z(q_m) 2 d / h = f(q_m) + sqrt(2 kT / h) B(q_m) xi
//! ```
//!
//! Linear modes have the variance `kT/k` at any step. Modes that relax faster than a step alternate
//! in sign. For segments of 40 nm, the energy of stretch and shear is 0.2 % too large in steps of
//! 0.3 ns. In steps of 1 ns it is 8.6 % too large. The first steps are fully implicit to damp
//! initial imbalances.
//!
//! # Source
//! Implicit steps at the start: Rannacher, Numer. Math. 43 (1984) 309. Noise of the start: Fixman,
//! J. Chem. Phys. 69 (1978) 1527. Drift: Hutter and Ottinger, J. Chem. Soc. Faraday Trans. 94
//! (1998) 1403.

mod stressed;
mod turn;

use turn::Turn;

use crate::components::{Components, couples_by_distance};
use crate::friction::Velocities;
use crate::progress::Progress;
use crate::stress::Stresses;
use crate::{Flow, Friction, StepLimits};
use actin_equilibrium::{ImplicitSolver, Layout, SolveError, StepSize};
use actin_integrate::{Body, FailureKind, Noise, StepFailure, Stepper};
use actin_mechanics::{Coordinates, Loads, Split, State, System, Thermostat};
use thiserror::Error;

/// Separates this noise from other uses of the same seed.
const PURPOSE: [u8; 8] = *b"brownian";

/// Number of fully implicit steps before midpoint steps.
const DAMPED_STEPS: u64 = 4;

/// Largest rotation (rad) of an iteration.
const LARGEST_TURN: f64 = 0.5;

/// Largest number of successive halvings of a step.
const HALVINGS: u32 = 8;

/// Streams of noise per step: one for each part.
const PARTS: u64 = 1 << (HALVINGS + 1);

/// Error of the construction of a stepper.
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
    pub(crate) fn check_thermal_energy(thermal_energy: f64) -> Result<(), Self> {
        if thermal_energy.is_finite() && thermal_energy >= 0.0 {
            Ok(())
        } else {
            Err(Self::ThermalEnergy(thermal_energy))
        }
    }
}

/// Stepper of overdamped motion.
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
    /// `true` if the steps include random stress.
    has_stress: bool,
    /// `true` for frames with free spin about their own axes.
    is_axial: Vec<bool>,
    /// Spin of these frames since the start of a step (rad); zero for others.
    spins: Vec<f64>,
    progress: Progress,
    components: Components,
    start: State,
    /// Loads at the start, for the heat.
    before: Loads,
    /// Frames at half the step.
    middle: State,
    /// Random loads of the friction.
    random: Loads,
    loads: Loads,
    residual: Loads,
    velocities: Velocities,
    iterations: u64,
}

impl Brownian {
    /// Creates a stepper for the unknowns `layout` of `system`, with `friction` and the thermal
    /// energy `kT` (pN nm). Zero thermal energy disables the noise. An unspecified order of
    /// unknowns is derived from the present state.
    ///
    /// # Errors
    /// If an interaction has no potential or no second derivatives, or the thermal energy is
    /// invalid.
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
        let mut interactions = system.interactions().iter();
        let has_contacts =
            interactions.any(|interaction| couples_by_distance(interaction.as_ref()));
        let mut solver = ImplicitSolver::new(if has_contacts {
            layout.with_changing_links()
        } else {
            layout.with_conjugate_gradients()
        });
        solver.factorize(state, system.interactions(), &friction.times(1.0));
        let elements = (friction.dashpots.len(), friction.turns.len());
        Ok(Self {
            noise: Noise::with_purpose(PURPOSE, seed, elements),
            stresses,
            has_stress,
            spins: vec![0.0; state.frames.len()],
            components: Components::new(&solver, system.interactions(), state, &friction),
            progress: Progress::default(),
            is_axial: vec![false; state.frames.len()],
            velocities: Velocities::zeros(state),
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

    /// Selects midpoint steps, for elements whose energy is far from quadratic in thermal motion.
    #[must_use]
    pub fn with_midpoint_steps(self) -> Self {
        Self {
            has_stress: false,
            ..self
        }
    }

    /// Decouples the spin of rods that are isotropic about their axes from their other motion in the
    /// matrix of the steps. A rod spins freely if all its frames are bare, that is, without other
    /// bodies attached off their axes. Springs at sites off the axis do not prevent spins.
    #[must_use]
    pub fn with_spinning_frames(
        mut self,
        system: &System,
        is_bare: impl Fn(usize) -> bool,
    ) -> Self {
        let axial = self.stresses.decouple_spins(system.interactions(), is_bare);
        for &i in &axial {
            self.is_axial[i] = true;
        }
        self.solver.set_spinning_frames(&axial);
        self
    }

    /// Sets the flow of the fluid. Steps must be short compared with the inverse velocity gradient.
    #[must_use]
    pub fn in_flow(self, flow: Flow) -> Self {
        Self { flow, ..self }
    }

    /// Sets the convergence limits.
    #[must_use]
    pub fn with_limits(self, limits: StepLimits) -> Self {
        Self { limits, ..self }
    }

    /// Number of iterations of all steps, each with a factorisation.
    pub fn iterations(&self) -> u64 {
        self.iterations
    }

    /// Saves the start of a step and adds half of the work of driven bodies to the energy balance.
    fn begin(&mut self, system: &mut System, h: f64) {
        self.start.copy_motion_from(system.state());
        if self.books_heat(system) {
            self.before.clone_from(system.loads());
        }
        system.record_work(0.5 * h);
    }

    fn book(&self, system: &mut System, h: f64) {
        system.record_work(0.5 * h);
        if self.books_heat(system) {
            system.record_overdamped_heat((&self.start, &self.before));
        }
    }

    /// Returns `true` if heat is recorded. With noise it is not recorded: modes that relax within a
    /// step exchange about kT per step, and a relative error of a thousandth would dominate the
    /// energy balance.
    fn books_heat(&self, system: &System) -> bool {
        system.tracks_energy_balance() && self.thermal_energy == 0.0
    }

    /// Solves the implicit step of time `h` from `self.start`, with the noise of a step of time
    /// `of`. Loads, friction and noise are taken at the end.
    fn solve(&mut self, system: &mut System, h: f64, of: f64) -> Result<(), StepFailure> {
        let strength = (2.0 * self.thermal_energy / of).sqrt();
        let mut extent = StepSize::default();
        for _ in 0..self.limits.iterations {
            self.iterations += 1;
            self.loads.clone_from(system.loads());
            let state = system.state();
            self.find_velocities(state, h);
            self.residual.clone_from(&self.loads);
            let flow = self.flow.between(&self.start, state);
            let at = (state, &self.velocities, &flow);
            self.friction.add_loads(at, |_| true, &mut self.residual);
            let noise = (&self.noise.points, &self.noise.frames);
            self.friction
                .add_noise(state, strength, noise, &mut self.residual);
            let friction = self.friction.times(1.0 / h);
            self.solver
                .factorize(state, system.interactions(), &friction);
            let state = system.state_mut();
            extent = self.solver.advance(state, &self.residual, LARGEST_TURN);
            if self.limits.hold(&extent) {
                return Ok(());
            }
        }
        Err(self.failure(system, &extent))
    }

    /// Makes a step with random stress. A step that does not converge is halved; the halves have
    /// the numbers `2 part` and `2 part + 1` and separate noise.
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
        let solved = self
            .check_driven(system)
            .and_then(|()| self.solve_stressed(system, h));
        if solved.is_ok() {
            self.book(system, h);
            let (state, interactions) = system.state_mut_and_interactions();
            self.stresses.record(interactions, state);
        }
        if solved.is_ok() || 2 * part >= PARTS {
            return solved;
        }
        let start = self.start.clone();
        system.state_mut().copy_motion_from(&start);
        self.step_stressed(system, (step, 2 * part), 0.5 * h)?;
        self.step_stressed(system, (step, 2 * part + 1), 0.5 * h)
    }

    /// Fails if driven bodies move through others at once.
    fn check_driven(&self, system: &System) -> Result<(), StepFailure> {
        let state = system.state();
        let mut interactions = system.interactions().iter();
        match interactions.find_map(|one| one.passes_through(&self.start, state)) {
            None => Ok(()),
            Some(body) => Err(StepFailure {
                problem: FailureKind::PassesThrough,
                body: match body {
                    Coordinates::Point(i) => Body::Point(i),
                    Coordinates::Frame(i) => Body::Frame(i),
                },
            }),
        }
    }

    /// Makes a step without noise, one of `parts` equal parts of the whole step. A step that does
    /// not converge is halved.
    fn step_without_noise(
        &mut self,
        system: &mut System,
        parts: u64,
        h: f64,
    ) -> Result<(), StepFailure> {
        self.begin(system, h);
        let start = self.start.clone();
        // Restarts must keep the work recorded in the controls.
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
        self.solver.repeat_motion(&self.middle, system.state_mut());
        Ok(())
    }

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
            self.solver.repeat_motion(&self.start, system.state_mut());
            system.drift(0.5 * h);
        }
        self.book(system, h);
        Ok(())
    }

    fn failure(&self, system: &System, extent: &StepSize) -> StepFailure {
        StepFailure {
            problem: FailureKind::NotConverged(extent.displacement),
            body: self.worst(system.state()),
        }
    }

    fn worst(&self, state: &State) -> Body {
        let moved = self.moved(state).into_iter().enumerate();
        let worst = moved.max_by(|(_, a), (_, b)| a.total_cmp(b));
        worst.map_or(Body::Frame(0), |(i, _)| Body::Point(i))
    }

    /// Displacements of points since the start of the step (nm), infinite if not finite.
    fn moved(&self, state: &State) -> Vec<f64> {
        let (start, end) = (&self.start.points.position, &state.points.position);
        let moved = end
            .iter()
            .zip(start.iter())
            .map(|(x, from)| (x - from).norm());
        moved
            .map(|d| if d.is_finite() { d } else { f64::INFINITY })
            .collect()
    }

    /// Velocities relative to the fluid at the end of a motion from the start to `state` over a
    /// time `h`.
    fn find_velocities(&mut self, state: &State, h: f64) {
        self.find_velocities_of_points(state, h, 1.0);
        let flow = self.flow.between(&self.start, state);
        for i in 0..state.frames.len() {
            let turn = Turn::between(&self.start, state, i);
            let fluid = flow.turning(state.frames.orientation.get(i));
            self.velocities.frames.set(i, turn.vector / h - fluid);
        }
    }

    /// Velocities relative to the fluid at half of a motion from the start to `state` over a time
    /// `h`, and the frames at this place.
    fn find_velocities_at_middle(&mut self, state: &State, h: f64) {
        self.find_velocities_of_points(state, h, 0.5);
        let flow = self.flow.between(&self.start, state);
        let components = &self.components;
        for i in (0..state.frames.len()).filter(|&i| components.has_frame(i)) {
            let turn = if self.is_axial[i] {
                let turn = Turn::with_spin(&self.start, state, i, self.spins[i]);
                self.spins[i] = turn.vector.z;
                turn
            } else {
                Turn::between(&self.start, state, i)
            };
            let velocity = turn.vector / h - flow.turning(turn.middle);
            let frames = &mut self.velocities.frames;
            frames.set(i, turn.in_axes_of_end(velocity));
            self.middle.frames.orientation.set(i, turn.middle);
        }
    }

    /// The velocity of the fluid is taken at the fraction `way` of the displacement.
    fn find_velocities_of_points(&mut self, state: &State, h: f64, way: f64) {
        let (start, components) = (&self.start, &self.components);
        let flow = self.flow.between(start, state);
        for i in (0..state.points.len()).filter(|&i| components.has_point(i)) {
            let from = start.points.position.get(i);
            let moved = state.points.position.get(i) - from;
            let fluid = flow.velocity_at(from + moved * way);
            self.velocities.points.set(i, moved / h - fluid);
        }
    }
}

impl Stepper for Brownian {
    fn step(&mut self, system: &mut System, step: u64, h: f64) -> Result<(), StepFailure> {
        // Driven bodies move to their position at the end of the step; free bodies have no
        // velocity.
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

    fn prevents_crossings(&self) -> bool {
        self.thermal_energy > 0.0 && self.has_stress
    }
}

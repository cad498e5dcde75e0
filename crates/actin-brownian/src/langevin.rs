use crate::friction::{ScaledFriction, Velocities};
use crate::{BrownianError, Flow, Friction};
use actin_equilibrium::{ImplicitSolver, Layout};
use actin_integrate::{Noise, StepFailure, Stepper};
use actin_mechanics::{
    Coordinates, Loads, Matrix3, SecondOrder, Split, State, Stiffness, System, Thermostat, Vectors,
};

/// Separates this noise from other uses of the same seed.
const PURPOSE: [u8; 8] = *b"langevin";

/// Stepper of motion with inertia and friction, with or without thermal noise.
///
/// A step of time `h` consists of a kick over `h/2`, a drift over `h/2`, friction, a drift and a
/// kick. With the inertia `M` and the friction `Z` at half the step, friction and noise change the
/// velocities `v` to `v'`:
///
/// ```text
/// (M + h Z/2) v' = (M - h Z/2) v + sqrt(2 kT h) B xi,   B B^T = Z
/// ```
///
/// This preserves the Maxwell distribution. For constant `Z` and any `h Z/M`, the velocity `F/Z`
/// under a constant load `F`, the diffusion coefficient `kT/Z` and the mean energy `kT/2` of linear
/// modes are exact. Steps are stable below 2 over the largest frequency. Velocities alternate in
/// sign for `h Z/M > 2`.
///
/// The noise is a function of the seed, the number of the step and the index of the dashpot.
///
/// # Source
/// Gronbech-Jensen and Farago, Mol. Phys. 111 (2013) 983, with a friction matrix.
#[derive(Debug)]
pub struct Langevin {
    friction: Friction,
    thermal_energy: f64,
    noise: Noise,
    solver: ImplicitSolver,
    velocities: Velocities,
    loads: Loads,
}

impl Langevin {
    /// Creates a stepper for the unknowns `layout` of `system`, with the thermal energy (pN nm) and
    /// the seed of the noise. Zero thermal energy disables the noise.
    ///
    /// # Errors
    /// If the thermal energy is invalid.
    pub fn new(
        system: &System,
        layout: Layout,
        friction: Friction,
        (thermal_energy, seed): (f64, u64),
    ) -> Result<Self, BrownianError> {
        BrownianError::check_thermal_energy(thermal_energy)?;
        let state = system.state();
        let loads = Loads::zeros(state);
        let mut solver = ImplicitSolver::new(layout);
        // Determines the order of unknowns.
        let step = 1.0;
        solver.factorize(state, &[], &Resistance::new(&friction, step));
        Ok(Self {
            noise: Noise::with_purpose(
                PURPOSE,
                seed,
                (friction.dashpots.len(), friction.turns.len()),
            ),
            velocities: Velocities::zeros(state),
            friction,
            thermal_energy,
            solver,
            loads,
        })
    }

    fn rub(&mut self, system: &mut System, step: u64, h: f64) {
        let state = system.state();
        self.velocities.points.clone_from(&state.points.velocity);
        for i in 0..state.frames.len() {
            let l = state.frames.angular_momentum.get(i);
            let omega = state.frames.angular_velocity(i, l);
            self.velocities.frames.set(i, omega);
        }
        self.loads.clear();
        self.friction.add_loads(
            (state, &self.velocities, &Flow::default()),
            |_| true,
            &mut self.loads,
        );
        if self.thermal_energy > 0.0 {
            let strength = (2.0 * self.thermal_energy / h).sqrt();
            self.noise.draw_stream(step, (1.0, 1.0));
            let noise = (&self.noise.points, &self.noise.frames);
            self.friction
                .add_noise(state, strength, noise, &mut self.loads);
        }
        let resistance = Resistance::new(&self.friction, h);
        self.solver.factorize(state, &[], &resistance);
        let (points, frames) = self.solver.velocities(state, &self.loads);
        add(system.state_mut(), &points, &frames);
    }
}

fn add(state: &mut State, points: &Vectors, frames: &Vectors) {
    for (i, gain) in points.iter().enumerate() {
        state.points.velocity.add(i, gain);
    }
    for (i, gain) in frames.iter().enumerate() {
        let gain = gain.component_div(&state.frames.inverse_moments(i));
        state.frames.angular_momentum.add(i, gain);
    }
}

impl Stepper for Langevin {
    fn step(&mut self, system: &mut System, step: u64, h: f64) -> Result<(), StepFailure> {
        system.kick(0.5 * h, 0.5 * h);
        system.record_work(0.5 * h);
        system.drift(0.5 * h);
        let before = system.kinetic_energies();
        self.rub(system, step, h);
        if let (Some(before), Some(after)) = (before, system.kinetic_energies()) {
            system.record_heat(after.0 + after.1 - before.0 - before.1);
        }
        system.drift(0.5 * h);
        system.kick(0.5 * h, 0.5 * h);
        system.record_work(0.5 * h);
        if system.has_step_end() {
            system.end_step(step + 1, h);
        }
        Ok(())
    }
}

struct Resistance<'a> {
    friction: ScaledFriction<'a>,
    h: f64,
}

impl<'a> Resistance<'a> {
    fn new(friction: &'a Friction, h: f64) -> Self {
        Self {
            friction: friction.times(0.5),
            h,
        }
    }
}

impl SecondOrder for Resistance<'_> {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        use Coordinates::{Frame, Point};
        self.friction.add_stiffness(state, stiffness);
        let of_mass = |mass: f64| Matrix3::from_diagonal_element(mass / self.h);
        let points = (0..state.points.len()).filter(|&i| state.points.is_free(i));
        for i in points {
            stiffness.push(Point(i), Point(i), of_mass(state.points.mass(i)));
        }
        // The mass of a slider replaces the masses of its points.
        for slider in state.sliders.iter() {
            let share = slider.mass / slider.points.len() as f64;
            for &i in &slider.points {
                stiffness.push(Point(i), Point(i), of_mass(share));
            }
        }
        for i in 0..state.frames.len() {
            let moments = state.frames.inverse_moments(i).map(f64::recip);
            let of_frame = Matrix3::from_diagonal(&(moments / self.h));
            stiffness.push(Frame(i), Frame(i), of_frame);
        }
    }
}

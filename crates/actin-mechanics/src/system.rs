//! A state with its interactions, split into drift and kick.

use crate::energy_balance::work_on_free;
use crate::{Drive, EnergyBalance, Interaction, Loads, Motion, Residual, State, Vectors};
use std::sync::Arc;

/// Interface between integrators and systems.
///
/// A wrapper that supports an [`EnergyBalance`] must also forward `record_work`, `kinetic_energies` and
/// `record_heat`.
pub trait Split {
    /// Moves all bodies freely for a time `h`, which may be negative.
    fn drift(&mut self, h: f64);

    /// Applies the forces for a time `translation` and the torques for a time `rotation`, at the
    /// present positions. Both times may be negative.
    fn kick(&mut self, translation: f64, rotation: f64);

    /// Multiplies velocities by `translational` and angular momenta by `rotational`.
    fn damp(&mut self, translational: f64, rotational: f64);

    /// Number of evaluations of the loads.
    fn force_evaluations(&self) -> u64;

    /// Adds the work of the drive over a time `t` at the present positions to the [`EnergyBalance`], if
    /// there is one.
    fn record_work(&mut self, _t: f64) {}

    /// Kinetic energies of free points and of free frames, or `None` without an [`EnergyBalance`].
    fn kinetic_energies(&self) -> Option<(f64, f64)> {
        None
    }

    /// Adds energy from drag or noise to the [`EnergyBalance`].
    fn record_heat(&mut self, _energy: f64) {}
}

/// Event between time steps, such as the rupture of a spring.
pub trait StepEnd: std::fmt::Debug + Send + Sync {
    /// Applies the events at the end of time step `step` (counted from 1) of length `h`, and
    /// returns `true` if loads may have changed.
    ///
    /// The result must depend on the arguments alone, because steps may be repeated.
    fn end_step(&self, state: &mut State, step: u64, h: f64) -> bool;
}

/// Interface between thermostats and systems, and events between steps.
pub trait Thermostat: Split {
    /// Numbers of points and of frames, including held ones.
    fn bodies(&self) -> (usize, usize);

    /// Adds thermal impulses, scaled to the inertia of each body.
    ///
    /// The deviates `d`, in units of the square root of an energy, are one vector per point and one
    /// per frame.
    ///
    /// ```text
    /// points:   velocity         += d / sqrt(m)         (lab frame)
    /// frames:   angular momentum += d_a sqrt(I_a)       (body axis a)
    /// sliders:  velocity along direction k += d_k / sqrt(M)
    /// ```
    ///
    /// For a slider, `d` belongs to its first point, and `M` is its mass. Held bodies receive no
    /// impulse.
    fn add_thermal_impulses(&mut self, points: &Vectors, frames: &Vectors);

    /// Returns `true` if there are events between steps, so that steps must be taken one by one.
    fn has_step_end(&self) -> bool {
        false
    }

    /// Applies the events at the end of time step `step` (counted from 1) of length `h`.
    fn end_step(&mut self, _step: u64, _h: f64) {}
}

/// A state, the interactions that act on it, and their loads.
///
/// Loads are evaluated lazily after a change of the positions.
#[derive(Debug)]
pub struct System {
    state: State,
    interactions: Arc<[Box<dyn Interaction>]>,
    loads: Loads,
    loads_are_current: bool,
    /// `true` if the state may have been changed by the caller since the last check.
    changed_outside: bool,
    force_evaluations: u64,
    drive: Option<Box<dyn Drive>>,
    step_end: Option<Box<dyn StepEnd>>,
    energy_balance: Option<EnergyBalance>,
}

impl System {
    /// Creates a system without evaluating the loads.
    ///
    /// # Panics
    /// If the arrays of the state have inconsistent lengths, or if a [`Slider`](crate::Slider) is
    /// invalid. An interaction that acts on a missing body or control panics at the first
    /// evaluation of loads or energies.
    pub fn new(state: State, interactions: Vec<Box<dyn Interaction>>) -> Self {
        Self::with_shared(state, interactions.into())
    }

    /// Creates a system that shares the interactions of `self`, in another state of the same
    /// bodies. It has no drive, no energy balance and no events between steps.
    ///
    /// # Panics
    /// See [`new`](Self::new).
    #[must_use]
    pub fn in_state(&self, state: State) -> Self {
        Self::with_shared(state, Arc::clone(&self.interactions))
    }

    fn with_shared(state: State, interactions: Arc<[Box<dyn Interaction>]>) -> Self {
        state.assert_shape();
        let loads = Loads::zeros(&state);
        Self {
            state,
            interactions,
            loads,
            loads_are_current: false,
            changed_outside: false,
            force_evaluations: 0,
            drive: None,
            step_end: None,
            energy_balance: None,
        }
    }

    /// Sets the prescribed motion of held bodies and controls, and resets the time to zero.
    pub fn set_drive(&mut self, drive: Box<dyn Drive>) {
        drive.place(&mut self.state, 0.0);
        self.loads_are_current = false;
        self.state.time = 0.0;
        self.drive = Some(drive);
    }

    /// Sets the events between steps.
    pub fn set_step_end(&mut self, step_end: Box<dyn StepEnd>) {
        self.step_end = Some(step_end);
    }

    /// Starts the energy balance in the controls of `ledger`.
    pub fn track_energy_balance(&mut self, energy_balance: EnergyBalance) {
        self.energy_balance = Some(energy_balance);
    }

    /// Returns `true` if the system has an energy balance.
    pub fn tracks_energy_balance(&self) -> bool {
        self.energy_balance.is_some()
    }

    /// Adds the heat of an overdamped step from `start`, where the loads were `before`.
    ///
    /// The heat is minus the work on free bodies of the mean of the loads at the start and the end.
    /// Loads are evaluated if they are not current.
    pub fn record_overdamped_heat(&mut self, (start, before): (&State, &Loads)) {
        self.loads();
        let both = work_on_free([before, &self.loads], [start, &self.state]);
        self.record_heat(-0.5 * both);
    }

    /// Present state.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Mutable access to the present state: positions, velocities, controls, inertia and holds. The
    /// numbers of bodies must not change.
    pub fn state_mut(&mut self) -> &mut State {
        self.loads_are_current = false;
        self.changed_outside = true;
        &mut self.state
    }

    /// Mutable access to the present state as [`state_mut`](Self::state_mut), with the interactions.
    pub fn state_mut_and_interactions(&mut self) -> (&mut State, &[Box<dyn Interaction>]) {
        self.loads_are_current = false;
        self.changed_outside = true;
        (&mut self.state, &self.interactions)
    }

    /// Returns `true` if the loads belong to the present positions.
    pub fn loads_are_current(&self) -> bool {
        self.loads_are_current
    }

    /// Restores the motion and the number of force evaluations of a system with the same bodies and
    /// interactions. The continuation is identical to the bit.
    ///
    /// # Panics
    /// If `motion` has other numbers of bodies or controls.
    pub fn restore(&mut self, motion: &Motion, loads_are_current: bool, force_evaluations: u64) {
        self.state_mut().set_motion(motion);
        if loads_are_current {
            self.loads();
        }
        self.force_evaluations = force_evaluations;
    }

    /// The interactions.
    pub fn interactions(&self) -> &[Box<dyn Interaction>] {
        &self.interactions
    }

    /// Loads at the present positions.
    ///
    /// # Panics
    /// If the numbers of bodies have changed since construction, or if the state violates the
    /// conditions of [`new`](Self::new).
    pub fn loads(&mut self) -> &Loads {
        if !self.loads_are_current {
            if self.changed_outside {
                self.assert_same_bodies();
                self.changed_outside = false;
            }
            self.loads.clear();
            for interaction in self.interactions.iter() {
                interaction.count_turns(&mut self.state);
                interaction.add_loads(&self.state, &mut self.loads);
            }
            self.force_evaluations += 1;
            self.loads_are_current = true;
        }
        &self.loads
    }

    fn assert_same_bodies(&self) {
        self.state.assert_shape();
        let made_with = (self.loads.force.len(), self.loads.torque.len());
        let now = (self.state.points.len(), self.state.frames.len());
        assert!(
            now == made_with,
            "the system was built with {} points and {} frames, but its state now has {} and {}",
            made_with.0,
            made_with.1,
            now.0,
            now.1
        );
    }

    /// Largest loads on free bodies. Evaluates the loads if they are not current.
    pub fn residual(&mut self) -> Residual {
        self.loads();
        self.loads.residual(&self.state)
    }

    /// Energy of each interaction.
    pub fn energies(&self) -> Vec<f64> {
        self.interactions
            .iter()
            .map(|interaction| interaction.energy(&self.state))
            .collect()
    }

    /// Sum of the energies of all interactions.
    pub fn potential_energy(&self) -> f64 {
        self.energies().iter().sum()
    }

    /// Sum of potential and kinetic energy.
    pub fn total_energy(&self) -> f64 {
        self.potential_energy() + self.state.kinetic_energy()
    }
}

impl Split for System {
    fn drift(&mut self, h: f64) {
        self.loads_are_current = false;
        self.state.points.drift(h);
        self.state.frames.drift(h);
        self.state.time += h;
        if let Some(drive) = &self.drive {
            let time = self.state.time;
            drive.place(&mut self.state, time);
        }
    }

    fn kick(&mut self, translation: f64, rotation: f64) {
        self.loads();
        let (state, force) = (&mut self.state, &self.loads.force);
        state.points.kick(force, translation);
        state.frames.kick(&self.loads.torque, rotation);
        for slider in state.sliders.iter() {
            slider.kick(&mut state.points.velocity, force, translation);
        }
    }

    fn damp(&mut self, translational: f64, rotational: f64) {
        // The prescribed motion of held bodies is not damped.
        let state = &mut self.state;
        state.points.damp(translational);
        for slider in state.sliders.iter() {
            slider.damp(&mut state.points.velocity, translational);
        }
        state.frames.damp(rotational);
    }

    fn force_evaluations(&self) -> u64 {
        self.force_evaluations
    }

    fn record_work(&mut self, t: f64) {
        let (Some(energy_balance), true) = (self.energy_balance, self.drive.is_some()) else {
            return;
        };
        self.loads();
        if let Some(drive) = &self.drive {
            let driven = (drive.as_ref(), &*self.interactions);
            energy_balance.record_work(&mut self.state, driven, &self.loads, t);
        }
    }

    fn kinetic_energies(&self) -> Option<(f64, f64)> {
        self.energy_balance.map(|_| self.state.kinetic_energies())
    }

    fn record_heat(&mut self, energy: f64) {
        if let Some(energy_balance) = self.energy_balance {
            self.state.controls[energy_balance.heat] += energy;
        }
    }
}

impl Thermostat for System {
    fn bodies(&self) -> (usize, usize) {
        (self.state.points.len(), self.state.frames.len())
    }

    fn add_thermal_impulses(&mut self, points: &Vectors, frames: &Vectors) {
        let state = &mut self.state;
        state.points.add_thermal_impulses(points);
        for slider in state.sliders.iter() {
            slider.add_thermal_impulses(&mut state.points.velocity, points);
        }
        state.frames.add_thermal_impulses(frames);
    }

    fn has_step_end(&self) -> bool {
        self.step_end.is_some()
    }

    fn end_step(&mut self, step: u64, h: f64) {
        if let Some(step_end) = &self.step_end
            && step_end.end_step(&mut self.state, step, h)
        {
            self.loads_are_current = false;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{push_frame, push_point};
    use crate::{Slider, UnitQuaternion, Vector3};

    /// A free and a held point of mass 4, a held pair that slides along z with mass 16, and a free
    /// and a held top of moments (1, 1, 9).
    fn bodies() -> System {
        let mut state = State::default();
        for mass in [4.0, 4.0, 2.0, 2.0] {
            push_point(&mut state, Vector3::zeros(), mass);
        }
        (1..4).for_each(|i| state.points.hold(i));
        state.sliders.push(Slider {
            points: vec![2, 3],
            directions: vec![Vector3::z()],
            mass: 16.0,
        });
        for _ in 0..2 {
            push_frame(&mut state, UnitQuaternion::identity(), [1.0, 1.0, 9.0]);
        }
        state.frames.hold(1);
        System::new(state, Vec::new())
    }

    #[test]
    fn states_of_other_shape_are_refused() {
        let is_refused = |change: fn(&mut State)| {
            let run = || {
                let mut system = bodies();
                system.kick(1.0, 1.0);
                change(system.state_mut());
                system.kick(1.0, 1.0);
            };
            std::panic::catch_unwind(run).is_err()
        };
        assert!(!is_refused(|state| state.points.hold(0)));
        assert!(is_refused(|state| {
            let (position, mass) = (Vector3::zeros(), 1.0);
            push_point(state, position, mass);
        }));
        assert!(is_refused(|state| state.points.velocity = Vectors::zeros(1)));
        assert!(is_refused(
            |state| state.frames.angular_momentum = Vectors::zeros(3)
        ));
        assert!(is_refused(|state| state.frames.orientation.w.clear()));
        assert!(is_refused(|state| state.sliders[0].points.clear()));
        assert!(is_refused(|state| state.sliders[0].points.push(4)));
        assert!(is_refused(|state| state.sliders[0].mass = 0.0));
        assert!(is_refused(|state| state.sliders[0]
            .directions
            .push(Vector3::z())));
    }

    /// Unit deviates give each free component an energy of 1/2, and held bodies none.
    #[test]
    fn impulses_scale_with_the_root_of_inertia() {
        let mut system = bodies();
        let ones: Vectors = (0..4).map(|_| Vector3::repeat(1.0)).collect();
        system.add_thermal_impulses(&ones, &ones);
        let state = system.state();
        let v = |i| state.points.velocity.get(i);
        assert_eq!((v(0), v(1)), (Vector3::repeat(0.5), Vector3::zeros()));
        assert_eq!((v(2), v(3)), (Vector3::z() * 0.25, Vector3::z() * 0.25));
        let l = |i| state.frames.angular_momentum.get(i);
        assert!((l(0) - Vector3::new(1.0, 1.0, 3.0)).norm() < 1e-15);
        assert_eq!(l(1), Vector3::zeros());
        // Three components of a point, one of the slider, three of a frame.
        assert!((state.kinetic_energy() - 3.5).abs() < 1e-14);
    }
}

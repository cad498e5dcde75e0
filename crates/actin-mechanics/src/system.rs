//! A state with its interactions, split into drift and kick.

use crate::ledger::work_on_free;
use crate::{Interaction, Ledger, Loads, Motion, Residual, State, Vectors};
use std::sync::Arc;

/// What an integrator may do to a system: nothing else is visible to it. One that wraps another and is to keep its
/// [`Ledger`] passes on the three methods of that too.
pub trait Split {
    /// Moves everything freely for a time `h` (which may be negative).
    fn drift(&mut self, h: f64);

    /// Applies the loads at the present positions: forces for a time `translation`, torques for a
    /// time `rotation` (which may be negative).
    fn kick(&mut self, translation: f64, rotation: f64);

    /// Multiplies velocities by `translational` and angular momenta by `rotational`.
    fn damp(&mut self, translational: f64, rotational: f64);

    /// How often the loads have been evaluated so far.
    fn force_evaluations(&self) -> u64;

    /// Books the work of what is driven, at the present positions, for a time `t`; nothing where no
    /// [`Ledger`] is kept.
    fn book_work(&mut self, _t: f64) {}

    /// Kinetic energies of the free points and of the free frames, where heat is booked.
    fn kinetic_energies(&self) -> Option<(f64, f64)> {
        None
    }

    /// Books energy that drag or noise has added.
    fn book_heat(&mut self, _energy: f64) {}
}

/// What happens to a system between one time step and the next, such as a spring that breaks.
pub trait StepEnd: std::fmt::Debug + Send + Sync {
    /// Lets happen what does at the end of the step with the number `step`, counted from 1, of a length
    /// `h`. Returns whether loads may have changed. What it does depends on its arguments alone: steps may be made
    /// again.
    fn end_step(&self, state: &mut State, step: u64, h: f64) -> bool;
}

/// What a heat bath may do to a system besides damping it, and what happens between steps.
pub trait Thermostat: Split {
    /// Number of points and of frames, held ones included.
    fn bodies(&self) -> (usize, usize);

    /// Adds thermal impulses, scaled to the inertia of what they meet.
    ///
    /// With deviates `d` in the root of an energy, one vector per point and one per frame, each
    /// velocity gains `d / sqrt(m)` (lab frame) and each angular momentum `d_a sqrt(I_a)` about its
    /// body axis `a`. Held bodies gain nothing; a body that slides gains, along its `k`-th
    /// direction, component `k` of its first point's `d` over the root of its whole mass.
    fn add_thermal_impulses(&mut self, points: &Vectors, frames: &Vectors);

    /// Whether something happens at the end of each step, so that steps are to be made one by one.
    fn has_step_end(&self) -> bool {
        false
    }

    /// Lets that happen, at the end of the step with the number `step`, counted from 1, of a length `h`.
    fn end_step(&mut self, _step: u64, _h: f64) {}
}

/// What moves held bodies and controls as time goes.
pub trait Drive: std::fmt::Debug + Send + Sync {
    /// Puts them where they belong at `time` and gives held bodies their velocities.
    ///
    /// Called after every drift, so that loads are evaluated at the exact places: the order of a
    /// method is not lost to the drive. What slides keeps its place along which it slides.
    fn place(&self, state: &mut State, time: f64);

    /// Energy that the controls which it moves add to `interactions` over a time `t`, at the places and the time of
    /// `state`; it leaves the state as it was. Zero where it moves held bodies alone.
    fn work_of_controls(
        &self,
        _state: &mut State,
        _interactions: &[Box<dyn Interaction>],
        _t: f64,
    ) -> f64 {
        0.0
    }
}

/// A state, the interactions that act on it, and their loads.
///
/// Loads are evaluated when first needed after the positions have changed, so that two kicks
/// with no drift between them cost one evaluation.
#[derive(Debug)]
pub struct System {
    state: State,
    interactions: Arc<[Box<dyn Interaction>]>,
    loads: Loads,
    loads_are_current: bool,
    /// Whether the state may have been changed from outside since it was last looked at.
    changed_outside: bool,
    force_evaluations: u64,
    drive: Option<Box<dyn Drive>>,
    step_end: Option<Box<dyn StepEnd>>,
    ledger: Option<Ledger>,
}

impl System {
    /// A system; nothing is evaluated yet.
    ///
    /// # Panics
    /// If not every body has a place and a motion, or if a [`Slider`](crate::Slider) is not sound.
    /// An interaction panics if it acts on a body or a control that is not there, when loads or
    /// energies are first evaluated.
    pub fn new(state: State, interactions: Vec<Box<dyn Interaction>>) -> Self {
        Self::with_shared(state, interactions.into())
    }

    /// Another system under the same interactions, which both share, in a state of the same bodies; it
    /// has no drive and no ledger, and nothing happens between its steps.
    ///
    /// # Panics
    /// As [`new`](Self::new).
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
            ledger: None,
        }
    }

    /// Lets `drive` move held bodies and controls from now on, its time beginning at zero.
    pub fn set_drive(&mut self, drive: Box<dyn Drive>) {
        drive.place(&mut self.state, 0.0);
        self.loads_are_current = false;
        self.state.time = 0.0;
        self.drive = Some(drive);
    }

    /// Lets something happen between steps from now on.
    pub fn set_step_end(&mut self, step_end: Box<dyn StepEnd>) {
        self.step_end = Some(step_end);
    }

    /// Books from now on what comes from outside.
    pub fn keep_ledger(&mut self, ledger: Ledger) {
        self.ledger = Some(ledger);
    }

    /// Whether what comes from outside is booked.
    pub fn keeps_ledger(&self) -> bool {
        self.ledger.is_some()
    }

    /// Books as heat what a step without inertia from `start`, where the loads were `before`, has taken from the
    /// energy by moving free bodies: by the mean of the loads of its start and end. Evaluates the loads if they are not current.
    pub fn book_overdamped_heat(&mut self, (start, before): (&State, &Loads)) {
        self.loads();
        let both = work_on_free([before, &self.loads], [start, &self.state]);
        self.book_heat(-0.5 * both);
    }

    /// The present state.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// The present state, to be changed from outside: places, motion, controls, inertia and what is
    /// held, but not the numbers of bodies, for which the system was made.
    pub fn state_mut(&mut self) -> &mut State {
        self.loads_are_current = false;
        self.changed_outside = true;
        &mut self.state
    }

    /// Whether the loads belong to the present positions, so that they need not be evaluated again.
    pub fn loads_are_current(&self) -> bool {
        self.loads_are_current
    }

    /// Puts the system where another one of the same bodies and terms stood, as far as time has
    /// changed it, work counts included: what follows is the same to the bit.
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

    /// The loads at the present positions.
    ///
    /// # Panics
    /// If the state has other numbers of bodies than the system was made with, or is no longer one
    /// that [`new`](Self::new) takes.
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

    /// Asserts that the state still has the bodies that the loads are for.
    fn assert_same_bodies(&self) {
        self.state.assert_shape();
        let made_with = (self.loads.force.len(), self.loads.torque.len());
        let now = (self.state.points.len(), self.state.frames.len());
        assert!(
            now == made_with,
            "the system was made with {} points and {} frames, its state now has {} and {}",
            made_with.0,
            made_with.1,
            now.0,
            now.1
        );
    }

    /// Largest loads on free bodies; evaluates the loads if they are not current.
    pub fn residual(&mut self) -> Residual {
        self.loads();
        self.loads.residual(&self.state)
    }

    /// Energy of each interaction, in order.
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

    /// Potential and kinetic energy.
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
        // Prescribed motion of held bodies is not damped: it is zero or driven.
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

    fn book_work(&mut self, t: f64) {
        let (Some(ledger), true) = (self.ledger, self.drive.is_some()) else {
            return;
        };
        self.loads();
        if let Some(drive) = &self.drive {
            let driven = (drive.as_ref(), &*self.interactions);
            ledger.book_work(&mut self.state, driven, &self.loads, t);
        }
    }

    fn kinetic_energies(&self) -> Option<(f64, f64)> {
        self.ledger.map(|_| self.state.kinetic_energies())
    }

    fn book_heat(&mut self, energy: f64) {
        if let Some(ledger) = self.ledger {
            self.state.controls[ledger.heat] += energy;
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

    /// Two points of mass 4, the second held; a pair of held points that slides along z as one
    /// body of mass 16; two tops of moments (1, 1, 9), the second held.
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

    /// Bodies that are added later would have no loads, and those that lose their velocity would not
    /// be moved: both silently without this check.
    #[test]
    fn states_that_lose_their_shape_are_refused() {
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

    /// Impulses go as the root of the inertia, so that energies do not: each component that
    /// is free has 1/2. Held bodies that answered would carry heat through the wall.
    #[test]
    fn impulses_meet_the_free_bodies_by_the_root_of_their_inertia() {
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

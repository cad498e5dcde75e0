//! Relaxation of new bodies for a short time, with all other bodies held, under drag or in a heat
//! bath.
//!
//! It relaxes modes that the cross-sections do not determine: bonds, shear, and waves shorter than
//! a rod's segments. In a bath these modes reach the bath temperature. Longer waves are nearly
//! unchanged.

use super::momentum::Bodies;
use super::transfer::Transfer;
use crate::Plan;
use crate::run::order;
use crate::scene::{Brownian, Dynamics, SceneProblem, Task};
use actin_brownian::Layout;
use actin_integrate::{Bath, Drag, POSITION_VERLET, Run};
use actin_mechanics::{Shared, State, System, Vector3};
use std::error::Error;

/// Drag rate (1/ns) for bodies with inertia.
///
/// Bonds (100 to 470 rad/ns) relax under it, a bend over 36 nm (33 rad/ns) by half, and longer
/// waves hardly at all. Rates of 30 and 120 give energy jumps of similar size.
const RATE_PER_NS: f64 = 60.0;

/// Shortest relaxation time (ns). Without inertia a bend over 36 nm relaxes in 0.25 ns in water.
const TIME_NS: f64 = 0.15;

/// Number of steps without heat; stiff modes are at rest after each.
const STEPS_WITHOUT_HEAT: f64 = 4.0;

/// Smallest number of steps with random stress. A mode that relaxes in one step then has 1 - 2^-8
/// of its thermal energy.
const STRESSED_STEPS: f64 = 4.0;

/// Smallest number of midpoint steps in a bath.
///
/// The first steps are implicit and leave fast modes too cold. The fastest mode by default relaxes
/// in a fiftieth of a step and loses 15 % of that error in each further step.
const MIDPOINT_STEPS: f64 = 60.0;

/// Mixed with the step into the seed of the bath, for noise independent of the motion.
const OTHER_NOISE: u64 = 0x5e77_1e5e;

/// Odd number near 2^64 over the golden ratio.
const SPREAD: u64 = 0x9e37_79b9_7f4a_7c15;

impl Transfer<'_> {
    /// Relaxes new bodies by the motion of `task` and returns the state.
    ///
    /// # Errors
    /// If the new bodies do not settle.
    pub(super) fn settled(
        &self,
        state: &State,
        bodies: &Bodies,
        task: &Task,
    ) -> Result<State, SceneProblem> {
        let mut local = state.clone();
        local.sliders = Shared::default();
        let others = self.bodies(state, |s_nm| !self.is_switched(s_nm));
        others.points.iter().for_each(|&i| local.points.hold(i));
        others.frames.iter().for_each(|&i| local.frames.hold(i));
        stop_all(&mut local);
        let mut system = self.to.system.in_state(local);
        let settled = match task {
            Task::Dynamics(dynamics) => self.settle(&mut system, dynamics),
            Task::Brownian(brownian) => self.relax(&mut system, brownian),
            Task::Equilibrium(_) => unreachable!("following requires a motion"),
        };
        settled.map_err(|error| {
            let rule = format!(
                "new bodies at {} place(s) do not settle at {:.4} ns: {error}",
                bodies.points.len(),
                self.time_ns
            );
            SceneProblem::new("filament.sections", "", rule)
        })?;
        Ok(System::state(&system).clone())
    }

    /// Relaxes free bodies with inertia: under drag, or in the bath of the motion with that drag.
    fn settle(&self, system: &mut System, dynamics: &Dynamics) -> Result<(), Box<dyn Error>> {
        let step = dynamics.time_step_ns.unwrap_or(TIME_NS);
        let run = Run::from_duration(crate::run::composition_of(dynamics), step, TIME_NS)?;
        let drag = Drag::new(RATE_PER_NS, RATE_PER_NS)?;
        let run = match &dynamics.thermal {
            None => run.with_drag(drag),
            Some(thermal) => {
                let seed = self.other_seed(thermal.seed);
                run.with_bath(Bath::new(drag, thermal.energy_pn_nm(), seed)?)
            }
        };
        run.execute(system, &mut [])?;
        Ok(())
    }

    /// Relaxes free bodies without inertia, by steps of the motion or, without heat, by shorter
    /// ones.
    fn relax(&self, system: &mut System, task: &Brownian) -> Result<(), Box<dyn Error>> {
        let own = Brownian {
            seed: self.other_seed(task.seed),
            ..task.clone()
        };
        let plan = Plan::new(self.to)?;
        let estimate = plan.estimate().ok_or("it has no time step")?;
        let step = estimate.time_step_ns;
        let (step, time) = match (task.thermal(), estimate.has_random_stress()) {
            (None, _) => (TIME_NS / STEPS_WITHOUT_HEAT, TIME_NS),
            (Some(_), true) => (step, f64::max(TIME_NS, STRESSED_STEPS * step)),
            (Some(_), false) => (step, f64::max(TIME_NS, MIDPOINT_STEPS * step)),
        };
        let layout = Layout::new(system.state(), Some(&order(self.to)))?;
        let mut stepper = estimate.stepper((self.to, &own), system, layout)?;
        let run = Run::from_duration(&POSITION_VERLET, step, time)?;
        run.execute_from(None, Some(&mut stepper), system, &mut [])?;
        Ok(())
    }

    /// Seed of the relaxation at this step. Seeds of neighbouring steps are far apart.
    fn other_seed(&self, seed: u64) -> u64 {
        seed ^ OTHER_NOISE.wrapping_add(self.step).wrapping_mul(SPREAD)
    }
}

fn stop_all(state: &mut State) {
    for i in 0..state.points.len() {
        state.points.velocity.set(i, Vector3::zeros());
    }
    for i in 0..state.frames.len() {
        state.frames.angular_momentum.set(i, Vector3::zeros());
    }
}

//! How new bodies settle among the others, which are held: their own motion for a short time, in a drag or in a heat bath.
//!
//! What settles is what the cross-sections on which they were put do not tell: bonds, shear, waves shorter than the segments of a
//! rod. In a bath it has the temperature of the bath from then on; what is longer stays as it was.

use super::momentum::Bodies;
use super::transfer::Transfer;
use crate::Plan;
use crate::run::order;
use crate::scene::{Brownian, Dynamics, SceneProblem, Task};
use actin_brownian::Layout;
use actin_integrate::{Bath, Drag, POSITION_VERLET, Run};
use actin_mechanics::{Shared, State, System, Vector3};
use std::error::Error;

/// Rate (1/ns) of the drag in which new bodies with inertia settle: bonds (some 100 to 470 rad/ns) settle in it, a bend over
/// 36 nm (33 rad/ns) by half, what is longer hardly moves. Rates of 30 and 120 leave jumps of energy as large.
const RATE_PER_NS: f64 = 60.0;

/// Time (ns) for which they settle, at least. Without inertia a bend over 36 nm relaxes in 0.25 ns in water.
const TIME_NS: f64 = 0.15;

/// Steps without heat: what is stiff is at rest after each.
const STEPS_WITHOUT_HEAT: f64 = 4.0;

/// Fewest steps with random stress: what relaxes in a step has 1 - 2^-8 of its thermal energy behind them.
const STRESSED_STEPS: f64 = 4.0;

/// Fewest midpoint steps in a bath. The first are implicit, and leave what is fast too cold; what relaxes in a fiftieth of a step,
/// the fastest there is by default, forgets 15 % of that in each of the others.
const MIDPOINT_STEPS: f64 = 60.0;

/// Mixed with the step into the seed of a bath, so that what settles meets another noise than the motion does.
const OTHER_NOISE: u64 = 0x5e77_1e5e;

/// An odd number, the golden ratio of 2^64.
const SPREAD: u64 = 0x9e37_79b9_7f4a_7c15;

impl Transfer<'_> {
    /// The state after new bodies have settled as they move in `task`.
    ///
    /// # Errors
    /// New bodies that do not settle.
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
            Task::Equilibrium(_) => unreachable!("an equilibrium is no motion"),
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

    /// Lets what is free settle with inertia: in a drag, or in the bath of the motion under that drag.
    fn settle(&self, system: &mut System, dynamics: &Dynamics) -> Result<(), Box<dyn Error>> {
        let step = dynamics.time_step_ns.unwrap_or(TIME_NS);
        let run = Run::over(crate::run::composition_of(dynamics), step, TIME_NS)?;
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

    /// Lets what is free settle without inertia, by the steps of the motion, without heat by shorter ones.
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
        let layout = Layout::new(system.state(), Some(&order(self.to)), Vec::new())?;
        let mut stepper = estimate.stepper((self.to, &own), system, layout)?;
        let run = Run::over(&POSITION_VERLET, step, time)?;
        run.execute_steps(&mut stepper, system, &mut [])?;
        Ok(())
    }

    /// A seed for what settles at this step: far apart for neighbouring steps, so that no two runs settle with one noise.
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

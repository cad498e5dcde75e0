//! Time step and counts of a motion before its run.

use crate::observe::RecordTimes;
use crate::scene::{Dynamics, Integrator, Scene, Task};
use actin_integrate::Composition;

/// Time step and counts of a motion before the run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Largest frequency of the filament as built (rad/ns); zero for overdamped motion.
    ///
    /// For rods that stiffen under shear it is at least the frequency with constant rigidities.
    pub largest_frequency_rad_per_ns: f64,
    /// Largest stable time step of the integrator (ns); infinite for overdamped motion.
    pub stability_limit_ns: f64,
    /// Time step (ns).
    pub time_step_ns: f64,
    /// Number of steps, unless the stop rule ends the run earlier.
    pub steps: u64,
    /// Steps between two records.
    pub steps_between_records: u64,
    /// Time between two records (ns).
    pub record_every_ns: f64,
    /// Load evaluations in these steps; for overdamped motion an estimate from the usual number of
    /// iterations.
    pub force_evaluations: u64,
    /// Longest accurate step of overdamped motion; `None` for other motion.
    pub longest_sound_step: Option<LongestStep>,
    /// Distance (nm) by which walls act as if they were farther away; `None` without contacts or heat.
    pub approach_nm: Option<f64>,
}

/// Longest accurate steps of overdamped thermal motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LongestStep {
    /// Default step (ns), accurate for slow modes.
    pub ns: f64,
    /// Longest midpoint step (ns), accurate for all modes; longer steps of rods use random stress.
    pub of_midpoints_ns: f64,
    /// `true` if monomers have bonds, which allow no longer steps.
    pub has_bonds: bool,
}

impl Estimate {
    /// Number of records, including the first and the last.
    pub(crate) fn records(&self) -> u64 {
        self.steps / self.steps_between_records + 1
    }

    pub(super) fn record_times(&self) -> RecordTimes {
        RecordTimes {
            every_ns: self.record_every_ns,
            duration_ns: self.time_step_ns * self.steps as f64,
        }
    }

    /// Writes the time step and the interval of records of a motion into its scene.
    pub(super) fn resolve(&self, scene: &mut Scene) {
        let (step, every) = match &mut scene.task {
            Task::Dynamics(task) => {
                if task.drag.fluid().is_some() {
                    task.integrator = Integrator::PositionVerlet;
                }
                (&mut task.time_step_ns, &mut task.record_every_ns)
            }
            Task::Brownian(task) => (&mut task.time_step_ns, &mut task.record_every_ns),
            Task::Equilibrium(_) => return,
        };
        *step = Some(self.time_step_ns);
        *every = Some(self.record_every_ns);
    }
}

/// The coefficient table of an integrator.
pub fn composition(integrator: Integrator) -> &'static Composition {
    match integrator {
        Integrator::PositionVerlet => &actin_integrate::POSITION_VERLET,
        Integrator::Pefrl => &actin_integrate::PEFRL,
        Integrator::Vefrl => &actin_integrate::VEFRL,
        Integrator::ForestRuth => &actin_integrate::FOREST_RUTH,
        Integrator::Suzuki => &actin_integrate::SUZUKI,
    }
}

/// The coefficient table of the steps of a motion; in a fluid of their conservative part.
pub(crate) fn composition_of(dynamics: &Dynamics) -> &'static Composition {
    match dynamics.drag.fluid() {
        None => composition(dynamics.integrator),
        Some(_) => &actin_integrate::POSITION_VERLET,
    }
}

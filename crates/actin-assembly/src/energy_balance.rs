//! Energy exchange of a motion with its surroundings.

use super::{Assembly, Ramp};
use crate::scene::Task;
use actin_mechanics::{EnergyBalance, State};
use serde::{Deserialize, Serialize};

/// Energy (pN nm) received from the surroundings up to a record.
///
/// The total energy minus this sum is constant up to the time-stepping error. Perturbations that
/// leave saddles are not included.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EnergyExchange {
    /// Work of moving ends and anchors and of loads that change in time.
    pub work_pn_nm: f64,
    /// Heat from drag and, in a bath, noise; negative if drag dominates. Not computed for
    /// overdamped motion in a bath.
    pub heat_pn_nm: f64,
    /// Energy change by linkers that broke, formed or stepped.
    pub events_pn_nm: f64,
}

impl EnergyExchange {
    /// Sum of work, heat and events.
    pub fn sum_pn_nm(&self) -> f64 {
        self.work_pn_nm + self.heat_pn_nm + self.events_pn_nm
    }
}

/// Name of a column of `energies.csv` and its value.
pub type EnergyColumn = (&'static str, fn(&EnergyExchange) -> f64);

/// Adds the energy balance of a motion to a state under construction; `None` for other tasks.
pub(super) fn of_motion(task: &Task, state: &mut State) -> Option<EnergyBalance> {
    (!matches!(task, Task::Equilibrium(_))).then(|| EnergyBalance {
        work: state.add_control(0.0),
        heat: state.add_control(0.0),
    })
}

impl Assembly {
    /// Returns the energy received up to `state`, a state of a run in progress.
    ///
    /// States read from files do not contain it; read `energies.csv` instead.
    pub fn booked(&self, state: &State) -> EnergyExchange {
        let [work_pn_nm, heat_pn_nm] = self.energy_balance.map_or([0.0; 2], |energy_balance| {
            [energy_balance.work, energy_balance.heat].map(|control| state.controls[control])
        });
        let events = self.kinetics.as_ref().map(|all| all.booked(state));
        EnergyExchange {
            work_pn_nm,
            heat_pn_nm,
            events_pn_nm: events.unwrap_or_default(),
        }
    }

    /// Returns the columns of the exchanges that occur in this scene.
    pub fn booked_columns(&self) -> Vec<EnergyColumn> {
        let (is_driven, has_drag) = match &self.scene.task {
            Task::Dynamics(dynamics) => (Ramp::from_assembly(self).is_some(), dynamics.has_drag()),
            // Heat from noise is not recorded.
            Task::Brownian(task) => (
                Ramp::from_assembly(self).is_some(),
                task.thermal().is_none(),
            ),
            Task::Equilibrium(_) => (false, false),
        };
        let mut columns: Vec<EnergyColumn> = Vec::new();
        if is_driven {
            columns.push(("work_pn_nm", |booked| booked.work_pn_nm));
        }
        if has_drag {
            columns.push(("heat_pn_nm", |booked| booked.heat_pn_nm));
        }
        if self.kinetics.is_some() {
            columns.push(("events_pn_nm", |booked| booked.events_pn_nm));
        }
        columns
    }
}

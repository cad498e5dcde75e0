//! What a motion gains from outside: the columns that close its energy.

use super::{Assembly, Ramp};
use crate::scene::Task;
use actin_mechanics::{Ledger, State};
use serde::{Deserialize, Serialize};

/// Energy (pN nm) that has come from outside up to a record. The energy of a motion less this is constant but for the
/// error of its time steps.
///
/// Pushes off saddles are not booked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Booked {
    /// By ends, anchors and loads that move or change in time.
    pub work_pn_nm: f64,
    /// By drag and, in a bath, noise: negative where drag takes more. Not booked of overdamped motion in a bath.
    pub heat_pn_nm: f64,
    /// By linkers that broke, formed or stepped.
    pub events_pn_nm: f64,
}

impl Booked {
    /// All of it.
    pub fn sum_pn_nm(&self) -> f64 {
        self.work_pn_nm + self.heat_pn_nm + self.events_pn_nm
    }
}

/// A column of `energies.csv` and what stands in it.
pub(crate) type Column = (&'static str, fn(&Booked) -> f64);

/// Adds what a motion books in to a state under construction; none of other tasks.
pub(super) fn of_motion(task: &Task, state: &mut State) -> Option<Ledger> {
    (!matches!(task, Task::Equilibrium(_))).then(|| Ledger {
        work: state.add_control(0.0),
        heat: state.add_control(0.0),
    })
}

impl Assembly {
    /// What has come from outside up to `state`, a state of a run in progress. Those read back from files have none of it: it
    /// stands in `energies.csv`.
    pub fn booked(&self, state: &State) -> Booked {
        let [work_pn_nm, heat_pn_nm] = self.ledger.map_or([0.0; 2], |ledger| {
            [ledger.work, ledger.heat].map(|control| state.controls[control])
        });
        let events = self.kinetics.as_ref().map(|all| all.booked(state));
        Booked {
            work_pn_nm,
            heat_pn_nm,
            events_pn_nm: events.unwrap_or_default(),
        }
    }

    /// The columns of what may come from outside in this scene, and what of it stands in each.
    pub(crate) fn booked_columns(&self) -> Vec<Column> {
        let (is_driven, has_drag) = match &self.scene.task {
            Task::Dynamics(dynamics) => (Ramp::of(self).is_some(), dynamics.has_drag()),
            // What noise brings is not booked.
            Task::Brownian(task) => (Ramp::of(self).is_some(), task.thermal().is_none()),
            Task::Equilibrium(_) => (false, false),
        };
        let mut columns: Vec<Column> = Vec::new();
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

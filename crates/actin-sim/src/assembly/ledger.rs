//! What a motion gains from outside: the columns that close its energy.

use super::{Assembly, Ramp};
use crate::scene::Task;
use actin_mechanics::{Ledger, State};
use serde::{Deserialize, Serialize};

/// Energy (pN nm) that has come from outside up to a record. The energy of a motion less this is constant but for the
/// error of its integrator: how much it is not says how good its time step is.
///
/// Pushes off saddles are not booked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Booked {
    /// By ends, anchors and loads that move or change in time.
    pub work_pn_nm: f64,
    /// By drag and, in a bath, noise: negative where drag takes more.
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

/// Adds what a motion books in to a state under construction; none of other tasks.
pub(super) fn of_motion(task: &Task, state: &mut State) -> Option<Ledger> {
    matches!(task, Task::Dynamics(_)).then(|| Ledger {
        work: state.add_control(0.0),
        heat: state.add_control(0.0),
    })
}

impl Assembly {
    /// What has come from outside up to `state`.
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

    /// The columns of what may come from outside in this scene, with what of `booked` stands in each.
    pub(crate) fn columns_of(&self, booked: &Booked) -> Vec<(&'static str, f64)> {
        let Booked {
            work_pn_nm,
            heat_pn_nm,
            events_pn_nm,
        } = *booked;
        let (is_driven, is_heated) = match &self.scene.task {
            Task::Dynamics(dynamics) => (Ramp::of(self).is_some(), dynamics.has_friction()),
            _ => (false, false),
        };
        [
            (is_driven, "work_pn_nm", work_pn_nm),
            (is_heated, "heat_pn_nm", heat_pn_nm),
            (self.kinetics.is_some(), "events_pn_nm", events_pn_nm),
        ]
        .into_iter()
        .filter_map(|(is_there, name, value)| is_there.then_some((name, value)))
        .collect()
    }
}

//! Linker events and controls of states that were read from files.

use super::{Assembly, LinkerEvent};
use crate::At;
use actin_mechanics::State;

impl Assembly {
    /// Returns `true` if linkers of the scene break, form or step.
    pub fn has_events(&self) -> bool {
        self.kinetics.is_some()
    }

    /// Sets the controls of a state at a time or place of the path: load factors, anchors, held
    /// bodies, and linkers after the `events` up to then.
    pub fn restore_controls(&self, state: &mut State, at: At, events: &[LinkerEvent]) {
        self.place_controls(state, at);
        let (At::Time(time_ns), Some(kinetics)) = (at, &self.kinetics) else {
            return;
        };
        for event in events.iter().take_while(|event| event.time_ns <= time_ns) {
            if let Some(switching) = kinetics.linker(event.linker) {
                switching.restore(state, event);
            }
        }
    }
}

//! Linker events and controls of states that were read from files.

use super::{Assembly, LinkerEvent, LinkerEventKind};
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
            let Some((linker, places_nm)) = kinetics.linker(event.linker) else {
                continue;
            };
            match event.what {
                LinkerEventKind::Broke | LinkerEventKind::Left => linker.release(state),
                LinkerEventKind::Formed | LinkerEventKind::Stepped => {
                    let distance = |place: &usize| (places_nm[*place] - event.at_nm).abs();
                    let nearest =
                        (0..places_nm.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
                    linker.bind(state, nearest.unwrap_or(0));
                }
            }
        }
    }
}

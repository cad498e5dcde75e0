//! Warnings that follow from other keys of the summary.

use super::{Status, Summary};
use crate::codes;
use actin_assembly::Note;

const DERIVED: [&str; 7] = [
    codes::LAW_RANGE,
    codes::UNSTABLE_TWIST,
    codes::STEP_ERROR,
    codes::MODEL_LIMIT,
    codes::SADDLE,
    codes::OTHER_STATES,
    codes::RESIDUAL_FLOOR,
];

impl Summary {
    /// Returns all notes, with codes for warnings.
    pub fn coded_notes(&self) -> Vec<Note> {
        let coded = |text: &String| {
            let warning = self
                .warnings
                .iter()
                .find(|warning| warning.message == *text);
            warning.cloned().unwrap_or_else(|| text.clone().into())
        };
        self.notes.iter().map(coded).collect()
    }

    pub(super) fn add_note(&mut self, note: Note) {
        self.notes.push(note.message.clone());
        self.warnings.extend(note.code.is_some().then_some(note));
    }

    #[must_use]
    pub(super) fn with_derived_warnings(mut self) -> Self {
        let is_derived = |note: &Note| note.code.as_ref().is_some_and(|c| DERIVED.contains(&&**c));
        let (derived, kept): (Vec<_>, _) = self.warnings.drain(..).partition(is_derived);
        self.warnings = kept;
        let is_stale = |text: &String| derived.iter().any(|note| note.message == *text);
        self.notes.retain(|text| !is_stale(text));
        for note in self.derived_warnings() {
            self.add_note(note);
        }
        self
    }

    /// Warnings about laws, twist and time steps.
    fn listed_warnings(&self) -> Vec<Note> {
        let ranges = self.beyond_range.iter().map(ToString::to_string);
        let twist = self.unstable_twist.iter().map(ToString::to_string);
        let steps = self.step_errors.iter().map(ToString::to_string);
        let ranges = ranges.map(|text| Note::warning(codes::LAW_RANGE, text));
        let twist = twist.map(|text| Note::warning(codes::UNSTABLE_TWIST, text));
        let steps = steps.map(|text| Note::warning(codes::STEP_ERROR, text));
        ranges.chain(twist).chain(steps).collect()
    }

    fn derived_warnings(&self) -> Vec<Note> {
        let mut all = self.listed_warnings();
        let mut add = |code, text: String| all.push(Note::warning(code, text));
        if let Some(floor) = &self.residual_floor {
            let (force, torque) = (floor.force_pn, floor.torque_pn_nm);
            let text = format!(
                "the tolerance is below round-off; the residual is limited to about {force:.1e} pN, {torque:.1e} pN nm"
            );
            add(codes::RESIDUAL_FLOOR, text);
        }
        // The failure of a run already names exceeded limits and saddles.
        if self.status != Status::Failed {
            for beyond in &self.beyond_use {
                add(codes::MODEL_LIMIT, beyond.to_string());
            }
            let negative = self
                .stability
                .as_ref()
                .map_or(0, |s| s.negative_eigenvalues);
            if negative > 0 {
                let text = format!(
                    "the equilibrium is a saddle with {negative} negative eigenvalue(s) and unstable; \
                     set `leave_saddles` in the task to reach a stable state"
                );
                add(codes::SADDLE, text);
            }
        }
        if self.states.is_none() && self.saddles_left + self.jumps > 0 {
            let (saddles, jumps) = (self.saddles_left, self.jumps);
            let text = format!(
                "the path moved away from {saddles} saddle(s) and made {jumps} sudden jump(s): other stable states exist, and \
                 the final state may not be connected to the start; set `states: 24` in the task to search for other states"
            );
            add(codes::OTHER_STATES, text);
        }
        all
    }
}

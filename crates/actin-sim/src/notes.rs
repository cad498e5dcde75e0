//! Notes on the results of a run: unknown errors and states.

use crate::codes;
use crate::scene::Task;
use crate::shape;
use crate::{Assembly, Outcome, Record};
use actin_assembly::Note;

/// Largest energy error without a warning, over the energy exchanged by a motion.
const LARGEST_SHARE: f64 = 0.01;
/// Largest energy error without a warning (pN nm).
const LEAST_PN_NM: f64 = 1e-3;

impl Outcome {
    /// Returns notes on unknown errors and states of this run; `last` is its last record.
    pub(crate) fn notes(&self, assembly: &Assembly, last: &Record) -> Vec<Note> {
        let twist = unknown_twist(assembly, last);
        let mut notes: Vec<Note> = Note::warnings(codes::UNKNOWN_TWIST, twist).collect();
        let error = self.equilibrium.as_ref().and_then(|e| e.error.as_ref());
        match error {
            Some(Err(problem)) => {
                let message = format!("the model error is unknown: {problem}");
                notes.push(Note::warning(codes::UNKNOWN_ERROR, message));
            }
            Some(Ok((error, scatter))) => notes.push(error.note(scatter).into()),
            None => {}
        }
        let states = assembly.note_on_several_states(&last.state);
        notes.extend(Note::warnings(codes::MONOMER_STATES, states));
        let rates = assembly.note_on_rates(&last.state);
        notes.extend(Note::warnings(codes::LINKER_RATES, rates));
        let energy_balance = self.note_on_energy_balance(assembly, last);
        notes.extend(Note::warnings(codes::ENERGY_BALANCE, energy_balance));
        let is_motion = !matches!(assembly.scene.task, Task::Equilibrium(_));
        if is_motion && self.has_converged() && self.at_rest.is_none() {
            notes.push(Note::warning(
                codes::UNKNOWN_STABILITY,
                "the stop rule was met, but it is not known whether the state at rest is stable: no \
                 equilibrium was found near it (force_law: PaperBalance and following loads have no energy)",
            ));
        }
        notes
    }

    /// Warning on the energy balance of an athermal motion with conservative loads.
    fn note_on_energy_balance(&self, assembly: &Assembly, last: &Record) -> Option<String> {
        let begun = self.begun_with_pn_nm?;
        let mut terms = assembly.system.interactions().iter();
        let is_known = assembly.scene.thermal().is_none()
            && self.pushes.is_empty()
            && terms.all(|term| term.is_conservative());
        let booked = last.booked;
        let open = last.potential_pn_nm() + last.kinetic_pn_nm - begun - booked.sum_pn_nm();
        let sizes = [
            booked.work_pn_nm,
            booked.heat_pn_nm,
            booked.events_pn_nm,
            self.largest_kinetic_pn_nm,
        ];
        let size = sizes.iter().fold(0.0, |most: f64, one| most.max(one.abs()));
        let is_open = open.abs() > LEAST_PN_NM.max(LARGEST_SHARE * size);
        (is_known && is_open).then(|| {
            format!(
                "the final energy differs by {open:+.3} pN nm from the balance of work and drag, at an exchange of {size:.3} \
                 pN nm: this is the error of the time steps; use a shorter time_step_ns"
            )
        })
    }
}

fn unknown_twist(assembly: &Assembly, last: &Record) -> Vec<String> {
    let filaments = 0..assembly.filaments.len();
    let here = (&last.state, last.at);
    let unknown = filaments.filter(|&filament| shape::link_is_unknown(assembly, filament, here));
    unknown
        .map(|filament| {
            format!(
                "filament {filament}: a loss of twist cannot be excluded. Twist plus writhe is not \
                 conclusive if one end has passed the other, if the straight extensions of the ends cross, or \
                 if the ends are tilted and the filament turns back"
            )
        })
        .collect()
}

//! Memory of records.

use crate::Assembly;
use crate::observe::observed_columns;
use crate::scene::SceneProblem;
use actin_mechanics::State;

/// Numbers of a record in addition to state, energies and observed quantities: time, kinetic
/// energy, residuals, work, heat, events.
const NUMBERS_OF_ROW: usize = 7;

fn of_record(state: &State, terms: usize) -> f64 {
    // Points have 6 numbers, frames 7.
    let numbers = 6 * state.points.len() + 7 * state.frames.len() + state.controls.len();
    8.0 * (numbers + terms) as f64
}

/// Bytes that the run of an assembly keeps per record; the state counts only if a file needs it.
fn of_kept_record(assembly: &Assembly) -> f64 {
    let terms = assembly.terms.len();
    let observed = 8.0 * observed_columns(assembly).len() as f64;
    if assembly.scene.output.needs_states() {
        of_record(assembly.system.state(), terms) + observed
    } else {
        8.0 * (NUMBERS_OF_ROW + terms) as f64 + observed
    }
}

/// Refuses a run whose records exceed the memory of the machine. `what` describes the records, given
/// the number of bodies.
pub(crate) fn check_records(
    assembly: &Assembly,
    records: f64,
    key: (&str, String),
    what: impl FnOnce(usize) -> String,
) -> Result<(), SceneProblem> {
    let bytes = assembly.bytes + records * of_kept_record(assembly);
    let bodies = assembly.points.len() + assembly.frames.len();
    actin_assembly::memory::check(bytes, key, || what(bodies))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;

    /// A record has 3 + 3 numbers per point, 4 + 3 per frame, and one energy per term.
    #[test]
    fn a_record_is_counted_as_it_is_stored() {
        let text = "Scene(
            filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 60.0, segments: 6)]),
            task: Dynamics(duration_ns: 1.0),
        )";
        let assembly = Assembly::build(&Scene::from_ron(text).unwrap()).unwrap();
        let state = assembly.system.state();
        assert_eq!((state.points.len(), state.frames.len()), (7, 6));
        let expected = 8.0 * f64::from(7 * 6 + 6 * 7 + 2 + 1);
        assert!((of_record(state, 1) - expected).abs() < 1e-9);
    }
}

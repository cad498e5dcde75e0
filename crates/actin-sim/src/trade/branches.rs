//! Other stable states of an equilibrium: candidates on another branch than the reference.

use super::measure::{Measurer, Values};
use super::run::{Limits, run_once};
use super::worst;
use crate::scene::{Scene, Task};

/// Number of random starts of the search for other stable states.
const STARTS: usize = 8;

/// Error of a candidate, in units of the wanted error, from which other stable states are searched.
pub(super) const SUSPICIOUS: f64 = 5.0;

/// Largest error of a candidate relative to the stable state on its branch.
const SAME_BRANCH: f64 = 0.1;

/// The same error as a fraction of the error relative to the reference.
const SAME_BRANCH_SHARE: f64 = 0.25;

/// Another stable state of the reference that a candidate has reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OtherState {
    /// Largest error relative to this state.
    pub error: f64,
    /// Potential energy above the reference (pN nm); negative for a state of lower energy.
    pub above_reference_pn_nm: f64,
}

/// Values of the compared items in a stable state, and its potential energy above the reference (pN nm).
pub(super) struct Branch {
    pub values: Values,
    pub above_reference_pn_nm: f64,
}

/// Returns the other stable states of one equilibrium, with the time of the search (s); empty for
/// paths of several stages, motions and failed searches.
pub(super) fn other_states(
    scene: &Scene,
    measurer: &Measurer,
    limits: Limits<'_>,
) -> (Vec<Branch>, f64) {
    let mut scene = scene.clone();
    let result = match &mut scene.task {
        Task::Equilibrium(settings) if scene.path.len() <= 1 => {
            settings.states = STARTS;
            run_once(&scene, limits).ok()
        }
        _ => None,
    };
    let Some(result) = result else {
        return (Vec::new(), 0.0);
    };
    let states = result.states.into_iter().flat_map(|found| found.states);
    let others = states.filter(|state| !state.is_result);
    let branches = others.map(|state| Branch {
        values: measurer.values(&result.assembly, &[state.record]),
        above_reference_pn_nm: state.above_result_pn_nm,
    });
    (branches.collect(), result.wall_s)
}

/// Returns the stable state on whose branch `values` lie; `None` if all states differ too much.
///
/// `error` is the largest error of `values` relative to the reference.
pub(super) fn closest(
    measurer: &Measurer,
    branches: &[Branch],
    values: &Values,
    error: f64,
) -> Option<OtherState> {
    let states = branches.iter().map(|branch| OtherState {
        error: worst(&measurer.errors(&branch.values, values)),
        above_reference_pn_nm: branch.above_reference_pn_nm,
    });
    let closest = states.min_by(|a, b| a.error.total_cmp(&b.error));
    closest.filter(|state| state.error <= SAME_BRANCH.min(SAME_BRANCH_SHARE * error))
}

#[cfg(test)]
mod tests {
    use super::super::measure::Measure;
    use super::*;
    use crate::Assembly;

    /// A compressed rod with shifted ends has several buckled states.
    #[test]
    fn a_state_on_another_branch_is_recognised() {
        let scene = Scene::from_ron(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 160.0)]),
                clamps: [Clamp(end: Start), Clamp(end: End)],
                path: [Stage(set: [Shift(end: End, shift_nm: (2.0, 0.0, -20.0))])],
                task: Equilibrium(),
            )",
        );
        let scene = scene.expect("the scene is valid");
        let assembly = Assembly::build(&scene).expect("the scene can be built");
        let measures = [Measure::EndCouple, Measure::Height];
        let measurer = Measurer::new(&assembly, &measures).expect("the scene has clamps");
        let limits = Limits {
            budget: None,
            records: None,
            is_interrupted: &|| false,
        };
        let (branches, _) = other_states(&scene, &measurer, limits);
        assert!(!branches.is_empty());
        let reference =
            run_once(&scene, limits).map(|run| measurer.values(&run.assembly, &run.records));
        let reference = reference.expect("the path ends at an equilibrium");
        for branch in &branches {
            let error = worst(&measurer.errors(&reference, &branch.values));
            let state = closest(&measurer, &branches, &branch.values, error).expect("it is known");
            assert!(state.error < 1e-9 && error > 0.01, "{state:?}, {error}");
        }
        assert_eq!(closest(&measurer, &branches, &reference, 0.0), None);
    }
}

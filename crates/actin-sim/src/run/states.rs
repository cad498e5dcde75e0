//! Other stable states of a scene, looked for about the equilibrium in which its path ends.

use super::taken::Taken;
use super::{At, Record};
use crate::Assembly;
use actin_equilibrium::{Found, Iteration, Known, Newton, Search, SearchObserver, SolveError};
use actin_mechanics::State;
use std::ops::ControlFlow;

/// Seed of the starts.
const SEED: u64 = 1;

/// The stable states that a search has found.
#[derive(Clone, Debug, PartialEq)]
pub struct StableStates {
    /// The states, that of least energy first; the result of the run is one of them.
    pub states: Vec<StableState>,
    /// Starts that led to no stable state, or to one that lost a turn or left the model's use on the way.
    pub lost: usize,
}

/// One of several stable states.
#[derive(Clone, Debug, PartialEq)]
pub struct StableState {
    /// The state, as a record whose place is that of the result.
    pub record: Record,
    /// Potential energy less that of the result (pN nm).
    pub above_result_pn_nm: f64,
    /// How many starts led to it.
    pub starts: usize,
    /// Whether it is the result of the run.
    pub is_result: bool,
}

/// Looks for other stable states than `state`, an equilibrium at `at`; none if the sink interrupts it.
///
/// # Errors
/// If the equilibrium cannot be solved again.
pub(super) fn search(
    assembly: &Assembly,
    (newton, taken): (&mut Newton, &mut Taken<'_>),
    (state, at): (&State, At),
    starts: usize,
) -> Result<Option<StableStates>, SolveError> {
    let interactions = assembly.system.interactions();
    let mut known = state.clone();
    let result = newton.solve(&mut known, interactions);
    let equilibrium = result.map_err(|failure| failure.cause)?;
    let energy = equilibrium.energy;
    let search = Search { starts, seed: SEED };
    // As built, with the ends where the path has led them.
    let mut reference = assembly.rest.clone();
    reference.controls.clone_from(&known.controls);
    if !assembly.drive.is_still() {
        assembly.drive.place(&mut reference, at.value());
    }
    let known = Known {
        state: &known,
        equilibrium: &equilibrium,
        reference: &reference,
    };
    let mut watch = Watch {
        assembly,
        taken,
        at,
    };
    let Found { states, lost } = match newton.search(&known, interactions, &search, &mut watch) {
        Ok(found) => found,
        Err(SolveError::Interrupted) => return Ok(None),
        Err(error) => return Err(error),
    };
    let states = states.into_iter().map(|one| StableState {
        record: super::equilibrium::record(&assembly.system, at.value(), &one.state),
        above_result_pn_nm: one.equilibrium.energy - energy,
        // The result itself was not started for.
        starts: one.found - usize::from(one.is_known),
        is_result: one.is_known,
    });
    Ok(Some(StableStates {
        states: states.collect(),
        lost,
    }))
}

/// Ends a search when the sink says so, and counts what is a result of the scene.
struct Watch<'a, 't> {
    assembly: &'a Assembly,
    taken: &'a mut Taken<'t>,
    at: At,
}

impl SearchObserver for Watch<'_, '_> {
    fn iterate(&mut self, _step: &Iteration) -> ControlFlow<()> {
        if self.taken.sink.is_interrupted() {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }

    fn counts(&mut self, state: &State) -> bool {
        self.taken.has_all_turns((state, self.at)) && self.assembly.beyond_use(state).is_empty()
    }
}

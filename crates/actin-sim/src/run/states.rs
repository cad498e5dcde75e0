//! Search for other stable states near the equilibrium at the end of a path.

use super::Record;
use super::record_stream::RecordStream;
use crate::Assembly;
use crate::At;
use actin_equilibrium::{
    Iteration, KnownEquilibrium, Newton, Search, SearchObserver, SearchResult, SolveError,
};
use actin_mechanics::State;
use std::ops::ControlFlow;

const SEED: u64 = 1;

/// Stable states found by a search.
#[derive(Clone, Debug, PartialEq)]
pub struct StableStates {
    /// States in ascending order of energy, including the result of the run.
    pub states: Vec<StableState>,
    /// Number of initial guesses that led to no stable state, or to a state with a lost turn or
    /// outside the validity of the model.
    pub lost: usize,
}

/// Stable state found by a search.
#[derive(Clone, Debug, PartialEq)]
pub struct StableState {
    /// State as a record at the place of the result.
    pub record: Record,
    /// Potential energy relative to the result (pN nm).
    pub above_result_pn_nm: f64,
    /// Number of initial guesses that led to it.
    pub starts: usize,
    /// `true` for the result of the run.
    pub is_result: bool,
}

/// Searches for stable states other than `state`, an equilibrium at `at`; `None` if the sink
/// interrupts the search.
///
/// # Errors
/// If the equilibrium cannot be solved again.
pub(super) fn search(
    assembly: &Assembly,
    (newton, records): (&mut Newton, &mut RecordStream<'_>),
    (state, at): (&State, At),
    starts: usize,
) -> Result<Option<StableStates>, SolveError> {
    let interactions = assembly.system.interactions();
    let mut known = state.clone();
    let result = newton.solve(&mut known, interactions);
    let equilibrium = result.map_err(|failure| failure.cause)?;
    let energy = equilibrium.energy;
    let search = Search { starts, seed: SEED };
    // State as built, with the ends at the end of the path.
    let mut reference = assembly.rest.clone();
    reference.controls.clone_from(&known.controls);
    if !assembly.drive.is_still() {
        assembly.drive.place(&mut reference, at.value());
    }
    let known = KnownEquilibrium {
        state: &known,
        equilibrium: &equilibrium,
        reference: &reference,
    };
    let mut watch = Watch {
        assembly,
        records,
        at,
    };
    let SearchResult { states, lost } =
        match newton.search(&known, interactions, &search, &mut watch) {
            Ok(found) => found,
            Err(SolveError::Interrupted) => return Ok(None),
            Err(error) => return Err(error),
        };
    let states = states.into_iter().map(|one| StableState {
        record: Record::of_equilibrium(&assembly.system, at.value(), &one.state),
        above_result_pn_nm: one.equilibrium.energy - energy,
        // The result has no initial guess.
        starts: one.found - usize::from(one.is_known),
        is_result: one.is_known,
    });
    Ok(Some(StableStates {
        states: states.collect(),
        lost,
    }))
}

/// Observer that interrupts the search for the sink and filters valid results.
struct Watch<'a, 't> {
    assembly: &'a Assembly,
    records: &'a mut RecordStream<'t>,
    at: At,
}

impl SearchObserver for Watch<'_, '_> {
    fn iterate(&mut self, _step: &Iteration) -> ControlFlow<()> {
        if self.records.sink.is_interrupted() {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }

    fn counts(&mut self, state: &State) -> bool {
        self.records.has_all_turns((state, self.at)) && self.assembly.beyond_use(state).is_empty()
    }
}

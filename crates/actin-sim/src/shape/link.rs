//! Link of a filament with held ends: the sum of twist and writhe.

use super::Ribbon;
use crate::{Assembly, At, End};
use actin_mechanics::State;

/// Link of filament 0 (turns): rotation of the end relative to the start about the axis as built,
/// prescribed by the path of the scene at a time or place.
///
/// With both ends extended straight along that axis to infinity, `twist + writhe = link`. The sum
/// changes by two turns if the filament passes through itself or one of the extensions. `None` if
/// an end is free or tilted by the path, because the link is then not defined.
///
/// # Source
/// J. H. White, Am. J. Math. 91 (1969) 693; F. B. Fuller, PNAS 75 (1978) 3557.
pub fn link(assembly: &Assembly, at: At) -> Option<f64> {
    assembly.link_at(0, assembly.path_parameter(at))
}

/// Tolerance (turns) within which twist plus writhe is a whole number.
pub(crate) const WHOLE: f64 = 0.05;

/// Returns `true` if both ends of a filament are held, but twist plus writhe in `state` cannot
/// reveal lost turns.
pub(crate) fn link_is_unknown(
    assembly: &Assembly,
    filament: usize,
    (state, at): (&State, At),
) -> bool {
    if [End::Start, End::End]
        .iter()
        .any(|end| assembly.held.turned_at(filament, *end).is_none())
    {
        return false;
    }
    let sum = |state| Ribbon::from_state(assembly, filament, state).linking();
    let change = sum(state).zip(sum(&assembly.rest));
    let Some(((now, built), turn)) = change.zip(assembly.turn_of_ends(filament, at)) else {
        return true;
    };
    let off = now - built - turn;
    (off - off.round()).abs() > WHOLE
}

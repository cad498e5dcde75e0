//! The link of a filament whose ends are held: what twist and writhe have to add up to.

use crate::assembly::StageTimes;
use crate::scene::is_across;
use crate::{Assembly, End, Task};
use actin_mechanics::Vector3;
use std::f64::consts::PI;

/// Link of filament 0 in turns: how far the end has been turned about the axis of the filament as
/// built against the start, as the path of the scene prescribes at `time_ns` (of an equilibrium the
/// path parameter).
///
/// `twist + writhe = link`, with both ends going on straight along that axis to be closed at
/// infinity, as long as the filament has not passed through itself or one of these straight lines
/// on its way, which changes the sum by two. None where an end is free, or tilted by the path: then
/// the ends are not parallel and the link is not defined.
///
/// # Source
/// J. H. White, Am. J. Math. 91 (1969) 693; F. B. Fuller, PNAS 75 (1978) 3557.
pub fn link(assembly: &Assembly, time_ns: f64) -> Option<f64> {
    link_of(assembly, 0, time_ns)
}

/// The same of any filament.
///
/// # Panics
/// If there is no such filament.
pub fn link_of(assembly: &Assembly, filament: usize, time_ns: f64) -> Option<f64> {
    link_at(assembly, filament, path_parameter(assembly, time_ns))
}

/// The same at a path parameter.
pub(crate) fn link_at(assembly: &Assembly, filament: usize, parameter: f64) -> Option<f64> {
    let axis = assembly.filaments[filament].axis();
    let turn = |end| {
        let clamp = assembly.held.clamp_at(filament, end)?;
        let turn: Vector3 = assembly.drive.turn(clamp, parameter);
        (!is_across(turn, axis)).then(|| turn.dot(&axis))
    };
    Some((turn(End::End)? - turn(End::Start)?) / (2.0 * PI))
}

/// Where on the path of the scene a record stands.
pub(crate) fn path_parameter(assembly: &Assembly, time_ns: f64) -> f64 {
    match assembly.scene.task {
        Task::Equilibrium(_) => time_ns,
        Task::Dynamics(_) => StageTimes::of(assembly).parameter(time_ns).0,
    }
}

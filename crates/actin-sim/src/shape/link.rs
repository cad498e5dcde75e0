//! The link of a filament whose ends are held: what twist and writhe have to add up to.

use crate::assembly::Ramp;
use crate::{Assembly, End, Task};
use actin_mechanics::Vector3;
use std::f64::consts::PI;

/// Link in turns: how far the end has been turned about lab z against the start, as the path of
/// the scene prescribes at `time_ns` (of an equilibrium the path parameter).
///
/// `twist + writhe = link`, with both ends going on straight along lab z to be closed at infinity,
/// as long as the filament has not passed through itself or one of these straight lines on its way,
/// which changes the sum by two. None where an end is free, or tilted by the path: then the ends
/// are not parallel and the link is not defined.
///
/// # Source
/// J. H. White, Am. J. Math. 91 (1969) 693; F. B. Fuller, PNAS 75 (1978) 3557.
pub fn link(assembly: &Assembly, time_ns: f64) -> Option<f64> {
    let parameter = path_parameter(assembly, time_ns);
    let turn = |end| {
        let clamp = assembly.clamps.iter().position(|c| c.end == end)?;
        let turn: Vector3 = assembly.drive.turn(clamp, parameter);
        (turn.x == 0.0 && turn.y == 0.0).then_some(turn.z)
    };
    Some((turn(End::End)? - turn(End::Start)?) / (2.0 * PI))
}

/// Where on the path of the scene a record stands.
fn path_parameter(assembly: &Assembly, time_ns: f64) -> f64 {
    match assembly.scene.task {
        Task::Equilibrium(_) => time_ns,
        Task::Dynamics(_) => Ramp::of(assembly).map_or(0.0, |ramp| ramp.parameter(time_ns).0),
    }
}

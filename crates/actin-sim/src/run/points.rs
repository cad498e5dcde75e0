//! How many equilibria a path may have.

use crate::scene::{Equilibrium as Settings, SceneProblem};
use crate::{Assembly, memory};

/// Refuses a path with more equilibria than memory holds: each stage has at least as many as steps of
/// the largest length fill it.
pub(super) fn check_points(assembly: &Assembly, settings: &Settings) -> Result<(), SceneProblem> {
    let least = assembly.drive.stages() as f64 / settings.largest_step;
    let record = memory::of_kept_record(assembly);
    let value = format!("{:?}", settings.largest_step);
    memory::check(
        assembly.bytes + least * record,
        ("task.largest_step", value),
        || {
            let bodies = assembly.points.len() + assembly.frames.len();
            format!("{least:.2e} equilibria of {bodies} bodies and more need")
        },
    )
}

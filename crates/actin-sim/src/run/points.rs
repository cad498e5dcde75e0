//! Upper bound of the number of equilibria on a path.

use crate::scene::{Equilibrium as Settings, SceneProblem};
use crate::{Assembly, memory};

/// Refuses a path with more equilibria than fit in memory, counted with steps of the largest
/// length.
pub(super) fn check_points(assembly: &Assembly, settings: &Settings) -> Result<(), SceneProblem> {
    let least = assembly.drive.stages() as f64 / settings.largest_step;
    let record = memory::of_kept_record(assembly);
    let value = format!("{:?}", settings.largest_step);
    actin_assembly::memory::check(
        assembly.bytes + least * record,
        ("task.largest_step", value),
        || {
            let bodies = assembly.points.len() + assembly.frames.len();
            format!("{least:.2e} equilibria of {bodies} bodies and more need")
        },
    )
}

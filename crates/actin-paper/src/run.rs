//! Runs into memory.

use actin_sim::{Assembly, Outcome, Plan, RunError, Trajectory};

/// Runs an assembly as its scene asks; it is then in its last state.
pub(crate) fn run_to_end(assembly: &mut Assembly) -> Result<(Trajectory, Outcome), RunError> {
    let (trajectory, outcome) = Plan::new(assembly)?.run()?;
    if let Some(last) = trajectory.records.last() {
        *assembly.system.state_mut() = last.state.clone();
    }
    Ok((trajectory, outcome))
}

//! Validation of `leave_saddles`.

use super::{Dynamics, Load, Scene, SceneProblem, rules};

/// Checks that the scene has a potential and no noise, which `leave_saddles` requires.
pub(super) fn check(scene: &Scene, dynamics: &Dynamics) -> Result<(), SceneProblem> {
    if dynamics.leave_saddles == 0 {
        return Ok(());
    }
    let refused = |rule| SceneProblem::new("task.leave_saddles", dynamics.leave_saddles, rule);
    if dynamics.thermal.is_some() {
        return Err(refused(
            "a filament in thermal motion is never at rest on a saddle: omit leave_saddles or \
             thermal",
        ));
    }
    if scene.loads.iter().any(Load::follows) {
        return Err(refused(
            "requires an energy, which loads with follows: true do not have: omit this key",
        ));
    }
    if scene
        .filaments()
        .any(|one| rules::check_potential(one).is_err())
    {
        return Err(refused(
            "requires an energy, which PaperBalance does not have: write EnergyGradient",
        ));
    }
    Ok(())
}

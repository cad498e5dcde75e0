//! Beads on filaments and their validation.

use super::linker::check_site;
use super::{LinkerSite, Scene, SceneProblem, Task};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Spherical bead attached rigidly to a filament. A linker between the same site and an anchor is an optical trap.
///
/// The centre has the friction `6 pi eta r`, and rotations have `8 pi eta r^3`. `eta` is the viscosity of the fluid,
/// and `r` the radius. The friction of the filament is added. A bead has no mass and no contacts, and does not change
/// equilibria.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Bead {
    /// Centre of the bead, which may be off the axis of the filament.
    pub site: LinkerSite,
    /// Radius; positive.
    pub radius_nm: f64,
}

/// Checks bead `i`. The sections of the scene must be valid.
pub(super) fn check(scene: &Scene, i: usize, bead: &Bead) -> Result<(), SceneProblem> {
    check_site(scene, &format!("beads[{i}].site"), &bead.site)?;
    match &scene.task {
        Task::Dynamics(dynamics) if dynamics.drag.fluid().is_none() => {
            let rule = "has no effect without a fluid: write drag: Water() or Brownian";
            Err(SceneProblem::new(format!("beads[{i}]"), "", rule))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use crate::Scene;

    const DUMBBELL: &str = "Scene(
        filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 100.0)]),
        beads: [
            Bead(site: Site(at_nm: 0.0), radius_nm: 250.0),
            Bead(site: Site(at_nm: 100.0, radius_nm: 250.0), radius_nm: 250.0),
        ],
        task: Brownian(duration_ms: 1.0, temperature_k: 0.0),
    )";

    #[test]
    fn beads_survive_the_round_trip_and_mistakes_are_refused() {
        let scene = Scene::from_ron(DUMBBELL).expect("the scene is valid");
        let printed = scene.to_ron();
        assert_eq!(Scene::from_ron(&printed).expect("it is valid"), scene);
        for (right, wrong, key) in [
            (
                "Site(at_nm: 0.0)",
                "Site(filament: 1, at_nm: 0.0)",
                "beads[0].site.filament",
            ),
            ("at_nm: 100.0", "at_nm: 101.0", "beads[1].site.at_nm"),
            (
                "0.0), radius_nm: 250.0",
                "0.0), radius_nm: -1.0",
                "beads[0].radius_nm",
            ),
            (
                "Brownian(duration_ms: 1.0, temperature_k: 0.0)",
                "Dynamics(duration_ns: 1.0)",
                "beads[0]",
            ),
        ] {
            let refused = Scene::from_ron(&DUMBBELL.replacen(right, wrong, 1)).expect_err(wrong);
            assert!(refused.to_string().contains(key), "{wrong}: {refused}");
        }
    }
}

//! Beads on filaments and their validation.

use super::linker::check_site;
use super::{LinkerSite, Scene, SceneProblem, Task};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Spherical bead attached rigidly to a filament. A linker between the same site and an anchor is an optical trap.
///
/// The centre has the friction `6 pi eta r`, and rotations have `8 pi eta r^3`. `eta` is the viscosity of the fluid,
/// and `r` the radius. In a shear flow the bead turns with half of the vorticity. The friction of the filament is added. A bead has no mass and no contacts, and does not change
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

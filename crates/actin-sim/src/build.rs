//! Construction of scenes whose sections are not written out.

use crate::scene::{Scene, SceneProblem};
use crate::{Assembly, trade};

/// Builds a scene; chooses automatic sections first.
///
/// # Errors
/// As [`Assembly::build`]; if no sections can be chosen.
pub fn build(scene: &Scene) -> Result<Assembly, SceneProblem> {
    let mut filaments = scene.filaments();
    if filaments.all(|filament| filament.sections.adaptive().is_none()) {
        return Assembly::build(scene);
    }
    let (scene, chosen) = trade::choose(scene)?;
    let mut built = Assembly::build(&scene)?;
    built.build_s += chosen.wall_s;
    built.chosen = Some(chosen);
    Ok(built)
}

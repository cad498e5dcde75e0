//! Small geometric imperfection of a filament.

use super::{Filament, SceneProblem};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Largest amplitude relative to the length of the filament: larger ones would stretch it noticeably.
const LARGEST: f64 = 0.01;

/// Smooth initial displacement of a filament from its axis.
///
/// It breaks the symmetry of a straight filament, which otherwise stays straight under any compression. The rest
/// shape stays straight: equilibria equal the equilibria of the perfect filament.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Imperfection {
    /// Largest displacement of the axis; positive, at most a hundredth of the length.
    pub amplitude_nm: f64,
    /// Seed of the shape.
    pub seed: u64,
}

pub(super) fn check(filament: &Filament) -> Result<(), SceneProblem> {
    let Some(imperfection) = &filament.imperfection else {
        return Ok(());
    };
    let key = "filament.imperfection.amplitude_nm";
    let amplitude = imperfection.amplitude_nm;
    let limit = LARGEST * filament.length_nm();
    if amplitude > limit {
        let rule = format!(
            "must be at most a hundredth of the filament's length, {limit} nm: it is meant to break \
             the symmetry, not to load the filament"
        );
        return Err(SceneProblem::new(key, format!("{amplitude:?}"), rule));
    }
    Ok(())
}

//! The kinetic energy beyond which a motion is not one: more than its loads can have given it.

use crate::Assembly;
use crate::scene::{Load, Slides};
use actin_mechanics::Vector3;

/// By how much the limit exceeds the bound: room for errors of the integrator near its stability
/// limit and for loads that are not the gradient of an energy.
const ROOM: f64 = 2.0;

/// Added to the limit (pN nm), so that round-off in a filament without loads, 1e-20, is no motion.
const LEAST: f64 = 1.0;

/// Limit of the kinetic energy (pN nm); infinite where no bound is known.
///
/// A filament whose controls stay has at most the energy that it begins with and the work of its
/// loads. Held fast at one end it lets each do `|F| 2 L` at most: nothing on it is ever further
/// from where it was than twice its length.
pub(super) fn kinetic_limit(assembly: &Assembly) -> f64 {
    let scene = &assembly.scene;
    let is_fast = |clamp: &crate::Clamped| clamp.slides == Slides::Nowhere;
    let is_bounded = scene.loads.is_empty() || assembly.clamps.iter().any(is_fast);
    if !scene.path.is_empty() || !is_bounded {
        return f64::INFINITY;
    }
    let forces = scene.loads.iter().map(|load| match load {
        Load::EndForce { force_pn, .. } => Vector3::from(*force_pn).norm(),
    });
    let work = forces.sum::<f64>() * 2.0 * assembly.length_nm();
    let limit = ROOM * (assembly.system.total_energy() + work) + LEAST;
    if limit.is_nan() { f64::INFINITY } else { limit }
}

#[cfg(test)]
mod tests {
    use super::kinetic_limit;
    use crate::{Assembly, Scene};

    const FORCE: &str = "EndForce(end: End, force_pn: (3.0, 0.0, 4.0))";

    fn limit_of(clamps: &str, loads: &str) -> f64 {
        let text = format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 30.0)]),
                clamps: [{clamps}],
                loads: [{loads}],
                task: Dynamics(duration_ns: 1.0),
            )"
        );
        let scene = Scene::from_ron(&text).unwrap();
        kinetic_limit(&Assembly::build(&scene).unwrap())
    }

    /// 5 pN over 60 nm, twice, and 1. What is free goes ever faster under a load, but not without.
    #[test]
    fn the_work_of_the_loads_is_bounded_where_an_end_is_fast() {
        assert!((limit_of("Clamp(end: Start)", FORCE) - 601.0).abs() < 1e-9);
        assert!(limit_of("", FORCE).is_infinite());
        assert!((limit_of("", "") - 1.0).abs() < 1e-9);
    }
}

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
/// Where some end is held fast and so is one of every filament that is loaded, and where controls
/// stay, there is at most the energy that the scene begins with and the work of its loads,
/// `|F| 2 L` each: nothing on a filament held fast is ever further from where it was than twice its
/// length.
pub(super) fn kinetic_limit(assembly: &Assembly) -> f64 {
    let scene = &assembly.scene;
    let is_fast = |filament: usize| {
        let mut clamps = assembly.clamps.iter();
        clamps.any(|clamp| clamp.filament == filament && clamp.slides == Slides::Nowhere)
    };
    let are_fast = scene.loads.iter().all(|load| match load {
        Load::EndForce { filament, .. } => is_fast(*filament),
    });
    let some_are_fast = (0..assembly.filaments.len()).any(is_fast);
    if !scene.path.is_empty() || !some_are_fast || !are_fast {
        return f64::INFINITY;
    }
    let works = scene.loads.iter().map(|load| match load {
        Load::EndForce {
            filament, force_pn, ..
        } => Vector3::from(*force_pn).norm() * assembly.length_of(*filament),
    });
    let work = 2.0 * works.sum::<f64>();
    let limit = ROOM * (assembly.system.total_energy() + work) + LEAST;
    if limit.is_nan() { f64::INFINITY } else { limit }
}

#[cfg(test)]
mod tests {
    use super::kinetic_limit;
    use crate::{Assembly, Scene};

    fn limit_of(clamps: &str) -> f64 {
        let text = format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 30.0)]),
                clamps: [{clamps}],
                loads: [EndForce(end: End, force_pn: (3.0, 0.0, 4.0))],
                task: Dynamics(duration_ns: 1.0),
            )"
        );
        let scene = Scene::from_ron(&text).unwrap();
        kinetic_limit(&Assembly::build(&scene).unwrap())
    }

    /// 5 pN over 60 nm, twice, and 1. What is free goes ever faster.
    #[test]
    fn the_work_of_the_loads_is_bounded_where_an_end_is_fast() {
        assert!((limit_of("Clamp(end: Start)") - 601.0).abs() < 1e-9);
        assert!(limit_of("").is_infinite());
    }
}

//! The kinetic energy beyond which a motion is not one: more than its loads can have given it.

use crate::Assembly;
use crate::scene::{Load, Resultant, Slides, Task};

/// By how much the limit exceeds the bound: room for errors of the integrator near its stability
/// limit and for loads that are not the gradient of an energy.
const ROOM: f64 = 2.0;

/// Added to the limit (pN nm), so that round-off in a filament without loads, 1e-20, is no motion.
const LEAST: f64 = 1.0;

/// How many times the thermal energy a whole filament may have beyond the mean of its kinetic energy:
/// more than ever comes up, since its probability falls by a factor e with each.
const THERMAL_EXCESS: f64 = 50.0;

/// Limit of the kinetic energy (pN nm) of a motion that begins with an energy (pN nm); infinite where no bound is known.
///
/// Filaments whose controls stay have at most the energy that they begin with and the work of their
/// loads. A filament that is held fast lets each load do `|F| 2 L` at most: nothing on it is ever
/// further from where it was than twice its length. In a heat bath there is thermal energy besides,
/// half of `kT` for each degree of freedom and `THERMAL_EXCESS` of them in all.
pub(super) fn kinetic_limit(assembly: &Assembly, begun_with: f64) -> f64 {
    let scene = &assembly.scene;
    let is_fast = |filament: usize| {
        let mut clamps = assembly.clamps.iter();
        clamps.any(|clamp| clamp.filament == filament && clamp.slides == Slides::Nowhere)
    };
    let work_of = |load: &Load| match load.resultant(scene) {
        Resultant::Force(force) if stays(load) && is_fast(load.filament()) => {
            2.0 * (force.norm() * assembly.length_of(load.filament()))
        }
        _ => f64::INFINITY,
    };
    let work: f64 = scene.loads.iter().map(work_of).sum();
    // What binds in a stretched state brings energy with it.
    if !scene.path.is_empty() || work.is_infinite() || assembly.kinetics.is_some() {
        return f64::INFINITY;
    }
    let heat = thermal_energy(assembly) * (0.5 * assembly.counts().dofs as f64 + THERMAL_EXCESS);
    let limit = ROOM * (begun_with + work + heat) + LEAST;
    if limit.is_nan() { f64::INFINITY } else { limit }
}

/// Whether a load is the same at all times and places, and its resultant what it was in the scene.
fn stays(load: &Load) -> bool {
    !load.follows() && load.factor().is_constant() && !matches!(load, Load::Acceleration(_))
}

/// The thermal energy `kT` (pN nm); none without a bath.
fn thermal_energy(assembly: &Assembly) -> f64 {
    match &assembly.scene.task {
        Task::Dynamics(dynamics) => dynamics.thermal.map_or(0.0, |t| t.energy_pn_nm()),
        Task::Brownian(_) | Task::Equilibrium(_) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::kinetic_limit;
    use crate::{Assembly, Scene};

    const FORCE: &str = "EndForce(end: End, force_pn: (3.0, 0.0, 4.0))";

    fn limit_of(clamps: &str, loads: &str) -> f64 {
        limit_in(clamps, loads, "duration_ns: 1.0")
    }

    fn limit_in(clamps: &str, loads: &str, task: &str) -> f64 {
        let text = format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 30.0)], rod: RodModel(law: Constant)),
                clamps: [{clamps}],
                loads: [{loads}],
                task: Dynamics({task}),
            )"
        );
        let scene = Scene::from_ron(&text).unwrap();
        let assembly = Assembly::build(&scene).unwrap();
        kinetic_limit(&assembly, assembly.system.total_energy())
    }

    /// 5 pN over 60 nm, twice, and 1. What is free goes ever faster under a load, but not without.
    #[test]
    fn the_work_of_the_loads_is_bounded_where_an_end_is_fast() {
        assert!((limit_of("Clamp(end: Start)", FORCE) - 601.0).abs() < 1e-9);
        assert!(limit_of("", FORCE).is_infinite());
        assert!((limit_of("", "") - 1.0).abs() < 1e-9);
    }

    /// 18 degrees of freedom (three nodes, three frames) at 300 K: 2 (9 + 50) kT more. Without them
    /// a thermal filament under no load, whose bound is 1 pN nm, would fail at once.
    #[test]
    fn heat_counts() {
        let task = "duration_ns: 1.0, thermal: (temperature_k: 300.0, seed: 1), \
                    drag: (translational_per_ns: 1.0, rotational_per_ns: 1.0)";
        let heat =
            limit_in("Clamp(end: Start)", FORCE, task) - limit_of("Clamp(end: Start)", FORCE);
        assert!((heat - 118.0 * 300.0 * 0.013_806_49).abs() < 1e-9);
    }
}

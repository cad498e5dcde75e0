//! Upper bound of the kinetic energy of a motion, for the detection of divergence.

use crate::Assembly;
use crate::scene::{FreeTranslation, Load, Resultant, Task};

/// Safety factor for integrator errors near the stability limit and for nonconservative loads.
const ROOM: f64 = 2.0;

/// Absolute margin (pN nm) above round-off in filaments without loads, about 1e-20.
const LEAST: f64 = 1.0;

/// Margin above the mean thermal kinetic energy of a filament, in units of kT. The probability
/// falls by a factor e per unit.
const THERMAL_EXCESS: f64 = 50.0;

/// Upper bound of the kinetic energy (pN nm) of a motion with initial energy `begun_with` (pN nm);
/// infinite if unknown.
///
/// With constant controls, the energy is at most the initial energy plus the work of the loads. On
/// a clamped filament each load does at most the work `2 L |F|`, because no point moves by more
/// than twice the length. A heat bath adds `kT / 2` per degree of freedom and `THERMAL_EXCESS` kT
/// in total.
pub(super) fn kinetic_limit(assembly: &Assembly, begun_with: f64) -> f64 {
    let scene = &assembly.scene;
    let is_fast = |filament: usize| {
        let mut clamps = assembly.clamps.iter();
        clamps.any(|clamp| clamp.filament == filament && clamp.slides == FreeTranslation::Nowhere)
    };
    let work_of = |load: &Load| match load.resultant(scene) {
        Resultant::Force(force) if stays(load) && is_fast(load.filament()) => {
            2.0 * (force.norm() * assembly.length_of(load.filament()))
        }
        _ => f64::INFINITY,
    };
    let work: f64 = scene.loads.iter().map(work_of).sum();
    // Linkers that form in a stretched state add energy.
    if !scene.path.is_empty() || work.is_infinite() || assembly.kinetics.is_some() {
        return f64::INFINITY;
    }
    let heat = thermal_energy(assembly) * (0.5 * assembly.counts().dofs as f64 + THERMAL_EXCESS);
    let limit = ROOM * (begun_with + work + heat) + LEAST;
    if limit.is_nan() { f64::INFINITY } else { limit }
}

/// Returns `true` if a load is constant in time and space and keeps its resultant.
fn stays(load: &Load) -> bool {
    !load.follows() && load.factor().is_constant() && !matches!(load, Load::Acceleration(_))
}

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

    /// Twice 60 nm times 5 pN, plus 1. Without a clamp the work is unbounded.
    #[test]
    fn the_work_of_the_loads_is_bounded_where_an_end_is_fast() {
        assert!((limit_of("Clamp(end: Start)", FORCE) - 601.0).abs() < 1e-9);
        assert!(limit_of("", FORCE).is_infinite());
        assert!((limit_of("", "") - 1.0).abs() < 1e-9);
    }

    /// 18 degrees of freedom (three nodes, three frames) at 300 K add 2 (9 + 50) kT.
    #[test]
    fn heat_counts() {
        let task = "duration_ns: 1.0, thermal: (temperature_k: 300.0, seed: 1), \
                    drag: (translational_per_ns: 1.0, rotational_per_ns: 1.0)";
        let heat =
            limit_in("Clamp(end: Start)", FORCE, task) - limit_of("Clamp(end: Start)", FORCE);
        assert!((heat - 118.0 * 300.0 * 0.013_806_49).abs() < 1e-9);
    }
}

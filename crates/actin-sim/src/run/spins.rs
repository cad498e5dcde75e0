//! Spins of filaments about their axes in overdamped motion.

use crate::scene::{Brownian as Task, Flow, SceneProblem, Task as AnyTask};
use crate::{Assembly, SectionSpan};
use actin_mechanics::RandomStress;
use std::collections::HashSet;

/// Largest mean square of a spin in a step (rad^2), if energies depend on it.
///
/// For 20 pairs of filaments of 20 um in segments of 1 um, joined by linkers with stiffness against
/// tilt and twist, steps with 0.5, 3.3 and 10 rad^2 take 7, 24 and 80 iterations.
const SQUARE: f64 = 0.5;

/// Largest step (ns) in which filaments whose spin changes energies do not spin far in thermal
/// motion: `<spin^2> = 2 kT h / (zeta L)` with the axial friction `zeta` per length.
pub(super) fn longest_step(
    assembly: &Assembly,
    task: &Task,
    thermal_energy: f64,
) -> Result<f64, SceneProblem> {
    let mut resisted = are_coupled(assembly);
    for linker in &assembly.scene.linkers {
        let is_stiff = linker.angular().iter().any(|(_, k)| *k > 0.0);
        if linker.roams() {
            // The twist of these depends on directions of filaments alone.
            if linker.tilt_pn_nm > 0.0 {
                resisted.fill(true);
            }
        } else if is_stiff {
            resisted[linker.filament] = true;
            if let Some(other) = &linker.to {
                resisted[other.filament] = true;
            }
        }
    }
    let mut longest = f64::INFINITY;
    for filament in (0..resisted.len()).filter(|&k| resisted[k]) {
        let about = assembly.cylinder(&task.drag, filament)?.about();
        let length = assembly.written(filament).length_nm();
        longest = longest.min(SQUARE * about * length / (2.0 * thermal_energy));
    }
    Ok(longest)
}

/// Returns for each filament whether its spin about the axis is coupled to other motion.
///
/// Rod laws couple it if they are not isotropic about the axis. Elements couple it if they are
/// joined to frames off the axis: other sections, hinged walls and beads. Linkers that resist tilt or
/// twist do not: their own stiffness contains the spin.
pub(super) fn are_coupled(assembly: &Assembly) -> Vec<bool> {
    let sections = (0..assembly.filaments.len()).map(|filament| assembly.sections_of(filament));
    let mut coupled: Vec<bool> = sections
        .map(|sections| sections.len() != 1 || sections.iter().any(SectionSpan::is_ellipsoids))
        .collect();
    for clamp in assembly.scene.clamps.iter().filter(|c| c.hinge.is_some()) {
        coupled[clamp.filament] = true;
    }
    // A flow turns beads about axes across the filament.
    let flows = match &assembly.scene.task {
        AnyTask::Brownian(task) => task.flow != Flow::AtRest || assembly.scene.periodic.is_some(),
        _ => false,
    };
    let beads = assembly.scene.beads.iter();
    for bead in beads.filter(|bead| flows || bead.site.radius_nm > 0.0) {
        coupled[bead.site.filament] = true;
    }
    let stresses = assembly
        .system
        .interactions()
        .iter()
        .filter_map(|one| one.random_stress());
    let axial: HashSet<usize> = stresses.flat_map(RandomStress::axial_frames).collect();
    for frame in (0..assembly.system.state().frames.len()).filter(|frame| !axial.contains(frame)) {
        coupled[assembly.filament_of_frame(frame)] = true;
    }
    coupled
}

#[cfg(test)]
mod tests {
    use crate::scene::Scene;
    use crate::{Assembly, Plan};

    /// Steps of the relaxation time of a segment, 1.2e7 ns, do not converge.
    #[test]
    fn coarse_filaments_with_tilted_linkers_move_by_default() {
        let filament =
            "sections: [Rod(from_nm: 0.0, to_nm: 2e4, segments: 20)], rod: RodModel(law: Constant)";
        let text = format!(
            "Scene(
                filaments: [Filament({filament}), Filament({filament}, at_nm: (0.0, 20.0, 0.0))],
                linkers: [Linker(
                    filament: 0, at_nm: 1e4, to: Site(filament: 1, at_nm: 1e4),
                    stiffness_pn_per_nm: 1.0, rest_length_nm: 20.0, tilt_pn_nm: 50.0,
                )],
                output: Output(vtk: false, states: false),
                task: Brownian(duration_ms: 3.0, temperature_k: 298.0, record_every_ns: 3e6, seed: 1),
            )"
        );
        let assembly = Assembly::build(&Scene::from_ron(&text).unwrap()).unwrap();
        let plan = Plan::new(&assembly).unwrap();
        let (estimate, outcome) = plan.run().unwrap();
        assert!(outcome.steps > 10 && outcome.steps < 100, "{estimate:?}");
        let evaluations = outcome.force_evaluations;
        assert!(evaluations < 12 * outcome.steps, "{evaluations}");
    }
}

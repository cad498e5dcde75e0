//! Construction of scenes that start from another run.

use crate::{FinishedRun, RunDirectory};
use actin_sim::{Assembly, Scene, SceneProblem, Start, Status};

/// Builds a scene as [`actin_sim::build`], and reads its initial state from the run that `start` names.
///
/// # Errors
/// As [`actin_sim::build`]; if the run failed or was interrupted, cannot be read, or has other bodies.
pub fn build(scene: &Scene) -> Result<Assembly, SceneProblem> {
    let mut assembly = actin_sim::build(scene)?;
    let Some(Start::Run { directory }) = &scene.start else {
        return Ok(assembly);
    };
    let run = FinishedRun::open(directory).and_then(|run| {
        let summary = RunDirectory::existing(directory).summary()?;
        Ok((summary, run.last_state()?, run))
    });
    let (summary, state, run) = run.map_err(|error| assembly.refused_start(error.to_string()))?;
    let rule = match summary.status {
        Status::Converged | Status::Completed => None,
        Status::Failed => Some(format!("is a run that failed: {}", summary.failure)),
        Status::Interrupted => Some("is an interrupted run: continue it with --resume".to_owned()),
    };
    if let Some(rule) = rule {
        return Err(assembly.refused_start(rule));
    }
    assembly.start_from(run.assembly(), &state)?;
    Ok(assembly)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::RunDirectory;
    use actin_sim::mechanics::State;
    use actin_sim::{End, Plan};
    use std::fs;
    use std::path::Path;

    /// Filament of monomers and a rod with other keys of the scene.
    fn scene(keys: &str) -> Scene {
        let text = format!(
            "Scene(
                filament: Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 12.0), Rod(from_nm: 12.0, to_nm: 42.0)]),
                clamps: [Clamp(end: Start)],
                output: (vtk: false),
                {keys}
            )"
        );
        Scene::from_ron(&text).unwrap()
    }

    fn after(run: &Path, keys: &str) -> Scene {
        let start = Some(Start::Run {
            directory: run.display().to_string(),
        });
        Scene {
            start,
            ..scene(keys)
        }
    }

    /// Writes a run into a folder and returns its states.
    fn run(scene: &Scene, folder: &Path) -> Vec<State> {
        let assembly = build(scene).unwrap();
        let plan = Plan::new(&assembly).unwrap();
        let (trajectory, outcome) = plan.run().unwrap();
        let directory = RunDirectory::create(folder, false).unwrap();
        directory.write(&plan, &trajectory, &outcome).unwrap();
        trajectory
            .records
            .into_iter()
            .map(|record| record.state)
            .collect()
    }

    fn refusal(scene: &Scene) -> String {
        build(scene).unwrap_err().to_string()
    }

    const LOAD: &str = "loads: [EndForce(end: End, force_pn: (-1.0, 0.0, 0.0))],";

    /// Two motions of 0.2 ns equal one of 0.4 ns up to the times of the steps.
    #[test]
    fn motions_continue() {
        let folder = tempfile::tempdir().unwrap();
        let motion =
            |ns: f64| format!("{LOAD} task: Dynamics(duration_ns: {ns:?}, time_step_ns: 1e-4)");
        let [first, second, whole] =
            ["first", "second", "whole"].map(|name| folder.path().join(name));
        run(&scene(&motion(0.2)), &first);
        let continued = run(&after(&first, &motion(0.2)), &second);
        let whole = run(&scene(&motion(0.4)), &whole);
        let tips = [&continued, &whole].map(|states| states.last().unwrap());
        let [places, velocities] = [
            tips.map(|state| state.points.position.get(state.points.len() - 1)),
            tips.map(|state| state.points.velocity.get(state.points.len() - 1)),
        ];
        assert!((places[0] - places[1]).norm() < 1e-9, "{places:?}");
        assert!(
            (velocities[0] - velocities[1]).norm() < 1e-8,
            "{velocities:?}"
        );
        assert!(velocities[0].norm() > 1e-2);
    }

    /// A released cantilever begins with the energy of its equilibrium, and stays there under the same load.
    #[test]
    fn motions_begin_at_an_equilibrium() {
        let folder = tempfile::tempdir().unwrap();
        let (bent, motion) = (folder.path().join("bent"), folder.path().join("motion"));
        let equilibrium = run(&scene(&format!("{LOAD} task: Equilibrium()")), &bent)
            .pop()
            .unwrap();
        let tip = |state: &State| state.points.position.get(state.points.len() - 1);
        let held = run(
            &after(&bent, &format!("{LOAD} task: Dynamics(duration_ns: 0.5)")),
            &motion,
        );
        for state in &held {
            assert!((tip(state) - tip(&equilibrium)).norm() < 1e-6);
        }
        let assembly = build(&after(&bent, "task: Dynamics(duration_ns: 0.5)")).unwrap();
        let bent = assembly.system.potential_energy();
        assert!(bent > 0.01, "{bent}");
        let (_, outcome) = Plan::new(&assembly).unwrap().run().unwrap();
        let begun = outcome.begun_with_pn_nm.unwrap();
        assert!((begun - bent).abs() < 1e-12 * bent, "{begun} {bent}");
    }

    /// In heat the free end has a separate cross-section, which continues the last segment.
    #[test]
    fn motions_in_heat_begin_at_an_equilibrium() {
        let folder = tempfile::tempdir().unwrap();
        let [bent, warm] = ["bent", "warm"].map(|name| folder.path().join(name));
        let cold = scene(&format!("{LOAD} task: Equilibrium()"));
        let state = run(&cold, &bent).pop().unwrap();
        let heat = "task: Brownian(duration_ms: 1e-6, temperature_k: 298.0, seed: 1)";
        let begun = build(&after(&bent, heat)).unwrap();
        let own = begun.system.state();
        assert_eq!(own.points.position, state.points.position);
        let count = state.frames.len();
        assert_eq!(own.frames.len(), count + 1);
        for i in 0..count {
            assert_eq!(
                own.frames.orientation.get(i),
                state.frames.orientation.get(i)
            );
        }
        let last = own.frames.orientation.get(count);
        assert!(last.angle_to(&state.frames.orientation.get(count - 1)) < 1e-12);
        // An equilibrium has no such cross-section.
        let warmed = run(&after(&bent, heat), &warm).pop().unwrap();
        let again = build(&after(&warm, "task: Equilibrium()")).unwrap();
        assert_eq!(again.system.state().frames.len(), count);
        assert_eq!(again.system.state().points.position, warmed.points.position);
    }

    #[test]
    fn stages_move_clamps_from_their_last_places() {
        let folder = tempfile::tempdir().unwrap();
        let path = "path: [Stage(set: [
            Shift(end: Start, shift_nm: (1.0, 2.0, 0.0)), Turn(end: Start, turn_deg: (0.0, 30.0, 0.0)),
        ])], task: Equilibrium()";
        let [first, second] = ["first", "second"].map(|name| folder.path().join(name));
        let moved = run(&scene(path), &first).pop().unwrap();
        let twice = run(&after(&first, path), &second);
        let assembly = actin_sim::build(&scene(path)).unwrap();
        let clamp = assembly.clamp_at(0, End::Start).unwrap();
        let built = clamp.point_nm(&assembly.rest);
        let shift = clamp.point_nm(&moved) - built;
        let both = clamp.point_nm(twice.last().unwrap()) - built;
        assert!(
            (shift.x - 1.0).abs() < 1e-12 && (both - 2.0 * shift).norm() < 1e-12,
            "{both}"
        );
        let frame = clamp.frames[0];
        let turned = |state: &State| {
            assembly
                .rest
                .frames
                .orientation
                .get(frame)
                .angle_to(&state.frames.orientation.get(frame))
        };
        assert!((turned(twice.last().unwrap()).to_degrees() - 60.0).abs() < 1e-9);
        let unmoved = build(&after(&first, "task: Equilibrium()")).unwrap();
        assert!((clamp.point_nm(unmoved.system.state()) - built - shift).norm() < 1e-12);
    }

    #[test]
    fn unusable_runs_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let at = folder.path().join("run");
        let task = "task: Equilibrium()";
        assert!(refusal(&after(&at, task)).contains("is not a run directory: it has no scene.ron"));
        run(&scene("linkers: [Linker(at_nm: 30.0, displaced_nm: (0.5, 0.0, 0.0), stiffness_pn_per_nm: 3.0)],
            path: [Stage(set: [Anchor(linker: 0, shift_nm: (0.0, 1.0, 0.0))])], task: Equilibrium()"), &at);
        assert!(refusal(&after(&at, task)).contains("moves anchors"));
        let mut other = after(&at, task);
        other.filament.sections = Scene::from_ron(
            "Scene(filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 42.0)]), task: Equilibrium())",
        ).unwrap().filament.sections;
        assert!(
            refusal(&other).contains("write the same sections"),
            "{}",
            refusal(&other)
        );
        let mut moved = after(&at, task);
        moved.filament.at_nm = [30.0, 0.0, 0.0];
        run(&scene(task), &folder.path().join("other"));
        moved.start = after(&folder.path().join("other"), task).start;
        assert!(refusal(&moved).contains("filament 0 has another position"));
        let mut wider = after(&folder.path().join("other"), task);
        wider.filament.monomers.radius_nm = 2.2;
        assert!(refusal(&wider).contains("monomers are built at other places"));
        let summary = at.join("summary.json");
        let text = fs::read_to_string(&summary).unwrap();
        let failed = text.replacen('{', "{\"failure\": \"no equilibrium\",", 1);
        let failed = failed.replacen("\"converged\"", "\"failed\"", 1);
        fs::write(&summary, failed).unwrap();
        assert!(refusal(&after(&at, task)).contains("is a run that failed: no equilibrium"));
        let unread = actin_sim::build(&after(&at, task)).unwrap();
        let problem = Plan::new(&unread).unwrap_err();
        assert!(problem.rule.contains("actin_rundir::build"), "{problem}");
    }
}

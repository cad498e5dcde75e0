//! What the library says to the text of a scene: reading, building, estimating and running.

use actin_sim::{Assembly, Plan, RunError, Scene, SceneError, SceneProblem, Trajectory};

/// Most steps of a motion that is run; a longer one is looked at by its estimate alone.
const MOST_STEPS: u64 = 2_000;

/// How far a scene came.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Verdict {
    /// Refused when read, built or estimated, with its place in the text.
    Refused(SceneError),
    /// Run, but not to its end, and said why.
    Broke(String),
    /// Run to its end, with finite results.
    Ran,
    /// Accepted; it would take longer than is waited for.
    Accepted,
    /// Results with a number that is not finite: never right.
    NotFinite(String),
}

/// Takes a scene through the whole library, as the program does.
pub(super) fn verdict(text: &str) -> Verdict {
    let scene = match Scene::from_ron(text) {
        Ok(scene) => scene,
        Err(error) => return Verdict::Refused(error),
    };
    let refused = |problem: &SceneProblem| Verdict::Refused(SceneError::locate(problem, text));
    let assembly = match Assembly::build(&scene) {
        Ok(assembly) => assembly,
        Err(problem) => return refused(&problem),
    };
    let plan = match Plan::new(&assembly) {
        Ok(plan) => plan,
        Err(problem) => return refused(&problem),
    };
    if plan.estimate().is_some_and(|e| e.steps > MOST_STEPS) {
        return Verdict::Accepted;
    }
    match plan.run() {
        Ok((trajectory, _)) => finite(&trajectory),
        Err(RunError::Refused(problem)) => refused(&problem),
        Err(error) => Verdict::Broke(error.to_string()),
    }
}

fn finite(trajectory: &Trajectory) -> Verdict {
    for (i, record) in trajectory.records.iter().enumerate() {
        let energies = record.energies_pn_nm.iter().sum::<f64>() + record.kinetic_pn_nm;
        let residual = record.residual_force_pn + record.residual_torque_pn_nm;
        if !(record.state.is_finite() && energies.is_finite() && residual.is_finite()) {
            return Verdict::NotFinite(format!("record {i}: {energies} pN nm, {residual} pN"));
        }
    }
    Verdict::Ran
}

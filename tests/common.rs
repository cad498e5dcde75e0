//! Scenes as text: how tests build and run them, and what they are refused with.

use actin_mechanics::State;
use actin_sim::{Assembly, Failure, Outcome, Plan, RunError, Scene, Trajectory};

/// The assembly of a scene.
pub(crate) fn build(text: &str) -> Assembly {
    let scene = Scene::from_ron(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    Assembly::build(&scene).unwrap_or_else(|problem| panic!("{problem}\n{text}"))
}

/// Runs an assembly as its scene asks, which is then in its last state; with what was recorded whether it fails or not.
pub(crate) fn run_anyway(assembly: &mut Assembly) -> (Trajectory, Result<Outcome, RunError>) {
    let mut trajectory = Trajectory::default();
    let plan = Plan::new(assembly).map_err(RunError::from);
    let outcome = plan.and_then(|plan| plan.run_into(&mut trajectory));
    if let Some(last) = trajectory.records.last() {
        *assembly.system.state_mut() = last.state.clone();
    }
    (trajectory, outcome)
}

/// The same of a run that gets to its end.
pub(crate) fn run(assembly: &mut Assembly) -> Result<(Trajectory, Outcome), RunError> {
    let (trajectory, outcome) = run_anyway(assembly);
    outcome.map(|outcome| (trajectory, outcome))
}

/// What went wrong in a run, with what is known up to there.
///
/// # Panics
/// If it went well, or did not begin.
pub(crate) fn failure(outcome: Result<Outcome, RunError>) -> (Failure, Outcome) {
    match outcome {
        Err(RunError::Failed(failed)) => (failed.failure, failed.outcome),
        Err(RunError::Refused(problem)) => panic!("refused: {problem}"),
        Ok(_) => panic!("nothing went wrong"),
    }
}

/// Runs a scene that must reach its end; the assembly is then in the last state.
pub(crate) fn ran(text: &str) -> (Assembly, Trajectory, Outcome) {
    let mut assembly = build(text);
    let (trajectory, outcome) = run(&mut assembly).unwrap_or_else(|e| panic!("{e}\n{text}"));
    (assembly, trajectory, outcome)
}

/// The message with which a scene is refused before it runs; empty if it is not.
pub(crate) fn refusal(text: &str) -> String {
    let scene = match Scene::from_ron(text) {
        Ok(scene) => scene,
        Err(error) => return error.message,
    };
    let assembly = Assembly::build(&scene);
    let planned = assembly.and_then(|assembly| Plan::new(&assembly).map(drop));
    planned.map_or_else(|problem| problem.to_string(), |()| String::new())
}

/// Largest distance of two states' points (nm).
pub(crate) fn apart(a: &State, b: &State) -> f64 {
    let pairs = a.points.position.iter().zip(b.points.position.iter());
    pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
}

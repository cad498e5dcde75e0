//! Helpers that build and run scenes given as text.

use actin_mechanics::State;
use actin_sim::{Assembly, Failure, Outcome, Plan, RunError, Scene, Trajectory};

pub(crate) fn build(text: &str) -> Assembly {
    let scene = Scene::from_ron(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    actin_sim::build(&scene).unwrap_or_else(|problem| panic!("{problem}\n{text}"))
}

/// Runs an assembly and leaves it in its last state. Returns the records also of a failed run.
pub(crate) fn run_anyway(assembly: &mut Assembly) -> (Trajectory, Result<Outcome, RunError>) {
    let mut trajectory = Trajectory::default();
    let plan = Plan::new(assembly).map_err(RunError::from);
    let outcome = plan.and_then(|plan| plan.run_into(&mut trajectory));
    if let Some(last) = trajectory.records.last() {
        *assembly.system.state_mut() = last.state.clone();
    }
    (trajectory, outcome)
}

pub(crate) fn run(assembly: &mut Assembly) -> Result<(Trajectory, Outcome), RunError> {
    let (trajectory, outcome) = run_anyway(assembly);
    outcome.map(|outcome| (trajectory, outcome))
}

/// Failure and partial outcome of a run; panics if the run succeeded or was refused.
pub(crate) fn failure(outcome: Result<Outcome, RunError>) -> (Failure, Outcome) {
    match outcome {
        Err(RunError::Failed(failed)) => (failed.failure, failed.outcome),
        Err(RunError::Refused(problem)) => panic!("refused: {problem}"),
        Ok(_) => panic!("the run did not fail"),
    }
}

pub(crate) fn ran(text: &str) -> (Assembly, Trajectory, Outcome) {
    let mut assembly = build(text);
    let (trajectory, outcome) = run(&mut assembly).unwrap_or_else(|e| panic!("{e}\n{text}"));
    (assembly, trajectory, outcome)
}

pub(crate) fn refusal(text: &str) -> String {
    let scene = match Scene::from_ron(text) {
        Ok(scene) => scene,
        Err(error) => return error.message,
    };
    let assembly = Assembly::build(&scene);
    let planned = assembly.and_then(|assembly| Plan::new(&assembly).map(drop));
    planned.map_or_else(|problem| problem.to_string(), |()| String::new())
}

pub(crate) fn apart(a: &State, b: &State) -> f64 {
    let pairs = a.points.position.iter().zip(b.points.position.iter());
    pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
}

/// Length (nm) and bending rigidity (pN nm^2) of [`rod_scene`].
pub(crate) const LENGTH: f64 = 160.0;
pub(crate) const BEND: f64 = 3.9e4;

/// Scene of a rod with equal shear and stretch rigidities (pN) and a twisting rigidity (pN nm^2).
///
/// The moment `n x r'` with `r' = d3 + n/S` is then equal to the moment for an unstrained segment,
/// and frames are exactly as in an inextensible rod.
pub(crate) fn rod_scene(
    segments: usize,
    (shear, twist): (f64, f64),
    clamps: &str,
    rest: &str,
) -> String {
    format!(
        "Scene(
            filament: Filament(
                sections: [Rod(from_nm: 0.0, to_nm: {LENGTH:?}, segments: {segments})],
                rod: RodModel(law: Constant, material: Rigidities(
                    shear_pn: ({shear:?}, {shear:?}, {shear:?}),
                    bend_pn_nm2: ({BEND:?}, {BEND:?}, {twist:?}),
                )),
            ),
            clamps: [{clamps}],
            {rest}
        )"
    )
}

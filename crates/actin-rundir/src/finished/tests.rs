//! Tests of reading finished runs.

use super::*;
use crate::names::STATES;
use actin_sim::Plan;
use actin_sim::mechanics::State;

fn scene(task: &str, stage: &str) -> String {
    format!(
        "Scene(
    filament: Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 12.0), Rod(from_nm: 12.0, to_nm: 42.0)]),
    clamps: [Clamp(end: Start)],
    linkers: [Linker(at_nm: 30.0, radius_nm: 1.8, displaced_nm: (0.5, 0.0, 0.0), stiffness_pn_per_nm: 3.0)],
    path: [Stage(set: [Anchor(linker: 0, shift_nm: (0.0, 1.0, 0.0))]{stage})],
    output: (vtk: false),
    task: {task},
)"
    )
}

const MOTION: (&str, &str) = (
    "Dynamics(duration_ns: 0.3, record_every_ns: 0.1)",
    ", duration_ns: 0.2",
);
const STATICS: (&str, &str) = ("Equilibrium(largest_step: 0.5)", "");

fn run(folder: &Path, (task, stage): (&str, &str)) -> Vec<(f64, State)> {
    let scene = Scene::from_ron(&scene(task, stage)).unwrap();
    let assembly = Assembly::build(&scene).unwrap();
    let plan = Plan::new(&assembly).unwrap();
    let (trajectory, outcome) = plan.run().unwrap();
    let directory = RunDirectory::create(folder, false).unwrap();
    directory.write(&plan, &trajectory, &outcome).unwrap();
    let records = trajectory.records.into_iter();
    records.map(|r| (r.at.value(), r.state)).collect()
}

/// Asserts that a part of the records can be read alone.
fn assert_some_are_read(folder: &Path, finished: &FinishedRun, was: &[(f64, State)]) {
    let assembly = finished.assembly();
    let stored = RunDirectory::existing(folder).stored_states(assembly);
    let stored = stored.unwrap().unwrap();
    let some = stored.states(assembly, [0, 2]).unwrap();
    for (state, (_, was)) in some.zip([&was[0], &was[2]]) {
        assert_eq!(state.unwrap().points.position, was.points.position);
    }
}

/// States are compared bit for bit, including the driven anchor.
#[test]
fn states_survive_the_round_trip() {
    for task in [MOTION, STATICS] {
        let folder = tempfile::tempdir().unwrap();
        let was = run(folder.path(), task);
        let finished = FinishedRun::open(folder.path()).unwrap();
        assert!(was.len() > 2 && finished.count() == was.len());
        let states = finished.states().unwrap();
        let mut anchors = Vec::new();
        for (i, (state, (at, was))) in states.zip(&was).enumerate() {
            let state = state.unwrap();
            assert_eq!(finished.at()[i].value().to_bits(), at.to_bits());
            assert_eq!(state.points.position, was.points.position);
            assert_eq!(state.points.velocity, was.points.velocity);
            assert_eq!(state.frames.orientation, was.frames.orientation);
            assert_eq!(state.frames.angular_momentum, was.frames.angular_momentum);
            // Energies received from the surroundings are controls that are not stored.
            let mut placed = state.clone();
            for id in was.controls.ids() {
                placed.controls[id] = f64::NAN;
            }
            let assembly = finished.assembly();
            assembly.restore_controls(&mut placed, finished.at()[i], &[]);
            for id in was
                .controls
                .ids()
                .filter(|id| !placed.controls[*id].is_nan())
            {
                let (again, was) = (state.controls[id], was.controls[id]);
                assert!((again - was).abs() < 1e-12, "{again} {was}");
            }
            anchors.push(finished.assembly().linkers[0].end_position(&state).y);
        }
        assert_some_are_read(folder.path(), &finished, &was);
        // Prescribed displacement of the anchor.
        let moved = anchors[anchors.len() - 1] - anchors[0];
        assert!((moved - 1.0).abs() < 1e-12, "{moved}");
    }
}

/// Error of opening a run directory damaged by `spoil`.
fn refusal(spoil: impl FnOnce(&Path)) -> String {
    let folder = tempfile::tempdir().unwrap();
    run(folder.path(), STATICS);
    spoil(folder.path());
    FinishedRun::open(folder.path()).unwrap_err().to_string()
}

#[test]
fn damaged_or_unfinished_runs_are_refused() {
    let remove =
        |name: &'static str| move |folder: &Path| fs::remove_file(folder.join(name)).unwrap();
    assert!(refusal(remove(SCENE)).ends_with("is not a run directory: it has no scene.ron"));
    let message = refusal(remove(STATES));
    assert!(
        message.contains("has no states.npz") && message.contains("states: false"),
        "{message}"
    );
    let message = refusal(|folder| fs::write(folder.join(STATES), "no archive").unwrap());
    assert!(message.contains("states.npz is damaged"), "{message}");
    // Edited scenes with equal and different numbers of bodies.
    let edited = |from: &'static str, to: &'static str| {
        refusal(move |folder| {
            let text = fs::read_to_string(folder.join(SCENE)).unwrap();
            assert!(text.contains(from), "{text}");
            fs::write(folder.join(SCENE), text.replace(from, to)).unwrap();
        })
    };
    let message = edited("to_nm: 42.0", "to_nm: 62.0");
    assert!(
        message.contains("s_nm does not match scene.ron"),
        "{message}"
    );
    let message = refusal(|folder| {
        let text = fs::read_to_string(folder.join(SCENE)).unwrap();
        let more = text.replace("to_nm: 12.0", "to_nm: 22.0");
        fs::write(
            folder.join(SCENE),
            more.replace("from_nm: 12.0", "from_nm: 22.0"),
        )
        .unwrap();
    });
    assert!(message.contains("position_nm has the shape"), "{message}");
    let message = refusal(|folder| fs::write(folder.join(SCENE), "Scene(\n  nothing: 1)").unwrap());
    assert!(message.contains("scene.ron:2:"), "{message}");
}

#[test]
fn newer_formats_are_refused() {
    let message = refusal(|folder| {
        let path = folder.join("summary.json");
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.contains("\"format\": 1"), "{text}");
        fs::write(path, text.replace("\"format\": 1", "\"format\": 2")).unwrap();
    });
    let expected = "summary.json has the format version 2: this program reads versions up to 1";
    assert!(message.contains(expected), "{message}");
}

#[test]
fn truncated_file_is_an_error() {
    let message = refusal(|folder| {
        let bytes = fs::read(folder.join(STATES)).unwrap();
        fs::write(folder.join(STATES), &bytes[..bytes.len() / 2]).unwrap();
    });
    assert!(message.contains("states.npz"), "{message}");
}

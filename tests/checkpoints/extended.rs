//! Completed motions are extended to the bytes of a longer motion.

use super::common::{build, checkpoints, files};
use actin_rundir::{Existing, OpenedRun, RunDirectory, RunDirectoryError};
use actin_sim::{Plan, Scene, Status};
use std::path::Path;

/// Runs the scene into `folder` with `--resume`. Returns the number of steps before this call.
fn run(folder: &Path, text: &str) -> Result<Option<u64>, RunDirectoryError> {
    let assembly = build(&Scene::from_ron(text).unwrap());
    let plan = Plan::new(&assembly).unwrap();
    let directory = RunDirectory::existing(folder);
    let before = directory.summary().ok().map(|summary| summary.work.steps);
    let mut sink = checkpoints(&directory, &plan);
    let opened = sink.open(&plan, Existing::Resume)?;
    let OpenedRun::Begun { saved, lock: _lock } = opened else {
        return Ok(None);
    };
    let is_extended = saved.is_some();
    let outcome = match saved {
        None => plan.run_into(&mut sink),
        Some(saved) => plan.resume_into(*saved, &mut sink),
    };
    let outcome = outcome.unwrap();
    assert_eq!(outcome.status, Status::Completed);
    directory.write(&plan, &sink, &outcome)?;
    sink.finish(outcome.status)?;
    assert!(!directory.has_checkpoint());
    Ok(before.filter(|_| is_extended))
}

const MIXED: &str =
    "Ellipsoids(from_nm: 0.0, to_nm: 12.0), Rod(from_nm: 12.0, to_nm: 42.0, segments: 3)";
const ROD: &str = "Rod(from_nm: 0.0, to_nm: 100.0, segments: 8)";
/// A linker that breaks and binds several times.
const EVENTS: &str = "linkers: [Linker(at_nm: 30.0, radius_nm: 1.8, displaced_nm: (1.0, 0.0, 0.0), stiffness_pn_per_nm: 3.0,
    kinetics: Kinetics(seed: 1, breaks: Breaking(rate_per_ns: 20.0, force_pn: 10.0), forms: Forming(rate_per_ns: 20.0, reach_nm: 5.0)))],";
/// Records without states.
const ROWS: &str = "output: (states: false, vtk: false),";

fn scene(sections: &str, task: &str, more: &str) -> String {
    format!(
        "Scene(
            filament: Filament(sections: [{sections}]),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: (-3.0, 1.0, 0.0))],
            observe: [Tip(), SquaredDisplacement(of: Tip), EndReaction(end: Start)],
            {more}
            task: {task},
        )"
    )
}

/// Returns scenes of a shorter and a longer motion with the same time step.
fn dynamics(task: &str, more: &str) -> [String; 2] {
    ["0.25", "1.0"].map(|ns| {
        let task = format!("Dynamics(duration_ns: {ns}, record_every_ns: 0.0625, {task})");
        scene(MIXED, &task, more)
    })
}

fn brownian(more: &str) -> [String; 2] {
    ["4e-4", "8e-4"].map(|ms| {
        let task = format!(
            "Brownian(duration_ms: {ms}, temperature_k: 298.0, seed: 4, record_every_ns: 50.0)"
        );
        scene(ROD, &task, more)
    })
}

fn motions() -> [[String; 2]; 7] {
    let drag = "drag: (translational_per_ns: 0.5, rotational_per_ns: 0.5)";
    let thermal = "thermal: (temperature_k: 298.0, seed: 3)";
    let path = "path: [Stage(set: [LoadFactor(load: 0, factor: 0.5)], duration_ns: 0.2)],";
    [
        dynamics(drag, path),
        dynamics(&format!("{drag}, {thermal}"), ""),
        dynamics(&format!("drag: Water(), {thermal}"), ROWS),
        dynamics("", ROWS),
        dynamics(&format!("{drag}, {thermal}"), EVENTS),
        brownian(""),
        brownian(ROWS),
    ]
}

#[test]
fn extended_motions_equal_longer_ones() {
    for [short, long] in motions() {
        let folder = tempfile::tempdir().unwrap();
        let [whole, parts] = ["whole", "parts"].map(|name| folder.path().join(name));
        assert_eq!(run(&whole, &long).unwrap(), None);
        assert_eq!(run(&parts, &short).unwrap(), None);
        let before = run(&parts, &long).unwrap();
        assert!(before.is_some_and(|steps| steps > 0), "{short}");
        let (whole, parts) = (files(&whole), files(&parts));
        for (one, other) in whole.iter().zip(&parts) {
            assert!(one == other, "{} differs: {long}", one.0);
        }
        assert_eq!(whole.len(), parts.len());
    }
}

/// The files of the finished run stay unchanged, and the error names the difference.
#[test]
fn other_runs_are_not_extended() {
    let task = |duration: &str, more: &str| {
        let task = format!("Dynamics(duration_ns: {duration}, {more})");
        scene(MIXED, &task, "")
    };
    let every = "record_every_ns: 0.0625";
    let saddles = "record_every_ns: 0.0625, leave_saddles: 1, \
                   drag: (translational_per_ns: 0.5, rotational_per_ns: 0.5)";
    let every_tenth = "record_every_ns: 0.1";
    let cases = [
        (every, "0.125", "was \"duration_ns: 0.25,\""),
        ("", "0.5", "cannot be extended: line "),
        (saddles, "1.0", "cannot be extended: with leave_saddles"),
        (every_tenth, "0.375", "cannot be extended: "),
    ];
    for (more, duration, reason) in cases {
        let (short, other) = (task("0.25", more), task(duration, more));
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run");
        run(&path, &short).unwrap();
        let before = files(&path);
        let message = run(&path, &other).unwrap_err().to_string();
        assert!(message.contains(reason), "{message}");
        assert!(files(&path) == before);
        assert_eq!(run(&path, &short).unwrap(), None);
    }
}

//! Runs with time-dependent resolution: directories, interruption, kills, resuming and replacement.
#![cfg(unix)]

use crate::common::{Workplace, assert_has, assert_same_files, signal, stdout};
use std::fs;
use std::path::Path;

/// A released cantilever with some ten switches.
const SWINGING: &str = "Scene(
    filament: Filament(
        sections: Following(
            length_nm: 110.0,
            monomers_where: [Curvature(above_per_nm: 0.002, below_per_nm: 0.001)],
            least_ns: 0.5,
        ),
    ),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-5.0, 0.0, 0.0))],
    observe: [Tip(), Energies],
    task: Dynamics(duration_ns: 15.0, record_every_ns: 0.1),
)";

const OVERDAMPED: &str = "Scene(
    filament: Filament(
        sections: Following(
            length_nm: 108.0,
            monomers_where: [Curvature(above_per_nm: 0.003, below_per_nm: 0.001)],
            segments: 1,
        ),
        rod: RodModel(law: Constant),
    ),
    clamps: [Clamp(end: Start)],
    task: Brownian(duration_ms: 0.015, temperature_k: 298.0, time_step_ns: 50.0,
        interfaces: QuasiHarmonic(sampled_ns: 10.0)),
)";

fn assert_same(one: &Path, other: &Path) {
    assert_same_files(one, other);
    let stretches = |folder: &Path| fs::read_dir(folder.join("stretches")).unwrap().count();
    assert_eq!(stretches(one), stretches(other));
    assert!(stretches(one) > 5);
    for index in 0..stretches(one) {
        let name = format!("stretches/{index:04}");
        assert_same_files(&one.join(&name), &other.join(&name));
    }
}

#[test]
fn a_motion_of_changing_resolution_resumes_to_the_same_bytes() {
    let place = Workplace::with(SWINGING);
    let whole = place.run("whole");
    assert_has(&whole, &["switch(es) added"]);
    let columns = place.read("whole/observables.csv");
    let columns = columns.lines().next().unwrap();
    assert!(columns.contains("energy_potential_pn_nm"), "{columns}");
    assert!(!columns.contains("energy_section_0"), "{columns}");
    for (name, how) in [
        ("stretches/0000/scene.ron", "-INT"),
        ("stretches/0002", "-KILL"),
        ("stretches/0003/scene.ron", "-INT"),
        ("stretches/0005/scene.ron", "-KILL"),
    ] {
        let arguments = ["--out", "parts", "--checkpoint-every", "0.01", "--resume"];
        let mut child = place.start(&arguments, &format!("parts/{name}"));
        signal(&child, how);
        let ended = child.wait().unwrap();
        assert_eq!(ended.code(), (how == "-INT").then_some(130), "{name}");
    }
    place.resume("parts");
    assert_same(&place.path("whole"), &place.path("parts"));
}

#[test]
fn overdamped_motion_of_changing_resolution_resumes_to_the_same_bytes() {
    let place = Workplace::with(OVERDAMPED);
    place.run("whole");
    for stretch in ["0003", "0007"] {
        let arguments = ["--out", "parts", "--checkpoint-every", "0.01", "--resume"];
        let mut child = place.start(&arguments, &format!("parts/stretches/{stretch}/scene.ron"));
        signal(&child, "-KILL");
        child.wait().unwrap();
    }
    // As left by a process killed between writing its results and removing its checkpoint.
    place.write("parts/stretches/0000/checkpoint.bin", "left");
    // As left by one killed while it replaces its list of files.
    place.write("parts/stretches/0001/actin-run.json.part", "left");
    place.resume("parts");
    assert_same(&place.path("whole"), &place.path("parts"));
}

#[test]
fn stretches_are_replaced_with_the_run() {
    let place = Workplace::with(SWINGING);
    place.run("a");
    let again = place.actin(&["run", "scene.ron", "--out", "a", "--resume"]);
    assert!(stdout(&again).contains("finished"), "{}", stdout(&again));
    place.fail(2, &["run", "scene.ron", "--out", "a"]);
    let shorter = [
        "run",
        "scene.ron",
        "--out",
        "a",
        "--overwrite",
        "--set",
        "task.duration_ns=2.0",
    ];
    place.succeed(&shorter);
    let stretches = fs::read_dir(place.path("a/stretches")).unwrap().count();
    let beginnings = place.read("a/stretches.json");
    assert_eq!(beginnings.matches("\"index\"").count(), stretches);
    place.write("a/stretches/0000/notes.txt", "mine");
    place.fail(2, &["run", "scene.ron", "--out", "a", "--overwrite"]);
    let notes = fs::read_to_string(place.path("a/stretches/0000/notes.txt"));
    assert_eq!(notes.unwrap(), "mine");
}

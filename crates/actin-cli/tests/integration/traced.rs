//! Filaments along points of a file, found relative to the scene, the working directory, or the sweep.

use crate::common::{Workplace, assert_has, code, stderr, stdout};
use std::fs;

const SCENE: &str = "Scene(
    filament: Filament(
        sections: [Rod(from_nm: 0.0, to_nm: 60.0, segments: 6)],
        shape: Points(file: \"trace.csv\"),
    ),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (0.1, 0.0, 0.0))],
    task: Equilibrium(),
)";

const POINTS: &str = "x_nm,y_nm,z_nm\n0,0,0\n0,3,20\n0,10,40\n0,20,60\n";

#[test]
fn a_trace_is_found_next_to_its_scene() {
    let place = Workplace::with("");
    fs::create_dir(place.path("scenes")).unwrap();
    place.write("scenes/curved.ron", SCENE);
    let missing = place.actin(&["check", "scenes/curved.ron"]);
    assert_eq!((code(&missing), stdout(&missing)), (2, ""));
    let told = "scenes/curved.ron:4:23: filament.shape.file = \"trace.csv\": cannot be read";
    assert!(stderr(&missing).contains(told), "{}", stderr(&missing));
    place.write("scenes/trace.csv", POINTS);
    place.succeed(&["run", "scenes/curved.ron", "--out", "a"]);
    fs::remove_file(place.path("scenes/trace.csv")).unwrap();
    place.succeed(&["run", "a/scene.ron", "--out", "b"]);
    place.assert_same(["a", "b"], &["profile.csv"]);
}

#[test]
fn paths_of_standard_input_are_relative_to_the_working_directory() {
    let place = Workplace::with(SCENE);
    place.write("trace.csv", POINTS);
    let output = place.piped(&["check", "-"], SCENE);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(
        stdout(&output).contains("(0.0, 10.0, 40.0)"),
        "{}",
        stdout(&output)
    );
}

#[test]
fn a_sweep_keeps_the_points() {
    let place = Workplace::with(SCENE);
    place.write("trace.csv", POINTS);
    let sweep = "Sweep(
        scene: \"scene.ron\",
        vary: [List(key: \"filament.sections[0].segments\", values: [6, 12])],
        results: [\"tip_displacement_nm[0]\"],
    )";
    place.write("sweep.ron", sweep);
    place.succeed(&["sweep", "sweep.ron", "--out", "swept"]);
    assert_has(&place.read("swept/scene.ron"), &["nm: [(0.0, 0.0, 0.0), "]);
}

//! Filaments along points of a file: beside the scene, in the working directory, and in a sweep.

use crate::workplace;
use std::fs::{self, File};
use std::process::Command;
use workplace::{Workplace, code, stderr, stdout};

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

/// The file is found beside the scene from any folder; the scene of the run directory has the points and gives
/// the same results without the file.
#[test]
fn a_trace_stands_beside_its_scene() {
    let place = Workplace::with("");
    fs::create_dir(place.path("scenes")).unwrap();
    fs::write(place.path("scenes/curved.ron"), SCENE).unwrap();
    let missing = place.actin(&["check", "scenes/curved.ron"]);
    assert_eq!((code(&missing), stdout(&missing)), (2, ""));
    let told = "scenes/curved.ron:4:23: filament.shape.file = \"trace.csv\": cannot be read";
    assert!(stderr(&missing).contains(told), "{}", stderr(&missing));
    fs::write(place.path("scenes/trace.csv"), POINTS).unwrap();
    let first = place.actin(&["run", "scenes/curved.ron", "--out", "a"]);
    assert_eq!(code(&first), 0, "{}", stderr(&first));
    fs::remove_file(place.path("scenes/trace.csv")).unwrap();
    let second = place.actin(&["run", "a/scene.ron", "--out", "b"]);
    assert_eq!(code(&second), 0, "{}", stderr(&second));
    let profile = |run: &str| fs::read(place.path(run).join("profile.csv")).unwrap();
    assert_eq!(profile("a"), profile("b"));
}

/// A scene from standard input has no folder: the working directory is asked.
#[test]
fn standard_input_looks_into_the_working_directory() {
    let place = Workplace::with(SCENE);
    fs::write(place.path("trace.csv"), POINTS).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_actin"))
        .args(["check", "-"])
        .current_dir(place.path(""))
        .stdin(File::open(place.path("scene.ron")).unwrap())
        .output()
        .unwrap();
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(
        stdout(&output).contains("(0.0, 10.0, 40.0)"),
        "{}",
        stdout(&output)
    );
}

/// A sweep keeps the points in its directory.
#[test]
fn a_sweep_keeps_the_points() {
    let place = Workplace::with(SCENE);
    fs::write(place.path("trace.csv"), POINTS).unwrap();
    let sweep = "Sweep(
        scene: \"scene.ron\",
        vary: [List(key: \"filament.sections[0].segments\", values: [6, 12])],
        results: [\"tip_displacement_nm[0]\"],
    )";
    fs::write(place.path("sweep.ron"), sweep).unwrap();
    let output = place.actin(&["sweep", "sweep.ron", "--out", "swept"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let kept = fs::read_to_string(place.path("swept/scene.ron")).unwrap();
    assert!(kept.contains("nm: [(0.0, 0.0, 0.0), "), "{kept}");
}

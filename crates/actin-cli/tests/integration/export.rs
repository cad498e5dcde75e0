//! Exported files, opened with packages of the target programs.
//!
//! The readers are the Python packages gsd, `MDAnalysis`, ovito and simulariumio, in the interpreter `ACTIN_READERS`
//! or python3. Tests of missing packages are skipped with a message, unless `ACTIN_REQUIRE_READERS` lists the
//! package.

use crate::common::{Workplace, assert_has, stderr, stdout};
use std::env;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Two filaments with monomers of two shapes, a rod, a junction, a linker between them and one to a fixed point.
const SCENE: &str = "Scene(
    title: \"two <filaments>\",
    filaments: [
        Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 20.0), Rod(from_nm: 20.0, to_nm: 50.0)]),
        Filament(
            sections: [Ellipsoids(from_nm: 0.0, to_nm: 30.0)],
            monomers: Monomers(anchors: Independent, semi_axes_nm: (2.0, 2.5, 2.5)),
            at_nm: (12.0, 0.0, 0.0),
        ),
    ],
    clamps: [Clamp(end: Start), Clamp(filament: 1, end: Start)],
    loads: [EndForce(end: End, force_pn: (-1.0, 0.5, 0.0))],
    linkers: [
        Linker(at_nm: 15.0, to: Site(filament: 1, at_nm: 15.0), stiffness_pn_per_nm: 10.0),
        Linker(at_nm: 40.0, displaced_nm: (0.3, 0.4, 0.0), stiffness_pn_per_nm: 10.0),
    ],
    output: (vtk: false),
    task: Dynamics(duration_ns: 0.4, record_every_ns: 0.1),
)";

fn ran(scene: &str) -> Workplace {
    let place = Workplace::with(scene);
    place.succeed(&["run", "scene.ron", "--out", "run"]);
    place
}

fn read(place: &Workplace, script: &str, packages: &[&str]) {
    let python = env::var("ACTIN_READERS").unwrap_or_else(|_| "python3".to_owned());
    for package in packages {
        let import = Command::new(&python)
            .args(["-c", &format!("import {package}")])
            .output();
        if !import.is_ok_and(|output| output.status.success()) {
            let required = env::var("ACTIN_REQUIRE_READERS").unwrap_or_default();
            let message = format!("{python} has no {package}: {script} is NOT TESTED");
            assert!(
                !required.split(',').any(|name| name == *package),
                "{message}"
            );
            eprintln!("SKIPPED: {message}");
            return;
        }
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/integration/readers");
    let output = Command::new(&python)
        .arg(folder.join(script))
        .current_dir(place.path(""))
        .output()
        .unwrap();
    assert!(output.status.success(), "{script}: {}", stderr(&output));
    println!("{script}: {}", stdout(&output).trim());
}

fn export(place: &Workplace, arguments: &[&str]) {
    place.succeed(&[&["export", "run"], arguments].concat());
}

#[test]
fn gsd_is_read_by_its_own_package_mdanalysis_and_ovito() {
    let place = ran(SCENE);
    export(&place, &["--to", "gsd"]);
    read(&place, "gsd_file.py", &["gsd.hoomd", "numpy"]);
    read(&place, "mdanalysis_file.py", &["MDAnalysis", "gsd.hoomd"]);
    read(&place, "ovito_file.py", &["ovito", "numpy"]);
}

#[test]
fn simularium_is_read_by_its_own_package() {
    let place = ran(SCENE);
    export(&place, &["--to", "simularium"]);
    read(&place, "simularium_file.py", &["simulariumio", "scipy"]);
}

#[test]
fn mistakes_are_reported() {
    let place = ran(&SCENE.replace("vtk: false", "vtk: false, states: false"));
    let refused = |arguments: &[&str], message: &str| {
        let output = place.fail(2, arguments);
        assert!(output.contains(message), "{output}");
    };
    let to_gsd = |run| ["export", run, "--to", "gsd"];
    refused(
        &to_gsd("nowhere"),
        "nowhere is not a run directory: it has no scene.ron",
    );
    refused(&to_gsd("run"), "run has no states.npz");
    refused(
        &["export", "run", "--to", "pdb"],
        "possible values: gsd, simularium",
    );
}

#[test]
fn existing_files_are_kept() {
    let place = ran(SCENE);
    export(&place, &["--to", "gsd"]);
    let before = fs::read(place.path("run.gsd")).unwrap();
    let again = place.fail(2, &["export", "run/", "--to", "gsd"]);
    assert_has(&again, &["run.gsd exists: name another file"]);
    export(&place, &["--to", "gsd", "--overwrite"]);
    assert_eq!(
        fs::read(place.path("run.gsd")).unwrap(),
        before,
        "the same bytes"
    );
    place.fail(2, &["export", "run", "--to", "gsd", "--out", "run"]);
    place.fail(74, &["export", "run", "--to", "gsd", "--out", "none/a.gsd"]);
    // A truncated array, found during the export.
    let bytes = fs::read(place.path("run/states.npz")).unwrap();
    place.write("run/states.npz", &bytes[..bytes.len() - 1]);
    let damaged = place.fail(2, &["export", "run", "--to", "gsd", "--out", "b.gsd"]);
    assert_has(&damaged, &["states.npz"]);
    let left = fs::read_dir(place.path("")).unwrap();
    let mut left: Vec<_> = left.map(|entry| entry.unwrap().file_name()).collect();
    left.sort();
    assert_eq!(left, ["run", "run.gsd", "scene.ron"]);
}

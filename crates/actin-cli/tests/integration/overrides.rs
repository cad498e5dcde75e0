//! Scenes from standard input, and keys that arguments set.

use crate::workplace;
use std::fs;
use std::io::Write;
use std::process::{Command, Stdio};
use workplace::{Workplace, code, stderr, stdout};

const SCENE: &str = "Scene(
    filament: Filament(
        sections: [Ellipsoids(from_nm: 0.0, to_nm: 10.0), Rod(from_nm: 10.0, to_nm: 30.0)],
        monomers: Monomers(anchors: Independent),
    ),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))],
    task: Equilibrium(),
)";

/// What was set is in the scene that is kept with the results, which gives the same results again and
/// resumes; the text that says the same gives them too.
#[test]
fn what_is_set_is_run_and_kept() {
    let place = Workplace::with(SCENE);
    let set = [
        "--set",
        "filament.rod.law=Fitted",
        "--set",
        "loads[0].force_pn[2]=-1.5",
    ];
    let run = [&["run", "--seed", "3", "scene.ron", "--out", "a"][..], &set].concat();
    let output = place.actin(&run);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let written = SCENE
        .replace("anchors: Independent", "anchors: Independent, seed: 3")
        .replace("clamps", "    // set\n    clamps")
        .replace("-2.0, 0.0, 0.0", "-2.0, 0.0, -1.5")
        .replace(
            "        monomers",
            "        rod: RodModel(law: Fitted),\n        monomers",
        );
    fs::write(place.path("written.ron"), written).unwrap();
    for (scene, out) in [("written.ron", "b"), ("a/scene.ron", "c")] {
        let output = place.actin(&["run", scene, "--out", out]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        for name in ["scene.ron", "energies.csv", "profile.csv"] {
            let [a, b] = ["a", out].map(|run| fs::read(place.path(run).join(name)).unwrap());
            assert!(a == b, "{name} of {out} differs");
        }
    }
    let again = place.actin(&[&run[..], &["--resume"]].concat());
    assert_eq!(code(&again), 0, "{}", stderr(&again));
    assert!(stdout(&again).contains("is finished"), "{}", stdout(&again));
    let other = place.actin(&["run", "scene.ron", "--out", "a", "--resume"]);
    assert_eq!(code(&other), 2, "another scene: {}", stdout(&other));
    let check = [&["check", "--seed", "3", "scene.ron"][..], &set].concat();
    let check = place.actin(&check);
    let kept = fs::read_to_string(place.path("a/scene.ron")).unwrap();
    assert!(stdout(&check).starts_with(&kept), "{}", stdout(&check));
}

/// Exit code 2, nothing written, and a message that begins with the override, where it is one.
#[test]
fn what_cannot_be_set_is_refused_by_name() {
    let place = Workplace::with(SCENE);
    for (arguments, message) in [
        (
            ["--set", "filament.rod.law=Fittet"],
            "error: --set filament.rod.law=Fittet: unknown RodLaw Fittet",
        ),
        (
            ["--set", "filament.sections[1].to_nm=5.0"],
            "error: --set filament.sections[1].to_nm=5.0: filament.sections[1].to_nm = 5.0: a section's \
             length",
        ),
        (["--set", "filament.monomers.anchors=Cubature"], ""),
        (
            ["--set", "task"],
            "error: invalid value 'task' for '--set <KEY=VALUE>'",
        ),
        (["--seed", "-1"], "error: "),
    ] {
        let output = place.actin(&[&["check", "scene.ron"][..], &arguments].concat());
        let found = stderr(&output);
        assert_eq!(
            code(&output),
            if message.is_empty() { 0 } else { 2 },
            "{found}"
        );
        assert!(found.starts_with(message), "{found}");
    }
    let drawn = ["--set", "filament.monomers.anchors=Cubature", "--seed", "3"];
    let output = place.actin(&[&["run", "scene.ron"][..], &drawn].concat());
    let message = "error: --seed 3: scene.ron draws nothing: no bonds, thermal noise, imperfections or events of linkers\n";
    assert_eq!((code(&output), stderr(&output)), (2, message));
    assert!(!place.path("runs").exists());
}

/// A scene from standard input has a directory by default; its errors have lines and columns.
#[test]
fn a_scene_may_come_from_standard_input() {
    let place = Workplace::with("");
    let run = |scene: &str| {
        let mut child = Command::new(env!("CARGO_BIN_EXE_actin"))
            .args(["run", "--set", "filament.rod.law=Fitted", "-"])
            .current_dir(place.path("scene.ron").parent().unwrap())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut input = child.stdin.take().unwrap();
        input.write_all(scene.as_bytes()).unwrap();
        drop(input);
        child.wait_with_output().unwrap()
    };
    let bad = run(&SCENE.replace("30.0", "3.0"));
    assert_eq!(code(&bad), 2);
    assert!(
        stderr(&bad).starts_with("error: -:3:78: filament.sections[1].to_nm"),
        "{}",
        stderr(&bad)
    );
    let good = run(SCENE);
    assert_eq!(code(&good), 0, "{}", stderr(&good));
    assert!(place.path("runs/stdin/summary.json").is_file());
}

//! Scenes from standard input, and overrides of keys.

use crate::common::{Workplace, assert_has, code, stderr};

const SCENE: &str = "Scene(
    filament: Filament(
        sections: [Ellipsoids(from_nm: 0.0, to_nm: 10.0), Rod(from_nm: 10.0, to_nm: 30.0)],
        monomers: Monomers(anchors: Independent),
    ),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))],
    task: Equilibrium(),
)";

#[test]
fn overrides_are_run_and_stored() {
    let place = Workplace::with(SCENE);
    let set = [
        "--set",
        "filament.rod.law=Fitted",
        "--set",
        "loads[0].force_pn[2]=-1.5",
    ];
    let run = [&["run", "--seed", "3", "scene.ron", "--out", "a"][..], &set].concat();
    place.succeed(&run);
    let written = SCENE
        .replace("anchors: Independent", "anchors: Independent, seed: 3")
        .replace("clamps", "    // set\n    clamps")
        .replace("-2.0, 0.0, 0.0", "-2.0, 0.0, -1.5")
        .replace(
            "        monomers",
            "        rod: RodModel(law: Fitted),\n        monomers",
        );
    place.write("written.ron", written);
    for (scene, out) in [("written.ron", "b"), ("a/scene.ron", "c")] {
        place.succeed(&["run", scene, "--out", out]);
        place.assert_same(["a", out], &["scene.ron", "energies.csv", "profile.csv"]);
    }
    let again = place.succeed(&[&run[..], &["--resume"]].concat());
    assert_has(&again, &["is finished"]);
    place.fail(2, &["run", "scene.ron", "--out", "a", "--resume"]);
    let check = [&["check", "--seed", "3", "scene.ron"][..], &set].concat();
    let check = place.succeed(&check);
    assert!(check.starts_with(&place.read("a/scene.ron")), "{check}");
}

#[test]
fn a_scene_may_come_from_standard_input() {
    let place = Workplace::with("");
    let set = ["run", "--set", "filament.rod.law=Fitted", "-"];
    let run = |scene: &str| place.piped(&set, scene);
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

#[test]
fn invalid_overrides_are_refused_by_name() {
    let place = Workplace::with(SCENE);
    for (arguments, message) in [
        (
            ["--set", "filament.rod.law=Fittet"],
            "error: --set filament.rod.law=Fittet: unknown RodLaw Fittet",
        ),
        (
            ["--set", "filament.sections[1].to_nm=5.0"],
            "error: --set filament.sections[1].to_nm=5.0: filament.sections[1].to_nm = 5.0: must be \
             greater than from_nm",
        ),
        (["--set", "filament.monomers.anchors=Cubature"], ""),
        (
            ["--set", "task"],
            "error: invalid value 'task' for '--set <KEY=VALUE>'",
        ),
        (["--seed", "-1"], "error: "),
    ] {
        let code = if message.is_empty() { 0 } else { 2 };
        let found = place.fail(code, &[&["check", "scene.ron"][..], &arguments].concat());
        assert!(found.starts_with(message), "{found}");
    }
    let drawn = ["--set", "filament.monomers.anchors=Cubature", "--seed", "3"];
    let found = place.fail(2, &[&["run", "scene.ron"][..], &drawn].concat());
    let message = "error: --seed 3: scene.ron has nothing random (sampled bonds, thermal noise, imperfections, linker events): remove --seed\n";
    assert_eq!(found, message);
    assert!(!place.path("runs").exists());
}

//! The built program: arguments, exit codes, output streams and files.

use crate::common::{Workplace, assert_has, code, pushed, stderr, stdout};
use actin_sim::Scene;
use std::fs;

/// Motion of 1 ns, about a thousand steps, with five records.
fn tiny() -> String {
    pushed(1.0).replace("record_every_ns: 1.0", "record_every_ns: 0.25")
}

#[test]
fn a_scene_runs_into_its_directory() {
    let place = Workplace::with(&tiny());
    let output = place.actin(&["run", "scene.ron", "--out", "results/a"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_eq!(stderr(&output), "");
    assert!(stdout(&output).contains("written to results/a"));
    let energies = place.read("results/a/energies.csv");
    // A header and five records, at 0 to 1 ns in steps of 0.25 ns.
    assert_eq!(energies.lines().count(), 6, "{energies}");
    assert_has(
        &place.read("results/a/summary.json"),
        &["\"status\": \"completed\""],
    );
}

#[test]
fn results_have_a_place_by_default() {
    let place = Workplace::with(&tiny());
    place.succeed(&["run", "scene.ron"]);
    assert!(place.path("runs/scene/summary.json").is_file());
}

#[test]
fn invalid_scenes_and_arguments_are_bad_input() {
    let place = Workplace::with(&tiny());
    let missing = place.fail(2, &["run", "absent.ron"]);
    assert!(missing.starts_with("error: absent.ron: "));
    place.write("binary.ron", b"Scene(\n  \xe9");
    let message = place.fail(2, &["check", "binary.ron"]);
    let start = "error: binary.ron:2:3: byte 0xe9 is not UTF-8";
    assert!(message.starts_with(start), "{message}");
    place.fail(2, &["walk", "scene.ron"]);
}

#[test]
fn an_explosion_is_reported_and_valid_records_are_kept() {
    let unstable = "duration_ns: 100.0, time_step_ns: 0.0105, allow_unstable_step: true";
    let place = Workplace::with(&tiny().replace("duration_ns: 1.0", unstable));
    let message = place.fail(3, &["run", "scene.ron", "--out", "a"]);
    assert_has(
        &message,
        &[
            "at step ",
            " acts most strongly",
            " at s = ",
            "last good state",
            " is in a",
        ],
    );
    assert!(
        ["bonds", "rod", "junction"]
            .iter()
            .any(|term| message.contains(&format!("{term:?}")))
    );
    let energies = place.read("a/energies.csv");
    assert!(energies.lines().count() >= 2, "{energies}");
    for value in energies.lines().skip(1).flat_map(|line| line.split(',')) {
        assert!(value.parse::<f64>().unwrap().is_finite());
    }
    assert!(place.path("a/states.npz").is_file());
    assert_has(&place.read("a/summary.json"), &["\"status\": \"failed\""]);
    assert!(place.path("a/checkpoint.bin").exists());
    let again = place.fail(3, &["run", "scene.ron", "--out", "a", "--resume"]);
    assert_eq!(again, message);
}

/// Two percent above the stability limit, the energy grows slowly. The run fails when the energy exceeds what the
/// load can have supplied, long before overflow.
#[test]
fn a_slow_explosion_is_caught() {
    let unstable = "duration_ns: 1000.0, time_step_ns: 0.00602, allow_unstable_step: true";
    let place = Workplace::with(&tiny().replace("duration_ns: 1.0", unstable));
    let output = place.fail(3, &["run", "scene.ron", "--out", "a"]);
    assert_has(&output, &["energy has reached"]);
    let energies = place.read("a/energies.csv");
    let mut names = energies.lines().next().unwrap().split(',');
    let column = names.position(|name| name == "kinetic_pn_nm").unwrap();
    for row in energies.lines().skip(1) {
        let kinetic: f64 = row.split(',').nth(column).unwrap().parse().unwrap();
        assert!(kinetic <= 241.0, "{row}");
    }
}

#[test]
fn check_prints_the_scene() {
    let place = Workplace::with(&tiny());
    let printed = place.succeed(&["check", "scene.ron"]);
    let scene = Scene::from_ron(&printed).unwrap();
    let written = Scene::from_ron(&tiny()).unwrap();
    assert_eq!(scene.filament.monomers, written.filament.monomers);
    assert_eq!(
        (&scene.clamps, &scene.loads),
        (&written.clamps, &written.loads)
    );
    let defaults = [
        "seed: 0",
        "segments: 2",
        "integrator: Pefrl",
        "weight: Shared",
        "hold: Wall",
    ];
    assert_has(&printed, &defaults);
    let open = printed.lines().filter(|line| line.contains("None"));
    let open: Vec<&str> = open.map(str::trim).collect();
    assert_eq!(
        open,
        [
            "imperfection: None,",
            "hinge: None,",
            "thermal: None,",
            "stop: None,"
        ],
        "the optional keys imperfection, spring, thermal and stop are absent; all others are resolved"
    );
    place.write("resolved.ron", &printed);
    let again = place.succeed(&["check", "resolved.ron"]);
    assert_eq!(untimed(&again), untimed(&printed));
    let files = fs::read_dir(place.path("")).unwrap().count();
    assert_eq!(files, 2, "checking writes nothing");
}

/// A twist of 0.0698 rad/nm exceeds the range of the rod law, 0.0472 rad/nm, and is reported once per rod and
/// quantity. Half of it is not reported.
#[test]
fn a_rod_beyond_the_data_of_its_law_is_reported() {
    let scene = |turn: &str| {
        format!(
            "Scene(
                filament: Filament(
                    sections: [Rod(from_nm: 0.0, to_nm: 75.0)],
                    rod: RodModel(law: Fitted),
                ),
                clamps: [Clamp(end: Start), Clamp(end: End, slides: AlongAxis)],
                path: [Stage(set: [Turn(end: End, turn_deg: (0.0, 0.0, {turn}))])],
                task: Equilibrium(),
            )"
        )
    };
    for (turn, beyond) in [("300.0", true), ("-300.0", true), ("180.0", false)] {
        let place = Workplace::with(&scene(turn));
        let output = place.run("a");
        let sign = if turn.starts_with('-') { "-" } else { "" };
        let line = format!("twist {sign}0.0698 rad/nm at s = ");
        println!("{turn}: {output}");
        assert_eq!(output.matches(&line).count(), usize::from(beyond));
        let summary = place.read("a/summary.json");
        assert_eq!(
            summary.matches("\"range_per_nm\": 0.0472").count(),
            usize::from(beyond)
        );
        assert_eq!(summary.contains("\"quantity\": \"twist\""), beyond);
    }
}

/// A rod of 100 nm whose natural length is 0.0507 nm shorter (S3 = 3.4e4 pN). Compressed by 0.09 nm it carries
/// 13.4 pN and is stable. Compressed by 0.1 nm it carries 16.8 pN, above the bound of 13.8 pN.
#[test]
fn a_rod_pushed_beyond_the_bound_of_its_twist_is_reported() {
    for (shift, unstable) in [("0.09", false), ("0.1", true)] {
        let place = Workplace::with(&format!(
            "Scene(
                filament: Filament(
                    sections: [Rod(from_nm: 0.0, to_nm: 100.0, segments: 20)],
                    rod: RodModel(law: PublishedExtension),
                ),
                clamps: [Clamp(end: Start), Clamp(end: End)],
                path: [Stage(set: [Shift(end: End, shift_nm: (0.0, 0.0, -{shift}))])],
                task: Equilibrium(leave_saddles: 0),
            )"
        ));
        let output = place.actin(&["run", "scene.ron", "--out", "a"]);
        println!("{shift}: {}", stdout(&output));
        let line = " nm exceeds the critical value 13.80 pN (twist 0.0000 rad/nm)";
        assert_eq!(stdout(&output).contains(line), unstable);
        let said = "the records: compression 16.77 pN";
        assert_eq!(stdout(&output).contains(said), unstable);
        let summary = place.read("a/summary.json");
        assert_eq!(summary.contains("\"unstable_twist\": []"), !unstable);
        assert_eq!(summary.contains("\"bound_pn\": 13.8"), unstable);
        assert_eq!(summary.contains("\"code\": \"unstable-twist\""), unstable);
        place.succeed(&["view", "a"]);
        let page = place.read("a/view.html");
        assert_eq!(page.contains("warning: twist is UNSTABLE in "), unstable);
    }
}

/// In a heat bath, a law without free energy is noted, and strains outside its range are summarised per quantity.
#[test]
fn a_law_in_a_bath_is_noted_and_its_fluctuations_are_summed_up() {
    let place = Workplace::with(
        "Scene(
            filament: Filament(
                sections: [Rod(from_nm: 0.0, to_nm: 30.0, segments: 20)],
                rod: RodModel(law: Fitted),
            ),
            task: Dynamics(
                duration_ns: 1.0,
                drag: (translational_per_ns: 5.0, rotational_per_ns: 5.0),
                thermal: (temperature_k: 298.0, seed: 1),
            ),
        )",
    );
    let note = "warning: rods with the law Fitted in a heat bath: ";
    let checked = place.succeed(&["check", "scene.ron"]);
    assert_eq!(checked.matches(&format!("// {note}")).count(), 1);
    assert!(Scene::from_ron(&checked).is_ok());
    let printed = place.run("a");
    assert_eq!(printed.matches(note).count(), 1);
    for quantity in ["twist", "curvature"] {
        let line = format!("{quantity} fluctuates beyond the data of the rod law in ");
        assert_eq!(printed.matches(&line).count(), 1);
    }
    let summary = place.read("a/summary.json");
    assert!(summary.contains(&note[9..]) && summary.contains("\"share_of_records\": "));
    assert_has(&summary, &["\"unstable_twist\": []"]);
}

#[test]
fn check_prints_the_cost() {
    let place = Workplace::with(
        "Scene(
            filament: Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 160.2)]),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))],
            task: Equilibrium(),
        )",
    );
    let printed = place.succeed(&["check", "scene.ron"]);
    let cost = "// cost: 1428 bonds and 0 elements; ";
    assert!(printed.contains(cost), "{printed}");
    let time = printed.lines().find(|line| line.starts_with("// time: "));
    assert!(
        time.is_some_and(|line| line.contains("measured here")),
        "{printed}"
    );
}

#[test]
fn completions_and_manual_pages_name_every_command() {
    let place = Workplace::with("");
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let output = place.succeed(&["completions", shell]);
        for word in ["run", "sweep", "check", "export", "overwrite"] {
            assert!(output.contains(word), "{shell}: {word}");
        }
    }
    place.fail(2, &["completions", "nothing"]);
    place.succeed(&["man", "man1"]);
    for (page, line) in [
        ("actin.1", "actin\\-export"),
        ("actin-run.1", "resume"),
        ("actin-export.1", "gsd"),
    ] {
        let text = std::fs::read_to_string(place.path("man1").join(page)).unwrap();
        assert!(text.starts_with(".ie") && text.contains(line), "{page}");
    }
}

fn untimed(printed: &str) -> Vec<&str> {
    let lines = printed.lines();
    lines
        .filter(|line| !line.starts_with("// time: "))
        .collect()
}

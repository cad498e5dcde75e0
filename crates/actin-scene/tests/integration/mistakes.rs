//! Messages of mistakes, and collection of all mistakes of a text.

use actin_scene::{Scene, SceneError, SceneProblem, SceneText};
use std::fs;
use std::path::Path;

const SCENE: &str = "Scene(
    filament: Filament(
        sections: [Ellipsoids(from_nm: 0.0, to_nm: 80.0), Rod(from_nm: 80.0, to_nm: 160.0)],
    ),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))],
    task: Equilibrium(force_pn: 1e-6),
)";

/// Returns `true` if a message has the parts of `expected`, separated by dots, in this order. A position is at the
/// beginning.
fn is_expected(message: &str, expected: &str) -> bool {
    let starts_with_place = expected.starts_with(|c: char| c.is_ascii_digit());
    let mut rest = message;
    let is_next = |part: &str| {
        let Some(at) = rest.find(part) else {
            return false;
        };
        rest = &rest[at + part.len()..];
        true
    };
    expected.split(" ... ").all(is_next)
        && (!starts_with_place || message.starts_with(expected.split(" ... ").next().unwrap()))
}

/// Each file of `mistakes/` is a valid scene and, after a line of dashes, replacements in its text with parts of the
/// message that they cause.
#[test]
fn mistakes_have_their_messages() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/integration/mistakes");
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let text = fs::read_to_string(&path).unwrap();
        let (text, mistakes) = text.split_once("----\n").unwrap();
        let scene = Scene::from_ron(text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        assert_eq!(Scene::from_ron(&scene.to_ron()), Ok(scene));
        for line in mistakes.lines() {
            let parts = line.split(" => ").map(|part| part.replace("\\n", "\n"));
            let parts: Vec<String> = parts.collect();
            let [right, wrong, expected] = &parts[..] else {
                panic!("three parts are needed: {line}");
            };
            let spoilt = text.replacen(right, wrong, 1);
            assert_ne!(spoilt, text, "{line}");
            let found = Scene::from_ron(&spoilt).expect_err(line).to_string();
            assert!(is_expected(&found, expected), "{line}: {found}");
            assert!(!SceneText::new(&spoilt).mistakes().is_empty(), "{line}");
        }
    }
}

/// Two mistakes in different places are both found, in the order of the text, with the same messages as alone.
#[test]
fn of_two_mistakes_neither_hides_the_other() {
    assert_eq!(SceneText::new(SCENE).mistakes(), []);
    let mistakes = [
        ("to_nm: 80.0", "two_nm: 80.0"),
        ("80.0, to_nm: 160.0", "80.0"),
        ("end: Start", "end: Begin"),
        ("-2.0, 0.0", "-2.0, x"),
        ("Equilibrium(", "Equilibrium(largest_stop: 1.0, "),
    ];
    let of = |text: &str| -> Vec<String> {
        let errors = SceneText::new(text).mistakes();
        errors.iter().map(|error| error.message.clone()).collect()
    };
    for (i, (from, to)) in mistakes.iter().enumerate() {
        let one = SCENE.replacen(from, to, 1);
        let first = of(&one);
        assert_eq!(first, [Scene::from_ron(&one).unwrap_err().message]);
        for (from, to) in &mistakes[i + 1..] {
            let second = of(&SCENE.replacen(from, to, 1));
            let both = of(&one.replacen(from, to, 1));
            assert_eq!(both, [&first[..], &second].concat(), "{from}");
        }
    }
}

/// At most 20 mistakes are listed, and fewer in long texts.
#[test]
fn of_many_mistakes_the_first_are_found() {
    let many = |what: &str, count: usize| {
        let clamps = vec![what; count].join(", ");
        let text = SCENE.replace("[Clamp(end: Start)]", &format!("[{clamps}]"));
        SceneText::new(&text).mistakes()
    };
    let problems = many("Clamp(end: Start)", 5000);
    assert_eq!(problems.len(), 20);
    assert!(
        problems[0].message.starts_with("clamps[1].end"),
        "{}",
        problems[0]
    );
    // Every second reading finds that the key of a refused value is missing.
    assert_eq!(many("Clamp(end: Begin)", 1000).len(), 10);
    assert_eq!(many("Clamp(end: Begin)", 60_000).len(), 1);
    let deep = SceneText::new(&"(".repeat(200_000)).mistakes();
    let expected = "1:129: brackets are nested more than 128 deep here";
    assert_eq!(
        deep.iter().map(ToString::to_string).collect::<Vec<_>>(),
        [expected]
    );
}

/// Rules of the whole scene are checked only if all numbers are valid.
#[test]
fn broken_rules_are_found_together() {
    let keys = |text: &str| -> Vec<String> {
        let mistakes = SceneText::new(text).mistakes();
        let key = |error: &SceneError| error.message.split(' ').next().unwrap().to_owned();
        mistakes.iter().map(key).collect()
    };
    let spoilt = SCENE
        .replace("160.0", "60.0")
        .replace("-2.0", "inf")
        .replace("1e-6", "-1.0");
    let expected = [
        "filament.sections[1].to_nm",
        "loads[0].force_pn",
        "task.force_pn",
    ];
    assert_eq!(keys(&spoilt), expected);
    assert_eq!(keys(&SCENE.replace("1e-6", "1.5")), ["task.force_pn"]);
    assert_eq!(keys(&SCENE.replace("[Clamp(end: Start)]", "[]")).len(), 1);
}

const PLACES: &str = r#"// a: comment (
Scene(
    title: "x: ( \" [",
    filament: (
        sections: [
            Rod(from_nm: 0.0, to_nm: 1e1),
            Rod(
                from_nm: 10.0, /* nested /* to_nm: */ */
                to_nm: 5.0,
            ),
        ],
    ),
    loads: [EndForce(end: End, force_pn: (0.0, inf, 0.0))],
)"#;

/// Keys after comments, strings and lists are located. An absent key is located at its parent.
#[test]
fn problems_are_placed_at_their_keys() {
    for (key, place) in [
        ("filament", (4, 5)),
        ("filament.sections[1]", (7, 13)),
        ("filament.sections[1].to_nm", (9, 17)),
        ("filament.sections[0].to_nm", (6, 31)),
        ("loads[0].force_pn", (13, 32)),
        ("loads[0].force_pn[1]", (13, 32)),
        ("filament.monomers.seed", (4, 5)),
        ("filaments[0].monomers.seed", (4, 5)),
        ("absent", (1, 1)),
    ] {
        let error = SceneError::locate(&SceneProblem::new(key, "", ""), PLACES);
        assert_eq!((error.line, error.column), place, "{key}");
    }
}

/// Parsing continues after a missing comma, a missing colon or an unknown comment.
#[test]
fn slips_between_values_hide_nothing() {
    for (from, to, place) in [
        ("80.0), Rod", "80.0) Rod", (3, 58)),
        ("force_pn: (-2.0, 0.0", "force_pn: (-2.0 0.0", (6, 48)),
        ("end: Start", "end Start", (5, 23)),
        ("end: Start", "end = Start", (5, 23)),
        ("    clamps", "    # ends\n    clamps", (5, 5)),
    ] {
        let text = SCENE.replacen(from, to, 1).replace("1e-6", "tiny");
        let found = SceneText::new(&text).mistakes();
        assert_eq!(found.len(), 2, "{to}: {found:?}");
        assert_eq!((found[0].line, found[0].column), place, "{}", found[0]);
        assert!(
            found[1].message.starts_with("task.force_pn"),
            "{}",
            found[1]
        );
    }
}

/// A key that is missing because its value was refused does not hide the mistake before it.
#[test]
fn consequences_hide_no_mistake() {
    let text = SCENE.replacen("Clamp(end: Start)", "\"Clamp\"(end: Begin)", 1);
    let found = SceneText::new(&text).mistakes();
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(
        found[0].message.contains("a name is expected"),
        "{}",
        found[0]
    );
    assert!(
        found[1]
            .message
            .starts_with("clamps[0].end: unknown End Begin")
            || found[1].message.starts_with("unknown End Begin"),
        "{}",
        found[1]
    );
    assert_eq!(Scene::from_ron(&text), Err(found[0].clone()));
}

/// Filaments are generated from valid numbers only; all invalid ones are listed, in the order of the text.
#[test]
fn numbers_of_scenes_with_arrangements_are_listed() {
    let text = "Scene(
        task: Brownian(duration_ms: -1.0, temperature_k: 298.0),
        repulsion: Repulsion(radius_nm: NaN, spheres: [Sphere(at_nm: (0.0, 0.0, 0.0), radius_nm: 500.0, side: Inside)]),
        burn_in_ns: NaN,
        arrangements: [Random(
            filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 100.0)]),
            count: 2, box_nm: (100.0, 100.0, 100.0), seed: 1,
        )],
    )";
    let lines: Vec<usize> = SceneText::new(text)
        .mistakes()
        .iter()
        .map(|error| error.line)
        .collect();
    assert_eq!(lines, [2, 3, 4], "{:?}", SceneText::new(text).mistakes());
    assert_eq!(Scene::from_ron(text).unwrap_err().line, 2);
}

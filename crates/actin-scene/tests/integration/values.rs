//! Scenes as dictionaries and lists, in memory and as JSON.

use actin_scene::SceneKind::{self as Kind, List, Text, Whole};
use actin_scene::{Scene, SceneText, SceneValue};
use std::path::Path;

fn keys(all: &[(&str, SceneValue)]) -> SceneValue {
    let owned = all
        .iter()
        .map(|(key, value)| ((*key).to_owned(), value.clone()));
    SceneValue::keys(owned.collect())
}

fn scene_with(section: SceneValue, more: Option<(&str, SceneValue)>) -> SceneValue {
    let sections = List(vec![section]).into();
    let mut all = vec![
        ("filament", keys(&[("sections", sections)])),
        ("task", keys(&[("Equilibrium", keys(&[]))])),
    ];
    all.extend(more);
    keys(&all)
}

fn refused(section: SceneValue) -> (String, String) {
    let problem = Scene::from_value(&scene_with(section, None), None).unwrap_err();
    (problem.key, problem.rule)
}

/// All scenes of the repository are unchanged by conversion to values and back.
#[test]
fn scenes_are_unchanged_by_conversion() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let mut folders = vec![folder];
    let mut number = 0;
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let Ok(text) = std::fs::read_to_string(&path) else {
                continue;
            };
            if let Ok(scene) = Scene::from_ron(&text) {
                assert_eq!(
                    Scene::from_value(&scene.to_value(), None),
                    Ok(scene),
                    "{path:?}"
                );
                number += 1;
            }
        }
    }
    assert!(number > 10, "{number} scenes");
}

/// Errors have the path of the key and the message of the text form.
#[test]
fn mistakes_name_their_keys() {
    let rod = |key: &str, value: Kind| {
        let all = keys(&[("from_nm", Whole(0).into()), (key, value.into())]);
        keys(&[("Rod", all)])
    };
    let (key, rule) = refused(rod("to", Whole(40)));
    assert_eq!(key, "filament.sections[0].to");
    assert!(
        rule.contains("the unit is part of the key, write to_nm"),
        "{rule}"
    );
    let (key, rule) = refused(rod("to_nm", Text("far".into())));
    assert_eq!(key, "filament.sections[0].to_nm");
    assert!(rule.contains("a number is expected, not \"far\""), "{rule}");
    let (key, rule) = refused(keys(&[("Rope", keys(&[]))]));
    assert_eq!(key, "filament.sections[0]");
    assert!(
        rule.contains("unknown Section Rope: expected one of"),
        "{rule}"
    );
    let (key, rule) = refused(keys(&[("Rod", keys(&[("from_nm", Whole(0).into())]))]));
    assert_eq!(key, "filament.sections[0]");
    assert!(rule.contains("missing key `to_nm`"), "{rule}");
    let (key, rule) = refused(rod("to_nm", Whole(-40)));
    assert_eq!(key, "filament.sections[0].to_nm");
    assert!(rule.contains("must be greater than from_nm"), "{rule}");
}

/// Vectors have a fixed number of components, and choices with keys are dictionaries.
#[test]
fn forms_agree_with_the_text() {
    let rod = || {
        let all = keys(&[("from_nm", Whole(0).into()), ("to_nm", Whole(40).into())]);
        keys(&[("Rod", all)])
    };
    let force = List(vec![Whole(1).into(); 4]);
    let load = keys(&[
        ("end", Text("End".into()).into()),
        ("force_pn", force.into()),
    ]);
    let loads = List(vec![keys(&[("EndForce", load)])]);
    let scene = scene_with(rod(), Some(("loads", loads.into())));
    let problem = Scene::from_value(&scene, None).unwrap_err();
    assert_eq!(problem.key, "loads[0].force_pn");
    assert!(
        problem.rule.contains("3 numbers are expected, not 4"),
        "{problem}"
    );
    let mut scene = scene_with(rod(), None);
    scene.set("task", Text("Dynamics".into()).into()).unwrap();
    let problem = Scene::from_value(&scene, None).unwrap_err();
    assert_eq!(problem.key, "task");
    assert!(
        problem.rule.contains("missing key `duration_ns`"),
        "{problem}"
    );
}

const JSON: &str = r#"{
    "filament": {"sections": [{"Rod": {"from_nm": 0, "to_nm": 40}}]},
    "clamps": [{"end": "Start", "hold": "Wall", "hinge": null}],
    "loads": [{"EndForce": {"end": "End", "force_pn": [0.1, 0, 0]}}],
    "task": {"Equilibrium": {}}
}"#;

/// A text that begins with a curly bracket is JSON.
#[test]
fn json_agrees_with_ron() {
    let ron = "Scene(
        filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0)]),
        clamps: [Clamp(end: Start)],
        loads: [EndForce(end: End, force_pn: (0.1, 0.0, 0.0))],
        task: Equilibrium(),
    )";
    assert_eq!(Scene::from_ron(JSON), Scene::from_ron(ron));
    let mut text = SceneText::new(JSON);
    text.set("loads[0].force_pn[1]=0.2".parse().unwrap())
        .unwrap();
    assert!(text.scene().is_ok());
}

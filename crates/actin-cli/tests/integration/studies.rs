//! The studies of the book: shortened scenes and sweeps run, and scripts plot the results.

use crate::common::{Workplace, code, python, stderr, stdout};
use serde_json::Value;
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A study of `studies.json`: shorter text of its scene and sweep, least number of rows of its table, and settings for a
/// short run of its scene.
struct Study {
    name: String,
    shorter: Vec<[String; 2]>,
    points: usize,
    set: Vec<String>,
}

fn studies() -> Vec<Study> {
    let all: Value = serde_json::from_str(include_str!("studies.json")).unwrap();
    let text = |value: &Value| value.as_str().unwrap().to_owned();
    let list = |value: &Value| value.as_array().unwrap().clone();
    let study = |one: &Value| Study {
        name: text(&one["name"]),
        shorter: list(&one["shorter"])
            .iter()
            .map(|pair| [text(&pair[0]), text(&pair[1])])
            .collect(),
        points: usize::try_from(one["points"].as_u64().unwrap()).unwrap(),
        set: list(&one["set"]).iter().map(text).collect(),
    };
    list(&all).iter().map(study).collect()
}

/// Scenes of measurements without a script, with changes for short runs.
const MEASURED: [(&str, &[&str]); 9] = [
    ("cofilin-heat", &["task.duration_ns=6.0"]),
    ("contraction-network", &["task.duration_ms=0.02"]),
    ("crossed-pair", &["task.duration_ms=0.1"]),
    ("fine-network", &[]),
    ("fine-network-heat", &["task.duration_ms=0.01"]),
    ("free-filaments", &["task.duration_ms=0.1"]),
    (
        "long-network",
        &["task.duration_ms=0.02", "task.record_every_ns=2e3"],
    ),
    ("network-heat", &["task.duration_ms=0.1"]),
    ("warm", &["task.duration_ns=1.0"]),
];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/studies")
}

fn place(study: &Study) -> Workplace {
    let place = Workplace::with("");
    for entry in fs::read_dir(folder()).unwrap() {
        let path = entry.unwrap().path();
        if path.is_file() {
            fs::copy(
                &path,
                place.path(path.file_name().unwrap().to_str().unwrap()),
            )
            .unwrap();
        }
    }
    for [from, to] in &study.shorter {
        let files = [
            format!("{}.ron", study.name),
            format!("{}-sweep.ron", study.name),
        ];
        let texts = files.map(|file| (fs::read_to_string(place.path(&file)).unwrap(), file));
        assert!(
            texts.iter().any(|(text, _)| text.contains(from.as_str())),
            "{from}"
        );
        for (text, file) in texts {
            fs::write(place.path(&file), text.replace(from.as_str(), to)).unwrap();
        }
    }
    place
}

#[test]
fn scenes_run() {
    for study in studies() {
        let place = place(&study);
        let set: Vec<&str> = study.set.iter().map(String::as_str).collect();
        run_short(&place, &format!("{}.ron", study.name), &set);
    }
    let place = Workplace::with("");
    for (name, set) in MEASURED {
        let file = folder().join(format!("{name}.ron"));
        run_short(&place, file.to_str().unwrap(), set);
    }
}

fn run_short(place: &Workplace, file: &str, set: &[&str]) {
    let out = Path::new(file).file_stem().unwrap().to_str().unwrap();
    let mut arguments = vec!["run", file, "--out", out];
    arguments.extend(set.iter().flat_map(|key| ["--set", key]));
    place.succeed(&arguments);
}

/// Each shortened sweep, whose script writes a figure and the table of its page. Without matplotlib the test is
/// skipped, or fails if `ACTIN_REQUIRE_MATPLOTLIB` is set, as in `.ci/run`.
#[test]
fn sweeps_run_and_scripts_draw_them() {
    let what = "the scripts of the studies are";
    let python = python("numpy, matplotlib", "ACTIN_REQUIRE_MATPLOTLIB", what);
    for study in studies() {
        let (place, name) = (place(&study), study.name.as_str());
        let sweep = format!("{name}-sweep");
        place.succeed(&["sweep", &format!("{sweep}.ron")]);
        let table = fs::read_to_string(place.path(&format!("sweeps/{sweep}/table.csv"))).unwrap();
        assert!(
            table.matches('\n').count() > study.points,
            "{name}: {table}"
        );
        if name == "bundle" {
            place.succeed(&["sweep", "bundle-push-sweep.ron"]);
        }
        let Some(python) = &python else { continue };
        let page = "page.md";
        let block = |name: &str| format!("<!-- generated: {name} -->\n\n<!-- end -->\n\n");
        let empty = block(name) + &block("bundle-push");
        fs::write(place.path(page), empty).unwrap();
        let output = Command::new(python)
            .args([&format!("{name}.py"), "--page", page])
            .current_dir(place.path("."))
            .output()
            .unwrap();
        assert_eq!(
            code(&output),
            0,
            "{name}: {}{}",
            stdout(&output),
            stderr(&output)
        );
        let svg = fs::read_to_string(place.path(&format!("{name}.svg"))).unwrap();
        assert!(svg.len() < 100_000 && svg.contains("</svg>"), "{name}");
        let page = fs::read_to_string(place.path(page)).unwrap();
        assert!(page.lines().count() > 5, "{name}: {page}");
        assert!(!page.contains("nan"), "{name}: {page}");
    }
}

#[test]
fn the_bundle_is_what_its_script_writes() {
    let place = Workplace::with("");
    let script = folder().join("make_bundle.py");
    let Ok(output) = Command::new("python3")
        .arg(script)
        .arg(place.path("."))
        .output()
    else {
        return eprintln!("no python3: the scene of the bundle is NOT TESTED");
    };
    assert!(output.status.success(), "{}", stderr(&output));
    for name in ["bundle.ron", "bundle-sweep.ron", "bundle-push-sweep.ron"] {
        let written = fs::read_to_string(place.path(name)).unwrap();
        assert!(
            written == fs::read_to_string(folder().join(name)).unwrap(),
            "{name}"
        );
    }
}

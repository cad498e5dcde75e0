//! `actin view`: its page in a browser, its films, and incomplete run directories.

#[path = "../../../actin-view/tests/chromium/mod.rs"]
mod chromium;

use crate::common::{Workplace, assert_has};
use chromium::{Mode, browser, count, probed};
use rayon::prelude::*;
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

const PROBE: &str = include_str!("view_probe.js");
/// Widths of a phone and a laptop (pixels).
const WIDTHS: [u32; 2] = [390, 1280];

/// A motion of monomers, a junction, a rod and a linker, with observables.
const MOTION: &str = "Scene(
    title: \"Seen & <turned>\",
    filament: Filament(sections: [
        Ellipsoids(from_nm: 0.0, to_nm: 40.0),
        Rod(from_nm: 40.0, to_nm: 100.0, segments: 6),
    ]),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-3.0, 0.0, 0.0))],
    linkers: [Linker(at_nm: 70.0, displaced_nm: (8.0, 0.0, 0.0), stiffness_pn_per_nm: 0.2)],
    observe: [Tip()],
    task: Dynamics(
        duration_ns: 12.0, record_every_ns: 0.5,
        drag: (translational_per_ns: 0.3, rotational_per_ns: 0.3),
    ),
)";

const PAIR: &str = "Scene(
    filaments: [
        Filament(sections: [Rod(from_nm: 0.0, to_nm: 60.0)]),
        Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 60.0)], at_nm: (15.0, 0.0, 0.0)),
    ],
    clamps: [Clamp(end: Start), Clamp(filament: 1, end: Start)],
    linkers: [Linker(at_nm: 40.0, to: Site(filament: 1, at_nm: 40.0), stiffness_pn_per_nm: 1.0)],
    loads: [EndForce(end: End, force_pn: (-1.0, 0.0, 0.0))],
    task: Equilibrium(),
)";

const PATH: &str = "Scene(
    filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 100.0, segments: 10)]),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))],
    path: [Stage(set: [LoadFactor(load: 0, factor: 1.0)])],
    task: Equilibrium(largest_step: 0.1),
)";

fn ran(scene: &str) -> Workplace {
    let place = Workplace::with(scene);
    place.run("a");
    place
}

fn page(place: &Workplace) -> String {
    place.succeed(&["view", "a"]);
    place.read("a/view.html")
}

/// Detects shader errors, a blank canvas, a slider without effect, a fixed cursor, and a table wider than a phone.
#[test]
fn pages_work_in_a_browser() {
    let Some(browser) = browser() else {
        return;
    };
    let pages = [
        (MOTION, Mode::Light, &WIDTHS[..]),
        (PATH, Mode::Dark, &WIDTHS[1..]),
        (PAIR, Mode::Light, &WIDTHS[..1]),
    ];
    pages.into_par_iter().for_each(|(scene, mode, widths)| {
        let place = ran(scene);
        let page = page(&place);
        let folder = tempfile::tempdir().unwrap();
        let found = probed(&browser, (&page, PROBE), widths, mode, folder.path());
        let warnings = warnings(&place);
        for (found, width) in found.iter().zip(widths) {
            assert_works(found, *width);
            assert_eq!(found["remarks"], json!(warnings));
        }
    });
}

fn warnings(place: &Workplace) -> Vec<String> {
    let summary = fs::read(place.path("a/summary.json")).unwrap();
    let summary: Value = serde_json::from_slice(&summary).unwrap();
    let warnings = summary["warnings"].as_array().unwrap().iter();
    warnings
        .map(|warning| {
            let [message, code] = ["message", "code"].map(|key| warning[key].as_str().unwrap());
            format!("warning: {message} [{code}]")
        })
        .collect()
}

fn assert_works(found: &Value, width: u32) {
    assert_eq!(found["errors"], json!([]), "{width}");
    assert_eq!(found["beyond"], json!([]), "{width}");
    assert!(count(&found["scrollWidth"]) <= u64::from(width), "{found}");
    let pixels: u64 = found["size"]
        .as_array()
        .unwrap()
        .iter()
        .map(count)
        .product();
    let some = pixels / 200..pixels * 9 / 10;
    assert!(some.contains(&count(&found["painted"])), "{width}: {found}");
    for act in ["turned", "along", "zoomed"] {
        assert!(count(&found[act]) > 1000, "{width}, {act}: {found}");
    }
    assert_eq!(found["after_reset"], 0, "{width}: {found}");
    assert_eq!(found["after_selection"], 0, "{width}: {found}");
    assert_eq!(found["small"], 0, "{width}: {found}");
    assert_selects(&found["selection"]);
    let tints = found["tints"].as_array().unwrap();
    assert!(tints.len() >= 3, "{found}");
    // Tension changes the colour of a single thin linker only.
    let least = |tint: &Value| {
        if tint[0] == "by tension of linkers" {
            100
        } else {
            500
        }
    };
    assert!(
        tints.iter().all(|tint| count(&tint[1]) > least(tint)),
        "{found}"
    );
    assert!(count(&found["legend"]) >= 2 && count(&found["charts"]) >= 1);
    let records = count(&found["records"]);
    if records > 1 {
        assert_plays(found, records);
    }
}

/// A body below the pointer is described with its fields, a click follows it, and a picture is saved.
fn assert_selects(found: &Value) {
    let described: Vec<&str> = found["described"]
        .as_array()
        .unwrap()
        .iter()
        .map(|line| line.as_str().unwrap())
        .collect();
    assert!(described[0].contains(" at s = "), "{found}");
    assert!(
        described.iter().any(|line| line.starts_with("curvature: ")),
        "{found}"
    );
    let name = found["name"].as_str().unwrap();
    assert!(name.contains(described[0]), "{found}");
    assert!(count(&found["moved"]) > 1000, "{found}");
    let (file, bytes) = found["saved"].as_str().unwrap().rsplit_once(' ').unwrap();
    assert_eq!(Path::new(file).extension().unwrap(), "png", "{found}");
    assert!(bytes.parse::<u32>().unwrap() > 5000, "{found}");
}

fn assert_plays(found: &Value, records: u64) {
    assert!(count(&found["moved"]) > 1000, "{found}");
    assert_eq!(found["after_play"], 0, "{found}");
    assert_eq!(found["ended"], (records - 1).to_string(), "{found}");
    assert!(count(&found["played"]) >= 3, "{found}");
    let cursors = ["at_first", "at_last"].map(|when| found[when].as_array().unwrap().clone());
    let [first, last] = cursors;
    let moved = first.iter().zip(&last).filter(|(a, b)| a != b);
    assert!(moved.count() >= 3, "{found}");
    assert!(count(&found["picked"]) <= records / 4, "{found}");
}

#[test]
fn only_pages_are_replaced() {
    let place = ran(PATH);
    page(&place);
    page(&place);
    place.write("mine.html", "<!doctype html>mine");
    let output = place.fail(2, &["view", "a", "--out", "mine.html"]);
    assert_has(
        &output,
        &["mine.html: exists and was not written by actin view"],
    );
    assert_eq!(place.read("mine.html"), "<!doctype html>mine");
    place.succeed(&["run", "scene.ron", "--out", "a", "--overwrite"]);
}

#[test]
fn directories_that_are_not_whole() {
    let place = ran(MOTION);
    let refused = |what: &str, reason: &str| {
        let output = place.fail(2, &["view", what]);
        assert!(output.contains(reason), "{output}");
    };
    refused("absent", "absent: No such file");
    refused("scene.ron", "not a directory");
    fs::create_dir(place.path("empty")).unwrap();
    refused("empty", "no scene.ron in it");
    let states = fs::read(place.path("a/states.npz")).unwrap();
    let told = |remark: &str| {
        let page = page(&place);
        assert!(page.contains(remark), "{remark}");
    };
    place.write("a/states.npz", &states[..states.len() / 3]);
    told("states.npz is damaged");
    fs::remove_file(place.path("a/states.npz")).unwrap();
    told("states.npz is missing. The initial shape is shown.");
    place.write("a/energies.csv", "time_ns,total_pn_nm\n0.0,what\n");
    told("energies.csv is damaged: row 1, total_pn_nm: &quot;what&quot; is not a number.");
    place.write("a/summary.json", "{}");
    told("summary.json is damaged");
    fs::remove_file(place.path("a/summary.json")).unwrap();
    told("There is no readable summary.json: the run has not ended");
    place.write("a/scene.ron", "Scene(\n    nothing: 1)");
    refused("a", "scene.ron:2:");
}

#[test]
fn films_are_pictures_in_order() {
    let place = ran(PATH);
    let film = ["view", "a", "--film", "film", "--size", "320x200"];
    place.succeed(&film);
    let mut names: Vec<_> = fs::read_dir(place.path("film"))
        .unwrap()
        .collect::<Result<_, _>>()
        .unwrap();
    names.sort_by_key(std::fs::DirEntry::file_name);
    assert!(names.len() >= 5, "{}", names.len());
    let mut before = Vec::new();
    for (k, entry) in names.iter().enumerate() {
        assert_eq!(entry.file_name(), format!("{:05}.png", k + 1).as_str());
        let bytes = fs::read(entry.path()).unwrap();
        assert_eq!(bytes[..8], *b"\x89PNG\r\n\x1a\n");
        let side = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
        assert_eq!((side(16), side(20)), (320, 200));
        assert_ne!(bytes, before, "picture {k} is that before it");
        before = bytes;
    }
    let output = place.fail(2, &film);
    assert_has(&output, &["film: is not empty"]);
}

#[test]
fn films_that_turn_and_arguments_that_are_refused() {
    let place = ran(PATH);
    let turn = [
        "view",
        "a",
        "--film",
        "turn",
        "--size",
        "64x48",
        "--turn",
        "360",
        "--pictures",
        "4",
    ];
    place.succeed(&turn);
    assert_eq!(fs::read_dir(place.path("turn")).unwrap().count(), 4);
    for bad in [["--size", "5x9"], ["--size", "640"], ["--pictures", "0"]] {
        place.fail(2, &[&["view", "a", "--film", "b"][..], &bad].concat());
    }
}

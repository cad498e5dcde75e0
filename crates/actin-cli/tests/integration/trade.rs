//! `actin trade`: table, files and error messages.

use crate::workplace;
use std::fs;
use workplace::{Workplace, code, stderr, stdout};

const BENT: &str = "Scene(
    filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 108.0)]),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))],
    task: Equilibrium(),
)";

/// The best scene runs. The table and the picture contain every candidate.
#[test]
fn a_trade_writes_a_table_a_picture_and_a_scene() {
    let place = Workplace::with(BENT);
    let arguments = [
        "trade",
        "scene.ron",
        "--quantity",
        "tip,energy",
        "--error",
        "0.05",
        "--out",
        "a",
    ];
    let output = place.actin(&arguments);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let printed = stdout(&output);
    assert!(printed.contains("reference: every monomer: "), "{printed}");
    let table = fs::read_to_string(place.path("a/trade.csv")).unwrap();
    let mut rows = csv::Reader::from_reader(table.as_bytes());
    let header = rows.headers().unwrap().clone();
    assert!(
        header.iter().any(|column| column == "tip error"),
        "{header:?}"
    );
    let picture = fs::read_to_string(place.path("a/trade.svg")).unwrap();
    let names: Vec<String> = rows
        .records()
        .map(|row| row.unwrap()[0].to_owned())
        .collect();
    assert!(names.len() >= 8);
    for name in &names {
        assert!(
            printed.contains(name.as_str()) && picture.contains(name.as_str()),
            "{name}"
        );
    }
    assert!(picture.contains("wanted: 5 %"));
    let best = place.actin(&["run", "a/best.ron", "--out", "b"]);
    assert_eq!(code(&best), 0, "{}", stderr(&best));
}

#[test]
fn an_earlier_trade_is_not_overwritten() {
    let place = Workplace::with(BENT);
    fs::create_dir(place.path("a")).unwrap();
    fs::write(place.path("a/best.ron"), "mine").unwrap();
    let output = place.actin(&["trade", "scene.ron", "--out", "a"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("--overwrite replaces it"));
    let kept = fs::read_to_string(place.path("a/best.ron")).unwrap();
    assert_eq!(kept, "mine");
}

#[test]
fn invalid_options_are_refused() {
    let place = Workplace::with(BENT);
    for (arguments, message) in [
        (
            ["--quantity", "linker-force"],
            "the scene has no linker-force",
        ),
        (
            ["--error", "2"],
            "error = 2.0: must be greater than 0 and below 1",
        ),
        (["--loads=-1.0", "--all"], "loads = -1.0: must be positive"),
        (["--budget", "never"], "not a number"),
    ] {
        let output = place.actin(&[&["trade", "scene.ron", "--out", "a"][..], &arguments].concat());
        assert_eq!(code(&output), 2, "{arguments:?}");
        assert!(stderr(&output).contains(message), "{}", stderr(&output));
    }
}

//! `actin trade`: table, files and error messages.

use crate::common::{Workplace, assert_has};
use std::fs;

const BENT: &str = "Scene(
    filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 108.0)]),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))],
    task: Equilibrium(),
)";

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
    let printed = place.succeed(&arguments);
    assert_has(&printed, &["reference: every monomer: "]);
    let table = place.read("a/trade.csv");
    let mut rows = csv::Reader::from_reader(table.as_bytes());
    let header = rows.headers().unwrap().clone();
    assert!(
        header.iter().any(|column| column == "tip error"),
        "{header:?}"
    );
    let picture = place.read("a/trade.svg");
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
    assert_has(&picture, &["wanted: 5 %"]);
    place.succeed(&["run", "a/best.ron", "--out", "b"]);
}

#[test]
fn an_earlier_trade_is_not_overwritten() {
    let place = Workplace::with(BENT);
    fs::create_dir(place.path("a")).unwrap();
    place.write("a/best.ron", "mine");
    let output = place.fail(2, &["trade", "scene.ron", "--out", "a"]);
    assert_has(&output, &["--overwrite replaces it"]);
    let kept = place.read("a/best.ron");
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
        let output = place.fail(
            2,
            &[&["trade", "scene.ron", "--out", "a"][..], &arguments].concat(),
        );
        assert!(output.contains(message), "{output}");
    }
}

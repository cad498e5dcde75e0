//! Messages of deliberate mistakes, compared with `scenarios/bad/printed.txt`.

use crate::common::{Workplace, code, stderr, stdout};
use std::fs;
use std::path::Path;

const MISTAKES: [&str; 44] = [
    "several-mistakes",
    "several-broken-rules",
    "filament-without-its-bracket",
    "section-without-its-bracket",
    "not-ron",
    "unclosed-scene",
    "text-behind-the-scene",
    "empty",
    "unknown-key",
    "unknown-unit-suffix",
    "missing-unit",
    "missing-key",
    "duplicate-key",
    "misspelled-structure",
    "unknown-law",
    "unknown-integrator",
    "wrong-type",
    "fractional-segments",
    "two-components",
    "negative-seed",
    "gap-between-sections",
    "clamp-twice",
    "non-finite-number",
    "linker-outside-the-filament",
    "negative-factor-of-a-rod",
    "arc-that-closes",
    "points-of-no-file",
    "unit-behind-a-number",
    "decimal-comma",
    "missing-comma",
    "equals-sign",
    "comment-with-a-hash",
    "vector-in-square-brackets",
    "name-in-quotes",
    "task-without-brackets",
    "one-clamp-without-a-list",
    "lower-case-choice",
    "observable-without-brackets",
    "repulsion-as-a-switch",
    "points-in-micrometres",
    "force-on-a-clamped-end",
    "equilibrium-of-a-free-filament",
    "thermal-without-drag",
    "time-step-above-stability-limit",
];

#[test]
fn mistakes_print_the_expected_messages() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/bad");
    let place = Workplace::with("");
    let mut printed = String::new();
    for name in MISTAKES {
        let file = format!("{name}.ron");
        fs::copy(folder.join(&file), place.path(&file)).unwrap();
        let output = place.actin(&["check", &file]);
        assert_eq!((code(&output), stdout(&output)), (2, ""), "{name}");
        let run = place.fail(2, &["run", &file]);
        assert_eq!(run, stderr(&output), "{name}");
        printed += &run;
        printed += "\n";
    }
    assert!(!place.path("runs").exists());
    let expected = fs::read_to_string(folder.join("printed.txt")).unwrap_or_default();
    assert!(
        printed == expected,
        "scenarios/bad/printed.txt should contain:\n{printed}"
    );
}

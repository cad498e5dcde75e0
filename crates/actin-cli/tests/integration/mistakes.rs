//! Messages of deliberate mistakes, compared with `scenarios/bad/printed.txt`.

use crate::common::{Workplace, code, stderr, stdout};
use std::fs;
use std::path::Path;

#[test]
fn mistakes_print_the_expected_messages() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/bad");
    let place = Workplace::with("");
    let expected = fs::read_to_string(folder.join("printed.txt")).unwrap();
    let places = expected
        .split_whitespace()
        .filter_map(|word| word.split_once(".ron:"));
    let mut names: Vec<&str> = places.map(|(name, _)| name).collect();
    names.dedup();
    assert!(names.len() > 40, "{names:?}");
    let mut printed = String::new();
    for name in names {
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
    assert!(
        printed == expected,
        "scenarios/bad/printed.txt should contain:\n{printed}"
    );
}

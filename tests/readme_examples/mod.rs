//! Examples of the library crates, as shown in their READMEs. READMEs run as documentation tests.

use std::fs;
use std::path::{Path, PathBuf};

/// The crates that can be used alone.
const LIBRARIES: [&str; 13] = [
    "actin-mechanics",
    "actin-ellipsoid",
    "actin-cosserat",
    "actin-coupling",
    "actin-integrate",
    "actin-equilibrium",
    "actin-brownian",
    "actin-fit",
    "actin-scene",
    "actin-sim",
    "actin-rundir",
    "actin-sweep",
    "actin-export",
];

const MEASUREMENTS: [&str; 8] = [
    "bond_rate",
    "elimination_order",
    "load_rate",
    "newton_against_length",
    "persistence_length",
    "scaling",
    "statics_against_dynamics",
    "weighted_bonds",
];

const MOST_LINES: usize = 60;

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(name)
}

fn examples(name: &str) -> Vec<(String, String)> {
    let files = fs::read_dir(folder(name).join("examples")).expect("every library has examples");
    // Examples in folders are measurements.
    let paths = files.map(|file| file.expect("it can be read").path());
    let paths = paths.filter(|path| path.is_file());
    let named = paths.map(|path| {
        let stem = path.file_stem().expect("a file").to_string_lossy();
        (stem.into_owned(), fs::read_to_string(&path).expect("text"))
    });
    named
        .filter(|(stem, _)| !MEASUREMENTS.contains(&stem.as_str()))
        .map(|(stem, text)| {
            let header = |line: &&str| line.starts_with("//!") || line.is_empty();
            let program: Vec<&str> = text.lines().skip_while(header).collect();
            (stem, program.join("\n"))
        })
        .collect()
}

#[test]
fn every_example_is_short_and_shown() {
    for name in LIBRARIES {
        let readme = fs::read_to_string(folder(name).join("README.md")).expect("text");
        for (example, program) in examples(name) {
            let lines = program.lines().count();
            assert!(lines <= MOST_LINES, "{name}: {example} has {lines} lines");
            let shown = readme.contains(&format!("```rust\n{program}\n```"));
            assert!(shown, "{name}: show the current {example} in the README");
            let command = format!("cargo run -p {name} --example {example}`");
            assert!(
                readme.contains(&command),
                "{name}: add the command of {example} to the README"
            );
        }
    }
}

#[test]
fn every_library_can_be_used_alone() {
    for name in LIBRARIES {
        let own = format!("use {}::", name.replace('-', "_"));
        let is_alone = |program: &str| {
            let mut uses = program
                .lines()
                .filter(|line| line.starts_with("use actin_"));
            uses.all(|line| line.starts_with(&own))
        };
        let alone = examples(name).iter().any(|(_, program)| is_alone(program));
        assert!(
            alone,
            "{name}: add an example that uses no other crate of the workspace"
        );
    }
}

#[test]
fn parameters_and_laws_are_written_and_read_with_the_feature_serde() {
    use actin_cosserat::{Rigidities, Stiffening, TanhTwist, TwistLaw};
    use actin_ellipsoid::EllipsoidParameters;
    fn comes_back<T>(value: &T)
    where
        T: serde::Serialize + serde::de::DeserializeOwned + PartialEq + std::fmt::Debug,
    {
        let text = actin_sim::to_ron(value, 0);
        assert_eq!(
            &actin_sim::read_ron::<T>(&text, "Law").unwrap(),
            value,
            "{text}"
        );
    }
    comes_back(&EllipsoidParameters::default());
    comes_back(&EllipsoidParameters::with_sampled_bonds(64, 3));
    comes_back(&Rigidities::table4());
    comes_back(&TwistLaw::Tanh(TanhTwist::published()));
    comes_back(&Stiffening {
        rest: 3.7e4,
        rise: 1.0 / 3.0,
        curvature: 0.01,
        twist: f64::INFINITY,
        shear: f64::INFINITY,
        range: 0.02,
    });
}

//! The reader of scenes under random texts: the corpus is every scene of the repository, good and
//! bad, each spoilt in a few places.

use super::config;
use super::mutation::{Mutation, mutations};
use actin_sim::{Assembly, Filament, Scene, SceneError, Section};
use proptest::prelude::*;
use proptest::sample::Index;
use proptest::test_runner::TestRunner;
use std::fs;
use std::path::Path;
use std::time::Instant;

/// Texts of all scenes below a folder.
fn texts(folder: &Path) -> Vec<String> {
    let mut all = Vec::new();
    let mut entries: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            all.extend(texts(&path));
        } else {
            all.push(fs::read_to_string(&path).unwrap());
        }
    }
    all
}

fn corpus() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let mut all = texts(&folder);
    // With every key written out.
    all.extend(crate::extremes::fields::scenes());
    all
}

/// Seconds that no input may take, on a busy machine: most take a ten-thousandth of that.
const PATIENCE_S: f64 = 60.0;

/// Most bonds of a scene that is built: 400 monomers have half as many by default.
const MOST_BONDS: f64 = 1e5;

/// Bodies that are sure to be refused: at a kilobyte each and more, what no machine has.
const TOO_MANY_BODIES: f64 = 1e12;

/// Whether building takes little: it is the reader that is tried here. What is refused for its size
/// is refused at once.
fn is_built_soon(scene: &Scene) -> bool {
    let counts = scene.filaments().flat_map(counts);
    let [bodies, bonds] = counts.fold([0.0; 2], |[a, b], [c, d]| [a + c, b + d]);
    bodies > TOO_MANY_BODIES || (bodies < 400.0 && bonds < MOST_BONDS)
}

/// Bodies and bonds of each section of a filament.
fn counts(filament: &Filament) -> impl Iterator<Item = [f64; 2]> {
    let monomers = &filament.monomers;
    let each = monomers.lateral_bonds as f64 + monomers.longitudinal_bonds as f64;
    filament.sections.iter().map(move |section| {
        let (from, to) = section.span_nm();
        match section {
            Section::Rod { segments, .. } => {
                [segments.map_or((to - from) / 10.0, |n| n as f64), 0.0]
            }
            Section::Ellipsoids { .. } => {
                let count = (to - from) / monomers.rise_nm;
                [count, count * each]
            }
        }
    })
}

/// Reads a text, and builds the scene if there is one: a scene or an error with its place.
fn read(text: &str) -> Result<(), SceneError> {
    let scene = Scene::from_ron(text)?;
    // As texts: a law may still hold a NaN here, which equals nothing; building refuses it.
    let written = scene.to_ron();
    let again = Scene::from_ron(&written).map(|scene| scene.to_ron());
    assert_eq!(again, Ok(written), "what is written is what was read");
    if is_built_soon(&scene) {
        Assembly::build(&scene).map_err(|problem| SceneError::locate(&problem, text))?;
    }
    Ok(())
}

fn check(text: &str) {
    let clock = Instant::now();
    if let Err(error) = read(text) {
        let lines = text.lines().count() + 1;
        assert!((1..=lines).contains(&error.line), "{error}");
        let width = text
            .lines()
            .nth(error.line - 1)
            .map_or(0, |line| line.chars().count());
        assert!((1..=width + 1).contains(&error.column), "{error}");
        assert!(!error.message.is_empty());
    }
    assert!(clock.elapsed().as_secs_f64() < PATIENCE_S, "too slow");
}

/// No panic, no hang, and an error that stands within the text. Symptoms of the plausible bugs: a
/// column counted in bytes, a place before line 1, a bracket followed by recursion.
#[test]
fn spoilt_scenes_are_read_or_refused_with_their_place() {
    let corpus = corpus();
    let input = (any::<Index>(), mutations());
    let spoil = |text: &str, changes: &[Mutation]| {
        let change = |text: String, change: &Mutation| change.apply(&text, &corpus);
        changes.iter().fold(text.to_owned(), change)
    };
    let outcome = TestRunner::new(config()).run(&input, |(which, changes)| {
        let text: &String = which.get(&corpus);
        check(&spoil(text, &changes));
        Ok(())
    });
    outcome.unwrap_or_else(|error| panic!("{error}"));
}

/// Texts that are no scenes at all.
#[test]
fn noise_is_refused() {
    let noise = prop_oneof!["\\PC{0,200}", "[(){}\\[\\]:,\"/*a-z0-9 \\n.#-]{0,300}"];
    let outcome = TestRunner::new(config()).run(&noise, |text| {
        check(&text);
        prop_assert!(Scene::from_ron(&text).is_err());
        Ok(())
    });
    outcome.unwrap_or_else(|error| panic!("{error}"));
}

/// A hundred thousand brackets, open or closed, in a thread with a small stack: depth is limited,
/// not followed until the stack ends.
#[test]
fn deep_nesting_is_refused_without_a_deep_stack() {
    let deep = 100_000;
    let mut all = Vec::new();
    for open in ["(", "[", "{", "Some(", "/*", "Scene(filament:", "[[(", "a("] {
        for before in [
            "",
            "Scene(filament:",
            "Scene(title:",
            "Scene(filament: Filament(sections:",
        ] {
            all.push(format!("{before}{}", open.repeat(deep)));
        }
    }
    all.push(format!("{}{}", "(".repeat(deep), ")".repeat(deep)));
    let thread = std::thread::Builder::new().stack_size(512 * 1024);
    let refused = thread.spawn(move || all.iter().all(|text| Scene::from_ron(text).is_err()));
    assert!(refused.unwrap().join().unwrap());
}

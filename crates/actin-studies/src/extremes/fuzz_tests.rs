//! Random and deeply nested texts, which must be refused. `crates/actin-cli/tests/trials` corrupts existing scenes.

use actin_sim::Scene;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed, TestRunner};
use std::time::Instant;

const CASES: u32 = 300;

fn config() -> Config {
    let wanted = std::env::var("ACTIN_FUZZ_CASES").ok();
    let cases = wanted.map_or(CASES, |text| {
        text.parse()
            .unwrap_or_else(|_| panic!("ACTIN_FUZZ_CASES={text} is not a number"))
    });
    Config {
        cases,
        failure_persistence: None,
        ..Config::default()
    }
}

#[test]
fn random_input_can_be_drawn_again() {
    let seed = config().rng_seed;
    println!("PROPTEST_RNG_SEED={seed}");
    assert!(
        matches!(seed, RngSeed::Fixed(_)),
        "not run by cargo in this workspace"
    );
}

const PATIENCE_S: f64 = 60.0;

fn check(text: &str) {
    let clock = Instant::now();
    if let Err(error) = Scene::from_ron(text) {
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

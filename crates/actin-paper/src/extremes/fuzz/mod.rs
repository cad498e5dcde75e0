//! Random texts and random scenes: whatever comes in, a scene or an error comes out.

mod builder;
mod mutation;
mod reader;

use proptest::test_runner::{Config, RngSeed};

/// Cases of each property where the environment does not say.
const CASES: u32 = 300;

/// How many cases a property is tried with: `ACTIN_FUZZ_CASES`, or a few seconds' worth.
fn config() -> Config {
    let wanted = std::env::var("ACTIN_FUZZ_CASES").ok();
    let cases = wanted.map_or(CASES, |text| {
        text.parse()
            .unwrap_or_else(|_| panic!("ACTIN_FUZZ_CASES={text} is no number"))
    });
    Config {
        cases,
        // Inputs that broke something are kept as tests of their own.
        failure_persistence: None,
        ..Config::default()
    }
}

/// Two runs try the same input: `.cargo/config.toml` gives a seed, unless the environment does.
#[test]
fn random_input_can_be_drawn_again() {
    let seed = config().rng_seed;
    println!("PROPTEST_RNG_SEED={seed}");
    assert!(
        matches!(seed, RngSeed::Fixed(_)),
        "not run by cargo in this workspace"
    );
}

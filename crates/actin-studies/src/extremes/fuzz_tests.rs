//! Random scenes and texts, which must be built or refused. `crates/actin-cli/tests/trials` corrupts existing scenes.

use super::sizes::loads;
use actin_mechanics::{Xorshift, perturb};
use actin_sim::{Assembly, Plan, Scene, SceneProblem};
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

/// Draws a factor from 1e-6 to 1e6, uniform in its logarithm, or 1.
fn factor() -> impl Strategy<Value = f64> {
    prop_oneof![
        3 => Just(1.0),
        2 => (-2.0..2.0f64).prop_map(|exponent| 10f64.powf(exponent)),
        1 => (-6.0..6.0f64).prop_map(|exponent| 10f64.powf(exponent)),
        1 => (-300.0..300.0f64).prop_map(|exponent| 10f64.powf(exponent)),
    ]
}

fn sections() -> impl Strategy<Value = String> {
    let length = prop_oneof![4 => 3.0..40.0f64, 1 => 0.01..3.0f64];
    let rod = prop::option::of(1usize..6);
    let parts = prop::collection::vec((length, rod), 1..5);
    (any::<bool>(), parts).prop_map(|(rod_first, parts)| {
        let mut from = 0.0;
        let mut all = Vec::new();
        for (i, (length, segments)) in parts.into_iter().enumerate() {
            let to = from + length;
            let segments = segments.map_or(String::new(), |n| format!(", segments: {n}"));
            all.push(if (i % 2 == 0) == rod_first {
                format!("Rod(from_nm: {from:?}, to_nm: {to:?}{segments}), ")
            } else {
                format!("Ellipsoids(from_nm: {from:?}, to_nm: {to:?}), ")
            });
            from = to;
        }
        all.concat()
    })
}

fn monomers() -> impl Strategy<Value = String> {
    let factors = prop::collection::vec(factor(), 8);
    let bonds = || 1usize..9;
    let top = prop::sample::select(vec![0usize, 1, 2]);
    (any::<u64>(), bonds(), bonds(), factors, top, -1e3..1e3f64).prop_map(
        |(seed, lateral, longitudinal, f, top, angle)| {
            let mut axes = [2.7 * f[0]; 3];
            axes[top] = 1.9 * f[1];
            let [a, b, c] = axes;
            format!(
                "Monomers(anchors: Independent, seed: {seed},
                 lateral_bonds: {lateral}, longitudinal_bonds: {longitudinal},
                 semi_axes_nm: ({a:?}, {b:?}, {c:?}), radius_nm: {:?}, rise_nm: {:?},
                 mass_ag: {:?}, lateral_rigidity_pn_per_nm: {:?}, lateral_max_bond_nm: {:?},
                 longitudinal_max_bond_nm: {:?}, turn_deg: {angle:?})",
                1.8 * f[2],
                2.7385 * f[3].clamp(0.05, 1e300),
                0.0697 * f[4],
                2258.0 * f[5],
                // For shorter lengths, sampling each interface fails after a million attempts.
                1.6 * f[6].max(0.5),
                2.2 * f[7].max(0.5),
            )
        },
    )
}

fn rod() -> impl Strategy<Value = String> {
    let balance = prop::sample::select(vec!["EnergyGradient", "PaperBalance"]);
    let law = prop::sample::select(vec!["Constant", "PublishedExtension", "CouplingEnergy"]);
    let factors = prop::collection::vec(factor(), 6);
    (balance, law, factors).prop_map(|(balance, law, f)| {
        format!(
            "RodModel(force_law: {balance}, law: {law}, material: Rigidities(
                shear_pn: ({:?}, {:?}, {:?}), bend_pn_nm2: ({:?}, {:?}, {:?})))",
            1.6e4 * f[0],
            1.6e4 * f[1],
            3.4e4 * f[2],
            3.9e4 * f[3],
            3.9e4 * f[4],
            1.3e4 * f[5],
        )
    })
}

fn linkers() -> impl Strategy<Value = String> {
    let one = (0.0..1.0f64, factor(), factor(), -1e3..1e3f64).prop_map(
        |(share, radius, stiffness, azimuth)| {
            format!(
                "Linker(at_nm: {:?}, radius_nm: {:?}, azimuth_deg: {azimuth:?},
                 displaced_nm: (1.0, 2.0, 0.0), stiffness_pn_per_nm: {:?}),",
                4.0 * share,
                1.8 * radius,
                100.0 * stiffness
            )
        },
    );
    prop::collection::vec(one, 0..3).prop_map(|all| all.concat())
}

fn scene() -> impl Strategy<Value = String> {
    let clamps = prop::sample::select(vec![
        "",
        "Clamp(end: Start)",
        "Clamp(end: Start), Clamp(end: End, slides: AlongAxis)",
        "Clamp(end: End, hold: NodeAndFrame)",
        "Clamp(end: Start, hold: TwoNodesAndFrame), Clamp(end: End)",
    ]);
    let junction = (prop::sample::select(vec!["Shared", "Full"]), 1usize..3);
    (sections(), monomers(), rod(), junction, clamps, linkers()).prop_map(
        |(sections, monomers, rod, (weight, attached), clamps, linkers)| {
            format!(
                "Scene(
                    filament: Filament(sections: [{sections}], monomers: {monomers}, rod: {rod},
                        junction: (weight: {weight}, attached_monomers: {attached})),
                    clamps: [{clamps}], linkers: [{linkers}],
                    task: Dynamics(duration_ns: 1.0),
                )"
            )
        },
    )
}

fn evaluate(text: &str) -> Result<(), SceneProblem> {
    let Ok(scene) = Scene::from_ron(text) else {
        return Ok(());
    };
    let mut assembly = Assembly::build(&scene)?;
    assert!(assembly.rest.is_finite(), "places of the built filament");
    let plan = Plan::new(&assembly)?;
    let estimate = plan.estimate().expect("a motion");
    assert!(estimate.time_step_ns.is_finite() && estimate.time_step_ns > 0.0);
    perturb(
        assembly.system.state_mut(),
        &mut Xorshift::new(1),
        1e-3,
        1e-3,
    );
    let loads = loads(assembly.system.interactions(), assembly.system.state());
    let all = loads.force.iter().chain(loads.torque.iter());
    assert!(
        all.into_iter().all(|v| v.iter().all(|c| c.is_finite())),
        "loads of a filament with a stable step"
    );
    Ok(())
}

#[test]
fn random_scenes_are_built_or_refused() {
    let outcome = TestRunner::new(config()).run(&scene(), |text| {
        if let Err(problem) = evaluate(&text) {
            prop_assert!(!problem.key.is_empty() && !problem.rule.is_empty());
        }
        Ok(())
    });
    outcome.unwrap_or_else(|error| panic!("{error}"));
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

//! The builder under random scenes whose numbers are valid, but of any size.

use super::config;
use actin_mechanics::Loads;
use actin_mechanics::{Xorshift, perturb};
use actin_sim::{Assembly, Scene, SceneProblem};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;

/// A factor from 1e-6 to 1e6, as often small as large, or none.
fn factor() -> impl Strategy<Value = f64> {
    prop_oneof![
        3 => Just(1.0),
        2 => (-2.0..2.0f64).prop_map(|exponent| 10f64.powf(exponent)),
        1 => (-6.0..6.0f64).prop_map(|exponent| 10f64.powf(exponent)),
        1 => (-300.0..300.0f64).prop_map(|exponent| 10f64.powf(exponent)),
    ]
}

/// Sections in turn of either kind, up to four, with lengths from a hundredth of a nm to 40 nm.
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
                // Below the gap each interface draws a million points in vain.
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

/// A scene of which every number obeys the rule of its own key.
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

/// Builds the scene, estimates its step and evaluates its loads as built and shaken.
fn evaluate(text: &str) -> Result<(), SceneProblem> {
    let Ok(scene) = Scene::from_ron(text) else {
        return Ok(());
    };
    let mut assembly = Assembly::build(&scene)?;
    assert!(assembly.rest.is_finite(), "places of the built filament");
    let plan = actin_sim::Plan::new(&assembly)?;
    let estimate = plan.estimate().expect("a motion");
    assert!(estimate.time_step_ns.is_finite() && estimate.time_step_ns > 0.0);
    perturb(
        assembly.system.state_mut(),
        &mut Xorshift::new(1),
        1e-3,
        1e-3,
    );
    let state = assembly.system.state();
    let mut loads = Loads::zeros(state);
    for interaction in assembly.system.interactions() {
        interaction.add_loads(state, &mut loads);
    }
    let all = loads.force.iter().chain(loads.torque.iter());
    assert!(
        all.into_iter().all(|v| v.iter().all(|c| c.is_finite())),
        "loads of a filament with a stable step"
    );
    Ok(())
}

/// A filament with finite loads and a stable step, or a problem that names its key.
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

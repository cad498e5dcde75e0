//! Zero loads in filaments as built.

use crate::common::build;
use actin_mechanics::Loads;

fn loads_at_rest(sections: &str, seed: u64, junction: &str, clamps: &str) -> (f64, f64) {
    let assembly = build(&format!(
        "Scene(
            filament: Filament(
                sections: [{sections}],
                monomers: Monomers(anchors: Independent, seed: {seed}),
                junction: JunctionModel({junction}),
                rod: RodModel(law: Constant),
            ),
            clamps: [{clamps}],
            task: Dynamics(duration_ns: 1.0),
        )"
    ));
    let mut loads = Loads::zeros(&assembly.rest);
    for interaction in assembly.system.interactions() {
        interaction.add_loads(&assembly.rest, &mut loads);
    }
    let largest =
        |norms: &actin_mechanics::Vectors| norms.iter().map(|v| v.norm()).fold(0.0, f64::max);
    (largest(&loads.force), largest(&loads.torque))
}

const MONOMERS_FIRST: &str =
    "Ellipsoids(from_nm: 0.0, to_nm: 40.0), Rod(from_nm: 40.0, to_nm: 80.0)";
const ROD_FIRST: &str = "Rod(from_nm: 0.0, to_nm: 40.0), Ellipsoids(from_nm: 40.0, to_nm: 80.0)";
const ROD_IN_THE_MIDDLE: &str = "Ellipsoids(from_nm: 0.0, to_nm: 30.0), \
     Rod(from_nm: 30.0, to_nm: 60.0, segments: 1), Ellipsoids(from_nm: 60.0, to_nm: 90.0)";
const MONOMERS_IN_THE_MIDDLE: &str = "Rod(from_nm: 0.0, to_nm: 30.0, segments: 7), \
     Ellipsoids(from_nm: 30.0, to_nm: 60.0), Rod(from_nm: 60.0, to_nm: 90.0)";

#[test]
fn filaments_as_built_are_unloaded() {
    // Round-off: 64 bonds of 50 pN/nm, or a segment of 3.4e4 pN, times 1e-16 of positions of 90 nm,
    // a few times over; torques with an arm of 10 nm.
    let (force_limit, torque_limit) = (5e-10, 5e-9);
    let orders = [
        MONOMERS_FIRST,
        ROD_FIRST,
        ROD_IN_THE_MIDDLE,
        MONOMERS_IN_THE_MIDDLE,
    ];
    let clamps = [
        "",
        "Clamp(end: Start)",
        "Clamp(end: Start), Clamp(end: End)",
    ];
    let mut worst = (0.0_f64, 0.0_f64);
    for sections in orders {
        for (seed, clamps) in [0, 1, u64::MAX].into_iter().zip(clamps) {
            for attached in [1, 2] {
                for weight in ["Shared", "Full"] {
                    let junction = format!("weight: {weight}, attached_monomers: {attached}");
                    let (force, torque) = loads_at_rest(sections, seed, &junction, clamps);
                    let case = format!("{sections} {junction} {clamps}, seed {seed}");
                    assert!(force < force_limit, "{force:e} pN: {case}");
                    assert!(torque < torque_limit, "{torque:e} pN nm: {case}");
                    worst = (worst.0.max(force), worst.1.max(torque));
                }
            }
        }
    }
    println!("largest at rest: {:e} pN, {:e} pN nm", worst.0, worst.1);
}

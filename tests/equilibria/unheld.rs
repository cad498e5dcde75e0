//! Filaments that nothing holds, under forces that balance: they turn until the couple of the forces
//! vanishes, and the certificate counts the rigid motions that are left.

use super::common::solved;
use actin_equilibrium::Stability;
use actin_mechanics::Vector3;
use actin_sim::{Assembly, End};

const TIGHT: &str = "task: Equilibrium(force_pn: 1e-9, torque_pn_nm: 1e-8)";

/// A free filament with `force` (pN) on its end and the opposite on its start.
fn pulled_apart(sections: &str, [x, y, z]: [f64; 3]) -> (Assembly, Vector3, Stability) {
    let text = format!(
        "Scene(
            filament: Filament(sections: [{sections}], rod: RodModel(law: Constant)),
            loads: [
                EndForce(end: End, force_pn: ({x:?}, {y:?}, {z:?})),
                EndForce(end: Start, force_pn: ({:?}, {:?}, {:?})),
            ],
            {TIGHT},
        )",
        -x, -y, -z
    );
    let (assembly, report) = solved(&text);
    let state = assembly.system.state();
    let span = assembly.tip_nm(state, End::End) - assembly.tip_nm(state, End::Start);
    let stability = report.equilibrium.unwrap().certificate.stability();
    (assembly, span, stability)
}

/// However the forces point at first, against the rod included: it ends along them, as long as a rod
/// on a wall under the same force, free to move as a whole (3) and about itself (1).
#[test]
fn an_unheld_rod_turns_along_its_forces() {
    let rod = "Rod(from_nm: 0.0, to_nm: 60.0)";
    let (on_wall, _) = solved(&format!(
        "Scene(
            filament: Filament(sections: [{rod}], rod: RodModel(law: Constant)),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: (0.0, 0.0, 5.0))],
            {TIGHT},
        )"
    ));
    let length = on_wall.tip_nm(on_wall.system.state(), End::End).z;
    assert!(length > 60.004);
    for force in [
        [0.0, 0.0, 5.0],
        [0.0, 0.0, -5.0],
        [3.0, 0.0, 4.0],
        [0.0, 5.0, 0.0],
    ] {
        let (_, span, stability) = pulled_apart(rod, force);
        println!("{force:?}: {span:?}, {stability:?}");
        // A force of 1e-9 pN that is left turns a rod under 5 pN by 1e-9 rad or less for each body.
        assert!((span - Vector3::from(force) / 5.0 * length).norm() < 1e-6);
        assert_eq!(stability, Stability::Neutral { modes: 4 });
    }
}

/// Monomers, and monomers on a rod, end along the forces too: what is left of their couple is what
/// the tolerance leaves.
#[test]
fn other_filaments_end_without_a_couple() {
    let monomers = "Ellipsoids(from_nm: 0.0, to_nm: 60.0)";
    let mixed = "Ellipsoids(from_nm: 0.0, to_nm: 20.0), Rod(from_nm: 20.0, to_nm: 60.0)";
    for sections in [monomers, mixed] {
        let force = [1.0, 0.0, -2.0];
        let (_, span, stability) = pulled_apart(sections, force);
        let couple = span.cross(&Vector3::from(force)).norm();
        println!("{couple:e} pN nm, {stability:?}");
        // Some dozen bodies, each with the tolerance in torque and in force at 60 nm.
        assert!(couple < 1e-5);
        assert!(span.dot(&Vector3::from(force)) > 0.0);
        assert!(
            !matches!(stability, Stability::Saddle { .. }),
            "{stability:?}"
        );
    }
}

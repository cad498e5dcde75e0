//! Unconstrained filaments under balanced forces rotate until the couple vanishes. The certificate
//! counts the remaining rigid motions.

use super::common::solved;
use actin_equilibrium::Stability;
use actin_mechanics::Vector3;
use actin_sim::{Assembly, End};

const TIGHT: &str = "task: Equilibrium(force_pn: 1e-9, torque_pn_nm: 1e-8)";

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

/// The rod ends along the forces, with the length of a clamped rod. Translations (3) and its axial
/// rotation (1) are neutral.
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
        // A residual of 1e-9 pN rotates a rod under 5 pN by at most 1e-9 rad per body.
        assert!((span - Vector3::from(force) / 5.0 * length).norm() < 1e-6);
        assert_eq!(stability, Stability::Neutral { modes: 4 });
    }
}

#[test]
fn other_filaments_end_without_a_couple() {
    let monomers = "Ellipsoids(from_nm: 0.0, to_nm: 60.0)";
    let mixed = "Ellipsoids(from_nm: 0.0, to_nm: 20.0), Rod(from_nm: 20.0, to_nm: 60.0)";
    for sections in [monomers, mixed] {
        let force = [1.0, 0.0, -2.0];
        let (_, span, stability) = pulled_apart(sections, force);
        let couple = span.cross(&Vector3::from(force)).norm();
        println!("{couple:e} pN nm, {stability:?}");
        // A few dozen bodies, each with the tolerance in torque and in force at 60 nm.
        assert!(couple < 1e-5);
        assert!(span.dot(&Vector3::from(force)) > 0.0);
        assert!(
            !matches!(stability, Stability::Saddle { .. }),
            "{stability:?}"
        );
    }
}

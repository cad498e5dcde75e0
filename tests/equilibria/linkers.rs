//! Filaments held by linkers: an independent value, and balance.

use super::common::{MIXED, solved};
use actin_mechanics::{Vector3, rotation};
use actin_sim::{Assembly, BodyKind};

const PULLED_ROUND: &str = "Scene(
    filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 180.5, segments: 19)], rod: RodModel(law: Constant)),
    clamps: [
        Clamp(end: Start, hold: TwoNodesAndFrame),
        Clamp(end: End, hold: TwoNodesAndFrame),
    ],
    linkers: [Linker(
        at_nm: 90.25, radius_nm: 1.8, displaced_nm: (0.0, 5.0, 0.0),
        stiffness_pn_per_nm: 100.0,
    )],
    task: Equilibrium(),
)";

fn energy(assembly: &Assembly, name: &str) -> f64 {
    let terms = assembly.terms.iter().zip(assembly.system.energies());
    terms.filter(|(t, _)| t.name == name).map(|(_, e)| e).sum()
}

/// Rod of Figure 7 in an independent prototype: 27.96 pN nm in the rod, 5.285 degrees, 15.65 pN in
/// the linker.
#[test]
fn a_linker_turns_the_middle_of_a_clamped_rod() {
    let (assembly, _) = solved(PULLED_ROUND);
    let state = assembly.system.state();
    let elastic = energy(&assembly, "rod");
    let middle = assembly.linkers[0].site().frame();
    let turn = rotation::log(state.frames.orientation.get(middle))
        .z
        .to_degrees();
    let force = assembly.linkers[0].force(state).norm();
    println!("pulled round: {elastic:.4} pN nm, {turn:.4} deg, {force:.4} pN");
    assert!((elastic - 27.96).abs() < 0.005);
    assert!((turn - 5.285).abs() < 0.0005);
    assert!((force - 15.65).abs() < 0.005);
}

/// A couple `C` about a free filament acts on both ends of its linker: `C = k sin a` for the tilt `a` of each end.
#[test]
fn a_couple_tilts_a_linker() {
    let text = "Scene(
        filaments: [
            Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0, segments: 4)], rod: (law: Constant)),
            Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0, segments: 4)], rod: (law: Constant), at_nm: (20.0, 0.0, 0.0)),
        ],
        clamps: [Clamp(end: Start), Clamp(end: End)],
        linkers: [Linker(
            at_nm: 15.0, to: Site(filament: 1, at_nm: 15.0), stiffness_pn_per_nm: 10.0, rest_length_nm: 20.0,
            tilt_pn_nm: 100.0, twist_pn_nm: 50.0,
        )],
        loads: [Couple(filament: 1, end: End, couple_pn_nm: (0.0, 0.0, 30.0))],
        task: Equilibrium(),
    )";
    let (assembly, _) = solved(text);
    let found = energy(&assembly, "linker");
    let exact = 200.0 * (1.0 - 0.3_f64.asin().cos());
    println!("tilted linker: {found:.6} pN nm, exact {exact:.6}");
    // The clamped filament rolls at the linker; residual torques are below 1e-6 pN nm.
    assert!((found - exact).abs() < 1e-5);
}

#[test]
fn clamp_and_linkers_balance() {
    let (mut assembly, _) = solved(&format!(
        "Scene(
            filament: {MIXED},
            clamps: [Clamp(end: Start)],
            linkers: [
                Linker(
                    at_nm: 12.0, radius_nm: 1.8, azimuth_deg: 40.0,
                    displaced_nm: (2.0, 0.0, 1.0), stiffness_pn_per_nm: 20.0,
                ),
                Linker(
                    at_nm: 33.0, radius_nm: 1.8, azimuth_deg: -70.0,
                    anchor_nm: (-6.0, 1.0, 36.0), stiffness_pn_per_nm: 10.0,
                    rest_length_nm: 3.0,
                ),
            ],
            task: Equilibrium(force_pn: 1e-9, torque_pn_nm: 1e-9),
        )"
    ));
    let loads = assembly.system.loads().clone();
    let state = assembly.system.state();
    let reaction = assembly.clamps[0].reaction(state, &loads);
    let (mut force, mut torque) = (reaction.force_pn, reaction.torque_pn_nm);
    for linker in &assembly.linkers {
        force += linker.force(state);
        let arm = linker.end_position(state) - assembly.clamps[0].point_nm(state);
        torque += arm.cross(&linker.force(state));
    }
    println!(
        "unbalanced: {:.1e} pN, {:.1e} pN nm",
        force.norm(),
        torque.norm()
    );
    assert!(reaction.force_pn.norm() > 1.0);
    // About 40 residuals of 1e-9, at up to 40 nm.
    assert!(force.norm() < 4e-8 && torque.norm() < 2e-6);
}

/// The site of a filament held only by a linker lies on the line from the anchor along the force.
#[test]
fn a_filament_hangs_on_its_linker() {
    let (assembly, _) = solved(
        "Scene(
            filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 60.0)], rod: RodModel(law: Constant)),
            loads: [EndForce(end: End, force_pn: (3.0, 0.0, 0.0))],
            linkers: [Linker(
                at_nm: 0.0, anchor_nm: (-4.0, 0.0, 3.0), stiffness_pn_per_nm: 2.0,
                rest_length_nm: 5.0,
            )],
            task: Equilibrium(),
        )",
    );
    let state = assembly.system.state();
    let linker = &assembly.linkers[0];
    assert!((linker.force(state) + Vector3::x() * 3.0).norm() < 1e-6);
    let expected = Vector3::new(2.5, 0.0, 3.0);
    // The line rotates by the ratio of the residual of 1e-7 pN to 3 pN.
    assert!((linker.site().position(state) - expected).norm() < 1e-6);
    let tip = assembly
        .points
        .iter()
        .rposition(|p| p.kind == BodyKind::Node);
    let tip = state.points.position.get(tip.unwrap());
    assert!((tip - expected).cross(&Vector3::x()).norm() < 1e-5);
}

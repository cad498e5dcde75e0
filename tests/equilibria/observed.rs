//! Observed quantities of equilibria against beam theory.

use crate::common::ran;
use actin_sim::Summary;
use std::collections::BTreeMap;

/// Bending rigidity (pN nm^2), length (nm).
const B: f64 = 3.0e4;
const L: f64 = 160.0;

fn observed(load: &str, observe: &str) -> BTreeMap<String, f64> {
    let text = format!(
        "Scene(
            filament: Filament(
                sections: [Rod(from_nm: 0.0, to_nm: {L:?}, segments: 32)],
                rod: RodModel(law: Constant, material: Rigidities(
                    shear_pn: (5e4, 5e4, 1e5), bend_pn_nm2: ({B:?}, {B:?}, 1e4),
                )),
            ),
            clamps: [Clamp(end: Start)],
            loads: [{load}],
            path: [Stage(set: [LoadFactor(load: 0, factor: 1.0)])],
            observe: [{observe}],
            task: Equilibrium(),
        )"
    );
    let (assembly, trajectory, outcome) = ran(&text);
    let columns = trajectory.records[0].observed.len();
    assert!(trajectory.records.len() > 2 && columns > 0);
    let lengths = trajectory.records.iter().map(|r| r.observed.len());
    assert!(lengths.into_iter().all(|length| length == columns));
    let last = trajectory.records.last().unwrap();
    let summary = Summary::new(&assembly, last, &outcome);
    let all = summary.observables.into_iter();
    all.map(|(name, one)| (name, one.last.unwrap())).collect()
}

#[test]
fn a_couple_bends_into_an_arc() {
    let found = observed(
        "Couple(end: End, couple_pn_nm: (0.0, 90.0, 0.0))",
        "Curvature(at_nm: 160.0), Curvature(at_nm: 3.0), Twist(at_nm: 80.0), EndReaction(end: Start),
         EndToEnd()",
    );
    let curvature = 90.0 / B;
    for at in ["160", "3"] {
        let kappa = found[&format!("curvature[0]_at_{at}nm_rad_per_nm")];
        assert!((kappa / curvature - 1.0).abs() < 1e-8, "{kappa}");
        // Bent about y, towards +x.
        let about_y = found[&format!("curvature[0]_at_{at}nm_y_rad_per_nm")];
        assert!((about_y / curvature - 1.0).abs() < 1e-8, "{about_y}");
    }
    assert!(found["twist[0]_at_80nm_rad_per_nm"].abs() < 1e-10);
    assert!((found["reaction[0]_start_torque_y_pn_nm"] + 90.0).abs() < 1e-5);
    // The chord of an arc is `2 sin(kappa L / 2) / kappa`; 32 segments have a relative error of
    // `(kappa h)^2 / 24`.
    let chord = 2.0 / curvature * (0.5 * curvature * L).sin();
    assert!((found["end_to_end[0]_nm"] / chord - 1.0).abs() < 2e-5);
}

/// Small tip force: moment `F (L - s)`, and reactions that balance the force.
#[test]
fn a_force_bends_in_proportion_to_its_arm() {
    let force = 0.01;
    let found = observed(
        "EndForce(end: End, force_pn: (0.01, 0.0, 0.0))",
        "Curvature(at_nm: 40.0), Curvature(at_nm: 120.0), EndReaction(end: Start), Tip()",
    );
    for at in [40.0, 120.0] {
        let kappa = found[&format!("curvature[0]_at_{at}nm_rad_per_nm")];
        let expected = force * (L - at) / B;
        // Second order in the slope of the tip, `F L^2 / (2 B)` = 4e-3.
        assert!((kappa / expected - 1.0).abs() < 1e-4, "{kappa} {expected}");
    }
    assert!((found["reaction[0]_start_force_x_pn"] + force).abs() < 1e-6);
    let torque = found["reaction[0]_start_torque_y_pn_nm"];
    let arm = found["tip[0]_z_nm"];
    assert!((torque + force * arm).abs() < 1e-5, "{torque} {arm}");
}

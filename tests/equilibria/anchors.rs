//! Anchors moved along a path, and linkers whose sites change between monomers and rod.

use super::common::{MIXED, apart, build, run, solved};
use actin_mechanics::Vector3;
use actin_sim::Assembly;

/// Clamped mixed filament with a linker on each section. Anchors are displaced by `displaced` and
/// moved by `shifts` along a path of one stage of 40 ns.
fn clamped(displaced: [Vector3; 2], shifts: Option<[Vector3; 2]>, task: &str) -> String {
    let show = |v: Vector3| format!("({:?}, {:?}, {:?})", v.x, v.y, v.z);
    let set = |i: usize, shift| format!("Anchor(linker: {i}, shift_nm: {})", show(shift));
    let path = shifts.map_or_else(String::new, |[a, b]| {
        let (a, b) = (set(0, a), set(1, b));
        format!("path: [Stage(set: [{a}, {b}], duration_ns: 40.0)],")
    });
    let [a, b] = displaced.map(show);
    format!(
        "Scene(
            filament: {MIXED},
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: (0.0, 1.0, 0.0))],
            linkers: [
                Linker(
                    at_nm: 12.0, radius_nm: 1.8, azimuth_deg: 40.0,
                    displaced_nm: {a}, stiffness_pn_per_nm: 20.0,
                ),
                Linker(
                    at_nm: 33.0, radius_nm: 1.8, azimuth_deg: -70.0,
                    displaced_nm: {b}, stiffness_pn_per_nm: 10.0,
                ),
            ],
            {path}
            task: {task},
        )"
    )
}

const TIGHT: &str = "Equilibrium(force_pn: 1e-9, torque_pn_nm: 1e-9)";
const SHIFTS: [[f64; 3]; 2] = [[2.0, 0.5, 1.0], [-3.0, 0.0, 2.0]];

#[test]
fn anchors_move_smoothly_in_time() {
    let shifts = SHIFTS.map(Vector3::from);
    let task = "Dynamics(
        duration_ns: 2000.0,
        integrator: PositionVerlet,
        step_safety: 0.9,
        drag: (translational_per_ns: 2.0, rotational_per_ns: 2.0),
        stop: (force_pn: 1e-8, torque_pn_nm: 1e-8, kinetic_pn_nm: 1e-12),
        record_every_ns: 1.0,
    )";
    let mut moving = build(&clamped([Vector3::zeros(); 2], Some(shifts), task));
    let rest = moving.rest.clone();
    let (trajectory, report) = run(&mut moving).unwrap();
    assert!(
        report.has_converged(),
        "not converged after {} steps",
        report.steps
    );
    let linker = &moving.linkers[1];
    for record in trajectory
        .records
        .iter()
        .take_while(|r| r.at.value() < 45.0)
    {
        let x = (record.at.value() / 40.0).min(1.0);
        let share = x.powi(3) * (10.0 + x * (6.0 * x - 15.0));
        let moved = linker.end_position(&record.state) - linker.end_position(&rest);
        // The time of a record is a sum of steps.
        assert!(
            (moved - shifts[1] * share).norm() < 1e-9,
            "{}",
            record.at.value()
        );
    }
    let (still, _) = solved(&clamped([Vector3::zeros(); 2], Some(shifts), TIGHT));
    let distance = apart(still.system.state(), moving.system.state());
    // Residual of 1e-8 pN on modes of about 0.1 pN/nm.
    assert!(distance < 1e-6, "{distance:e} nm apart");
}

/// Filament of Figure 5 with sites on the outer side of the bend and `rod` nm of finely segmented
/// rod.
fn planar(rod: f64) -> Assembly {
    let (from, to) = (80.0 - 0.5 * rod, 80.0 + 0.5 * rod);
    let segments = (rod / 2.5).round();
    let linker = |s: f64, x: f64| {
        format!(
            "Linker(
                at_nm: {s:?}, radius_nm: 1.8, azimuth_deg: 180.0, displaced_nm: ({x:?}, 0.0, 0.0),
                stiffness_pn_per_nm: 100.0,
            ),"
        )
    };
    let linkers = [(25.0, 8.0), (80.0, -8.0), (135.0, 8.0)].map(|(s, x)| linker(s, x));
    let (assembly, _) = solved(&format!(
        "Scene(
            filament: Filament(sections: [
                Ellipsoids(from_nm: 0.0, to_nm: {from:?}),
                Rod(from_nm: {from:?}, to_nm: {to:?}, segments: {segments}),
                Ellipsoids(from_nm: {to:?}, to_nm: 160.0),
            ], rod: RodModel(law: Constant)),
            linkers: [{}],
            task: Equilibrium(),
        )",
        linkers.concat()
    ));
    assembly
}

fn numbers(assembly: &Assembly) -> [f64; 3] {
    let state = assembly.system.state();
    let pull = |k: usize| assembly.linkers[k].force(state).norm();
    [assembly.system.energies().iter().sum(), pull(0), pull(2)]
}

/// As junctions pass the outer sites, energy and tension change per step by less than their spread
/// over resolutions.
#[test]
fn the_equilibrium_is_continuous_where_a_junction_crosses_a_site() {
    let crossing: Vec<Assembly> = [95.0, 98.0, 101.0, 104.0, 108.0, 112.0, 116.0]
        .map(planar)
        .into();
    let on_rod = |a: &Assembly| [0, 2].map(|k| a.linkers[k].site().shares().len() == 2);
    assert_eq!(on_rod(&crossing[0]), [false; 2]);
    assert_eq!(on_rod(&crossing[6]), [true; 2]);
    let steps: Vec<[f64; 3]> = crossing.iter().map(numbers).collect();
    let others = [30.0, 60.0, 90.0, 130.0, 140.0].map(|rod| numbers(&planar(rod)));
    for (k, name) in ["energy", "pull at 25 nm", "pull at 135 nm"]
        .iter()
        .enumerate()
    {
        let step = steps
            .windows(2)
            .map(|w| (w[1][k] - w[0][k]).abs())
            .fold(0.0, f64::max);
        let largest = others
            .iter()
            .map(|n| n[k])
            .fold(f64::NEG_INFINITY, f64::max);
        let smallest = others.iter().map(|n| n[k]).fold(f64::INFINITY, f64::min);
        assert!(step < largest - smallest, "{name}: a step of {step}");
    }
}

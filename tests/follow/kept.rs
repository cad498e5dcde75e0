//! Quantities conserved by a switch, and its energy change.

use super::{energy, scene, to_and_fro};
use actin_sim::follow::{AdaptiveMotion, CompletedStretch};
use actin_sim::{BodyKind, End, Scene, Solution, Solve};
use std::sync::LazyLock;

fn swinging() -> Scene {
    let rest = "clamps: [Clamp(end: Start)],
        loads: [EndForce(end: End, force_pn: (-5.0, 0.0, 0.0))],
        task: Dynamics(duration_ns: 6.0, time_step_ns: 0.00125, record_every_ns: 0.125),";
    scene(144.0, 0.5, rest)
}

/// The motion of most tests, whose resolution alternates every 0.75 ns.
static SWINGING: LazyLock<AdaptiveMotion> = LazyLock::new(|| to_and_fro(&swinging(), 0.75));

fn pairs(run: &AdaptiveMotion) -> impl Iterator<Item = (&CompletedStretch, &CompletedStretch)> {
    run.stretches.iter().zip(&run.stretches[1..])
}

#[test]
fn momentum_is_kept_to_round_off() {
    let run = &*SWINGING;
    assert!(run.stretches.len() > 6);
    for (before, after) in pairs(run) {
        let old = &before.trajectory.records.last().unwrap().state;
        let new = &after.trajectory.records[0].state;
        assert!((old.time - new.time).abs() < 1e-12);
        let switch = after.stretch.beginning.switch.as_ref().unwrap();
        // About 10 bodies of 0.2 ag and 10 nm/ns, 100 nm from the origin.
        let scale = old.momentum().norm().max(1.0);
        assert!((new.momentum() - old.momentum()).norm() < 1e-13 * scale);
        let arm = 150.0 * scale;
        assert!((new.angular_momentum() - old.angular_momentum()).norm() < 1e-12 * arm);
        assert!(switch.momentum_change < 1e-13 * scale);
        assert!(switch.angular_momentum_change < 1e-12 * arm);
    }
}

#[test]
fn bodies_outside_switched_cells_are_unchanged() {
    let run = &*SWINGING;
    let mut kept = 0;
    for (before, after) in pairs(run) {
        let (old, new) = (
            before.trajectory.records.last().unwrap(),
            &after.trajectory.records[0],
        );
        let switch = after.stretch.beginning.switch.as_ref().unwrap();
        let spans = [switch.to_monomers.as_slice(), &switch.to_rod].concat();
        let is_inside = |s: f64| spans.iter().any(|[a, b]| a - 1e-6 < s && s < b + 1e-6);
        let (from, to) = (&before.stretch.assembly, &after.stretch.assembly);
        let length = to.length_nm();
        for (i, point) in to.points.iter().enumerate() {
            if is_inside(point.s_nm.min(length)) {
                continue;
            }
            let same = |other: &actin_sim::PointInfo| {
                other.kind == point.kind && (other.s_nm - point.s_nm).abs() < 1e-6
            };
            let there = from.points.iter().position(same).unwrap();
            assert_eq!(
                new.state.points.position.get(i),
                old.state.points.position.get(there)
            );
            assert_eq!(
                new.state.points.velocity.get(i),
                old.state.points.velocity.get(there)
            );
            kept += 1;
        }
    }
    // Six nodes of the first cell at each switch, without the node at its end.
    assert_eq!(kept, 6 * (run.stretches.len() - 1));
}

/// Energy minus work, heat and changes by switches is constant up to the integrator error.
#[test]
fn the_energy_is_balanced() {
    let driven = "clamps: [Clamp(end: Start), Clamp(end: End)],
        path: [Stage(set: [Shift(end: End, shift_nm: (12.0, 0.0, -9.0))], duration_ns: 5.0)],
        task: Dynamics(duration_ns: 6.0, time_step_ns: 0.00125, record_every_ns: 0.125,
            drag: (translational_per_ns: 0.5, rotational_per_ns: 2.0)),";
    let driven = to_and_fro(&scene(144.0, 0.5, driven), 0.75);
    for run in [&*SWINGING, &driven] {
        let left = |ran: &CompletedStretch| -> Vec<f64> {
            let switches = ran.stretch.beginning.switches_pn_nm;
            let records = ran.trajectory.records.iter();
            records
                .map(|r| energy(r) - r.booked.sum_pn_nm() - switches)
                .collect()
        };
        let all: Vec<f64> = run.stretches.iter().flat_map(left).collect();
        let records = run.stretches.iter().flat_map(|ran| &ran.trajectory.records);
        let largest = records.fold(0.0, |most: f64, r| most.max(r.kinetic_pn_nm));
        let booked: f64 = run.switches().map(|s| s.energy_pn_nm.abs()).sum();
        assert!(booked > 1.0, "{booked}");
        let worst = all
            .iter()
            .fold(0.0, |worst: f64, e| worst.max((e - all[0]).abs()));
        assert!(worst < 1e-3 * largest, "{worst} of {largest}");
    }
}

#[test]
fn the_motion_agrees_with_monomers() {
    let followed = &*SWINGING;
    let mut scene = swinging();
    let length = followed.stretches[0].stretch.assembly.length_nm();
    scene.filament.sections = vec![actin_sim::Section::Ellipsoids {
        from_nm: 0.0,
        to_nm: length,
        altered: None,
    }]
    .into();
    let Solution {
        assembly: all,
        trajectory,
        ..
    } = scene.solve().unwrap();
    let expected = all.tip_nm(&trajectory.records.last().unwrap().state, End::End);
    let last = followed.stretches.last().unwrap();
    let record = last.trajectory.records.last().unwrap();
    let found = last.stretch.assembly.tip_nm(&record.state, End::End);
    println!("tip {found:?}, of monomers {expected:?}");
    assert!((found - expected).norm() < 0.05 * expected.x.abs());
    assert!(
        last.stretch
            .assembly
            .points
            .iter()
            .any(|p| p.kind == BodyKind::Monomer)
    );
}

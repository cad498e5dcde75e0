//! Inertial motion in water compared with overdamped motion.

use super::filaments::mean_and_error;
use crate::common::{build, ran};
use actin_brownian::Cylinder;
use actin_sim::mechanics::{State, Vector3};
use actin_sim::{End, Fluid, Plan, Record};
use std::f64::consts::PI;

fn tips(sections: &str, force_pn: f64, task: &str) -> (Vec<Vector3>, u64) {
    let text = format!(
        "Scene(
            filament: Filament(sections: [{sections}], rod: RodModel(law: Constant)),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: ({force_pn:?}, 0.0, 0.0))],
            task: {task},
        )"
    );
    let (assembly, trajectory, report) = ran(&text);
    let tip = |record: &Record| assembly.tip_nm(&record.state, End::End);
    let tips = trajectory.records.iter().map(tip).collect();
    (tips, report.force_evaluations)
}

fn largest_difference(sections: &str, duration_ns: f64, step_ns: f64) -> f64 {
    let every = duration_ns / 10.0;
    let water = "drag: Water(viscosity_mpa_s: 1.0)";
    let with =
        format!("Dynamics(duration_ns: {duration_ns:?}, record_every_ns: {every:?}, {water})");
    let without = format!(
        "Brownian(duration_ms: {:?}, temperature_k: 0.0, record_every_ns: {every:?}, time_step_ns: {step_ns:?}, {water})",
        duration_ns * 1e-6
    );
    let [with, without] = [with, without].map(|task| tips(sections, 4.0, &task).0);
    assert_eq!((with.len(), without.len()), (11, 11));
    let last = without[10].x - without[0].x;
    let share = (without[5].x - without[0].x) / last;
    let pairs = with.iter().zip(&without);
    let largest = pairs.map(|(a, b)| (a.x - b.x).abs()).fold(0.0, f64::max) / last;
    println!("{sections}: half way {share:.3} of {last:.4} nm, largest difference {largest:.2e}");
    largest
}

/// Relaxation over 150 ns with and without inertia agrees to 1 % of the deflection.
#[test]
fn cantilevers_relax_alike_with_inertia_and_without() {
    for sections in [
        "Rod(from_nm: 0.0, to_nm: 60.0, segments: 3)",
        "Ellipsoids(from_nm: 0.0, to_nm: 60.0)",
        "Ellipsoids(from_nm: 0.0, to_nm: 30.0), Rod(from_nm: 30.0, to_nm: 60.0, segments: 2)",
    ] {
        assert!(largest_difference(sections, 150.0, 0.2) < 0.01);
    }
}

#[test]
#[ignore = "takes minutes"]
fn long_cantilevers_relax_alike_with_inertia_and_without() {
    for sections in [
        "Rod(from_nm: 0.0, to_nm: 160.0, segments: 4)",
        "Rod(from_nm: 0.0, to_nm: 160.0, segments: 8)",
    ] {
        assert!(largest_difference(sections, 4000.0, 5.0) < 0.01);
    }
}

/// Mean squared transverse deflection of the tip (nm^2), its standard error from 20 blocks, and the
/// evaluations.
fn variance(task: &str) -> (f64, f64, u64) {
    let (tips, evaluations) = tips("Rod(from_nm: 0.0, to_nm: 60.0, segments: 3)", 0.0, task);
    let start = tips[0];
    let squares: Vec<f64> = tips[tips.len() / 21..]
        .iter()
        .map(|tip| 0.5 * ((tip.x - start.x).powi(2) + (tip.y - start.y).powi(2)))
        .collect();
    let blocks: Vec<f64> = squares
        .chunks_exact(squares.len() / 20)
        .map(|block| block.iter().sum::<f64>() / block.len() as f64)
        .collect();
    let (mean, error) = mean_and_error(&blocks);
    (mean, error, evaluations)
}

/// In water at 298 K the tip of a cantilever of 60 nm has the variance `kT (L^3/3B + L/S)`, plus
/// the correction of three segments. 300 us have about 2000 independent values: 3 %.
#[test]
#[ignore = "takes minutes"]
fn tips_fluctuate_alike_with_inertia_and_without() {
    let rest = "record_every_ns: 50.0";
    let with = format!(
        "Dynamics(duration_ns: 300000.0, drag: Water(), thermal: (temperature_k: 298.0, seed: 1), {rest})"
    );
    let without = |step: f64| {
        format!(
            "Brownian(duration_ms: 0.3, temperature_k: 298.0, seed: 2, time_step_ns: {step:?}, {rest})"
        )
    };
    // Compliance under a force from statics.
    let rod = "Rod(from_nm: 0.0, to_nm: 60.0, segments: 3)";
    let [bent, straight] = [0.1, 0.0].map(|force| tips(rod, force, "Equilibrium()").0);
    let theory = 1.380_649e-2 * 298.0 * (bent[0].x - straight[0].x) / 0.1;
    for task in [with, without(0.25), without(5.0)] {
        let (mean, error, evaluations) = variance(&task);
        println!(
            "{mean:.4} +- {error:.4} nm^2, theory {theory:.4}, {evaluations} evaluations: {task}"
        );
        assert!(
            (mean - theory).abs() < 3.0 * error + 0.01 * theory,
            "{task}"
        );
    }
}

#[test]
fn steps_in_water_depend_on_the_stiffness() {
    let planned = |rest: &str| {
        let assembly = build(&format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 60.0, segments: 3)], rod: RodModel(law: Constant)),
                task: Dynamics(duration_ns: 1.0{rest}),
            )"
        ));
        let plan = Plan::new(&assembly).unwrap();
        (
            plan.estimate().unwrap().time_step_ns,
            plan.relaxation_times().is_some(),
        )
    };
    let (verlet, is_relaxing) = planned(", integrator: PositionVerlet");
    let water = planned(", drag: Water()");
    assert!(!is_relaxing && water.1);
    assert!((water.0 / verlet - 1.0).abs() < 1e-12);
    planned(", drag: Water(), thermal: (temperature_k: 298.0, seed: 1)");
}

/// A bead turns with half of the vorticity and moves with the fluid at its centre, on the axis of a short filament and off
/// it. A filament alone turns into the flow and stays there.
#[test]
fn beads_follow_a_shear_flow_like_spheres() {
    let turned = |distance: f64| {
        let (assembly, trajectory, _) = ran(&format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0, segments: 2)], rod: (law: Constant),
                    direction: (0.0, 1.0, 0.0), at_nm: (0.0, 0.0, 100.0)),
                beads: [Bead(site: Site(at_nm: 15.0, radius_nm: {distance:?}), radius_nm: 250.0)],
                task: Brownian(duration_ms: 0.4, temperature_k: 0.0, time_step_ns: 1000.0, record_every_ns: 4e5,
                    flow: Shear(rate_per_s: 1000.0, along: (1.0, 0.0, 0.0), across: (0.0, 0.0, 1.0))),
            )"
        ));
        let friction = assembly.friction(&Fluid::default()).unwrap();
        let bead = friction.dashpots.last().unwrap();
        let [first, last] = [0, 1].map(|k| &trajectory.records[k].state);
        let frame = |state: &State| state.frames.orientation.get(bead.frame);
        let centre = |state: &State| {
            let points = bead.points.map(|(i, w)| state.points.position.get(i) * w);
            points[0] + points[1] + frame(state) * bead.arm
        };
        let turn = (frame(last) * frame(first).inverse()).scaled_axis();
        (turn, centre(first), centre(last) - centre(first))
    };
    for distance in [0.0, 200.0] {
        let (turn, from, moved) = turned(distance);
        // A strain of 0.4. On its arm the filament has 0.02 of the friction of rotation.
        let error = 1e-3 + 0.1 * (distance / 200.0) * 0.04;
        assert!((turn - Vector3::y() * 0.2).norm() < error, "{turn}");
        assert!(
            (moved.x - 0.4 * from.z).abs() < 5e-3 * from.z.abs(),
            "{from} {moved}"
        );
    }
}

/// A free filament with a trapped bead relaxes at the rate of the trap over the friction. Bodies
/// that move with the bead have the transverse friction of the filament in addition.
#[test]
fn trapped_beads_have_the_friction_of_spheres() {
    let (radius, stiffness) = (500.0, 0.05);
    let sphere = 6.0 * PI * 0.89 * radius;
    for (section, distance) in [("Rod", 0.0), ("Rod", 20.0), ("Ellipsoids", 20.0)] {
        let text = format!(
            "Scene(
                filament: Filament(sections: [{section}(from_nm: 0.0, to_nm: 60.0)], rod: (law: Constant)),
                beads: [Bead(site: Site(at_nm: 30.0, radius_nm: {distance:?}, azimuth_deg: 50.0), radius_nm: {radius:?})],
                linkers: [Linker(at_nm: 30.0, radius_nm: {distance:?}, azimuth_deg: 50.0,
                    displaced_nm: (0.0, 0.0, 0.0), stiffness_pn_per_nm: {stiffness:?})],
                task: Brownian(duration_ms: 1.0, temperature_k: 0.0),
            )"
        );
        let assembly = build(&text);
        let friction = assembly.friction(&Fluid::default()).unwrap();
        let dashpot = friction.dashpots.last().unwrap();
        let centre = assembly.linkers[0].site().position(&assembly.rest);
        let arm = assembly.rest.frames.orientation.get(dashpot.frame) * dashpot.arm;
        let weighted = dashpot
            .points
            .map(|(i, w)| assembly.rest.points.position.get(i) * w);
        assert!((weighted[0] + weighted[1] + arm - centre).norm() < 1e-12);
        assert!((dashpot.friction.x - sphere).abs() < 1e-9);
        // Times of 1e5 ns are not resolved with monomers, whose shortest time is 1e-4 ns.
        if section == "Ellipsoids" {
            continue;
        }
        let length = assembly.length_nm();
        let across = Cylinder::new(0.89, length, 3.5).unwrap().across() * length;
        let plan = Plan::new(&assembly).unwrap();
        let slowest = plan.relaxation_times().unwrap().unwrap().slowest_ns;
        let expected = (sphere + across) / stiffness;
        let error = slowest[0] / expected - 1.0;
        println!("{section} at {distance} nm: {error:e}");
        // The filament bends by the ratio of the stiffness of the trap to its own.
        assert!(error.abs() < 1e-5, "{section}: {error:e}");
    }
}

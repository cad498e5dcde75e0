//! A rod rolled up by turning its free end: pure bending with uniform curvature.

use super::common::{BEND, LENGTH, PRECISION, build, failure, rod_scene, run, run_anyway};
use crate::theory::{bisect, second_order_limit};
use actin_mechanics::Vector3;
use actin_sim::{Assembly, End, Failure, Outcome, RunError};
use std::f64::consts::PI;

fn rolled(segments: usize, twist: f64, turn: f64) -> (Assembly, Outcome) {
    let rest = format!(
        "path: [Stage(set: [Turn(end: End, turn_deg: (0.0, {turn:?}, 0.0))])],
         task: Equilibrium(leave_saddles: 0),"
    );
    let clamps = "Clamp(end: Start), Clamp(end: End, slides: Freely)";
    let mut assembly = build(&rod_scene(segments, (1e5, twist), clamps, &rest));
    let report = match run(&mut assembly) {
        Ok((_, report)) => report,
        Err(RunError::Failed(failed)) if matches!(failed.failure, Failure::Saddle(_)) => {
            failed.outcome
        }
        Err(error) => panic!("{error}"),
    };
    (assembly, report)
}

fn end_couple(assembly: &mut Assembly) -> Vector3 {
    let loads = assembly.system.loads().clone();
    let clamp = assembly.clamps.iter().find(|c| c.end == End::End).unwrap();
    clamp.reaction(assembly.system.state(), &loads).torque_pn_nm
}

/// All bending elements have the same angle, so that the couple `2 pi B / L` and the closure are
/// exact on any mesh.
#[test]
fn a_full_turn_closes_a_circle() {
    let (mut assembly, report) = rolled(20, 2.0 * BEND, 360.0);
    let couple = end_couple(&mut assembly);
    let exact = 2.0 * PI * BEND / LENGTH;
    let tip = assembly.tip_nm(assembly.system.state(), End::End);
    let certificate = report.equilibrium.unwrap().certificate;
    // Residual of 1e-7 pN nm and its displacement.
    assert!((couple - Vector3::y() * exact).norm() < 1e-6, "{couple}");
    assert!(tip.norm() < 1e-6, "{tip}");
    assert_eq!(certificate.negative, 0);
}

/// A rod with small twisting rigidity leaves the plane before it closes. With `c = B3 / B` the
/// critical turn is `2 x` with `tan x = -x (1 - c)/c`, the first conjugate point of the force-free
/// rod. It is 210.46 deg for `c = 1/3`.
#[test]
fn a_rod_that_twists_easily_leaves_the_plane() {
    let c: f64 = 1.0 / 3.0;
    let mut x: f64 = 1.8;
    for _ in 0..50 {
        x = PI + (-x * (1.0 - c) / c).atan();
    }
    let exact = (2.0 * x).to_degrees();
    let values = [10, 20, 40].map(|segments| {
        let is_unstable = |turn: f64| {
            let (_, report) = rolled(segments, c * BEND, turn);
            report.equilibrium.unwrap().certificate.negative > 0
        };
        bisect(is_unstable, [190.0, 230.0], PRECISION)
    });
    let limit = second_order_limit("roll-up loses stability", values, exact, 0.08);
    assert!(limit.abs() < 1e-5, "{limit:e}");
}

#[test]
fn a_couple_on_a_free_end_rolls_up_half_a_turn() {
    let couple = 2.0 * PI * BEND / LENGTH;
    let rest = format!(
        "loads: [Couple(end: End, couple_pn_nm: (0.0, {couple:?}, 0.0))],
         path: [Stage(set: [LoadFactor(load: 0, factor: 1.0)])], task: Equilibrium(),"
    );
    let mut assembly = build(&rod_scene(40, (1e5, BEND), "Clamp(end: Start)", &rest));
    let (_, outcome) = run_anyway(&mut assembly);
    let (failure, _) = failure(outcome);
    let message = failure.to_string();
    let Failure::PathEnded { failure, .. } = failure else {
        panic!("{message}");
    };
    assert!((failure.parameter - 0.5).abs() < 1.0 / 40.0, "{message}");
    for part in ["loses its stability: ", "at half a turn", "slides: Freely"] {
        assert!(message.contains(part), "{part:?} in {message}");
    }
}

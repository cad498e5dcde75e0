//! Certificates of motions at rest, saddles, and ways to leave them.

use crate::common::{build, failure, run, run_anyway};
use actin_sim::{End, Failure, Outcome, RunError, Status, Trajectory};

fn pushed(filament: &str, task: &str) -> String {
    format!(
        "Scene(
            filament: Filament(
                sections: [Rod(from_nm: 0.0, to_nm: 200.0, segments: 10)], rod: RodModel(law: Constant), {filament}
            ),
            clamps: [Clamp(end: Start), Clamp(end: End)],
            path: [Stage(set: [Shift(end: End, shift_nm: (0.0, 0.0, -60.0))], duration_ns: 5.0)],
            task: {task},
        )"
    )
}

fn damped(keys: &str) -> String {
    format!(
        "Dynamics(
            duration_ns: 400.0, record_every_ns: 1.0,
            drag: (translational_per_ns: 1.0, rotational_per_ns: 1.0), {keys}
        )"
    )
}

const STOP: &str = "stop: (force_pn: 1e-6, torque_pn_nm: 1e-6, kinetic_pn_nm: 1e-10),";

fn moved(text: &str) -> Result<(Trajectory, Outcome), RunError> {
    run(&mut build(text))
}

fn moved_anyway(text: &str) -> (Trajectory, Result<Outcome, RunError>) {
    run_anyway(&mut build(text))
}

fn energy(trajectory: &Trajectory) -> f64 {
    trajectory.records.last().unwrap().potential_pn_nm()
}

fn buckled() -> f64 {
    let (trajectory, report) = moved(&pushed("", "Equilibrium()")).unwrap();
    assert_eq!(report.certificate().unwrap().negative, 0);
    assert!(report.saddles_left > 0);
    energy(&trajectory)
}

/// Without imperfection the rod stays straight with the energy `S3 strain^2 L / 2` = 306000 pN nm,
/// a thousand times the energy of the buckled state.
#[test]
fn a_straight_rod_that_stays_straight_is_a_saddle() {
    for keys in ["", STOP] {
        let (trajectory, ended) = moved_anyway(&pushed("", &damped(keys)));
        let (Failure::Saddle(problem), report) = failure(ended) else {
            panic!("no saddle");
        };
        let straight = 0.5 * 3.4e4 * 0.3_f64.powi(2) * 200.0;
        assert!((energy(&trajectory) / straight - 1.0).abs() < 1e-9);
        assert!(report.status == Status::Failed && report.at_rest.unwrap().negative > 0);
        assert!(trajectory.records[0].at.value().abs() < 1e-12);
        assert_eq!(problem.key, "task.leave_saddles");
        assert!(problem.rule.contains("imperfection"), "{problem}");
        assert!(buckled() < 1e-2 * straight);
    }
}

/// An imperfection of 0.01 nm leads to the buckled equilibrium. The energy difference is second
/// order in the residual of the stop rule.
#[test]
fn an_imperfection_leads_to_the_buckled_state() {
    let imperfection = "imperfection: (amplitude_nm: 0.01, seed: 1),";
    let (trajectory, report) = moved(&pushed(imperfection, &damped(STOP))).unwrap();
    let error = energy(&trajectory) / buckled() - 1.0;
    assert!(error.abs() < 1e-8, "{error:e}");
    assert!(report.has_converged() && report.at_rest.unwrap().negative == 0);
    assert!(report.pushes.is_empty());
}

#[test]
fn a_motion_is_pushed_off_saddles() {
    for (stop, bound) in [(STOP, 1e-8), ("", 1e-6)] {
        let task = damped(&format!("leave_saddles: 3, {stop}"));
        let (trajectory, report) = moved(&pushed("", &task)).unwrap();
        let error = energy(&trajectory) / buckled() - 1.0;
        assert!(error.abs() < bound, "{error:e}");
        assert_eq!(report.at_rest.unwrap().negative, 0);
        assert_eq!(report.saddles_left, report.pushes.len());
        let push = report.pushes[0];
        // The path takes 5 ns and ends with the energy of the straight rod.
        assert!(push.time_ns >= 5.0 && push.negative_eigenvalues > 0);
        assert!((push.energy_pn_nm / 306_000.0 - 1.0).abs() < 1e-6);
        let size = (push.displacement_nm / 0.01).max(push.turn_rad / 1e-3);
        assert!((size - 1.0).abs() < 1e-12 && push.lowest_eigenvalue < 0.0);
    }
}

#[test]
fn certificates_belong_to_motions_at_rest() {
    let bent = |rod: &str, task: &str| {
        let text = format!(
            "Scene(
                filament: Filament(
                    sections: [Rod(from_nm: 0.0, to_nm: 40.0, segments: 4)],
                    rod: RodModel(law: Constant{rod}),
                ),
                clamps: [Clamp(end: Start)],
                loads: [EndForce(end: End, force_pn: (2.0, 0.0, -1.0))],
                task: Dynamics(duration_ns: {task}),
            )"
        );
        let (_, report) = moved(&text).unwrap();
        report.at_rest
    };
    let drag = "drag: (translational_per_ns: 3.0, rotational_per_ns: 3.0)";
    let at_rest = bent("", &format!("60.0, {drag}")).unwrap();
    assert_eq!((at_rest.negative, at_rest.unresolved), (0, 0));
    assert_eq!(bent("", "5.0"), None);
    assert_eq!(bent("", &format!("0.5, {drag}")), None);
    let bath = "thermal: (temperature_k: 1e-20, seed: 1)";
    assert_eq!(bent("", &format!("60.0, {drag}, {bath}")), None);
    let printed = ", force_law: PaperBalance";
    assert_eq!(bent(printed, &format!("60.0, {drag}")), None);
}

#[test]
fn a_free_filament_is_neutral() {
    let text = "Scene(
        filament: Filament(
            sections: [Rod(from_nm: 0.0, to_nm: 40.0, segments: 4)],
            imperfection: (amplitude_nm: 0.1, seed: 3),
            rod: RodModel(law: Constant),
        ),
        task: Dynamics(
            duration_ns: 60.0, drag: (translational_per_ns: 3.0, rotational_per_ns: 3.0),
        ),
    )";
    let (_, report) = moved(text).unwrap();
    let at_rest = report.at_rest.unwrap();
    assert_eq!((at_rest.negative, at_rest.unresolved), (0, 6));
    let pulled = text.replace(
        "task:",
        "loads: [EndForce(end: End, force_pn: (0.0, 0.0, 1.0))], task:",
    );
    assert_eq!(moved(&pulled).unwrap().1.at_rest, None);
}

/// Two and a half turns in a few ps do not spread over the segments and slip. An arc slips too. The
/// same rotation at low speed succeeds.
#[test]
fn twist_that_slips_is_an_error() {
    let straight = ("Rod(from_nm: 0.0, to_nm: 60.0, segments: 6)", "");
    let arc = (
        "Rod(from_nm: 0.0, to_nm: 100.0)",
        "shape: Arc(radius_nm: 100.0),",
    );
    for ((section, shape), slides, fast, slow, end) in [
        (straight, ", slides: AlongAxis", 0.02, 1.5, 2.0),
        (arc, "", 0.05, 5.0, 6.0),
    ] {
        let turned = |duration: f64| {
            moved_anyway(&format!(
                "Scene(
                    filament: Filament(sections: [{section}], {shape} rod: RodModel(law: Constant)),
                    clamps: [Clamp(end: Start), Clamp(end: End{slides})],
                    path: [Stage(set: [Turn(end: End, turn_deg: (0.0, 0.0, 900.0))], duration_ns: {duration:?})],
                    task: Dynamics(
                        duration_ns: {end:?}, record_every_ns: {:?},
                        drag: (translational_per_ns: 5.0, rotational_per_ns: 5.0),
                    ),
                )",
                0.1 * fast
            ))
        };
        let (trajectory, ended) = turned(fast);
        let (Failure::TwistLost { place, slip }, report) = failure(ended) else {
            panic!("no slip in {section} {shape}");
        };
        println!("{place}{slip}");
        assert!((slip.lost_turns().abs() - 1.0).abs() < 1e-12 && slip.joint_deg.abs() > 90.0);
        assert_eq!(report.status, Status::Failed);
        assert!(trajectory.records.last().unwrap().at.value() < slip.at.value());
        let (trajectory, ended) = turned(slow);
        ended.unwrap();
        assert!((trajectory.records.last().unwrap().at.value() - end).abs() < 1e-12);
    }
}

fn hinged(load: &str, path: &str, end: &str) -> String {
    format!(
        "Scene(
            filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 100.0)], rod: RodModel(law: Constant)),
            clamps: [
                Clamp(end: Start, hold: Pin, hinge: (bend_pn_nm_per_rad: 100.0, twist_pn_nm_per_rad: 20.0)),
                {end}
            ],
            loads: [{load}], path: [{path}],
            task: Dynamics(
                duration_ns: 20.0, record_every_ns: 10.0,
                drag: (translational_per_ns: 5.0, rotational_per_ns: 5.0),
            ),
        )"
    )
}

/// The spring carries at most `pi k` = 62.8 pN nm. A larger couple, or a frame that turns faster
/// than the rod, exceeds half a turn.
#[test]
fn a_hinge_past_half_a_turn_is_an_error() {
    let couple = |size: f64| format!("Couple(end: End, couple_pn_nm: (0.0, 0.0, {size:?}))");
    let turn = |degrees: f64, duration: f64| {
        let set = format!("set: [Turn(end: Start, turn_deg: (0.0, 0.0, {degrees:?}))]");
        format!("Stage({set}, duration_ns: {duration:?})")
    };
    for (load, path) in [
        (couple(40.0), String::new()),
        (String::new(), turn(180.0, 18.0)),
    ] {
        assert!(moved(&hinged(&load, &path, "")).is_ok(), "{load} {path}");
    }
    for (load, path) in [
        (couple(80.0), String::new()),
        (String::new(), turn(720.0, 0.1)),
    ] {
        for end in ["", "Clamp(end: End, hold: Pin, slides: AlongAxis),"] {
            let (_, ended) = moved_anyway(&hinged(&load, &path, end));
            let (Failure::HingeSlipped { place, slip }, report) = failure(ended) else {
                panic!("{load} {path} {end} does not slip");
            };
            println!("{place}{slip}");
            assert_eq!((slip.filament, slip.end), (0, End::Start));
            // Each step rotates by a few degrees at most.
            let [angle, twist] = slip.turned_deg;
            assert!((170.0..180.0).contains(&angle) && (twist.abs() - angle).abs() < 1e-6);
            assert_eq!(report.status, Status::Failed);
        }
    }
}

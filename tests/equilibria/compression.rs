//! Compressed rods with twist-stretch coupling have unstable twist beyond a critical force
//! (`docs/numerics.md`, "Extended rods in compression").

use super::common::{build, ran, run, run_anyway};
use actin_cosserat::{Rigidities, TwistStretch};
use actin_mechanics::testing::stiffness_matrix;
use actin_mechanics::{UnitQuaternion, Vector3};
use actin_sim::{Assembly, Failure, RunError, UnstableTwist};
use std::f64::consts::PI;

/// Laws and the critical compression (pN) of the untwisted rod, `B3(0) / |xi''(0)|`, from the
/// printed parameters by hand.
const LAWS: [(&str, f64); 2] = [
    // 566.01 / (2 x 20.508)
    ("PublishedExtension", 13.80),
    // 235.488 / (0.463366 / 6.02136e-3)
    ("Fitted", 3.060),
];

/// 100 nm between two walls, far below Euler's load, 154 pN.
fn rod(law: &str, segments: usize, rest: &str) -> String {
    format!(
        "Scene(
            filament: Filament(
                sections: [Rod(from_nm: 0.0, to_nm: 100.0, segments: {segments})],
                rod: RodModel(law: {law}),
            ),
            clamps: [Clamp(end: Start), Clamp(end: End)],
            {rest}
        )"
    )
}

fn set_uniform(assembly: &mut Assembly, twist: f64, strain: f64) {
    let (points, frames) = (assembly.points.clone(), assembly.frames.clone());
    let state = assembly.system.state_mut();
    for (i, point) in points.iter().enumerate() {
        let place = Vector3::z() * (point.s_nm * (1.0 + strain));
        state.points.position.set(i, place);
    }
    for (i, frame) in frames.iter().enumerate() {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), twist * frame.s_nm);
        state.frames.orientation.set(i, turn);
    }
}

fn push(assembly: &mut Assembly, twist: f64, compression: f64) {
    let (mut low, mut high) = (-0.1, 0.1);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        set_uniform(assembly, twist, middle);
        let loads = assembly.system.loads().clone();
        let reaction = assembly.clamps[0].reaction(assembly.system.state(), &loads);
        (low, high) = if reaction.force_pn.z > compression {
            (middle, high)
        } else {
            (low, middle)
        };
    }
}

/// Number of negative eigenvalues of the stiffness for axial shifts and rotations, which decouple
/// in a straight rod.
fn negative_modes(assembly: &Assembly) -> usize {
    let state = assembly.system.state();
    let points = (0..state.points.len()).filter(|&i| state.points.is_free(i));
    let frames = (0..state.frames.len()).filter(|&i| state.frames.is_free(i));
    let behind_points = 3 * state.points.len();
    let chosen: Vec<usize> = points
        .map(|i| 3 * i + 2)
        .chain(frames.map(|i| behind_points + 3 * i + 2))
        .collect();
    let matrix = stiffness_matrix(assembly.system.interactions()[0].as_ref(), state);
    let block = matrix.select_rows(&chosen).select_columns(&chosen);
    let rounding = 1e-14 * block.amax();
    let eigenvalues = block.symmetric_eigenvalues();
    assert!(eigenvalues.iter().all(|e| e.abs() > rounding));
    eigenvalues.iter().filter(|e| **e < 0.0).count()
}

/// Number of unstable modes `cos(m pi s / L)` of the twist of `n` segments at `share` times the
/// bound. A segment has the mean of its two nodes, `cos(m pi / 2n)` of their amplitude.
fn expected_modes(n: usize, share: f64) -> usize {
    let softens = |m: usize| (m as f64 * PI / (2 * n) as f64).cos().powi(2);
    (1..n).filter(|&m| softens(m) * share > 1.0).count()
}

fn only(found: &[UnstableTwist]) -> UnstableTwist {
    assert_eq!(found.len(), 1, "one entry per rod: {found:?}");
    found[0]
}

#[test]
fn modes_turn_unstable_at_the_bound() {
    for (law, at_rest) in LAWS {
        for (segments, twist) in [(10, 0.0), (20, 0.0), (40, 0.0), (20, 2e-3), (20, -2e-3)] {
            let mut assembly = build(&rod(law, segments, "task: Equilibrium(),"));
            push(&mut assembly, twist, 50.0 * at_rest);
            let found = only(&assembly.unstable_twist(assembly.system.state()));
            let bound = found.bound_pn.unwrap();
            if twist == 0.0 {
                assert!((bound / at_rest - 1.0).abs() < 1e-3, "{law}: {bound}");
            }
            let mut counts = Vec::new();
            for share in [0.5, 0.999, 1.07, 1.6, 3.3, 11.0] {
                push(&mut assembly, twist, share * bound);
                let expected = expected_modes(segments, share);
                assert_eq!(negative_modes(&assembly), expected, "{law}, {share}");
                counts.push(expected);
                let said = assembly.unstable_twist(assembly.system.state());
                if share < 1.0 {
                    assert_eq!(said, []);
                    continue;
                }
                let said = only(&said);
                assert!((said.compression_pn / (share * bound) - 1.0).abs() < 1e-9);
                assert!((said.bound_pn.unwrap() / bound - 1.0).abs() < 1e-9);
                assert!((said.twist_per_nm - twist).abs() < 1e-12);
            }
            println!("{law}, {segments} segments, twist {twist}: {bound:.3} pN, {counts:?}");
        }
    }
}

/// Beyond its data, `Homogenised` loses the stiffness of twist at large curvature, in tension too.
#[test]
fn bending_can_make_twist_unstable() {
    let bent = |force_pn: f64| {
        let (.., outcome) = ran(&format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 160.0)]),
                clamps: [Clamp(end: Start)],
                loads: [EndForce(end: End, force_pn: ({force_pn:?}, 0.0, 0.0))],
                task: Equilibrium(),
            )"
        ));
        outcome.unstable_twist
    };
    assert_eq!(bent(5.0), []);
    let found = only(&bent(10.0));
    assert_eq!(found.bound_pn, None);
    assert!(
        found.curvature_per_nm > 0.0175 && found.compression_pn < 0.0,
        "{found:?}"
    );
    let told = found.to_string();
    assert!(
        told.contains("UNSTABLE at s = ") && told.contains(": curvature 0.0"),
        "{told}"
    );
}

/// Number of unstable modes of the published law, including bending and shear: 0 at 13 pN, 2 at
/// 14.5, 12 at 40.
#[test]
fn certificates_count_unstable_modes() {
    for (compression, negative) in [(13.0, 0), (14.5, 2), (40.0, 12)] {
        let natural = TwistStretch::published().extension(0.0);
        let shift = 100.0 * (natural - compression / Rigidities::table4().shear.z);
        let rest = format!(
            "path: [Stage(set: [Shift(end: End, shift_nm: (0.0, 0.0, {shift:?}))])],
             task: Equilibrium(leave_saddles: 0),"
        );
        let mut assembly = build(&rod("PublishedExtension", 20, &rest));
        let (trajectory, outcome) = run_anyway(&mut assembly);
        let report = match outcome {
            Err(RunError::Failed(failed)) if matches!(failed.failure, Failure::Saddle(_)) => {
                failed.outcome
            }
            other => other.unwrap(),
        };
        let certificate = report.equilibrium.unwrap().certificate;
        assert_eq!(certificate.negative, negative, "{compression} pN");
        let states = trajectory.records.iter().map(|record| &record.state);
        let said = assembly.unstable_twist_over(states);
        if negative == 0 {
            assert_eq!(said, []);
            continue;
        }
        let said = only(&said);
        println!("{compression} pN: {said:?}");
        assert!((said.compression_pn / compression - 1.0).abs() < 1e-6);
        assert!(said.share_of_records > 0.0 && said.share_of_records < 1.0);
    }
}

#[test]
fn a_motion_reports_its_share_of_unstable_records() {
    for (law, _) in LAWS {
        let rest = "path: [
                Stage(set: [Shift(end: End, shift_nm: (0.0, 0.0, -0.2))], duration_ns: 0.2),
                Stage(set: [Shift(end: End, shift_nm: (0.0, 0.0, 0.1))], duration_ns: 0.2),
            ],
            task: Dynamics(duration_ns: 3.0, drag: (translational_per_ns: 5.0,
                rotational_per_ns: 5.0)),";
        let mut assembly = build(&rod(law, 10, rest));
        let (trajectory, _) = run(&mut assembly).unwrap();
        let states = || trajectory.records.iter().map(|record| &record.state);
        let said = only(&assembly.unstable_twist_over(states()));
        let unstable = states().filter(|state| !assembly.unstable_twist(state).is_empty());
        let share = unstable.count() as f64 / trajectory.records.len() as f64;
        println!("{law}: {said:?}");
        assert!((said.share_of_records - share).abs() < 1e-15);
        assert!(share > 0.01 && share < 0.5);
        assert!(assembly.unstable_twist(assembly.system.state()).is_empty());
    }
}

fn twists(assembly: &Assembly) -> Vec<f64> {
    let q = &assembly.system.state().frames.orientation;
    let frames = 1..assembly.frames.len();
    let twist = |i: usize| {
        let distance = assembly.frames[i].s_nm - assembly.frames[i - 1].s_nm;
        let turn = q.get(i - 1).inverse() * q.get(i);
        turn.scaled_axis().z / distance
    };
    frames.map(twist).collect()
}

/// The unstable rod divides into stable domains of over-twist and under-twist. Domain walls have
/// one or two elements on any mesh, since the law has no length scale.
#[test]
fn domain_walls_are_as_fine_as_the_mesh() {
    for segments in [10, 20, 40, 80] {
        let rest = "path: [Stage(set: [Shift(end: End, shift_nm: (0.0, 0.0, -0.168315))])],
             task: Equilibrium(leave_saddles: 30),";
        let mut assembly = build(&rod("PublishedExtension", segments, rest));
        let (_, report) = run(&mut assembly).unwrap();
        assert_eq!(report.equilibrium.unwrap().certificate.negative, 0);
        let twists = twists(&assembly);
        let changes = twists.windows(2).filter(|t| t[0] * t[1] < 0.0).count();
        let between = twists.iter().filter(|t| **t > -0.003 && **t < 0.002);
        let between = between.count();
        let loads = assembly.system.loads().clone();
        let start = &assembly.clamps[0];
        let force = start.reaction(assembly.system.state(), &loads).force_pn.z;
        let [low, high] = [f64::min, f64::max].map(|f| twists.iter().copied().fold(0.0, f));
        println!(
            "{segments} segments: {force:.2} pN, twist {low:.4} to {high:.4}, {changes} changes of side"
        );
        assert!(changes > 0 && between <= 2 * changes, "{twists:.4?}");
        assert!(low < -0.004 && high > 0.003);
        // The straight untwisted rod, at 40 pN, is 25 to 35 % above.
        assert!(force > 29.0 && force < 32.0);
    }
}

#[test]
fn other_laws_have_no_bound() {
    for law in ["Constant", "CouplingEnergy"] {
        let mut assembly = build(&rod(law, 10, "task: Equilibrium(),"));
        push(&mut assembly, 0.0, 1e3);
        assert_eq!(assembly.unstable_twist(assembly.system.state()), []);
    }
}

//! Resumed runs give the results of uninterrupted runs.

use super::common::{Choice, IN_TIME, advance, files};
use actin_rundir::RunDirectory;
use actin_sim::{LinkerEventKind, Outcome, Plan, Record, Scene, Solve, Status, Trajectory};
use proptest::prelude::*;

fn timeless(report: &Outcome) -> String {
    let report = Outcome {
        wall_s: 0.0,
        ..report.clone()
    };
    format!("{report:?}")
}

fn bits(record: &Record) -> Vec<u64> {
    let numbers = [
        record.at.value(),
        record.kinetic_pn_nm,
        record.residual_force_pn,
        record.residual_torque_pn_nm,
    ];
    let energies = record.energies_pn_nm.iter();
    numbers
        .iter()
        .chain(energies)
        .map(|v| v.to_bits())
        .collect()
}

fn assert_same(one: &Trajectory, other: &Trajectory) {
    assert_eq!(one.records.len(), other.records.len());
    for (i, (a, b)) in one.records.iter().zip(&other.records).enumerate() {
        assert_eq!(bits(a), bits(b), "record {i}");
        assert_eq!(a.state, b.state, "record {i}");
    }
}

fn compare(scene: &Scene, leave: &[u64]) {
    let folder = tempfile::tempdir().unwrap();
    let whole = RunDirectory::create(folder.path().join("whole"), false).unwrap();
    let pieces = RunDirectory::create(folder.path().join("pieces"), false).unwrap();
    let (assembly, expected, report) = advance(scene, &whole, false, u64::MAX);
    let plan = Plan::new(&assembly).unwrap();
    whole.write(&plan, &expected, &report).unwrap();
    whole.remove_checkpoint().unwrap();

    let (mut resumes, mut pending) = (false, leave.iter().copied());
    let (assembly, trajectory, resumed) = loop {
        let left = pending.next().unwrap_or(u64::MAX);
        let (assembly, trajectory, report) = advance(scene, &pieces, resumes, left);
        resumes = true;
        if report.status != Status::Interrupted {
            break (assembly, trajectory, report);
        }
    };
    assert_same(&expected, &trajectory);
    assert_eq!(timeless(&report), timeless(&resumed));
    // The final state is stored, so that results can be written again.
    let (_, again, once_more) = advance(scene, &pieces, true, u64::MAX);
    assert_same(&expected, &again);
    assert_eq!(timeless(&report), timeless(&once_more));
    let plan = Plan::new(&assembly).unwrap();
    pieces.write(&plan, &trajectory, &resumed).unwrap();
    pieces.remove_checkpoint().unwrap();
    assert!(
        files(whole.path()) == files(pieces.path()),
        "a file differs"
    );
}

/// Drag, stop rule, and seed of noise, which requires drag and excludes a stop rule.
fn surroundings() -> impl Strategy<Value = (f64, bool, Option<u64>)> {
    let drag = prop_oneof![Just(0.0), 0.1..5.0];
    prop_oneof![
        2 => (drag, any::<bool>(), Just(None)),
        1 => (0.1..5.0, Just(false), any::<u64>().prop_map(Some)),
    ]
}

fn choice() -> impl Strategy<Value = Choice> {
    (
        0_usize..5,
        0..=IN_TIME,
        0_usize..5,
        surroundings(),
        0.01..0.2,
        // At least as long as the longest path.
        0.26..0.6,
    )
        .prop_map(
            |(filament, held, integrator, surroundings, record_every_ns, duration_ns)| {
                let (drag, stops, noise) = surroundings;
                Choice {
                    filament,
                    held,
                    integrator,
                    drag,
                    stops,
                    noise,
                    record_every_ns,
                    duration_ns,
                }
            },
        )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 36, failure_persistence: None, ..Default::default() })]

    #[test]
    fn motions_resume_to_the_same_bits(
        choice in choice(),
        leave in proptest::collection::vec(1_u64..12, 1..4),
    ) {
        compare(&choice.motion(), &leave);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 18, failure_persistence: None, ..Default::default() })]

    #[test]
    fn paths_of_equilibria_resume_to_the_same_bits(
        choice in choice().prop_filter("statics has no time", |choice| choice.held != IN_TIME),
        leave in proptest::collection::vec(1_u64..60, 1..4),
    ) {
        compare(&choice.statics(), &leave);
    }
}

#[test]
fn a_motion_is_pushed_off_a_saddle_once_however_often_it_is_left() {
    let text = "Scene(
        filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 200.0, segments: 10)], rod: RodModel(law: Constant)),
        clamps: [Clamp(end: Start), Clamp(end: End)],
        path: [Stage(set: [Shift(end: End, shift_nm: (0.0, 0.0, -60.0))], duration_ns: 4.0)],
        task: Dynamics(
            duration_ns: 40.0, record_every_ns: 1.0, leave_saddles: 2,
            drag: (translational_per_ns: 5.0, rotational_per_ns: 5.0),
        ),
    )";
    let scene = Scene::from_ron(text).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let directory = RunDirectory::create(folder.path(), false).unwrap();
    let (_, trajectory, report) = advance(&scene, &directory, false, u64::MAX);
    let [push] = report.pushes[..] else {
        panic!("{:?}", report.pushes);
    };
    // Checks before and around the perturbation: at least one per record.
    let checks = trajectory
        .records
        .iter()
        .filter(|r| r.at.value() <= push.time_ns);
    let before = checks.count() as u64;
    compare(&scene, &[before / 2, 1, before]);
    compare(&scene, &[before, 1, 1]);
    compare(&scene, &[3 * before, 2, 1]);
}

#[test]
fn turns_of_a_couple_resume_to_the_same_bits() {
    for task in [
        "Dynamics(duration_ns: 1.6, record_every_ns: 0.1)",
        "Brownian(duration_ms: 1.6e-6, record_every_ns: 0.1, temperature_k: 0.0, time_step_ns: 0.01,
             drag: Water(viscosity_mpa_s: 0.001))",
    ] {
        let text = format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 60.0)], rod: RodModel(law: Constant)),
                clamps: [Clamp(end: Start, hold: Pin)],
                loads: [Couple(end: Start, couple_pn_nm: (0.0, 0.0, 200.0))],
                task: {task},
            )"
        );
        compare(&Scene::from_ron(&text).unwrap(), &[9, 3, 5]);
    }
}

/// Neighbour list and stiffness pattern are not in the checkpoint.
#[test]
fn contacts_resume_to_the_same_bits() {
    let scene = |path: &str, task: &str| {
        let text = format!(
            "Scene(
                filaments: [
                    Filament(sections: [Rod(from_nm: 0.0, to_nm: 60.0)]),
                    Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 14.0), Rod(from_nm: 14.0, to_nm: 54.0)],
                        at_nm: (8.0, -27.0, 30.0), direction: (0.0, 1.0, 0.0)),
                ],
                clamps: [Clamp(end: Start), Clamp(end: End), Clamp(filament: 1, end: Start)],
                linkers: [Linker(filament: 1, at_nm: 40.0, to: Site(at_nm: 50.0), stiffness_pn_per_nm: 0.5)],
                repulsion: Repulsion(planes: [Plane(at_nm: (-4.5, 0.0, 0.0), normal: (1.0, 0.0, 0.0))]),
                path: [{path}],
                task: {task},
            )"
        );
        Scene::from_ron(&text).unwrap()
    };
    let moved = "Stage(set: [Shift(filament: 1, end: Start, shift_nm: (-5.0, 3.0, 0.0))], duration_ns: 0.4)";
    let thermal = "Dynamics(duration_ns: 0.5, record_every_ns: 0.05, thermal: (temperature_k: 298.0, seed: 3),
        drag: (translational_per_ns: 1.0, rotational_per_ns: 1.0))";
    compare(&scene(moved, thermal), &[2, 3, 1]);
    compare(
        &scene(moved, "Equilibrium(force_pn: 1e-6, largest_step: 0.1)"),
        &[1, 3, 2],
    );
}

#[test]
fn linkers_resume_to_the_same_bits() {
    let scene = |task: &str| {
        let text = format!(
            "Scene(
                filaments: [
                    Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 14.0), Rod(from_nm: 14.0, to_nm: 44.0)]),
                    Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0)], at_nm: (9.0, 0.0, 0.0)),
                ],
                clamps: [Clamp(end: Start)],
                linkers: [
                    Linker(at_nm: 20.0, to: Site(filament: 1, at_nm: 22.0), stiffness_pn_per_nm: 20.0, rest_length_nm: 8.0,
                        kinetics: Kinetics(seed: 1, breaks: Breaking(rate_per_ns: 20.0, force_pn: 10.0),
                            forms: Forming(rate_per_ns: 30.0, reach_nm: 5.0))),
                    Linker(at_nm: 2.0, displaced_nm: (-5.0, 0.0, 0.0), stiffness_pn_per_nm: 2.0,
                        kinetics: Kinetics(seed: 4, steps: Stepping(step_nm: 2.7, rate_per_ns: 30.0, stall_pn: 50.0))),
                ],
                task: Dynamics(duration_ns: 0.3, record_every_ns: 0.03, {task}),
            )"
        );
        Scene::from_ron(&text).unwrap()
    };
    let thermal = "thermal: (temperature_k: 298.0, seed: 3),
        drag: (translational_per_ns: 1.0, rotational_per_ns: 1.0)";
    for task in ["", "integrator: Vefrl", thermal] {
        let scene = scene(task);
        let outcome = scene.solve().unwrap().outcome;
        assert!(outcome.events.len() > 5, "{:?}", outcome.events);
        compare(&scene, &[2, 3, 5]);
    }
}

#[test]
fn overdamped_motions_resume_to_the_same_bits() {
    for (filament, held, noise) in [
        (0, 0, Some(3)),
        (1, 1, None),
        (1, 3, Some(5)),
        (3, 2, Some(7)),
        (4, 0, Some(1)),
    ] {
        let choice = Choice {
            filament,
            held,
            integrator: 0,
            drag: 0.0,
            stops: false,
            noise,
            record_every_ns: 0.05,
            duration_ns: 0.3,
        };
        compare(&choice.brownian(), &[3, 2]);
        compare(&choice.in_water(), &[3, 2]);
    }
}

/// A motor pool and passive crosslinkers on filaments that repel each other, in water.
#[test]
fn crosslinkers_resume_to_the_same_bits() {
    let text = "Scene(
        arrangements: [Random(
            filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 300.0, segments: 3)], rod: (law: Constant)),
            count: 12, box_nm: (90.0, 90.0, 90.0), seed: 2,
        )],
        crosslinkers: [
            Crosslinkers(count: 30, stiffness_pn_per_nm: 0.2, rest_length_nm: 10.0, attach_per_ns: 2e-5,
                bind_per_ns: 4e-5, unbinds: Breaking(rate_per_ns: 5e-6, force_pn: 5.0), radius_nm: 3.5,
                site_spacing_nm: 5.5, tilt_pn_nm: 2.0, twist_pn_nm: 2.0, seed: 3),
            Crosslinkers(count: 20, stiffness_pn_per_nm: 0.2, attach_per_ns: 2e-5, bind_per_ns: 1e-5,
                unbinds: Breaking(rate_per_ns: 1e-6),
                steps: Stepping(step_nm: 5.5, rate_per_ns: 5e-6, stall_pn: 4.0), seed: 4),
        ],
        repulsion: Repulsion(),
        task: Brownian(duration_ms: 0.15, temperature_k: 298.0, seed: 7, time_step_ns: 2500.0,
            record_every_ns: 15000.0),
    )";
    let scene = Scene::from_ron(text).unwrap();
    let ran = scene.solve().unwrap();
    let (assembly, outcome) = (&ran.assembly, &ran.outcome);
    let count = |kind| outcome.events.iter().filter(|e| e.what == kind).count();
    for kind in [
        LinkerEventKind::Attached,
        LinkerEventKind::Detached,
        LinkerEventKind::Formed,
        LinkerEventKind::Broke,
        LinkerEventKind::Stepped,
    ] {
        assert!(count(kind) > 0, "{kind}");
    }
    // Events restore the sites of each record.
    for record in ran.records() {
        let mut state = record.state.clone();
        state.controls = assembly.rest.controls.clone();
        assembly.restore_controls(&mut state, record.at, &outcome.events);
        for i in 0..assembly.linkers.len() {
            let ends = assembly.linker_ends(i, &state);
            assert_eq!(ends, assembly.linker_ends(i, &record.state), "linker {i}");
        }
    }
    compare(&scene, &[2, 5]);
}

//! Search for other stable states: correctness and reproducibility.

use super::common::{build, solved};
use actin_rundir::RunDirectory;
use actin_sim::{Assembly, Equilibrium, Outcome, StableStates, Trajectory};

fn buckled(states: usize) -> String {
    format!(
        "Scene(
            filament: Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 80.0)],
                imperfection: Imperfection(amplitude_nm: 0.2, seed: 1)),
            clamps: [Clamp(end: Start), Clamp(end: End)],
            path: [Stage(set: [Shift(end: End, shift_nm: (0.0, 0.0, -8.0))])],
            task: Equilibrium(states: {states}, accept_jumps: true),
        )"
    )
}

fn found(outcome: &Outcome) -> &StableStates {
    outcome
        .equilibrium
        .as_ref()
        .unwrap()
        .states
        .as_ref()
        .unwrap()
}

#[test]
fn stable_states_are_stable() {
    let (assembly, outcome) = solved(&buckled(12));
    let all = found(&outcome);
    let interactions = assembly.system.interactions();
    let energy = |state| interactions.iter().map(|i| i.energy(state)).sum::<f64>();
    let result = energy(assembly.system.state());
    let plain = solved(&buckled(0)).0;
    assert_eq!(plain.system.state(), assembly.system.state());
    let above: Vec<_> = all.states.iter().map(|s| s.above_result_pn_nm).collect();
    println!("{above:.3?}");
    let starts: usize = all.states.iter().map(|s| s.starts).sum();
    assert_eq!(starts + all.lost, 12);
    assert!(all.states.len() > 1, "monomers must have several states");
    assert!(
        all.states
            .is_sorted_by(|a, b| a.above_result_pn_nm <= b.above_result_pn_nm)
    );
    assert_eq!(all.states.iter().filter(|s| s.is_result).count(), 1);
    let mut newton = actin_sim::solver(&assembly, &Equilibrium::default()).unwrap();
    for one in &all.states {
        let state = &one.record.state;
        let above = energy(state) - result;
        assert!(
            (above - one.above_result_pn_nm).abs() < 1e-9 * result.abs(),
            "{above}"
        );
        let certificate = newton.certify(state, interactions).unwrap();
        assert_eq!((certificate.negative, certificate.unresolved), (0, 0));
        assert!(one.record.residual_force_pn <= 1e-7 && one.record.residual_torque_pn_nm <= 1e-7);
        assert_eq!(one.is_result, above.abs() < 1e-9 * result);
    }
    assert_eq!(found(&solved(&buckled(12)).1), all);
}

#[test]
fn a_run_directory_holds_other_states() {
    let assembly: Assembly = build(&buckled(3));
    let plan = actin_sim::Plan::new(&assembly).unwrap();
    let mut trajectory = Trajectory::default();
    let outcome = plan.run_into(&mut trajectory).unwrap();
    let folder = std::env::temp_dir().join(format!("other-states-{}", std::process::id()));
    let directory = RunDirectory::create(&folder, false).unwrap();
    directory.write_scene(plan.scene()).unwrap();
    let summary = directory.write(&plan, &trajectory, &outcome).unwrap();
    let states = summary.states.unwrap();
    let lowest = states.found.first().unwrap();
    assert_eq!(states.found.len(), found(&outcome).states.len());
    assert!(lowest.above_result_pn_nm <= 0.0 && lowest.filaments.len() == 1);
    assert!(folder.join("other_states.npz").metadata().unwrap().len() > 10_000);
    std::fs::remove_dir_all(&folder).unwrap();
}

/// A rod with unequal bending rigidities buckles to both sides at equal energy. States connected by
/// zero-stiffness modes count as one.
#[test]
fn states_along_neutral_modes_count_once() {
    let count = |ends: &str, law: &str| {
        let text = format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 100.0{law})], rod: RodModel(law: Constant)),
                {ends}
                task: Equilibrium(states: 12),
            )"
        );
        let (_, outcome) = solved(&text);
        let all = &found(&outcome).states;
        println!(
            "{:?}",
            all.iter().map(|s| s.above_result_pn_nm).collect::<Vec<_>>()
        );
        let lowest = all[0].above_result_pn_nm;
        all.iter()
            .filter(|s| s.above_result_pn_nm < lowest + 1e-3)
            .count()
    };
    let pushed = "clamps: [Clamp(end: Start), Clamp(end: End)],
        path: [Stage(set: [Shift(end: End, shift_nm: (0.0, 0.0, -12.0))])],";
    let flat = ", altered: AlteredRod(material: Rigidities(shear_pn: (1.0e5, 1.0e5, 1.0e5),
        bend_pn_nm2: (3.0e4, 6.0e4, 3.0e4)))";
    assert_eq!(
        (count("", ""), count(pushed, ""), count(pushed, flat)),
        (1, 1, 2)
    );
}

//! Paths that end on a saddle or lose twist fail.

use super::common::{build, cantilever, failure, newton, run, run_anyway};
use actin_sim::{End, Failure, Scene, Status};

#[test]
fn an_imperfection_chooses_the_side() {
    let tip = |seed: u64| {
        let imperfection = format!("imperfection: (amplitude_nm: 0.1, seed: {seed}), rod:");
        let text = cantilever(8, [0.0, 0.0, -6.0], "task: Equilibrium(leave_saddles: 0)");
        let mut assembly = build(&text.replace("rod:", &imperfection));
        let (_, report) = run(&mut assembly).unwrap();
        assert_eq!(report.saddles_left, 0);
        let tip = assembly.tip_nm(assembly.system.state(), End::End);
        tip.y.atan2(tip.x)
    };
    let sides = [1, 2, 3].map(tip);
    println!("{sides:?}");
    let apart = |a: f64, b: f64| (a - b).sin().hypot(1.0 - (a - b).cos()) > 0.1;
    assert!(apart(sides[0], sides[1]) && apart(sides[1], sides[2]));
}

fn turned(sections: &str, degrees: f64, task: &str) -> String {
    format!(
        "Scene(
            filament: Filament(sections: [{sections}], rod: RodModel(law: Constant)),
            clamps: [Clamp(end: Start), Clamp(end: End, slides: AlongAxis)],
            path: [Stage(set: [Turn(end: End, turn_deg: (0.0, 0.0, {degrees:?}))])],
            task: Equilibrium({task}),
        )"
    )
}

#[test]
fn lost_twist_of_mixed_filaments_is_an_error() {
    let mixed =
        "Rod(from_nm: 0.0, to_nm: 40.0, segments: 4), Ellipsoids(from_nm: 40.0, to_nm: 60.0)";
    let mut assembly = build(&turned(mixed, 1500.0, "accept_jumps: true"));
    let (trajectory, ended) = run_anyway(&mut assembly);
    let (Failure::TwistLost { place, slip }, report) = failure(ended) else {
        panic!("nothing slipped");
    };
    let told = format!("{place}{slip}");
    let parts = [
        "in stage 1 of 1",
        "filament 0 has lost 1 turn(s)",
        "the joint at s = ",
    ];
    assert!(parts.iter().all(|part| told.contains(part)), "{told}");
    assert!(slip.lost_turns().abs() >= 1.0 && report.status == Status::Failed);
    let last = trajectory.records.last().unwrap();
    assert!(last.at.value() < slip.at.value() && slip.at.value() <= 1.0);
    assert_eq!(report.equilibrium.unwrap().points, trajectory.records.len());
}

#[test]
fn a_start_that_is_twisted_has_lost_nothing() {
    let text = turned("Rod(from_nm: 0.0, to_nm: 75.0, segments: 8)", 700.0, "");
    let mut assembly = build(&text);
    let (trajectory, _) = run(&mut assembly).unwrap();
    let mut scene = Scene::from_ron(&text).unwrap();
    scene.path.clear();
    let mut again = actin_sim::Assembly::build(&scene).unwrap();
    *again.system.state_mut() = trajectory.records.last().unwrap().state.clone();
    assert!(run(&mut again).is_ok());
}

/// A column of 200 nm under `Homogenised`, compressed beyond its critical load along a path. Half of
/// the modes of the straight state are unstable, and the loads have no component along them.
#[test]
fn a_path_in_compression_leaves_the_axis_only_if_permitted() {
    let follow = |task: &str| {
        let text = format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0, to_nm: 200, segments: 20)]),
                clamps: [Clamp(end: Start), Clamp(end: End)],
                path: [Stage(set: [Shift(end: End, shift_nm: (0, 0, -20))])],
                task: Equilibrium({task}),
            )"
        );
        let mut assembly = build(&text);
        let (trajectory, ended) = run_anyway(&mut assembly);
        let off_axis = |state: &actin_sim::mechanics::State| {
            let positions = state.points.position.iter();
            positions.map(|x| x.x.hypot(x.y)).fold(0.0, f64::max)
        };
        let records = trajectory.records.iter();
        (
            records.map(|r| off_axis(&r.state)).fold(0.0, f64::max),
            ended,
        )
    };
    let (off_axis, ended) = follow("leave_saddles: 0");
    let (Failure::Saddle(problem), report) = failure(ended) else {
        panic!("no saddle");
    };
    assert_eq!((off_axis, report.saddles_left), (0.0, 0));
    println!("{}", problem.rule);

    let (off_axis, ended) = follow("");
    let report = ended.unwrap();
    println!("{off_axis} nm off the axis");
    assert!(off_axis > 30.0 && report.saddles_left > 0);
    assert_eq!(report.certificate().unwrap().negative, 0);
}

fn straight_column(section: &str, law: &str, force: f64) -> String {
    format!(
        "Scene(
            filament: Filament(sections: [{section}], rod: RodModel(law: {law})),
            clamps: [Clamp(end: Start), Clamp(end: End, slides: AlongAxis)],
            loads: [EndForce(end: End, force_pn: (0, 0, -{force:?}))],
            task: Equilibrium(),
        )"
    )
}

const COLUMN: &str = "Rod(from_nm: 0, to_nm: 1000, segments: 20)";

/// The observer receives each step once, displacements or not. Without attempts a column stays
/// straight.
#[test]
fn slow_descents_are_displaced_if_saddles_may_be_left() {
    for attempts in [0, 3] {
        let assembly = build(&straight_column(COLUMN, "Homogenised", 5.0));
        let mut state = assembly.system.state().clone();
        let mut newton = newton(&assembly, 1e-7);
        let mut observed = Vec::new();
        let interactions = assembly.system.interactions();
        let found = newton.minimize_observed(&mut state, interactions, attempts, &mut |step| {
            observed.push(*step);
            std::ops::ControlFlow::Continue(())
        });
        let positions = state.points.position.iter();
        let off_axis = positions.map(|x| x.x.hypot(x.y)).fold(0.0, f64::max);
        let (history, left) = match found {
            Ok(found) => (found.history, found.saddles_left),
            Err(failure) => (failure.history, 0),
        };
        println!(
            "{attempts} attempts: {} steps, {left}, {off_axis} nm",
            history.len()
        );
        assert_eq!(observed, history);
        assert_eq!(left > 0, attempts > 0);
        assert_eq!(off_axis > 100.0, attempts > 0);
    }
}

/// Columns of 1000 nm between walls, of which one slides, from their straight state. Under
/// `Homogenised` half of the modes of that state are unstable, and the loads have no component along
/// them.
#[test]
fn straight_columns_buckle_under_every_law() {
    let solve = |section: &str, law: &str, force: f64| {
        let mut assembly = build(&straight_column(section, law, force));
        let (_, report) = run(&mut assembly).unwrap();
        assert_eq!(report.certificate().unwrap().negative, 0, "{law}");
        let steps = report.equilibrium.unwrap().newton_iterations;
        let left = report.saddles_left;
        println!("{law}, {force} pN: {steps} steps, {left} displacements");
        let tip = assembly.tip_nm(assembly.system.state(), End::End).z - 1000.0;
        (tip, assembly.system.potential_energy())
    };
    let rod = COLUMN;
    for law in ["Constant", "Fitted", "Homogenised"] {
        for force in [1.7, 2.0, 5.0] {
            let (tip, energy) = solve(rod, law, force);
            println!("{law}, {force} pN: tip {tip} nm, energy {energy} pN nm");
            assert!(tip < -100.0 && energy < -10.0);
        }
    }
    let (_, monomers) = solve("Ellipsoids(from_nm: 0, to_nm: 1000)", "Constant", 1.7);
    let (_, homogenised) = solve(rod, "Homogenised", 1.7);
    println!("energy of monomers {monomers}, of the rod {homogenised} pN nm");
    assert!((homogenised / monomers - 1.0).abs() < 0.02);
}

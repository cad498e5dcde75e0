//! Ends that are pinned, hinged by a spring, and moved at constant velocity.

use super::common::{BEND, LENGTH, SHEAR, TWIST, build, cantilever, run};
use crate::theory::{bisect, second_order_limit};
use actin_mechanics::{Loads, State, Vector3, rotation};
use actin_sim::{Assembly, End, Failure, Plan, RunError};

/// The compliance of the hinge adds to the compliance of the rod; the reaction is the spring's
/// torque.
#[test]
fn compliances_of_hinge_and_rod_add() {
    let (force, couple, bend, twist) = (1e-3, 30.0, 400.0, 120.0);
    let hinge = format!(
        "clamps: [Clamp(end: Start, hold: Pin,
            hinge: (bend_pn_nm_per_rad: {bend:?}, twist_pn_nm_per_rad: {twist:?}))]"
    );
    let on_hinge = |segments: usize, loads: &str| {
        let text = cantilever(segments, SHEAR, loads, "task: Equilibrium(),");
        run(&text.replace("clamps: [Clamp(end: Start)]", &hinge)).0
    };
    let load = format!("Force(end: End, force_pn: ({force:?}, 0.0, 0.0))");
    let values = [8, 16, 32].map(|segments| {
        let assembly = on_hinge(segments, &load);
        assembly.tip_nm(assembly.system.state(), End::End).x
    });
    let exact = force * LENGTH.powi(3) / (3.0 * BEND) + force * LENGTH.powi(2) / bend;
    let limit = second_order_limit("cantilever on a hinge", values, exact, 0.1);
    assert!(limit.abs() < 1e-5, "{limit:e}");
    let load = format!("Couple(end: End, couple_pn_nm: (0.0, 0.0, {couple:?}))");
    let mut assembly = on_hinge(16, &load);
    let last = assembly
        .frames
        .iter()
        .position(|f| (f.s_nm - 155.0).abs() < 1e-9);
    let turn = rotation::log(
        assembly
            .system
            .state()
            .frames
            .orientation
            .get(last.unwrap()),
    );
    let exact = couple * (155.0 / TWIST + 1.0 / twist);
    assert!(
        (turn - Vector3::z() * exact).norm() < 1e-8,
        "{turn} {exact}"
    );
    let loads = assembly.system.loads().clone();
    let reaction = assembly.clamps[0].reaction(assembly.system.state(), &loads);
    assert!((reaction.torque_pn_nm + Vector3::z() * couple).norm() < 1e-6);
}

/// A chain with small bending rigidity, pinned at a span `D` of 0.75 of its length `L`, is a catenary.
/// With `x = D / 2a` from `sinh(x) = x L / D`, the sag is `a (cosh(x) - 1)`.
#[test]
fn a_pinned_chain_hangs_as_a_catenary() {
    let (length, span, weight) = (400.0_f64, 300.0_f64, 0.1);
    let x = bisect(|x| x.sinh() / x > length / span, [0.1, 5.0], 1e-14);
    let a = span / (2.0 * x);
    let exact = a * (x.cosh() - 1.0);
    let sags = [20, 40, 80].map(|segments| {
        let text = format!(
            "Scene(
                filament: Filament(
                    sections: [Rod(from_nm: 0.0, to_nm: {length:?}, segments: {segments})],
                    rod: RodModel(law: Constant, material: Rigidities(
                        shear_pn: (1e5, 1e5, 1e5), bend_pn_nm2: (0.1, 0.1, 10.0),
                    )),
                ),
                clamps: [Clamp(end: Start, hold: Pin), Clamp(end: End, hold: Pin)],
                loads: [ForcePerLength(force_pn_per_nm: (-{weight:?}, 0.0, 0.0))],
                path: [Stage(set: [
                    LoadFactor(load: 0, factor: 1.0),
                    Shift(end: End, shift_nm: (0.0, 0.0, {:?})),
                ])],
                task: Equilibrium(accept_jumps: true),
            )",
            span - length
        );
        let (assembly, _) = run(&text);
        let x = |i: usize| assembly.system.state().points.position.get(i).x;
        -(0..=segments).map(x).fold(0.0, f64::min)
    });
    // Stretch of 2e-4 at most and bending, B / w a^3 = 1e-6.
    let errors = sags.map(|sag| sag / exact - 1.0);
    assert!(errors[2].abs() < 1e-3, "{errors:?}");
    assert!(errors[2].abs() < errors[0].abs(), "{errors:?}");
}

#[test]
fn a_steady_stage_moves_at_constant_velocity() {
    let text = "Scene(
        filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 100.0)], rod: RodModel(law: Constant)),
        clamps: [Clamp(end: Start), Clamp(end: End)],
        path: [Stage(set: [Shift(end: End, shift_nm: (0.4, 0.0, -2.0))], duration_ns: 4.0, pace: Steady)],
        task: Dynamics(duration_ns: 5.0, record_every_ns: 0.25,
            drag: (translational_per_ns: 5.0, rotational_per_ns: 5.0)),
    )";
    let (assembly, trajectory) = run(text);
    let end = assembly.clamps[1].points[0];
    for record in &trajectory.records {
        let t = record.at.value();
        let share = (t / 4.0).min(1.0);
        let place = Vector3::new(0.4 * share, 0.0, 100.0 - 2.0 * share);
        let off = (record.state.points.position.get(end) - place).norm();
        // Time is a sum of a few hundred steps.
        assert!(off < 1e-11, "{t}: {off:e}");
        let velocity = Vector3::new(0.1, 0.0, -0.5);
        let expected = if t < 3.9 { velocity } else { Vector3::zeros() };
        let off = (record.state.points.velocity.get(end) - expected).norm();
        assert!(off < 1e-14 || (t - 4.0).abs() < 0.1, "{t}: {off:e}");
    }
}

/// A path that turns a hinge past half a turn loses a turn. The rod takes `k / (k + C / L)` = 0.596
/// of the turn, and the hinge reaches 180 deg at 446 deg.
#[test]
fn a_hinge_past_half_a_turn_is_a_lost_turn() {
    let lost = |turn: f64| {
        let text = format!(
            "Scene(
                filament: Filament(
                    sections: [Rod(from_nm: 0.0, to_nm: {LENGTH:?}, segments: 16)],
                    rod: RodModel(law: Constant, material: Rigidities(
                        shear_pn: (1e3, 1e3, 1e4), bend_pn_nm2: ({BEND:?}, {BEND:?}, {TWIST:?}),
                    )),
                ),
                clamps: [
                    Clamp(end: Start),
                    Clamp(end: End, hold: Pin,
                        hinge: (bend_pn_nm_per_rad: 4e3, twist_pn_nm_per_rad: 120.0)),
                ],
                loads: [Force(end: End, force_pn: (0.0, 0.0, 40.0))],
                path: [Stage(set: [Turn(end: End, turn_deg: (0.0, 0.0, {turn:?}))])],
                task: Equilibrium(accept_jumps: true),
            )"
        );
        let text = text.replace("hold: Pin,", "hold: Pin, slides: AlongAxis,");
        let assembly = build(&text);
        match Plan::new(&assembly).map(|plan| plan.run()).unwrap() {
            Ok(_) => 0.0,
            Err(RunError::Failed(failed)) => match failed.failure {
                Failure::TwistLost { slip, .. } => slip.lost_turns(),
                other => panic!("{other}"),
            },
            Err(refused) => panic!("{refused}"),
        }
    };
    for (turn, turns) in [(300.0, 0.0), (-430.0, 0.0), (500.0, 1.0), (-600.0, -1.0)] {
        let found = lost(turn);
        assert!((found - turns).abs() < 0.5, "{turn}: {found}");
    }
}

#[test]
fn a_hinge_bent_past_half_a_turn_is_reported() {
    let turned = |degrees: f64| {
        let assembly = build(&format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 100.0)], rod: RodModel(law: Constant)),
                clamps: [Clamp(end: Start, hold: Pin,
                    hinge: (bend_pn_nm_per_rad: 100.0, twist_pn_nm_per_rad: 20.0))],
                linkers: [Linker(at_nm: 100.0, displaced_nm: (0.0, 0.0, 0.0), stiffness_pn_per_nm: 10.0)],
                path: [Stage(set: [Turn(end: Start, turn_deg: ({degrees:?}, 0.0, 0.0))])],
                task: Equilibrium(accept_jumps: true),
            )"
        ));
        Plan::new(&assembly).map(|plan| plan.run()).unwrap()
    };
    assert!(turned(150.0).is_ok());
    let Err(RunError::Failed(failed)) = turned(360.0) else {
        panic!("the slip of the hinge was not detected");
    };
    let Failure::HingeSlipped { place, slip } = failed.failure else {
        panic!("{}", failed.failure);
    };
    println!("{place}{slip}");
    // Bent without twist; equilibria are a few degrees apart.
    let [angle, twist] = slip.turned_deg;
    assert!(angle > 150.0 && angle < 180.0 && twist.abs() < 1.0);
}

fn sliding(sections: &str, slides: &str) -> (Assembly, State, Loads) {
    let (assembly, trajectory) = run(&format!(
        "Scene(
            filament: Filament(sections: [{sections}], shape: Arc(radius_nm: 60.0), rod: RodModel(law: Constant)),
            clamps: [Clamp(end: Start), Clamp(end: End, slides: {slides})],
            loads: [Force(at_nm: 40.0, force_pn: (20.0, 30.0, 10.0))],
            task: Dynamics(duration_ns: 0.2, drag: (translational_per_ns: 5.0, rotational_per_ns: 5.0)),
        )"
    ));
    let state = trajectory.records[50].state.clone();
    let mut loads = Loads::zeros(&state);
    for interaction in assembly.system.interactions() {
        interaction.add_loads(&state, &mut loads);
    }
    (assembly, state, loads)
}

#[test]
fn reactions_vanish_along_sliding_directions() {
    for slides in ["Freely", "AlongAxis"] {
        let (assembly, state, loads) = sliding("Rod(from_nm: 0.0, to_nm: 100.0)", slides);
        let clamp = assembly.clamp_at(0, End::End).unwrap();
        let felt: Vector3 = clamp.points.iter().map(|&i| loads.force.get(i)).sum();
        let tangent = assembly.filaments[0].frame_at(100.0) * Vector3::z();
        let free = match slides {
            "Freely" => felt,
            _ => tangent * tangent.dot(&felt),
        };
        assert!(free.norm() > 1e-3, "{slides}: {}", free.norm());
        let left = clamp.reaction(&state, &loads).force_pn + felt - free;
        assert!(left.norm() < 1e-12 * felt.norm(), "{slides}");
    }
}

/// The torque of two freely sliding monomers refers to their centre, where the accelerating loads
/// have no moment.
#[test]
fn freely_sliding_ends_have_no_moment_of_acceleration() {
    let (assembly, state, loads) = sliding("Ellipsoids(from_nm: 0.0, to_nm: 60.0)", "Freely");
    let clamp = assembly.clamp_at(0, End::End).unwrap();
    let place = |i: usize| state.points.position.get(i);
    let sum: Vector3 = clamp.points.iter().map(|&i| place(i)).sum();
    let centre = sum / clamp.points.len() as f64;
    let points = clamp.points.iter();
    let moments = points.map(|&i| (place(i) - centre).cross(&loads.force.get(i)));
    let turned = |i: usize| state.frames.orientation.get(i) * loads.torque.get(i);
    let couples = clamp.frames.iter().map(|&i| turned(i));
    let torque: Vector3 = moments.chain(couples).sum();
    let reaction = clamp.reaction(&state, &loads);
    let off = (reaction.torque_pn_nm + torque).norm();
    assert!(off < 1e-9 * torque.norm(), "{off:e}");
    assert_eq!(reaction.force_pn, Vector3::zeros());
}

//! Loads that make no sense, and what is said of them: key, value and rule.

use actin_sim::Scene;

/// The message with which a scene of a rod of 100 nm on a wall is refused.
fn refusal(load: &str, task: &str) -> String {
    let text = format!(
        "Scene(
            filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 100.0)], rod: RodModel(law: Constant)),
            clamps: [Clamp(end: Start)],
            loads: [{load}],
            task: {task},
        )"
    );
    Scene::from_ron(&text).map_or_else(|error| error.message, |_| String::new())
}

const STATICS: &str = "Equilibrium()";
const MOTION: &str = "Dynamics(duration_ns: 1.0)";

/// Each load is refused with a message that begins so.
fn assert_refused(cases: &[(String, &str)]) {
    for (load, expected) in cases {
        let message = refusal(load, MOTION);
        assert!(message.starts_with(expected), "{load}: {message}");
    }
}

#[test]
fn places_without_a_meaning_are_refused() {
    let f = "force_pn: (1.0, 0.0, 0.0)";
    assert_refused(&[
        (
            format!("Force({f})"),
            "loads[0]: nothing says where it acts: write end or at_nm",
        ),
        (
            format!("Force(end: End, at_nm: 3.0, {f})"),
            "loads[0].at_nm = 3.0: end says where it acts already: write one of the two",
        ),
        (
            format!("Force(at_nm: 100.5, {f})"),
            "loads[0].at_nm = 100.5: must lie on the filament, from 0 to 100.0",
        ),
        (
            format!("Force(end: Start, {f})"),
            "loads[0].end = Start: this end is clamped: a force on it moves nothing",
        ),
        (
            "Couple(end: Start, couple_pn_nm: (1.0, 0.0, 0.0))".to_owned(),
            "loads[0].end = Start: this end is clamped: a couple on it turns nothing",
        ),
        (
            "Couple(end: End, couple_pn_nm: (inf, 0.0, 0.0))".to_owned(),
            "loads[0].couple_pn_nm = [inf, 0.0, 0.0]: must be finite",
        ),
    ]);
}

#[test]
fn intervals_and_factors_without_a_meaning_are_refused() {
    let f = "force_pn: (1.0, 0.0, 0.0)";
    let q = "force_pn_per_nm: (1.0, 0.0, 0.0)";
    assert_refused(&[
        (
            format!("ForcePerLength(from_nm: -1.0, {q})"),
            "loads[0].from_nm = -1.0: must be at least 0 and below the filament's length, 100.0",
        ),
        (
            format!("ForcePerLength(from_nm: 50.0, to_nm: 40.0, {q})"),
            "loads[0].to_nm = 40.0: must be greater than from_nm = 50.0, and at most the filament's",
        ),
        (
            format!("Force(end: End, {f}, factor: Sine(period_ns: 0.0))"),
            "loads[0].factor.period_ns = 0.0: must be finite and greater than 0",
        ),
        (
            format!("Force(end: End, {f}, factor: Table(time_ns: [0.0, 0.0], factor: [0.0, 1.0]))"),
            "loads[0].factor.time_ns[1] = 0.0: times ascend",
        ),
        (
            format!("Force(end: End, {f}, factor: Table(time_ns: [0.0], factor: [0.0, 1.0]))"),
            "loads[0].factor.factor = 2 values: must be as many as times: 1",
        ),
    ]);
}

/// What has no potential, or changes in time, is no load of an equilibrium; a sine never lets a motion
/// come to rest.
#[test]
fn tasks_refuse_what_they_cannot_do() {
    let follower = "Force(end: End, force_pn: (0.0, 0.0, -1.0), follows: true)";
    let sine = "Force(end: End, force_pn: (1.0, 0.0, 0.0), factor: Sine(period_ns: 1.0))";
    for (load, task, expected) in [
        (
            follower,
            STATICS,
            "loads[0].follows = true: a load that turns with the filament has no",
        ),
        (sine, STATICS, "loads[0].factor: Equilibrium knows no time"),
        (
            sine,
            "Dynamics(duration_ns: 1.0, stop: (force_pn: 1e-3, torque_pn_nm: 1e-3, kinetic_pn_nm: 1e-3))",
            "task.stop: loads[0] has a Sine for a factor, under which nothing comes to rest",
        ),
        (
            follower,
            "Dynamics(duration_ns: 1.0, leave_saddles: 1)",
            "task.leave_saddles = 1: saddles are those of an energy, which loads that turn",
        ),
        (
            "Couple(end: End, couple_pn_nm: (0.0, 0.0, 1e-7))",
            STATICS,
            "task.torque_pn_nm = 1e-7: must be below half of loads[0] (1e-7 pN nm)",
        ),
        (
            "ForcePerLength(force_pn_per_nm: (0.0, 1e-8, 0.0))",
            STATICS,
            "task.force_pn = 1e-7: must be below what loads[0] puts on a nanometre (1",
        ),
    ] {
        let message = refusal(load, task);
        assert!(message.starts_with(expected), "{load}: {message}");
        assert_eq!(refusal(load, MOTION), "", "{load}");
    }
}

/// Nothing keeps a free rod from spinning under one couple, nor from falling under its weight.
#[test]
fn couples_that_nothing_bears_are_refused() {
    let refusal = |loads: &str| {
        let text = format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 100.0)], rod: RodModel(law: Constant)),
                loads: [{loads}],
                task: Equilibrium(),
            )"
        );
        Scene::from_ron(&text).map_or_else(|error| error.message, |_| String::new())
    };
    let one = "Couple(end: End, couple_pn_nm: (0.0, 2.0, 1.0)),";
    let message = refusal(one);
    assert!(
        message.starts_with("loads[0].couple_pn_nm = [0.0, 2.0, 1.0]: no clamp"),
        "{message}"
    );
    let weight = "Acceleration(acceleration_nm_per_ns2: (0.0, 0.0, -1.0))";
    let message = refusal(weight);
    assert!(message.starts_with("loads[0].acceleration_nm_per_ns2 = [0.0, 0.0, -1.0]: no clamp"));
}

/// A rod on one pin turns under a couple for ever, one on a hinge or on two pins does not.
#[test]
fn couples_on_one_pin_are_refused() {
    let refusal = |clamps: &str| {
        let text = format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 100.0)], rod: RodModel(law: Constant)),
                clamps: [{clamps}],
                loads: [Couple(end: End, couple_pn_nm: (1.0, 0.0, 0.0))],
                task: Equilibrium(),
            )"
        );
        Scene::from_ron(&text).map_or_else(|error| error.message, |_| String::new())
    };
    assert_ne!(refusal("Clamp(end: Start, hold: Pin)"), "");
    let hinge = "hinge: (bend_pn_nm_per_rad: 10.0, twist_pn_nm_per_rad: 10.0)";
    assert_eq!(
        refusal(&format!("Clamp(end: Start, hold: Pin, {hinge})")),
        ""
    );
    let pins = "Clamp(end: Start, hold: Pin), Clamp(end: End, hold: Pin, slides: AlongAxis)";
    assert_eq!(refusal(pins), "");
}

/// What acts on held bodies alone moves nothing: the place of a load lies behind a clamp, or the end slides along
/// another axis.
#[test]
fn loads_on_held_bodies_are_refused() {
    for load in [
        "Force(at_nm: 0.0, force_pn: (1.0, 0.0, 0.0))",
        "ForcePerLength(to_nm: 1.0, force_pn_per_nm: (1.0, 0.0, 0.0))",
        "Couple(at_nm: 0.0, couple_pn_nm: (0.0, 0.0, 1.0))",
        "EndForce(end: End, force_pn: (1.0, 0.0, 0.0))",
    ] {
        let text = format!(
            "Scene(
                filament: Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 60.0)]),
                clamps: [Clamp(end: Start), Clamp(end: End, slides: AlongAxis)],
                loads: [{load}],
                task: {STATICS},
            )"
        );
        let scene = Scene::from_ron(&text).unwrap();
        let problem =
            actin_sim::Assembly::build(&scene).map_or_else(|p| p.to_string(), |_| String::new());
        assert!(
            problem.contains("acts on held bodies alone"),
            "{load}: {problem}"
        );
    }
}

/// Between two bare pins a filament turns about its axis: only couples that balance about it are borne.
#[test]
fn a_couple_along_two_pins_is_refused() {
    let message = |couples: &str| {
        let text = format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 100.0)], rod: RodModel(law: Constant)),
                clamps: [Clamp(end: Start, hold: Pin), Clamp(end: End, hold: Pin)],
                loads: [{couples}],
                task: {STATICS},
            )"
        );
        Scene::from_ron(&text).map_or_else(|error| error.message, |_| String::new())
    };
    let couple =
        |at: f64, z: f64| format!("Couple(at_nm: {at:?}, couple_pn_nm: (1.0, 0.0, {z:?})),");
    let refused = message(&couple(50.0, 1.0));
    assert!(
        refused.contains("turn about the line between them"),
        "{refused}"
    );
    assert_eq!(message(&couple(50.0, 0.0)), "");
    assert_eq!(
        message(&[couple(20.0, -1.0), couple(50.0, 1.0)].concat()),
        ""
    );
}

/// Nothing is at rest while loads change: what waits for rest is refused if they change to the end.
#[test]
fn rest_before_loads_have_settled_is_refused() {
    let load =
        |factor: &str| format!("Force(end: End, force_pn: (1.0, 0.0, 0.0), factor: {factor})");
    for key in [
        "stop: (force_pn: 1e-4, torque_pn_nm: 1e-4, kinetic_pn_nm: 1e-8)",
        "leave_saddles: 2",
    ] {
        let task = format!("Dynamics(duration_ns: 10.0, {key})");
        let message = refusal(&load("Sine(period_ns: 1.0)"), &task);
        assert!(
            message.contains("under which nothing comes to rest"),
            "{message}"
        );
        let message = refusal(&load("Ramp(begin_ns: 4.0, duration_ns: 6.0)"), &task);
        assert!(message.contains("changes until 10.0 ns"), "{message}");
        assert_eq!(refusal(&load("Ramp(duration_ns: 6.0)"), &task), "");
    }
}

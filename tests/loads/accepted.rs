//! Accepted loads close to refused ones (`scenarios/bad`).

use crate::common::refusal;

fn assert_is_accepted(clamps: &str, loads: &str, task: &str) {
    let text = format!(
        "Scene(
            filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 100.0)], rod: RodModel(law: Constant)),
            clamps: [{clamps}],
            loads: [{loads}],
            task: {task},
        )"
    );
    assert_eq!(refusal(&text), "", "{text}");
}

#[test]
fn valid_loads_are_accepted() {
    let wall = "Clamp(end: Start)";
    let (statics, motion) = ("Equilibrium()", "Dynamics(duration_ns: 1.0)");
    let follower = "Force(end: End, force_pn: (0.0, 0.0, -1.0), follows: true)";
    let force = "Force(end: End, force_pn: (1.0, 0.0, 0.0), factor:";
    let sine = format!("{force} Sine(period_ns: 1.0))");
    let ramp = format!("{force} Ramp(duration_ns: 6.0))");
    let bend = "Couple(end: End, couple_pn_nm: (1.0, 0.0, 0.0))";
    let small = "Couple(end: End, couple_pn_nm: (0.0, 0.0, 1e-7))";
    let lines = "ForcePerLength(force_pn_per_nm: (0.0, 1e-8, 0.0))";
    let pin = "Clamp(end: Start, hold: Pin)";
    let hinge = "Clamp(end: Start, hold: Pin, hinge: (bend_pn_nm_per_rad: 10.0, twist_pn_nm_per_rad: 10.0))";
    let slide = format!("{pin}, Clamp(end: End, hold: Pin, slides: AlongAxis)");
    let pins = format!("{pin}, Clamp(end: End, hold: Pin)");
    let couple =
        |at: f64, z: f64| format!("Couple(at_nm: {at:?}, couple_pn_nm: (1.0, 0.0, {z:?})),");
    let balanced = [couple(20.0, -1.0), couple(50.0, 1.0)].concat();
    let stop = "Dynamics(duration_ns: 10.0, stop: (force_pn: 1e-4, torque_pn_nm: 1e-4, kinetic_pn_nm: 1e-8))";
    for (clamps, loads, task) in [
        // Motion accepts loads without a potential, time-dependent loads and small loads.
        (wall, follower, motion),
        (wall, &sine, motion),
        (wall, small, motion),
        (wall, lines, motion),
        // Couples balanced by a hinge, two pins or another couple.
        (hinge, bend, statics),
        (&slide, bend, statics),
        (&pins, &couple(50.0, 0.0), statics),
        (&pins, &balanced, statics),
        // Loads that settle before the motion comes to rest.
        (wall, &ramp, stop),
        (wall, &ramp, "Dynamics(duration_ns: 10.0, leave_saddles: 2)"),
    ] {
        assert_is_accepted(clamps, loads, task);
    }
}

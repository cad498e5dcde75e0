//! Ends of runs: model limits, saddles, lost twist, residuals at round-off.

use crate::common::{Workplace, assert_has};

#[test]
fn a_result_outside_the_model_is_a_failure() {
    let place = Workplace::with(
        "Scene(
            filament: Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 30.0)]),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: (0.0, 0.0, -1e5))],
            task: Equilibrium(),
        )",
    );
    let message = place.fail(3, &["run", "scene.ron", "--out", "a"]);
    assert_has(
        &message,
        &[
            "does not apply to the result: the bonds at s = ",
            " (limit 1)",
            "are in a",
        ],
    );
    assert_has(
        &place.read("a/summary.json"),
        &["\"status\": \"failed\"", "\"quantity\": \"bonds\""],
    );
    let again = place.fail(3, &["run", "scene.ron", "--out", "a", "--resume"]);
    assert_eq!(again, message);
}

#[test]
fn saddles_that_were_left_are_reported() {
    for (force, saddles) in [(2.0, 0), (8.0, 1)] {
        let place = Workplace::with(&format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 160.0)], rod: RodModel(law: Constant)),
                clamps: [Clamp(end: Start)],
                loads: [EndForce(end: End, force_pn: (0.0, 0.0, -{force:?}))],
                task: Equilibrium(),
            )"
        ));
        let output = place.run("a");
        let words = "moved away from 1 saddle(s) and made 0 sudden jump(s)";
        let printed = output;
        assert_eq!(printed.contains(words), saddles > 0, "{printed}");
        assert_eq!(summary(&place)["saddles_left"], saddles);
    }
}

fn straight(filament: &str, task: &str) -> Workplace {
    Workplace::with(&format!(
        "Scene(
            filament: Filament(
                sections: [Rod(from_nm: 0.0, to_nm: 100.0, segments: 5)], {filament}
            ),
            clamps: [Clamp(end: Start), Clamp(end: End)],
            path: [Stage(set: [Shift(end: End, shift_nm: (0.0, 0.0, -20.0))], duration_ns: 2.0)],
            task: {task},
        )"
    ))
}

fn damped(keys: &str) -> String {
    format!(
        "Dynamics(duration_ns: 60.0, {keys}
            drag: (translational_per_ns: 3.0, rotational_per_ns: 3.0))"
    )
}

fn summary(place: &Workplace) -> serde_json::Value {
    let text = place.read("a/summary.json");
    serde_json::from_str(&text).unwrap()
}

#[test]
fn an_end_on_a_saddle_is_a_failure() {
    for task in [damped(""), "Equilibrium(leave_saddles: 0)".into()] {
        let place = straight("", &task);
        let said = place.fail(3, &["run", "scene.ron", "--out", "a"]);
        assert!(said.starts_with("error: scene.ron:7:"), "{said}");
        assert_has(&said, &["task.leave_saddles = 0: the run ends on a saddle"]);
        assert!(said.trim_end().ends_with("all results are in a"), "{said}");
        let json = summary(&place);
        assert_eq!(
            (&json["status"], &json["stability"]["stable"]),
            (&"failed".into(), &false.into())
        );
        assert!(json["stability"]["negative_eigenvalues"].as_u64() > Some(0));
        assert!(place.path("a/states.npz").is_file());
        let again = place.fail(3, &["run", "scene.ron", "--out", "a", "--resume"]);
        assert_eq!(again, said);
    }
}

#[test]
fn a_motion_at_rest_reports_its_stability() {
    let imperfection = "imperfection: (amplitude_nm: 0.01, seed: 1),";
    for (filament, keys, pushes) in [(imperfection, "", 0), ("", "leave_saddles: 3,", 1)] {
        let place = straight(filament, &damped(keys));
        let output = place.run("a");
        let last = output.lines().last().unwrap();
        assert!(
            last.starts_with("at rest, stable") && last.ends_with("; written to a"),
            "{last}"
        );
        assert_eq!(output.matches("pushed off a saddle").count(), pushes);
        let json = summary(&place);
        assert_eq!(json["stability"]["negative_eigenvalues"], 0);
        assert_eq!(json["saddles_left"], pushes);
        assert_eq!(
            json.get("pushes")
                .map_or(0, |p| p.as_array().unwrap().len()),
            pushes
        );
    }
}

#[test]
fn uncertified_rest_is_warned_about() {
    let stop = "stop: (force_pn: 1e-3, torque_pn_nm: 1e-3, kinetic_pn_nm: 1e-6),";
    let place = straight(
        "rod: RodModel(law: Constant, force_law: PaperBalance),",
        &damped(stop),
    );
    let output = place.run("a");
    let told = "warning: the stop rule was met, but it is not known whether";
    assert!(output.contains(told), "{output}");
}

#[test]
fn a_residual_at_round_off_is_warned_about() {
    for (tolerance, told) in [("1e-7", false), ("1e-16", true)] {
        let place = Workplace::with(&format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 160.0)]),
                clamps: [Clamp(end: Start)],
                loads: [EndForce(end: End, force_pn: (2.0, 0.0, 0.0))],
                task: Equilibrium(force_pn: {tolerance}, torque_pn_nm: {tolerance}),
            )"
        ));
        let output = place.run("a");
        let words = "the tolerance is below round-off";
        assert_eq!(output.contains(words), told, "{output}");
        let summary = place.read("a/summary.json");
        let is_null = summary.contains("\"residual_floor\": null");
        assert_eq!(is_null, !told, "{summary}");
    }
}

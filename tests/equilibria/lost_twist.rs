//! Twist that is lost between held ends is said wherever twist plus writhe can tell it, and nothing is
//! said to be lost that is not.

use crate::common::{build, failure, run, run_anyway};
use actin_sim::{Failure, Summary};

const MIXED: &str =
    "Rod(from_nm: 0.0, to_nm: 40.0, segments: 3), Ellipsoids(from_nm: 40.0, to_nm: 80.0)";

/// Held at both ends, its end moved along a path.
fn driven(filament: &str, end: &str, setting: &str) -> String {
    format!(
        "Scene(
            filament: Filament({filament}),
            clamps: [Clamp(end: Start), Clamp(end: End{end})],
            path: [Stage(set: [{setting}])],
            task: Equilibrium(accept_jumps: true, leave_saddles: 20),
        )"
    )
}

fn lost_turns(text: &str) -> f64 {
    let (_, ended) = run_anyway(&mut build(text));
    if ended.is_ok() {
        return 0.0;
    }
    match failure(ended) {
        (Failure::TwistLost { slip, .. }, _) => slip.lost_turns(),
        (other, _) => panic!("{other}"),
    }
}

/// An end that may go round the filament may take two turns off it, but not while the filament points
/// forward all the way.
#[test]
fn a_free_end_that_stays_ahead_loses_nothing_unseen() {
    let sections = format!("sections: [{MIXED}]");
    for slides in ["AlongAxis", "Freely"] {
        let end = format!(", slides: {slides}");
        let turn = "Turn(end: End, turn_deg: (0.0, 0.0, 3000.0))";
        let lost = lost_turns(&driven(&sections, &end, turn));
        println!("{slides}: {lost}");
        assert!(lost.abs() >= 1.0, "{slides}");
    }
}

/// Ends that are tilted against each other have a turn as well.
#[test]
fn tilted_ends_lose_nothing_unseen() {
    let sections = format!("sections: [{MIXED}]");
    for turn in ["(0.0, 1.0, 3000.0)", "(0.0, 20.0, 2000.0)"] {
        let setting = format!("Turn(end: End, turn_deg: {turn})");
        let lost = lost_turns(&driven(&sections, ", slides: AlongAxis", &setting));
        println!("{turn}: {lost}");
        assert!(lost.abs() >= 1.0, "{turn}");
    }
    let rod = "sections: [Rod(from_nm: 0.0, to_nm: 80.0, segments: 40)]";
    for turn in [
        "(0.0, 1.0, 1500.0)",
        "(30.0, 20.0, 200.0)",
        "(-60.0, 0.0, -90.0)",
    ] {
        let setting = format!("Turn(end: End, turn_deg: {turn})");
        assert!(lost_turns(&driven(rod, "", &setting)).abs() < 0.5, "{turn}");
    }
}

/// An end that is pushed past the other has lost nothing; with the straight lines beyond both on one
/// line the sum tells nothing, and the summary says so. Beside each other they tell it again.
#[test]
fn ends_that_pass_each_other_lose_nothing() {
    for (segments, aside, is_known) in [(20, 0.0, false), (40, 0.0, false), (20, 5.0, true)] {
        let filament = format!(
            "sections: [Rod(from_nm: 0.0, to_nm: 50.0, segments: {segments})],
             imperfection: (amplitude_nm: 0.01, seed: 1)"
        );
        let shift = format!("Shift(end: End, shift_nm: ({aside:?}, 0.0, -55.0))");
        let mut assembly = build(&driven(&filament, "", &shift));
        let (trajectory, report) = run(&mut assembly).unwrap();
        let last = trajectory.records.last().unwrap();
        let notes = Summary::new(&assembly, last, &report).notes;
        let says_so = notes
            .iter()
            .any(|note| note.contains("has lost twist is not known"));
        assert_eq!(
            says_so, !is_known,
            "{segments} segments, {aside} nm aside: {notes:?}"
        );
    }
}

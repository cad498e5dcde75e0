//! Lost twist between held ends is reported, without false reports.

use super::common::{build, failure, ran, run_anyway};
use crate::common::refusal;
use actin_sim::{Failure, Summary};

const MIXED: &str =
    "Rod(from_nm: 0.0, to_nm: 40.0, segments: 3), Ellipsoids(from_nm: 40.0, to_nm: 80.0)";

fn driven(filament: &str, end: &str, setting: &str) -> String {
    format!(
        "Scene(
            filament: Filament({filament}, rod: RodModel(law: Constant)),
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

/// An end can pass around the filament and remove two turns, but not while the filament points
/// forward everywhere.
#[test]
fn a_free_end_that_stays_ahead_loses_no_turn_unreported() {
    let sections = format!("sections: [{MIXED}]");
    for slides in ["AlongAxis", "Freely"] {
        let end = format!(", slides: {slides}");
        let turn = "Turn(end: End, turn_deg: (0.0, 0.0, 3000.0))";
        let lost = lost_turns(&driven(&sections, &end, turn));
        assert!(lost.abs() >= 1.0, "{slides}");
    }
}

#[test]
fn tilted_ends_lose_nothing_unseen() {
    let sections = format!("sections: [{MIXED}]");
    for turn in ["(0.0, 1.0, 3000.0)", "(0.0, 20.0, 2000.0)"] {
        let setting = format!("Turn(end: End, turn_deg: {turn})");
        let lost = lost_turns(&driven(&sections, ", slides: AlongAxis", &setting));
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

/// An end pushed past the other has lost no turn. With overlapping extensions the sum is
/// inconclusive and gives a warning.
#[test]
fn ends_that_pass_each_other_lose_nothing() {
    for (segments, aside, is_known) in [(20, 0.0, false), (40, 0.0, false), (20, 5.0, true)] {
        let filament = format!(
            "sections: [Rod(from_nm: 0.0, to_nm: 50.0, segments: {segments})],
             imperfection: (amplitude_nm: 0.01, seed: 1)"
        );
        let shift = format!("Shift(end: End, shift_nm: ({aside:?}, 0.0, -55.0))");
        let unknown = unknown(&driven(&filament, "", &shift));
        assert_eq!(
            unknown == 0,
            is_known,
            "{segments} segments, {aside} nm aside"
        );
    }
}

fn unknown(text: &str) -> usize {
    let (assembly, trajectory, report) = ran(text);
    let last = trajectory.records.last().unwrap();
    let notes = Summary::new(&assembly, last, &report).notes;
    let says_so = |note: &&String| note.contains("a loss of twist cannot be excluded");
    notes.iter().filter(says_so).count()
}

const ROD: &str = "Rod(from_nm: 0.0, to_nm: 80.0, segments: 32)";
const QUARTER: &str = "Arc(radius_nm: 50.92958178940651)";
const HALF: &str = "Arc(radius_nm: 25.464790894703256)";
const HELIX: &str = "Helix(radius_nm: 5.0, pitch_nm: 60.0)";
const CURVE: &str = "Points(
    nm: [(0.0, 0.0, 0.0), (20.0, 10.0, 30.0), (10.0, 30.0, 70.0), (0.0, 0.0, 120.0)])";

/// The rotation of the ends of bent filaments is relative to the filament as built. Unmoved ends
/// give no warning, unless their extensions cross.
#[test]
fn bent_filaments_that_stay_lose_nothing() {
    let still = "Turn(end: End, turn_deg: (0.0, 0.0, 0.0))";
    let narrow = "Helix(radius_nm: 8.0, pitch_nm: 25.0)";
    let crossing = "Arc(radius_nm: 18.3)";
    for shape in [QUARTER, HALF, HELIX, narrow, CURVE, crossing] {
        for sections in [ROD, MIXED] {
            let filament = format!("sections: [{sections}], shape: {shape}");
            let doubts = unknown(&driven(&filament, "", still));
            // The outermost monomer extends beyond its clamped point, where the half circle points
            // inward.
            let crosses = shape == crossing || (shape, sections) == (HALF, MIXED);
            assert_eq!(doubts, usize::from(crosses), "{shape} {sections}");
        }
    }
}

/// A rotation that segments follow is no loss; a slip through three segments is reported. An arc of
/// 80 degrees is turned about the tangents of its ends.
#[test]
fn bent_filaments_lose_nothing_unseen() {
    let arc = "Arc(radius_nm: 57.29577951308232)";
    for (shape, turn) in [
        (arc, "(1477.2, 0.0, 260.47)"),
        (arc, "(0.0, 0.0, 1500.0)"),
        (HELIX, "(0.0, 0.0, 1500.0)"),
        (CURVE, "(0.0, 0.0, 1500.0)"),
        (QUARTER, "(1500.0, 0.0, 0.0)"),
        (HALF, "(0.0, 0.0, -1500.0)"),
    ] {
        let text = |sections: &str| {
            let filament = format!("sections: [{sections}], shape: {shape}");
            driven(&filament, "", &format!("Turn(end: End, turn_deg: {turn})"))
        };
        let followed = lost_turns(&text(ROD));
        assert_eq!((followed, unknown(&text(ROD))), (0.0, 0), "{shape} {turn}");
        if shape == HALF {
            continue;
        }
        let slipped = lost_turns(&text(MIXED)).abs();
        println!("{shape} {turn}: {slipped}");
        if shape == QUARTER {
            // The outermost monomer tilts beyond a right angle.
            assert_eq!((slipped, unknown(&text(MIXED))), (0.0, 1));
        } else {
            assert!(slipped >= 1.0, "{shape} {turn}");
        }
    }
}

/// A quarter of a circle is turned about the tangent of its end. Too large a turn for ten segments
/// is refused.
#[test]
fn turns_count_about_the_tangent() {
    let turned = |degrees: f64| {
        let filament = "sections: [Rod(from_nm: 0.0, to_nm: 80.0, segments: 10)],
            shape: Arc(radius_nm: 50.92958178940651)";
        let setting = format!("Turn(end: End, turn_deg: ({degrees:?}, 0.0, 0.0))");
        refusal(&driven(filament, "", &setting))
    };
    assert_eq!(turned(1790.0), "");
    let refused = turned(1810.0);
    assert!(refused.contains("turned by 1810 deg"), "{refused}");
    assert!(
        refused.contains("181 deg between neighbouring segments"),
        "{refused}"
    );
}

//! Scenes that ask for more than any machine has: refused before anything is allocated.

use super::row::{Outcome, Row};
use super::verdict::{Verdict, verdict};
use std::time::Instant;

const ROD: &str = "Rod(from_nm: 0.0, to_nm: 30.0)";

/// What is asked for, sections and task.
const SCENES: [(&str, &str, &str); 10] = [
    (
        "1e12 monomers",
        "Ellipsoids(from_nm: 0.0, to_nm: 2.7385e12)",
        "Equilibrium()",
    ),
    (
        "1e12 segments",
        "Rod(from_nm: 0.0, to_nm: 30.0, segments: 1000000000000)",
        "Equilibrium()",
    ),
    (
        "1e12 segments by default",
        "Rod(from_nm: 0.0, to_nm: 1e13)",
        "Equilibrium()",
    ),
    (
        "a rod behind 1e12 monomers",
        "Ellipsoids(from_nm: 0.0, to_nm: 2.7385e12), Rod(from_nm: 2.7385e12, to_nm: 2.8e12)",
        "Equilibrium()",
    ),
    (
        "1e11 segments, twice",
        "Rod(from_nm: 0.0, to_nm: 30.0, segments: 100000000000), Ellipsoids(from_nm: 30.0, to_nm: 60.0),
         Rod(from_nm: 60.0, to_nm: 90.0, segments: 100000000000)",
        "Equilibrium()",
    ),
    (
        "1e300 nm of rod",
        "Rod(from_nm: 0.0, to_nm: 1e300)",
        "Equilibrium()",
    ),
    (
        "1e12 records",
        ROD,
        "Dynamics(duration_ns: 1e10, record_every_ns: 0.01)",
    ),
    (
        "1e12 records by a step of 1e-12 ns",
        ROD,
        "Dynamics(duration_ns: 1.0, time_step_ns: 1e-12, record_every_ns: 1e-12)",
    ),
    (
        "1e16 steps",
        ROD,
        "Dynamics(duration_ns: 1e4, time_step_ns: 1e-12)",
    ),
    ("1e300 ns", ROD, "Dynamics(duration_ns: 1e300)"),
];

/// Seconds that no refusal may take, on a busy machine: it takes a thousandth of one, and what is
/// asked for would take hours or more than there is memory.
const PATIENCE_S: f64 = 30.0;

/// All of them.
pub(super) fn rows() -> Vec<Row> {
    SCENES
        .map(|(case, sections, task)| {
            let text = format!(
                "Scene(filament: Filament(sections: [{sections}], rod: RodModel(law: Constant)), clamps: [Clamp(end: Start)],
                    task: {task})"
            );
            let clock = Instant::now();
            let outcome = match verdict(&text) {
                Verdict::Refused(error) if clock.elapsed().as_secs_f64() < PATIENCE_S => {
                    Outcome::Refused(error.to_string())
                }
                other => Outcome::Wrong(format!("{other:?} after {:?}", clock.elapsed())),
            };
            Row::new("guard", case, outcome)
        })
        .to_vec()
}

//! Unconstrained directions: rigid motions of free filaments and floppy modes of monomers at rest, each
//! counted as a mode without stiffness, none passed for stable.

use super::row::{Outcome, Row};
use super::scenes::{either, run};

/// Filaments at rest: the case, its filaments, its clamps, and how many of their modes are neutral.
const SCENES: [(&str, &str, &str, Modes); 7] = [
    ("a free segment", "1 Rod 10", "", Modes::FreeRods),
    ("a free rod of 100 nm", "1 Rod 100", "", Modes::FreeRods),
    ("a free rod of 10 um", "1 Rod 10000", "", Modes::FreeRods),
    ("two free rods", "2 Rod 60", "", Modes::FreeRods),
    ("a rod on a wall", "1 Rod 100", "Start", Modes::None),
    ("free monomers", "1 Ellipsoids 40", "", Modes::Monomers(7)),
    (
        "monomers on a wall",
        "1 Ellipsoids 40",
        "Start",
        Modes::Monomers(-2),
    ),
];

/// How many modes are neutral.
#[derive(Clone, Copy)]
enum Modes {
    None,
    /// Six for each, and pairs that bend so softly that their eigenvalues are below the resolution.
    FreeRods,
    /// So many more than there are monomers.
    Monomers(i64),
}

/// Roots of `cos x cosh x = 1`, the wave numbers of a free beam over its length.
const WAVES: [f64; 4] = [4.730_041, 7.853_205, 10.995_608, 14.137_165];
/// Bending rigidity of the rod (pN nm^2) and length of its segments (nm).
const BEND: f64 = 3.9e4;
const SEGMENT: f64 = 10.0;

/// All of them.
pub(super) fn rows() -> Vec<Row> {
    let row = |(case, filaments, clamp, modes): (&str, &str, &str, Modes)| {
        let outcome = either(neutral(filaments, clamp, modes));
        Row::new("neutral modes", case, outcome)
    };
    SCENES.map(row).to_vec()
}

/// Counts the modes of `filaments`, given as how many, of what, and of which length (nm).
fn neutral(filaments: &str, clamp: &str, modes: Modes) -> Result<Outcome, Outcome> {
    let [count, model, length] = filaments.split(' ').collect::<Vec<_>>()[..] else {
        unreachable!("a number, a model and a length");
    };
    let filament = |i: i64| {
        format!(
            "Filament(
                sections: [{model}(from_nm: 0.0, to_nm: {length}.0)],
                monomers: Monomers(anchors: Independent, lateral_bonds: 16, longitudinal_bonds: 16),
                rod: RodModel(law: Constant),
                at_nm: ({}.0, 0.0, 0.0),
            ),",
            20 * i
        )
    };
    let count: i64 = count.parse().expect("it is a number");
    let filaments: String = (0..count).map(filament).collect();
    let clamps = match clamp {
        "" => String::new(),
        end => format!("clamps: [Clamp(end: {end})],"),
    };
    let ran = run(&format!(
        "Scene(filaments: [{filaments}], {clamps} task: Equilibrium())"
    ))?;
    let monomers = i64::try_from(ran.assembly.counts().monomers).expect("there are few");
    let found = ran.report.equilibrium.expect("an equilibrium has a report");
    let certificate = found.certificate;
    if certificate.negative > 0 {
        return Err(Outcome::Wrong(format!("{certificate:?}")));
    }
    let length: f64 = length.parse().expect("it is a number");
    let is_soft = |wave: &&f64| BEND * SEGMENT * (*wave / length).powi(4) < certificate.resolution;
    let soft = WAVES.iter().filter(is_soft).count();
    let expected = match modes {
        Modes::None => 0,
        Modes::FreeRods => count * (6 + 2 * i64::try_from(soft).expect("there are few")),
        Modes::Monomers(more) => monomers + more,
    };
    let found = i64::try_from(certificate.unresolved).expect("there are few");
    let what = "rigid and floppy motions, and softer ones than can be told from them";
    Ok(Outcome::correct(what, found.abs_diff(expected) as f64, 0.0))
}

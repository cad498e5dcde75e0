//! Equilibria with zero-stiffness modes, beyond the twist instability, beyond buckling, and beyond half a turn of a
//! joint.

use super::row::{CaseResult, Expected, Outcome, Row, correct};
use super::scenes::{CompletedRun, Parts, run, run_to_saddle};
use actin_sim::Setting;
use actin_sim::rod_constants::{TABLE_4_SHEAR, XI_COEFFICIENTS};
use actin_sim::shape::Ribbon;
use std::f64::consts::PI;

/// Number of neutral modes: rigid motions of free filaments and zero-stiffness modes of monomers at rest.
#[derive(Clone, Copy)]
enum Modes {
    None,
    /// Six for each rod, and pairs of bending modes with eigenvalues below the resolution.
    FreeRods,
    /// The number of monomers plus this.
    Monomers(i64),
}

/// Filaments at rest: case, number, model, length (nm), clamps, neutral modes.
const AT_REST: [(&str, i64, &str, f64, &str, Modes); 7] = [
    ("a free segment", 1, "Rod", 10.0, "", Modes::FreeRods),
    ("a free rod of 100 nm", 1, "Rod", 100.0, "", Modes::FreeRods),
    ("a free rod of 10 um", 1, "Rod", 1e4, "", Modes::FreeRods),
    ("two free rods", 2, "Rod", 60.0, "", Modes::FreeRods),
    ("a rod on a wall", 1, "Rod", 100.0, WALL, Modes::None),
    (
        "free monomers",
        1,
        "Ellipsoids",
        40.0,
        "",
        Modes::Monomers(7),
    ),
    (
        "monomers on a wall",
        1,
        "Ellipsoids",
        40.0,
        WALL,
        Modes::Monomers(-2),
    ),
];
const WALL: &str = "clamps: [Clamp(end: Start)],";

/// Roots of `cos x cosh x = 1`: wave numbers times length of a free beam.
const WAVES: [f64; 4] = [4.730_041, 7.853_205, 10.995_608, 14.137_165];
/// Rigidities of bending and twist (pN nm^2), and length of segments (nm).
const BEND: f64 = 3.9e4;
const TWIST: f64 = 1.3e4;
const SEGMENT: f64 = 10.0;

pub(super) fn neutral_modes() -> Vec<Row> {
    let row = |(case, count, model, length, clamps, modes): (&str, i64, &str, f64, &str, Modes)| {
        let tried = neutral(count, (model, length), clamps, modes);
        Row::new("neutral modes", case, tried)
    };
    AT_REST.map(row).to_vec()
}

fn neutral(count: i64, (model, length): (&str, f64), clamps: &str, modes: Modes) -> CaseResult {
    let filament = |i: i64| {
        format!(
            "Filament(
                sections: [{model}(from_nm: 0.0, to_nm: {length:?})],
                monomers: Monomers(anchors: Independent, lateral_bonds: 16, longitudinal_bonds: 16),
                rod: RodModel(law: Constant),
                at_nm: ({}.0, 0.0, 0.0),
            ),",
            20 * i
        )
    };
    let filaments: String = (0..count).map(filament).collect();
    let ran = run(&format!(
        "Scene(filaments: [{filaments}], {clamps} task: Equilibrium())"
    ))?;
    let whole = |count: usize| i64::try_from(count).expect("there are few");
    let found = ran.report.equilibrium.expect("an equilibrium has a report");
    let certificate = found.certificate;
    if certificate.negative > 0 {
        return Err(Outcome::Wrong(format!("{certificate:?}")));
    }
    let is_soft = |wave: &&f64| BEND * SEGMENT * (*wave / length).powi(4) < certificate.resolution;
    let expected = match modes {
        Modes::None => 0,
        Modes::FreeRods => count * (6 + 2 * whole(WAVES.iter().filter(is_soft).count())),
        Modes::Monomers(more) => whole(ran.assembly.counts().monomers) + more,
    };
    let error = whole(certificate.unresolved).abs_diff(expected) as f64;
    let what = "rigid and floppy motions, and softer ones than can be told from them";
    correct(what, error, 0.0)
}

/// Laws with twist-dependent natural length: name, critical compression (pN), relative change of
/// the natural length, stretching rigidity (pN), and compressions relative to the critical one.
/// `Fitted` has no stiffness for small shear and does not stay straight at larger compressions.
const LAWS: [(&str, f64, f64, f64, &[f64]); 2] = [
    (
        "PublishedExtension",
        // 566.01 / (2 x 20.508)
        13.80,
        XI_COEFFICIENTS[0],
        TABLE_4_SHEAR[2],
        &[0.1, 0.99, 1.02, 3.0, 10.0],
    ),
    // 235.488 / (0.463366 / 6.02136e-3)
    ("Fitted", 3.060, 0.0, 3.354_4e4, &[0.1, 0.99, 1.02]),
];
/// Length (nm), so short that the Euler load between clamps, 960 pN, is far above.
const PUSHED: f64 = 40.0;
const SEGMENTS: usize = 20;

pub(super) fn compression() -> Vec<Row> {
    let rows = LAWS
        .iter()
        .flat_map(|&(law, bound, natural, stretch, shares)| {
            shares.iter().map(move |&share| {
                let shift = PUSHED * (natural - share * bound / stretch);
                let case = format!("rod, {law}, {share} of its bound");
                Row::new("compression", case, compressed(law, shift, bound, share))
            })
        });
    rows.collect()
}

/// Returns the number of unstable twist modes at a fraction of the bound, as derived in `docs/numerics.md`.
fn unstable_modes(share: f64) -> usize {
    let softens = |m: usize| (m as f64 * PI / (2 * SEGMENTS) as f64).cos().powi(2);
    (1..SEGMENTS).filter(|&m| softens(m) * share > 1.0).count()
}

/// Checks the warning about the twist instability and the number of unstable modes. The law
/// `Fitted` also has unstable shear modes.
fn compressed(law: &str, shift: f64, bound: f64, share: f64) -> CaseResult {
    let parts = Parts {
        models: format!("rod: RodModel(law: {law}),"),
        ..Parts::new(
            format!("Rod(from_nm: 0.0, to_nm: {PUSHED:?}, segments: {SEGMENTS})"),
            format!(
                "clamps: [Clamp(end: Start), Clamp(end: End)],
                 path: [Stage(set: [Shift(end: End, shift_nm: (0.0, 0.0, {shift:?}))])],"
            ),
            "Equilibrium(leave_saddles: 0)",
        )
    };
    let ran = run_to_saddle(&parts.text())?;
    let said = ran.assembly.unstable_twist(ran.assembly.system.state());
    if (share > 1.0) == said.is_empty() {
        return Err(Outcome::Wrong(format!("the run says {said:?}")));
    }
    if law == "Fitted" {
        let reported = said.first().map_or(Some(bound), |said| said.bound_pn);
        let what = "the run tells the bound, once it is passed";
        let error = reported.map_or(f64::INFINITY, |reported| (reported / bound - 1.0).abs());
        return correct(what, error, 1e-3);
    }
    let found = ran.report.equilibrium.expect("an equilibrium").certificate;
    let error = found.negative.abs_diff(unstable_modes(share)) as f64;
    let what = "number of unstable modes, which the run tells of";
    correct(what, error, 0.0)
}

/// Motions that compress a straight rod, as keys of the filament and of the task. Without a
/// perturbation the rod stays straight by symmetry.
const WAYS: [(&str, &str, &str); 3] = [
    ("as it is", "", ""),
    (
        "imperfection of 0.01 nm",
        "imperfection: (amplitude_nm: 0.01, seed: 1),",
        "",
    ),
    ("leave_saddles: 3", "", "leave_saddles: 3,"),
];
/// Compressions relative to the length; the critical one is 0.11 %.
const PUSHES: [f64; 4] = [1e-3, 3e-3, 0.03, 0.3];

/// Compares the final energy of damped motions with the equilibrium. A motion that stays straight
/// above the critical load fails on a saddle.
pub(super) fn straight() -> Vec<Row> {
    let pushed = |share: f64, imperfection: &str, task: String| {
        Parts {
        models: imperfection.to_owned(),
        ..Parts::new(
            "Rod(from_nm: 0.0, to_nm: 200.0, segments: 10)",
            format!(
                "clamps: [Clamp(end: Start), Clamp(end: End)],
                 path: [Stage(set: [Shift(end: End, shift_nm: (0.0, 0.0, {:?}))], duration_ns: 20.0)],",
                -share * 200.0
            ),
            task,
        )
    }
    };
    let moved = |share: f64, imperfection: &str, keys: &str| {
        let task = format!(
            "Dynamics(duration_ns: 2000.0, record_every_ns: 2.0, {keys}
            drag: (translational_per_ns: 1.0, rotational_per_ns: 1.0),
            stop: (force_pn: 1e-6, torque_pn_nm: 1e-6, kinetic_pn_nm: 1e-10))"
        );
        let ran = pushed(share, imperfection, task).run()?;
        let statics = pushed(share, "", "Equilibrium()".to_owned()).run()?;
        let [energy, exact] = [ran, statics].map(|ran| ran.assembly.system.potential_energy());
        correct("energy of statics", (energy / exact - 1.0).abs(), 1e-8)
    };
    let row = |share: f64, (words, imperfection, keys): (&str, &str, &str)| {
        let case = format!("rod, pushed together by {share} of its length in time, {words}");
        let is_saddle = words == "as it is" && share > 1e-3;
        let row = Row::new("straight rod", case, moved(share, imperfection, keys));
        row.expecting(if is_saddle {
            Expected::Fails(&["saddle"])
        } else {
            Expected::Correct
        })
    };
    let rows = PUSHES
        .into_iter()
        .flat_map(|share| WAYS.map(|way| row(share, way)));
    rows.collect()
}

const LONG_ROD: &str = "Rod(from_nm: 0.0, to_nm: 75.0)";
const SIX_SEGMENTS: &str = "Rod(from_nm: 0.0, to_nm: 75.0, segments: 6)";
const ONE_SEGMENT: &str = "Rod(from_nm: 0.0, to_nm: 10.0, segments: 1)";
const LONG_MONOMERS: &str = "Ellipsoids(from_nm: 0.0, to_nm: 75.0)";
const MONOMERS: &str = "Ellipsoids(from_nm: 0.0, to_nm: 30.0)";
const BOTH: &str =
    "Rod(from_nm: 0.0, to_nm: 40.0, segments: 4), Ellipsoids(from_nm: 40.0, to_nm: 60.0)";
const JUMPS: &str = "Equilibrium(accept_jumps: true)";

fn turned(sections: &str, degrees: f64, statics: &str, ns: Option<f64>) -> Parts {
    let duration = ns.map_or(String::new(), |ns| format!("duration_ns: {ns:?}"));
    let rest = format!(
        "clamps: [Clamp(end: Start), Clamp(end: End, slides: AlongAxis)],
             path: [Stage(set: [Turn(end: End, turn_deg: (0.0, 0.0, {degrees:?}))], {duration})],"
    );
    let task = if ns.is_none() {
        statics.to_owned()
    } else {
        let duration = if sections == ONE_SEGMENT { 20.0 } else { 5.0 };
        format!(
            "Dynamics(duration_ns: {duration:?}, integrator: PositionVerlet,
        drag: (translational_per_ns: 5.0, rotational_per_ns: 5.0))"
        )
    };
    Parts::new(sections, rest, task)
}

/// Twist over 75 nm; two turns are 90 deg per joint of the rod.
pub(super) fn twist(has_monomers: bool) -> Vec<Row> {
    let mut rows = Vec::new();
    for degrees in [180.0, -180.0, 360.0, -360.0, 720.0, -720.0] {
        let row = |model: &str, tried| {
            let case = format!("{model}, {degrees:+} deg over 75 nm");
            Row::new("twist", case, tried)
        };
        rows.push(row("rod", uniform(LONG_ROD, 75.0, degrees, None)));
        if has_monomers {
            let jumps = certified(degrees, JUMPS);
            rows.extend([
                row("monomers", certified(degrees, "Equilibrium()")).expecting(Expected::Sound),
                row("monomers, across jumps", jumps).expecting(Expected::Sound),
            ]);
        }
    }
    rows
}

/// Twist of one segment between two clamps, half of it at each; an error above 180 deg at each
/// clamp.
pub(super) fn one_segment() -> Vec<Row> {
    let rows = [90.0, 350.0, 359.9, 360.1, 400.0, 720.0]
        .into_iter()
        .flat_map(|degrees: f64| {
            let half = degrees / 2.0;
            let expected = if half < 180.0 {
                Expected::Correct
            } else {
                Expected::Stops
            };
            [("statics", None), ("driven in time", Some(2.0))].map(|(how, ns)| {
                let case = format!("{half} deg per half segment, {how}");
                let tried = uniform(ONE_SEGMENT, 10.0, degrees, ns);
                Row::new("turn", case, tried).expecting(expected)
            })
        });
    rows.collect()
}

const LOST: Expected = Expected::Fails(&["lost"]);
/// Filaments twisted up to and beyond the limit of their joints, in statics with jumps or within a time (ns).
const SLIPPING: [(&str, &str, f64, Option<f64>, Expected); 7] = [
    (SIX, SIX_SEGMENTS, 1070.0, None, Expected::Correct),
    (SIX, SIX_SEGMENTS, 5000.0, None, Expected::Refused),
    (SIX, SIX_SEGMENTS, 5000.0, Some(4.0), Expected::Refused),
    (
        "six segments of rod, within 0.02 ns",
        SIX_SEGMENTS,
        900.0,
        Some(0.02),
        LOST,
    ),
    ("rod and monomers", BOTH, 1500.0, None, LOST),
    ("rod and monomers", BOTH, 1500.0, Some(4.0), LOST),
    ("monomers", MONOMERS, 1500.0, None, LOST),
];
const SIX: &str = "six segments of rod";

pub(super) fn slipping() -> Vec<Row> {
    let row =
        |(model, sections, degrees, ns, expected): (&str, &str, f64, Option<f64>, Expected)| {
            let how = ns.map_or("statics, across jumps", |_| "driven in time");
            let case = format!("{model}, turned by {degrees} deg, {how}");
            let tried = linked(&turned(sections, degrees, JUMPS, ns));
            Row::new("turn", case, tried).expecting(expected)
        };
    SLIPPING.map(row).to_vec()
}

fn linked(parts: &Parts) -> CaseResult {
    let ran = parts.run()?;
    let ribbon = Ribbon::new(&ran.assembly, ran.assembly.system.state());
    let link = ran.assembly.scene.path.iter().flat_map(|stage| &stage.set);
    let turns = link.map(|setting| match setting {
        Setting::Turn { turn_deg, .. } => turn_deg[2] / 360.0,
        _ => 0.0,
    });
    let sum = ribbon.twist() + ribbon.writhe().unwrap_or(f64::NAN);
    let error = (sum - turns.sum::<f64>()).abs();
    correct("twist and writhe (turns)", error, 1e-9)
}

fn uniform(sections: &str, length: f64, degrees: f64, ns: Option<f64>) -> CaseResult {
    let mut ran = turned(sections, degrees, "Equilibrium()", ns).run()?;
    let exact = TWIST * degrees.to_radians() / length;
    let error = (couple(&mut ran, 1) / exact - 1.0).abs();
    correct("couple B3 phi / L", error, 1e-8)
}

fn couple(ran: &mut CompletedRun, clamp: usize) -> f64 {
    ran.reaction(clamp).1.z
}

fn certified(degrees: f64, task: &str) -> CaseResult {
    let mut ran = turned(LONG_MONOMERS, degrees, task, None).run()?;
    let found = ran.report.equilibrium.as_ref();
    let negative = found.map(|e| e.certificate.negative);
    if negative != Some(0) {
        let message = format!("{negative:?} negative eigenvalues");
        return Err(Outcome::Wrong(message));
    }
    let (near, far) = (couple(&mut ran, 0), couple(&mut ran, 1));
    // The sliding end has no torque about the axis other than its reaction.
    let error = (near + far).abs() / far.abs();
    correct("couples of both ends, stable", error, 1e-4)
}

//! Twist to 720 deg over 75 nm, and turns of one segment up to and past half a turn.

use super::row::{Outcome, Row};
use super::scenes::{Parts, Ran, either};
use actin_sim::Setting;
use actin_sim::shape::Ribbon;

const ROD: &str = "Rod(from_nm: 0.0, to_nm: 75.0)";
const MONOMERS: &str = "Ellipsoids(from_nm: 0.0, to_nm: 75.0)";
const ONE_SEGMENT: &str = "Rod(from_nm: 0.0, to_nm: 10.0, segments: 1)";
/// Twisting rigidity (pN nm^2).
const TWIST: f64 = 1.3e4;

/// A filament whose far end is turned by `degrees` about the axis, along which it slides.
fn turned(sections: &str, degrees: f64, task: &str, duration: &str) -> Parts {
    Parts {
        sections: sections.to_owned(),
        rest: format!(
            "clamps: [Clamp(end: Start), Clamp(end: End, slides: AlongAxis)],
             path: [Stage(set: [Turn(end: End, turn_deg: (0.0, 0.0, {degrees:?}))], {duration})],"
        ),
        task: task.to_owned(),
        ..Parts::default()
    }
}

/// Twist of 75 nm.
pub(super) fn twist(monomers: bool) -> Vec<Row> {
    let mut rows = Vec::new();
    for degrees in [180.0, -180.0, 360.0, -360.0, 720.0, -720.0] {
        let mut push = |model: &str, outcome| {
            let case = format!("{model}, {degrees:+} deg over 75 nm");
            rows.push(Row::new("twist", case, outcome));
        };
        push("rod", either(uniform(ROD, 75.0, degrees)));
        if monomers {
            push("monomers", either(certified(degrees, "")));
            let across = either(certified(degrees, "accept_jumps: true"));
            push("monomers, across jumps", across);
        }
    }
    rows
}

/// Turns of one segment between two walls: each of its halves turns by half of it.
pub(super) fn one_segment() -> Vec<Row> {
    let mut rows = Vec::new();
    for degrees in [90.0, 350.0, 359.9, 360.1, 400.0, 720.0] {
        let case = |how: &str| format!("{} deg per half segment, {how}", degrees / 2.0);
        let statics = either(uniform(ONE_SEGMENT, 10.0, degrees));
        rows.push(Row::new("turn", case("statics"), statics));
        let dynamics = either(driven(degrees));
        rows.push(Row::new("turn", case("driven in time"), dynamics));
    }
    rows
}

/// Filaments that a turn twists beyond what their joints can follow: refused, or an error as soon as
/// twist is lost. None may end with twist and writhe that miss the turn of its ends.
pub(super) fn slipping() -> Vec<Row> {
    let six = "Rod(from_nm: 0.0, to_nm: 75.0, segments: 6)";
    let mixed = "Rod(from_nm: 0.0, to_nm: 40.0, segments: 4), \
                 Ellipsoids(from_nm: 40.0, to_nm: 60.0)";
    let jumps = "Equilibrium(accept_jumps: true)";
    let damped = "Dynamics(duration_ns: 5.0, integrator: PositionVerlet,
        drag: (translational_per_ns: 5.0, rotational_per_ns: 5.0))";
    let monomers = "Ellipsoids(from_nm: 0.0, to_nm: 30.0)";
    let (rod, slow, fast) = (
        "six segments of rod",
        "duration_ns: 4.0",
        "duration_ns: 0.02",
    );
    let rod_fast = "six segments of rod, within 0.02 ns";
    let both = "rod and monomers";
    let cases = [
        (rod, six, 1070.0, jumps, ""),
        (rod, six, 5000.0, jumps, ""),
        (rod, six, 5000.0, damped, slow),
        (rod_fast, six, 900.0, damped, fast),
        (both, mixed, 1500.0, jumps, ""),
        (both, mixed, 1500.0, damped, slow),
        ("monomers", monomers, 1500.0, jumps, ""),
    ];
    cases
        .map(|(model, sections, degrees, task, duration)| {
            let how = if duration.is_empty() {
                "statics, across jumps"
            } else {
                "driven in time"
            };
            let case = format!("{model}, turned by {degrees} deg, {how}");
            let outcome = either(linked(&turned(sections, degrees, task, duration)));
            Row::new("turn", case, outcome)
        })
        .to_vec()
}

/// Twist plus writhe is the turn of the ends.
fn linked(parts: &Parts) -> Result<Outcome, Outcome> {
    let ran = parts.run()?;
    let ribbon = Ribbon::new(&ran.assembly, ran.assembly.system.state());
    let link = ran.assembly.scene.path.iter().flat_map(|stage| &stage.set);
    let turns = link.map(|setting| match setting {
        Setting::Turn { turn_deg, .. } => turn_deg[2] / 360.0,
        _ => 0.0,
    });
    let sum = ribbon.twist() + ribbon.writhe().unwrap_or(f64::NAN);
    let error = (sum - turns.sum::<f64>()).abs();
    Ok(Outcome::correct("twist and writhe (turns)", error, 1e-9))
}

/// Twist is uniform, its couple `B3` times that.
fn uniform(sections: &str, length: f64, degrees: f64) -> Result<Outcome, Outcome> {
    let mut ran = turned(sections, degrees, "Equilibrium()", "").run()?;
    let exact = TWIST * degrees.to_radians() / length;
    let error = (couple(&mut ran) / exact - 1.0).abs();
    Ok(Outcome::correct("couple B3 phi / L", error, 1e-8))
}

/// The same in time: turned within 2 ns and damped for 18.
fn driven(degrees: f64) -> Result<Outcome, Outcome> {
    let task = "Dynamics(duration_ns: 20.0, integrator: PositionVerlet,
        drag: (translational_per_ns: 5.0, rotational_per_ns: 5.0))";
    let mut ran = turned(ONE_SEGMENT, degrees, task, "duration_ns: 2.0").run()?;
    let exact = TWIST * degrees.to_radians() / 10.0;
    let error = (couple(&mut ran) / exact - 1.0).abs();
    Ok(Outcome::correct("couple B3 phi / L", error, 1e-8))
}

/// Couple about the axis that the far end bears (pN nm).
fn couple(ran: &mut Ran) -> f64 {
    let loads = ran.assembly.system.loads().clone();
    let end = &ran.assembly.clamps[1];
    end.reaction(ran.assembly.system.state(), &loads)
        .torque_pn_nm
        .z
}

/// Every equilibrium of monomers comes with its certificate, the couples of both ends in balance.
fn certified(degrees: f64, task: &str) -> Result<Outcome, Outcome> {
    let mut ran = turned(MONOMERS, degrees, &format!("Equilibrium({task})"), "").run()?;
    let found = ran.report.equilibrium.as_ref();
    let negative = found.map(|e| e.certificate.negative);
    if negative != Some(0) {
        let message = format!("{negative:?} negative eigenvalues");
        return Err(Outcome::Wrong(message));
    }
    let far = couple(&mut ran);
    let loads = ran.assembly.system.loads().clone();
    let near = ran.assembly.clamps[0].reaction(ran.assembly.system.state(), &loads);
    let error = (near.torque_pn_nm.z + far).abs() / far.abs();
    // The far end bears the moment of what its bodies cannot slide along: none about the axis.
    Ok(Outcome::correct(
        "couples of both ends, stable",
        error,
        1e-4,
    ))
}

//! Filaments of the fewest and of very many bodies.

use super::row::{Outcome, Row};
use super::scenes::{Parts, build, either};
use actin_integrate::{Drag, PEFRL, advance};
use actin_sim::Plan;
use std::time::Instant;

/// The smallest that can be built, and a step of motion of each.
pub(super) fn smallest() -> Vec<Row> {
    [
        ("1 segment", "Rod(from_nm: 0.0, to_nm: 10.0, segments: 1)"),
        ("3 monomers", "Ellipsoids(from_nm: 0.0, to_nm: 2.7)"),
        (
            "2 monomers between 2 segments",
            "Rod(from_nm: 0.0, to_nm: 10.0, segments: 1), Ellipsoids(from_nm: 10.0, to_nm: 15.5),
             Rod(from_nm: 15.5, to_nm: 25.5, segments: 1)",
        ),
        ("0 segments", "Rod(from_nm: 0.0, to_nm: 10.0, segments: 0)"),
        ("2 monomers", "Ellipsoids(from_nm: 0.0, to_nm: 1.3)"),
    ]
    .map(|(name, sections)| Row::new("size", name, either(moved(&free(sections), 1000))))
    .to_vec()
}

/// Very many bodies, in one filament and in a hundredth as many: 20 steps, seconds and memory in the
/// name.
pub(super) fn largest(count: u32) -> Vec<Row> {
    let (filaments, length) = (count / 100, f64::from(count));
    let rod = format!(
        "Rod(from_nm: 0.0, to_nm: {:?}, segments: {count})",
        10.0 * length
    );
    let monomers = format!(
        "Ellipsoids(from_nm: 0.0, to_nm: {:?})",
        71.2 / 26.0 * length
    );
    let rods = "Rod(from_nm: 0.0, to_nm: 40.0, segments: 4)";
    let pairs = "Ellipsoids(from_nm: 0.0, to_nm: 10.0), Rod(from_nm: 10.0, to_nm: 50.0)";
    [
        (count, "segments", free(&rod)),
        (count, "monomers", free(&monomers)),
        (filaments, "rods of 4 segments", side_by_side(filaments, rods)),
        (filaments, "filaments of monomers and rod", side_by_side(filaments, pairs)),
    ]
    .map(|(count, name, text)| {
        let clock = Instant::now();
        let outcome = either(moved(&text, 20));
        let seconds = clock.elapsed().as_secs_f64();
        let memory = peak_memory_mb();
        let count = f64::from(count);
        let case = format!(
            "{count:.0e} {name}: built, estimated and 20 steps in {seconds:.1} s, at most {memory:.0} MB"
        );
        Row::new("size", case, outcome)
    })
    .to_vec()
}

/// Paths of very many stages: their scene is read, built and estimated, and ends where its last stage
/// says.
pub(super) fn stages(count: u32) -> Vec<Row> {
    let clock = Instant::now();
    let outcome = either(driven(count));
    let seconds = clock.elapsed().as_secs_f64();
    let case = format!(
        "{:.0e} stages, each of which moves another of as many loads: built in {seconds:.1} s",
        f64::from(count)
    );
    vec![Row::new("size", case, outcome)]
}

/// A rod with as many loads as stages, each set in a stage of its own: their factors at the end.
fn driven(count: u32) -> Result<Outcome, Outcome> {
    let load = "EndForce(end: End, force_pn: (0.001, 0.0, 0.0)), ".repeat(count as usize);
    let stage = |i: u32| format!("Stage(set: [LoadFactor(load: {i}, factor: {}.0)]), ", i + 1);
    let stages: String = (0..count).map(stage).collect();
    let parts = Parts {
        sections: "Rod(from_nm: 0.0, to_nm: 40.0, segments: 4)".into(),
        rest: format!("clamps: [Clamp(end: Start)], loads: [{load}], path: [{stages}],"),
        task: "Equilibrium()".into(),
        ..Parts::default()
    };
    let assembly = parts.build()?;
    Plan::new(&assembly).map_err(|problem| Outcome::Refused(problem.to_string()))?;
    let mut state = assembly.rest.clone();
    assembly.drive.place(&mut state, f64::from(count));
    let controls = state.controls.values().iter().zip(1_u32..);
    let error = controls.map(|(factor, i)| (factor - f64::from(i)).abs());
    Ok(Outcome::correct("factors", error.fold(0.0, f64::max), 0.0))
}

/// A free filament of these sections, in motion.
fn free(sections: &str) -> String {
    let parts = Parts {
        sections: sections.to_owned(),
        task: MOTION.into(),
        ..Parts::default()
    };
    parts.text()
}

/// As many free filaments of these sections, 20 nm from each other.
fn side_by_side(count: u32, sections: &str) -> String {
    let filament = |i: u32| {
        let at = 20 * i;
        format!(
            "Filament(sections: [{sections}], at_nm: ({at}.0, 0.0, 0.0), rod: RodModel(law: Constant)), "
        )
    };
    let filaments = (0..count).map(filament).collect::<Vec<_>>().concat();
    format!("Scene(filaments: [{filaments}], task: {MOTION})")
}

const MOTION: &str = "Dynamics(duration_ns: 1.0)";

/// The most memory that this process has had (MB); not a number where the system does not say.
fn peak_memory_mb() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|line| line.trim().strip_suffix(" kB")?.parse::<f64>().ok());
    kilobytes.map_or(f64::NAN, |kb| kb / 1024.0)
}

/// Some steps of shaken filaments, by their momentum: what they have at the start they keep.
fn moved(text: &str, steps: u64) -> Result<Outcome, Outcome> {
    use actin_mechanics::{Xorshift, randomise_velocities};
    let mut assembly = build(text)?;
    let plan = Plan::new(&assembly).map_err(|problem| Outcome::Refused(problem.to_string()))?;
    let estimate = *plan.estimate().expect("a motion has an estimate");
    let system = &mut assembly.system;
    randomise_velocities(system.state_mut(), &mut Xorshift::new(2), 1.0, 0.1);
    let before = system.state().momentum();
    advance(system, &PEFRL, estimate.time_step_ns, steps, &Drag::NONE);
    let points = system.state().points.len() as f64;
    let error = (system.state().momentum() - before).norm() / before.norm();
    // Sums of as many terms as there are points, each with round-off, relative to a sum of
    // random directions that is as much smaller than its terms together.
    let bound = 1e-13 * points.sqrt().max(10.0);
    Ok(Outcome::correct("momentum", error, bound))
}

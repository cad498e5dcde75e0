//! Filaments of the fewest and of very many bodies.

use super::row::{Outcome, Row};
use super::scenes::{Parts, either};
use actin_integrate::{Drag, PEFRL, advance};
use std::time::Instant;

/// The smallest that can be built, and a step of motion of each.
pub(crate) fn smallest() -> Vec<Row> {
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
    .map(|(name, sections)| Row::new("size", name, either(moved(sections, 1000))))
    .to_vec()
}

/// Very many bodies: 20 steps, seconds and memory in the name.
pub(crate) fn largest(count: u32) -> Vec<Row> {
    let count = f64::from(count);
    let rod = format!(
        "Rod(from_nm: 0.0, to_nm: {:?}, segments: {count})",
        10.0 * count
    );
    let monomers = format!("Ellipsoids(from_nm: 0.0, to_nm: {:?})", 71.2 / 26.0 * count);
    [("segments", rod), ("monomers", monomers)]
        .map(|(name, sections)| {
            let clock = Instant::now();
            let outcome = either(moved(&sections, 20));
            let seconds = clock.elapsed().as_secs_f64();
            let memory = peak_memory_mb();
            let case = format!(
                "{count:.0e} {name}: built, estimated and 20 steps in {seconds:.1} s, at most \
                 {memory:.0} MB"
            );
            Row::new("size", case, outcome)
        })
        .to_vec()
}

/// The most memory that this process has had (MB); not a number where the system does not say.
fn peak_memory_mb() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|line| line.trim().strip_suffix(" kB")?.parse::<f64>().ok());
    kilobytes.map_or(f64::NAN, |kb| kb / 1024.0)
}

/// Some steps of a shaken filament, by its momentum: what it has at the start it keeps.
fn moved(sections: &str, steps: u64) -> Result<Outcome, Outcome> {
    use actin_mechanics::testing::{Noise, momenta, set_in_motion};
    let parts = Parts {
        sections: sections.to_owned(),
        task: "Dynamics(duration_ns: 1.0)".into(),
        ..Parts::default()
    };
    let mut assembly = parts.build()?;
    let estimate = actin_sim::estimate(&assembly)
        .map_err(|problem| Outcome::Refused(problem.to_string()))?
        .expect("a motion has an estimate");
    let system = &mut assembly.system;
    set_in_motion(system.state_mut(), &mut Noise::new(2), 1.0, 0.1);
    let before = momenta(system.state()).0;
    advance(system, &PEFRL, estimate.time_step_ns, steps, &Drag::NONE);
    let points = system.state().points.len() as f64;
    let error = (momenta(system.state()).0 - before).norm() / before.norm();
    // Sums of as many terms as there are points, each with round-off, relative to a sum of
    // random directions that is as much smaller than its terms together.
    let bound = 1e-13 * points.sqrt().max(10.0);
    Ok(Outcome::correct("momentum", error, bound))
}

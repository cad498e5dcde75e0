//! Cost of a run: counts known before the start, and time measured on the first steps.

use crate::scene::Task;
use crate::{Assembly, Plan, Record, RunError, Sink, Status};
use std::fmt;
use std::time::Instant;

/// Duration of a measurement (s). Motions with inertia run for at least 100 steps.
const MEASURED_S: f64 = 0.2;

/// Counts of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// Bonds between monomers.
    pub bonds: usize,
    /// Rod segments and bonds of junctions.
    pub elements: usize,
    /// Upper bound of the force evaluations of a motion; `None` for an equilibrium.
    pub evaluations: Option<u64>,
    /// Memory (bytes) of a run into a directory, with records on the disk.
    pub bytes: f64,
    /// Pairs of neighbouring segments and monomers, as built, in the repulsion; `None` without repulsion.
    pub contacts: Option<usize>,
}

/// Time of a run on one core of this machine, measured on its first steps, without output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// Number of measured steps: time steps or Newton steps.
    pub steps: u64,
    /// Time of one step (s).
    pub step_s: f64,
    /// Time of assembly and run (s); `None` for an equilibrium beyond the duration of the measurement, and for a run
    /// that failed.
    pub total_s: Option<f64>,
    /// True if the measured steps failed.
    pub has_failed: bool,
}

impl Plan<'_> {
    /// Returns the counts of the run.
    pub fn cost(&self) -> Cost {
        let assembly = self.assembly();
        let elements = (0..assembly.filaments.len()).map(|filament| elements(assembly, filament));
        Cost {
            bonds: assembly.counts().bonds,
            elements: elements.sum(),
            evaluations: self.estimate().map(|estimate| estimate.force_evaluations),
            bytes: assembly.bytes,
            contacts: (assembly.repelled.as_ref()).map(|all| all.pairs(&assembly.rest)),
        }
    }

    /// Returns the time of the run, extrapolated from its first 0.2 s; `None` if the run is refused.
    pub fn timing(&self) -> Option<Timing> {
        let mut watch = Stopwatch::default();
        let began = Instant::now();
        let outcome = match self.run_into(&mut watch) {
            Ok(outcome) => outcome,
            Err(RunError::Failed(failed)) => failed.outcome,
            Err(RunError::Refused(_)) => return None,
        };
        let elapsed_s = began.elapsed().as_secs_f64();
        let is_equilibrium = matches!(self.scene().task, Task::Equilibrium(_));
        let steps = if is_equilibrium {
            watch.checks.saturating_sub(1)
        } else {
            outcome.steps
        };
        let steps = steps.max(1);
        let step_s = watch.measured_s() / steps as f64;
        let left = match outcome.status {
            Status::Failed => None,
            Status::Interrupted => self.estimate().map(|all| all.steps.saturating_sub(steps)),
            _ => Some(0),
        };
        Some(Timing {
            steps,
            step_s,
            total_s: left.map(|left| self.set_up_s() + elapsed_s + left as f64 * step_s),
            has_failed: outcome.status == Status::Failed,
        })
    }
}

fn elements(assembly: &Assembly, filament: usize) -> usize {
    let counts = assembly.counts_of(filament);
    let attached = assembly.written(filament).junction.attached_monomers;
    counts.segments + counts.junctions * attached
}

#[derive(Default)]
struct Stopwatch {
    /// Times of the first and the last check.
    span: Option<[Instant; 2]>,
    checks: u64,
}

impl Stopwatch {
    fn measured_s(&self) -> f64 {
        self.span
            .map_or(0.0, |[first, last]| (last - first).as_secs_f64())
    }
}

impl Sink for Stopwatch {
    fn record(&mut self, _record: &Record) {}

    fn is_interrupted(&mut self) -> bool {
        let now = Instant::now();
        self.checks += 1;
        self.span = Some([self.span.map_or(now, |[first, _]| first), now]);
        self.measured_s() >= MEASURED_S
    }
}

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} bonds and {} elements", self.bonds, self.elements)?;
        if let Some(evaluations) = self.evaluations {
            write!(f, " in each of at most {evaluations} force evaluations")?;
        }
        if let Some(contacts) = self.contacts {
            write!(f, "; {contacts} contacts of the repulsion, as built")?;
        }
        write!(
            f,
            "; about {} of memory",
            actin_assembly::memory::in_words(self.bytes)
        )
    }
}

impl fmt::Display for Timing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let each = time(self.step_s);
        match self.total_s {
            None if self.has_failed => {
                f.write_str("unknown: the FIRST STEPS FAIL, as `run` reports")
            }
            Some(total) => write!(
                f,
                "{} on one core, measured here over {} steps of {each}",
                time(total),
                self.steps
            ),
            None => write!(f, "{each} per Newton step, measured here"),
        }
    }
}

/// Formats a time with two significant digits or fewer.
fn time(seconds: f64) -> String {
    match seconds {
        s if s < 1.0 => format!("{s:.1e} s"),
        s if s < 10.0 => format!("{s:.1} s"),
        s if s < 120.0 => format!("{s:.0} s"),
        s if s < 7200.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.0} h", s / 3600.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;

    fn measured(sections: &str, rest: &str) -> (Cost, Timing) {
        let text = format!(
            "Scene(
                filament: Filament(sections: [{sections}], rod: RodModel(law: Constant)),
                clamps: [Clamp(end: Start)],
                loads: [EndForce(end: End, force_pn: (1.0, 0.0, 0.0))],
                {rest}
            )"
        );
        let assembly = Assembly::build(&Scene::from_ron(&text).unwrap()).unwrap();
        let plan = Plan::new(&assembly).unwrap();
        (plan.cost(), plan.timing().unwrap())
    }

    const ROD: &str = "Rod(from_nm: 0.0, to_nm: 60.0, segments: 6)";

    /// 4000 evaluations: 1000 steps of 0.001 ns with four evaluations each. 8 elements: 6 segments and 2 bonds of a junction.
    #[test]
    fn counts_agree_with_the_scene() {
        let motion = "task: Dynamics(duration_ns: 1.0, time_step_ns: 0.001),";
        let (rod, _) = measured(ROD, motion);
        assert_eq!((rod.bonds, rod.elements), (0, 6));
        assert_eq!((rod.evaluations, rod.contacts), (Some(4000), None));
        let mixed =
            "Ellipsoids(from_nm: 0.0, to_nm: 30.0), Rod(from_nm: 30.0, to_nm: 90.0, segments: 6)";
        let (mixed, _) = measured(mixed, motion);
        assert!(mixed.bonds > 0);
        assert_eq!(mixed.elements, 6 + 2);
        let repelled = format!("repulsion: Repulsion(), {motion}");
        let words = measured(ROD, &repelled).0.to_string();
        assert!(words.contains("contacts of the repulsion"), "{words}");
    }

    #[test]
    fn times_are_measured_and_extrapolated() {
        let motion = "task: Dynamics(duration_ns: 1e4, time_step_ns: 0.001),";
        let (_, timing) = measured(ROD, motion);
        assert!(timing.steps >= 100 && timing.steps < 10_000_000);
        let total = timing.total_s.unwrap();
        assert!(total >= 1e7 * timing.step_s * (1.0 - 1e-9), "{timing:?}");
        let (_, still) = measured(ROD, "task: Equilibrium(),");
        assert!(still.total_s.is_some_and(|s| s > 0.0), "{still:?}");
        let unknown = Timing {
            total_s: None,
            ..still
        };
        assert!(
            unknown
                .to_string()
                .ends_with("per Newton step, measured here")
        );
    }
}

//! Comparison of overdamped time steps with steps of half the length.

use super::Estimate;
use crate::Assembly;
use actin_assembly::Part;
use actin_brownian::Brownian;
use actin_integrate::Stepper;
use actin_mechanics::{State, System};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;

/// Number of steps between comparisons. A comparison costs three steps.
const APART: u64 = 100;

/// Smallest number of comparisons for a result.
const FEWEST: f64 = 16.0;

/// Smallest reported relative difference.
const REPORTED: f64 = 0.02;

/// Smallest reported difference in standard errors.
const SIGNIFICANT: f64 = 4.0;

/// First number of steps of comparisons, which have their own noise.
const OWN_STEPS: u64 = 1 << 52;

/// Difference of the mean energy of a term between steps and steps of half the length.
///
/// The energies are compared after one step and after two half steps from the same states, each with its own noise.
/// A nonzero difference is an error of parts that relax within a step. Slower parts have smaller errors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StepError {
    /// Name of the term.
    pub term: String,
    /// Time step (ns).
    pub time_step_ns: f64,
    /// Mean difference over mean energy.
    pub relative_difference: f64,
    /// Standard error of the relative difference.
    pub standard_error: f64,
}

impl fmt::Display for StepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let percent = [self.relative_difference, self.standard_error].map(|value| 100.0 * value);
        write!(
            f,
            "time steps of {:.1e} ns change energies: after steps of half the length, the mean energy of the term {} differs \
             by {:+.1} ± {:.1} %; write a shorter time_step_ns",
            self.time_step_ns, self.term, percent[0], percent[1]
        )
    }
}

/// Sums over all comparisons of the energy (pN nm) of a term after a step, the difference for two half steps, and its
/// square.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Sums {
    energy: f64,
    difference: f64,
    square: f64,
}

/// Comparisons of a run so far, which checkpoints store.
///
/// Comparisons are grouped by the binary logarithm of their step, so that a longer run continues a shorter one.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct StepComparisons {
    groups: BTreeMap<u32, Group>,
}

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Group {
    count: f64,
    sums: BTreeMap<String, Sums>,
}

impl Group {
    fn add(&mut self, other: &Self) {
        self.count += other.count;
        for (term, one) in &other.sums {
            let sums = self.sums.entry(term.clone()).or_default();
            sums.energy += one.energy;
            sums.difference += one.difference;
            sums.square += one.square;
        }
    }
}

impl StepComparisons {
    /// Significant differences for a time step (ns), from the last two groups: half to three quarters of the run.
    pub(super) fn errors(&self, time_step_ns: f64) -> Vec<StepError> {
        let mut all = Group::default();
        for group in self.groups.values().rev().take(2) {
            all.add(group);
        }
        let n = all.count;
        if n < FEWEST {
            return Vec::new();
        }
        let errors = all.sums.iter().map(|(term, sums)| {
            let mean = sums.difference / n;
            let variance = (sums.square / n - mean * mean).max(0.0) / (n - 1.0);
            let energy = sums.energy / n;
            StepError {
                term: term.clone(),
                time_step_ns,
                relative_difference: mean / energy,
                standard_error: variance.sqrt() / energy,
            }
        });
        let is_reported = |error: &StepError| {
            let size = error.relative_difference.abs();
            size.is_finite() && size > REPORTED.max(SIGNIFICANT * error.standard_error)
        };
        errors.filter(is_reported).collect()
    }
}

/// Stepper of comparisons, which do not change the run.
pub(super) struct StepCheck<'a> {
    assembly: &'a Assembly,
    system: System,
    stepper: Brownian,
    time_step_ns: f64,
}

impl<'a> StepCheck<'a> {
    /// Creates the check with an own system, driven like the system of the run, and an own stepper.
    pub(super) fn new(
        assembly: &'a Assembly,
        estimate: &Estimate,
        (system, stepper): (System, Brownian),
    ) -> Self {
        Self {
            assembly,
            system,
            stepper,
            time_step_ns: estimate.time_step_ns,
        }
    }

    /// Compares after some of the steps.
    pub(super) fn compare(&mut self, state: &State, step: u64, comparisons: &mut StepComparisons) {
        if step == 0 || !step.is_multiple_of(APART) {
            return;
        }
        let h = self.time_step_ns;
        let own = OWN_STEPS + 3 * step;
        let whole = self.energies(state, &[own], h);
        let halves = self.energies(state, &[own + 1, own + 2], 0.5 * h);
        let (Some(whole), Some(halves)) = (whole, halves) else {
            return;
        };
        let group = comparisons.groups.entry(step.ilog2()).or_default();
        group.count += 1.0;
        for ((name, energy), other) in whole.into_iter().zip(halves.into_values()) {
            let difference = other - energy;
            let sums = group.sums.entry(name.to_owned()).or_default();
            sums.energy += energy;
            sums.difference += difference;
            sums.square += difference * difference;
        }
    }

    /// Energies of the terms (pN nm) after steps of length `h`; `None` if a step fails.
    fn energies(&mut self, state: &State, steps: &[u64], h: f64) -> Option<BTreeMap<&'a str, f64>> {
        self.system.state_mut().copy_motion_from(state);
        for &step in steps {
            self.stepper.step(&mut self.system, step, h).ok()?;
        }
        let mut all = BTreeMap::new();
        for (term, energy) in self.assembly.terms.iter().zip(self.system.energies()) {
            if !matches!(term.part, Part::Load(_) | Part::Clamp(_)) {
                *all.entry(term.name).or_default() += energy;
            }
        }
        Some(all)
    }
}

#[cfg(test)]
mod tests {
    use super::StepError;
    use crate::{Assembly, BOLTZMANN_PN_NM_PER_K, Plan, Record, Scene, Sink, Solve};
    use actin_mechanics::Loads;

    const FILAMENTS: usize = 20;
    const BLOCKS: usize = 20;

    /// Errors of a run of free filaments.
    fn errors(steps: f64, keys: &str) -> Vec<StepError> {
        let text = scene(steps, 1e4, keys);
        Scene::from_ron(&text)
            .unwrap()
            .solve()
            .unwrap()
            .outcome
            .step_errors
    }

    /// Free filaments in steps of `step_ns`, with more keys of the scene.
    fn scene(steps: f64, step_ns: f64, keys: &str) -> String {
        format!(
            "Scene(
                arrangements: [Copies(
                    filament: Filament(
                        sections: [Rod(from_nm: 0.0, to_nm: 200.0, segments: 2)], rod: RodModel(law: Constant),
                    ),
                    count: {FILAMENTS}, shift_nm: (0.0, 1000.0, 0.0),
                )],
                {keys}
                output: Output(vtk: false, states: false),
                task: Brownian(
                    duration_ms: {:?}, temperature_k: 298.0, time_step_ns: {step_ns:?}, record_every_ns: {step_ns:?},
                    seed: 1,
                ),
            )",
            steps * step_ns * 1e-6
        )
    }

    /// Filaments between walls: contacts have no random stress, so that long steps leave them cold.
    #[test]
    fn long_steps_at_walls_are_reported() {
        let walls = "repulsion: Repulsion(filaments: false, stiffness_pn_per_nm: 10.0, planes: [
            Plane(at_nm: (-5.0, 0.0, 0.0), normal: (1.0, 0.0, 0.0)),
            Plane(at_nm: (5.0, 0.0, 0.0), normal: (-1.0, 0.0, 0.0)),
        ]),";
        let long = errors(4e3, walls);
        assert!(
            long.iter().any(|error| error.term == "repulsion"),
            "{long:?}"
        );
        assert_eq!(errors(2.5e3, ""), []);
    }

    /// Mean force of a wall on each filament, over all records and two walls.
    struct Pressure<'a> {
        assembly: &'a Assembly,
        forces: Vec<f64>,
    }

    impl Sink for Pressure<'_> {
        fn record(&mut self, record: &Record) {
            let mut loads = Loads::zeros(&record.state);
            let walls = self.assembly.system.interactions().iter();
            for wall in walls.filter(|one| one.term() == "repulsion") {
                wall.add_loads(&record.state, &mut loads);
            }
            let forces = loads.force.x.iter().map(|force| force.abs());
            self.forces
                .push(forces.sum::<f64>() / (2 * FILAMENTS) as f64);
        }
    }

    /// Mean force of a wall on free filaments of 200 nm between walls, relative to the exact force of rigid filaments
    /// in short steps, and its standard error. The exact force is `kT / (w - L/2)` for filaments of the length `L`
    /// between walls at a distance `w` from which axes are reflected.
    fn pressure(steps: f64, step_ns: f64) -> (f64, f64) {
        let walls = "repulsion: Repulsion(filaments: false, planes: [
            Plane(at_nm: (-150.0, 0.0, 0.0), normal: (1.0, 0.0, 0.0)),
            Plane(at_nm: (150.0, 0.0, 0.0), normal: (-1.0, 0.0, 0.0)),
        ]),";
        let scene = Scene::from_ron(&scene(steps, step_ns, walls)).unwrap();
        let assembly = Assembly::build(&scene).unwrap();
        let mut pressure = Pressure {
            assembly: &assembly,
            forces: Vec::new(),
        };
        Plan::new(&assembly)
            .unwrap()
            .run_into(&mut pressure)
            .unwrap();
        let exact = 298.0 * BOLTZMANN_PN_NM_PER_K / (300.0 - 2.0 * 3.7 - 100.0);
        let size = pressure.forces.len() / BLOCKS;
        let blocks = pressure.forces.chunks_exact(size);
        let ratio = |block: &[f64]| block.iter().sum::<f64>() / (size as f64 * exact);
        let ratios: Vec<f64> = blocks.map(ratio).collect();
        let mean = ratios.iter().sum::<f64>() / BLOCKS as f64;
        let squares = ratios.iter().map(|ratio| (ratio - mean).powi(2));
        let variance = squares.sum::<f64>() / (BLOCKS * (BLOCKS - 1)) as f64;
        (mean, variance.sqrt())
    }

    /// Forces that have not converged would be too large.
    #[test]
    fn long_steps_do_not_raise_the_force_of_walls() {
        let (mean, error) = pressure(1e3, 1e4);
        assert!(mean < 1.0 + 3.0 * error && mean > 0.5, "{mean} +- {error}");
    }

    #[test]
    #[ignore = "takes minutes"]
    fn the_force_of_walls_depends_on_the_step() {
        for (step_ns, steps) in [(100.0, 60_000.0), (1e3, 20_000.0), (1e4, 10_000.0)] {
            let (mean, error) = pressure(steps, step_ns);
            println!("{step_ns} ns: {mean:.3} +- {error:.3} of the exact force");
            assert!((mean - 1.0).abs() < 3.0 * error + 0.25 * (step_ns * 1e-4).sqrt());
        }
    }
}

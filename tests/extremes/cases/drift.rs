//! Long undamped motion: energy without a trend, momenta to round-off.

use super::row::{Outcome, Row};
use super::stability::free;
use actin_integrate::{Drag, PEFRL, advance, largest_frequency, stable_step};
use actin_mechanics::System;
use actin_mechanics::testing::{Noise, momenta, set_in_motion};

/// Small filaments.
const FILAMENTS: [(&str, &str); 2] = [
    (
        "rod of 3 segments",
        "Rod(from_nm: 0.0, to_nm: 30.0, segments: 3)",
    ),
    ("4 monomers", "Ellipsoids(from_nm: 0.0, to_nm: 11.0)"),
];

/// What became of a run in tenths: means of the relative deviation of the energy, its largest
/// magnitude, and the relative change of momentum and angular momentum at the end.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Drift {
    pub(crate) means: [f64; 10],
    pub(crate) largest: f64,
    pub(crate) momenta: [f64; 2],
}

impl Drift {
    /// From the mean of the first three tenths to that of the last three.
    pub(crate) fn trend(&self) -> f64 {
        let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
        mean(&self.means[7..]) - mean(&self.means[..3])
    }

    /// Runs a system for `steps` steps at a quarter of the limit, its energy taken 1000 times.
    pub(crate) fn of(system: &mut System, steps: u64) -> Self {
        let frequency = largest_frequency(system).expect("loads at rest are finite");
        let h = stable_step(&PEFRL, frequency, 0.25).expect("it is positive");
        let start = system.total_energy();
        let before = momenta(system.state());
        let (mut means, mut largest) = ([0.0; 10], 0.0_f64);
        for mean in &mut means {
            for _ in 0..100 {
                advance(system, &PEFRL, h, steps / 1000, &Drag::NONE);
                let deviation = system.total_energy() / start - 1.0;
                *mean += deviation / 100.0;
                largest = largest.max(deviation.abs());
            }
        }
        let after = momenta(system.state());
        let change = [
            (after.0 - before.0).norm() / before.0.norm(),
            (after.1 - before.1).norm() / before.1.norm(),
        ];
        Self {
            means,
            largest,
            momenta: change,
        }
    }
}

/// Both filaments for `steps` steps.
pub(crate) fn rows(steps: u64) -> Vec<Row> {
    let mut rows = Vec::new();
    for (name, sections) in FILAMENTS {
        let mut push = |what: &str, outcome| {
            let case = format!("{name}, {steps:.0e} steps, {what}", steps = steps as f64);
            rows.push(Row::new("undamped", case, outcome));
        };
        let drift = match free(sections) {
            Ok(mut system) => {
                set_in_motion(system.state_mut(), &mut Noise::new(11), 2.0, 0.5);
                Drift::of(&mut system, steps)
            }
            Err(outcome) => {
                push("", outcome);
                continue;
            }
        };
        // The wavering of the energy is the yardstick of its trend.
        push(
            "trend of the energy",
            Outcome::correct(
                "means of the last and first three tenths",
                drift.trend().abs(),
                0.1 * drift.largest,
            ),
        );
        // Round-off adds up as a walk, and as a drift where it has a sign.
        let bound = 1e-16 * steps as f64;
        let [linear, angular] = drift.momenta;
        push(
            "momentum",
            Outcome::correct("relative change", linear, bound),
        );
        push(
            "angular momentum",
            Outcome::correct("relative change", angular, bound),
        );
    }
    rows
}

//! How the energy of a run fares.

use actin_integrate::{Drag, PEFRL, advance};
use actin_mechanics::{State, System};

/// The relative deviation of the energy from its start, over ten equal parts of a run.
#[derive(Clone, Debug)]
pub(crate) struct EnergyRecord {
    /// Means.
    means: [f64; 10],
    /// Largest magnitudes.
    largest: [f64; 10],
    /// Sum of the squares of all 2000.
    squares: f64,
}

impl EnergyRecord {
    /// Runs PEFRL for `steps` steps of `h` (ns), with the energy taken 2000 times, at each of
    /// which `look` sees the state. The energy counts from the filament at rest, so that it is
    /// all energy of motion and strain.
    pub(crate) fn of(
        system: &mut System,
        h: f64,
        steps: u64,
        mut look: impl FnMut(&State),
    ) -> Self {
        let start = system.total_energy();
        let mut record = Self {
            means: [0.0; 10],
            largest: [0.0; 10],
            squares: 0.0,
        };
        for (mean, largest) in record.means.iter_mut().zip(&mut record.largest) {
            for _ in 0..200 {
                advance(system, &PEFRL, h, steps / 2000, &Drag::NONE);
                let deviation = system.total_energy() / start - 1.0;
                // A state that has exploded must not pass as one that is not compared.
                let deviation = if deviation.is_nan() {
                    f64::INFINITY
                } else {
                    deviation
                };
                *mean += deviation / 200.0;
                *largest = largest.max(deviation.abs());
                record.squares += deviation * deviation;
                look(system.state());
            }
        }
        record
    }

    /// Largest deviation of all.
    pub(crate) fn wander(&self) -> f64 {
        self.largest.iter().copied().fold(0.0, f64::max)
    }

    /// Root mean square of the deviation.
    pub(crate) fn rms(&self) -> f64 {
        (self.squares / 2000.0).sqrt()
    }

    /// Largest deviation over the first three tenths.
    pub(crate) fn early(&self) -> f64 {
        self.largest[..3].iter().copied().fold(0.0, f64::max)
    }

    /// How far the mean moved from the first three tenths to the last three.
    pub(crate) fn trend(&self) -> f64 {
        let mean = |part: &[f64]| part.iter().sum::<f64>() / 3.0;
        mean(&self.means[7..]) - mean(&self.means[..3])
    }

    /// One line for a table.
    pub(crate) fn line(&self) -> String {
        format!(
            "largest {:.1e} (first three tenths {:.1e}), rms {:.1e}, trend of the mean {:+.1e}",
            self.wander(),
            self.early(),
            self.rms(),
            self.trend()
        )
    }
}

/// Numbers in a row, two digits each.
pub(crate) fn scientific(numbers: &[f64]) -> String {
    let words: Vec<String> = numbers.iter().map(|n| format!("{n:.1e}")).collect();
    words.join(" ")
}

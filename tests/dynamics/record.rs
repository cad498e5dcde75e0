//! Energy statistics of a run.

use actin_integrate::{Drag, PEFRL, advance};
use actin_mechanics::{State, System};

/// Relative deviation of the energy from its start in ten equal parts of a run.
#[derive(Clone, Debug)]
pub(crate) struct EnergyRecord {
    means: [f64; 10],
    largest: [f64; 10],
    squares: f64,
}

impl EnergyRecord {
    /// Runs PEFRL for `steps` steps of `h` (ns) and samples the energy 2000 times, calling `look`
    /// for each state. The energy is relative to the filament at rest.
    pub(crate) fn new(
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

    pub(crate) fn wander(&self) -> f64 {
        self.largest.iter().copied().fold(0.0, f64::max)
    }

    pub(crate) fn rms(&self) -> f64 {
        (self.squares / 2000.0).sqrt()
    }

    pub(crate) fn early(&self) -> f64 {
        self.largest[..3].iter().copied().fold(0.0, f64::max)
    }

    pub(crate) fn trend(&self) -> f64 {
        let mean = |part: &[f64]| part.iter().sum::<f64>() / 3.0;
        mean(&self.means[7..]) - mean(&self.means[..3])
    }

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

pub(crate) fn scientific(numbers: &[f64]) -> String {
    let words: Vec<String> = numbers.iter().map(|n| format!("{n:.1e}")).collect();
    words.join(" ")
}

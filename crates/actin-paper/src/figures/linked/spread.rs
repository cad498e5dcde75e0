//! How far equilibria of one filament, resolved in several ways, lie apart.

use super::case::{Figure, Variant};
use super::solve::{Balance, Outcome};

/// Spreads over resolutions.
#[derive(Clone, Debug)]
pub(super) struct Spread {
    /// Largest and smallest energy (pN nm), and the resolutions that have them.
    pub energies: [(f64, String); 2],
    /// Their difference over the mean of all.
    pub energy: f64,
    /// Largest distance of two centre lines at equal arc length (nm), and which and where.
    pub node: f64,
    pub farthest: String,
    /// Largest difference of a linker's pull over its mean, over the linkers.
    pub force: f64,
    /// Smallest and largest turn of the middle (deg).
    pub roll: (f64, f64),
    pub resolutions: usize,
}

impl Spread {
    /// The spread of one variant and seed over the mixed resolutions, or over all.
    pub(super) fn over(
        outcomes: &[Outcome],
        figure: &Figure,
        variant: Variant,
        seed: u64,
        with_pure: bool,
    ) -> Self {
        let chosen: Vec<(String, &Balance)> = outcomes
            .iter()
            .filter(|o| o.case.figure.id == figure.id && o.case.variant == variant)
            .filter(|o| o.case.seed == seed && (with_pure || o.case.is_mixed()))
            .map(|o| (o.case.name(), &o.lowest))
            .collect();
        Self::of(&chosen)
    }

    fn of(chosen: &[(String, &Balance)]) -> Self {
        let by_energy =
            |a: &&(String, &Balance), b: &&(String, &Balance)| a.1.energy.total_cmp(&b.1.energy);
        let some = "there are resolutions to compare";
        let highest = chosen.iter().max_by(by_energy).expect(some);
        let lowest = chosen.iter().min_by(by_energy).expect(some);
        let linkers = 0..lowest.1.forces.len();
        let forces = linkers.map(|k| relative(chosen, |b| b.forces[k]));
        let (node, farthest) = farthest(chosen);
        let rolls = || chosen.iter().map(|(_, b)| b.roll);
        Self {
            energies: [highest, lowest].map(|(name, b)| (b.energy, name.clone())),
            energy: relative(chosen, |b| b.energy),
            node,
            farthest,
            force: forces.fold(0.0, f64::max),
            roll: (
                rolls().fold(f64::INFINITY, f64::min),
                rolls().fold(0.0, f64::max),
            ),
            resolutions: chosen.len(),
        }
    }

    /// Difference of the largest and the smallest energy (pN nm).
    pub(super) fn energy_range(&self) -> f64 {
        self.energies[0].0 - self.energies[1].0
    }
}

/// Largest minus smallest value over the mean of all.
fn relative(chosen: &[(String, &Balance)], value: impl Fn(&Balance) -> f64) -> f64 {
    let values = || chosen.iter().map(|(_, b)| value(b));
    let largest = values().fold(f64::NEG_INFINITY, f64::max);
    let smallest = values().fold(f64::INFINITY, f64::min);
    (largest - smallest) / (values().sum::<f64>() / chosen.len() as f64)
}

/// The two centre lines farthest apart: their distance (nm), and which they are and where.
fn farthest(chosen: &[(String, &Balance)]) -> (f64, String) {
    let mut worst = (0.0, String::new());
    for (i, (one, a)) in chosen.iter().enumerate() {
        for (other, b) in &chosen[..i] {
            let (distance, s) = a.centre_line.farthest_from(&b.centre_line);
            if distance > worst.0 {
                worst = (distance, format!("{other} and {one} at s = {s:.0} nm"));
            }
        }
    }
    worst
}

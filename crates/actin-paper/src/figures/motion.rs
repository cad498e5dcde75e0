//! Frequency, decay rate and energies of damped motions.

use super::draft::Draft;
use crate::statistics::largest;

#[derive(Clone, Copy, Debug)]
pub(super) struct RingDown {
    /// Angular frequency (rad/ns).
    pub frequency_rad_per_ns: f64,
    /// Decay rate of the amplitude (1/ns).
    pub decay_per_ns: f64,
}

const MOST_EXTREMA: usize = 8;

/// Frequency and decay rate from the extrema of `approach` (time, value) about the equilibrium `end`.
///
/// Extrema of a damped oscillation are half a period apart and decrease by `exp(-decay T/2)`. The first and the last
/// extremum determine both numbers. Faster modes can cause several extrema between two zero crossings, of which the
/// largest is used. Returns `None` for fewer than three extrema.
pub(super) fn ring_down(approach: &[(f64, f64)], end: f64) -> Option<RingDown> {
    let all = approach
        .windows(3)
        .filter(|w| (w[1].1 - w[0].1) * (w[2].1 - w[1].1) < 0.0)
        .map(vertex);
    let mut extrema: Vec<(f64, f64)> = Vec::new();
    for one in all {
        match extrema.last_mut() {
            Some(last) if (last.1 - end) * (one.1 - end) > 0.0 => {
                if (one.1 - end).abs() > (last.1 - end).abs() {
                    *last = one;
                }
            }
            _ => extrema.push(one),
        }
    }
    extrema.truncate(MOST_EXTREMA);
    let (first, last) = (extrema.first()?, extrema.last()?);
    let halves = extrema.len().checked_sub(1).filter(|n| *n >= 2)? as f64;
    let time = last.0 - first.0;
    let shrinkage = ((first.1 - end) / (last.1 - end)).abs().ln();
    Some(RingDown {
        frequency_rad_per_ns: std::f64::consts::PI * halves / time,
        decay_per_ns: shrinkage / time,
    })
}
/// Vertex of the parabola through three equidistant points.
fn vertex(w: &[(f64, f64)]) -> (f64, f64) {
    let h = w[1].0 - w[0].0;
    let slope = 0.5 * (w[2].1 - w[0].1);
    let bend = w[2].1 - 2.0 * w[1].1 + w[0].1;
    let t = -slope / bend;
    (w[1].0 + t * h, w[1].1 + 0.5 * t * slope)
}

/// Adds the claim that energies decay, without a verdict, because drag always removes energy.
pub(super) fn energy_decays(draft: &mut Draft<'_>, motions: &[Vec<f64>]) {
    if motions.is_empty() {
        return;
    }
    let statement = format!(
        "energies decay as the filaments approach equilibrium; largest rise of kinetic and potential energy \
         (loads included) between two records, divided by the energy loss of the motion; {} motions",
        motions.len()
    );
    let ours = largest(motions.iter().map(|motion| largest_rise(motion)));
    draft.claim("energy_decays", ours, None, statement);
}

/// Largest rise between neighbours, divided by the difference between first and last value.
fn largest_rise(energies: &[f64]) -> f64 {
    let lost = (energies[0] - energies[energies.len() - 1]).abs();
    largest(energies.windows(2).map(|pair| pair[1] - pair[0])) / lost
}

#[cfg(test)]
mod tests {
    use super::{largest_rise, ring_down};

    #[test]
    fn damped_oscillation_is_recovered() {
        let (omega, decay) = (0.17, 0.025);
        let approach: Vec<(f64, f64)> = (0..2000)
            .map(|k| 1.2 * f64::from(k))
            .map(|t| (t, 60.0 * (1.0 - (-decay * t).exp() * (omega * t).cos())))
            .collect();
        let ring = ring_down(&approach, 60.0).unwrap();
        assert!((ring.frequency_rad_per_ns - omega).abs() < 1e-3 * omega);
        assert!((ring.decay_per_ns - decay).abs() < 5e-3 * decay);
    }

    /// A superposed faster mode adds extrema.
    #[test]
    fn fast_modes_are_ignored() {
        let (omega, decay) = (0.17, 0.025);
        let approach: Vec<(f64, f64)> = (0..1000)
            .map(|k| 0.5 * f64::from(k))
            .map(|t| {
                let fast = 0.4 * (-0.3 * decay * t).exp() * (13.7 * omega * t).sin();
                (
                    t,
                    60.0 * (1.0 - (-decay * t).exp() * (omega * t).cos()) + fast,
                )
            })
            .collect();
        let ring = ring_down(&approach, 60.0).unwrap();
        assert!((ring.frequency_rad_per_ns - omega).abs() < 0.03 * omega);
    }

    #[test]
    fn monotone_approach_has_no_oscillation() {
        let approach: Vec<(f64, f64)> = (0..50)
            .map(|k| (f64::from(k), 1.0 - (-0.1 * f64::from(k)).exp()))
            .collect();
        assert!(ring_down(&approach, 1.0).is_none());
    }

    /// Rise of 0.4 during a loss of 8: ratio 0.05.
    #[test]
    fn rise_is_relative_to_loss() {
        assert!((largest_rise(&[10.0, 3.0, 3.4, 2.0]) - 0.05).abs() < 1e-15);
        assert!(largest_rise(&[10.0, 3.0, 2.0]).abs() < 1e-15);
    }
}

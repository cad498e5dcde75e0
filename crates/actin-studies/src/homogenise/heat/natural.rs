//! The straight filament at a temperature with free length, and free or prescribed twist.

use super::heat;
use actin_paper::cells::twisted;
use actin_sim::ellipsoid::{Cell, Control, Displacements, HeatResponse, SixVector};

/// Number of samples of each Newton step. The last step leaves an error of 5e-5 in stretch.
const SAMPLES: [usize; 3] = [200, 400, 1600];
/// Largest Newton step of twist (rad/nm) and stretch.
const LONGEST: f64 = 5e-3;

pub(super) struct Natural {
    pub(super) twist: f64,
    pub(super) stretch: f64,
    pub(super) displacements: Displacements,
}

/// Finds the strain at which the tension and, without a given twist, the twisting torque vanish. Uses Newton's method
/// with the sampled tangent, starting from the relaxed cell; `stream` is the first random stream.
pub(super) fn natural(
    cell: &Cell,
    kt: f64,
    twist: Option<f64>,
    stream: u64,
) -> Result<Natural, String> {
    let relaxed = twisted(cell, twist.unwrap_or(0.0))?;
    let mut natural = Natural {
        twist: relaxed.strain[2],
        stretch: relaxed.strain[5],
        displacements: relaxed.displacements,
    };
    for (samples, number) in SAMPLES.into_iter().zip(stream..) {
        let response = straight(cell, kt, &natural, samples, number)?;
        let (loads, t) = (&response.loads, &response.tangent);
        let limited = |step: f64| step.clamp(-LONGEST, LONGEST);
        if twist.is_some() {
            natural.stretch -= limited(loads[5] / t[(5, 5)]);
        } else {
            let determinant = t[(2, 2)] * t[(5, 5)] - t[(2, 5)] * t[(2, 5)];
            let by_twist = (loads[2] * t[(5, 5)] - loads[5] * t[(2, 5)]) / determinant;
            let by_stretch = (loads[5] * t[(2, 2)] - loads[2] * t[(2, 5)]) / determinant;
            natural.twist -= limited(by_twist);
            natural.stretch -= limited(by_stretch);
        }
        natural.displacements = response.displacements;
    }
    Ok(natural)
}

pub(super) fn straight(
    cell: &Cell,
    kt: f64,
    at: &Natural,
    samples: usize,
    stream: u64,
) -> Result<HeatResponse, String> {
    let strain = SixVector::new(0.0, 0.0, at.twist, 0.0, 0.0, at.stretch);
    let controls = std::array::from_fn(|k| Control::Strain(strain[k]));
    let start = Some((&strain, &at.displacements));
    cell.sample(&controls, &heat(kt, samples, stream), start)
        .map_err(|e| e.to_string())
}

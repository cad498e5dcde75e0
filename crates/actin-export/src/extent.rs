//! Size of the simulation box.

use crate::{Particles, RecordedStates};
use std::io;

/// Smallest edge of the box (nm), for runs in a plane or along a line.
const LEAST_NM: f64 = 10.0;

/// Returns the edges of a box centred at the lab origin that contains all particles of all records (nm).
///
/// Each edge is four times the largest coordinate plus radius. Two particles are then less than half an edge apart,
/// so that periodic minimum images do not change distances.
///
/// # Errors
/// If the states cannot be read.
pub(crate) fn edges_nm(
    states: &dyn RecordedStates,
    particles: &Particles<'_>,
) -> io::Result<[f64; 3]> {
    let radii = particles.species.iter().map(|s| s.shape.radius_nm());
    let radius = radii.fold(0.0, f64::max);
    let mut farthest = [0.0_f64; 3];
    for state in states.states() {
        for place in particles.places(&*state?) {
            for (most, x) in farthest.iter_mut().zip(place.iter()) {
                *most = most.max(x.abs());
            }
        }
    }
    Ok(farthest.map(|most| (4.0 * (most + radius)).max(LEAST_NM)))
}

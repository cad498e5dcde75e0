//! How much room a run takes.

use crate::{ExportError, Particles};
use actin_sim::FinishedRun;

/// Least extent of a box (nm), for a run that moves in a plane or along a line.
const LEAST_NM: f64 = 10.0;

/// Edges of the box about the lab origin that holds all particles of all records (nm).
///
/// Each is four times the largest coordinate and radius, so that no two particles are farther apart than half
/// of it: programs that take the box for periodic find no shorter way between them.
///
/// # Errors
/// States that cannot be read.
pub(crate) fn edges_nm(
    run: &FinishedRun,
    particles: &Particles<'_>,
) -> Result<[f64; 3], ExportError> {
    let radii = particles.species.iter().map(|s| s.shape.radius_nm());
    let radius = radii.fold(0.0, f64::max);
    let mut farthest = [0.0_f64; 3];
    for state in run.states()? {
        for place in particles.places(&state?) {
            for (most, x) in farthest.iter_mut().zip(place.iter()) {
                *most = most.max(x.abs());
            }
        }
    }
    Ok(farthest.map(|most| (4.0 * (most + radius)).max(LEAST_NM)))
}

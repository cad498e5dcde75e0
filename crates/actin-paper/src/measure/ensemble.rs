//! Averages over bond samplings of one filament.

use super::sweep::Curve;
use super::{MeasureError, Specimen};
use crate::statistics::SampleStatistics;
use rayon::prelude::*;

/// Measures every sampling at each azimuth (deg) of a transverse load, in parallel. Results are in
/// the order of the seeds; results of one sampling are contiguous.
///
/// # Errors
/// The first error of `measure` in the order of the seeds. Quadrature bonds accept only seed 0.
pub fn over_samplings_and_azimuths<T: Send>(
    specimen: &Specimen,
    seeds: &[u64],
    azimuths_deg: &[f64],
    measure: impl Fn(&Specimen, f64) -> Result<T, MeasureError> + Sync,
) -> Result<Vec<T>, MeasureError> {
    let cases = seeds
        .iter()
        .flat_map(|&seed| azimuths_deg.iter().map(move |&at| (seed, at)));
    let cases: Vec<(u64, f64)> = cases.collect();
    let measured = cases.par_iter().map(|&(seed, azimuth_deg)| {
        let mut sampling = specimen.clone();
        sampling.filament.monomers.seed = seed;
        measure(&sampling, azimuth_deg)
    });
    measured.collect::<Vec<_>>().into_iter().collect()
}

/// Mean and scatter of `measured` at each value of `prescribed` in the curves, in ascending order.
/// Values of `prescribed` with a relative difference below 1e-9 are equal.
///
/// Curves that ended early reduce the count.
pub fn sampled_by<P>(
    curves: &[Curve<P>],
    prescribed: impl Fn(&P) -> f64,
    measured: impl Fn(&P) -> f64,
) -> Vec<(f64, SampleStatistics)> {
    let points = curves.iter().flat_map(|curve| &curve.points);
    let mut pairs: Vec<(f64, f64)> = points.map(|p| (prescribed(p), measured(p))).collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    pairs
        .chunk_by(|a, b| (b.0 - a.0).abs() <= 1e-9 * a.0.abs())
        .map(|same| {
            (
                same[0].0,
                SampleStatistics::from_values(same.iter().map(|pair| pair.1)),
            )
        })
        .collect()
}

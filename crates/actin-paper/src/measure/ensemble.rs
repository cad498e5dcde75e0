//! Averages over bond samplings of one filament.

use super::sweep::Curve;
use super::{MeasureError, Specimen};
use rayon::prelude::*;

/// Mean and scatter of a quantity over specimens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleStatistics {
    /// Arithmetic mean; NaN without values.
    pub mean: f64,
    /// Standard deviation of a single value, `sqrt(sum (x - mean)^2 / (n - 1))`; NaN for fewer than
    /// two values.
    pub deviation: f64,
    /// Standard error of the mean of independent values, `deviation / sqrt(n)`.
    pub error: f64,
    /// Number of values.
    pub count: usize,
}

impl SampleStatistics {
    /// Computes mean and scatter of `values`.
    ///
    /// ```
    /// let sampled = actin_paper::measure::SampleStatistics::from_values([1.0, 3.0]);
    /// assert_eq!((sampled.mean, sampled.count), (2.0, 2));
    /// assert!((sampled.deviation - 2.0_f64.sqrt()).abs() < 1e-15 && sampled.error == 1.0);
    /// ```
    pub fn from_values(values: impl IntoIterator<Item = f64>) -> Self {
        let values: Vec<f64> = values.into_iter().collect();
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let squares: f64 = values.iter().map(|x| (x - mean).powi(2)).sum();
        // The quotient is 0 / 0 for one value and 0 / -1 for none, where the mean is NaN.
        let deviation = (squares / (n - 1.0)).sqrt();
        Self {
            mean,
            deviation,
            error: deviation / n.sqrt(),
            count: values.len(),
        }
    }
}

/// Measures specimens that differ only in the seed of their bonds, in parallel. Results are in the
/// order of the seeds.
///
/// # Errors
/// The first error of `measure` in the order of the seeds. Quadrature bonds accept only seed 0.
pub fn over_samplings<T: Send>(
    specimen: &Specimen,
    seeds: &[u64],
    measure: impl Fn(&Specimen) -> Result<T, MeasureError> + Sync,
) -> Result<Vec<T>, MeasureError> {
    let measured: Vec<_> = seeds
        .par_iter()
        .map(|&seed| {
            let mut sampling = specimen.clone();
            sampling.filament.monomers.seed = seed;
            measure(&sampling)
        })
        .collect();
    measured.into_iter().collect()
}

/// Measures every sampling at each azimuth (deg) of a transverse load, in parallel over samplings.
/// Curves of one sampling are contiguous.
///
/// # Errors
/// The first error of `measure`, in the order of the seeds.
pub fn over_samplings_and_azimuths<P: Send>(
    specimen: &Specimen,
    seeds: &[u64],
    azimuths_deg: &[f64],
    measure: impl Fn(&Specimen, f64) -> Result<Curve<P>, MeasureError> + Sync,
) -> Result<Vec<Curve<P>>, MeasureError> {
    let curves = over_samplings(specimen, seeds, |sampling| {
        let at = azimuths_deg
            .iter()
            .map(|&azimuth| measure(sampling, azimuth));
        at.collect::<Result<Vec<_>, _>>()
    })?;
    Ok(curves.into_iter().flatten().collect())
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

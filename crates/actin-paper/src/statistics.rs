//! Mean, scatter and range of samples.

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sample {
    pub count: usize,
    pub mean: f64,
    /// Standard deviation of a single value, from `count - 1` degrees of freedom; 0 for one value.
    pub sd: f64,
    pub low: f64,
    pub high: f64,
}

impl Sample {
    /// Largest minus smallest value.
    pub(crate) fn range(&self) -> f64 {
        self.high - self.low
    }

    /// [`Self::range`] over the mean.
    pub(crate) fn spread(&self) -> f64 {
        self.range() / self.mean
    }
}

/// The statistics of `values`; NaN without values.
pub(crate) fn sample(values: impl IntoIterator<Item = f64>) -> Sample {
    let values: Vec<f64> = values.into_iter().collect();
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
    Sample {
        count: values.len(),
        mean,
        sd: (squares / (n - 1.0).max(1.0)).sqrt(),
        low: values.iter().copied().fold(f64::NAN, f64::min),
        high: values.iter().copied().fold(f64::NAN, f64::max),
    }
}

/// Root mean square; NaN without values.
pub(crate) fn rms(values: impl IntoIterator<Item = f64>) -> f64 {
    let (count, sum) = values
        .into_iter()
        .fold((0.0, 0.0), |(n, sum), v| (n + 1.0, sum + v * v));
    f64::sqrt(sum / count)
}

/// Largest of non-negative values; 0 without values.
pub(crate) fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::{rms, sample};

    #[test]
    fn by_hand() {
        let s = sample([1.0, 2.0, 3.0, 6.0]);
        assert_eq!((s.count, s.mean, s.low, s.high), (4, 3.0, 1.0, 6.0));
        assert!((s.sd - f64::sqrt(14.0 / 3.0)).abs() < 1e-15);
        assert!((s.spread() - 5.0 / 3.0).abs() < 1e-15);
        assert!(sample([2.0]).sd.abs() < 1e-15);
        assert!((rms([3.0, -4.0]) - f64::sqrt(12.5)).abs() < 1e-15);
    }
}

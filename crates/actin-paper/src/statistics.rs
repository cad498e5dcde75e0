//! Mean, scatter and range of samples.

/// Mean, scatter and range of a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleStatistics {
    /// Arithmetic mean; NaN without values.
    pub mean: f64,
    /// Standard deviation of a single value, `sqrt(sum (x - mean)^2 / (n - 1))`; NaN for fewer than
    /// two values.
    pub deviation: f64,
    /// Standard error of the mean of independent values, `deviation / sqrt(n)`.
    pub error: f64,
    /// Smallest and largest value; NaN without values.
    pub low: f64,
    /// See [`Self::low`].
    pub high: f64,
    /// Number of values.
    pub count: usize,
}

impl SampleStatistics {
    /// Computes the statistics of `values`.
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
            low: values.iter().copied().fold(f64::NAN, f64::min),
            high: values.iter().copied().fold(f64::NAN, f64::max),
            count: values.len(),
        }
    }

    /// Standard deviation of a single value; 0 for fewer than two values.
    pub(crate) fn sd(&self) -> f64 {
        if self.count < 2 { 0.0 } else { self.deviation }
    }

    /// Largest minus smallest value.
    pub(crate) fn range(&self) -> f64 {
        self.high - self.low
    }

    /// [`Self::range`] over the mean.
    pub(crate) fn spread(&self) -> f64 {
        self.range() / self.mean
    }
}

/// The statistics of `values`.
pub(crate) fn sample(values: impl IntoIterator<Item = f64>) -> SampleStatistics {
    SampleStatistics::from_values(values)
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

/// Distinct values in order of occurrence.
pub(crate) fn distinct<T: PartialEq>(values: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut all = Vec::new();
    for value in values {
        if !all.contains(&value) {
            all.push(value);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::{rms, sample};

    #[test]
    fn by_hand() {
        let s = sample([1.0, 2.0, 3.0, 6.0]);
        assert_eq!((s.count, s.mean, s.low, s.high), (4, 3.0, 1.0, 6.0));
        assert!((s.sd() - f64::sqrt(14.0 / 3.0)).abs() < 1e-15);
        assert!((s.spread() - 5.0 / 3.0).abs() < 1e-15);
        assert!(sample([2.0]).sd().abs() < 1e-15);
        assert!((rms([3.0, -4.0]) - f64::sqrt(12.5)).abs() < 1e-15);
    }
}

//! Normal random numbers.

use crate::stream::Stream;

/// Separates these streams from the streams of bonds.
const MOTION: u64 = u64::MAX;

#[derive(Clone, Debug)]
pub(super) struct Normal {
    stream: Stream,
    spare: Option<f64>,
}

impl Normal {
    pub(super) fn new(seed: u64, number: u64) -> Self {
        Self {
            stream: Stream::new(seed, MOTION, number),
            spare: None,
        }
    }

    /// # Source
    /// Polar method of Marsaglia and Bray, SIAM Review 6 (1964) 260.
    pub(super) fn next(&mut self) -> f64 {
        if let Some(spare) = self.spare.take() {
            return spare;
        }
        loop {
            let u = 2.0 * self.uniform() - 1.0;
            let v = 2.0 * self.uniform() - 1.0;
            let s = u * u + v * v;
            if s > 0.0 && s < 1.0 {
                let scale = (-2.0 * s.ln() / s).sqrt();
                self.spare = Some(v * scale);
                return u * scale;
            }
        }
    }

    pub(super) fn uniform(&mut self) -> f64 {
        self.stream.uniform()
    }
}

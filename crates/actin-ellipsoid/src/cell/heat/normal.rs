//! Normal random numbers of a keyed stream.

use crate::stream::Stream;

/// Keeps the streams of motion apart from those of bonds.
const MOTION: u64 = u64::MAX;

/// Independent numbers of mean 0 and variance 1.
#[derive(Clone, Debug)]
pub(super) struct Normal {
    stream: Stream,
    spare: Option<f64>,
}

impl Normal {
    /// Those of stream `number` of a seed.
    pub(super) fn new(seed: u64, number: u64) -> Self {
        Self {
            stream: Stream::new(seed, MOTION, number),
            spare: None,
        }
    }

    /// The next one.
    ///
    /// # Source
    /// The polar method of Marsaglia and Bray, SIAM Review 6 (1964) 260.
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

    /// A number uniform in [0, 1).
    pub(super) fn uniform(&mut self) -> f64 {
        self.stream.uniform()
    }
}

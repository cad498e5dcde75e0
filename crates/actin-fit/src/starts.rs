//! Where searches start: points given by hand, and points drawn within bounds.

use crate::bounds::Bounds;
use crate::error::FitError;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Where the searches of a nonlinear fit start.
///
/// ```
/// use actin_fit::{Bounds, Starts};
///
/// let bounds = Bounds::new(&[(0.0, 4.0)])?;
/// let mut drawn = Starts::drawn(4, 7).points(&bounds)?;
/// drawn.sort_by(|a, b| a[0].total_cmp(&b[0]));
/// // One in each quarter of the range.
/// let quarters: Vec<f64> = drawn.iter().map(|p| p[0].floor()).collect();
/// assert_eq!(quarters, [0.0, 1.0, 2.0, 3.0]);
/// # Ok::<(), actin_fit::FitError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Starts {
    given: Vec<Vec<f64>>,
    drawn: usize,
    seed: u64,
}

impl Starts {
    /// One start, given by hand.
    pub fn at(parameters: &[f64]) -> Self {
        Self {
            given: vec![parameters.to_vec()],
            drawn: 0,
            seed: 0,
        }
    }

    /// `count` starts of a Latin hypercube within the bounds: each parameter has one value in each
    /// of `count` equal parts of its range, in an order drawn with the seed.
    ///
    /// The starts are the same on every machine.
    ///
    /// # Source
    /// `McKay`, Beckman and Conover, Technometrics 21 (1979) 239.
    pub fn drawn(count: usize, seed: u64) -> Self {
        Self {
            given: Vec::new(),
            drawn: count,
            seed,
        }
    }

    /// These starts and one more, given by hand. Those given by hand come first.
    #[must_use]
    pub fn and_at(mut self, parameters: &[f64]) -> Self {
        self.given.push(parameters.to_vec());
        self
    }

    /// These starts and `count` drawn ones; see [`drawn`](Self::drawn).
    #[must_use]
    pub fn and_drawn(self, count: usize, seed: u64) -> Self {
        Self {
            drawn: count,
            seed,
            ..self
        }
    }

    /// The starts.
    ///
    /// # Errors
    /// If one does not fit the bounds, starts are to be drawn and a bound is infinite, or there is
    /// none.
    pub fn points(&self, bounds: &Bounds) -> Result<Vec<Vec<f64>>, FitError> {
        let mut points = self.given.clone();
        for (number, point) in points.iter().enumerate() {
            bounds.check(number, point)?;
        }
        if self.drawn > 0 {
            points.extend(latin_hypercube(self.drawn, self.seed, bounds)?);
        }
        if points.is_empty() {
            return Err(FitError::NoStart);
        }
        Ok(points)
    }
}

fn latin_hypercube(count: usize, seed: u64, bounds: &Bounds) -> Result<Vec<Vec<f64>>, FitError> {
    let mut generator = ChaCha8Rng::from_seed(key(seed));
    let mut points = vec![vec![0.0; bounds.len()]; count];
    for parameter in 0..bounds.len() {
        let (lower, upper) = (bounds.lower(parameter), bounds.upper(parameter));
        if !bounds.width(parameter).is_finite() {
            return Err(FitError::Unbounded {
                parameter,
                lower,
                upper,
            });
        }
        let order = shuffled(count, &mut generator);
        for (point, part) in points.iter_mut().zip(order) {
            let fraction = (part as f64 + uniform(&mut generator)) / count as f64;
            // Rounding must not carry a start across its bound.
            point[parameter] = (lower + fraction * (upper - lower)).clamp(lower, upper);
        }
    }
    Ok(points)
}

/// The seed, little endian, then zeros: independent of any generator's way to stretch a seed.
fn key(seed: u64) -> [u8; 32] {
    let mut key = [0; 32];
    key[..8].copy_from_slice(&seed.to_le_bytes());
    key
}

/// Uniform in [0, 1): the upper 53 bits of a 64-bit draw.
fn uniform(generator: &mut ChaCha8Rng) -> f64 {
    const SPACING: f64 = 1.0 / (1u64 << 53) as f64;
    (generator.next_u64() >> 11) as f64 * SPACING
}

/// `0 .. count` in random order (Fisher and Yates), from 64-bit draws on every machine.
fn shuffled(count: usize, generator: &mut ChaCha8Rng) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    for last in (1..count).rev() {
        let product = u128::from(generator.next_u64()) * (last as u128 + 1);
        let other = usize::try_from(product >> 64).expect("at most `last`, which is a usize");
        order.swap(last, other);
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fixed for good: another generator, key or conversion would change every seeded fit.
    #[test]
    fn starts_are_those_of_the_first_release() {
        let bounds = Bounds::new(&[(-1.0, 1.0), (0.0, 10.0)]).unwrap();
        let points = Starts::drawn(3, 11).points(&bounds).unwrap();
        assert_eq!(points, GOLDEN);
    }

    const GOLDEN: [[f64; 2]; 3] = [
        [0.058_395_505_091_662_25, 8.332_562_571_592_515],
        [0.872_951_039_364_412_9, 1.270_607_859_306_775_1],
        [-0.404_180_699_721_771_3, 4.604_074_096_817_054],
    ];
}

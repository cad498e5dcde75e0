use crate::bounds::Bounds;
use crate::error::FitError;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Starting points of the searches of a nonlinear fit.
///
/// ```
/// use actin_fit::{Bounds, Starts};
///
/// let bounds = Bounds::new(&[(0.0, 4.0)])?;
/// let mut drawn = Starts::random(4, 7).points(&bounds)?;
/// drawn.sort_by(|a, b| a[0].total_cmp(&b[0]));
/// // One start in each quarter of the range.
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
    /// Creates one explicit start.
    pub fn at(parameters: &[f64]) -> Self {
        Self {
            given: vec![parameters.to_vec()],
            drawn: 0,
            seed: 0,
        }
    }

    /// Creates `count` random starts by Latin hypercube sampling within the bounds: each parameter
    /// takes one value in each of `count` equal parts of its range.
    ///
    /// The starts depend on the seed only and are the same on every machine.
    ///
    /// # Source
    /// `McKay`, Beckman and Conover, Technometrics 21 (1979) 239.
    pub fn random(count: usize, seed: u64) -> Self {
        Self {
            given: Vec::new(),
            drawn: count,
            seed,
        }
    }

    /// Adds an explicit start. Explicit starts precede random ones.
    #[must_use]
    pub fn and_at(mut self, parameters: &[f64]) -> Self {
        self.given.push(parameters.to_vec());
        self
    }

    /// Adds `count` random starts; see [`random`](Self::random).
    #[must_use]
    pub fn and_random(self, count: usize, seed: u64) -> Self {
        Self {
            drawn: count,
            seed,
            ..self
        }
    }

    /// Starting points within the given bounds.
    ///
    /// # Errors
    /// If a start does not match the bounds, a bound of random starts is infinite, or the list is
    /// empty.
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
            // Rounding could otherwise move a start across its bound.
            point[parameter] = (lower + fraction * (upper - lower)).clamp(lower, upper);
        }
    }
    Ok(points)
}

fn key(seed: u64) -> [u8; 32] {
    let mut key = [0; 32];
    key[..8].copy_from_slice(&seed.to_le_bytes());
    key
}

/// Uniform number in [0, 1) from the upper 53 bits of a 64-bit draw.
fn uniform(generator: &mut ChaCha8Rng) -> f64 {
    const SPACING: f64 = 1.0 / (1u64 << 53) as f64;
    (generator.next_u64() >> 11) as f64 * SPACING
}

/// Random permutation of `0 .. count` (Fisher and Yates) from 64-bit draws.
fn shuffled(count: usize, generator: &mut ChaCha8Rng) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    for last in (1..count).rev() {
        let product = u128::from(generator.next_u64()) * (last as u128 + 1);
        let other = usize::try_from(product >> 64).expect("the product is at most `last`");
        order.swap(last, other);
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn starts_are_those_of_the_first_release() {
        let bounds = Bounds::new(&[(-1.0, 1.0), (0.0, 10.0)]).unwrap();
        let points = Starts::random(3, 11).points(&bounds).unwrap();
        assert_eq!(points, GOLDEN);
    }

    const GOLDEN: [[f64; 2]; 3] = [
        [0.058_395_505_091_662_25, 8.332_562_571_592_515],
        [0.872_951_039_364_412_9, 1.270_607_859_306_775_1],
        [-0.404_180_699_721_771_3, 4.604_074_096_817_054],
    ];
}

use actin_mechanics::{Vector3, Vectors};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

/// Separates this noise from other uses of the same seed.
const PURPOSE: [u8; 8] = *b"thermal\0";

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Half {
    Before,
    After,
}

/// Normal deviates of a step or half step, one vector per point and per frame.
///
/// Each step has a separate `ChaCha8` stream. In a heat bath the number of the stream is twice that
/// of the step, plus one for the second half. Point `i` and frame `i`, held ones included, use the
/// `i`-th six 64-bit words. The deviates of a body thus do not depend on other bodies.
///
/// ```
/// use actin_integrate::Noise;
/// let mut noise = Noise::with_purpose(*b"example\0", 1, (2, 0));
/// noise.draw_stream(7, (1.0, 1.0));
/// let first = noise.points.get(0);
/// noise.draw_stream(8, (1.0, 1.0));
/// noise.draw_stream(7, (2.0, 1.0));
/// assert_eq!(noise.points.get(0), 2.0 * first);
/// ```
#[derive(Clone, Debug)]
pub struct Noise {
    generator: ChaCha8Rng,
    /// Deviates of points, with mean zero.
    pub points: Vectors,
    /// Deviates of frames, with mean zero.
    pub frames: Vectors,
}

impl Noise {
    pub(crate) fn new(seed: u64, bodies: (usize, usize)) -> Self {
        Self::with_purpose(PURPOSE, seed, bodies)
    }

    /// Creates the noise of a `seed` for given numbers of points and frames. Other purposes have
    /// independent noise.
    pub fn with_purpose(purpose: [u8; 8], seed: u64, (points, frames): (usize, usize)) -> Self {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        key[8..16].copy_from_slice(&purpose);
        Self {
            generator: ChaCha8Rng::from_seed(key),
            points: Vectors::zeros(points),
            frames: Vectors::zeros(frames),
        }
    }

    pub(crate) fn draw(&mut self, step: u64, half: Half, spreads: (f64, f64)) {
        self.draw_stream(2 * step + u64::from(half == Half::After), spreads);
    }

    /// Draws the deviates of a stream, with standard deviations `spreads` of points and frames.
    pub fn draw_stream(&mut self, stream: u64, spreads: (f64, f64)) {
        self.generator.set_stream(stream);
        self.generator.set_word_pos(0);
        for i in 0..self.points.len().max(self.frames.len()) {
            let [(a, b), (c, d), (e, f)] = std::array::from_fn(|_| self.pair());
            if i < self.points.len() {
                self.points.set(i, spreads.0 * Vector3::new(a, b, c));
            }
            if i < self.frames.len() {
                self.frames.set(i, spreads.1 * Vector3::new(d, e, f));
            }
        }
    }

    /// Two independent standard normal deviates from two 64-bit words:
    /// `sqrt(-2 ln u) (cos, sin)(2 pi w)`, with `u` in (0, 1] and `w` in [0, 1). Their magnitude is
    /// at most 8.6.
    ///
    /// # Source
    /// Box and Muller, Ann. Math. Stat. 29 (1958) 610.
    fn pair(&mut self) -> (f64, f64) {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        let (sin, cos) = (TAU * self.uniform()).sin_cos();
        (radius * cos, radius * sin)
    }

    /// Uniform number in [0, 1) from the upper 53 bits of a 64-bit word.
    fn uniform(&mut self) -> f64 {
        const SPACING: f64 = 1.0 / (1u64 << 53) as f64;
        (self.generator.next_u64() >> 11) as f64 * SPACING
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(seed: u64, bodies: (usize, usize), step: u64, half: Half) -> Noise {
        let mut noise = Noise::new(seed, bodies);
        noise.draw(step, half, (1.0, 1.0));
        noise
    }

    #[test]
    fn deviates_belong_to_step_half_and_body() {
        let few = drawn(3, (2, 1), 7, Half::After);
        let mut many = Noise::new(3, (100, 100));
        many.draw(1_000_000, Half::Before, (1.0, 1.0));
        many.draw(7, Half::After, (1.0, 1.0));
        assert_eq!(few.points.get(1), many.points.get(1));
        assert_eq!(few.frames.get(0), many.frames.get(0));
    }

    /// Moments up to the fourth, and correlations between components, halves, steps and neighbours,
    /// within 4.5 standard errors.
    #[test]
    fn deviates_are_independent_and_normal() {
        let bodies = 20_000;
        let a = drawn(11, (bodies, bodies), 5, Half::Before);
        let b = drawn(11, (bodies, bodies), 5, Half::After);
        let c = drawn(11, (bodies, bodies), 6, Half::Before);
        let series: Vec<&Vec<f64>> = [&a, &b, &c]
            .into_iter()
            .flat_map(|noise| [&noise.points, &noise.frames])
            .flat_map(|v| [&v.x, &v.y, &v.z])
            .collect();
        let n = bodies as f64;
        let mean = |f: &dyn Fn(usize) -> f64| (0..bodies).map(f).sum::<f64>() / n;
        for (k, x) in series.iter().enumerate() {
            // Variances of x, x^2, x^3 and x^4: 1, 2, 15 and 96.
            for (power, expected, variance) in [
                (1, 0.0, 1.0),
                (2, 1.0, 2.0),
                (3, 0.0, 15.0),
                (4, 3.0, 96.0f64),
            ] {
                let error = mean(&|i| x[i].powi(power)) - expected;
                assert!(
                    error.abs() < 4.5 * (variance / n).sqrt(),
                    "{k}, {power}: {error}"
                );
            }
            let neighbours = mean(&|i| x[i] * x[(i + 1) % bodies]);
            assert!(neighbours.abs() < 4.5 / n.sqrt(), "{k}: {neighbours}");
            for (l, y) in series[..k].iter().enumerate() {
                let error = mean(&|i| x[i] * y[i]);
                assert!(error.abs() < 4.5 / n.sqrt(), "{k}, {l}: {error}");
            }
        }
    }

    /// Any change of generator, key or conversion would change all seeded runs. Logarithms can
    /// differ in the last digit between machines.
    #[test]
    fn numbers_are_those_of_the_first_release() {
        let noise = drawn(7, (1, 1), 5, Half::After);
        let all = [noise.points.get(0), noise.frames.get(0)];
        println!("{all:?}");
        for (vector, golden) in all.iter().zip(GOLDEN) {
            assert!((vector - Vector3::from(golden)).norm() < 1e-15 * vector.norm());
        }
    }

    const GOLDEN: [[f64; 3]; 2] = [
        [
            -0.796_451_245_209_515_4,
            0.033_564_817_184_089_48,
            -0.736_687_525_186_472_3,
        ],
        [
            -1.776_557_796_458_752_4,
            0.796_126_668_556_352_5,
            -1.213_753_716_900_151_8,
        ],
    ];
}

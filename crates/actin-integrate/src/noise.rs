//! Normal deviates that are a function of seed, step, half and body.

use actin_mechanics::{Vector3, Vectors};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

/// Parts the key of this noise from other uses of the same seed.
const PURPOSE: [u8; 8] = *b"thermal\0";

/// One of the two halves of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Half {
    /// Before the conservative step.
    Before,
    /// After it.
    After,
}

/// Deviates of one step or half step, one vector for every point and one for every frame.
///
/// Each has a stream of `ChaCha8` of its own. In a heat bath its number is twice the number of the step,
/// plus one for the second half. The `i`-th point and the `i`-th frame, held ones included,
/// take the `i`-th six 64-bit words of it: a fixed share, so that the words of one body do not
/// depend on the values of another's.
///
/// ```
/// use actin_integrate::Noise;
/// let mut noise = Noise::of_purpose(*b"example\0", 1, (2, 0));
/// noise.draw_stream(7, (1.0, 1.0));
/// let first = noise.points.get(0);
/// noise.draw_stream(8, (1.0, 1.0));
/// noise.draw_stream(7, (2.0, 1.0));
/// assert_eq!(noise.points.get(0), 2.0 * first);
/// ```
#[derive(Clone, Debug)]
pub struct Noise {
    generator: ChaCha8Rng,
    /// For points: normal with mean zero and the standard deviation asked for.
    pub points: Vectors,
    /// For frames.
    pub frames: Vectors,
}

impl Noise {
    /// The noise of a heat bath for so many points and frames.
    pub(crate) fn new(seed: u64, bodies: (usize, usize)) -> Self {
        Self::of_purpose(PURPOSE, seed, bodies)
    }

    /// The noise of `seed` for so many points and frames, or whatever has a vector in their place. Other
    /// purposes have other noise.
    pub fn of_purpose(purpose: [u8; 8], seed: u64, (points, frames): (usize, usize)) -> Self {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        key[8..16].copy_from_slice(&purpose);
        Self {
            generator: ChaCha8Rng::from_seed(key),
            points: Vectors::zeros(points),
            frames: Vectors::zeros(frames),
        }
    }

    /// Draws all deviates of a half step, with the standard deviations `spreads` of points and of
    /// frames.
    pub(crate) fn draw(&mut self, step: u64, half: Half, spreads: (f64, f64)) {
        self.draw_stream(2 * step + u64::from(half == Half::After), spreads);
    }

    /// Draws all deviates of the stream with this number, with the standard deviations `spreads` of
    /// points and of frames.
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

    /// Two independent standard normal deviates from two 64-bit words.
    ///
    /// `sqrt(-2 ln u) (cos, sin)(2 pi w)` with `u` uniform in (0, 1] and `w` in [0, 1), both
    /// multiples of 2^-53: no deviate is beyond 8.6.
    ///
    /// # Source
    /// Box and Muller, Ann. Math. Stat. 29 (1958) 610.
    fn pair(&mut self) -> (f64, f64) {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        let (sin, cos) = (TAU * self.uniform()).sin_cos();
        (radius * cos, radius * sin)
    }

    /// The next number, uniform in [0, 1): the upper 53 bits of a 64-bit word.
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

    /// What a body meets does not depend on how many others there are, nor on what was drawn
    /// before: a stream that runs on would fail both, and with them every resumed run.
    #[test]
    fn deviates_belong_to_step_half_and_body() {
        let few = drawn(3, (2, 1), 7, Half::After);
        let mut many = Noise::new(3, (100, 100));
        many.draw(1_000_000, Half::Before, (1.0, 1.0));
        many.draw(7, Half::After, (1.0, 1.0));
        assert_eq!(few.points.get(1), many.points.get(1));
        assert_eq!(few.frames.get(0), many.frames.get(0));
    }

    /// Seed, step, half, body and kind all matter, in their highest bits too.
    #[test]
    fn deviates_differ() {
        let first = |seed, step, half| {
            let noise = drawn(seed, (2, 2), step, half);
            [&noise.points, &noise.frames]
                .map(|v| [v.x[0], v.y[0], v.z[0], v.x[1]])
                .concat()
        };
        let top = 1 << 63;
        let mut all = [
            first(0, 0, Half::Before),
            first(0, 0, Half::After),
            first(0, 1, Half::Before),
            first(0, 1 << 53, Half::Before),
            first(top, 0, Half::Before),
        ]
        .concat();
        let count = all.len();
        all.sort_by(f64::total_cmp);
        all.dedup();
        assert_eq!((all.len(), count), (40, 40));
    }

    /// Moments up to the fourth, and no correlation between components, halves, steps or
    /// neighbours.
    ///
    /// The bounds are 4.5 standard errors; a Box-Muller pair of which one word is used twice
    /// would be correlated, uniform deviates would have a fourth moment of 1.8.
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

    /// The numbers are fixed for good: a change of generator, key or conversion would change every
    /// run that was ever seeded. The last digit of a logarithm may differ between machines.
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

//! Means of correlated series with standard errors by block averages.

/// Smallest number of blocks for an error, whose relative error is then about a quarter.
const FEWEST: u64 = 8;

/// Averages over blocks of 1, 2, 4, 8, ... values or whole periods of a series, updated with each value.
///
/// For `n` independent blocks of one length with averages `a_i`, the standard error of the mean is
///
/// ```text
/// e = sqrt(sum (a_i - mean)^2 / (n (n - 1)))
/// ```
///
/// It grows with the block length until blocks are independent. The plateau is the first length `B`
/// with
///
/// ```text
/// B^3 > 2 N (e_B / e_1)^4        N values
/// ```
///
/// There the remaining correlation equals the statistical error of `e`, which is `e / sqrt(2 (n -
/// 1))`. With fewer than eight blocks the plateau is not reached, and `e` is a lower bound. Memory
/// grows with the logarithm of the number of values.
///
/// # Source
/// Blocks: Flyvbjerg and Petersen, J. Chem. Phys. 91, 461 (1989), equations 27 to 28. Plateau: Lee,
/// Conduit, Nemec, Lopez Rios and Drummond, Phys. Rev. E 83, 066706 (2011), section II.
///
/// ```
/// use actin_sim::statistics::BlockAverages;
/// let mut blocks = BlockAverages::default();
/// [1.0, 2.0, 3.0, 4.0].map(|value| blocks.push(value));
/// let estimate = blocks.estimate().unwrap();
/// assert_eq!((estimate.mean, estimate.values), (2.5, 4));
/// // Single values: sqrt(5 / (4 * 3)) = 0.65. Pairs, 1.5 and 3.5: sqrt(2 / (2 * 1)) = 1, the larger of the two.
/// assert_eq!((estimate.error, estimate.block), (Some(1.0), None));
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BlockAverages {
    levels: Vec<Level>,
    /// Unfinished shortest block.
    open: Level,
    values: u64,
}

#[derive(Clone, Debug, Default, PartialEq)]
struct Level {
    count: u64,
    mean: f64,
    /// Sum of squared deviations from the mean.
    squares: f64,
    /// First half of the next block of twice the length.
    half: Option<f64>,
}

/// Mean of a series with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Mean of all values.
    pub mean: f64,
    /// Number of values.
    pub values: u64,
    /// Standard error of the mean; a lower bound if the plateau is not reached. `None` for a single
    /// value.
    pub error: Option<f64>,
    /// Block length at the plateau; `None` if it is not reached.
    pub block: Option<u64>,
    /// Number of independent values with the same error; an upper bound if the plateau is not
    /// reached.
    pub independent: f64,
}

impl BlockAverages {
    /// Adds the next value of the series as a block.
    pub fn push(&mut self, value: f64) {
        self.push_part(value);
        self.end_block();
    }

    /// Adds the next value to the present shortest block, for series with a period.
    pub fn push_part(&mut self, value: f64) {
        self.open.add(value);
    }

    /// Ends the present shortest block, if it has values.
    pub fn end_block(&mut self) {
        let block = std::mem::take(&mut self.open);
        if block.count == 0 {
            return;
        }
        self.values += block.count;
        let mut average = block.mean;
        for level in &mut self.levels {
            level.add(average);
            match level.half.take() {
                None => {
                    level.half = Some(average);
                    return;
                }
                Some(half) => average = 0.5 * (half + average),
            }
        }
        let mut level = Level::default();
        level.add(average);
        level.half = Some(average);
        self.levels.push(level);
    }

    /// Returns the mean and its error, or `None` without a complete block. An unfinished block does not count.
    pub fn estimate(&self) -> Option<Estimate> {
        let first = self.levels.first()?;
        let single = first.error();
        let known = |level: &&Level| level.count >= FEWEST;
        let enough = self.levels.iter().take_while(known);
        let errors: Vec<f64> = enough.filter_map(Level::error).collect();
        let values = first.count as f64;
        let is_level = |&(k, error): &(usize, f64)| {
            let length = 2.0_f64.powi(i32::try_from(k).unwrap_or(i32::MAX));
            let ratio = single.filter(|&s| s > 0.0).map_or(0.0, |s| error / s);
            length.powi(3) > 2.0 * values * ratio.powi(4)
        };
        let level = errors.iter().copied().enumerate().find(is_level);
        let all = self.levels.iter().filter_map(Level::error);
        let largest = if errors.is_empty() {
            all.reduce(f64::max)
        } else {
            errors.iter().copied().reduce(f64::max)
        };
        let error = level.map(|(_, error)| error).or(largest);
        let share = match (single, error) {
            (Some(single), Some(error)) if error > single => (single / error).powi(2),
            _ => 1.0,
        };
        Some(Estimate {
            mean: first.mean,
            values: self.values,
            error,
            block: level.map(|(k, _)| (self.values / first.count) << k),
            independent: values * share,
        })
    }
}

impl Level {
    /// Adds an average (Welford's update).
    fn add(&mut self, average: f64) {
        self.count += 1;
        let before = average - self.mean;
        self.mean += before / self.count as f64;
        self.squares += before * (average - self.mean);
    }

    /// Standard error of the mean for independent blocks; `None` for a single block.
    fn error(&self) -> Option<f64> {
        let count = self.count as f64;
        (self.count > 1).then(|| (self.squares / (count * (count - 1.0))).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    /// Autoregressive series of order one, `x_i = phi x_(i-1) + noise` with uniform noise of
    /// variance 1/12, after a thousand values of burn-in.
    fn series(phi: f64, count: usize, seed: u64) -> Vec<f64> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut x = 0.0;
        let mut next = || {
            let uniform = (random.next_u64() >> 11) as f64 / 2.0_f64.powi(53);
            x = phi * x + uniform - 0.5;
            x
        };
        (0..1000).for_each(|_| _ = next());
        (0..count).map(|_| next()).collect()
    }

    /// Standard error of the mean of `count` values: with the variance `v` of a value, `v / N ((1 +
    /// phi)/(1 - phi) - 2 phi (1 - phi^N) / (N (1 - phi)^2))`.
    fn exact_error(phi: f64, count: usize) -> f64 {
        let n = count as f64;
        let variance = 1.0 / 12.0 / (1.0 - phi * phi);
        let ends = 2.0 * phi * (1.0 - phi.powf(n)) / (n * (1.0 - phi).powi(2));
        (variance / n * ((1.0 + phi) / (1.0 - phi) - ends)).sqrt()
    }

    fn estimate(values: &[f64]) -> Estimate {
        let mut blocks = BlockAverages::default();
        for &value in values {
            blocks.push(value);
        }
        blocks.estimate().unwrap()
    }

    const SERIES: u64 = 32;

    /// Blocks of `B` miss the share `2 phi / (B (1 - phi^2))` of the squared error, below 4 % here.
    /// Over 32 series the mean error scatters by 1 %, and the squared deviation in errors by a
    /// quarter (tolerance: four of these).
    #[test]
    fn errors_agree_with_theory() {
        for phi in [0.0, 0.5, 0.9] {
            let count = 1 << 16;
            let exact = exact_error(phi, count);
            let (mut ratio, mut square, mut independent) = (0.0, 0.0, 0.0);
            for seed in 0..SERIES {
                let found = estimate(&series(phi, count, seed));
                assert!(found.block.is_some(), "{phi} {seed}");
                let error = found.error.unwrap();
                ratio += error / exact / SERIES as f64;
                square += (found.mean / error).powi(2) / SERIES as f64;
                independent += found.independent / SERIES as f64;
            }
            assert!((ratio - 1.0).abs() < 0.05, "{phi}: {ratio}");
            assert!((square - 1.0).abs() < 1.0, "{phi}: {square}");
            let expected = count as f64 * (1.0 - phi) / (1.0 + phi);
            assert!(
                (independent / expected - 1.0).abs() < 0.1,
                "{phi}: {independent}"
            );
        }
    }

    #[test]
    fn blocks_outlast_the_correlation() {
        let block = |phi| estimate(&series(phi, 1 << 16, 1)).block.unwrap();
        // (2 N g^2)^(1/3) with g = (1 + phi) / (1 - phi): 51, 106 and 361.
        assert_eq!([0.0, 0.5, 0.9].map(block), [64, 128, 512]);
    }

    #[test]
    fn a_short_series_has_not_levelled_off() {
        for seed in 0..8 {
            let found = estimate(&series(0.999, 1024, seed));
            assert_eq!(found.block, None);
            assert!(found.error.unwrap() < exact_error(0.999, 1024));
        }
    }

    #[test]
    fn small_series() {
        assert_eq!(BlockAverages::default().estimate(), None);
        let one = estimate(&[3.0]);
        assert_eq!((one.mean, one.error, one.block), (3.0, None, None));
        let constant = estimate(&[2.0; 20]);
        assert_eq!((constant.error, constant.block), (Some(0.0), Some(1)));
        assert!((constant.independent - 20.0).abs() < 1e-12);
    }

    #[test]
    fn whole_periods_have_no_error() {
        let mut blocks = BlockAverages::default();
        for k in 1..=400_u32 {
            let sine = (std::f64::consts::TAU * f64::from(k) / 50.0).sin();
            blocks.push_part(sine * sine);
            if k % 50 == 0 {
                blocks.end_block();
            }
        }
        let estimate = blocks.estimate().unwrap();
        assert_eq!(estimate.values, 400);
        assert!((estimate.mean - 0.5).abs() < 1e-14 && estimate.error.unwrap() < 1e-14);
    }
}

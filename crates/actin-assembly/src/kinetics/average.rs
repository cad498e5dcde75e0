//! Averages of the forces of linkers, free of thermal fluctuations.

use actin_mechanics::{ControlId, State, Vector3};

/// Exponential averages since the start of the run or since a linker has formed, in controls of the state.
///
/// ```text
/// <F>^2 = |A|^2 - c (Q - |A|^2) / (1 - c)
/// ```
///
/// `A` is the weighted average of the force, `Q` of its square, and `c` the sum of squared weights,
/// which sum to 1. The second term is the mean square of the fluctuation of `A`, for forces that are
/// independent in successive steps.
#[derive(Clone, Debug)]
pub(super) struct ForceAverage {
    /// Time constant (ns).
    time: f64,
    /// Tension vector, forces against steps, square, weight, and square of the weights, each as a sum.
    sums: [ControlId; 8],
}

/// Sum of squared weights above which an average has one force, whose fluctuation is unknown.
const SINGLE: f64 = 1.0 - 1e-6;

const SQUARE: usize = 5;
const WEIGHT: usize = 6;
const WEIGHT_SQUARE: usize = 7;

impl ForceAverage {
    pub(super) fn new(state: &mut State, time: f64) -> Self {
        Self {
            time,
            sums: [0.0; 8].map(|zero| state.add_control(zero)),
        }
    }

    /// Returns `true` if the averages are the forces of the last step.
    pub(super) fn is_instantaneous(&self) -> bool {
        self.time <= 0.0
    }

    /// Begins new averages, for a linker that has just formed.
    pub(super) fn begin(&self, state: &mut State) {
        for sum in self.sums {
            state.controls[sum] = 0.0;
        }
    }

    /// Adds the tension vector and the forces against steps (pN) of a step of length `h` (ns).
    pub(super) fn add(&self, state: &mut State, h: f64, (tension, against): (Vector3, [f64; 2])) {
        let kept = (-h / self.time).exp();
        let share = 1.0 - kept;
        let square = tension.norm_squared();
        let [x, y, z] = tension.into();
        let values = [x, y, z, against[0], against[1], square, 1.0];
        for (sum, value) in self.sums.into_iter().zip(values) {
            state.controls[sum] = kept * state.controls[sum] + share * value;
        }
        let squares = &mut state.controls[self.sums[WEIGHT_SQUARE]];
        *squares = kept * kept * *squares + share * share;
    }

    /// Averaged force (pN) against a step of a hand.
    pub(super) fn against(&self, hand: usize, state: &State) -> f64 {
        let weight = state.controls[self.sums[WEIGHT]];
        if weight > 0.0 {
            state.controls[self.sums[3 + hand]] / weight
        } else {
            0.0
        }
    }

    /// Averaged tension vector and its magnitude without fluctuations (pN).
    pub(super) fn tension(&self, state: &State) -> (Vector3, f64) {
        let sum = |k: usize| state.controls[self.sums[k]];
        let weight = sum(WEIGHT);
        if weight <= 0.0 {
            return (Vector3::zeros(), 0.0);
        }
        let average = Vector3::from_fn(|k, _| sum(k) / weight);
        let squared = average.norm_squared();
        let correlation = sum(WEIGHT_SQUARE) / (weight * weight);
        let variance = (sum(SQUARE) / weight - squared).max(0.0);
        let fluctuation = if correlation < SINGLE {
            correlation / (1.0 - correlation) * variance
        } else {
            0.0
        };
        (average, (squared - fluctuation).max(0.0).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_mechanics::Xorshift;

    /// Forces with a standard deviation of 3 pN in each direction about a mean of 0 or 4 pN.
    #[test]
    fn fluctuations_do_not_contribute() {
        for mean in [0.0, 4.0] {
            let mut state = State::default();
            let average = ForceAverage::new(&mut state, 10.0);
            let mut noise = Xorshift::new(4);
            let mut random = || noise.sample() * 3.0_f64.powf(1.5);
            let (mut squares, mut plain) = (0.0, 0.0);
            for _ in 0..20_000 {
                let force = Vector3::from_fn(|k, _| if k == 0 { mean } else { 0.0 } + random());
                average.add(&mut state, 1.0, (force, [force.x, 0.0]));
                let (vector, tension) = average.tension(&state);
                squares += tension * tension / 2e4;
                plain += vector.norm_squared() / 2e4;
            }
            println!(
                "{mean} pN: {:.3} pN, {:.3} pN with fluctuations",
                squares.sqrt(),
                plain.sqrt()
            );
            assert!(plain > mean * mean + 1.0);
            assert!(squares < mean * mean + 0.8 && squares > mean * mean - 0.3);
            average.begin(&mut state);
            for _ in 0..2 {
                average.add(&mut state, 1.0, (Vector3::x() * 2.3, [0.5, 0.0]));
                let (vector, tension) = average.tension(&state);
                assert!((vector.x - 2.3).abs() < 1e-7 && (tension - 2.3).abs() < 1e-7);
            }
            assert!((average.against(0, &state) - 0.5).abs() < 1e-12);
        }
    }

    /// A force that jumps from 0 to 10 pN, for less than the time constant.
    #[test]
    fn a_jump_does_not_count_as_a_fluctuation() {
        let mut state = State::default();
        let average = ForceAverage::new(&mut state, 1000.0);
        for k in 0..100 {
            let force = if k < 5 { 0.0 } else { 10.0 };
            average.add(&mut state, 1.0, (Vector3::x() * force, [0.0; 2]));
        }
        let (vector, tension) = average.tension(&state);
        assert!(
            vector.x > 9.5 && (tension - vector.x).abs() < 0.05,
            "{vector} {tension}"
        );
    }
}

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
    /// Replaces the average where the force has changed.
    recent: Option<RecentAverage>,
}

/// Average of the tension vector over the time in which its fluctuations decay to a seventh of the force scale of the rate.
///
/// The fluctuations have at most the variance `kT k` of a spring of stiffness `k`, and relax in `f/k` with the friction
/// `f` of the bodies. Over a time `t`, in steps of length `h`, the variance of the average is at most
/// `kT (k h/2 + f) / t`. Slower fluctuations, of beads or in viscous fluids, count as changes of the force.
#[derive(Clone, Debug)]
pub(super) struct RecentAverage {
    thermal_energy: f64,
    /// Stiffness of the linker (pN/nm).
    stiffness: f64,
    /// Change of the force (pN) at which the rate changes by a factor of e.
    scale: f64,
    /// Tension vector and weight.
    sums: [ControlId; 4],
}

/// Friction (pN ns/nm) of 100 nm of filament in water, across.
const FRICTION: f64 = 400.0;
/// Standard deviation of the recent average over the scale.
const SPREAD: f64 = 1.0 / 7.0;
/// Difference from the average over the scale above which the recent average counts, 3.5 standard deviations.
const CHANGED: f64 = 0.5;
/// Largest ratio of the time constants of the recent average and the long one.
const RECENT: f64 = 0.25;

impl RecentAverage {
    pub(super) fn new(state: &mut State, thermal_energy: f64, stiffness: f64, scale: f64) -> Self {
        Self {
            thermal_energy,
            stiffness,
            scale,
            sums: [0.0; 4].map(|zero| state.add_control(zero)),
        }
    }

    /// Time constant (ns) for steps of length `h` (ns).
    fn time(&self, h: f64) -> f64 {
        let variance = (SPREAD * self.scale).powi(2);
        self.thermal_energy * (0.5 * self.stiffness * h + FRICTION) / variance
    }

    fn add(&self, state: &mut State, share: f64, tension: Vector3) {
        let [x, y, z] = tension.into();
        for (sum, value) in self.sums.into_iter().zip([x, y, z, 1.0]) {
            state.controls[sum] += share * (value - state.controls[sum]);
        }
    }

    /// Returns the average if it differs from `average` by more than fluctuations do.
    fn changed(&self, state: &State, average: &Vector3) -> Option<Vector3> {
        let [x, y, z, weight] = self.sums.map(|sum| state.controls[sum]);
        let recent = Vector3::new(x, y, z) / weight;
        let is_changed = (recent - average).norm() > CHANGED * self.scale;
        (weight > 0.0 && is_changed).then_some(recent)
    }
}

/// Sum of squared weights above which an average has one force, whose fluctuation is unknown.
const SINGLE: f64 = 1.0 - 1e-6;

const SQUARE: usize = 5;
const WEIGHT: usize = 6;
const WEIGHT_SQUARE: usize = 7;

impl ForceAverage {
    pub(super) fn new(state: &mut State, time: f64, recent: Option<RecentAverage>) -> Self {
        Self {
            time,
            sums: [0.0; 8].map(|zero| state.add_control(zero)),
            recent,
        }
    }

    /// Time (ns) after which the average follows a change of the force, for steps of length `h` (ns).
    pub(super) fn delay(&self, h: f64) -> f64 {
        let recent = self.recent.as_ref().map(|recent| recent.time(h));
        let is_used = |time: &f64| *time < RECENT * self.time;
        recent.filter(is_used).unwrap_or(self.time)
    }

    /// Returns `true` if the averages are the forces of the last step.
    pub(super) fn is_instantaneous(&self) -> bool {
        self.time <= 0.0
    }

    /// Begins new averages, for a linker that has just formed.
    pub(super) fn begin(&self, state: &mut State) {
        let recent = self.recent.iter().flat_map(|recent| recent.sums);
        for sum in self.sums.into_iter().chain(recent) {
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
        let delay = self.delay(h);
        if let Some(recent) = self.recent.as_ref().filter(|_| delay < self.time) {
            recent.add(state, -(-h / delay).exp_m1(), tension);
        }
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
        let recent = self.recent.as_ref();
        if let Some(recent) = recent.and_then(|recent| recent.changed(state, &average)) {
            return (recent, recent.norm());
        }
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
            let average = ForceAverage::new(&mut state, 10.0, None);
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
        let average = ForceAverage::new(&mut state, 1000.0, None);
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

    /// A force that jumps by 10 pN, ten times the scale of the rate, after a hundredth of the averaging time.
    #[test]
    fn recent_forces_replace_the_average_after_a_change() {
        let mut state = State::default();
        let recent = RecentAverage::new(&mut state, 0.1, 1.0, 1.0);
        let average = ForceAverage::new(&mut state, 1e6, Some(recent));
        let delay = average.delay(1.0);
        assert!((delay - 49.0 * 0.1 * 400.5).abs() < 1e-9, "{delay}");
        assert!((average.delay(1e6) - 1e6).abs() < 1e-9);
        let mut tension = |force: f64, steps: i32| {
            for _ in 0..steps {
                average.add(&mut state, 1.0, (Vector3::x() * force, [0.0; 2]));
            }
            average.tension(&state).1
        };
        assert!(tension(0.0, 10_000) < 1e-9);
        // Less than half of the scale.
        assert!(tension(10.0, 50) < 0.1);
        let after = tension(10.0, 5000);
        assert!((after - 10.0).abs() < 1.0, "{after}");
    }
}

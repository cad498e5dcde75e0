//! How much cross-sections of a filament in a heat bath turn against each other.
//!
//! At distance `s`, `<cos theta> = exp(-s / lp)` and `<phi^2> = s kT / C`, where `theta` tilts the axis
//! and `phi` goes about it; `lp` is the persistence length and `C` the twisting rigidity.

use actin_mechanics::{State, UnitQuaternion, rotation};

/// Means over samples of one filament, by separation of frames.
#[derive(Clone, Debug, PartialEq)]
pub struct Turns {
    /// `<cos theta>`.
    pub cosine: Vec<f64>,
    /// `<phi^2>` (rad^2).
    pub twist: Vec<f64>,
}

impl Turns {
    /// No samples yet of a filament of so many frames.
    pub fn new(frames: usize) -> Self {
        Self {
            cosine: vec![0.0; frames],
            twist: vec![0.0; frames],
        }
    }

    /// Adds one of so many `samples`: the mean over all pairs of frames at each separation. The axis of
    /// the filament at `rest` is z.
    pub fn add(&mut self, rest: &State, state: &State, samples: usize) {
        let (q0, q) = (&rest.frames.orientation, &state.frames.orientation);
        // Turns from rest, in the axes of the filament at rest.
        let turns: Vec<UnitQuaternion> = (0..q.len())
            .map(|i| q.get(i) * q0.get(i).inverse())
            .collect();
        for k in 0..turns.len() {
            let pairs = turns.iter().zip(&turns[k..]);
            let weight = 1.0 / (pairs.len() * samples) as f64;
            for (a, b) in pairs {
                let relative = a.inverse() * b;
                let (x, y) = (relative.i, relative.j);
                // Of a rotation, the element (3, 3) of its matrix.
                self.cosine[k] += weight * (1.0 - 2.0 * (x * x + y * y));
                self.twist[k] += weight * rotation::log(relative).z.powi(2);
            }
        }
    }
}

/// Steps of `h` in a duration, the last one included.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the conversion saturates, and durations are positive"
)]
pub fn steps_in(duration: f64, h: f64) -> u64 {
    (duration / h).ceil() as u64
}

/// An estimate from all replicas, with its standard error.
pub fn jackknife<T>(replicas: &[T], estimate: impl Fn(&[&T]) -> f64) -> (f64, f64) {
    let all: Vec<&T> = replicas.iter().collect();
    let whole = estimate(&all);
    let n = all.len() as f64;
    let squares = (0..all.len()).map(|leave| {
        let rest: Vec<&T> = all[..leave]
            .iter()
            .chain(&all[leave + 1..])
            .copied()
            .collect();
        (estimate(&rest) - whole).powi(2)
    });
    let square: f64 = squares.sum();
    (whole, (square * (n - 1.0) / n).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_mechanics::{Frame, Inertia, Vector3};

    /// Of a mean, the jackknife is the usual standard error: of 1, 2, 3, 4 it is `sqrt(5/12)`.
    #[test]
    fn the_jackknife_of_a_mean_is_its_standard_error() {
        let mean = |chosen: &[&f64]| chosen.iter().copied().sum::<f64>() / chosen.len() as f64;
        let (value, error) = jackknife(&[1.0, 2.0, 3.0, 4.0], mean);
        assert!((value - 2.5).abs() < 1e-15);
        assert!((error - (5.0_f64 / 12.0).sqrt()).abs() < 1e-15);
    }

    /// Three frames, the second tilted by 0.3 and the third twisted by 0.4, seen from the first.
    #[test]
    fn tilt_and_twist_are_told_apart() {
        let state = |turns: [Vector3; 3]| {
            let mut state = State::default();
            for turn in turns {
                state.frames.push(Frame {
                    orientation: rotation::exp(turn),
                    inertia: Inertia::from_moments([1.0, 1.0, 1.0]).unwrap(),
                });
            }
            state
        };
        let rest = state([Vector3::zeros(); 3]);
        let (tilt, twist) = (Vector3::x() * 0.3, Vector3::z() * 0.4);
        let mut turns = Turns::new(3);
        turns.add(&rest, &state([Vector3::zeros(), tilt, twist]), 1);
        assert!((turns.cosine[0] - 1.0).abs() < 1e-15 && turns.twist[0].abs() < 1e-15);
        // Separation 2: first and third only.
        assert!((turns.cosine[2] - 1.0).abs() < 1e-15);
        assert!((turns.twist[2] - 0.16).abs() < 1e-15);
        // Separation 1: the pair of the first two has the tilt alone.
        let of_second = 2.0 * turns.cosine[1] - 0.3_f64.cos();
        assert!((of_second - 0.3_f64.cos()).abs() < 1e-15);
    }
}

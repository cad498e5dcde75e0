use crate::problem::Linearisation;
use faer::Mat;
use faer::linalg::solvers::{Qr, SolveLstsq};

/// Damping above which a step does not change any parameter.
pub(crate) const LARGEST_DAMPING: f64 = 1e16;
/// Damping of Gauss-Newton steps, which keeps the damped matrix regular.
pub(crate) const SMALLEST_DAMPING: f64 = 1e-14;
/// Relative tolerance of the step length.
const LENGTH_TOLERANCE: f64 = 0.05;
/// Maximum number of bisections; ten reach the tolerance.
const BISECTIONS: usize = 60;

#[derive(Clone, Debug)]
pub(crate) struct BoundDistances {
    pub(crate) down: Vec<f64>,
    pub(crate) up: Vec<f64>,
    pub(crate) free: Vec<bool>,
}

#[derive(Clone, Debug)]
pub(crate) struct Step {
    pub(crate) values: Vec<f64>,
    pub(crate) inside: Vec<usize>,
}

/// Damped problem `|c - T L s|^2 + damping |D s|^2` at a point.
///
/// `scales` is the diagonal of `D`, at least the column norms `L`.
///
/// # Source
/// More, Lecture Notes in Mathematics 630 (1978) 105.
#[derive(Debug)]
pub(crate) struct Damped<'a> {
    pub(crate) linear: &'a Linearisation,
    pub(crate) scales: &'a [f64],
    pub(crate) room: &'a BoundDistances,
}

impl Damped<'_> {
    /// Minimises the damped problem over the free parameters.
    ///
    /// A step that crosses bounds is truncated there and solved again for the other parameters.
    /// Parameters at a bound thus do not distort the direction of the step.
    pub(crate) fn step(&self, damping: f64) -> Step {
        let room = self.room;
        let mut step = vec![0.0; self.scales.len()];
        let mut free: Vec<usize> = (0..step.len()).filter(|&j| room.free[j]).collect();
        while !free.is_empty() {
            for (&j, s) in free.iter().zip(self.solve(damping, &free, &step)) {
                step[j] = s;
            }
            let before = free.len();
            free.retain(|&j| room.down[j] <= step[j] && step[j] <= room.up[j]);
            for (s, (down, up)) in step.iter_mut().zip(room.down.iter().zip(&room.up)) {
                *s = s.clamp(*down, *up);
            }
            if free.len() == before {
                break;
            }
            for &j in &free {
                step[j] = 0.0;
            }
        }
        Step {
            values: step,
            inside: free,
        }
    }

    /// Damped solution for the free parameters with the others fixed at `step`, by QR of `T L / D`
    /// stacked on the square root of the damping.
    pub(crate) fn solve(&self, damping: f64, free: &[usize], step: &[f64]) -> Vec<f64> {
        let (linear, scales) = (self.linear, self.scales);
        let rows = linear.rotated.len();
        let held: Vec<f64> = (0..step.len())
            .map(|j| if free.contains(&j) { 0.0 } else { step[j] })
            .collect();
        let remainder = linear.remainder(&held);
        let root = damping.sqrt();
        let matrix = Mat::from_fn(rows + free.len(), free.len(), |i, k| {
            if i < rows {
                let j = free[k];
                linear.triangle[(i, j)] * (linear.lengths[j] / scales[j])
            } else if i - rows == k {
                root
            } else {
                0.0
            }
        });
        let right = Mat::from_fn(rows + free.len(), 1, |i, _| {
            remainder.get(i).copied().unwrap_or(0.0)
        });
        let solution = Qr::new(matrix.as_ref()).solve_lstsq(&right);
        (0..free.len())
            .map(|k| solution[(k, 0)] / scales[free[k]])
            .collect()
    }

    pub(crate) fn length(&self, step: &[f64]) -> f64 {
        let parts = step.iter().zip(self.scales).map(|(s, scale)| s * scale);
        parts.fold(0.0, f64::hypot)
    }

    /// Least damping, at least `least`, with a step of at most `length` within 5 %.
    pub(crate) fn damping_for(&self, length: f64, least: f64) -> f64 {
        let far = |damping: f64| self.length(&self.step(damping).values) / length - 1.0;
        if far(least) <= LENGTH_TOLERANCE {
            return least;
        }
        // Upper bound for steps within the bounds: |D s| <= |D^-1 L descent| / damping.
        let slopes = (0..self.scales.len())
            .filter(|&j| self.room.free[j])
            .map(|j| self.linear.descent[j] * (self.linear.lengths[j] / self.scales[j]));
        let steepest = slopes.fold(0.0, f64::hypot);
        let (mut short, mut long) = ((steepest / length).clamp(least, LARGEST_DAMPING), least);
        for _ in 0..BISECTIONS {
            let middle = (short * long).sqrt();
            match far(middle) {
                excess if excess > LENGTH_TOLERANCE => long = middle,
                excess if excess < -LENGTH_TOLERANCE => short = middle,
                _ => return middle,
            }
        }
        short
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `|c - R s|^2` with `R = [[1, 1], [0, 1]]` and `c = (2, 1)`; the minimum is at (1, 1).
    fn linear() -> Linearisation {
        let matrix = Mat::from_fn(2, 2, |i, j| if i > j { 0.0 } else { 1.0 });
        Linearisation::new(matrix.as_ref(), &[2.0, 1.0]).unwrap()
    }

    fn room(up: f64) -> BoundDistances {
        BoundDistances {
            down: vec![-9.0; 2],
            up: vec![9.0, up],
            free: vec![true; 2],
        }
    }

    /// The bound 0.5 of the second parameter moves the minimum of the first to 1.5. Truncation
    /// alone leaves it at 1.
    #[test]
    fn remaining_parameters_are_solved_again_at_a_bound() {
        let linear = linear();
        // The damping of 1e-14 moves the step by about as much.
        for (up, expected, inside) in [(9.0, [1.0, 1.0], vec![0, 1]), (0.5, [1.5, 0.5], vec![0])] {
            let damped = Damped {
                linear: &linear,
                scales: &[2.0; 2],
                room: &room(up),
            };
            let step = damped.step(SMALLEST_DAMPING);
            for (s, e) in step.values.iter().zip(expected) {
                assert!((s - e).abs() < 1e-12, "{step:?}");
            }
            assert_eq!(step.inside, inside);
        }
    }

    #[test]
    fn dampings_give_lengths() {
        let linear = linear();
        for (up, full) in [(9.0, 8.0_f64.sqrt()), (0.5, 10.0_f64.sqrt())] {
            let damped = Damped {
                linear: &linear,
                scales: &[2.0; 2],
                room: &room(up),
            };
            for part in [1e-6, 0.01, 0.3, 0.8] {
                let damping = damped.damping_for(part * full, SMALLEST_DAMPING);
                let length = damped.length(&damped.step(damping).values);
                assert!(
                    (length / (part * full) - 1.0).abs() < 0.051,
                    "{part} {length}"
                );
            }
            let least = damped.damping_for(full, SMALLEST_DAMPING);
            assert_eq!(least.to_bits(), SMALLEST_DAMPING.to_bits());
        }
    }
}

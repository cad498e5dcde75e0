//! The damped step within bounds.

use crate::problem::Linearisation;
use faer::Mat;
use faer::linalg::solvers::{Qr, SolveLstsq};

/// Where a step may go: distances to the bounds, and which parameters may move.
#[derive(Clone, Debug)]
pub(crate) struct Room {
    pub(crate) down: Vec<f64>,
    pub(crate) up: Vec<f64>,
    pub(crate) free: Vec<bool>,
}

/// The step `s` that makes `|c - R s|^2 + damping |D s|^2` least over the free parameters.
///
/// Where it would cross bounds it ends on them and is solved again for the others, so that
/// parameters at a bound do not spoil the direction of the rest. `scales` is the diagonal of `D`.
/// Solved by QR of `R` above `sqrt(damping) D`, never by normal equations.
///
/// # Source
/// More, Lecture Notes in Mathematics 630 (1978) 105.
pub(crate) fn damped_step(
    linear: &Linearisation,
    damping: f64,
    scales: &[f64],
    room: &Room,
) -> Vec<f64> {
    let mut step = vec![0.0; scales.len()];
    let mut free: Vec<usize> = (0..scales.len()).filter(|&j| room.free[j]).collect();
    while !free.is_empty() {
        for (&j, s) in free
            .iter()
            .zip(solve(linear, damping, scales, &free, &step))
        {
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
    step
}

/// The damped solution for the free parameters, with the others at `step`.
fn solve(
    linear: &Linearisation,
    damping: f64,
    scales: &[f64],
    free: &[usize],
    step: &[f64],
) -> Vec<f64> {
    let rows = linear.rotated.len();
    let held: Vec<f64> = (0..step.len())
        .map(|j| if free.contains(&j) { 0.0 } else { step[j] })
        .collect();
    let remainder = linear.remainder(&held);
    let root = damping.sqrt();
    let matrix = Mat::from_fn(rows + free.len(), free.len(), |i, k| {
        if i < rows {
            linear.triangle[(i, free[k])] / scales[free[k]]
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

#[cfg(test)]
mod tests {
    use super::*;

    /// `|c - R s|^2` with `R = [[1, 1], [0, 1]]`, `c = (2, 1)` has its minimum at (1, 1). With the
    /// second bounded by 0.5 the first is to be 1.5; a step that is only cut stays at 1.
    #[test]
    fn the_others_are_solved_again_where_one_meets_its_bound() {
        let matrix = Mat::from_fn(2, 2, |i, j| if i > j { 0.0 } else { 1.0 });
        let linear = Linearisation::new(matrix.as_ref(), &[2.0, 1.0]).unwrap();
        let room = |up| Room {
            down: vec![-9.0; 2],
            up: vec![9.0, up],
            free: vec![true; 2],
        };
        // Damping of 1e-14 moves the step by about as much.
        let near = |step: &[f64], x: f64, y: f64| {
            assert!(
                (step[0] - x).abs() < 1e-12 && (step[1] - y).abs() < 1e-12,
                "{step:?}"
            );
        };
        near(
            &damped_step(&linear, 1e-14, &[1.0; 2], &room(9.0)),
            1.0,
            1.0,
        );
        near(
            &damped_step(&linear, 1e-14, &[1.0; 2], &room(0.5)),
            1.5,
            0.5,
        );
    }
}

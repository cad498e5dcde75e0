//! Contribution of the chart of [`Chain::carry`] to the second derivatives: unbalanced loads times
//! the accelerations of carried motion. Stiffness blocks refer to straight motion, `x + t v` and
//! `Q exp(t phi)`.
//!
//! A point carried by frame `f` with rotation `R(t)` moves as `x_j = x_i + R (d + t s)` with
//! `s = v_j - v_i - theta_f x d`. A frame that follows another one rotates by
//! `R_b = R_a exp(t (theta_b - theta_a)) = exp(t theta_b + t^2 c_b / 2) + O(t^3)`:
//!
//! ```text
//! c_b   = c_a + theta_a x theta_b
//! x_j'' = x_i'' - theta_f x (theta_f x d) + 2 theta_f x (v_j - v_i) + c_f x d
//! ```
//!
//! With the resultant loads of a body and all bodies that it carries, each term couples neighbours
//! only.

use super::{Chain, Link};
use actin_mechanics::Coordinates::{Frame, Point};
use actin_mechanics::{Loads, Matrix3, State, Stiffness, Vectors};

impl Chain {
    /// Adds minus `loads` times the second derivatives of positions and rotations. Points of
    /// sliders must not carry other bodies.
    pub(crate) fn add_turning(&self, state: &State, loads: &Loads, blocks: &mut Stiffness) {
        let mut force = loads.force.clone();
        let frames = 0..state.frames.len();
        let mut torque: Vectors = frames
            .map(|f| state.frames.orientation.get(f) * loads.torque.get(f))
            .collect();
        for &link in self.0.iter().rev() {
            if let Link::Point { from, seen, to } = link {
                let carried = force.get(to);
                let d = state.points.position.get(to) - state.points.position.get(from);
                force.add(from, carried);
                torque.add(seen, d.cross(&carried));
                let axes = matrix(state, seen);
                let product = 0.5 * (carried * d.transpose() + d * carried.transpose());
                let own = product - Matrix3::from_diagonal_element(carried.dot(&d));
                let own = axes.tr_mul(&own) * axes;
                let cross = axes.tr_mul(&carried.cross_matrix());
                blocks.push(Frame(seen), Frame(seen), 0.5 * (own + own.transpose()));
                blocks.push(Frame(seen), Point(to), cross);
                blocks.push(Frame(seen), Point(from), -cross);
            }
        }
        for &link in self.0.iter().rev() {
            if let Link::Frame { from, to } = link {
                let carried = torque.get(to);
                torque.add(from, carried);
                let half = 0.5 * carried.cross_matrix();
                let block = matrix(state, from).tr_mul(&half) * matrix(state, to);
                blocks.push(Frame(from), Frame(to), block);
            }
        }
    }
}

fn matrix(state: &State, frame: usize) -> Matrix3 {
    let q = state.frames.orientation.get(frame);
    q.to_rotation_matrix().into_inner()
}

#[cfg(test)]
mod tests;

//! Assertion on second derivatives: they agree with differences of the loads.

use super::{derivative, loads_of};
use crate::{
    Coordinates, Interaction, Loads, Matrix3, State, Stiffness, Vector3, Vectors, rotation,
};
use crate::{Xorshift, perturb};
use nalgebra::{DMatrix, DVector};

/// Asserts that the second derivatives of the energy are minus the derivatives of the loads.
///
/// Forces change by `-K`, and torques by `-(K - [tau]x / 2)` for rotations of the same frame and by
/// `-K` otherwise. Diagonal blocks must be symmetric, and pairs must not depend on the state. `h`
/// is the step of [`derivative`]. `relative` is the tolerance relative to the largest entry of the
/// same kind (point-point, point-frame, frame-frame).
///
/// # Panics
/// If a condition does not hold, or if the interaction has no second derivatives.
pub fn assert_is_stiffness(interaction: &dyn Interaction, state: &State, h: f64, relative: f64) {
    assert_same_pairs(interaction, state);
    assert_are_second_derivatives(interaction, state, h, relative);
}

/// Like [`assert_is_stiffness`], for interactions whose pairs depend on the state, such as
/// contacts.
///
/// # Panics
/// See [`assert_is_stiffness`], except for the condition on pairs.
pub fn assert_are_second_derivatives(
    interaction: &dyn Interaction,
    state: &State,
    h: f64,
    relative: f64,
) {
    assert_diagonal(interaction, state, relative);
    let expected = stiffness_by_differences(interaction, state, h);
    let actual = stiffness_matrix(interaction, state);
    let first_frame = 3 * state.points.len();
    let kind = |i: usize, j: usize| usize::from(i >= first_frame) + usize::from(j >= first_frame);
    let mut scale = [0.0_f64; 3];
    for (i, j) in entries(&expected) {
        let largest = &mut scale[kind(i, j)];
        *largest = largest.max(expected[(i, j)].abs());
    }
    for (i, j) in entries(&expected) {
        let error = (actual[(i, j)] - expected[(i, j)]).abs();
        assert!(
            error <= relative * scale[kind(i, j)],
            "row {}, column {}: {} differs from {}, the derivative of the loads",
            name(state, i),
            name(state, j),
            actual[(i, j)],
            expected[(i, j)]
        );
    }
}

/// Matrix of second derivatives of one interaction: three rows per point (lab frame), then three
/// per frame (body frame).
///
/// # Panics
/// If the interaction has no second derivatives.
pub fn stiffness_matrix(interaction: &dyn Interaction, state: &State) -> DMatrix<f64> {
    dense(&stiffness_of(interaction, state), state)
}

pub(super) fn dense(stiffness: &Stiffness, state: &State) -> DMatrix<f64> {
    let first = |c: Coordinates| match c {
        Coordinates::Point(i) => 3 * i,
        Coordinates::Frame(i) => 3 * (state.points.len() + i),
    };
    let n = 3 * (state.points.len() + state.frames.len());
    let mut matrix = DMatrix::zeros(n, n);
    for &(a, b, block) in stiffness.all() {
        let mut place = matrix.fixed_view_mut::<3, 3>(first(a), first(b));
        place += block;
        if a != b {
            let mut place = matrix.fixed_view_mut::<3, 3>(first(b), first(a));
            place += block.transpose();
        }
    }
    matrix
}

fn stiffness_of(interaction: &dyn Interaction, state: &State) -> Stiffness {
    let mut stiffness = Stiffness::default();
    interaction
        .second_order()
        .expect("use an interaction with second derivatives")
        .add_stiffness(state, &mut stiffness);
    stiffness
}

/// Asserts that pairs do not depend on the state.
fn assert_same_pairs(interaction: &dyn Interaction, state: &State) {
    let here = stiffness_of(interaction, state);
    let mut moved = state.clone();
    perturb(&mut moved, &mut Xorshift::new(77), 0.1, 0.1);
    let elsewhere = stiffness_of(interaction, &moved);
    let pairs = |s: &Stiffness| s.all().map(|b| (b.0, b.1)).collect::<Vec<_>>();
    assert_eq!(pairs(&here), pairs(&elsewhere), "pairs at another state");
}

/// Asserts that diagonal blocks are symmetric.
fn assert_diagonal(interaction: &dyn Interaction, state: &State, relative: f64) {
    let here = stiffness_of(interaction, state);
    for (a, _, block) in here.all().filter(|(a, b, _)| a == b) {
        let asymmetry = (block - block.transpose()).amax();
        assert!(
            asymmetry <= relative * block.amax(),
            "the diagonal block of {a:?} is not symmetric: {block}"
        );
    }
}

fn entries(matrix: &DMatrix<f64>) -> impl Iterator<Item = (usize, usize)> + use<> {
    let (rows, columns) = matrix.shape();
    (0..rows).flat_map(move |i| (0..columns).map(move |j| (i, j)))
}

fn name(state: &State, row: usize) -> String {
    let (body, axis) = (row / 3, ["x", "y", "z"][row % 3]);
    match body.checked_sub(state.points.len()) {
        None => format!("{axis} of point {body}"),
        Some(frame) => format!("turn {axis} of frame {frame}"),
    }
}

fn stiffness_by_differences(interaction: &dyn Interaction, state: &State, h: f64) -> DMatrix<f64> {
    let n = 3 * (state.points.len() + state.frames.len());
    let mut matrix = DMatrix::zeros(n, n);
    for (c, mut column) in matrix.column_iter_mut().enumerate() {
        let slope = derivative(h, |step| {
            let mut moved = state.clone();
            move_coordinate(&mut moved, c, step);
            all_loads(&loads_of(interaction, &moved))
        });
        column.copy_from(&-slope);
    }
    let torques = loads_of(interaction, state).torque;
    for (k, torque) in torques.iter().enumerate() {
        let first = 3 * (state.points.len() + k);
        let mut block = matrix.fixed_view_mut::<3, 3>(first, first);
        let half: Matrix3 = 0.5 * torque.cross_matrix();
        block += half;
    }
    matrix
}

fn move_coordinate(state: &mut State, coordinate: usize, step: f64) {
    let mut vector = Vector3::zeros();
    vector[coordinate % 3] = step;
    let body = coordinate / 3;
    match body.checked_sub(state.points.len()) {
        None => state.points.position.add(body, vector),
        Some(frame) => {
            let q = state.frames.orientation.get(frame) * rotation::exp(vector);
            state.frames.orientation.set(frame, q);
        }
    }
}

pub(super) fn all_loads(loads: &Loads) -> DVector<f64> {
    let flat = |v: &Vectors| v.iter().flat_map(|v| [v.x, v.y, v.z]).collect::<Vec<_>>();
    let (forces, torques) = (flat(&loads.force), flat(&loads.torque));
    DVector::from_vec([forces, torques].concat())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SecondOrder;
    use crate::testing::{push_frame, push_point};
    use Coordinates::{Frame as F, Point as P};

    /// Spring of stiffness 2 between the origin and a point of a body: energy `(x + Q b)^2`.
    #[derive(Debug)]
    struct Spring {
        arm: Vector3,
        geometric: f64,
    }

    impl Spring {
        fn end(&self, state: &State) -> Vector3 {
            state.points.position.get(0) + state.frames.orientation.get(0) * self.arm
        }
    }

    impl Interaction for Spring {
        fn term(&self) -> &'static str {
            "spring"
        }

        fn add_loads(&self, state: &State, loads: &mut Loads) {
            let force = -2.0 * self.end(state);
            let q = state.frames.orientation.get(0);
            loads.force.add(0, force);
            loads.torque.add(0, self.arm.cross(&(q.inverse() * force)));
        }

        fn elements(&self) -> usize {
            1
        }

        fn write_energies(&self, state: &State, energies: &mut [f64]) {
            energies[0] = self.end(state).norm_squared();
        }

        fn second_order(&self) -> Option<&dyn SecondOrder> {
            Some(self)
        }
    }

    impl SecondOrder for Spring {
        fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
            let q = state.frames.orientation.get(0).to_rotation_matrix();
            let q = q.matrix();
            let slope = -q * self.arm.cross_matrix();
            let g = q.transpose() * self.end(state) * 2.0;
            let product = g * self.arm.transpose();
            let geometric = 0.5 * (product + product.transpose())
                - Matrix3::from_diagonal_element(product.trace());
            stiffness.push(P(0), P(0), Matrix3::from_diagonal_element(2.0));
            stiffness.push(P(0), F(0), 2.0 * slope);
            let turn = 2.0 * slope.transpose() * slope;
            stiffness.push(F(0), F(0), turn + self.geometric * geometric);
        }
    }

    fn check(geometric: f64) {
        let mut state = State::default();
        push_point(&mut state, Vector3::new(0.3, -1.0, 0.7), 1.0);
        push_frame(
            &mut state,
            rotation::exp(Vector3::new(0.4, 1.0, -0.2)),
            [1.0, 1.0, 2.0],
        );
        let arm = Vector3::new(1.0, 0.5, -0.4);
        // The length scale is 1: truncation 0.02^8 and round-off 1e-16 / 0.02 are below 1e-13.
        assert_is_stiffness(&Spring { arm, geometric }, &state, 0.02, 1e-12);
    }

    #[test]
    fn second_derivatives_of_a_spring_are_accepted() {
        check(1.0);
    }

    #[test]
    #[should_panic(expected = "of frame 0")]
    fn a_missing_geometric_part_is_detected() {
        check(0.0);
    }
}

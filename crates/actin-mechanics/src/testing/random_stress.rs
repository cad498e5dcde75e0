//! The argument for random stress: its loads have the covariance of the stiffness.

use super::second_order::{all_loads, dense};
use crate::{Interaction, Loads, State, Stiffness};
use nalgebra::DMatrix;

/// Asserts that the random stresses of these interactions together have loads of the covariance `kT K`, with `K` the second
/// derivatives of their energy but for what comes from their own loads, and that stresses can balance these loads.
///
/// Each deviate in turn is 1 and all others 0; the loads `g_k` of the stresses must make `sum g_k g_k^T = K`.
/// Elements are to have a positive stiffness at `state`. `relative` is the tolerance as a share of the
/// largest entry.
///
/// # Panics
/// If this does not hold, or if an interaction has no random stress.
pub fn assert_fluctuates(interactions: &[&dyn Interaction], state: &State, relative: f64) {
    let n = 3 * (state.points.len() + state.frames.len());
    let (mut covariance, mut stiffness) = (DMatrix::zeros(n, n), Stiffness::default());
    let mut balanced = Loads::zeros(state);
    for interaction in interactions {
        let stress = interaction.random_stress().expect("it has random stress");
        let components = stress.components();
        for k in 0..components {
            let mut values = vec![0.0; components];
            values[k] = 1.0;
            stress.draw(state, 1.0, &mut values);
            let mut loads = Loads::zeros(state);
            stress.add_stress_loads(state, &values, &mut loads);
            let g = all_loads(&loads);
            covariance += &g * g.transpose();
        }
        let mut values = vec![0.0; components];
        stress.balance(state, &mut values);
        interaction.add_loads(state, &mut balanced);
        stress.add_stress_loads(state, &values, &mut balanced);
        let second = interaction
            .second_order()
            .expect("it has second derivatives");
        second.add_stiffness(state, &mut stiffness);
        stress.add_stress_stiffness(state, &values, &mut stiffness);
    }
    let stiffness = dense(&stiffness, state);
    let error = (&covariance - &stiffness).amax();
    assert!(
        error <= relative * stiffness.amax(),
        "covariance {covariance:.3} against stiffness {stiffness:.3}"
    );
    let mut loads = Loads::zeros(state);
    for interaction in interactions {
        interaction.add_loads(state, &mut loads);
    }
    let (left, all) = (all_loads(&balanced).amax(), all_loads(&loads).amax());
    assert!(left <= relative * all, "{left} of {all} is left over");
}

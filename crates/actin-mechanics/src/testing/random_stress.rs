//! Assertion on random stress: its loads have the covariance of the stiffness.

use super::second_order::{all_loads, dense};
use crate::{Interaction, Loads, State, StepStress, Stiffness};
use nalgebra::DMatrix;

/// Asserts that the random stresses of the interactions have loads of covariance `kT K`, and that
/// stresses can balance the loads of the elements.
///
/// `K` is the stiffness without the contribution of the elements' own loads. With the loads `g_k`
/// of unit deviates, `sum g_k g_k^T = K` is required.
///
/// # Panics
/// If an error exceeds `relative` times the largest entry, or if an interaction has no random
/// stress.
pub fn assert_fluctuates(interactions: &[&dyn Interaction], state: &State, relative: f64) {
    let n = 3 * (state.points.len() + state.frames.len());
    let (mut covariance, mut stiffness) = (DMatrix::zeros(n, n), Stiffness::default());
    let mut balanced = Loads::zeros(state);
    for interaction in interactions {
        let stress = interaction.random_stress().expect("a random stress");
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
        let stresses = StepStress {
            values: &values,
            is_turned: false,
            is_balanced: false,
        };
        stress.add_stressed_stiffness(state, &stresses, &mut stiffness);
    }
    let stiffness = dense(&stiffness, state);
    let error = (&covariance - &stiffness).amax();
    assert!(
        error <= relative * stiffness.amax(),
        "covariance {covariance:.3} differs from stiffness {stiffness:.3}"
    );
    let mut loads = Loads::zeros(state);
    let each = interactions.iter();
    each.for_each(|interaction| interaction.add_loads(state, &mut loads));
    let (left, all) = (all_loads(&balanced).amax(), all_loads(&loads).amax());
    assert!(
        left <= relative * all,
        "unbalanced load {left} of largest load {all}"
    );
}

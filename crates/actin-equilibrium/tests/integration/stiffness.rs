//! Assembled stiffness.

use crate::common;
use actin_equilibrium::Layout;
use actin_mechanics::{Interaction, Vector3};
use actin_mechanics::{Xorshift, perturb};
use common::{ACTIN, Rod, assert_is_second_derivative, filament, in_order, push_slider};

fn bent_rod() -> (actin_mechanics::State, Vec<Box<dyn Interaction>>) {
    let rod = Rod {
        segments: 5,
        length: 50.0,
        ..ACTIN
    };
    let mut state = rod.state();
    perturb(&mut state, &mut Xorshift::new(1), 0.5, 0.4);
    (state, rod.interactions())
}

/// Large strains reveal errors of the geometric stiffness.
#[test]
fn stiffness_is_the_derivative_of_the_loads_with_and_without_a_given_order() {
    let (state, interactions) = bent_rod();
    let rod = Rod {
        segments: 5,
        ..ACTIN
    };
    assert_is_second_derivative(&interactions, &state, Layout::free(&state), 1e-8);
    assert_is_second_derivative(&interactions, &state, rod.layout(&state), 1e-8);
    let (mut state, bonds) = filament(6, 4, 2);
    perturb(&mut state, &mut Xorshift::new(2), 0.2, 0.1);
    let interactions: Vec<Box<dyn Interaction>> = vec![Box::new(bonds)];
    let layout = Layout::new(&state, Some(&in_order(&state))).unwrap();
    assert_is_second_derivative(&interactions, &state, layout, 1e-8);
    let directions = vec![Vector3::new(0.6, 0.8, 0.0), Vector3::z()];
    push_slider(&mut state, vec![3, 5], directions);
    for order in [None, Some(in_order(&state))] {
        let layout = Layout::new(&state, order.as_ref()).unwrap();
        assert_eq!(layout.unknowns(), 2 * 3 + 4 * 3 + 2);
        assert_is_second_derivative(&interactions, &state, layout, 1e-8);
    }
}

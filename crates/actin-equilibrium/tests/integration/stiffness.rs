//! Assembled stiffness.

use crate::common;
use actin_equilibrium::{Group, Layout, Pivot};
use actin_mechanics::{Interaction, PointLoad, Vector3};
use actin_mechanics::{Xorshift, perturb};
use common::{ACTIN, Rod, assert_is_second_derivative, filament, in_order};

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
    let (mut state, bonds) = filament(5, 4, 2);
    perturb(&mut state, &mut Xorshift::new(2), 0.2, 0.1);
    let layout = Layout::new(&state, Some(&in_order(&state)), vec![]).unwrap();
    assert_is_second_derivative(&[Box::new(bonds)], &state, layout, 1e-8);
}

/// The second order term of a rotation equals the moment of the load.
#[test]
fn stiffness_of_groups_includes_the_second_order_of_their_turn() {
    let (mut state, bonds) = filament(6, 4, 2);
    perturb(&mut state, &mut Xorshift::new(4), 0.2, 0.1);
    let control = state.add_control(1.0);
    let load = PointLoad::new(
        &state,
        vec![(5, 1.0)],
        Vector3::new(300.0, 20.0, -100.0),
        control,
    )
    .unwrap();
    let interactions: Vec<Box<dyn Interaction>> = vec![Box::new(bonds), Box::new(load)];
    let ends = Group::rigid(vec![4, 5], vec![4, 5]);
    let inner = Group {
        points: vec![2, 3],
        frames: vec![2],
        pivot: Pivot::Point(3),
        translations: vec![Vector3::new(1.0, 1.0, 0.0)],
        rotations: vec![Vector3::new(0.0, 1.0, 0.3), Vector3::x()],
    };
    let groups = vec![ends, inner];
    for order in [None, Some(in_order(&state))] {
        let layout = Layout::new(&state, order.as_ref(), groups.clone()).unwrap();
        assert_eq!(layout.unknowns(), 6 + 3 + 3, "two groups and frame 3");
        assert_is_second_derivative(&interactions, &state, layout, 1e-8);
    }
}

//! Loads of bonds.

use crate::common;
use actin_ellipsoid::EllipsoidModel;
use actin_mechanics::testing::{
    assert_is_balanced, assert_is_gradient, assert_is_invariant, derivative, loads_of,
};
use actin_mechanics::{Interaction, Vector3, rotation};
use actin_mechanics::{Xorshift, perturb};
use common::{filament, model, models, weighted};

/// The shortest bonds are 0.16 nm long, so the error of eight-point differences with a step of 1e-4
/// nm is below 1e-8; rounding is 1e-11 of the loads.
#[test]
fn loads_are_the_gradient_of_the_energy() {
    for seed in 0..4 {
        for model in models(seed) {
            let (mut state, _, bonds) = filament(&model, 5);
            perturb(&mut state, &mut Xorshift::new(seed), 0.5, 0.3);
            assert_is_gradient(&bonds, &state, 1e-4, 1e-8);
        }
    }
}

#[test]
fn loads_have_no_resultant() {
    for seed in 0..10 {
        for model in models(seed) {
            let (mut state, _, bonds) = filament(&model, 20);
            perturb(&mut state, &mut Xorshift::new(seed), 0.5, 0.3);
            assert_is_balanced(&bonds, &state, 1e-14);
            assert_is_invariant(&bonds, &state, 1e-13);
        }
    }
}

/// Bonds are parallel to the line of centres and extend equally.
#[test]
fn an_interface_pulled_along_the_line_of_centres_is_one_spring() {
    let models = [model(3, 64), weighted(12)];
    for (pull, model) in [-0.01, 0.1, 2.0].into_iter().zip(models.iter().cycle()) {
        let (mut state, _, bonds) = filament(model, 2);
        let axis = (model.helix().centre(1) - model.helix().centre(0)).normalize();
        state.points.position.add(1, pull * axis);
        let rigidity = model.parameters().lateral.rigidity;
        let energy = 0.5 * rigidity * pull * pull;
        assert!((bonds.energy(&state) - energy).abs() < 1e-12 * energy.max(1.0));
        let force = loads_of(&bonds, &state).force.get(1);
        assert!((force + rigidity * pull * axis).norm() < 1e-10);
    }
}

/// Energy for small `s`: `K/8 s^4 <1/L^2>`.
#[test]
fn an_interface_sheared_resists_with_the_cube_only() {
    for model in [model(3, 64), weighted(12)] {
        assert_shear_is_cubic(&model);
    }
}

fn assert_shear_is_cubic(model: &EllipsoidModel) {
    let (rest, _, bonds) = filament(model, 2);
    let axis = (model.helix().centre(1) - model.helix().centre(0)).normalize();
    let across = axis.cross(&Vector3::x()).normalize();
    let energy = |shear: f64| {
        let mut state = rest.clone();
        state.points.position.add(1, shear * across);
        bonds.energy(&state)
    };
    let pair = bonds.pairs()[0];
    let mean = bonds
        .bonds_of(&pair)
        .map(|b| b.weight * b.rest_length.powi(-2))
        .sum::<f64>();
    let shear: f64 = 1e-3;
    let expected = 0.125 * model.parameters().lateral.rigidity * shear.powi(4) * mean;
    // The next term is smaller by s^2 / 2 L^2 < 1e-4.
    assert!((energy(shear) / expected - 1.0).abs() < 1e-4);
}

/// Tilt stiffness is the second moment of the bonds; torsion has zero stiffness.
#[test]
fn an_interface_resists_tilt_but_not_torsion() {
    for model in [model(3, 64), weighted(12)] {
        assert_tilt_has_stiffness(&model);
    }
}

fn assert_tilt_has_stiffness(model: &EllipsoidModel) {
    let (rest, monomers, bonds) = filament(model, 2);
    let axis = (model.helix().centre(1) - model.helix().centre(0)).normalize();
    let stiffness = |about: Vector3| {
        derivative(1e-4, |angle| {
            let mut state = rest.clone();
            let frame = monomers.frame(1);
            let q = rotation::exp(angle * about) * state.frames.orientation.get(frame);
            state.frames.orientation.set(frame, q);
            let torque = loads_of(&bonds, &state).torque.get(frame);
            -(q * torque).dot(&about)
        })
    };
    let pair = bonds.pairs()[0];
    let tilt = axis.cross(&Vector3::x()).normalize();
    let expected: f64 = bonds
        .ends_of(&pair, &rest)
        .zip(bonds.bonds_of(&pair))
        .map(|([_, end], bond)| {
            let arm = tilt.cross(&(end - rest.points.position.get(1)));
            pair.rigidity * bond.weight * arm.dot(&axis).powi(2)
        })
        .sum();
    assert!((stiffness(tilt) / expected - 1.0).abs() < 1e-8);
    assert!(stiffness(axis).abs() < 1e-8 * expected);
}

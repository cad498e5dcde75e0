//! Filaments for integration tests.

use actin_ellipsoid::{Anchors, Bonds, EllipsoidModel, EllipsoidParameters, Monomers, Placement};
use actin_mechanics::State;

pub(crate) fn model(seed: u64, bonds: usize) -> EllipsoidModel {
    model_with(Anchors::Independent, seed, bonds)
}

pub(crate) fn model_with(anchors: Anchors, seed: u64, bonds: usize) -> EllipsoidModel {
    let mut parameters = EllipsoidParameters {
        anchors,
        seed,
        ..EllipsoidParameters::default()
    };
    parameters.lateral.bonds = bonds;
    parameters.longitudinal.bonds = bonds;
    EllipsoidModel::new(parameters).expect("the defaults are valid")
}

/// Quadrature bonds.
#[allow(dead_code, reason = "not used by every test")]
pub(crate) fn weighted(points: usize) -> EllipsoidModel {
    model_with(Anchors::Cubature, 0, points)
}

#[allow(dead_code, reason = "not used by every test")]
pub(crate) fn models(seed: u64) -> [EllipsoidModel; 3] {
    [model(seed, 8), model(seed, 64), weighted(12)]
}

pub(crate) fn filament(model: &EllipsoidModel, count: usize) -> (State, Monomers, Bonds) {
    let mut state = State::default();
    let monomers = model
        .build(&mut state, &Placement::default(), 0, count)
        .unwrap();
    let bonds = model
        .bonds(&monomers)
        .expect("the default interfaces have bonds");
    (state, monomers, bonds)
}

//! Built filaments.

use crate::common;
use actin_ellipsoid::{Anchors, EllipsoidModel, EllipsoidParameters, Placement};
use actin_mechanics::testing::loads_of;
use actin_mechanics::{Interaction, State, Vector3, rotation};
use common::{filament, model, model_with};
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: None,
        ..ProptestConfig::with_cases(100)
    })]

    /// Positions have rounding errors of 1e-14 up to 100 nm from the origin. The largest stiffness
    /// is 3e4 pN/nm: residuals of 3e-10 pN, and as much from the placement.
    #[test]
    fn the_built_filament_is_free_of_loads(
        seed: u64,
        anchors in prop::sample::select(vec![
            Anchors::Independent,
            Anchors::Identical,
            Anchors::Cubature,
        ]),
        bonds in 1usize..80,
        first in -10i64..10,
        azimuth in -4.0..4.0f64,
        turn in prop::array::uniform3(-2.0..2.0f64),
        shift in prop::array::uniform3(-20.0..20.0f64),
    ) {
        let bonds = if anchors == Anchors::Cubature { 12 } else { bonds };
        let parameters = EllipsoidParameters {
            azimuth,
            ..model_with(anchors, seed, bonds).parameters().clone()
        };
        let model = EllipsoidModel::new(parameters).unwrap();
        let placement = Placement {
            rotation: rotation::exp(turn.into()),
            translation: shift.into(),
        };
        let mut state = State::default();
        let monomers = model.build(&mut state, &placement, first, 20).unwrap();
        let bonds = model.bonds(&monomers).unwrap();
        let actin_mechanics::Residual { force, torque } = loads_of(&bonds, &state).residual(&state);
        prop_assert!(force < 1e-9, "force {force:e}");
        prop_assert!(torque < 1e-9, "torque {torque:e}");
        // Half of 3e3 pN/nm times (5e-14 nm)^2 for about forty interfaces.
        prop_assert!(bonds.energy(&state) < 1e-21);
    }
}

#[test]
fn the_same_monomers_have_the_same_anchors_in_any_run() {
    for anchors in [Anchors::Independent, Anchors::Identical, Anchors::Cubature] {
        let model = model_with(anchors, 12, 9);
        let whole = {
            let mut state = State::default();
            let monomers = model
                .build(&mut state, &Placement::default(), -5, 40)
                .unwrap();
            model.bonds(&monomers).unwrap()
        };
        let mut state = State::default();
        let _other = model
            .build(&mut state, &Placement::default(), 100, 3)
            .unwrap();
        let monomers = model
            .build(&mut state, &Placement::default(), 7, 11)
            .unwrap();
        let part = model.bonds(&monomers).unwrap();
        let mut compared = 0;
        for pair in part.pairs() {
            let lower = monomers.index(pair.lower);
            let same = whole
                .pairs()
                .iter()
                .find(|p| p.kind == pair.kind && whole.monomers().index(p.lower) == lower)
                .unwrap();
            assert!(part.bonds_of(pair).eq(whole.bonds_of(same)));
            compared += 1;
        }
        assert_eq!(compared, part.elements());
        for (k, index) in monomers.indices().enumerate() {
            let position = state.points.position.get(monomers.point(k));
            assert_eq!(position, model.helix().centre(index));
        }
    }
}

#[test]
fn placement_moves_the_centre_line() {
    let model = model(0, 1);
    let placement = Placement {
        rotation: rotation::exp(Vector3::new(0.0, std::f64::consts::FRAC_PI_2, 0.0)),
        translation: Vector3::new(5.0, 6.0, 7.0),
    };
    let mut state = State::default();
    let monomers = model.build(&mut state, &placement, -2, 6).unwrap();
    for (k, index) in monomers.indices().enumerate() {
        let orientation = state.frames.orientation.get(monomers.frame(k));
        let radial = orientation * Vector3::new(model.parameters().radius, 0.0, 0.0);
        let point = state.points.position.get(monomers.point(k)) - radial;
        let along = Vector3::new(index as f64 * model.parameters().rise, 0.0, 0.0);
        assert!((point - placement.translation - along).norm() < 1e-13);
    }
}

/// 42 kDa; moments of a solid ellipsoid: 2.916 m (radial), 2.18 m (others).
#[test]
fn monomers_have_mass_and_inertia() {
    let (state, ..) = filament(&model(0, 1), 3);
    let m = 0.0697;
    for k in 0..3 {
        assert!((state.points.inverse_mass()[k] * m - 1.0).abs() < 1e-14);
        let moments = Vector3::new(2.916 * m, 2.18 * m, 2.18 * m);
        let product = state.frames.inverse_moments(k).component_mul(&moments);
        assert!((product - Vector3::repeat(1.0)).norm() < 1e-14);
    }
}

//! Derivatives and moments of chains.

use super::*;
use crate::{EllipsoidModel, EllipsoidParameters, Placement};
use actin_mechanics::testing::{
    assert_fluctuates, assert_is_balanced, assert_is_gradient, assert_is_stiffness,
};
use actin_mechanics::{Xorshift, correlate, perturb};

const KT: f64 = 4.1;

fn run(count: usize) -> (Monomers, State) {
    let model = EllipsoidModel::new(EllipsoidParameters::default()).unwrap();
    let mut state = State::default();
    let monomers = model.build(&mut state, &Placement::default(), 3, count);
    (monomers.unwrap(), state)
}

fn chain(count: usize) -> (QuasiHarmonic, State) {
    let (monomers, state) = run(count);
    let mut noise = Xorshift::new(3);
    let mut random = |size: f64| SixMatrix::from_fn(|_, _| size * noise.sample());
    let scales = SixVector::new(0.05, 0.05, 0.02, 0.02, 0.02, 0.03);
    let links = (0..count - 1).map(|k| {
        let skew = SixMatrix::identity() + random(0.3);
        let spread = SixMatrix::from_diagonal(&scales) * skew;
        let covariance = spread * spread.transpose();
        let units = SixMatrix::from_diagonal(&scales);
        let follows = units * random(0.4) * units.try_inverse().unwrap();
        Link {
            pose: Pose::from_link(&monomers, k, &state),
            follows: if k == 0 { SixMatrix::zeros() } else { follows },
            stiffness: KT * covariance.try_inverse().unwrap(),
        }
    });
    let links = links.collect();
    (QuasiHarmonic::new(monomers, links), state)
}

#[test]
fn chains_are_the_gradient_of_their_energy() {
    let (chain, mut state) = chain(6);
    let mut loads = Loads::zeros(&state);
    chain.add_loads(&state, &mut loads);
    let residual = loads.residual(&state);
    assert!(
        residual.force < 1e-9 && residual.torque < 1e-9,
        "{residual:?}"
    );
    assert_fluctuates(&[&chain, &chain.of_lowers(2..4)], &state, 1e-9);
    perturb(&mut state, &mut Xorshift::new(5), 0.1, 0.1);
    for chain in [&chain, &chain.of_lowers(2..4), &chain.of_lowers(0..2)] {
        assert_is_gradient(chain, &state, 1e-3, 1e-8);
        assert_is_stiffness(chain, &state, 1e-3, 1e-7);
        assert_is_balanced(chain, &state, 1e-12);
    }
}

#[test]
fn parts_add_up() {
    let (chain, mut state) = chain(9);
    perturb(&mut state, &mut Xorshift::new(5), 0.1, 0.1);
    let stretches = [0..3, 3..4, 4..20].map(|lowers| chain.of_lowers(lowers));
    assert_eq!(stretches.each_ref().map(Interaction::elements), [3, 1, 4]);
    let sum: f64 = stretches.iter().map(|stretch| stretch.energy(&state)).sum();
    assert!((sum / chain.energy(&state) - 1.0).abs() < 1e-13);
}

/// 4.5 standard errors of 40 000 states, `sqrt(2 / 40 000)` each.
#[test]
fn moments_reproduce_the_chain() {
    let (chain, mut state) = chain(5);
    let monomers = chain.monomers;
    let mut fluctuations = Fluctuations::new(&monomers, &state);
    let mut noise = Xorshift::new(11);
    let states = 40_000;
    for _ in 0..states {
        let mut below = SixVector::zeros();
        for (k, link) in chain.links().iter().enumerate() {
            let mut deviates = [(); 6].map(|()| (0..12).map(|_| noise.sample()).sum::<f64>() / 2.0);
            correlate(KT * link.stiffness.try_inverse().unwrap(), &mut deviates);
            let own = link.follows * below + SixVector::from(deviates);
            let pose = link.pose.displaced(&own);
            let (point, frame) = (monomers.point(k), monomers.frame(k));
            let axes = state.frames.orientation.get(frame);
            let place = state.points.position.get(point) + axes * pose.place;
            state.points.position.set(point + 1, place);
            state.frames.orientation.set(frame + 1, axes * pose.turn);
            below = own;
        }
        fluctuations.add(&state);
    }
    let found = fluctuations.chain(KT).unwrap();
    // Zero for the chain itself, one standard error for the original chain.
    assert!(fluctuations.distance_from(&found, KT) < 1e-9);
    let distance = fluctuations.distance_from(&chain, KT) / (2.0 / f64::from(states)).sqrt();
    assert!((0.5..2.0).contains(&distance), "{distance}");
    let error = 4.5 * (2.0 / f64::from(states)).sqrt();
    for (link, expected) in found.links().iter().zip(chain.links()) {
        let root = expected.stiffness.cholesky().unwrap().l();
        let inverse = root.try_inverse().unwrap();
        let ratio = inverse * link.stiffness * inverse.transpose();
        assert!((ratio - SixMatrix::identity()).amax() < error, "{ratio}");
        let missing = root.tr_mul(&(link.follows - expected.follows));
        let scale = SixMatrix::from_diagonal(&expected.stiffness.diagonal().map(f64::sqrt));
        let missing = missing * scale.try_inverse().unwrap();
        assert!(missing.amax() < 3.0 * error, "{missing}");
    }
}

#[test]
fn too_few_states_are_refused() {
    let (monomers, state) = run(3);
    let mut fluctuations = Fluctuations::new(&monomers, &state);
    fluctuations.add(&state);
    let error = fluctuations.chain(KT).unwrap_err();
    assert_eq!((error.link, error.states), (0, 1));
}

//! Stiffness of bonds.

use crate::common;
use actin_mechanics::testing::assert_is_stiffness;
use actin_mechanics::{Xorshift, perturb};
use common::{filament, models};

/// The shortest bonds are 0.16 nm long, so the relative error of eight-point differences with a
/// step of 1e-3 nm is (1e-3 / 0.16)^8; rounding is 1e-14 of the loads over 1e-3.
#[test]
fn stiffness_is_the_derivative_of_the_loads() {
    for count in [2, 5, 11] {
        for seed in 0..4 {
            for model in models(seed) {
                let (mut state, _, bonds) = filament(&model, count);
                assert_is_stiffness(&bonds, &state, 1e-3, 1e-9);
                perturb(&mut state, &mut Xorshift::new(seed), 0.5, 0.3);
                assert_is_stiffness(&bonds, &state, 1e-3, 1e-9);
            }
        }
    }
}

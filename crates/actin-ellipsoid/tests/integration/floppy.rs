//! The stiffness of a free filament at rest: `N + 7` motions meet none.
//!
//! Bonds of an interface are parallel, so it resists 3 of 6 relative motions: 3 (2N - 3) in all.
//! Around each of the N - 2 triangles (i, i+1, i+2) one of these says what the others say: the
//! relative rotations about the triangle's normal add up to zero. That leaves 5N - 7 of 6N.

use crate::common;
use actin_mechanics::testing::stiffness_matrix;
use common::{filament, models};
use nalgebra::DMatrix;

/// Absolute eigenvalues, smallest first.
fn spectrum_of(stiffness: &DMatrix<f64>) -> Vec<f64> {
    let eigenvalues = stiffness.symmetric_eigenvalues();
    let mut spectrum: Vec<f64> = eigenvalues.iter().map(|e| e.abs()).collect();
    spectrum.sort_by(f64::total_cmp);
    spectrum
}

/// Exactly `N + 7` eigenvalues are zero, with a clear gap above: any bond that is not parallel
/// to its line of centres, or not at its rest length, would close it. The first that is not zero
/// is 5e-5 of the largest or more, so round-off of the second derivatives, 1e-14 of the largest,
/// leaves 2e-10 of it.
#[test]
fn a_free_filament_has_n_plus_7_modes_without_stiffness() {
    for count in [12, 30] {
        for seed in 0..3 {
            for model in models(seed) {
                let (state, _, bonds) = filament(&model, count);
                let spectrum = spectrum_of(&stiffness_matrix(&bonds, &state));
                let (zero, first) = (spectrum[count + 6], spectrum[count + 7]);
                let largest = spectrum[6 * count - 1];
                println!("N = {count}: {zero:.1e} | {first:.2e} ... {largest:.2e}");
                assert!(zero < 1e-8 * first, "{zero:e} against {first:e}");
            }
        }
    }
}

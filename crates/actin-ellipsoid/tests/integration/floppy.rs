//! Zero-stiffness modes of an unconstrained filament at rest.
//!
//! The bonds of an interface are parallel, so it resists 3 of 6 relative motions: 3 (2N - 3) in
//! total. Each of the N - 2 triangles (i, i+1, i+2) makes one of them redundant. This leaves 6N -
//! (5N - 7) = N + 7 modes.

use crate::common;
use actin_mechanics::testing::stiffness_matrix;
use common::{filament, models};
use nalgebra::DMatrix;

fn spectrum_of(stiffness: &DMatrix<f64>) -> Vec<f64> {
    let eigenvalues = stiffness.symmetric_eigenvalues();
    let mut spectrum: Vec<f64> = eigenvalues.iter().map(|e| e.abs()).collect();
    spectrum.sort_by(f64::total_cmp);
    spectrum
}

/// The smallest non-zero eigenvalue is at least 5e-5 of the largest.
#[test]
fn an_unconstrained_filament_has_n_plus_7_zero_stiffness_modes() {
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

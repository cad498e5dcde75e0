//! The stiffness of a free filament at rest: `N + 7` motions meet none.
//!
//! Bonds of an interface are parallel, so it resists 3 of 6 relative motions: 3 (2N - 3) in all.
//! Around each of the N - 2 triangles (i, i+1, i+2) one of these says what the others say: the
//! relative rotations about the triangle's normal add up to zero. That leaves 5N - 7 of 6N.
//! Both the differences of the loads and the second derivatives say so.

use crate::common;
use actin_mechanics::testing::{loads_of, stiffness_matrix};
use actin_mechanics::{Interaction, State, Vector3, rotation};
use common::{filament, models};
use nalgebra::{DMatrix, DVector};

/// The state with coordinate `c` moved by `step`: six coordinates per monomer, displacement (nm,
/// lab frame), then rotation (rad, body frame).
fn moved(rest: &State, c: usize, step: f64) -> State {
    let mut state = rest.clone();
    let (monomer, axis) = (c / 6, c % 3);
    let mut vector = Vector3::zeros();
    vector[axis] = step;
    if c % 6 < 3 {
        state.points.position.add(monomer, vector);
    } else {
        let q = state.frames.orientation.get(monomer) * rotation::exp(vector);
        state.frames.orientation.set(monomer, q);
    }
    state
}

/// All loads, in the order of the coordinates.
fn gather(interaction: &dyn Interaction, state: &State) -> DVector<f64> {
    let loads = loads_of(interaction, state);
    let both = loads.force.iter().zip(loads.torque.iter());
    let flat = both.flat_map(|(f, t)| [f.x, f.y, f.z, t.x, t.y, t.z]);
    DVector::from_vec(flat.collect())
}

/// The stiffness at rest (pN/nm, pN, pN nm) as the eight-point central difference of the loads:
/// with steps of 1e-3 nm its error is about 1e-16 / 1e-3 of the largest stiffness.
fn stiffness_by_differences(interaction: &dyn Interaction, rest: &State) -> DMatrix<f64> {
    const STEP: f64 = 1e-3;
    const WEIGHTS: [(f64, f64); 4] = [
        (1.0, 4.0 / 5.0),
        (2.0, -1.0 / 5.0),
        (3.0, 4.0 / 105.0),
        (4.0, -1.0 / 280.0),
    ];
    let n = 6 * rest.points.len();
    let mut stiffness = DMatrix::zeros(n, n);
    for c in 0..n {
        for (k, weight) in WEIGHTS {
            let ahead = gather(interaction, &moved(rest, c, k * STEP));
            let behind = gather(interaction, &moved(rest, c, -k * STEP));
            let mut column = stiffness.column_mut(c);
            column -= (ahead - behind) * (weight / STEP);
        }
    }
    let asymmetry = (&stiffness - stiffness.transpose()).amax();
    assert!(
        asymmetry < 1e-10 * stiffness.amax(),
        "no loads at rest, so K is symmetric"
    );
    (&stiffness + stiffness.transpose()) * 0.5
}

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
/// leaves 2e-10 of it; the error of the differences, 1e-13 of the largest, 2e-9.
#[test]
fn a_free_filament_has_n_plus_7_modes_without_stiffness() {
    for count in [12, 30] {
        for seed in 0..3 {
            for model in models(seed) {
                let (state, _, bonds_term) = filament(&model, count);
                let differences = stiffness_by_differences(&bonds_term, &state);
                assert_zero_modes(&spectrum_of(&differences), count, 1e-6);
                let analytic = stiffness_matrix(&bonds_term, &state);
                assert_zero_modes(&spectrum_of(&analytic), count, 1e-8);
            }
        }
    }
}

/// Asserts that `N + 7` eigenvalues, and no more, are below `relative` times the next one.
fn assert_zero_modes(spectrum: &[f64], count: usize, relative: f64) {
    let (zero, first) = (spectrum[count + 6], spectrum[count + 7]);
    println!(
        "N = {count}: {zero:.1e} | {first:.2e} ... {:.2e}",
        spectrum[6 * count - 1]
    );
    assert!(zero < relative * first, "{zero:e} against {first:e}");
}

//! Thick cantilever with small shear rigidity against Timoshenko's beam.

use super::common::{Rod, orders};

/// Tip deflection under a force of 15 (length 3, radius 0.25, E = 1e6, G = 1e4, shear factor 4/3).
/// Source: Gazzola et al., R. Soc. Open Sci. 5 (2018) 171628, Section 4.
const TIP: f64 = 0.061_191_892_5;
const FORCE: f64 = 15.0;
/// Share of bending in [`TIP`], F L^3 / 3B; the rest is shear, F L / S.
const BENDING_SHARE: f64 = 0.719_100;

fn cantilever(segments: usize) -> Rod {
    let (young, shear, radius) = (1e6, 1e4, 0.25_f64);
    let area = std::f64::consts::PI * radius * radius;
    let second_moment = 0.25 * area * radius * radius;
    let s = 4.0 / 3.0 * shear * area;
    let b = young * second_moment;
    Rod {
        length_nm: 3.0,
        segments,
        shear_pn: [s, s, young * area],
        bend_pn_nm2: [b, b, 2.0 * shear * second_moment],
        force_pn: FORCE,
        ..Rod::actin(segments)
    }
}

/// A thousandth of the force, where the beam is linear. Bending converges with order two, and shear
/// has no discretisation error.
#[test]
fn a_small_load_gives_timoshenkos_deflection() {
    let meshes = [1, 2, 4, 8, 16];
    let errors = meshes.map(|segments| {
        let rod = Rod {
            force_pn: 1e-3 * FORCE,
            ..cantilever(segments)
        };
        rod.deflection_nm() / (1e-3 * TIP) - 1.0
    });
    println!("errors {errors:?}, orders {:?}", orders(errors));
    for (n, error) in meshes.into_iter().zip(errors) {
        // 1/2n^2 of the bending; see `elastica`.
        let expected = 0.5 * BENDING_SHARE / (n * n) as f64;
        assert!((error - expected).abs() < 5e-6, "{n}: {error}");
    }
    for order in orders(errors) {
        assert!((order - 2.0).abs() < 5e-3, "{errors:?}");
    }
}

/// Under the full force the slope is 0.03; the nonlinearity is about its square.
#[test]
fn the_printed_load_is_small_to_three_digits() {
    let [coarse, fine] = [10, 20].map(|n| cantilever(n).deflection_nm() / TIP);
    let limit = (4.0 * fine - coarse) / 3.0;
    println!("full load {limit}");
    assert!((-5e-4..0.0).contains(&(limit - 1.0)), "{limit}");
}

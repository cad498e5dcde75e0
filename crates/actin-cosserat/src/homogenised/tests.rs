//! The potential: exact derivatives, its symmetries, and its linearity in the coefficients.

use super::{Homogenised, HomogenisedForm, SixVector, Term};
use crate::RodKey;
use actin_mechanics::testing::derivative;

/// Nodes that are not even, and a coefficient of its own at each of them for each term, of the size that brings
/// about 1 pN at the strains below.
fn law() -> Homogenised {
    let nodes = [-0.04, -0.01, 0.0, 0.02, 0.05];
    let form = HomogenisedForm::new(&nodes, &[-5e-3, 4e-4, 0.0, -0.012, -0.03]).unwrap();
    let unit = |term: Term| {
        let jet = term.jet([2e-3, 1e-4, 1e-4, 1e-4]);
        1.0 / jet.value.max(1e-6)
    };
    Homogenised::new(form, |term, k| {
        let place = Term::ALL.iter().position(|other| *other == term).unwrap();
        unit(term) * (1.0 + 0.3 * (place as f64 + 2.0 * k as f64).sin())
    })
    .unwrap()
}

/// Strains inside the nodes and beyond them, in tension and compression.
fn strains() -> Vec<SixVector> {
    let size = SixVector::new(0.01, 0.01, 0.07, 0.01, 0.01, 4e-3);
    let strain = |n: i32| SixVector::from_fn(|k, _| (3.7 * f64::from(n) + 2.3 * k as f64).sin());
    (0..60).map(|n| strain(n).component_mul(&size)).collect()
}

/// Eight-point differences; compression gives way over 1e-4, hence the small step along the axis. The bounds are
/// the rounding of energies of 10 pN and loads of 1e4 pN over the steps, tenfold.
#[test]
fn loads_and_tangent_are_exact() {
    let law = law();
    for strain in strains() {
        let (loads, tangent) = (law.loads(&strain), law.tangent(&strain));
        let scale = law.energy_density(&strain).abs().max(1.0);
        assert!((tangent - tangent.transpose()).amax() <= 1e-12 * tangent.amax());
        for k in 0..6 {
            let h = if k == 5 { 5e-6 } else { 2e-5 };
            // Third derivatives of splines jump at nodes: a difference across one is no derivative.
            let is_near = |node: &f64| (node - strain[2]).abs() < 5.0 * h;
            if k == 2 && law.form().nodes().iter().any(is_near) {
                continue;
            }
            let at = |h: f64| strain + SixVector::ith(k, h);
            let slope = derivative(h, |h| law.energy_density(&at(h)));
            assert!(
                (loads[k] - slope).abs() < 1e-13 * scale / h + 1e-6,
                "{k}: {strain}"
            );
            let column = derivative(h, |h| law.loads(&at(h)));
            let bound = 1e-13 * loads.amax().max(1.0) / h + 1e-6 * tangent.amax();
            assert!((tangent.column(k) - column).amax() < bound, "{k}: {strain}");
        }
    }
}

/// Turned about the axis, and turned end for end (`kappa_1` and `sigma_1` change their signs), the rod stores the
/// same.
#[test]
fn the_law_has_the_symmetries_of_the_filament() {
    let law = law();
    for strain in strains() {
        let energy = law.energy_density(&strain);
        let (sin, cos) = 0.7_f64.sin_cos();
        let mut turned = strain;
        let mut reversed = strain;
        for k in [0, 3] {
            turned[k] = cos * strain[k] - sin * strain[k + 1];
            turned[k + 1] = sin * strain[k] + cos * strain[k + 1];
            reversed[k] = -strain[k];
        }
        for other in [turned, reversed] {
            let same = law.energy_density(&other);
            assert!((same - energy).abs() < 1e-11 * energy.abs().max(1.0));
        }
    }
}

/// The units of all coefficients, times these, add up to the law.
#[test]
fn units_add_up() {
    let law = law();
    for strain in strains() {
        let mut energy = 0.0;
        let mut loads = SixVector::zeros();
        for (term, spline) in Term::ALL.into_iter().zip(&law.coefficients) {
            let units = law.form().units(term, &strain);
            for (node, (unit_energy, unit_loads)) in law.form().nodes().iter().zip(units) {
                let coefficient = spline.jet(*node)[0];
                energy += coefficient * unit_energy;
                loads += coefficient * unit_loads;
            }
        }
        assert!((energy - law.energy_density(&strain)).abs() < 1e-10 * energy.abs().max(1.0));
        assert!((loads - law.loads(&strain)).amax() < 1e-10 * loads.amax().max(1.0));
    }
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    let form = law().form().clone();
    let refused = Homogenised::new(form, |_, _| f64::NAN).unwrap_err();
    assert_eq!(refused.key, RodKey::Coefficient);
    assert!(HomogenisedForm::new(&[0.0, 1.0, 2.0], &[0.0, f64::INFINITY, 0.0]).is_err());
}

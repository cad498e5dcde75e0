use crate::common;
use actin_fit::{Data, Mat, Observations, Polynomial, fit_linear};
use common::{Gauss, places, refused};
use proptest::prelude::*;

fn observations(y: &[f64]) -> Observations {
    Observations::new(y).unwrap()
}

proptest! {
    #[test]
    fn polynomials_are_recovered(
        p in prop::collection::vec(-1.0..1.0_f64, 5),
        size in prop::sample::select(vec![1e-25_f64, 0.03, 1.0, 700.0, 1e25]),
        constant in any::<bool>(),
    ) {
        let polynomial = if constant { Polynomial::new(4) } else { Polynomial::without_constant(5) };
        // All terms are of equal size at the end of the range.
        let p: Vec<f64> = p.iter().zip(polynomial.powers()).map(|(p, k)| p * size.powi(-k)).collect();
        let x: Vec<f64> = places(-1.0, 1.0, 17).iter().map(|x| x * size).collect();
        let y: Vec<f64> = x.iter().map(|x| polynomial.value(&p, *x)).collect();
        let fit = polynomial.fit(&Data::new(&x, observations(&y)).unwrap()).unwrap();
        for (k, (got, is)) in polynomial.powers().zip(fit.parameters.iter().zip(&p)) {
            // Condition number 50, times rounding of values of order 1.
            prop_assert!((got - is).abs() * size.powi(k) < 1e-13 * 50.0);
        }
        prop_assert!(fit.goodness.rms < 1e-14 * 5.0);
    }
}

#[test]
fn qr_agrees_with_normal_equations() {
    let mut noise = Gauss::new(1);
    let (points, n) = (30, 3);
    let design = Mat::from_fn(points, n, |_, j| {
        noise.next() * 10.0_f64.powi(i32::try_from(j).unwrap())
    });
    let y: Vec<f64> = (0..points).map(|_| noise.next()).collect();
    let deviations: Vec<f64> = (0..points).map(|i| 0.5 + (i % 4) as f64).collect();
    let known = observations(&y).with_deviations(&deviations).unwrap();
    let fit = fit_linear(design.as_ref(), &known).unwrap();

    let weight = |i: usize| deviations[i].powi(-2);
    let normal = Mat::from_fn(n, n, |a, b| {
        (0..points)
            .map(|i| design[(i, a)] * weight(i) * design[(i, b)])
            .sum::<f64>()
    });
    for a in 0..n {
        // N p = A^T W y and N C = 1. The condition number is below 1e3 in these units.
        let right: f64 = (0..points).map(|i| design[(i, a)] * weight(i) * y[i]).sum();
        let left: f64 = (0..n).map(|b| normal[(a, b)] * fit.parameters[b]).sum();
        assert!((left - right).abs() < 1e-12 * normal[(a, a)].sqrt() * 10.0);
        for b in 0..n {
            let product: f64 = (0..n)
                .map(|k| normal[(a, k)] * fit.precision.covariance[(k, b)])
                .sum();
            let unit = (normal[(a, a)] / normal[(b, b)]).sqrt();
            assert!((product - f64::from(u8::from(a == b))).abs() < 1e-13 * unit * 10.0);
        }
    }
    let residuals = &fit.goodness.residuals;
    let chi: f64 = (0..points).map(|i| residuals[i].powi(2) * weight(i)).sum();
    assert!((chi / fit.goodness.chi_squared - 1.0).abs() < 1e-14);
    assert_eq!(fit.goodness.degrees_of_freedom, 27);
}

/// A point of weight 2 equals two points.
#[test]
fn a_weight_counts_points() {
    let weighted = observations(&[1.0, 5.0, 6.0])
        .with_weights(&[2.0, 1.0, 3.0])
        .unwrap();
    let line = Polynomial::new(1);
    let a = line
        .fit(&Data::new(&[0.0, 1.0, 2.0], weighted).unwrap())
        .unwrap();
    let repeated = observations(&[1.0, 1.0, 5.0, 6.0, 6.0, 6.0]);
    let b = line
        .fit(&Data::new(&[0.0, 0.0, 1.0, 2.0, 2.0, 2.0], repeated).unwrap())
        .unwrap();
    for (a, b) in a.parameters.iter().zip(&b.parameters) {
        assert!((a - b).abs() < 1e-14);
    }
    assert!((a.goodness.chi_squared - b.goodness.chi_squared).abs() < 1e-14);
}

#[test]
fn known_deviations_set_the_errors_and_weights_do_not() {
    let x = places(0.0, 1.0, 8);
    let y = [0.1, 0.0, 0.4, 0.2, 0.6, 0.9, 0.7, 1.1];
    let fit = |o: Observations| Polynomial::new(1).fit(&Data::new(&x, o).unwrap()).unwrap();
    let error = |o| fit(o).precision.standard_error(1).unwrap();
    let plain = error(observations(&y));
    let relative = error(observations(&y).with_weights(&[9.0; 8]).unwrap());
    assert!((relative / plain - 1.0).abs() < 1e-13);
    // Standard error of the slope for deviation s: s / sqrt(sum (x - mean)^2).
    let spread: f64 = x.iter().map(|x| (x - 0.5) * (x - 0.5)).sum();
    let known = error(observations(&y).with_deviations(&[3.0; 8]).unwrap());
    assert!((known - 3.0 / spread.sqrt()).abs() < 1e-13);
}

/// The error band of a straight line is narrowest at the mean of x, s / sqrt(n). Variances without
/// covariances give a wider band.
#[test]
fn propagation_uses_covariances() {
    let x = places(2.0, 4.0, 9);
    let known = observations(&[0.0; 9]).with_deviations(&[0.6; 9]).unwrap();
    let line = Polynomial::new(1);
    let fit = line.fit(&Data::new(&x, known).unwrap()).unwrap();
    let at_mean = fit.precision.propagated(&line.gradient(3.0));
    assert!((at_mean - 0.2).abs() < 1e-13, "{at_mean}");
    let correlation = fit.precision.correlation();
    // Exact value: -mean / sqrt(mean of squares).
    let mean_square = x.iter().map(|x| x * x).sum::<f64>() / 9.0;
    assert!((correlation[(0, 1)] + 3.0 / mean_square.sqrt()).abs() < 1e-13);
    assert!((correlation[(1, 1)] - 1.0).abs() < 1e-15);
}

#[test]
fn undetermined_parameters_are_listed() {
    let five = observations(&[1.0, 2.0, 3.0, 5.0, 8.0]);
    let parallel = Mat::from_fn(5, 3, |i, j| match j {
        0 => 0.1 * (i + 1) as f64,
        1 => 1.0,
        _ => 1e6 * 0.3 * (i + 1) as f64,
    });
    let zeros = Mat::from_fn(5, 2, |i, j| if j == 0 { 0.0 } else { i as f64 });
    for (design, message) in [
        (parallel, "2 of 3 parameters; not determined: [0, 2]"),
        (zeros, "1 of 2 parameters; not determined: [0]"),
    ] {
        let found = refused(fit_linear(design.as_ref(), &five));
        assert_eq!(found, format!("the data determine {message}"));
    }
    let x = [1.0, 1.0, 2.0, 2.0, 3.0, 3.0];
    let data = Data::new(&x, observations(&[1.0, 1.1, 2.0, 2.1, 3.0, 3.1])).unwrap();
    let found = refused(Polynomial::new(3).fit(&data));
    assert!(
        found.starts_with("the data determine 3 of 4 parameters"),
        "{found}"
    );
}

#[test]
fn too_few_points_are_refused() {
    let line = Polynomial::new(1);
    let two = || observations(&[1.0, 3.0]);
    let data = |o| Data::new(&[0.0, 1.0], o).unwrap();
    let found = refused(line.fit(&data(two())));
    assert_eq!(found, "3 points are needed, but there are 2");
    let fit = line
        .fit(&data(two().with_deviations(&[0.5, 0.5]).unwrap()))
        .unwrap();
    assert!((fit.parameters[1] - 2.0).abs() < 1e-14);
    assert_eq!(fit.goodness.reduced_chi_squared(), None);
    assert!((fit.precision.standard_error(0).unwrap() - 0.5).abs() < 1e-14);
}

#[test]
fn invalid_lists_are_refused() {
    let one = || observations(&[1.0]);
    let design = Mat::from_fn(2, 1, |i, _| if i == 1 { f64::NAN } else { 1.0 });
    let rows = |values: &[f64]| Data::from_rows(2, values, observations(&[1.0, 2.0]));
    let wide = rows(&[1.0; 4]).unwrap();
    #[rustfmt::skip]
    let cases = [
        (refused(Observations::new(&[0.0, f64::INFINITY])), "observation 1 must be finite, but is inf"),
        (refused(Data::new(&[f64::NEG_INFINITY], one())), "x 0 must be finite, but is -inf"),
        (refused(fit_linear(design.as_ref(), &observations(&[1.0, 2.0]))), " 1 must be finite, but is NaN"),
        (refused(one().with_weights(&[0.0])), "weight 0 must be positive and finite, but is 0"),
        (refused(one().with_deviations(&[-1.0])), "deviation 0 must be positive and finite, but is -1"),
        (refused(one().with_weights(&[1.0, 1.0])), "weights must have length 1, but has 2"),
        (refused(rows(&[1.0; 3])), "x must have length 4, but has 3"),
        (refused(Polynomial::new(0).fit(&wide)), " must have length 1, but has 2"),
    ];
    for (found, message) in cases {
        assert!(found.ends_with(message), "{found}");
    }
}

use crate::common;
use actin_fit::{
    Bounds, ClosureModel, Data, Fit, Mat, Model, Observations, Polynomial, Status, fit_linear,
};
use common::{Gauss, decay, errors, fit, places, refused};
use proptest::prelude::*;

fn noisy(unit: f64) -> Vec<f64> {
    let mut noise = Gauss::new(5);
    let at = |x: &f64| unit * (2.0 * (-1.3 * x).exp() + 0.02 * noise.next());
    places(0.0, 3.0, 15).iter().map(at).collect()
}

fn fitted(unit: f64, observations: Observations) -> Fit {
    let data = Data::new(&places(0.0, 3.0, 15), observations).unwrap();
    fit(&decay(unit), &data, &Bounds::none(2), &[5.0, 0.2]).unwrap()
}

#[test]
fn the_size_of_the_data_changes_nothing() {
    let plain = fitted(1.0, Observations::new(&noisy(1.0)).unwrap());
    for unit in [1e-98, 1e-40, 1e40, 1e98] {
        let unknown = Observations::new(&noisy(unit)).unwrap();
        let known = unknown.clone().with_deviations(&[0.02 * unit; 15]).unwrap();
        for (observations, is_known) in [(unknown, false), (known, true)] {
            let scaled = fitted(unit, observations);
            for (a, b) in plain.parameters.iter().zip(&scaled.parameters) {
                // The tolerance of 1e-10 applies to errors of 1 %.
                assert!((a / b - 1.0).abs() < 1e-11, "{unit:e}: {a} {b}");
            }
            let rms = scaled.goodness.rms / (unit * plain.goodness.rms) - 1.0;
            assert!(rms.abs() < 1e-10, "{unit:e}: {rms:e}");
            if !is_known {
                for (a, b) in errors(&plain).iter().zip(errors(&scaled)) {
                    assert!((a / b - 1.0).abs() < 1e-9, "{unit:e}: {a} {b}");
                }
            }
        }
    }
}

#[test]
fn sizes_whose_squares_are_lost_are_refused() {
    let new = |y: &[f64]| Observations::new(y);
    let message = refused(new(&[1.0, 1e300]));
    assert_eq!(
        message,
        "observation 1 is 1e300: must lie between 0e0 and 1e100, so that squares neither overflow nor underflow; choose another unit"
    );
    let message = refused(new(&[1e-300, -1e-299, 5e-324]));
    assert!(
        message
            .starts_with("the largest observation, number 1 is -1e-299: must lie between 1e-100")
    );
    let two = || new(&[1.0, 2.0]).unwrap();
    for bad in [1e300, 1e-300, 5e-324, f64::MAX] {
        let message = refused(two().with_deviations(&[1.0, bad]));
        assert!(message.starts_with(&format!("deviation 1 is {bad:e}: must lie between 1e-100")));
    }
    for bad in [1e300, 1e-300, 5e-324] {
        let message = refused(two().with_weights(&[bad, 1.0]));
        assert!(message.starts_with("weight 0 is "), "{message}");
    }
    let message = refused(new(&[1e60, 0.0]).unwrap().with_deviations(&[1e-60; 2]));
    assert!(
        message.starts_with("ratio of observation to deviation at point 0 is "),
        "{message}"
    );
    let message = refused(new(&[1e-60, 0.0]).unwrap().with_deviations(&[1e60; 2]));
    assert!(
        message.contains("the largest ratio of observation to deviation, at point 0 is "),
        "{message}"
    );
    // Zeros are valid, and so are small values next to large ones.
    assert!(new(&[0.0, 0.0]).is_ok() && new(&[1.0, 1e-300, 5e-324, 0.0]).is_ok());
}

/// The point with a deviation of 1e-20 dominates, and the point with 1e80 has no effect.
#[test]
fn deviations_of_mixed_sizes() {
    let deviations = [1e-20, 3e-20, 1.0, 1e80];
    let values = [2.0, 2.0, 7.0, -1e70];
    let observations = Observations::new(&values).unwrap();
    let observations = observations.with_deviations(&deviations).unwrap();
    let fit = fit_linear(Mat::full(4, 1, 1.0).as_ref(), &observations).unwrap();
    assert!((fit.parameters[0] - 2.0).abs() < 1e-14);
    let error = fit.precision.standard_error(0).unwrap();
    let expected = 1e-20 / (1.0 + 1.0 / 9.0_f64).sqrt();
    assert!((error / expected - 1.0).abs() < 1e-12, "{error:e}");
}

#[test]
fn a_mean_of_large_ratios() {
    let observations = Observations::new(&[1e70, 1e70]).unwrap();
    let observations = observations.with_deviations(&[1e-30; 2]).unwrap();
    let fit = fit_linear(Mat::full(2, 1, 1.0).as_ref(), &observations).unwrap();
    assert!((fit.parameters[0] / 1e70 - 1.0).abs() < 1e-14);
    assert!(fit.goodness.chi_squared.is_finite());
}

/// Coefficients at places of 1e60, and variances of parameters in units of 1e-170 and 1e170.
#[test]
fn variances_that_overflow_are_refused() {
    let y = Observations::new(&noisy(1.0)).unwrap();
    for size in [1e-60, 1e60, 1.7e308, 1e-300] {
        let x: Vec<f64> = places(-1.0, 1.0, 15).iter().map(|x| x * size).collect();
        let message = refused(Polynomial::new(6).fit(&Data::new(&x, y.clone()).unwrap()));
        assert!(message.contains(" of parameter "), "{size:e}: {message}");
    }
    // The places round to three subnormal numbers.
    let x: Vec<f64> = places(-1.0, 1.0, 15).iter().map(|x| x * 5e-324).collect();
    let message = refused(Polynomial::new(6).fit(&Data::new(&x, y.clone()).unwrap()));
    assert!(
        message.starts_with("the data determine 3 of 7"),
        "{message}"
    );
    for unit in [1e-170, 1e170] {
        let scaled = ClosureModel::new(
            2,
            move |x, p| decay(1.0).value(x, &[p[0] / unit, p[1]]),
            move |x, p, gradient: &mut [f64]| {
                decay(1.0).gradient(x, &[p[0] / unit, p[1]], gradient);
                gradient[0] /= unit;
            },
        );
        let data = Data::new(&places(0.0, 3.0, 15), y.clone()).unwrap();
        let message = refused(fit(&scaled, &data, &Bounds::none(2), &[5.0 * unit, 0.2]));
        assert!(
            message.starts_with("the variance of parameter 0 is too"),
            "{message}"
        );
    }
    let design = Mat::from_fn(15, 1, |i, _| 1e300 * (1.0 + i as f64 / 15.0));
    let message = refused(fit_linear(design.as_ref(), &y));
    assert!(message.starts_with("length of column 0 is "), "{message}");
}

#[test]
fn wide_bounds_change_nothing() {
    let y = Observations::new(&noisy(1.0)).unwrap();
    let data = Data::new(&places(0.0, 3.0, 15), y).unwrap();
    let within = |size: f64| {
        let bounds = Bounds::new(&[(-size, size); 2]).unwrap();
        let fit = fit(&decay(1.0), &data, &bounds, &[5.0, 0.2]).unwrap();
        assert_eq!(fit.statuses, [Status::Determined; 2], "{size:e}");
        errors(&fit)
    };
    assert_eq!(within(1e3), within(1e307));
    assert_eq!(within(1e3), within(f64::MAX));
}

#[test]
fn a_start_that_overflows_is_named() {
    let data = Data::new(
        &[1.0, 2.0, 3.0],
        Observations::new(&[1.0, 2.0, 4.0]).unwrap(),
    )
    .unwrap();
    let growth = ClosureModel::new(
        1,
        |x, p| (p[0] * x[0]).exp(),
        |x, p, gradient| gradient[0] = x[0] * (p[0] * x[0]).exp(),
    );
    for (rate, point) in [(300.0, 2), (150.0, 2), (710.0, 0)] {
        let message = refused(fit(&growth, &data, &Bounds::none(1), &[rate]));
        assert!(
            message.contains("infinite, not a number or too large to be squared at point ")
                && message.contains(&format!("at point {point}")),
            "{message}"
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn any_size_gives_numbers_or_a_message(
        y in prop::collection::vec(any::<f64>(), 6),
        sizes in prop::collection::vec(-330..310_i32, 6),
        deviations in prop::collection::vec(-330..310_i32, 6),
        narrow in 1..400_i32,
        is_known in any::<bool>(),
    ) {
        // Narrow ranges of exponents are accepted more often.
        let size = |k: &i32| 10.0_f64.powi(k % narrow);
        let y: Vec<f64> = y.iter().zip(&sizes).map(|(y, k)| y.signum() * size(k)).collect();
        let s: Vec<f64> = deviations.iter().map(size).collect();
        let observed = Observations::new(&y);
        let observed = observed.and_then(|o| {
            if is_known { o.with_deviations(&s) } else { o.with_weights(&s) }
        });
        let line = ClosureModel::new(
            2,
            |x, p| p[0] + p[1] * x[0],
            |x, _, gradient| gradient.copy_from_slice(&[1.0, x[0]]),
        );
        let Ok(observed) = observed else { return Ok(()) };
        let x = places(-1.0, 1.0, 6);
        let data = Data::new(&x, observed).unwrap();
        let straight = Polynomial::new(1).fit(&data);
        if let Ok(fit) = &straight {
            for j in 0..2 {
                prop_assert!(fit.parameters[j].is_finite());
                prop_assert!(fit.precision.standard_error(j).unwrap().is_finite());
            }
            prop_assert!(fit.goodness.chi_squared.is_finite() && fit.goodness.rms.is_finite());
        }
        let bounds = Bounds::none(2);
        let search = fit(&line, &data, &bounds, &[1.0, 0.0]);
        if let Ok(fit) = search {
            let goodness = &fit.goodness;
            prop_assert!(goodness.chi_squared.is_finite() && goodness.rms.is_finite());
            prop_assert!(fit.precision.correlation()[(0, 1)].abs() <= 1.0 + 1e-9);
            if fit.statuses == [Status::Determined; 2] {
                // At a minimum chi squared equals the value of the linear fit, except for rounding:
                // weights of 1e-18 to 1e-25 amplify it in the parameters to about 1e-13 of the data,
                // whose square is 1e-26 of the scale.
                let Ok(straight) = straight else { return Ok(()) };
                let scale: f64 = data.observations().values().iter()
                    .zip(data.observations().deviations())
                    .map(|(y, s)| (y / s).powi(2))
                    .sum();
                let rise = goodness.chi_squared - straight.goodness.chi_squared;
                prop_assert!(rise <= 1e-9 * straight.goodness.chi_squared + 1e-24 * scale, "{rise:e}");
            }
        }
    }
}

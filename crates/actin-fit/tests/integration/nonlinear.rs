use crate::common;
use actin_fit::{
    Bounds, ClosureModel, Data, FitError, LevenbergMarquardt, Model, Observations, Options,
    Polynomial, Starts, Status, Termination, check_gradient,
};
use common::{Gauss, Sigmoid, clean, decay, fit, places, refused, values};
use proptest::prelude::*;

fn noisy(model: &dyn Model, x: &[f64], p: &[f64], deviation: f64, seed: u64) -> Data {
    let mut noise = Gauss::new(seed);
    let y: Vec<f64> = values(model, x, p)
        .iter()
        .map(|y| y + deviation * noise.next())
        .collect();
    Data::new(x, Observations::new(&y).unwrap()).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn sigmoids_are_recovered(
        low in -5.0..5.0_f64, rise in 1.0..9.0_f64, c in -0.5..0.5_f64, w in 0.3..1.0_f64,
    ) {
        let p = [low, low + rise, c, w];
        let data = clean(&Sigmoid, &places(-3.0, 3.0, 25), &p);
        // Widths below the distance of places give a step function with additional minima.
        let ends = (low - 2.0, low + rise + 2.0);
        let bounds = Bounds::new(&[ends, ends, (-1.0, 1.0), (0.15, 2.0)]).unwrap();
        let fit = LevenbergMarquardt::default()
            .fit(&Sigmoid, &data, &bounds, &Starts::random(6, 3))
            .unwrap();
        for (got, is) in fit.parameters.iter().zip(&p) {
            // Condition number below 1e2, values up to 14, and a search that ends at rounding.
            prop_assert!((got - is).abs() < 1e-10, "{got} {is} {:?}", fit.starts);
        }
    }
}

#[test]
fn a_linear_model_gives_the_linear_fit() {
    let cubic = Polynomial::new(3);
    let model = ClosureModel::new(
        4,
        move |x, p| cubic.value(p, x[0]),
        move |x, _, gradient| gradient.copy_from_slice(&cubic.gradient(x[0])),
    );
    let data = noisy(
        &model,
        &places(-1.0, 1.0, 20),
        &[1.0, -2.0, 0.5, 3.0],
        0.1,
        5,
    );
    let linear = cubic.fit(&data).unwrap();
    let fit = fit(&model, &data, &Bounds::none(4), &[0.0; 4]).unwrap();
    for j in 0..4 {
        assert!((fit.parameters[j] - linear.parameters[j]).abs() < 1e-9);
        for k in 0..4 {
            let (a, b) = (
                fit.precision.covariance[(j, k)],
                linear.precision.covariance[(j, k)],
            );
            assert!((a - b).abs() < 1e-13);
        }
    }
    assert!((fit.precision.condition / linear.precision.condition - 1.0).abs() < 1e-9);
}

/// With parameters in units that differ by powers of two the search takes the same steps, to the
/// last bit.
#[test]
fn the_search_does_not_depend_on_units() {
    let (a, b) = (2.0_f64.powi(30), 2.0_f64.powi(-24));
    let scaled = ClosureModel::new(
        2,
        move |x, p| decay(1.0).value(x, &[p[0] / a, p[1] / b]),
        move |x, p, gradient| {
            decay(1.0).gradient(x, &[p[0] / a, p[1] / b], gradient);
            gradient[0] /= a;
            gradient[1] /= b;
        },
    );
    let data = noisy(&decay(1.0), &places(0.0, 3.0, 15), &[2.0, 1.3], 0.05, 3);
    let plain = fit(&decay(1.0), &data, &Bounds::none(2), &[5.0, 0.2]).unwrap();
    let other = fit(&scaled, &data, &Bounds::none(2), &[5.0 * a, 0.2 * b]).unwrap();
    assert_eq!(
        other.parameters,
        [plain.parameters[0] * a, plain.parameters[1] * b]
    );
    assert_eq!(other.starts[0].iterations, plain.starts[0].iterations);
    assert_eq!(
        other.precision.standard_error(1),
        plain.precision.standard_error(1).map(|e| e * b)
    );
}

#[test]
fn a_parameter_stops_at_its_bound() {
    let x = places(0.0, 3.0, 15);
    let data = noisy(&decay(1.0), &x, &[2.0, 1.3], 0.05, 3);
    let bounds = Bounds::new(&[(0.0, 10.0), (0.0, 1.0)]).unwrap();
    let fit = fit(&decay(1.0), &data, &bounds, &[5.0, 0.2]).unwrap();
    assert_eq!(fit.parameters[1].to_bits(), 1.0_f64.to_bits());
    assert_eq!(fit.statuses, [Status::Determined, Status::AtUpperBound]);
    assert_eq!(fit.precision.standard_error(1), None);
    assert_eq!(fit.goodness.degrees_of_freedom, 14);

    let e: Vec<f64> = x.iter().map(|x| (-x).exp()).collect();
    let product: f64 = e
        .iter()
        .zip(data.observations().values())
        .map(|(e, y)| e * y)
        .sum();
    let square: f64 = e.iter().map(|e| e * e).sum();
    assert!((fit.parameters[0] - product / square).abs() < 1e-9);
    let error = fit.precision.standard_error(0).unwrap();
    let deviation = fit.goodness.reduced_chi_squared().unwrap().sqrt();
    assert!((error - deviation / square.sqrt()).abs() < 1e-12);
}

#[test]
fn bounds_are_met_to_the_last_bit() {
    let data = noisy(&decay(1.0), &places(0.0, 3.0, 15), &[2.0, 1.3], 0.05, 3);
    for k in 1..40 {
        let shift = 0.017 * f64::from(k);
        for (rates, start, bound, status) in [
            ((-1.0, 0.7), 0.69 - shift, 0.7_f64, Status::AtUpperBound),
            ((2.1, 9.0), 2.11 + shift, 2.1_f64, Status::AtLowerBound),
        ] {
            let bounds = Bounds::new(&[(0.0, 10.0), rates]).unwrap();
            let fit = fit(&decay(1.0), &data, &bounds, &[2.0, start]).unwrap();
            assert_eq!(fit.parameters[1].to_bits(), bound.to_bits());
            assert_eq!(fit.statuses[1], status);
        }
    }
}

#[test]
fn a_bound_is_left_again() {
    let data = noisy(&decay(1.0), &places(0.0, 3.0, 15), &[2.0, 1.3], 0.05, 3);
    let open = fit(&decay(1.0), &data, &Bounds::none(2), &[5.0, 0.2]).unwrap();
    let bounds = Bounds::new(&[(0.0, 10.0), (0.1, 4.0)]).unwrap();
    let closed = fit(&decay(1.0), &data, &bounds, &[10.0, 0.1]).unwrap();
    assert_eq!(closed.statuses, [Status::Determined; 2]);
    assert!((closed.parameters[1] - open.parameters[1]).abs() < 1e-9);
}

#[test]
fn equal_bounds_hold_a_parameter() {
    let data = clean(&decay(1.0), &places(0.0, 3.0, 15), &[2.0, 1.3]);
    let bounds = Bounds::new(&[(2.0, 2.0), (0.1, 4.0)]).unwrap();
    let one = fit(&decay(1.0), &data, &bounds, &[2.0, 0.5]).unwrap();
    assert_eq!(one.statuses, [Status::Held, Status::Determined]);
    assert!((one.parameters[1] - 1.3).abs() < 1e-12);
    let bounds = Bounds::new(&[(2.0, 2.0), (1.0, 1.0)]).unwrap();
    let none = fit(&decay(1.0), &data, &bounds, &[2.0, 1.0]).unwrap();
    assert_eq!((none.starts[0].iterations, none.precision.rank), (1, 0));
}

/// The data determine the product `p0 p1` and the rate of `p0 p1 exp(-p2 x)`, not the factors.
#[test]
fn factors_of_a_product_are_not_determined() {
    let model = ClosureModel::new(
        3,
        |x, p| p[0] * p[1] * (-p[2] * x[0]).exp(),
        |x, p, gradient| {
            let e = (-p[2] * x[0]).exp();
            gradient.copy_from_slice(&[p[1] * e, p[0] * e, -x[0] * p[0] * p[1] * e]);
        },
    );
    let data = noisy(&model, &places(0.0, 3.0, 15), &[2.0, 3.0, 1.3], 0.05, 3);
    let fit = fit(&model, &data, &Bounds::none(3), &[1.0, 1.0, 1.0]).unwrap();
    assert_eq!(
        fit.statuses,
        [
            Status::Undetermined,
            Status::Undetermined,
            Status::Determined
        ]
    );
    assert_eq!(fit.precision.rank, 2);
    assert_eq!(fit.goodness.degrees_of_freedom, 13);
    assert_eq!(fit.precision.standard_error(0), None);
    // Rate and error agree with those of the model with one factor.
    let two = common::fit(&decay(1.0), &data, &Bounds::none(2), &[1.0, 1.0]).unwrap();
    assert!((fit.parameters[2] - two.parameters[1]).abs() < 1e-8);
    let errors = (
        fit.precision.standard_error(2).unwrap(),
        two.precision.standard_error(1).unwrap(),
    );
    assert!((errors.0 / errors.1 - 1.0).abs() < 1e-8, "{errors:?}");
}

#[test]
fn a_step_of_no_height_has_no_place() {
    let x = places(-3.0, 3.0, 25);
    let data = Data::new(&x, Observations::new(&[4.0; 25]).unwrap()).unwrap();
    let bounds = Bounds::new(&[(0.0, 9.0), (0.0, 9.0), (-1.0, 1.0), (0.1, 2.0)]).unwrap();
    let fit = fit(&Sigmoid, &data, &bounds, &[3.0, 5.0, 0.3, 0.5]).unwrap();
    assert_eq!(fit.statuses[2..], [Status::Undetermined; 2]);
    assert_eq!(fit.statuses[..2], [Status::Determined; 2]);
    assert_eq!(fit.precision.rank, 2);
}

#[test]
fn a_step_lost_in_noise_is_weak() {
    let data = noisy(
        &Sigmoid,
        &places(-3.0, 3.0, 25),
        &[1.0, 1.02, 0.0, 0.5],
        0.1,
        8,
    );
    let bounds = Bounds::new(&[(0.0, 2.0), (0.0, 2.0), (-1.0, 1.0), (0.4, 0.8)]).unwrap();
    let fit = LevenbergMarquardt::default()
        .fit(&Sigmoid, &data, &bounds, &Starts::random(10, 1))
        .unwrap();
    let open = |status: &Status| *status != Status::Determined;
    assert!(fit.statuses[2..].iter().all(open), "{:?}", fit.statuses);
}

/// `sin(p x)` has many minima. One start misses the lowest minimum.
#[test]
fn several_starts_find_the_lowest_minimum() {
    let sine = ClosureModel::new(
        1,
        |x, p| (p[0] * x[0]).sin(),
        |x, p, gradient| gradient[0] = x[0] * (p[0] * x[0]).cos(),
    );
    let data = noisy(&sine, &places(0.0, 6.0, 60), &[7.3], 0.1, 2);
    let bounds = Bounds::new(&[(0.5, 12.0)]).unwrap();
    let one = fit(&sine, &data, &bounds, &[3.0]).unwrap();
    assert!((one.parameters[0] - 7.3).abs() > 1.0);
    let several = LevenbergMarquardt::default()
        .fit(&sine, &data, &bounds, &Starts::at(&[3.0]).and_random(24, 9))
        .unwrap();
    assert!(
        (several.parameters[0] - 7.3).abs() < 0.02,
        "{:?}",
        several.parameters
    );
    assert_eq!(several.starts.len(), 25);
    assert_eq!(several.starts[0].parameters, one.parameters);
    let agreeing = several.agreeing_starts(1e-6);
    assert!((1..25).contains(&agreeing), "{agreeing}");
    let least = several
        .starts
        .iter()
        .map(|s| s.chi_squared)
        .fold(f64::INFINITY, f64::min);
    assert!((several.goodness.chi_squared / least - 1.0).abs() < 1e-9);
}

#[test]
fn rows_hold_several_variables() {
    let plane = ClosureModel::new(
        3,
        |x, p| p[0] + p[1] * x[0] + p[2] * x[1],
        |x, _, gradient| gradient.copy_from_slice(&[1.0, x[0], x[1]]),
    );
    let rows = [0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 2.0, 3.0];
    let y = Observations::new(&[1.0, 3.0, 0.0, 2.0]).unwrap();
    let data = Data::from_rows(2, &rows, y).unwrap();
    let fit = fit(&plane, &data, &Bounds::none(3), &[0.0; 3]).unwrap();
    for (got, is) in fit.parameters.iter().zip([1.0, 2.0, -1.0]) {
        assert!((got - is).abs() < 1e-12);
    }
}

#[test]
fn a_wrong_gradient_stalls() {
    let wrong = ClosureModel::new(1, |x, p| p[0] * x[0], |x, _, gradient| gradient[0] = -x[0]);
    let data = Data::new(&[1.0, 2.0], Observations::new(&[1.0, 2.1]).unwrap()).unwrap();
    let error = fit(&wrong, &data, &Bounds::none(1), &[0.0]).unwrap_err();
    let FitError::NoConvergence { starts, .. } = error else {
        panic!("{error}");
    };
    assert_eq!(starts[0].ending, Termination::Stalled);
    assert_eq!(starts[0].parameters, [0.0]);
    let check = check_gradient(&wrong, &data, &[1.0]).unwrap();
    assert!((check.error - 2.0).abs() < 1e-9);
}

#[test]
fn searches_that_do_not_end_are_reported() {
    let options = Options {
        iterations: 3,
        ..Options::default()
    };
    let data = noisy(&decay(1.0), &places(0.0, 3.0, 15), &[2.0, 1.3], 0.05, 3);
    let starts = Starts::at(&[50.0, 0.01]).and_at(&[40.0, 0.02]);
    let error = LevenbergMarquardt::new(options)
        .unwrap()
        .fit(&decay(1.0), &data, &Bounds::none(2), &starts)
        .unwrap_err();
    let message = error.to_string();
    for part in [
        "none of 2 starts converged; the closest, start ",
        " reached the maximum number of iterations (iterations: 3, evaluations: ",
        "by parameter ",
        " and must be at most 1.0e-10; the last step changed a parameter by ",
        ", damping ",
    ] {
        assert!(message.contains(part), "{message}");
    }
    let FitError::NoConvergence { starts, .. } = error else {
        panic!("{error}");
    };
    assert!(
        starts
            .iter()
            .all(|s| s.ending == Termination::Iterations && s.iterations == 3)
    );
}

#[test]
fn a_start_where_the_model_is_not_finite_is_reported() {
    let root = ClosureModel::new(
        1,
        |x, p| p[0].sqrt() * x[0],
        |x, p, gradient| gradient[0] = 0.5 * x[0] / p[0].sqrt(),
    );
    let data = clean(&root, &[1.0, 2.0, 3.0], &[4.0]);
    let starts = Starts::at(&[-1.0]).and_at(&[1.0]);
    let fit = LevenbergMarquardt::default()
        .fit(&root, &data, &Bounds::none(1), &starts)
        .unwrap();
    assert_eq!(fit.starts[0].ending, Termination::NotFinite { point: 0 });
    assert_eq!(fit.best, 1);
    assert!((fit.parameters[0] - 4.0).abs() < 1e-12);
}

#[test]
fn bounds_and_options_out_of_order_are_refused() {
    let bounds = Bounds::new(&[(0.0, 1.0), (2.0, 1.0)]);
    let message = "bounds of parameter 1 must be in order, but are 2 and 1";
    assert_eq!(refused(bounds), message);
    assert!(Bounds::new(&[(f64::NAN, 1.0)]).is_err());
    assert!(Bounds::new(&[(f64::INFINITY, f64::INFINITY)]).is_err());
    let options = Options {
        cosine: 0.0,
        ..Options::default()
    };
    assert!(LevenbergMarquardt::new(options).is_err());
}

#[test]
fn mismatched_bounds_and_starts_are_refused() {
    let half = Bounds::new(&[(0.0, 9.0), (0.0, f64::INFINITY)]).unwrap();
    let [one, out, short] = [&[1.0, 1.0][..], &[1.0, -1.0], &[1.0]].map(Starts::at);
    let [some, none] = [3, 0].map(|count| Starts::random(count, 1));
    #[rustfmt::skip]
    let cases = [
        (15, &half, out, "start 0 must lie within bounds, but its parameter 1 is -1"),
        (15, &half, short, " must have length 2, but has 1"),
        (15, &half, some, "finite bounds, but the bounds of parameter 1 are 0 and inf"),
        (15, &half, none, "a nonlinear fit needs a start, but none was given"),
        (2, &half, one.clone(), "3 points are needed, but there are 2"),
        (15, &Bounds::none(3), one, "bounds must have length 2, but has 3"),
    ];
    for (points, bounds, starts, message) in cases {
        let data = clean(&decay(1.0), &places(0.0, 3.0, points), &[2.0, 1.3]);
        let found = refused(LevenbergMarquardt::default().fit(&decay(1.0), &data, bounds, &starts));
        assert!(found.ends_with(message), "{found}");
    }
}

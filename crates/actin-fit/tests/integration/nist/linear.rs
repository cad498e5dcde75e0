use super::problems::{Problem, read};
use crate::common::{digits, least_digits};
use actin_fit::{LinearFit, Polynomial, fit_linear};

fn fit(problem: &Problem) -> LinearFit {
    let data = problem.data();
    match problem.name.as_str() {
        "Longley" => fit_linear(problem.design().as_ref(), data.observations()).unwrap(),
        "Wampler5" => Polynomial::new(5).fit(&data).unwrap(),
        _ => Polynomial::new(10).fit(&data).unwrap(),
    }
}

/// Longley: six collinear regressors; normal equations of the raw columns (condition number 5e9)
/// lose nearly all digits of the constant. Wampler5: polynomial of degree 5 with noise of a thousand
/// times its size and standard errors up to 2e7. Filip: polynomial of degree 10 on [-8.8, -3.1], for
/// which many programs report a deficient rank.
#[test]
fn certified_values_of_linear_problems() {
    for problem in read(include_str!("linear.txt")) {
        let least = match problem.name.as_str() {
            "Longley" => [9.0, 9.0],
            "Wampler5" => [5.0, 9.0],
            _ => [5.0, 5.0],
        };
        let fit = fit(&problem);
        let error = |j| fit.precision.standard_error(j).unwrap();
        let errors: Vec<f64> = (0..fit.parameters.len()).map(error).collect();
        let got = [
            least_digits(&fit.parameters, &problem.parameters),
            least_digits(&errors, &problem.errors),
        ];
        let condition = fit.precision.condition;
        println!("{} {got:.1?} condition {condition:.1e}", problem.name);
        let is_met = got.iter().zip(least).all(|(got, least)| *got > least);
        assert!(is_met, "{}: {got:?}", problem.name);
        if problem.sum_of_squares > 0.0 {
            assert!(digits(fit.goodness.chi_squared, problem.sum_of_squares) > 9.0);
        }
    }
}

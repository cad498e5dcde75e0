//! Coverage of standard errors: over repeats with new noise, the true value lies within 1 standard
//! error in 68.3 % and within 1.96 in 95 % of the fits.

use crate::common;
use actin_fit::{
    Bounds, Data, LevenbergMarquardt, Model, Observations, Polynomial, Precision, Starts,
};
use common::{Gauss, Sigmoid, places, values};

const REPEATS: u32 = 200;

/// Numbers of true values within 1 and 1.96 standard errors.
#[derive(Debug, Default)]
struct Hits {
    one: u32,
    two: u32,
}

fn count(hits: &mut [Hits], fitted: &[f64], precision: &Precision, truth: &[f64]) {
    for (j, hits) in hits.iter_mut().enumerate() {
        let error = precision
            .standard_error(j)
            .expect("every parameter is determined");
        let distance = (fitted[j] - truth[j]).abs() / error;
        hits.one += u32::from(distance < 1.0);
        hits.two += u32::from(distance < 1.96);
    }
}

/// Requires each count within 3.5 standard deviations sqrt(200 q (1 - q)), 6.6 and 3.1. Standard
/// errors that are wrong by 30 % give 101 or 161 of 200 within one.
fn assert_covered(name: &str, hits: &[Hits]) {
    println!("{name}: {hits:?} of {REPEATS}");
    for hits in hits {
        assert!((114..=159).contains(&hits.one), "{name}: {hits:?}");
        assert!((180..=200).contains(&hits.two), "{name}: {hits:?}");
    }
}

fn observe(y: &[f64], deviations: &[f64], noise: &mut Gauss) -> Observations {
    let noisy: Vec<f64> = y
        .iter()
        .zip(deviations)
        .map(|(y, s)| y + s * noise.next())
        .collect();
    Observations::new(&noisy).unwrap()
}

/// Noise of 2 % and known size, with random starts.
#[test]
fn sigmoid_with_known_noise() {
    let truth = [3.0, 11.0, 0.01, 0.03];
    let x = places(-0.1, 0.1, 30);
    let y = values(&Sigmoid, &x, &truth);
    let deviations: Vec<f64> = y.iter().map(|y| 0.02 * y).collect();
    let bounds = Bounds::new(&[(0.0, 8.0), (6.0, 20.0), (-0.05, 0.05), (0.005, 0.1)]).unwrap();
    let mut hits: Vec<Hits> = (0..4).map(|_| Hits::default()).collect();
    let mut chi_squared = 0.0;
    for repeat in 0..u64::from(REPEATS) {
        let mut noise = Gauss::new(1000 + repeat);
        let observations = observe(&y, &deviations, &mut noise);
        let data = Data::new(&x, observations.with_deviations(&deviations).unwrap()).unwrap();
        let fit = LevenbergMarquardt::default()
            .fit(&Sigmoid, &data, &bounds, &Starts::random(4, repeat))
            .unwrap();
        count(&mut hits, &fit.parameters, &fit.precision, &truth);
        chi_squared += fit.goodness.chi_squared / f64::from(REPEATS);
    }
    assert_covered("sigmoid, known noise", &hits);
    // Mean of chi squared with 26 degrees of freedom; its deviation is sqrt(2 * 26 / 200) = 0.5.
    assert!((chi_squared - 26.0).abs() < 1.8, "{chi_squared}");
}

#[test]
fn sigmoid_with_unknown_noise() {
    let truth = [3.0, 11.0, 0.01, 0.03];
    let x = places(-0.1, 0.1, 30);
    let y = values(&Sigmoid, &x, &truth);
    let mut hits: Vec<Hits> = (0..4).map(|_| Hits::default()).collect();
    for repeat in 0..u64::from(REPEATS) {
        let mut noise = Gauss::new(3000 + repeat);
        let data = Data::new(&x, observe(&y, &[0.15; 30], &mut noise)).unwrap();
        let start = Starts::at(&[4.0, 9.0, 0.0, 0.05]);
        let fit = LevenbergMarquardt::default()
            .fit(&Sigmoid, &data, &Bounds::none(4), &start)
            .unwrap();
        count(&mut hits, &fit.parameters, &fit.precision, &truth);
    }
    assert_covered("sigmoid, unknown noise", &hits);
}

/// Degree 6, with and without constant term, for unknown and relative noise.
#[test]
fn polynomials() {
    let x = places(-0.06, 0.06, 40);
    for polynomial in [Polynomial::new(6), Polynomial::without_constant(6)] {
        let truth: Vec<f64> = polynomial
            .powers()
            .map(|k| 0.3 * (-20.0_f64).powi(k))
            .collect();
        let y: Vec<f64> = x.iter().map(|x| polynomial.value(&truth, *x)).collect();
        let deviations: Vec<f64> = x.iter().map(|x| 1e-3 + 0.1 * x.abs()).collect();
        let weights: Vec<f64> = deviations.iter().map(|s| 7.0 / (s * s)).collect();
        for weighted in [false, true] {
            let mut hits: Vec<Hits> = truth.iter().map(|_| Hits::default()).collect();
            for repeat in 0..u64::from(REPEATS) {
                let mut noise = Gauss::new(5000 + repeat);
                let observations = if weighted {
                    observe(&y, &deviations, &mut noise)
                        .with_weights(&weights)
                        .unwrap()
                } else {
                    observe(&y, &[2e-3; 40], &mut noise)
                };
                let fit = polynomial
                    .fit(&Data::new(&x, observations).unwrap())
                    .unwrap();
                count(&mut hits, &fit.parameters, &fit.precision, &truth);
            }
            assert_covered(&format!("{polynomial:?}, weighted {weighted}"), &hits);
        }
    }
}

#[test]
fn propagated_variance_matches_the_scatter_of_curves() {
    let truth = [3.0, 11.0, 0.01, 0.03];
    let x = places(-0.1, 0.1, 30);
    let y = values(&Sigmoid, &x, &truth);
    let (mut square, mut stated) = (0.0, 0.0);
    for repeat in 0..u64::from(REPEATS) {
        let mut noise = Gauss::new(9000 + repeat);
        let observations = observe(&y, &[0.1; 30], &mut noise);
        let data = Data::new(&x, observations.with_deviations(&[0.1; 30]).unwrap()).unwrap();
        let fit = LevenbergMarquardt::default()
            .fit(&Sigmoid, &data, &Bounds::none(4), &Starts::at(&truth))
            .unwrap();
        let mut gradient = [0.0; 4];
        Sigmoid.gradient(&[0.02], &fit.parameters, &mut gradient);
        let miss = Sigmoid.value(&[0.02], &fit.parameters) - Sigmoid.value(&[0.02], &truth);
        square += miss * miss;
        stated += fit.precision.propagated(&gradient).powi(2);
    }
    let ratio = square / stated;
    println!("scatter over stated variance {ratio:.3}");
    // The relative standard deviation of a variance from 200 repeats is 10 %.
    assert!((ratio - 1.0).abs() < 0.35, "{ratio}");
}

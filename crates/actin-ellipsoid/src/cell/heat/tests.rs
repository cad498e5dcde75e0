//! Limits of the sampling.

use super::*;
use crate::cell::Control::{Load, Strain};
use crate::{EllipsoidModel, EllipsoidParameters, Hold};
use actin_mechanics::testing::derivative;

const ROOM: f64 = 4.114;

fn cell() -> Cell {
    let model = EllipsoidModel::new(EllipsoidParameters::default()).unwrap();
    Cell::new(&model, 13, Hold::Means).unwrap()
}

fn held(strain: [f64; 6]) -> [Control; 6] {
    strain.map(Strain)
}

const STRAINED: [f64; 6] = [4e-3, -2e-3, 0.011, 6e-3, 3e-3, -4e-3];

/// Tolerance in standard errors: 100 numbers exceed it by chance once in 1500 runs.
const APART: f64 = 4.5;

fn heat(kt: f64, samples: usize) -> Heat {
    Heat {
        kt,
        samples,
        acceptance: 0.8,
        seed: 1,
        stream: 0,
    }
}

/// Eight-point differences.
#[test]
fn the_gradient_matches_differences_of_the_potential() {
    let cell = cell();
    let potential = Potential {
        cell: &cell,
        kt: 1e3,
        free: vec![2, 5],
        loads: SixVector::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0),
    };
    let place = DVector::from_fn(
        84,
        |k, _| if k < 78 { 0.05 } else { 0.01 } * (7.3 * k as f64 + 1.0).sin(),
    );
    let at = |place: usize, h: f64, base: &DVector<f64>| {
        let mut moved = base.clone();
        moved[place] += h;
        let mut gradient = DVector::zeros(84);
        let value = potential.slopes(&moved, &mut gradient);
        (value, gradient)
    };
    let (_, expected) = at(0, 0.0, &place);
    let hessian = potential.derivatives(&place).hessian;
    for k in 0..84 {
        let h = if k < 78 { 2e-3 } else { 2e-4 };
        let slope = derivative(h, |h| at(k, h, &place).0);
        assert!((expected[k] - slope).abs() < 1e-10 * expected.amax(), "{k}");
        let column = derivative(h, |h| at(k, h, &place).1);
        assert!(
            (hessian.column(k) - column).amax() < 1e-10 * hessian.amax(),
            "{k}"
        );
    }
}

/// Thermal contributions are of order kT: 2e-8 of those at 298 K.
#[test]
fn a_cold_cell_agrees_with_the_relaxed_one() {
    let cell = cell();
    let relaxed = cell.relax(&STRAINED.into(), None).unwrap();
    let cold = cell
        .sample(&held(STRAINED), &heat(1e-7, 800), None)
        .unwrap();
    for i in 0..6 {
        let difference = (cold.loads[i] - relaxed.loads[i]).abs();
        let size = relaxed.loads.rows(3 * (i / 3), 3).amax();
        let allowed = APART * cold.loads_error[i] + 1e-6 * size;
        assert!(difference < allowed, "{i}: {difference} {allowed}");
        assert!(allowed < 1e-4 * size, "{i}: {allowed} says nothing");
        for j in 0..6 {
            let size = (relaxed.tangent[(i, i)] * relaxed.tangent[(j, j)]).sqrt();
            let difference = (cold.tangent[(i, j)] - relaxed.tangent[(i, j)]).abs();
            let allowed = APART * cold.tangent_error[(i, j)] + 1e-4 * size;
            assert!(difference < allowed, "{i} {j}: {difference} {allowed}");
            assert!(allowed < 0.05 * size, "{i} {j}: {allowed} says nothing");
        }
    }
}

#[test]
fn means_do_not_depend_on_the_step() {
    let cell = cell();
    let with = |acceptance: f64, stream: u64| {
        let heat = Heat {
            acceptance,
            stream,
            ..heat(ROOM, 1500)
        };
        cell.sample(&held(STRAINED), &heat, None).unwrap()
    };
    let (long, short) = (with(0.4, 0), with(0.95, 1));
    assert!(long.step > 2.0 * short.step, "{} {}", long.step, short.step);
    for i in 0..6 {
        let error = long.loads_error[i].hypot(short.loads_error[i]);
        let difference = (long.loads[i] - short.loads[i]).abs();
        assert!(difference < APART * error, "{i}: {difference} {error}");
        let difference = (short.loads[i] - short.plain[i]).abs();
        let error = short.loads_error[i].hypot(short.plain_error[i]);
        assert!(
            difference < APART * error,
            "plain {i}: {difference} {error}"
        );
        assert!(short.loads_error[i] < 1.2 * short.plain_error[i], "{i}");
    }
    for response in [long, short] {
        let [ratio, error] = response.equipartition;
        assert!(
            (ratio - 1.0).abs() < APART * error && error < 0.03,
            "{ratio} {error}"
        );
    }
}

/// Differences over a stretch of 2e-3 from independent chains.
#[test]
fn the_tangent_matches_differences_of_the_loads() {
    let cell = cell();
    let at = |stretch: f64, stream: u64| {
        let heat = Heat {
            stream,
            ..heat(ROOM, 1500)
        };
        let strain = [0.0, 0.0, 0.0, 0.0, 0.0, stretch];
        cell.sample(&held(strain), &heat, None).unwrap()
    };
    let [lower, middle, upper] = [at(-1e-3, 0), at(0.0, 1), at(1e-3, 2)];
    for i in [2, 5] {
        let slope = (upper.loads[i] - lower.loads[i]) / 2e-3;
        let error = upper.loads_error[i].hypot(lower.loads_error[i]) / 2e-3;
        let error = error.hypot(middle.tangent_error[(i, 5)]);
        let difference = (slope - middle.tangent[(i, 5)]).abs();
        assert!(difference < APART * error, "{i}: {difference} {error}");
        assert!(error < 0.1 * slope, "{i}: {slope} {error}");
    }
}

/// Fluctuations of the strains of one cell limit the agreement to 10 %.
#[test]
fn free_strains_fluctuate_by_their_compliance() {
    let cell = cell();
    let pulled = [
        Strain(0.0),
        Strain(0.0),
        Load(0.0),
        Strain(0.0),
        Strain(0.0),
        Load(20.0),
    ];
    let free = cell.sample(&pulled, &heat(ROOM, 12_000), None).unwrap();
    let there = cell
        .sample(&held(free.strain.into()), &heat(ROOM, 12_000), None)
        .unwrap();
    let block =
        |of: &SixMatrix| nalgebra::Matrix2::new(of[(2, 2)], of[(2, 5)], of[(5, 2)], of[(5, 5)]);
    let compliance = block(&there.tangent).try_inverse().unwrap() * (ROOM / cell.length());
    let covariance = block(&free.covariance);
    let share = (covariance - compliance).amax() / compliance.amax();
    assert!(share < 0.1, "{covariance} {compliance}");
}

#[test]
fn sampling_is_reproducible() {
    let cell = cell();
    let with = |stream: u64| {
        let heat = Heat {
            stream,
            ..heat(ROOM, 160)
        };
        cell.sample(&held(STRAINED), &heat, None).unwrap().loads
    };
    assert_eq!(with(3), with(3));
    assert_ne!(with(3), with(4));
}

#[test]
fn normal_numbers_are_normal() {
    let mut normal = Normal::new(1, 2);
    let numbers: Vec<f64> = (0..100_000).map(|_| normal.next()).collect();
    let moment = |k: i32| numbers.iter().map(|x| x.powi(k)).sum::<f64>() / 1e5;
    let errors =
        [1.0, 2.0_f64.sqrt(), 15.0_f64.sqrt(), 96.0_f64.sqrt()].map(|x| x / 1e5_f64.sqrt());
    for ((k, expected), error) in (1..5).zip([0.0, 1.0, 0.0, 3.0]).zip(errors) {
        assert!(
            (moment(k) - expected).abs() < 5.0 * error,
            "{k}: {}",
            moment(k)
        );
    }
}

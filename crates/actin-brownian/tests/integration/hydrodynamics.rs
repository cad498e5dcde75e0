//! Effect of hydrodynamic interaction: bending modes of a chain of interacting beads, compared with
//! the local friction of a cylinder.

use actin_brownian::Cylinder;
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use std::f64::consts::PI;

const VISCOSITY: f64 = 0.89;
const RADIUS: f64 = 3.5;
/// Bending rigidity (pN nm^2).
const BEND: f64 = 3.9e4;

/// Transverse mobility of touching beads of radius `b` along `length` (nm/(pN ns)).
///
/// Rotne and Prager, J. Chem. Phys. 50 (1969) 4831; Yamakawa, J. Chem. Phys. 53 (1970) 436.
fn across_of_beads(number: usize, length: f64) -> DMatrix<f64> {
    let b = 0.5 * length / number as f64;
    let own = 1.0 / (6.0 * PI * VISCOSITY * b);
    DMatrix::from_fn(number, number, |i, j| {
        if i == j {
            return own;
        }
        let r = 2.0 * b * i.abs_diff(j) as f64;
        (1.0 + 2.0 * b * b / (3.0 * r * r)) / (8.0 * PI * VISCOSITY * r)
    })
}

fn local(cylinder: &Cylinder, number: usize) -> DVector<f64> {
    let each = cylinder.between_ends() * cylinder.length() / number as f64;
    let mut friction = DVector::from_element(number, each);
    friction[0] += cylinder.at_ends();
    friction[number - 1] += cylinder.at_ends();
    friction
}

fn of_whole(mobility: &DMatrix<f64>, length: f64) -> [f64; 2] {
    let n = mobility.nrows();
    let places = DVector::from_fn(n, |i, _| length * ((i as f64 + 0.5) / n as f64 - 0.5));
    let solved = mobility
        .clone()
        .cholesky()
        .expect("the mobility is positive definite");
    let moved = solved.solve(&DVector::from_element(n, 1.0));
    [moved.sum(), solved.solve(&places).dot(&places)]
}

fn number_of_beads(cylinder: &Cylinder) -> usize {
    let whole = cylinder.across() * cylinder.length();
    let usual = (1..2000)
        .find(|n| 2.0 * RADIUS * *n as f64 >= cylinder.length())
        .unwrap_or(1);
    let miss = |n: &usize| {
        let length = cylinder.length();
        (of_whole(&across_of_beads(*n, length), length)[0] / whole - 1.0).abs()
    };
    let fewest = usual * 7 / 10;
    let step = (usual / 20).max(1);
    let numbers = (0..13).map(|k| fewest + k * step);
    numbers
        .min_by(|a, b| miss(a).total_cmp(&miss(b)))
        .expect("the list of numbers is not empty")
}

fn stiffness(number: usize, length: f64) -> DMatrix<f64> {
    let l = length / number as f64;
    let mut k = DMatrix::zeros(number, number);
    for joint in 1..number - 1 {
        for (a, x) in [(joint - 1, 1.0), (joint, -2.0), (joint + 1, 1.0)] {
            for (b, y) in [(joint - 1, 1.0), (joint, -2.0), (joint + 1, 1.0)] {
                k[(a, b)] += BEND / l.powi(3) * x * y;
            }
        }
    }
    k
}

/// Lowest fifteen nonzero bending rates: eigenvalues of `M K` with the mobility `M`.
fn rates(mobility: &DMatrix<f64>, stiffness: &DMatrix<f64>) -> Vec<f64> {
    let root = mobility
        .clone()
        .cholesky()
        .expect("the mobility is positive definite")
        .l();
    let both = root.transpose() * stiffness * &root;
    let mut rates: Vec<f64> = SymmetricEigen::new(both)
        .eigenvalues
        .iter()
        .copied()
        .collect();
    rates.sort_by(f64::total_cmp);
    rates[2..17].to_vec()
}

/// Friction per length of a transverse wave `cos(q s)` of an infinite cylinder:
/// `4 pi eta / (K_0(q a) + q a K_1(q a)/2)`, for slender waves
/// `4 pi eta / (ln(2/(q a)) - 0.5772 + 1/2)`.
fn of_wave(q: f64) -> f64 {
    4.0 * PI * VISCOSITY / ((2.0 / (q * RADIUS)).ln() - 0.577_216 + 0.5)
}

fn compared(length: f64) -> ([f64; 2], Vec<f64>, Vec<f64>) {
    let cylinder = Cylinder::new(VISCOSITY, length, RADIUS).unwrap();
    let number = number_of_beads(&cylinder);
    let beads = across_of_beads(number, length);
    let friction = local(&cylinder, number);
    let locally = DMatrix::from_diagonal(&friction.map(f64::recip));
    let (whole, known) = (of_whole(&locally, length), of_whole(&beads, length));
    let k = stiffness(number, length);
    let modes = rates(&beads, &k).into_iter().zip(rates(&locally, &k));
    let modes: Vec<f64> = modes.map(|(beads, local)| beads / local).collect();
    let waves = (0..15).map(|n| {
        let q = (f64::from(n) + 1.5) * PI / length;
        cylinder.between_ends() / of_wave(q)
    });
    println!(
        "{length} nm, {number} beads of {:.2} nm: across {:.3}, end over end {:.3}, modes {modes:.3?}, waves {:.3?}",
        0.5 * length / number as f64,
        whole[0] / known[0],
        whole[1] / known[1],
        waves.clone().collect::<Vec<f64>>()
    );
    (
        [whole[0] / known[0], whole[1] / known[1]],
        modes,
        waves.collect(),
    )
}

/// The total friction agrees within 2 %. Interacting beads relax more slowly, the more the shorter
/// the wave. Short waves have the friction of an infinite cylinder within 10 %.
#[test]
fn local_friction_is_that_of_the_whole_and_too_small_for_waves() {
    let (whole, modes, waves) = compared(1000.0);
    assert!(
        whole.iter().all(|ratio| (ratio - 1.0).abs() < 0.02),
        "{whole:?}"
    );
    assert!(modes[0] < 1.0, "{modes:?}");
    assert!(modes.windows(2).all(|pair| pair[1] < pair[0]), "{modes:?}");
    assert!(
        (modes[14] / waves[14] - 1.0).abs() < 0.1,
        "{modes:?} {waves:?}"
    );
}

/// Short and long chains, within 5 %.
#[test]
#[ignore = "takes a minute"]
fn interaction() {
    for length in [160.0, 1000.0, 5000.0] {
        let (whole, modes, _) = compared(length);
        let misses = |ratio: &f64| (ratio - 1.0).abs();
        assert!(whole.iter().all(|ratio| misses(ratio) < 0.05), "{whole:?}");
        assert!(modes.windows(2).all(|pair| pair[1] < pair[0]), "{modes:?}");
    }
}

//! What energies, loads and tangents of relaxed cells weigh in the fit of the law without heat.

use super::super::fit::{Weighted, upper};
use super::super::rows::Row;

/// What counts as a difference of 1: a share of the value, and energy (pN), bending couple, twisting couple
/// (pN nm), shear force and tension (pN).
const SHARE: f64 = 0.05;
const FLOORS: [f64; 5] = [0.01, 0.5, 0.5, 0.1, 1.0];
/// Floor of the twisting couple (pN nm) of the straight filament, which twists easily at rest.
const STRAIGHT: f64 = 0.03;
/// Of the tangent: a share of the roots of diagonal entries, and these at least (pN nm^2, pN). Entries beside the
/// diagonal count more.
const TANGENT: f64 = 0.33;
const BESIDE: f64 = 1.4;
const SOFTEST: [f64; 6] = [5e3, 5e3, 300.0, 12.0, 12.0, 5e3];
/// Cells with a diagonal entry below this, or an eigenvalue below that, are about to change their branch: their
/// tangent says nothing of the others.
const FIRM: [f64; 6] = [1e3, 1e3, -1.0, -1.0, -1.0, 1e3];
const BRANCH: f64 = -50.0;
/// Weight of a row and of its tangent on paths of cells that are free to shear; of the grid: [`weights`].
const ON_PATHS: (f64, f64) = (3.0, 3.0);
/// Share and floor (pN nm) of the bending couple there: long filaments bend as gently as that.
const BENT: (f64, f64) = (0.02, 0.002);

/// What counts as a difference of 1 in each of the numbers of a row.
pub(super) fn deviations(row: &Row) -> [f64; 7] {
    let [energy, couple, twisting, force, tension] = FLOORS;
    let is_straight = row.strain[0] == 0.0 && row.strain[2] == 0.0 && row.extension >= 0.0;
    let twisting = if is_straight { STRAIGHT } else { twisting };
    let m = couple + SHARE * row.loads.fixed_rows::<2>(0).norm();
    let m3 = twisting + SHARE * row.loads[2].abs();
    let n = force + SHARE * row.loads.fixed_rows::<2>(3).norm();
    let n3 = tension + SHARE * row.loads[5].abs();
    [energy + SHARE * row.energy, m, m, m3, n, n, n3]
}

/// The same of a bent cell that is free to shear.
fn on_path(row: &Row) -> [f64; 7] {
    let mut sizes = deviations(row);
    let (share, floor) = BENT;
    sizes[1] = floor + share * row.loads.fixed_rows::<2>(0).norm();
    sizes[2] = sizes[1];
    sizes
}

/// Weight of a row and of its tangent: twist and tension alone and stiffness at rest count most, compression least,
/// where the cell changes its branch and no smooth law follows it.
fn weights(row: &Row) -> (f64, f64) {
    let [curvature, twist, shear, ..] = row.strain;
    let weight = match (curvature == 0.0, shear == 0.0) {
        _ if row.extension < -1e-3 => 0.15,
        _ if row.extension < -1e-4 => 0.4,
        (true, true) => 12.0,
        (false, false) => 1.0,
        _ => 1.5,
    };
    let is_small = curvature <= 1e-3 && shear <= 1e-3;
    let is_rest = is_small && twist.abs() < 4e-3 && (-1e-4..1e-3).contains(&row.extension);
    let of_tangent = match (is_small, is_rest) {
        (_, true) => 8.0,
        (true, _) => 3.0,
        _ => 1.0,
    };
    (weight, of_tangent * weight)
}

/// The rows with their weights: of the grid, and of paths.
pub(super) fn weighted<'a>(grid: &[&'a Row], paths: &'a [Row]) -> Vec<Weighted<'a>> {
    let of_grid = grid.iter().map(|row| (*row, weights(row)));
    let of_paths = paths.iter().map(|row| (row, ON_PATHS));
    let of_grid = of_grid.map(|(row, weight)| (row, deviations(row), weight));
    let of_paths = of_paths.map(|(row, weight)| (row, on_path(row), weight));
    let one = |(row, sizes, (weight, of_tangent)): (&'a Row, [f64; 7], _)| Weighted {
        row,
        numbers: sizes.map(|size| weight / size),
        tangent: entries(row)
            .into_iter()
            .map(|(at, w)| (at, w * of_tangent))
            .collect(),
    };
    of_grid.chain(of_paths).map(one).collect()
}

/// Entries of the tangent that count, with their weights.
fn entries(row: &Row) -> Vec<((usize, usize), f64)> {
    let diagonal = row.tangent.diagonal();
    let is_firm = (0..6).all(|k| diagonal[k] > FIRM[k]) && row.least_stiffness() > BRANCH;
    let size = |k: usize| diagonal[k].max(SOFTEST[k]);
    let weight = |(i, j): (usize, usize)| {
        let beside = if i == j { 1.0 } else { BESIDE };
        beside / (TANGENT * (size(i) * size(j)).sqrt())
    };
    let kept = upper().filter(|_| is_firm);
    kept.map(|place| (place, weight(place))).collect()
}

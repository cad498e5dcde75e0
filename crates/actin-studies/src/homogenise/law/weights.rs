//! Weights of energies, loads and tangents of relaxed cells in the fit of the athermal law.

use super::super::fit::Weighted;
use super::super::rows::{Row, upper};
use actin_cosserat::Homogenised;
use actin_sim::ellipsoid::{SixMatrix, SixVector};

/// Unit residual: a fraction of the value, and energy (pN), bending torque, twisting torque (pN nm), shear force,
/// tension (pN).
const SHARE: f64 = 0.05;
const FLOORS: [f64; 5] = [0.01, 0.5, 0.5, 0.1, 1.0];
/// Smallest unit residual of the twisting torque (pN nm) of the straight filament, whose twist is soft at rest.
const STRAIGHT: f64 = 0.03;
/// Unit residual of the tangent: a fraction of the square roots of diagonal entries, and lower bounds of these (pN
/// nm^2, pN). Off-diagonal entries have a larger weight.
const TANGENT: f64 = 0.33;
const BESIDE: f64 = 1.4;
const SOFTEST: [f64; 6] = [5e3, 5e3, 300.0, 12.0, 12.0, 5e3];
/// Cells with a smaller diagonal entry or eigenvalue are close to a change of branch. Their tangents are not
/// representative.
const STIFF: [f64; 6] = [1e3, 1e3, -1.0, -1.0, -1.0, 1e3];
const BRANCH: f64 = -50.0;
/// Weights of data and tangent under given strains: straight, with bending or shear, and with both. Compressed cells
/// have the last weights, since they change their branch.
const STRAIGHT_CELL: (f64, f64) = (36.0, 150.0);
const BENT_OR_SHEARED: (f64, f64) = (0.9, 1.4);
const BOTH: (f64, f64) = (0.6, 0.6);
/// Factors of the weight of the tangent at rest and at other small strains.
const AT_REST: f64 = 6.0;
const SMALL: f64 = 0.1;
/// Extensions below which a cell is compressed and up to which it is at rest; twist (rad/nm) up to which it is at
/// rest.
const REST_EXTENSION: [f64; 2] = [-1e-4, 1e-3];
const REST_TWIST: f64 = 4e-3;
/// Unit residual of a strain under given loads (relative).
const STRAIN: f64 = 0.01;
/// Relative residual above which the loss grows less than quadratically, since strains close to a change of branch
/// are not smooth functions of loads.
const ROBUST: f64 = 0.1;
/// Smallest scales of curvature, twist (rad/nm), shear and stretch; contributions of bending to the scales of twist
/// and shear (nm), and of shear to the scale of bending (1/nm).
const LEAST: [f64; 4] = [2e-5, 5e-4, 1e-4, 5e-4];
const BY_BENDING: [f64; 2] = [0.1, 15.0];
const BY_SHEAR: f64 = 1.0 / 60.0;
/// Smallest scale of the twisting torque (pN nm), and contribution of the bending torque.
const TWISTING: [f64; 2] = [0.3, 0.1];
/// Units of strains, and smallest stiffness (pN) in these units: 800 pN nm^2 for bending, 0.5 for twist, 2 pN for
/// shear and stretch.
const UNITS: [f64; 6] = [0.05, 0.05, 2.0, 1.0, 1.0, 1.0];
const SOFT: f64 = 2.0;
/// Stiffness of a prescribed twist (pN).
const HELD: f64 = 1e9;

fn deviations(row: &Row) -> [f64; 7] {
    let [energy, couple, twisting, force, tension] = FLOORS;
    let is_straight = row.strain[0] == 0.0 && row.strain[2] == 0.0 && row.extension >= 0.0;
    let twisting = if is_straight { STRAIGHT } else { twisting };
    let m = couple + SHARE * row.loads.fixed_rows::<2>(0).norm();
    let m3 = twisting + SHARE * row.loads[2].abs();
    let n = force + SHARE * row.loads.fixed_rows::<2>(3).norm();
    let n3 = tension + SHARE * row.loads[5].abs();
    [energy + SHARE * row.energy, m, m, m3, n, n, n3]
}

fn weights(row: &Row) -> (f64, f64) {
    let [curvature, twist, shear, ..] = row.strain;
    let [pushed, rest] = REST_EXTENSION;
    let is_straight = curvature == 0.0 && shear == 0.0;
    let (weight, of_tangent) = match (curvature == 0.0, shear == 0.0) {
        _ if row.extension < pushed => BOTH,
        (true, true) => STRAIGHT_CELL,
        (false, false) => BOTH,
        _ => BENT_OR_SHEARED,
    };
    let is_small = curvature <= 1e-3 && shear <= 1e-3;
    let is_rest = is_small && twist.abs() < REST_TWIST && (pushed..rest).contains(&row.extension);
    let factor = match (is_straight, is_rest) {
        (true, true) => AT_REST,
        (false, false) if is_small => SMALL,
        _ => 1.0,
    };
    (weight, factor * of_tangent)
}

/// Returns weighted cells: those under given strains, and loaded ones weighted by their agreement with `law`.
pub(super) fn weighted<'a>(
    strained: &[&'a Row],
    loaded: &'a [Row],
    law: Option<&Homogenised>,
) -> Vec<Weighted<'a>> {
    let of_strained = |row: &&'a Row| {
        let (weight, of_tangent) = weights(row);
        let entries = entries(row).into_iter();
        Weighted {
            row,
            numbers: deviations(row).map(|size| weight / size),
            tangent: entries.map(|(at, w)| (at, w * of_tangent)).collect(),
            sums: Vec::new(),
        }
    };
    let of_loaded = |row: &'a Row| Weighted {
        row,
        numbers: [0.0; 7],
        tangent: Vec::new(),
        sums: strain_sums(row)
            .map(|sum| robust(row, sum, law) / STRAIN)
            .into(),
    };
    let strained = strained.iter().map(of_strained);
    strained.chain(loaded.iter().map(of_loaded)).collect()
}

fn robust(row: &Row, sum: SixVector, law: Option<&Homogenised>) -> SixVector {
    let off = law.map_or(0.0, |law| sum.dot(&(law.loads(&row.six()) - row.loads)));
    sum / (off / ROBUST).hypot(1.0)
}

/// Returns linear combinations of torque and force that equal relative strain differences under given loads: for the
/// six strains if all are free, and with a prescribed twist, where the twisting torque replaces the twist.
pub(super) fn strain_sums(row: &Row) -> [SixVector; 12] {
    let [curvature, twist, shear, stretch, _] = row.strain;
    let [least_bend, least_twist, least_shear, least_stretch] = LEAST;
    let [to_twist, to_shear] = BY_BENDING;
    let bend = curvature + BY_SHEAR * shear + least_bend;
    let across = shear + to_shear * curvature + least_shear;
    let about = twist.abs() + to_twist * curvature + least_twist;
    let along = stretch.abs() + least_stretch;
    let sizes = [bend, bend, about, across, across, along];
    let [free, held] = [false, true].map(|is_held| compliance(&row.tangent, is_held));
    let couple = row.loads.fixed_rows::<2>(0).norm();
    let [least_couple, of_couple] = TWISTING;
    let twisting = row.loads[2].abs() + of_couple * couple + least_couple;
    let rest = SixVector::ith(2, 1.0) - held * row.tangent.column(2);
    std::array::from_fn(|k| match k {
        8 => rest / twisting,
        0..6 => free.column(k) / sizes[k],
        _ => held.column(k - 6) / sizes[k - 6],
    })
}

/// Returns the inverse of the tangent, with a stiffness of at least [`SOFT`] in all directions. With a prescribed
/// twist, the inverse is that for the other strains.
fn compliance(tangent: &SixMatrix, is_held: bool) -> SixMatrix {
    let unit = SixMatrix::from_diagonal(&UNITS.into());
    let mut scaled = unit * tangent * unit;
    if is_held {
        scaled.row_mut(2).fill(0.0);
        scaled.column_mut(2).fill(0.0);
        scaled[(2, 2)] = HELD;
    }
    let eigen = scaled.symmetric_eigen();
    let inverse = eigen.eigenvalues.map(|x| x.abs().max(SOFT).recip());
    let vectors = unit * eigen.eigenvectors;
    vectors * SixMatrix::from_diagonal(&inverse) * vectors.transpose()
}

fn entries(row: &Row) -> Vec<((usize, usize), f64)> {
    let diagonal = row.tangent.diagonal();
    let is_firm = (0..6).all(|k| diagonal[k] > STIFF[k]) && row.least_stiffness() > BRANCH;
    let size = |k: usize| diagonal[k].max(SOFTEST[k]);
    let weight = |(i, j): (usize, usize)| {
        let beside = if i == j { 1.0 } else { BESIDE };
        beside / (TANGENT * (size(i) * size(j)).sqrt())
    };
    let cached = upper().filter(|_| is_firm);
    cached.map(|place| (place, weight(place))).collect()
}

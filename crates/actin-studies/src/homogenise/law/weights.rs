//! What energies, loads and tangents of relaxed cells weigh in the fit of the law without heat.

use super::super::fit::Weighted;
use super::super::rows::{Row, upper};
use actin_cosserat::Homogenised;
use actin_sim::ellipsoid::{SixMatrix, SixVector};

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
const STIFF: [f64; 6] = [1e3, 1e3, -1.0, -1.0, -1.0, 1e3];
const BRANCH: f64 = -50.0;
/// Weights of a cell's numbers and of its tangent under given strains: straight, only bent or only sheared, and both; of
/// pushed cells, which change their branch, the last.
const STRAIGHT_CELL: (f64, f64) = (36.0, 150.0);
const BENT_OR_SHEARED: (f64, f64) = (0.9, 1.4);
const BOTH: (f64, f64) = (0.6, 0.6);
/// How much more the tangent counts where the filament is at rest: the stiffness that users know. At other small strains,
/// of which loaded cells say the same, it counts less.
const AT_REST: f64 = 6.0;
const SMALL: f64 = 0.1;
/// Extension below which a cell counts as pushed, and up to which as at rest; twist (rad/nm) of the same.
const REST_EXTENSION: [f64; 2] = [-1e-4, 1e-3];
const REST_TWIST: f64 = 4e-3;
/// Difference of a strain under given loads that counts as 1, as a share of the strain.
const STRAIN: f64 = 0.01;
/// The share from which on differences count less than their square: next to a change of branch strains follow loads in no
/// smooth way.
const ROBUST: f64 = 0.1;
/// Least sizes of curvature, twist (rad/nm), shear and stretch; and how much of its size bending lends to twist and
/// to shear (nm), and shear to bending (1/nm).
const LEAST: [f64; 4] = [2e-5, 5e-4, 1e-4, 5e-4];
const BY_BENDING: [f64; 2] = [0.1, 15.0];
const BY_SHEAR: f64 = 1.0 / 60.0;
/// Least twisting couple (pN nm), and how much a bending couple adds to it.
const TWISTING: [f64; 2] = [0.3, 0.1];
/// Units of the strains, and the least stiffness (pN) that is counted in them: 800 pN nm^2 of bending, 0.5 of twist,
/// 2 pN of shear and stretch.
const UNITS: [f64; 6] = [0.05, 0.05, 2.0, 1.0, 1.0, 1.0];
const SOFT: f64 = 2.0;
/// The stiffness of a twist that is held (pN).
const HELD: f64 = 1e9;

/// What counts as a difference of 1 in each of the numbers of a row.
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

/// Weight of a row and of its tangent.
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

/// Cells with their weights: under given strains, and loaded ones as far as `law` follows these.
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

/// A sum with less weight where the law is far off.
fn robust(row: &Row, sum: SixVector, law: Option<&Homogenised>) -> SixVector {
    let off = law.map_or(0.0, |law| sum.dot(&(law.loads(&row.six()) - row.loads)));
    sum / (off / ROBUST).hypot(1.0)
}

/// Sums of differences of couple and force that are differences of strain under given loads, as shares: of the six strains
/// where all are free, then of those where the twist is held, with the twisting couple in its place.
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

/// The inverse of a tangent, soft directions as stiff as [`SOFT`]; where the twist is held, of the other strains.
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

/// Entries of the tangent that count, with their weights.
fn entries(row: &Row) -> Vec<((usize, usize), f64)> {
    let diagonal = row.tangent.diagonal();
    let is_firm = (0..6).all(|k| diagonal[k] > STIFF[k]) && row.least_stiffness() > BRANCH;
    let size = |k: usize| diagonal[k].max(SOFTEST[k]);
    let weight = |(i, j): (usize, usize)| {
        let beside = if i == j { 1.0 } else { BESIDE };
        beside / (TANGENT * (size(i) * size(j)).sqrt())
    };
    let kept = upper().filter(|_| is_firm);
    kept.map(|place| (place, weight(place))).collect()
}

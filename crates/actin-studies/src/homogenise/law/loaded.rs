//! Cells under random loads: bending torque, shear force at any angle, tension, and twist or twisting torque. Each is
//! zero or random on a logarithmic scale.

use super::super::region::evenly;
use super::super::rows::Row;
use actin_cosserat::HomogenisedForm;
use actin_paper::cells::{relax, shortening};
use actin_sim::ellipsoid::{Cell, CellResponse, Control, SixMatrix, SixVector};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Ranges of bending torque (pN nm), shear force, tension, compression (pN), twist (rad/nm) and twisting torque (pN
/// nm), with the fraction of cells without this load.
const COUPLE: ([f64; 2], f64) = ([0.1, 800.0], 0.15);
const SHEAR: ([f64; 2], f64) = ([0.02, 20.0], 0.2);
const TENSION: ([f64; 2], f64) = ([0.3, 40.0], 0.55);
const COMPRESSION: ([f64; 2], f64) = ([0.3, 20.0], 0.75);
const TWIST: ([f64; 2], f64) = ([3e-4, 0.045], 0.1);
const TWISTING: ([f64; 2], f64) = ([0.1, 400.0], 0.33);
/// Cells with larger strains are excluded: curvature (rad/nm), twist (rad/nm), shear.
const LARGEST: [f64; 3] = [0.022, 0.05, 0.04];
/// Initial fraction of the loads. Increments grow by half, and are halved if no equilibrium is found or the twist
/// changes by more than `JUMP` (rad/nm). A cell is excluded if the increment falls below `SMALLEST`.
const SHARE: f64 = 0.25;
const SMALLEST: f64 = 0.01;
const JUMP: f64 = 0.02;

fn magnitude(([least, most], none): ([f64; 2], f64), x: f64) -> f64 {
    if x < none {
        return 0.0;
    }
    least * (most / least).powf((x - none) / (1.0 - none))
}

/// Returns rows for `count` loads after the first `skip`. Each is the mean of `each` cells, which are used in turn.
/// Loads without an equilibrium are excluded.
pub(super) fn rows(
    (cells, each): (&[Cell], usize),
    form: &HomogenisedForm,
    skip: u64,
    count: u64,
) -> Vec<Row> {
    let row = |k: u64| {
        let place = usize::try_from(k).expect("thousands of loads");
        let own = cells.iter().cycle().skip(place * each % cells.len());
        let all = own.take(each).map(|cell| loaded(cell, k));
        row(&mean(&all.collect::<Option<Vec<_>>>()?), form)
    };
    let places = skip + 1..=skip + count;
    places.into_par_iter().filter_map(row).collect()
}

fn controls(k: u64) -> impl Fn(f64) -> [Control; 6] {
    let [a, b, c, d, e, f, g, h] = evenly::<8>(k);
    let azimuth = TAU * h;
    let couple = magnitude(COUPLE, a);
    let (sin, cos) = azimuth.sin_cos();
    let bend = [couple * cos, couple * sin];
    let shear = magnitude(SHEAR, b);
    let (sin, cos) = (azimuth + TAU * c).sin_cos();
    let push = [shear * cos, shear * sin];
    let tension = magnitude(TENSION, d) - magnitude(COMPRESSION, 1.0 - d);
    let side = if f < 0.5 { 1.0 } else { -1.0 };
    move |share| {
        let load = |x: f64| Control::Load(share * x);
        let turn = if g < 0.5 {
            Control::Strain(share * side * magnitude(TWIST, e))
        } else {
            load(side * magnitude(TWISTING, e))
        };
        let [m1, m2] = bend.map(load);
        let [n1, n2] = push.map(load);
        [m1, m2, turn, n1, n2, load(tension)]
    }
}

fn loaded(cell: &Cell, k: u64) -> Option<CellResponse> {
    let controls = controls(k);
    let mut reached: Option<CellResponse> = None;
    let (mut done, mut step) = (0.0, SHARE);
    while done < 1.0 {
        let next = f64::min(1.0, done + step);
        let twist = |response: &CellResponse| response.strain[2];
        let before = reached.as_ref().map_or(0.0, twist);
        let found = relax(cell, controls(next), reached.as_ref()).ok();
        match found.filter(|response| (twist(response) - before).abs() < JUMP) {
            Some(response) => {
                (reached, done) = (Some(response), next);
                step *= 1.5;
            }
            None => step *= 0.5,
        }
        if step < SMALLEST {
            return None;
        }
    }
    reached
}

fn mean(all: &[CellResponse]) -> CellResponse {
    let share = (all.len() as f64).recip();
    CellResponse {
        strain: share * all.iter().map(|one| one.strain).sum::<SixVector>(),
        energy: share * all.iter().map(|one| one.energy).sum::<f64>(),
        loads: share * all.iter().map(|one| one.loads).sum::<SixVector>(),
        tangent: share * all.iter().map(|one| one.tangent).sum::<SixMatrix>(),
        ..all[0].clone()
    }
}

fn row(response: &CellResponse, form: &HomogenisedForm) -> Option<Row> {
    let s = response.strain;
    let turn = about_axis(s[4].atan2(s[3]));
    let [k1, k2, twist, shear, _, stretch]: [f64; 6] = (turn * s).into();
    let strain = [k1.hypot(k2), twist, shear];
    let is_small = strain.iter().zip(LARGEST).all(|(x, most)| x.abs() <= most);
    let [curvature, ..] = strain;
    is_small.then(|| Row {
        strain: [curvature, twist, shear, stretch, k2.atan2(k1).to_degrees()],
        extension: stretch - form.natural_stretch(twist) + shortening(curvature, shear),
        energy: response.energy,
        loads: turn * response.loads,
        tangent: turn * response.tangent * turn.transpose(),
        errors: SixVector::zeros(),
    })
}

fn about_axis(angle: f64) -> SixMatrix {
    let (sin, cos) = angle.sin_cos();
    let mut turn = SixMatrix::from_diagonal(&SixVector::new(cos, cos, 1.0, cos, cos, 1.0));
    for k in [0, 3] {
        turn[(k, k + 1)] = sin;
        turn[(k + 1, k)] = -sin;
    }
    turn
}

//! Strains that are no points of the grid: to test the law on, and to hold its tangent positive at.

use super::super::axes::Axes;
use super::super::filament::{mean, strain, twisted};
use super::super::rows::Row;
use super::RANGE;
use actin_cosserat::HomogenisedForm;
use actin_sim::ellipsoid::{Cell, SixVector};
use rayon::prelude::*;

/// The `k`-th of a sequence of points that fill the unit cube evenly.
///
/// # Source
/// M. Roberts, The unreasonable effectiveness of quasirandom sequences (2018): an additive recurrence with the
/// powers of the root of `x^(N+1) = x + 1`.
pub(super) fn evenly<const N: usize>(k: u64) -> [f64; N] {
    let mut root: f64 = 1.5;
    for _ in 0..60 {
        root = (1.0 + root).powf(1.0 / (N as f64 + 1.0));
    }
    let mut step = 1.0;
    std::array::from_fn(|_| {
        step /= root;
        (0.5 + k as f64 * step).fract()
    })
}

/// Strains within the range, stretched by up to 3e-3, that are no points of the grid, others for each `seed`.
pub(super) fn other_rows(
    cell: &Cell,
    axes: &Axes,
    seed: u64,
    count: u64,
) -> Result<Vec<Row>, String> {
    let last = |values: &[f64]| values[values.len() - 1];
    let (twist, stretch) = (last(&axes.twist), last(&axes.extension).min(3e-3));
    let draw = |k: u64| {
        let [a, b, c, d, e] = evenly(k);
        // Small twists and extensions are more common than large ones.
        let side: f64 = 2.0 * b - 1.0;
        let point = [
            RANGE.curvature * a,
            twist * side * side * side,
            RANGE.shear * c,
            0.0,
            360.0 * d,
        ];
        (point, stretch * e * e)
    };
    let first = seed * count + 1;
    let points: Vec<([f64; 5], f64)> = (first..first + count).map(draw).collect();
    let mean = mean()?;
    let row = |&(mut point, extension): &([f64; 5], f64)| {
        let natural = twisted(&mean, point[1])?;
        point[3] = natural.strain[5] + extension;
        let own = twisted(cell, point[1])?;
        let [k, twist, shear, stretch, angle] = point;
        let strain = strain([k, twist, shear, stretch, angle.to_radians()]);
        let response = cell
            .relax(&strain, Some(&own.displacements))
            .map_err(|e| e.to_string())?;
        Ok(Row::new(point, extension, &response))
    };
    points.par_iter().map(row).collect()
}

/// Strains up to these sizes, denser at small ones.
#[derive(Clone, Copy, Debug)]
pub(super) struct Region {
    pub(super) curvature: f64,
    pub(super) twist: f64,
    pub(super) shear: f64,
    pub(super) extension: [f64; 2],
}

impl Region {
    /// The first `count` of an even sequence, after the `skip` first.
    pub(super) fn strains(self, form: &HomogenisedForm, skip: u64, count: u64) -> Vec<SixVector> {
        let draw = |k| {
            let [a, b, c, d, e] = evenly(k);
            let (side, pull): (f64, f64) = (2.0 * b - 1.0, 2.0 * e - 1.0);
            let twist = self.twist * side * side * side;
            let [least, most] = self.extension;
            let extension = pull * pull * if pull < 0.0 { least } else { most };
            let stretch = form.natural_stretch(twist) + extension;
            let angle = std::f64::consts::TAU * d;
            strain([
                self.curvature * a * a,
                twist,
                self.shear * c * c,
                stretch,
                angle,
            ])
        };
        (skip + 1..=skip + count).map(draw).collect()
    }
}

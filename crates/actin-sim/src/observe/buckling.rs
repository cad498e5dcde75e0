//! Buckling measures of a centre line resampled at equally spaced points.

use super::View;
use crate::shape::{Buckle, equally_spaced};

type Column = (&'static str, fn(&Buckle) -> f64);

const COLUMNS: [Column; 7] = [
    ("contour_nm", |b| b.contour_nm),
    ("mean_distance_nm", |b| b.mean_distance_nm),
    ("peak_asymmetry", |b| b.peak_asymmetry),
    ("non_coplanarity", |b| b.non_coplanarity),
    ("bend", |b| b.bend),
    ("normals_rad_per_nm", |b| b.normals_rad_per_nm),
    ("supertwist_deg", |b| b.supertwist_deg),
];

pub(super) fn columns(filament: usize, points: usize) -> Vec<String> {
    let name = |(what, _)| format!("buckling[{filament}]_{points}_points_{what}");
    COLUMNS.map(name).into()
}

pub(super) fn values(view: &View<'_>, filament: usize, points: usize) -> Vec<f64> {
    let line = equally_spaced(&view.ribbon(filament).points_nm, points);
    let axis = view.assembly.filaments[filament].axis();
    let buckle = Buckle::new(&line, axis);
    COLUMNS.map(|(_, value)| value(&buckle)).into()
}

//! Buckling measures of a centre line resampled at equally spaced points.

use super::View;
use crate::shape::{Buckle, equally_spaced};

pub(super) fn columns(filament: usize, points: usize) -> Vec<String> {
    [
        "contour_nm",
        "mean_distance_nm",
        "peak_asymmetry",
        "non_coplanarity",
        "bend",
        "normals_rad_per_nm",
        "supertwist_deg",
    ]
    .map(|what| format!("buckling[{filament}]_{points}_points_{what}"))
    .into()
}

pub(super) fn values(view: &View<'_>, filament: usize, points: usize) -> Vec<f64> {
    let line = equally_spaced(&view.ribbon(filament).points_nm, points);
    let axis = view.assembly.filaments[filament].axis();
    let buckle = Buckle::new(&line, axis);
    vec![
        buckle.contour_nm,
        buckle.mean_distance_nm,
        buckle.peak_asymmetry,
        buckle.non_coplanarity,
        buckle.bend,
        buckle.normals_rad_per_nm,
        buckle.supertwist_deg,
    ]
}

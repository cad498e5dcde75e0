//! Size, asymmetry and planarity of a buckled filament.

use super::{Observe, StoredPositions, View};
use crate::shape::{Buckle, equally_spaced};

/// Buckling measures of a centre line resampled at equally spaced points.
#[derive(Debug)]
pub(super) struct Buckling {
    pub(super) filament: usize,
    pub(super) points: usize,
}

impl Observe for Buckling {
    fn columns(&self) -> Vec<String> {
        [
            "contour_nm",
            "mean_distance_nm",
            "peak_asymmetry",
            "non_coplanarity",
            "bend",
            "normals_rad_per_nm",
            "supertwist_deg",
        ]
        .map(|what| format!("buckling[{}]_{}_points_{what}", self.filament, self.points))
        .into()
    }

    fn observe(&self, view: &View<'_>, _past: &mut StoredPositions, row: &mut Vec<f64>) {
        let line = equally_spaced(&view.ribbon(self.filament).points_nm, self.points);
        let axis = view.assembly.filaments[self.filament].axis();
        let buckle = Buckle::new(&line, axis);
        row.extend([
            buckle.contour_nm,
            buckle.mean_distance_nm,
            buckle.peak_asymmetry,
            buckle.non_coplanarity,
            buckle.bend,
            buckle.normals_rad_per_nm,
            buckle.supertwist_deg,
        ]);
    }
}

//! Curvature, twist and strain at an arc length, from the centre line and its frames.

use super::{Observe, StoredPositions, View, vector};
use crate::shape::Ribbon;
use actin_mechanics::Vector3;

/// Curvature about the axes of the cross-section, and its magnitude.
#[derive(Debug)]
pub(super) struct Curvature {
    pub(super) filament: usize,
    pub(super) at_nm: f64,
}

/// Twist beyond the twist of the helix.
#[derive(Debug)]
pub(super) struct Twist {
    pub(super) filament: usize,
    pub(super) at_nm: f64,
}

/// Shear and stretch of the centre line along the axes of the cross-section.
#[derive(Debug)]
pub(super) struct Strain {
    pub(super) filament: usize,
    pub(super) at_nm: f64,
}

impl Observe for Curvature {
    fn columns(&self) -> Vec<String> {
        let name = name("curvature", self.filament, self.at_nm);
        ["_x", "_y", ""]
            .map(|axis| format!("{name}{axis}_rad_per_nm"))
            .into()
    }

    fn observe(&self, view: &View<'_>, _past: &mut StoredPositions, row: &mut Vec<f64>) {
        let ribbon = view.ribbon(self.filament);
        let kappa = between(&ribbon.s_nm, &ribbon.curvatures(), self.at_nm);
        row.extend([kappa.x, kappa.y, kappa.x.hypot(kappa.y)]);
    }
}

impl Observe for Twist {
    fn columns(&self) -> Vec<String> {
        let name = name("twist", self.filament, self.at_nm);
        vec![format!("{name}_rad_per_nm")]
    }

    fn observe(&self, view: &View<'_>, _past: &mut StoredPositions, row: &mut Vec<f64>) {
        let ribbon = view.ribbon(self.filament);
        row.push(between(&ribbon.s_nm, &ribbon.curvatures(), self.at_nm).z);
    }
}

impl Observe for Strain {
    fn columns(&self) -> Vec<String> {
        vector(&name("strain", self.filament, self.at_nm), "")
    }

    fn observe(&self, view: &View<'_>, _past: &mut StoredPositions, row: &mut Vec<f64>) {
        let ribbon = view.ribbon(self.filament);
        let strain = between(&ribbon.frame_s_nm, &strains(ribbon), self.at_nm);
        row.extend(strain.iter());
    }
}

fn name(what: &str, filament: usize, at_nm: f64) -> String {
    format!("{what}[{filament}]_at_{at_nm}nm")
}

/// Strain of each edge in its frame: edge vector over rest length, minus the axis.
fn strains(ribbon: &Ribbon) -> Vec<Vector3> {
    let edges = ribbon.points_nm.windows(2).zip(ribbon.s_nm.windows(2));
    let framed = edges.zip(&ribbon.frames);
    framed
        .map(|((ends, s_nm), frame)| {
            let edge = (ends[1] - ends[0]) / (s_nm[1] - s_nm[0]);
            frame.inverse_transform_vector(&edge) - Vector3::z()
        })
        .collect()
}

fn between(places: &[f64], values: &[Vector3], at: f64) -> Vector3 {
    let last = places.len() - 1;
    let above = places.partition_point(|&place| place < at);
    if above == 0 || above > last {
        return values[above.min(last)];
    }
    let share = (at - places[above - 1]) / (places[above] - places[above - 1]);
    values[above - 1] * (1.0 - share) + values[above] * share
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_lie_on_straight_lines() {
        let values = [1.0, 5.0, 9.0].map(|x| Vector3::x() * x);
        let places = [-1.0, 0.0, 0.5, 2.0, 2.5, 3.0, 7.0].into_iter();
        let found: Vec<f64> = places
            .map(|s| between(&[0.0, 2.0, 3.0], &values, s).x)
            .collect();
        assert_eq!(found, [1.0, 1.0, 2.0, 5.0, 7.0, 9.0, 9.0]);
    }
}

//! Buckling measures of a centre line resampled at equally spaced points.

use super::View;
use crate::shape::{Buckle, resampled};

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
    let line = resampled(&view.ribbon(filament).points_nm, points);
    let axis = view.assembly.filaments[filament].axis();
    let buckle = Buckle::new(&line, axis);
    COLUMNS.map(|(_, value)| value(&buckle)).into()
}

#[cfg(test)]
mod tests {
    use crate::observe::tests::{build, observe, value};
    use std::f64::consts::TAU;

    /// Value of a rod of 200 nm along a curve, with 50 points.
    fn of_rod(curve: &str, direction: &str, segments: u32, column: &str) -> f64 {
        let assembly = build(&format!(
            "Scene(
                filament: Filament(
                    sections: [Rod(from_nm: 0.0, to_nm: 200.0, segments: {segments})],
                    direction: {direction}, shape: {curve}, rod: RodModel(law: Constant),
                ),
                clamps: [Clamp(end: Start)],
                observe: [Buckling()],
                task: Equilibrium(),
            )"
        ));
        let row = observe(&assembly, &assembly.rest);
        value(&assembly, &row, &format!("buckling[0]_50_points_{column}"))
    }

    const DIRECTIONS: [&str; 2] = ["(0.0, 0.0, 1.0)", "(1.0, 2.0, -0.5)"];

    /// 47 angles between binormals of a helix at arc lengths `200 / 49`. Segments along tangents have their nodes on a
    /// helix whose radius is larger by `x / sin x`, for an angle `2 x` between neighbours about the axis.
    #[test]
    fn normals_of_coarse_rods_turn_by_the_torsion() {
        let helix = "Helix(radius_nm: 15.0, pitch_nm: 60.0)";
        let rise = 60.0 / TAU;
        // Errors of the spline; 50 points alone cause 0.6 %.
        for (segments, tolerance) in [(10, 0.06), (20, 0.015), (40, 0.01), (100, 0.01)] {
            let half = 100.0 / f64::from(segments) / rise.hypot(15.0);
            let radius = 15.0 * half / half.sin();
            let expected = rise / (radius * radius + rise * rise) * 47.0 / 49.0;
            let found = DIRECTIONS.map(|d| of_rod(helix, d, segments, "normals_rad_per_nm"));
            assert!((found[0] / found[1] - 1.0).abs() < 1e-9, "{found:?}");
            let error = found[0] / expected - 1.0;
            assert!(error.abs() < tolerance, "{segments}: {found:?}");
        }
    }

    #[test]
    fn an_arc_of_a_coarse_rod_is_flat_and_even() {
        let arc = "Arc(radius_nm: 100.0)";
        let bend = 1.0 - (200.0_f64 / 49.0 / 100.0).cos();
        for (segments, direction) in [(10, 0), (20, 1), (40, 0), (100, 1)] {
            let find = |column| of_rod(arc, DIRECTIONS[direction], segments, column);
            let normals = find("normals_rad_per_nm");
            assert!(normals < 1e-6, "{segments}: {normals}");
            let found = find("bend");
            assert!(
                (found / bend - 1.0).abs() < 0.01,
                "{segments}: {found} {bend}"
            );
        }
        assert!(of_rod("AtRest", DIRECTIONS[1], 10, "normals_rad_per_nm") < f64::MIN_POSITIVE);
    }
}

//! Curvature, twist and strain at an arc length, from the centre line and its frames.

use super::vector;
use crate::shape::Ribbon;
use crate::shape::axis::interpolated;
use actin_mechanics::Vector3;

pub(super) fn curvature_columns(filament: usize, at_nm: f64) -> Vec<String> {
    let name = name("curvature", filament, at_nm);
    ["_x", "_y", ""]
        .map(|axis| format!("{name}{axis}_rad_per_nm"))
        .into()
}

/// Curvature about the axes of the cross-section, and its magnitude.
pub(super) fn curvature(ribbon: &Ribbon, at_nm: f64) -> Vec<f64> {
    let kappa = between(&ribbon.s_nm, ribbon.curvatures(), at_nm);
    vec![kappa.x, kappa.y, kappa.x.hypot(kappa.y)]
}

pub(super) fn twist_columns(filament: usize, at_nm: f64) -> Vec<String> {
    vec![format!("{}_rad_per_nm", name("twist", filament, at_nm))]
}

/// Twist beyond the twist of the helix.
pub(super) fn twist(ribbon: &Ribbon, at_nm: f64) -> f64 {
    between(&ribbon.s_nm, ribbon.curvatures(), at_nm).z
}

pub(super) fn strain_columns(filament: usize, at_nm: f64) -> Vec<String> {
    vector(&name("strain", filament, at_nm), "")
}

/// Shear and stretch of the centre line along the axes of the cross-section.
pub(super) fn strain(ribbon: &Ribbon, at_nm: f64) -> Vec<f64> {
    let strain = between(&ribbon.frame_s_nm, strains(ribbon), at_nm);
    strain.as_slice().to_vec()
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

fn between(places: &[f64], values: Vec<Vector3>, at_nm: f64) -> Vector3 {
    let known: Vec<(f64, Vector3)> = places.iter().copied().zip(values).collect();
    interpolated(&known, at_nm)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Plan;
    use crate::observe::tests::{build, value};

    #[test]
    fn values_lie_on_straight_lines() {
        let values = [1.0, 5.0, 9.0].map(|x| Vector3::x() * x);
        let places = [-1.0, 0.0, 0.5, 2.0, 2.5, 3.0, 7.0].into_iter();
        let found: Vec<f64> = places
            .map(|s| between(&[0.0, 2.0, 3.0], values.to_vec(), s).x)
            .collect();
        assert_eq!(found, [1.0, 1.0, 2.0, 5.0, 7.0, 9.0, 9.0]);
    }

    fn solved(scene: &str, columns: &[&str]) -> Vec<f64> {
        let assembly = build(scene);
        let (trajectory, _) = Plan::new(&assembly).unwrap().run().unwrap();
        let row = &trajectory.records.last().unwrap().observed;
        let of = |column: &&str| value(&assembly, row, column);
        columns.iter().map(of).collect()
    }

    /// At the nodes of a rod, moment over curvature is the rigidity, also at the cross-section of a hinge.
    #[test]
    fn a_hinge_bends_its_end() {
        let found = solved(
            "Scene(
                filament: Filament(
                    sections: [Rod(from_nm: 0.0, to_nm: 100.0, segments: 10)],
                    rod: RodModel(law: Constant),
                ),
                clamps: [
                    Clamp(end: Start),
                    Clamp(end: End, hold: Pin, hinge: Hinge(bend_pn_nm_per_rad: 2000.0, twist_pn_nm_per_rad: 2000.0)),
                ],
                loads: [ForcePerLength(force_pn_per_nm: (0.03, 0.0, 0.0))],
                observe: [
                    Curvature(at_nm: 100.0), InternalLoad(at_nm: 100.0),
                    Curvature(at_nm: 50.0), InternalLoad(at_nm: 50.0),
                ],
                task: Equilibrium(),
            )",
            &[
                "curvature[0]_at_100nm_y_rad_per_nm",
                "internal_load[0]_at_100nm_moment_y_pn_nm",
                "curvature[0]_at_50nm_y_rad_per_nm",
                "internal_load[0]_at_50nm_moment_y_pn_nm",
            ],
        );
        let [end, middle] = [found[1] / found[0], found[3] / found[2]];
        // Moments are in the axes of the cross-section, curvatures between two frames.
        assert!((end / middle - 1.0).abs() < 1e-3, "{found:?}");
        assert!(found[1].abs() > 10.0, "{found:?}");
    }

    /// A torque at the end twists the whole length.
    #[test]
    fn an_end_torque_twists_the_last_half_segment() {
        let found = solved(
            "Scene(
                filament: Filament(
                    sections: [Rod(from_nm: 0.0, to_nm: 100.0, segments: 20)],
                    rod: RodModel(law: Constant),
                ),
                clamps: [Clamp(end: Start)],
                loads: [Couple(end: End, couple_pn_nm: (0.0, 0.0, 50.0))],
                observe: [Contour(), Twist(at_nm: 40.0)],
                task: Equilibrium(),
            )",
            &["contour[0]_twist_turns", "twist[0]_at_40nm_rad_per_nm"],
        );
        let turns = found[1] * 100.0 / std::f64::consts::TAU;
        assert!((found[0] / turns - 1.0).abs() < 1e-6, "{found:?}");
    }
}

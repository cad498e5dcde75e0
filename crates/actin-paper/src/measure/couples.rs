//! Bending by end couples: both ends are held in orientation, the far end is free of force.

use super::follow::{Evidence, PathPoint};
use super::sweep::{Curve, across, reaction, sweep};
use super::{MeasureError, Specimen};
use actin_mechanics::Vector3;
use actin_sim::Assembly;
use actin_sim::{End, FreeTranslation, Scene, Setting, Stage};

/// A filament bent by end couples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CouplePoint {
    /// Relative rotation of the ends over the length at rest (rad/nm).
    pub curvature_rad_per_nm: f64,
    /// Couple about the bending axis at the far end (pN nm).
    pub couple_pn_nm: f64,
    /// Couple about the bending axis at the near end (pN nm); minus the far couple in equilibrium.
    pub near_couple_pn_nm: f64,
    /// Couple across the bending axis at the far end (pN nm): zero if isotropic and untwisted.
    pub cross_couple_pn_nm: f64,
    /// Secant bending rigidity `M / kappa` (pN nm^2).
    pub rigidity_pn_nm2: f64,
    /// Quality of the equilibrium.
    pub evidence: Evidence,
}

/// Rotates the far end by `kappa L` for each curvature (rad/nm) about the transverse axis at an
/// azimuth (deg, from lab x). The far end slides freely, so that no force acts and the couple is
/// uniform.
///
/// # Errors
/// An invalid filament, or a curvature that is zero or not finite.
pub fn bend_by_couples(
    specimen: &Specimen,
    curvatures_rad_per_nm: &[f64],
    azimuth_deg: f64,
) -> Result<Curve<CouplePoint>, MeasureError> {
    let axis = across(azimuth_deg);
    // The turn uses the resolved length, which can differ from the requested length.
    let length = Assembly::build(&turns(specimen, &axis, &[]))?.length_nm();
    let scene = |curvatures: &[f64]| {
        let turns_rad: Vec<f64> = curvatures.iter().map(|kappa| kappa * length).collect();
        turns(specimen, &axis, &turns_rad)
    };
    sweep(
        "curvature_rad_per_nm",
        curvatures_rad_per_nm,
        scene,
        |assembly, curvature, stop| read(assembly, curvature, &axis, stop),
    )
}

fn turns(specimen: &Specimen, axis: &Vector3, turns_rad: &[f64]) -> Scene {
    let stage = |turn: &f64| Stage {
        set: vec![Setting::Turn {
            filament: 0,
            end: End::End,
            turn_deg: (axis * turn.to_degrees()).into(),
        }],
        duration_ns: None,
        pace: actin_sim::TimeCourse::Smooth,
    };
    let path = turns_rad.iter().map(stage).collect();
    specimen.scene(
        "Bending by couples",
        Some(FreeTranslation::Freely),
        Vec::new(),
        path,
    )
}

fn read(assembly: &Assembly, curvature: f64, axis: &Vector3, stop: &PathPoint) -> CouplePoint {
    let torque_at = |end| reaction(assembly, &stop.state, end).torque_pn_nm;
    let far = torque_at(End::End);
    let couple = far.dot(axis);
    CouplePoint {
        curvature_rad_per_nm: curvature,
        couple_pn_nm: couple,
        near_couple_pn_nm: torque_at(End::Start).dot(axis),
        cross_couple_pn_nm: (far - axis * couple).norm(),
        rigidity_pn_nm2: couple / curvature,
        evidence: stop.evidence,
    }
}

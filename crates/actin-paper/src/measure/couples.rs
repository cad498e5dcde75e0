//! Bending by end couples: both ends held in orientation, no force at the far one.

use super::follow::{Evidence, Stop};
use super::sweep::{Curve, across, reaction, sweep};
use super::{MeasureError, Specimen};
use actin_mechanics::Vector3;
use actin_sim::Assembly;
use actin_sim::{End, Scene, Setting, Slides, Stage};

/// A filament bent by couples at its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CouplePoint {
    /// Turn between the ends over length at rest (rad/nm).
    pub curvature_rad_per_nm: f64,
    /// Couple about the axis of bending that holds the far end (pN nm).
    pub couple_pn_nm: f64,
    /// Couple about the axis of bending that holds the near end (pN nm); minus the other.
    pub near_couple_pn_nm: f64,
    /// Couple across the axis of bending at the far end (pN nm): zero if isotropic and untwisted.
    pub cross_couple_pn_nm: f64,
    /// Secant bending rigidity `M / kappa` (pN nm^2).
    pub rigidity_pn_nm2: f64,
    /// How far to trust it.
    pub evidence: Evidence,
}

/// Turns the far end by `kappa L` for each curvature (rad/nm) about the transverse axis at an
/// azimuth (deg, from lab x); it slides freely, so that no force acts and the couple is the same
/// all along.
///
/// # Errors
/// A filament that is refused, a curvature that is zero or not finite.
pub fn bend_by_couples(
    specimen: &Specimen,
    curvatures_rad_per_nm: &[f64],
    azimuth_deg: f64,
) -> Result<Curve<CouplePoint>, MeasureError> {
    let axis = across(azimuth_deg);
    // The length as resolved, not as asked for, makes turns of curvatures.
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
        pace: actin_sim::Pace::Smooth,
    };
    let path = turns_rad.iter().map(stage).collect();
    specimen.scene("Bending by couples", Some(Slides::Freely), Vec::new(), path)
}

fn read(assembly: &Assembly, curvature: f64, axis: &Vector3, stop: &Stop) -> CouplePoint {
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

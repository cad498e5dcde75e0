//! Stretch at blocked turn, by a force or a displacement.

use super::follow::{Evidence, PathPoint};
use super::sweep::{Curve, far_end_shift, reaction, sweep};
use super::{MeasureError, Specimen};
use actin_sim::Assembly;
use actin_sim::{End, FreeTranslation, Load, Scene, Setting, Stage};

/// A filament under axial force with its ends held against rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StretchPoint {
    /// Axial force on the far end (pN), positive in tension.
    pub force_pn: f64,
    /// Change of length over length at rest.
    pub strain: f64,
    /// Secant stretching rigidity `F L / dL` (pN).
    pub rigidity_pn: f64,
    /// Torque about the axis that holds the far end (pN nm).
    pub torque_pn_nm: f64,
    /// Quality of the equilibrium.
    pub evidence: Evidence,
}

/// Pulls the far end along the axis with each force (pN); it slides along the axis only.
///
/// # Errors
/// An invalid filament, or a force that is zero or not finite.
///
/// # Source
/// arXiv 2203.01284, Appendix B: `S3 = F L / dL`.
pub fn stretch_by_force(
    specimen: &Specimen,
    forces_pn: &[f64],
) -> Result<Curve<StretchPoint>, MeasureError> {
    let scene = |forces: &[f64]| {
        let unit = Load::EndForce {
            filament: 0,
            end: End::End,
            force_pn: [0.0, 0.0, 1.0],
        };
        let path = factors(forces);
        specimen.scene(
            "Stretch by force",
            Some(FreeTranslation::AlongAxis),
            vec![unit],
            path,
        )
    };
    sweep("force_pn", forces_pn, scene, |assembly, force, stop| {
        read(assembly, force, stop)
    })
}

/// Moves the far end along the axis to each strain.
///
/// # Errors
/// An invalid filament, or a strain that is zero or not finite.
///
/// # Source
/// arXiv 2203.01284, Appendix B.
pub fn stretch_by_shift(
    specimen: &Specimen,
    strains: &[f64],
) -> Result<Curve<StretchPoint>, MeasureError> {
    // The displacement uses the resolved length, which can differ from the requested length.
    let length = Assembly::build(&shifts(specimen, &[]))?.length_nm();
    let scene = |strains: &[f64]| {
        let shifts_nm: Vec<f64> = strains.iter().map(|strain| strain * length).collect();
        shifts(specimen, &shifts_nm)
    };
    sweep("strain", strains, scene, |assembly, _, stop| {
        let force = reaction(assembly, &stop.state, End::End).force_pn.z;
        read(assembly, force, stop)
    })
}

/// One stage for each factor of the first load.
pub(super) fn factors(factors: &[f64]) -> Vec<Stage> {
    let stage = |&factor: &f64| Stage {
        set: vec![Setting::LoadFactor { load: 0, factor }],
        duration_ns: None,
        pace: actin_sim::TimeCourse::Smooth,
    };
    factors.iter().map(stage).collect()
}

fn shifts(specimen: &Specimen, shifts_nm: &[f64]) -> Scene {
    let stage = |&shift: &f64| Stage {
        set: vec![Setting::Shift {
            filament: 0,
            end: End::End,
            shift_nm: [0.0, 0.0, shift],
        }],
        duration_ns: None,
        pace: actin_sim::TimeCourse::Smooth,
    };
    let path = shifts_nm.iter().map(stage).collect();
    specimen.scene(
        "Stretch by shift",
        Some(FreeTranslation::Nowhere),
        Vec::new(),
        path,
    )
}

fn read(assembly: &Assembly, force_pn: f64, stop: &PathPoint) -> StretchPoint {
    let strain = far_end_shift(assembly, &stop.state).z / assembly.length_nm();
    StretchPoint {
        force_pn,
        strain,
        rigidity_pn: force_pn / strain,
        torque_pn_nm: reaction(assembly, &stop.state, End::End).torque_pn_nm.z,
        evidence: stop.evidence,
    }
}

//! Shear: the far end is pushed across the axis with its orientation held.

use super::follow::{Evidence, PathPoint};
use super::stretch::factors;
use super::sweep::{Curve, across, far_end_shift, sweep};
use super::{MeasureError, Specimen};
use actin_mechanics::Vector3;
use actin_sim::Assembly;
use actin_sim::{End, FreeTranslation, Load};

/// A filament sheared by a transverse force with parallel ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearPoint {
    /// Transverse force on the far end (pN).
    pub force_pn: f64,
    /// Displacement of the far end along the force (nm).
    pub shift_nm: f64,
    /// Displacement over length at rest, from shear and S-shaped bending.
    pub shear: f64,
    /// Secant `F L / d` (pN), a lower bound of the shear rigidity, since bending adds to `d`.
    pub apparent_rigidity_pn: f64,
    /// Quality of the equilibrium.
    pub evidence: Evidence,
}

/// Pushes the far end with each transverse force (pN) at an azimuth about the axis (deg, from lab
/// x). Its orientation is held and it slides freely.
///
/// # Errors
/// An invalid filament, or a force that is zero or not finite.
pub fn shear_by_force(
    specimen: &Specimen,
    forces_pn: &[f64],
    azimuth_deg: f64,
) -> Result<Curve<ShearPoint>, MeasureError> {
    let direction = across(azimuth_deg);
    let scene = |forces: &[f64]| {
        let unit = Load::EndForce {
            filament: 0,
            end: End::End,
            force_pn: direction.into(),
        };
        let path = factors(forces);
        specimen.scene("Shear", Some(FreeTranslation::Freely), vec![unit], path)
    };
    sweep("force_pn", forces_pn, scene, |assembly, force, stop| {
        read(assembly, force, &direction, stop)
    })
}

fn read(assembly: &Assembly, force_pn: f64, direction: &Vector3, stop: &PathPoint) -> ShearPoint {
    let shift = far_end_shift(assembly, &stop.state).dot(direction);
    let shear = shift / assembly.length_nm();
    ShearPoint {
        force_pn,
        shift_nm: shift,
        shear,
        apparent_rigidity_pn: force_pn / shear,
        evidence: stop.evidence,
    }
}

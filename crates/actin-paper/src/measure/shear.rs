//! Shear: the far end pushed across the axis, its orientation held.

use super::follow::{Evidence, Stop};
use super::stretch::factors;
use super::sweep::{Curve, across, far_end_shift, sweep};
use super::{MeasureError, Specimen};
use actin_mechanics::Vector3;
use actin_sim::Assembly;
use actin_sim::{End, Load, Slides};

/// A filament sheared by a transverse force, its ends kept parallel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearPoint {
    /// Transverse force on the far end (pN).
    pub force_pn: f64,
    /// Displacement of the far end along the force (nm).
    pub shift_nm: f64,
    /// Displacement over length at rest: shear and S-shaped bending together.
    pub shear: f64,
    /// Secant `F L / d` (pN), a lower bound of the shearing rigidity: bending adds to `d`.
    pub apparent_rigidity_pn: f64,
    /// How far to trust it.
    pub evidence: Evidence,
}

impl ShearPoint {
    /// The secant shearing rigidity (pN) left when the bending of a guided beam of rigidity
    /// `bending_pn_nm2` is taken off: `F / (d / L - F L^2 / 12 B)`. Negative where bending alone
    /// would go further than `d`.
    pub fn rigidity_pn(&self, length_nm: f64, bending_pn_nm2: f64) -> f64 {
        let bending = self.force_pn * length_nm.powi(2) / (12.0 * bending_pn_nm2);
        self.force_pn / (self.shear - bending)
    }
}

/// Pushes the far end with each force (pN) across the axis, at an azimuth about it (deg, from
/// lab x); its orientation is held and it slides freely.
///
/// # Errors
/// A filament that is refused, a force that is zero or not finite.
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
        specimen.scene("Shear", Some(Slides::Freely), vec![unit], path)
    };
    sweep("force_pn", forces_pn, scene, |assembly, force, stop| {
        read(assembly, force, &direction, stop)
    })
}

fn read(assembly: &Assembly, force_pn: f64, direction: &Vector3, stop: &Stop) -> ShearPoint {
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

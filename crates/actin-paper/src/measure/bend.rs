//! Bending by a transverse force at the free tip.

use super::elastica::rigidity_ratio;
use super::follow::{Evidence, PathPoint};
use super::stretch::factors;
use super::sweep::{Curve, across, sweep};
use super::{MeasureError, Specimen};
use actin_mechanics::Vector3;
use actin_sim::Assembly;
use actin_sim::{End, Load};

/// A cantilever under a tip force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipForcePoint {
    /// Transverse force on the tip (pN).
    pub force_pn: f64,
    /// Displacement of the tip along the force (nm).
    pub deflection_nm: f64,
    /// Secant bending rigidity for small deflections, `F L^3 / 3 d` (pN nm^2).
    pub linear_rigidity_pn_nm2: f64,
    /// Rigidity of the inextensible elastica with the same deflection (pN nm^2).
    pub elastica_rigidity_pn_nm2: f64,
    /// Quality of the equilibrium.
    pub evidence: Evidence,
}

/// Loads the free tip with each transverse force (pN) at an azimuth about the axis (deg, from lab
/// x).
///
/// Both rigidities neglect shear, and the elastica neglects stretch. Monomers have no shear
/// stiffness at rest, so that neither value is a material property at small forces. See
/// [`super::bend_by_couples`].
///
/// # Errors
/// An invalid filament, or a force that is zero or not finite.
pub fn bend_by_tip_force(
    specimen: &Specimen,
    forces_pn: &[f64],
    azimuth_deg: f64,
) -> Result<Curve<TipForcePoint>, MeasureError> {
    let direction = across(azimuth_deg);
    let scene = |forces: &[f64]| {
        let unit = Load::EndForce {
            filament: 0,
            end: End::End,
            force_pn: direction.into(),
        };
        specimen.scene("Bending by a tip force", None, vec![unit], factors(forces))
    };
    sweep("force_pn", forces_pn, scene, |assembly, force, stop| {
        read(assembly, force, &direction, stop)
    })
}

fn read(
    assembly: &Assembly,
    force_pn: f64,
    direction: &Vector3,
    stop: &PathPoint,
) -> TipForcePoint {
    let length = assembly.length_nm();
    let tip = |state| assembly.tip_nm(state, End::End);
    let deflection = (tip(&stop.state) - tip(&assembly.rest)).dot(direction);
    let linear = force_pn * length.powi(3) / (3.0 * deflection);
    TipForcePoint {
        force_pn,
        deflection_nm: deflection,
        linear_rigidity_pn_nm2: linear,
        elastica_rigidity_pn_nm2: linear * rigidity_ratio(deflection.abs() / length),
        evidence: stop.evidence,
    }
}

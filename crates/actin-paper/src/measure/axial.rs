//! Protocols along the axis: twist, and stretch at blocked turn.

use super::follow::{Evidence, PathPoint};
use super::sweep::{Curve, Protocol, far_end_shift, force, reaction};
use super::{MeasureError, Specimen};
use crate::run::shift;
use actin_mechanics::Vector3;
use actin_sim::{Assembly, End, FreeTranslation, Setting};

/// A filament held at an angle of twist with free length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwistPoint {
    /// Turn of the far end about the axis (deg); positive is right-handed, that is over-twist.
    pub turn_deg: f64,
    /// Turn per length at rest, `kappa = phi / L` (rad/nm).
    pub curvature_rad_per_nm: f64,
    /// Torque about the axis that holds the far end (pN nm).
    pub torque_pn_nm: f64,
    /// Torque about the axis that holds the near end (pN nm); minus the far torque in equilibrium.
    pub near_torque_pn_nm: f64,
    /// Secant twisting rigidity `tau L / phi` (pN nm^2).
    pub rigidity_pn_nm2: f64,
    /// Change of length over length at rest.
    pub relative_length_change: f64,
    /// Quality of the equilibrium.
    pub evidence: Evidence,
}

/// Turns the far end about the axis by each angle (deg). It slides along the axis only.
///
/// The secant rigidity is `B3 = tau L / phi` with the torque `tau` at the far end about lab z, the
/// length at rest `L` and the angle `phi`. The accuracy of torques is about the tolerance of the
/// solver.
///
/// # Errors
/// An invalid filament, or an angle that is zero or not finite.
///
/// # Source
/// arXiv 2203.01284, Appendix B, Tables 3 and 5.
pub fn twist(specimen: &Specimen, turns_deg: &[f64]) -> Result<Curve<TwistPoint>, MeasureError> {
    let protocol = Protocol::new(specimen, Some(FreeTranslation::AlongAxis), None);
    let settings = |deg: f64| vec![Setting::turn(End::End, [0.0, 0.0, deg])];
    protocol.sweep("turn_deg", turns_deg, settings, read_twist)
}

fn read_twist(assembly: &Assembly, turn_deg: f64, stop: &PathPoint) -> TwistPoint {
    let length = assembly.length_nm();
    let torque_at = |end| reaction(assembly, &stop.state, end).torque_pn_nm.z;
    let curvature = turn_deg.to_radians() / length;
    let torque = torque_at(End::End);
    TwistPoint {
        turn_deg,
        curvature_rad_per_nm: curvature,
        torque_pn_nm: torque,
        near_torque_pn_nm: torque_at(End::Start),
        rigidity_pn_nm2: torque / curvature,
        relative_length_change: far_end_shift(assembly, &stop.state).z / length,
        evidence: stop.evidence,
    }
}

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
    let protocol = Protocol::new(
        specimen,
        Some(FreeTranslation::AlongAxis),
        Some(Vector3::z()),
    );
    protocol.sweep("force_pn", forces_pn, |pn| vec![force(pn)], read_stretch)
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
    let protocol = Protocol::new(specimen, Some(FreeTranslation::Nowhere), None);
    let length = protocol.length_nm()?;
    let settings = |strain: f64| vec![shift(End::End, strain * length)];
    protocol.sweep("strain", strains, settings, |assembly, _, stop| {
        let force = reaction(assembly, &stop.state, End::End).force_pn.z;
        read_stretch(assembly, force, stop)
    })
}

fn read_stretch(assembly: &Assembly, force_pn: f64, stop: &PathPoint) -> StretchPoint {
    let strain = far_end_shift(assembly, &stop.state).z / assembly.length_nm();
    StretchPoint {
        force_pn,
        strain,
        rigidity_pn: force_pn / strain,
        torque_pn_nm: reaction(assembly, &stop.state, End::End).torque_pn_nm.z,
        evidence: stop.evidence,
    }
}

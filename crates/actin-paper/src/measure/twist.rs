//! Twist: torque and change of length at held angles.

use super::follow::{Evidence, PathPoint};
use super::sweep::{Curve, far_end_shift, reaction, sweep};
use super::{MeasureError, Specimen};
use actin_sim::Assembly;
use actin_sim::{End, FreeTranslation, Scene, Setting, Stage};

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
    let scene = |turns: &[f64]| scene(specimen, turns);
    sweep("turn_deg", turns_deg, scene, read)
}

fn scene(specimen: &Specimen, turns_deg: &[f64]) -> Scene {
    let stage = |&turn: &f64| {
        let turn_deg = [0.0, 0.0, turn];
        let end = End::End;
        Stage {
            set: vec![Setting::Turn {
                filament: 0,
                end,
                turn_deg,
            }],
            duration_ns: None,
            pace: actin_sim::TimeCourse::Smooth,
        }
    };
    let path = turns_deg.iter().map(stage).collect();
    specimen.scene("Twist", Some(FreeTranslation::AlongAxis), Vec::new(), path)
}

pub(super) fn read(assembly: &Assembly, turn_deg: f64, stop: &PathPoint) -> TwistPoint {
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

//! Twist: couple and change of length at held angles.

use super::follow::{Evidence, Stop};
use super::sweep::{Curve, far_end_shift, in_order, reaction, sweep};
use super::{MeasureError, Specimen};
use actin_sim::Assembly;
use actin_sim::{End, Scene, Setting, Slides, Stage};

/// A filament held at an angle of twist, free to change its length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwistPoint {
    /// Turn of the far end about the axis (deg); positive is right-handed, that is over-twist.
    pub turn_deg: f64,
    /// Turn per length at rest, `kappa = phi / L` (rad/nm).
    pub curvature_rad_per_nm: f64,
    /// Couple about the axis that holds the far end (pN nm).
    pub torque_pn_nm: f64,
    /// Couple about the axis that holds the near end (pN nm); minus the other.
    pub near_torque_pn_nm: f64,
    /// Secant twisting rigidity `tau L / phi` (pN nm^2).
    pub rigidity_pn_nm2: f64,
    /// Change of length over length at rest.
    pub relative_length_change: f64,
    /// How far to trust it.
    pub evidence: Evidence,
}

/// Turns the far end about the axis by each angle (deg), free to slide along the axis only.
///
/// The secant rigidity is `B3 = tau L / phi`, `tau` the couple at the far end about lab z, `L` the
/// length at rest, `phi` the angle. Torques are accurate to about the tolerance of the solver.
///
/// # Errors
/// A filament that is refused, an angle that is zero or not finite.
///
/// # Source
/// arXiv 2203.01284, Appendix B, Tables 3 and 5.
pub fn twist(specimen: &Specimen, turns_deg: &[f64]) -> Result<Curve<TwistPoint>, MeasureError> {
    let scene = |turns: &[f64]| scene(specimen, turns);
    sweep("turn_deg", turns_deg, scene, read)
}

/// The same along one path, in the order in which the angles are given: out and back, say, which
/// shows where large twist has more than one equilibrium.
///
/// # Errors
/// As [`twist`].
pub fn twist_in_order(
    specimen: &Specimen,
    turns_deg: &[f64],
) -> Result<Curve<TwistPoint>, MeasureError> {
    let scene = |turns: &[f64]| scene(specimen, turns);
    in_order("turn_deg", turns_deg, scene, read)
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
            pace: actin_sim::Pace::Smooth,
        }
    };
    let path = turns_deg.iter().map(stage).collect();
    specimen.scene("Twist", Some(Slides::AlongAxis), Vec::new(), path)
}

pub(super) fn read(assembly: &Assembly, turn_deg: f64, stop: &Stop) -> TwistPoint {
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

//! Protocols along the axis: twist, stretch at blocked turn, and twist under axial force.

use super::follow::{Evidence, PathPoint};
use super::sweep::{
    Curve, MissingEquilibrium, Protocol, check, check_finite, far_end_shift, force, reaction,
};
use super::{MeasureError, Specimen};
use crate::run::{shift, turn};
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
    let settings = |deg: f64| vec![turn(End::End, [0.0, 0.0, deg])];
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

/// Tolerance on the torque at a free end, relative to the torque at turn 0.
const COUPLE_LEFT: f64 = 1e-4;
/// Limit on the number of equilibria in the search for the torque-free turn at one force.
const TRIALS: usize = 60;
/// First step of the search (deg); it doubles until the torque changes sign.
const FIRST_STEP_DEG: f64 = 0.25;

/// A filament under axial force, twisted or free to turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PulledTwistPoint {
    /// Axial force on the far end (pN), positive in tension.
    pub force_pn: f64,
    /// Turn, torque and change of length relative to the unloaded filament at rest.
    pub twist: TwistPoint,
}

/// Turns the far end about the axis by each angle (deg) under an axial force (pN, positive in
/// tension). The far end slides along the axis.
///
/// For an energy `U(strain, kappa_3)` per length, the torque is `dU / d kappa_3` at the strain of
/// the force. With `U = int B3 k dk + S3 (strain - xi + 1)^2 / 2` it is `B3 kappa_3 - F d xi / d
/// kappa_3`: the force adds the torque of twist-stretch coupling.
///
/// # Errors
/// An invalid filament, an angle that is zero or not finite, or a force that is not finite.
pub fn twist_under_tension(
    specimen: &Specimen,
    force_pn: f64,
    turns_deg: &[f64],
) -> Result<Curve<PulledTwistPoint>, MeasureError> {
    check_finite("force_pn", force_pn)?;
    let settings = |turn: f64| controls(force_pn, turn);
    pulled(specimen).sweep("turn_deg", turns_deg, settings, |assembly, turn, stop| {
        let twist = read_twist(assembly, turn, stop);
        PulledTwistPoint { force_pn, twist }
    })
}

/// Pulls the far end along the axis with each force (pN) and turns it until its torque is below
/// 1e-4 of the blocking torque.
///
/// The torque of monomers in compression can jump across zero between two equilibria. The force is
/// then reported as unreached.
///
/// # Errors
/// An invalid filament, or a force that is zero or not finite.
pub fn free_turn_under_tension(
    specimen: &Specimen,
    forces_pn: &[f64],
) -> Result<Curve<PulledTwistPoint>, MeasureError> {
    check("force_pn", forces_pn)?;
    let mut all = Curve::empty();
    for &force_pn in forces_pn {
        all.append(free_turn(specimen, force_pn)?);
    }
    Ok(all)
}

/// Brackets the zero of the torque from turn 0 by growing steps, then applies false position with
/// halved weight of a retained end (Illinois algorithm).
fn free_turn(specimen: &Specimen, force_pn: f64) -> Result<Curve<PulledTwistPoint>, MeasureError> {
    let mut curve = held(specimen, force_pn, 0.0)?;
    let Some(blocked) = curve.points.first().map(couple) else {
        return Ok(curve);
    };
    // Turn (deg) and torque (pN nm) on both sides of the zero; the second one is the latest.
    let (mut from, mut to) = ((0.0, blocked), None::<(f64, f64)>);
    let mut here = from;
    let mut turn = -FIRST_STEP_DEG * blocked.signum();
    for _ in 0..TRIALS {
        curve = held(specimen, force_pn, turn)?;
        let left = match curve.points.first().map(couple) {
            Some(left) if left.abs() > COUPLE_LEFT * blocked.abs() => left,
            _ => return Ok(curve),
        };
        here = (turn, left);
        let is_before_zero = to.is_none() && left * from.1 > 0.0;
        match to {
            Some(last) if left * last.1 < 0.0 => from = last,
            Some(_) => from.1 *= 0.5,
            None if is_before_zero => from = here,
            None => {}
        }
        if is_before_zero {
            turn *= 2.0;
        } else {
            turn -= left * (turn - from.0) / (left - from.1);
            to = Some(here);
        }
    }
    curve.points.clear();
    // A torque that jumps across zero has several equilibria and no root.
    let (turn, left) = here;
    let reason = format!("a torque of {left} pN nm remains at {turn} deg after {TRIALS} trials");
    let value = force_pn;
    curve.unreached.push(MissingEquilibrium { value, reason });
    Ok(curve)
}

fn couple(point: &PulledTwistPoint) -> f64 {
    point.twist.torque_pn_nm
}

/// Equilibrium at a force and a turn; the secant rigidity is NaN at turn 0.
fn held(
    specimen: &Specimen,
    force_pn: f64,
    turn_deg: f64,
) -> Result<Curve<PulledTwistPoint>, MeasureError> {
    let settings = |force_pn| controls(force_pn, turn_deg);
    pulled(specimen).along(&[force_pn], settings, |assembly, force_pn, stop| {
        let twist = read_twist(assembly, turn_deg, stop);
        PulledTwistPoint { force_pn, twist }
    })
}

fn pulled(specimen: &Specimen) -> Protocol<'_> {
    Protocol::new(
        specimen,
        Some(FreeTranslation::AlongAxis),
        Some(Vector3::z()),
    )
}

/// Axial force (pN) and turn (deg) of the far end.
fn controls(force_pn: f64, turn_deg: f64) -> Vec<Setting> {
    vec![force(force_pn), turn(End::End, [0.0, 0.0, turn_deg])]
}

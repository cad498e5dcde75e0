//! Protocols across the axis: bending by a tip force or by couples, also under twist, and shear.

use super::elastica::rigidity_ratio;
use super::follow::{Evidence, PathPoint};
use super::sweep::{Curve, Protocol, across, check_finite, far_end_shift, force, reaction};
use super::{MeasureError, Specimen};
use actin_mechanics::{UnitQuaternion, Vector3, rotation};
use actin_sim::{Assembly, End, FreeTranslation, Setting};
use std::f64::consts::TAU;

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
    let protocol = Protocol::new(specimen, None, Some(direction));
    let read = |assembly: &Assembly, force_pn: f64, stop: &PathPoint| {
        let length = assembly.length_nm();
        let tip = |state| assembly.tip_nm(state, End::End);
        let deflection = (tip(&stop.state) - tip(&assembly.rest)).dot(&direction);
        let linear = force_pn * length.powi(3) / (3.0 * deflection);
        TipForcePoint {
            force_pn,
            deflection_nm: deflection,
            linear_rigidity_pn_nm2: linear,
            elastica_rigidity_pn_nm2: linear * rigidity_ratio(deflection.abs() / length),
            evidence: stop.evidence,
        }
    };
    protocol.sweep("force_pn", forces_pn, |pn| vec![force(pn)], read)
}

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
    let protocol = Protocol::new(specimen, Some(FreeTranslation::Freely), None);
    let length = protocol.length_nm()?;
    let settings = |kappa: f64| {
        vec![Setting::turn(
            End::End,
            axis * (kappa * length).to_degrees(),
        )]
    };
    let read = |assembly: &Assembly, curvature: f64, stop: &PathPoint| {
        let torque_at = |end| reaction(assembly, &stop.state, end).torque_pn_nm;
        let far = torque_at(End::End);
        let couple = far.dot(&axis);
        CouplePoint {
            curvature_rad_per_nm: curvature,
            couple_pn_nm: couple,
            near_couple_pn_nm: torque_at(End::Start).dot(&axis),
            cross_couple_pn_nm: (far - axis * couple).norm(),
            rigidity_pn_nm2: couple / curvature,
            evidence: stop.evidence,
        }
    };
    let name = "curvature_rad_per_nm";
    protocol.sweep(name, curvatures_rad_per_nm, settings, read)
}

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
    let protocol = Protocol::new(specimen, Some(FreeTranslation::Freely), Some(direction));
    let read = |assembly: &Assembly, force_pn: f64, stop: &PathPoint| {
        let shift = far_end_shift(assembly, &stop.state).dot(&direction);
        let shear = shift / assembly.length_nm();
        ShearPoint {
            force_pn,
            shift_nm: shift,
            shear,
            apparent_rigidity_pn: force_pn / shear,
            evidence: stop.evidence,
        }
    };
    protocol.sweep("force_pn", forces_pn, |pn| vec![force(pn)], read)
}

/// A filament twisted and bent by a uniform couple: a helix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HelixPoint {
    /// Turn of the far end about the axis, before the tilt, over length at rest (rad/nm).
    pub twist_rad_per_nm: f64,
    /// Prescribed tilt of the far end over length at rest (rad/nm).
    pub tilt_rad_per_nm: f64,
    /// Curvature of the helix (rad/nm); equal to the tilt per length if untwisted.
    pub curvature_rad_per_nm: f64,
    /// Couple at the far end (pN nm, lab frame).
    pub couple_pn_nm: Vector3,
    /// Component of the couple along the filament (pN nm), at the near end.
    pub twisting_couple_pn_nm: f64,
    /// Twist of the helix (rad/nm) that gives the turn of the far end.
    pub helix_twist_rad_per_nm: f64,
    /// Secant bending rigidity (pN nm^2): transverse component of the couple over curvature.
    pub rigidity_pn_nm2: f64,
    /// Quality of the equilibrium.
    pub evidence: Evidence,
}

/// Turns the far end about the axis by `twist L`, then tilts it by each `tilt L` (rad/nm) about the
/// transverse axis at an azimuth (deg, from lab x). It slides freely, so that no force acts.
///
/// The couple `m` is uniform, and an isotropic rod with secants `B` and `B3` is a helix. Its far
/// end is rotated by `exp(L m / B) exp(L (kappa_3 - m_3 / B) e3)` with `m_3 = m . e3` at the near
/// end. `B` follows from the tilt: `sin(theta / 2) = sin(gamma) sin(L m / 2 B)` with the angle
/// `gamma` between couple and filament. The result is the smallest root, so that `L m / B` must be
/// less than half a turn; use shorter filaments for larger twist. Rigidity and curvature are NaN
/// without a root.
///
/// # Errors
/// An invalid filament, a tilt that is zero or not finite, or a twist that is not finite.
pub fn bend_twisted(
    specimen: &Specimen,
    twist_rad_per_nm: f64,
    tilts_rad_per_nm: &[f64],
    azimuth_deg: f64,
) -> Result<Curve<HelixPoint>, MeasureError> {
    check_finite("twist_rad_per_nm", twist_rad_per_nm)?;
    let axis = across(azimuth_deg);
    let protocol = Protocol::new(specimen, Some(FreeTranslation::Freely), None);
    let length = protocol.length_nm()?;
    let twist = Vector3::z() * (twist_rad_per_nm * length);
    let settings = |tilt: f64| {
        let turned = composed(axis * (tilt * length), twist);
        vec![Setting::turn(End::End, turned.map(f64::to_degrees))]
    };
    let read = |assembly: &Assembly, tilt: f64, stop: &PathPoint| {
        let far = reaction(assembly, &stop.state, End::End).torque_pn_nm;
        let solved = Helix::new(far, tilt * length, length, axis, twist.z);
        HelixPoint {
            twist_rad_per_nm,
            tilt_rad_per_nm: tilt,
            curvature_rad_per_nm: solved.curvature * tilt.signum(),
            couple_pn_nm: far,
            twisting_couple_pn_nm: far.z,
            helix_twist_rad_per_nm: solved.twist,
            rigidity_pn_nm2: solved.rigidity,
            evidence: stop.evidence,
        }
    };
    protocol.sweep("tilt_rad_per_nm", tilts_rad_per_nm, settings, read)
}

/// Curvature, twist and bending rigidity of a helix under a uniform couple.
struct Helix {
    curvature: f64,
    twist: f64,
    rigidity: f64,
}

impl Helix {
    /// Computes the helix from the couple, and the tilt and turn (rad) of the far end.
    fn new(couple: Vector3, tilt: f64, length: f64, axis: Vector3, turn: f64) -> Self {
        let sine = couple.xy().norm() / couple.norm();
        let angle = 2.0 * ((0.5 * tilt.abs()).sin() / sine).asin();
        let rigidity = length * couple.norm() / angle;
        let end = rotation::exp(axis * tilt) * rotation::exp(Vector3::z() * turn);
        // The remaining rotation is a turn about e3, known up to full turns.
        let left = rotation::exp(couple * (length / rigidity)).inverse() * end;
        let spin = couple.z * length / rigidity;
        let rest = rotation::log(left).z;
        let twist = rest + TAU * ((turn - spin - rest) / TAU).round() + spin;
        Self {
            curvature: couple.xy().norm() / rigidity,
            twist: twist / length,
            rigidity,
        }
    }
}

/// The rotation vector, near `twist`, of the turn `twist` followed by the tilt.
fn composed(tilt: Vector3, twist: Vector3) -> Vector3 {
    let end: UnitQuaternion = rotation::exp(tilt) * rotation::exp(twist);
    let vector = rotation::log(end);
    let angle = vector.norm();
    if angle == 0.0 {
        return twist;
    }
    // Adds full turns about the same axis.
    let unit = vector / angle;
    let turns = ((twist.dot(&unit) - angle) / TAU).round();
    unit * (angle + TAU * turns)
}

//! Bending by couples of a filament under twist or axial force.

use super::follow::{Evidence, PathPoint};
use super::sweep::{Curve, across, check, check_finite, reaction, sweep};
use super::{MeasureError, Specimen};
use actin_mechanics::{UnitQuaternion, Vector3, rotation};
use actin_sim::Assembly;
use actin_sim::{End, FreeTranslation, Load, Scene, Setting, Stage};
use std::f64::consts::TAU;

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
    let length = Assembly::build(&helix(specimen, &[]))?.length_nm();
    let twist = Vector3::z() * (twist_rad_per_nm * length);
    let scene = |tilts: &[f64]| {
        let turns: Vec<Vector3> = tilts
            .iter()
            .map(|tilt| composed(axis * (tilt * length), twist))
            .collect();
        helix(specimen, &turns)
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
    sweep("tilt_rad_per_nm", tilts_rad_per_nm, scene, read)
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

fn helix(specimen: &Specimen, turns: &[Vector3]) -> Scene {
    let stage = |turn: &Vector3| Stage {
        set: vec![Setting::Turn {
            filament: 0,
            end: End::End,
            turn_deg: turn.map(f64::to_degrees).into(),
        }],
        duration_ns: None,
        pace: actin_sim::TimeCourse::Smooth,
    };
    let path = turns.iter().map(stage).collect();
    specimen.scene(
        "Bending of a twisted filament",
        Some(FreeTranslation::Freely),
        Vec::new(),
        path,
    )
}

/// A filament bent by end couples under axial force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PulledBendPoint {
    /// Axial force on the far end (pN), positive in tension.
    pub force_pn: f64,
    /// Relative rotation of the ends over length at rest (rad/nm).
    pub curvature_rad_per_nm: f64,
    /// Couple about the bending axis at the far end (pN nm).
    pub couple_pn_nm: f64,
    /// Secant bending rigidity (pN nm^2) for small bending under tension.
    pub rigidity_pn_nm2: f64,
    /// Quality of the equilibrium.
    pub evidence: Evidence,
}

/// Rotates the ends by `kappa L / 2` in opposite senses for each curvature (rad/nm), about the
/// transverse axis at an azimuth (deg, from lab x). A force (pN) pulls the freely sliding far end
/// along the undeformed axis.
///
/// The end couple is `M = B kappa x / tanh x` with `x = (L / 2) sqrt(F / B)`, for small angles and
/// without shear (`tan` in compression). `B` is the solution of this equation. The force acts on a
/// monomer off the axis and adds a couple that is even in the curvature: average over both signs or
/// over opposite azimuths.
///
/// # Errors
/// An invalid filament, a curvature that is zero or not finite, or a force that is not finite.
pub fn bend_under_tension(
    specimen: &Specimen,
    force_pn: f64,
    curvatures_rad_per_nm: &[f64],
    azimuth_deg: f64,
) -> Result<Curve<PulledBendPoint>, MeasureError> {
    check_finite("force_pn", force_pn)?;
    check("curvature_rad_per_nm", curvatures_rad_per_nm)?;
    let axis = across(azimuth_deg);
    let length = Assembly::build(&opposed(specimen, force_pn, &[]))?.length_nm();
    let scene = |curvatures: &[f64]| {
        let halves: Vec<Vector3> = curvatures
            .iter()
            .map(|kappa| axis * (0.5 * kappa * length))
            .collect();
        opposed(specimen, force_pn, &halves)
    };
    let read = |assembly: &Assembly, curvature: f64, stop: &PathPoint| {
        let couple = reaction(assembly, &stop.state, End::End)
            .torque_pn_nm
            .dot(&axis);
        PulledBendPoint {
            force_pn,
            curvature_rad_per_nm: curvature,
            couple_pn_nm: couple,
            rigidity_pn_nm2: pulled_rigidity(couple / curvature, force_pn, length),
            evidence: stop.evidence,
        }
    };
    sweep("curvature_rad_per_nm", curvatures_rad_per_nm, scene, read)
}

/// Solves `secant = B x / tanh x` with `x = (L / 2) sqrt(F / B)` for `B` by fixed-point iteration.
fn pulled_rigidity(secant: f64, force: f64, length: f64) -> f64 {
    let mut rigidity = secant;
    for _ in 0..200 {
        let square = 0.25 * length * length * force / rigidity;
        let x = square.abs().sqrt();
        let ratio = if x < 1e-6 {
            1.0
        } else if square > 0.0 {
            x / x.tanh()
        } else {
            x / x.tan()
        };
        rigidity = 0.5 * (rigidity + secant / ratio);
    }
    rigidity
}

fn opposed(specimen: &Specimen, force_pn: f64, halves: &[Vector3]) -> Scene {
    let turn = |end, half: Vector3| Setting::Turn {
        filament: 0,
        end,
        turn_deg: half.map(f64::to_degrees).into(),
    };
    let stage = |&half: &Vector3| Stage {
        set: vec![
            Setting::LoadFactor {
                load: 0,
                factor: force_pn,
            },
            turn(End::Start, -half),
            turn(End::End, half),
        ],
        duration_ns: None,
        pace: actin_sim::TimeCourse::Smooth,
    };
    let unit = Load::EndForce {
        filament: 0,
        end: End::End,
        force_pn: [0.0, 0.0, 1.0],
    };
    let path = halves.iter().map(stage).collect();
    specimen.scene(
        "Bending under tension",
        Some(FreeTranslation::Freely),
        vec![unit],
        path,
    )
}

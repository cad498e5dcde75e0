//! Bending by couples of a filament that is twisted, or pulled along its axis.

use super::follow::{Evidence, Stop};
use super::sweep::{Curve, across, check, check_finite, reaction, sweep};
use super::{MeasureError, Specimen};
use actin_mechanics::{UnitQuaternion, Vector3, rotation};
use actin_sim::Assembly;
use actin_sim::{End, Load, Scene, Setting, Slides, Stage};
use std::f64::consts::TAU;

/// A filament twisted and bent by one couple, the same all along: a helix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HelixPoint {
    /// Turn of the far end about the axis, before it is tilted, over length at rest (rad/nm).
    pub twist_rad_per_nm: f64,
    /// Tilt of the far end over length at rest (rad/nm): what is prescribed.
    pub tilt_rad_per_nm: f64,
    /// Curvature of the helix across its own axis (rad/nm); the tilt per length if untwisted.
    pub curvature_rad_per_nm: f64,
    /// Couple that holds the far end (pN nm, lab frame).
    pub couple_pn_nm: Vector3,
    /// Its component about the filament (pN nm), read at the near end.
    pub twisting_couple_pn_nm: f64,
    /// Twist of the helix (rad/nm): that by which the turn of the far end comes about.
    pub helix_twist_rad_per_nm: f64,
    /// Secant bending rigidity (pN nm^2): couple across the filament over curvature.
    pub rigidity_pn_nm2: f64,
    /// How far to trust it.
    pub evidence: Evidence,
}

/// Turns the far end about the axis by `twist L`, then tilts it by each `tilt L` (rad/nm) about the
/// transverse axis at an azimuth (deg, from lab x); it slides freely, so that no force acts.
///
/// The couple `m` is then the same all along, and an isotropic rod with `B` and `B3` of its own for
/// this curvature and twist is a helix: its far end is turned by
/// `exp(L m / B) exp(L (kappa_3 - m_3 / B) e3)`, `m_3 = m . e3` at the near end. The tilt gives `B`:
/// `sin(theta / 2) = sin(gamma) sin(L m / 2 B)`, `gamma` the angle between couple and filament. The
/// smallest root is taken, so `L m / B` must stay below a half-turn: shorter filaments for
/// larger twist. Where there is no root, rigidity and curvature are not numbers.
///
/// # Errors
/// A filament that is refused, a tilt that is zero or not finite, a twist that is not finite.
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
    let read = |assembly: &Assembly, tilt: f64, stop: &Stop| {
        let far = reaction(assembly, &stop.state, End::End).torque_pn_nm;
        let solved = Helix::of(far, tilt * length, length, axis, twist.z);
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

/// Curvature, twist and bending rigidity of a helix under one couple.
struct Helix {
    curvature: f64,
    twist: f64,
    rigidity: f64,
}

impl Helix {
    /// From the couple, the tilt and turn (rad) of the far end.
    fn of(couple: Vector3, tilt: f64, length: f64, axis: Vector3, turn: f64) -> Self {
        let sine = couple.xy().norm() / couple.norm();
        let angle = 2.0 * ((0.5 * tilt.abs()).sin() / sine).asin();
        let rigidity = length * couple.norm() / angle;
        let end = rotation::exp(axis * tilt) * rotation::exp(Vector3::z() * turn);
        // What is left is a turn about e3 alone, known but for full turns.
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
    // The same rotation by any number of full turns about the same axis.
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
        pace: actin_sim::Pace::Smooth,
    };
    let path = turns.iter().map(stage).collect();
    specimen.scene(
        "Bending of a twisted filament",
        Some(Slides::Freely),
        Vec::new(),
        path,
    )
}

/// A filament under axial force, bent by couples at its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PulledBendPoint {
    /// Axial force on the far end (pN), positive in tension.
    pub force_pn: f64,
    /// Turn between the ends over length at rest (rad/nm).
    pub curvature_rad_per_nm: f64,
    /// Couple about the axis of bending that holds the far end (pN nm).
    pub couple_pn_nm: f64,
    /// Secant bending rigidity (pN nm^2) of small bending under tension.
    pub rigidity_pn_nm2: f64,
    /// How far to trust it.
    pub evidence: Evidence,
}

/// Turns both ends by `kappa L / 2` against each other for each curvature (rad/nm) about the
/// transverse axis at an azimuth (deg, from lab x) while a force (pN) pulls the far end along the
/// axis as built; it slides freely.
///
/// The couple at the ends is `M = B kappa x / tanh x`, `x = (L / 2) sqrt(F / B)`, for small angles and
/// no shear (with `tan` in compression); `B` solves it. The force acts on a monomer off the axis and
/// adds a couple that does not change its sign with the curvature: average over both signs, or over
/// opposite azimuths.
///
/// # Errors
/// A filament that is refused, a curvature that is zero or not finite, a force that is not finite.
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
    let read = |assembly: &Assembly, curvature: f64, stop: &Stop| {
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

/// The `B` of `secant = B x / tanh x`, `x = (L / 2) sqrt(F / B)`, by fixed point: the right side
/// changes slowly.
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
        pace: actin_sim::Pace::Smooth,
    };
    let unit = Load::EndForce {
        filament: 0,
        end: End::End,
        force_pn: [0.0, 0.0, 1.0],
    };
    let path = halves.iter().map(stage).collect();
    specimen.scene(
        "Bending under tension",
        Some(Slides::Freely),
        vec![unit],
        path,
    )
}

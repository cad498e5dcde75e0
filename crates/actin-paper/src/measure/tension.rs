//! Twist under axial force: torques at held turns, and the equilibrium turn of a free end.

use super::sweep::{Curve, MissingEquilibrium, check, check_finite, in_order, sweep};
use super::twist::{self, TwistPoint};
use super::{MeasureError, Specimen};
use actin_sim::{End, FreeTranslation, Load, Scene, Setting, Stage};

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
    let scene = |turns: &[f64]| {
        let controls: Vec<_> = turns.iter().map(|&turn| (force_pn, turn)).collect();
        pulled(specimen, &controls)
    };
    sweep("turn_deg", turns_deg, scene, |assembly, turn, stop| {
        let twist = twist::read(assembly, turn, stop);
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
    let mut all = Curve {
        length_nm: 0.0,
        points: Vec::new(),
        unreached: Vec::new(),
    };
    for &force_pn in forces_pn {
        let mut curve = free_turn(specimen, force_pn)?;
        all.length_nm = curve.length_nm;
        all.points.append(&mut curve.points);
        all.unreached.append(&mut curve.unreached);
    }
    Ok(all)
}

fn free_turn(specimen: &Specimen, force_pn: f64) -> Result<Curve<PulledTwistPoint>, MeasureError> {
    let mut curve = held(specimen, force_pn, 0.0)?;
    let Some(blocked) = curve.points.first().map(couple) else {
        return Ok(curve);
    };
    let mut search = Search::new(blocked);
    let (mut turn, mut left) = (0.0, blocked);
    for _ in 0..TRIALS {
        turn = search.trial_deg();
        curve = held(specimen, force_pn, turn)?;
        left = match curve.points.first().map(couple) {
            Some(left) if left.abs() > COUPLE_LEFT * blocked.abs() => left,
            _ => return Ok(curve),
        };
        search.narrow(turn, left);
    }
    curve.points.clear();
    // A torque that jumps across zero has several equilibria and no root.
    let reason = format!("a torque of {left} pN nm remains at {turn} deg after {TRIALS} trials");
    let value = force_pn;
    curve.unreached.push(MissingEquilibrium { value, reason });
    Ok(curve)
}

/// Brackets the zero from turn 0 by growing steps against the torque, then applies false position
/// with halved weight of a retained end (Illinois algorithm).
struct Search {
    /// Turn (deg) and torque (pN nm) on the far side of the zero, or nearest to it.
    from: (f64, f64),
    /// Turn and torque of the latest trial; without a bracket, the next trial.
    to: (f64, f64),
    is_bracket: bool,
}

impl Search {
    fn new(blocked: f64) -> Self {
        Self {
            from: (0.0, blocked),
            to: (-FIRST_STEP_DEG * blocked.signum(), blocked),
            is_bracket: false,
        }
    }

    fn trial_deg(&self) -> f64 {
        let ((from, at_from), (to, at_to)) = (self.from, self.to);
        if self.is_bracket {
            to - at_to * (to - from) / (at_to - at_from)
        } else {
            to
        }
    }

    fn narrow(&mut self, turn: f64, couple: f64) {
        if !self.is_bracket && couple * self.from.1 > 0.0 {
            self.from = (turn, couple);
            self.to.0 = 2.0 * turn;
            return;
        }
        if self.is_bracket && couple * self.to.1 < 0.0 {
            self.from = self.to;
        } else if self.is_bracket {
            self.from.1 *= 0.5;
        }
        self.to = (turn, couple);
        self.is_bracket = true;
    }
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
    let scene = |forces: &[f64]| {
        let controls: Vec<_> = forces.iter().map(|&force| (force, turn_deg)).collect();
        pulled(specimen, &controls)
    };
    in_order(
        "force_pn",
        &[force_pn],
        scene,
        |assembly, force_pn, stop| {
            let twist = twist::read(assembly, turn_deg, stop);
            PulledTwistPoint { force_pn, twist }
        },
    )
}

/// One stage for each pair of axial force (pN) and turn (deg).
fn pulled(specimen: &Specimen, controls: &[(f64, f64)]) -> Scene {
    let end = End::End;
    let stage = |&(factor, turn): &(f64, f64)| {
        let turn_deg = [0.0, 0.0, turn];
        Stage {
            set: vec![
                Setting::LoadFactor { load: 0, factor },
                Setting::Turn {
                    filament: 0,
                    end,
                    turn_deg,
                },
            ],
            duration_ns: None,
            pace: actin_sim::TimeCourse::Smooth,
        }
    };
    let unit = Load::EndForce {
        filament: 0,
        end,
        force_pn: [0.0, 0.0, 1.0],
    };
    let path = controls.iter().map(stage).collect();
    specimen.scene(
        "Twist under tension",
        Some(FreeTranslation::AlongAxis),
        vec![unit],
        path,
    )
}

//! Twist under axial force: couples at held turns, and the turn of an end that is free to turn.

use super::sweep::{Curve, Unreached, check, check_finite, in_order, sweep};
use super::twist::{self, TwistPoint};
use super::{MeasureError, Specimen};
use actin_sim::{End, Load, Scene, Setting, Slides, Stage};

/// Couple that may be left on an end that is free to turn, as a share of that at turn 0.
const COUPLE_LEFT: f64 = 1e-4;
/// Most equilibria in the search for the turn without couple, for one force.
const TRIALS: usize = 60;
/// First step of that search (deg); it grows by the factor 2 until the couple changes its sign.
const FIRST_STEP_DEG: f64 = 0.25;

/// A filament under axial force, twisted or free to turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PulledTwistPoint {
    /// Axial force on the far end (pN), positive in tension.
    pub force_pn: f64,
    /// Turn, couple and change of length, all against the filament at rest without force.
    pub twist: TwistPoint,
}

/// Turns the far end about the axis by each angle (deg) while a force (pN, positive in tension)
/// pulls it along the axis, along which it slides.
///
/// Of an energy `U(strain, kappa_3)` per length the couple is `dU / d kappa_3` at the strain which
/// the force makes. With `U = int B3 k dk + S3 (strain - xi + 1)^2 / 2` it is
/// `B3 kappa_3 - F d xi / d kappa_3`: twist-stretch coupling is what the force adds.
///
/// # Errors
/// A filament that is refused, an angle that is zero or not finite, a force that is not finite.
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

/// Pulls the far end along the axis with each force (pN) and turns it until no couple holds it, to
/// 1e-4 of the couple that would block the turn.
///
/// Of monomers in compression the couple can jump over zero, between equilibria that differ in
/// which way loose monomers give; such a force is not reached.
///
/// # Errors
/// A filament that is refused, a force that is zero or not finite.
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
    // A couple that jumps over zero has no zero: there are several equilibria.
    let reason = format!("after {TRIALS} trials {left} pN nm are left at {turn} deg");
    let value = force_pn;
    curve.unreached.push(Unreached { value, reason });
    Ok(curve)
}

/// Walks from turn 0 against the couple until that changes its sign, then closes in on the zero by
/// false position, where the weight of an end that stays is halved (Illinois).
struct Search {
    /// Turn (deg) and couple (pN nm) at the far side of the zero, or nearest to it so far.
    from: (f64, f64),
    /// The same at the latest trial; before there is a bracket, the next trial.
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

/// One equilibrium at a force and a turn; of the turn 0 the secant rigidity is not a number.
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
            pace: actin_sim::Pace::Smooth,
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
        Some(Slides::AlongAxis),
        vec![unit],
        path,
    )
}

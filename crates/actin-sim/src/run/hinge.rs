//! Detection of hinges turned past half a turn.
//!
//! The angle of a hinge's spring is known up to half a turn. Beyond that angle the spring loses a
//! whole turn and its torque changes sign. Hinges are checked after every drift of a motion and at
//! every equilibrium of a path.

use crate::At;
use crate::{Assembly, End};
use actin_assembly::Ramp;
use actin_mechanics::{Drive, Interaction, State, UnitQuaternion, rotation};
use std::f64::consts::FRAC_PI_4;
use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Half of the angle (rad) above which a hinge may have jumped between equilibria.
const LARGEST_HALF_ANGLE: f64 = FRAC_PI_4;

/// Hinge that was turned past half a turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HingeSlip {
    /// Index of the filament.
    pub filament: usize,
    /// Hinged end.
    pub end: End,
    /// Time or path parameter.
    pub at: At,
    /// Angle of the spring just before (deg), and its part about the filament (deg).
    pub turned_deg: [f64; 2],
}

impl fmt::Display for HingeSlip {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [angle, twist] = self.turned_deg;
        write!(
            f,
            "the hinge at the {} of filament {} was turned past half a turn ({angle:.0} deg just before, {twist:.0} \
             deg of it about the filament), where its spring loses a whole turn; use a stiffer hinge, a smaller \
             turn or a smaller load",
            self.end, self.filament
        )
    }
}

#[derive(Clone, Copy, Debug)]
struct Hinge {
    filament: usize,
    end: End,
    frames: [usize; 2],
}

impl Hinge {
    fn all(assembly: &Assembly) -> Vec<Self> {
        let ends = (0..assembly.filaments.len())
            .flat_map(|filament| [End::Start, End::End].map(|end| (filament, end)));
        let hinged = ends.filter_map(|(filament, end)| {
            let frames = assembly.hinge_frames(filament, end)?;
            Some(Self {
                filament,
                end,
                frames,
            })
        });
        hinged.collect()
    }

    fn rotation(&self, state: &State) -> UnitQuaternion {
        let [from, to] = self.frames.map(|i| state.frames.orientation.get(i));
        from.inverse() * to
    }

    fn slip(&self, before: UnitQuaternion, at: At) -> HingeSlip {
        let theta = rotation::log(before);
        HingeSlip {
            filament: self.filament,
            end: self.end,
            at,
            turned_deg: [theta.norm(), theta.z].map(f64::to_degrees),
        }
    }
}

/// Drive of a motion: the path of its scene, with a monitor of the hinges after each change of the state.
#[derive(Clone, Debug)]
pub(super) struct HingeWatch {
    ramp: Option<Ramp>,
    hinges: Vec<Hinge>,
    seen: Arc<Mutex<HingeHistory>>,
}

#[derive(Debug, Default)]
struct HingeHistory {
    last: Vec<UnitQuaternion>,
    /// First slip.
    slip: Option<HingeSlip>,
}

impl HingeWatch {
    pub(super) fn new(assembly: &Assembly) -> Self {
        let watch = Self {
            ramp: Ramp::from_assembly(assembly),
            hinges: Hinge::all(assembly),
            seen: Arc::default(),
        };
        watch.begin(assembly.system.state());
        watch
    }

    pub(super) fn begin(&self, state: &State) {
        self.seen().last = self.hinges.iter().map(|h| h.rotation(state)).collect();
    }

    /// Returns the drive that shares the history of this monitor; `None` without a path and hinges.
    pub(super) fn to_drive(&self) -> Option<Box<dyn Drive>> {
        let is_needed = self.ramp.is_some() || !self.hinges.is_empty();
        is_needed.then(|| Box::new(self.clone()) as Box<dyn Drive>)
    }

    /// Time (ns) after which all controls are constant.
    pub(super) fn duration_ns(&self) -> f64 {
        self.ramp.as_ref().map_or(0.0, Ramp::duration)
    }

    pub(super) fn slip(&self) -> Option<HingeSlip> {
        self.seen().slip
    }

    fn seen(&self) -> MutexGuard<'_, HingeHistory> {
        self.seen.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drive for HingeWatch {
    fn place(&self, state: &mut State, time: f64) {
        if let Some(ramp) = &self.ramp {
            ramp.place(state, time);
        }
        let mut seen = self.seen();
        for (i, hinge) in self.hinges.iter().enumerate() {
            let now = hinge.rotation(state);
            let before = std::mem::replace(&mut seen.last[i], now);
            if has_passed(before, now) && seen.slip.is_none() {
                seen.slip = Some(hinge.slip(before, At::Time(time)));
            }
        }
    }

    fn work_of_controls(
        &self,
        state: &mut State,
        interactions: &[Box<dyn Interaction>],
        t: f64,
    ) -> f64 {
        let ramp = self.ramp.as_ref();
        ramp.map_or(0.0, |ramp| ramp.work_of_controls(state, interactions, t))
    }
}

/// Returns the first hinge turned past half a turn between two equilibria. Rotations by more than a
/// right angle may be jumps and are ignored.
pub(super) fn slip_between(
    assembly: &Assembly,
    before: &State,
    (state, at): (&State, At),
) -> Option<HingeSlip> {
    Hinge::all(assembly).into_iter().find_map(|hinge| {
        let (before, now) = (hinge.rotation(before), hinge.rotation(state));
        let is_near = before.coords.dot(&now.coords).abs() > LARGEST_HALF_ANGLE.cos();
        (is_near && has_passed(before, now)).then(|| hinge.slip(before, at))
    })
}

/// Returns `true` if the shortest path between two rotations passes half a turn. There the unit
/// quaternion with positive real part changes sign.
fn has_passed(before: UnitQuaternion, now: UnitQuaternion) -> bool {
    before.coords.dot(&now.coords) * before.w * now.w < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_mechanics::Vector3;

    #[test]
    fn half_a_turn_is_passed_once() {
        let turn = |x: f64, z: f64| rotation::exp(Vector3::new(x, 0.0, z).map(f64::to_radians));
        for (before, now, passed) in [
            (turn(0.0, 170.0), turn(0.0, 190.0), true),
            (turn(0.0, -190.0), turn(0.0, -170.0), true),
            (turn(20.0, 170.0), turn(40.0, 178.0), true),
            (turn(0.0, 150.0), turn(0.0, 170.0), false),
            (turn(0.0, 190.0), turn(0.0, 210.0), false),
            (turn(0.0, 10.0), turn(0.0, -10.0), false),
            (turn(80.0, 0.0), turn(0.0, 80.0), false),
        ] {
            assert_eq!(has_passed(before, now), passed, "{before} {now}");
            assert_eq!(has_passed(now, before), passed);
        }
    }
}

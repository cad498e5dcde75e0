//! Whether the spring of a hinged end was turned past half a turn. Its angle is known up to there: past it, the
//! spring is turned by as much the other way round, so that a whole turn is lost and its couple changes sign.
//!
//! A motion is looked at after every drift, a path of equilibria at every equilibrium.

use super::At;
use crate::assembly::Ramp;
use crate::{Assembly, End};
use actin_mechanics::{Drive, Interaction, State, UnitQuaternion, rotation};
use std::f64::consts::FRAC_PI_4;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

/// Between equilibria a hinge that turns by more than twice this angle (rad) may have jumped, through any angle.
const LARGEST_HALF_ANGLE: f64 = FRAC_PI_4;

/// A hinge that was turned past half a turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HingeSlip {
    /// The filament.
    pub filament: usize,
    /// Its hinged end.
    pub end: End,
    /// When, or where on the path.
    pub at: At,
    /// How far (deg) its spring was turned just before, and how far of that about the filament.
    pub turned_deg: [f64; 2],
}

impl fmt::Display for HingeSlip {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let end = match self.end {
            End::Start => "start",
            End::End => "end",
        };
        let [angle, twist] = self.turned_deg;
        write!(
            f,
            "the hinge at the {end} of filament {} was turned past half a turn, {angle:.0} deg just before, {twist:.0} \
             deg of it about the filament: there its spring loses a whole turn and pulls the other way; a stiffer \
             hinge, a smaller turn or a smaller load stays below",
            self.filament
        )
    }
}

/// A hinged end and the two frames that its spring joins.
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

    /// The rotation of its spring.
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

/// The hinges of a motion, looked at wherever its bodies have moved.
#[derive(Clone, Debug)]
pub(super) struct HingeWatch {
    hinges: Vec<Hinge>,
    seen: Arc<Mutex<Seen>>,
}

#[derive(Debug, Default)]
struct Seen {
    last: Vec<UnitQuaternion>,
    /// The first slip.
    slip: Option<HingeSlip>,
}

impl HingeWatch {
    /// Of an assembly in the state in which it was built.
    pub(super) fn new(assembly: &Assembly) -> Self {
        let watch = Self {
            hinges: Hinge::all(assembly),
            seen: Arc::default(),
        };
        watch.begin(assembly.system.state());
        watch
    }

    /// Looks from `state` on.
    pub(super) fn begin(&self, state: &State) {
        let mut seen = self.seen.lock().unwrap_or_else(PoisonError::into_inner);
        seen.last = self.hinges.iter().map(|h| h.rotation(state)).collect();
    }

    /// What is to be called after every drift, besides what a ramp moves: the ramp alone where nothing is hinged.
    pub(super) fn beside(&self, ramp: Option<Ramp>) -> Option<Box<dyn Drive>> {
        if self.hinges.is_empty() {
            return ramp.map(|ramp| Box::new(ramp) as Box<dyn Drive>);
        }
        let watch = self.clone();
        Some(Box::new(Watched { ramp, watch }))
    }

    /// The first hinge that was turned too far, if one was.
    pub(super) fn slip(&self) -> Option<HingeSlip> {
        let seen = self.seen.lock().unwrap_or_else(PoisonError::into_inner);
        seen.slip
    }

    fn look(&self, state: &State, time_ns: f64) {
        let mut seen = self.seen.lock().unwrap_or_else(PoisonError::into_inner);
        for (i, hinge) in self.hinges.iter().enumerate() {
            let now = hinge.rotation(state);
            let before = std::mem::replace(&mut seen.last[i], now);
            if has_passed(before, now) && seen.slip.is_none() {
                seen.slip = Some(hinge.slip(before, At::Time(time_ns)));
            }
        }
    }
}

/// A ramp, and the hinges that are looked at behind it.
#[derive(Debug)]
struct Watched {
    ramp: Option<Ramp>,
    watch: HingeWatch,
}

impl Drive for Watched {
    fn place(&self, state: &mut State, time: f64) {
        if let Some(ramp) = &self.ramp {
            ramp.place(state, time);
        }
        self.watch.look(state, time);
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

/// The first hinge that was turned past half a turn between one equilibrium and the next. One that turned by more
/// than a right angle has jumped: nothing is concluded.
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

/// Whether the shortest way from one rotation to another leads through half a turn: there, of the two unit
/// quaternions of a rotation, the one with the positive real part changes sign.
fn has_passed(before: UnitQuaternion, now: UnitQuaternion) -> bool {
    before.coords.dot(&now.coords) * before.w * now.w < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_mechanics::Vector3;

    /// About one axis, and about another on the way; nothing is passed where the angle shrinks or changes sign at
    /// zero.
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

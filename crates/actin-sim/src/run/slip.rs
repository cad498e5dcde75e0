//! Whether a filament whose ends are held has lost twist on its way: through a joint that was turned
//! past half a turn, or by passing through itself.
//!
//! Twist plus writhe is compared with the turn of the ends at every record. It is off by whole turns or
//! not at all, so that half a turn is the threshold. Where it is off by anything else (an end has passed
//! the other, so that the straight lines beyond them overlap) the sum says nothing, and nothing is
//! concluded.

use super::{At, Failure, HingeSlip, Record};
use crate::scene::Slides;
use crate::shape::{Ribbon, WHOLE, turn_of_ends};
use crate::{Assembly, End};
use actin_mechanics::State;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Turns of a filament that its twist and writhe no longer show.
#[derive(Clone, Debug, PartialEq)]
pub struct Slip {
    /// The filament.
    pub filament: usize,
    /// When it was found, or where on the path.
    pub at: At,
    /// Turn of the end against the start (turns).
    pub link_turns: f64,
    /// Twist plus writhe (turns).
    pub found_turns: f64,
    /// Arc length (nm) of the joint that is twisted most, in that state or the last good one.
    pub joint_s_nm: f64,
    /// Angle of that joint (deg).
    pub joint_deg: f64,
}

impl Slip {
    /// How many turns are lost.
    pub fn lost_turns(&self) -> f64 {
        (self.link_turns - self.found_turns).round()
    }
}

impl fmt::Display for Slip {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lost = self.lost_turns().abs();
        let how = if is_even(lost) {
            "it has passed through itself or through the straight line beyond an end, or a joint was \
             turned past half a turn on the way"
        } else {
            "a joint was turned past half a turn on the way"
        };
        write!(
            f,
            "filament {} has lost {lost} turn(s): its ends are turned by {:.2} against each other, its \
             twist and writhe add up to {:.2}; {how}; the joint at s = {:.2} nm is twisted most, by \
             {:.0} deg; more segments or smaller steps may help",
            self.filament, self.link_turns, self.found_turns, self.joint_s_nm, self.joint_deg
        )
    }
}

/// How a filament lost turns.
#[derive(Clone, Debug)]
pub(super) enum Lost {
    /// Through itself or a joint between ends that are held.
    Twist(Slip),
    /// Through the spring of an end.
    Hinge(HingeSlip),
}

impl Lost {
    pub(super) fn at(&self) -> At {
        match self {
            Self::Twist(slip) => slip.at,
            Self::Hinge(slip) => slip.at,
        }
    }

    /// As the failure of a run; `place` says when, or in which stage.
    pub(super) fn failure(self, place: String) -> Failure {
        match self {
            Self::Twist(slip) => Failure::TwistLost { place, slip },
            Self::Hinge(slip) => Failure::HingeSlipped { place, slip },
        }
    }
}

/// Watches the filaments of a run whose ends are held, or hinged: then the spring counts as a joint.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct LinkWatch {
    held: Vec<Held>,
}

/// A filament with both ends held.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Held {
    filament: usize,
    /// Twist plus writhe (turns) less the turn of the ends, where the run begins or since an end went
    /// round the filament.
    offset_turns: f64,
    /// Whether an end may go round the filament, which changes the sum by two turns.
    is_loose: bool,
    /// Whether the filament pointed forward everywhere at the last record: then no end was going round.
    was_forward: bool,
}

impl LinkWatch {
    /// A watch of a run that begins in `start`, its path at the beginning.
    pub(super) fn new(assembly: &Assembly, start: &State) -> Self {
        let held = (0..assembly.filaments.len()).filter_map(|filament| {
            let ends = [End::Start, End::End].map(|end| {
                let clamp = assembly.held.turned_at(filament, end)?;
                Some(&assembly.clamps[clamp])
            });
            let [Some(one), Some(other)] = ends else {
                return None;
            };
            let turn = turn_of_ends(assembly, filament, At::Path(0.0))?;
            let ribbon = Ribbon::of(assembly, filament, start);
            Some(Held {
                filament,
                offset_turns: ribbon.linking()? - turn,
                is_loose: [one, other].iter().any(|c| c.slides == Slides::Freely),
                was_forward: ribbon.is_forward(),
            })
        });
        Self {
            held: held.collect(),
        }
    }

    /// Whether it watches as many filaments as `other`.
    pub(super) fn fits(&self, other: &Self) -> bool {
        self.held.len() == other.held.len()
    }

    /// Follows a record that was found good when it was made.
    pub(super) fn follow(&mut self, assembly: &Assembly, record: &Record) {
        for held in &mut self.held {
            held.compare(assembly, &record.state, record.at);
        }
    }

    /// The first filament that has lost a turn in `state`; `before` is the last good state. To be asked at every record, in order.
    pub(super) fn slip(
        &mut self,
        assembly: &Assembly,
        (state, at): (&State, At),
        before: Option<&State>,
    ) -> Option<Slip> {
        self.held.iter_mut().find_map(|held| {
            let (link_turns, found_turns) = held.compare(assembly, state, at)?;
            let joints = [state, before.unwrap_or(state)]
                .map(|state| Ribbon::of(assembly, held.filament, state).most_twisted());
            let is_second = joints[1].1.abs() > joints[0].1.abs();
            let (joint_s_nm, angle) = joints[usize::from(is_second)];
            Some(Slip {
                filament: held.filament,
                at,
                link_turns,
                found_turns,
                joint_s_nm,
                joint_deg: angle.to_degrees(),
            })
        })
    }
}

impl Held {
    /// The turn of the ends and the sum of twist and writhe (turns), if they tell of a slip.
    fn compare(&mut self, assembly: &Assembly, state: &State, at: At) -> Option<(f64, f64)> {
        let link_turns = turn_of_ends(assembly, self.filament, at)?;
        let ribbon = Ribbon::of(assembly, self.filament, state);
        let is_forward = ribbon.is_forward();
        let may_go_round = self.is_loose && !(is_forward && self.was_forward);
        self.was_forward = is_forward;
        let found_turns = ribbon.linking()? - self.offset_turns;
        let off = link_turns - found_turns;
        let lost = off.round();
        if lost == 0.0 || (off - lost).abs() > WHOLE {
            return None;
        }
        if may_go_round && is_even(lost) {
            self.offset_turns -= lost;
            return None;
        }
        Some((link_turns, found_turns))
    }
}

/// Whether a whole number is even.
fn is_even(turns: f64) -> bool {
    turns % 2.0 == 0.0
}

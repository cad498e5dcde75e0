//! Detection of lost twist in filaments with held ends, through a joint turned past half a turn or
//! self-passage.
//!
//! Twist plus writhe is compared with the prescribed turn of the ends at every record. The
//! difference is a whole number of turns, so the threshold is half a turn. Other differences occur
//! when the straight extensions of the ends overlap; these are ignored.

use super::{HingeSlip, Record};
use crate::At;
use crate::scene::FreeTranslation;
use crate::shape::{Ribbon, WHOLE};
use crate::{Assembly, End};
use actin_mechanics::State;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Turns of a filament missing in its twist and writhe.
#[derive(Clone, Debug, PartialEq)]
pub struct Slip {
    /// Index of the filament.
    pub filament: usize,
    /// Time or path parameter of the detection.
    pub at: At,
    /// Turn of the end relative to the start (turns).
    pub link_turns: f64,
    /// Twist plus writhe (turns).
    pub found_turns: f64,
    /// Arc length (nm) of the most twisted joint, in this state or the last good one.
    pub joint_s_nm: f64,
    /// Angle of that joint (deg).
    pub joint_deg: f64,
}

impl Slip {
    /// Number of lost turns.
    pub fn lost_turns(&self) -> f64 {
        (self.link_turns - self.found_turns).round()
    }
}

impl fmt::Display for Slip {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lost = self.lost_turns().abs();
        let how = if is_even(lost) {
            "it passed through itself or through the straight extension of an end, or a joint was \
             turned past half a turn"
        } else {
            "a joint was turned past half a turn"
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

#[derive(Clone, Debug)]
pub(super) enum TurnLoss {
    /// Through self-passage or a joint.
    Twist(Slip),
    /// Through the spring of a hinged end.
    Hinge(HingeSlip),
}

impl TurnLoss {
    pub(super) fn at(&self) -> At {
        match self {
            Self::Twist(slip) => slip.at,
            Self::Hinge(slip) => slip.at,
        }
    }
}

/// Monitor of filaments with held or hinged ends; a hinge counts as a joint.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct LinkWatch {
    held: Vec<LinkRecord>,
}

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct LinkRecord {
    filament: usize,
    /// Twist plus writhe minus the turn of the ends (turns), at the start or since an end last
    /// passed around the filament.
    offset_turns: f64,
    /// An end can pass around the filament, which changes the sum by two turns.
    is_loose: bool,
    /// All tangents pointed forward at the last record.
    was_forward: bool,
}

impl LinkWatch {
    pub(super) fn new(assembly: &Assembly, start: &State) -> Self {
        let held = (0..assembly.filaments.len()).filter_map(|filament| {
            let ends = [End::Start, End::End].map(|end| {
                let clamp = assembly.held.turned_at(filament, end)?;
                Some(&assembly.clamps[clamp])
            });
            let [Some(one), Some(other)] = ends else {
                return None;
            };
            let turn = assembly.turn_of_ends(filament, At::Path(0.0))?;
            let ribbon = Ribbon::from_state(assembly, filament, start);
            Some(LinkRecord {
                filament,
                offset_turns: ribbon.linking()? - turn,
                is_loose: [one, other]
                    .iter()
                    .any(|c| c.slides == FreeTranslation::Freely),
                was_forward: ribbon.is_forward(),
            })
        });
        Self {
            held: held.collect(),
        }
    }

    pub(super) fn fits(&self, other: &Self) -> bool {
        self.held.len() == other.held.len()
    }

    /// Updates the monitor with a record that was already accepted.
    pub(super) fn follow(&mut self, assembly: &Assembly, record: &Record) {
        for held in &mut self.held {
            held.compare(assembly, &record.state, record.at);
        }
    }

    /// Returns the first filament that lost a turn in `state`; `before` is the last good state.
    /// Call it for every record in order.
    pub(super) fn slip(
        &mut self,
        assembly: &Assembly,
        (state, at): (&State, At),
        before: Option<&State>,
    ) -> Option<Slip> {
        self.held.iter_mut().find_map(|held| {
            let (link_turns, found_turns) = held.compare(assembly, state, at)?;
            let joints = [state, before.unwrap_or(state)]
                .map(|state| Ribbon::from_state(assembly, held.filament, state).most_twisted());
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

impl LinkRecord {
    /// Turn of the ends and sum of twist and writhe (turns), if they indicate a slip.
    fn compare(&mut self, assembly: &Assembly, state: &State, at: At) -> Option<(f64, f64)> {
        let link_turns = assembly.turn_of_ends(self.filament, at)?;
        let ribbon = Ribbon::from_state(assembly, self.filament, state);
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

fn is_even(turns: f64) -> bool {
    turns % 2.0 == 0.0
}

//! Whether a filament whose ends are held has lost twist on its way: through a joint that was turned
//! past half a turn, or by passing through itself.
//!
//! Twist plus writhe is compared with the turn of the ends at every record. It is off by whole turns or
//! not at all, so that half a turn is the threshold.

use crate::scene::Slides;
use crate::shape::{Ribbon, link_of};
use crate::{Assembly, End};
use actin_mechanics::State;
use std::fmt;

/// Turns of a filament that its twist and writhe no longer show.
#[derive(Clone, Debug, PartialEq)]
pub struct Slip {
    /// The filament.
    pub filament: usize,
    /// When it was found (ns); of an equilibrium the path parameter.
    pub time_ns: f64,
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

/// Watches the filaments of a run whose ends are held.
#[derive(Clone, Debug)]
pub(super) struct LinkWatch {
    held: Vec<Held>,
}

/// A filament with both ends held.
#[derive(Clone, Copy, Debug)]
struct Held {
    filament: usize,
    /// Twist plus writhe (turns) where the run begins, less the link there.
    offset_turns: f64,
    /// Whether an end may go round the filament: then two turns more or less are nothing wrong.
    is_loose: bool,
}

impl LinkWatch {
    /// A watch of a run that begins in `start`, its path at the beginning.
    pub(super) fn new(assembly: &Assembly, start: &State) -> Self {
        let held = (0..assembly.filaments.len()).filter_map(|filament| {
            let ends = [End::Start, End::End].map(|end| assembly.clamp_at(filament, end));
            let [Some(one), Some(other)] = ends else {
                return None;
            };
            let link = link_of(assembly, filament, 0.0)?;
            let linking = Ribbon::of(assembly, filament, start).linking()?;
            Some(Held {
                filament,
                offset_turns: linking - link,
                is_loose: [one, other].iter().any(|c| c.slides == Slides::Freely),
            })
        });
        Self {
            held: held.collect(),
        }
    }

    /// The first filament that has lost a turn in `state`, at `time_ns` (of an equilibrium the path
    /// parameter); `before` is the last good state.
    pub(super) fn slip(
        &self,
        assembly: &Assembly,
        (state, time_ns): (&State, f64),
        before: Option<&State>,
    ) -> Option<Slip> {
        self.held.iter().find_map(|held| {
            let filament = held.filament;
            let link_turns = link_of(assembly, filament, time_ns)?;
            let linking = Ribbon::of(assembly, filament, state).linking()?;
            let found_turns = linking - held.offset_turns;
            let lost = (link_turns - found_turns).round();
            if lost == 0.0 || (held.is_loose && is_even(lost)) {
                return None;
            }
            let joints = [state, before.unwrap_or(state)]
                .map(|state| Ribbon::of(assembly, filament, state).most_twisted());
            let is_second = joints[1].1.abs() > joints[0].1.abs();
            let (joint_s_nm, angle) = joints[usize::from(is_second)];
            Some(Slip {
                filament,
                time_ns,
                link_turns,
                found_turns,
                joint_s_nm,
                joint_deg: angle.to_degrees(),
            })
        })
    }
}

/// Whether a whole number is even.
fn is_even(turns: f64) -> bool {
    turns % 2.0 == 0.0
}

/// What the twist of filaments is compared with: how they begin.
pub(super) fn links(assembly: &Assembly) -> LinkWatch {
    let mut start = assembly.system.state().clone();
    // Without a path, held ends are where the caller has put them.
    if !assembly.drive.is_still() {
        assembly.drive.place(&mut start, 0.0);
    }
    LinkWatch::new(assembly, &start)
}

//! Where a run can be left and taken up again. Files are no business of this crate.

use actin_mechanics::{Motion, Split, State, System};

/// A sound, synchronised state of a run between two of its batches of steps.
///
/// Batches end at the same step numbers however often a run is left and taken up again, so that
/// neighbouring half steps are merged in the same places and every bit is the same.
#[derive(Debug)]
pub struct Pause<'a> {
    /// Steps since step 0.
    pub step: u64,
    /// Time since step 0 (ns).
    pub time: f64,
    pub(crate) system: &'a System,
    pub(crate) largest_kinetic: f64,
    pub(crate) evaluations_before: u64,
    pub(crate) last_good: &'a Snapshot,
}

impl Pause<'_> {
    /// The state.
    pub fn state(&self) -> &State {
        self.system.state()
    }

    /// What is needed to go on from here.
    pub fn checkpoint(&self) -> Checkpoint {
        Checkpoint {
            here: Snapshot::new(self.step, self.system, self.largest_kinetic),
            last_good: self.last_good.clone(),
            evaluations_before: self.evaluations_before,
        }
    }
}

/// All that a run carries at a pause. Scheme, step, drag, intervals and rules belong to the
/// [`Run`](crate::Run), interactions and drive to the system.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Checkpoint {
    /// Where the run stands.
    pub here: Snapshot,
    /// The last state that observers have seen.
    pub last_good: Snapshot,
    /// Evaluations of the loads that the system had made when the run began.
    pub evaluations_before: u64,
}

/// A state of a run with what goes with it.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Snapshot {
    /// Steps since step 0.
    pub step: u64,
    /// What moves.
    pub motion: Motion,
    /// Whether the loads of that state had been evaluated.
    pub loads_are_current: bool,
    /// Evaluations of the loads that the system had made.
    pub force_evaluations: u64,
    /// Largest kinetic energy (pN nm) at a check so far, against which growth is measured.
    pub largest_kinetic: f64,
}

impl Snapshot {
    pub(crate) fn new(step: u64, system: &System, largest_kinetic: f64) -> Self {
        Self {
            step,
            motion: system.state().motion(),
            loads_are_current: system.loads_are_current(),
            force_evaluations: system.force_evaluations(),
            largest_kinetic,
        }
    }

    /// Puts a system of the same bodies and terms there.
    pub(crate) fn restore(&self, system: &mut System) {
        system.restore(&self.motion, self.loads_are_current, self.force_evaluations);
    }
}

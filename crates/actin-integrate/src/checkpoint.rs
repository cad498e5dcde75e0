use actin_mechanics::{Motion, Split, State, System};

/// Sound, synchronised state between two batches of steps.
///
/// The division into batches depends on step numbers only, so that resumed runs agree bitwise.
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
    /// State of the system.
    pub fn state(&self) -> &State {
        self.system.state()
    }

    /// Creates a checkpoint of this state.
    pub fn checkpoint(&self) -> Checkpoint {
        Checkpoint {
            here: Snapshot::new(self.step, self.system, self.largest_kinetic),
            last_good: self.last_good.clone(),
            evaluations_before: self.evaluations_before,
        }
    }
}

/// State of a run for resumption. Settings belong to the [`Run`](crate::Run), interactions and
/// drive to the system.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Checkpoint {
    /// State at the pause.
    pub here: Snapshot,
    /// Last observed state.
    pub last_good: Snapshot,
    /// Evaluations of the loads before the run.
    pub evaluations_before: u64,
}

/// State of a run with its counters.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Snapshot {
    /// Steps since step 0.
    pub step: u64,
    /// Positions, momenta and controls.
    pub motion: Motion,
    /// Whether the loads of the state were current.
    pub loads_are_current: bool,
    /// Evaluations of the loads of the system.
    pub force_evaluations: u64,
    /// Largest kinetic energy (pN nm) at all checks.
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

    pub(crate) fn restore(&self, system: &mut System) {
        system.restore(&self.motion, self.loads_are_current, self.force_evaluations);
    }
}

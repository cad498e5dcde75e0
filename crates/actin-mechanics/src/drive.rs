//! Prescribed motion.

use crate::{Interaction, State};

/// Prescribed motion of held bodies and controls.
pub trait Drive: std::fmt::Debug + Send + Sync {
    /// Sets the positions and velocities of driven bodies and the controls at `time`.
    ///
    /// Called after every drift, which preserves the order of the integrator. Sliding bodies keep
    /// their displacement along their directions.
    fn place(&self, state: &mut State, time: f64);

    /// Energy that driven controls add to `interactions` over a time `t`, at the positions and the
    /// time of `state`, which is unchanged on return. The default is zero.
    fn work_of_controls(
        &self,
        _state: &mut State,
        _interactions: &[Box<dyn Interaction>],
        _t: f64,
    ) -> f64 {
        0.0
    }
}

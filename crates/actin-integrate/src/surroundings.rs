//! What acts on a system between conservative steps: nothing, drag, or a heat bath.

use crate::noise::{Half, Noise};
use crate::{Bath, Drag, Stage};
use actin_mechanics::{Agitate, Split};

/// What happens before and after each conservative step.
pub(crate) trait Surroundings<S: Split + ?Sized> {
    /// Acts for half a step, before one.
    fn before(&mut self, system: &mut S);

    /// Acts for half a step, after one.
    fn after(&mut self, system: &mut S);

    /// What lies between the inner stages of two steps: `stage` for a time `t`, the halves, and
    /// `stage` again.
    fn between(&mut self, system: &mut S, stage: Stage, t: f64) {
        stage.apply(system, t);
        self.after(system);
        self.before(system);
        stage.apply(system, t);
    }
}

impl Stage {
    /// Applies the stage for a time `t`.
    #[inline]
    pub(crate) fn apply<S: Split + ?Sized>(self, system: &mut S, t: f64) {
        match self {
            Self::Drift => system.drift(t),
            Self::Kick => system.kick(t),
        }
    }
}

/// Nothing: the stages on either side become one.
pub(crate) struct Nothing;

impl<S: Split + ?Sized> Surroundings<S> for Nothing {
    fn before(&mut self, _: &mut S) {}

    fn after(&mut self, _: &mut S) {}

    fn between(&mut self, system: &mut S, stage: Stage, t: f64) {
        stage.apply(system, 2.0 * t);
    }
}

/// Drag: the halves on either side become one.
pub(crate) struct Dragging {
    half: (f64, f64),
    whole: (f64, f64),
}

impl Dragging {
    /// Drag in steps of `h` (ns).
    pub(crate) fn over(drag: &Drag, h: f64) -> Self {
        Self {
            half: drag.factors(0.5 * h),
            whole: drag.factors(h),
        }
    }
}

impl<S: Split + ?Sized> Surroundings<S> for Dragging {
    fn before(&mut self, system: &mut S) {
        system.damp(self.half.0, self.half.1);
    }

    fn after(&mut self, system: &mut S) {
        system.damp(self.half.0, self.half.1);
    }

    fn between(&mut self, system: &mut S, stage: Stage, t: f64) {
        stage.apply(system, t);
        system.damp(self.whole.0, self.whole.1);
        stage.apply(system, t);
    }
}

/// A heat bath: the halves stay apart, so that no bit depends on where steps were counted in one
/// call and where in two.
pub(crate) struct Heating {
    factors: (f64, f64),
    spreads: (f64, f64),
    noise: Noise,
    step: u64,
}

impl Heating {
    /// The bath in steps of `h` (ns), the first of which has the number `step`, around so many
    /// points and frames.
    pub(crate) fn over(bath: &Bath, h: f64, step: u64, bodies: (usize, usize)) -> Self {
        Self {
            factors: bath.drag().factors(0.5 * h),
            spreads: bath.spreads(0.5 * h),
            noise: Noise::new(bath.seed(), bodies),
            step,
        }
    }

    /// The exact step of the Ornstein-Uhlenbeck process over half a step.
    fn act<S: Agitate + ?Sized>(&mut self, system: &mut S, half: Half) {
        self.noise.draw(self.step, half, self.spreads);
        system.damp(self.factors.0, self.factors.1);
        system.agitate(&self.noise.points, &self.noise.frames);
    }
}

impl<S: Agitate + ?Sized> Surroundings<S> for Heating {
    fn before(&mut self, system: &mut S) {
        self.act(system, Half::Before);
    }

    fn after(&mut self, system: &mut S) {
        self.act(system, Half::After);
        self.step += 1;
    }
}

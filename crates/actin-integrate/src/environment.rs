use crate::noise::{Half, Noise};
use crate::{Bath, Drag, Stage};
use actin_mechanics::{Split, Thermostat};

pub(crate) trait Environment<S: Split + ?Sized> {
    fn before(&mut self, system: &mut S);

    fn after(&mut self, system: &mut S);

    fn kicks(&self) -> (f64, f64) {
        (1.0, 1.0)
    }

    #[inline]
    fn apply(&self, stage: Stage, system: &mut S, t: f64) {
        match stage {
            Stage::Drift => system.drift(t),
            Stage::Kick => {
                let (translation, rotation) = self.kicks();
                system.kick(t * translation, t * rotation);
                system.record_work(t);
            }
        }
    }

    /// Actions between the inner stages of two steps: `stage` for a time `t`, both halves, and
    /// `stage` again.
    fn between(&mut self, system: &mut S, stage: Stage, t: f64) {
        self.apply(stage, system, t);
        self.after(system);
        self.before(system);
        self.apply(stage, system, t);
    }
}

pub(crate) struct NoEnvironment;

impl<S: Split + ?Sized> Environment<S> for NoEnvironment {
    fn before(&mut self, _: &mut S) {}

    fn after(&mut self, _: &mut S) {}

    fn between(&mut self, system: &mut S, stage: Stage, t: f64) {
        self.apply(stage, system, 2.0 * t);
    }
}

type Factors = (f64, f64);

fn times(a: Factors, b: Factors) -> Factors {
    (a.0 * b.0, a.1 * b.1)
}

/// Halves of the drag around a conservative step that is rescaled in time.
///
/// The step lasts `b h` with `b` of [`Drag::time_rescaling`]. It is made as a step of `h` with
/// velocities times `b` and kicks times `b^2`, so that held and driven bodies keep their time.
#[derive(Clone, Copy, Debug)]
struct Halves {
    /// Decay and rescaling of velocities.
    before: Factors,
    /// Inverse rescaling and decay.
    after: Factors,
    rescaling: Factors,
    kicks: Factors,
}

impl Halves {
    /// Halves of `drag` in steps of `h` (ns).
    fn new(drag: &Drag, h: f64) -> Self {
        let decay = drag.factors(0.5 * h);
        let b = drag.time_rescaling(h);
        Self {
            before: times(decay, b),
            after: (decay.0 / b.0, decay.1 / b.1),
            rescaling: b,
            kicks: times(b, b),
        }
    }
}

pub(crate) struct DragHalves {
    halves: Halves,
    whole: Factors,
}

impl DragHalves {
    pub(crate) fn new(drag: &Drag, h: f64) -> Self {
        Self {
            halves: Halves::new(drag, h),
            whole: drag.factors(h),
        }
    }
}

/// Multiplies velocities by `factors` and adds the heat to the energy balance. The velocities are
/// those of the motion times `scales`, before and after.
fn damp<S: Split + ?Sized>(system: &mut S, factors: Factors, scales: [Factors; 2]) {
    if let Some(before) = system.kinetic_energies() {
        let after = (before.0 * factors.0.powi(2), before.1 * factors.1.powi(2));
        system.record_heat(energy(after, scales[1]) - energy(before, scales[0]));
    }
    system.damp(factors.0, factors.1);
}

fn energy(kinetic: (f64, f64), scale: Factors) -> f64 {
    kinetic.0 / (scale.0 * scale.0) + kinetic.1 / (scale.1 * scale.1)
}

const UNSCALED: Factors = (1.0, 1.0);

impl<S: Split + ?Sized> Environment<S> for DragHalves {
    fn before(&mut self, system: &mut S) {
        damp(
            system,
            self.halves.before,
            [UNSCALED, self.halves.rescaling],
        );
    }

    fn after(&mut self, system: &mut S) {
        damp(system, self.halves.after, [self.halves.rescaling, UNSCALED]);
    }

    fn kicks(&self) -> (f64, f64) {
        self.halves.kicks
    }

    fn between(&mut self, system: &mut S, stage: Stage, t: f64) {
        self.apply(stage, system, t);
        damp(system, self.whole, [self.halves.rescaling; 2]);
        self.apply(stage, system, t);
    }
}

/// Heat bath. Halves are not merged, so that results do not depend on the division into calls.
pub(crate) struct Heating {
    halves: Halves,
    spreads: Factors,
    noise: Noise,
    step: u64,
}

impl Heating {
    /// Creates a bath in steps of `h` (ns) from the step with the number `step`.
    pub(crate) fn new(bath: &Bath, h: f64, step: u64, bodies: (usize, usize)) -> Self {
        Self {
            halves: Halves::new(bath.drag(), h),
            spreads: bath.spreads(0.5 * h),
            noise: Noise::new(bath.seed(), bodies),
            step,
        }
    }

    /// Makes an exact Ornstein-Uhlenbeck step over half a step, with decay by `factors` and
    /// impulses of the standard deviations `spreads`.
    fn act<S: Thermostat + ?Sized>(
        &mut self,
        system: &mut S,
        half: Half,
        (factors, spreads): (Factors, Factors),
        scales: [Factors; 2],
    ) {
        self.noise.draw(self.step, half, spreads);
        let before = system.kinetic_energies();
        system.damp(factors.0, factors.1);
        system.add_thermal_impulses(&self.noise.points, &self.noise.frames);
        if let (Some(before), Some(after)) = (before, system.kinetic_energies()) {
            system.record_heat(energy(after, scales[1]) - energy(before, scales[0]));
        }
    }
}

impl<S: Thermostat + ?Sized> Environment<S> for Heating {
    fn before(&mut self, system: &mut S) {
        let Halves {
            before, rescaling, ..
        } = self.halves;
        let acts = (before, times(self.spreads, rescaling));
        self.act(system, Half::Before, acts, [UNSCALED, rescaling]);
    }

    fn after(&mut self, system: &mut S) {
        let Halves {
            after, rescaling, ..
        } = self.halves;
        let acts = (after, self.spreads);
        self.act(system, Half::After, acts, [rescaling, UNSCALED]);
        self.step += 1;
    }

    fn kicks(&self) -> (f64, f64) {
        self.halves.kicks
    }
}

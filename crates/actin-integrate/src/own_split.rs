use crate::{Reason, Run, RunSettingError, advance};
use actin_mechanics::Split;
use std::ops::ControlFlow;

/// Custom system at a step, with positions and momenta at the same time.
#[derive(Debug)]
pub struct SplitMoment<'a, S: ?Sized> {
    /// Steps since step 0.
    pub step: u64,
    /// Time since step 0 (ns).
    pub time: f64,
    /// System.
    pub system: &'a mut S,
}

/// Outcome of the run of a custom system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplitOutcome {
    /// [`Reason::Completed`] or [`Reason::Interrupted`].
    pub reason: Reason,
    /// Number of steps of this run.
    pub steps: u64,
    /// Time of the final state (ns), counted from step 0.
    pub time: f64,
    /// Evaluations of the loads during this run.
    pub force_evaluations: u64,
}

impl Run {
    /// Advances a custom system like [`execute`](Self::execute), and calls `observe` at the same
    /// steps. [`ControlFlow::Break`] ends the run. The state is not checked.
    ///
    /// ```
    /// use actin_integrate::{IntegrationError, PEFRL, Run, Split};
    /// use std::ops::ControlFlow;
    ///
    /// /// `x'' = -x`
    /// struct Oscillator { x: f64, v: f64, kicks: u64 }
    ///
    /// impl Split for Oscillator {
    ///     fn drift(&mut self, h: f64) { self.x += h * self.v; }
    ///     fn kick(&mut self, h: f64, _: f64) { self.v -= h * self.x; self.kicks += 1; }
    ///     fn damp(&mut self, factor: f64, _: f64) { self.v *= factor; }
    ///     fn force_evaluations(&self) -> u64 { self.kicks }
    /// }
    ///
    /// let mut oscillator = Oscillator { x: 1.0, v: 0.0, kicks: 0 };
    /// let run = Run::from_duration(&PEFRL, 0.05, std::f64::consts::TAU)?;
    /// let outcome = run.execute_split(&mut oscillator, |_| ControlFlow::Continue(()))?;
    /// assert!((oscillator.x - 1.0).abs() < 1e-6 && oscillator.v.abs() < 1e-6);
    /// assert_eq!(outcome.force_evaluations, 4 * outcome.steps);
    /// # Ok::<(), IntegrationError>(())
    /// ```
    ///
    /// # Errors
    /// If the run has a heat bath, a stop rule or an energy limit, which need the state of a
    /// `System`.
    pub fn execute_split<S: Split + ?Sized>(
        &self,
        system: &mut S,
        mut observe: impl FnMut(SplitMoment<'_, S>) -> ControlFlow<()>,
    ) -> Result<SplitOutcome, RunSettingError> {
        self.ensure_it_needs_no_state()?;
        let before = system.force_evaluations();
        let end = self.first_step + self.steps;
        let mut step = self.first_step;
        // The start of a continuation is not observed again.
        let mut is_shown = step == 0 || self.steps == 0;
        let reason = loop {
            let time = self.time(step);
            let flow = if is_shown {
                let system = &mut *system;
                observe(SplitMoment { step, time, system })
            } else {
                ControlFlow::Continue(())
            };
            if step == end {
                break Reason::Completed;
            } else if flow.is_break() {
                break Reason::Interrupted;
            }
            let next = end.min((step / self.observe_every + 1) * self.observe_every);
            advance(system, self.scheme, self.h, next - step, &self.drag);
            (step, is_shown) = (next, true);
        };
        Ok(SplitOutcome {
            reason,
            steps: step - self.first_step,
            time: self.time(step),
            force_evaluations: system.force_evaluations() - before,
        })
    }

    fn ensure_it_needs_no_state(&self) -> Result<(), RunSettingError> {
        let settings = [
            (self.bath.is_some(), "a heat bath"),
            (self.stop.is_some(), "a stop rule"),
            (
                self.kinetic_limit < f64::INFINITY,
                "a limit of the kinetic energy",
            ),
            (self.energy_limit < f64::INFINITY, "a limit of the energy"),
        ];
        match settings.into_iter().find(|(is_set, _)| *is_set) {
            Some((_, setting)) => Err(RunSettingError::NeedsSystem(setting)),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Drag, POSITION_VERLET, StopRule};

    #[derive(Clone, Debug, PartialEq)]
    struct Ball {
        x: f64,
        v: f64,
    }

    impl Split for Ball {
        fn drift(&mut self, h: f64) {
            self.x += h * self.v;
        }
        fn kick(&mut self, _: f64, _: f64) {}
        fn damp(&mut self, factor: f64, _: f64) {
            self.v *= factor;
        }
        fn force_evaluations(&self) -> u64 {
            0
        }
    }

    fn ball() -> Ball {
        Ball { x: 0.0, v: 1.0 }
    }

    fn run(steps: u64) -> Run {
        let run = Run::new(&POSITION_VERLET, 0.25, steps).unwrap();
        run.observing_every(4).unwrap()
    }

    /// Observations at the start, at multiples of the interval and at the end. A continued run
    /// agrees bitwise.
    #[test]
    fn a_run_is_observed_and_can_be_continued() {
        let drag = Drag::new(0.5, 0.5).unwrap();
        let mut shown = Vec::new();
        let mut whole = ball();
        let outcome = run(10).with_drag(drag).execute_split(&mut whole, |moment| {
            shown.push((moment.step, moment.time));
            ControlFlow::Continue(())
        });
        assert_eq!(shown, [(0, 0.0), (4, 1.0), (8, 2.0), (10, 2.5)]);
        let outcome = outcome.unwrap();
        assert_eq!((outcome.reason, outcome.steps), (Reason::Completed, 10));
        assert!((whole.v - (-0.5_f64 * 2.5).exp()).abs() < 1e-14);

        let mut parts = ball();
        let first = run(10).with_drag(drag).execute_split(&mut parts, |moment| {
            if moment.step == 4 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        assert_eq!(first.unwrap().reason, Reason::Interrupted);
        let rest = run(6).with_drag(drag).continuing_from(4);
        let mut shown = Vec::new();
        let second = rest.execute_split(&mut parts, |moment| {
            shown.push(moment.step);
            ControlFlow::Continue(())
        });
        assert_eq!((shown, second.unwrap().time), (vec![8, 10], 2.5));
        assert_eq!(parts, whole);
    }

    #[test]
    fn settings_that_need_a_system_are_refused() {
        let refused = |run: Run| {
            let result = run.execute_split(&mut ball(), |_| ControlFlow::Continue(()));
            matches!(result, Err(RunSettingError::NeedsSystem(_)))
        };
        assert!(!refused(run(1)));
        assert!(refused(
            run(1).with_stop_rule(StopRule::new(1.0, 1.0, 1.0).unwrap())
        ));
        assert!(refused(run(1).with_kinetic_limit(1.0).unwrap()));
        assert!(refused(run(1).with_energy_limit(1.0).unwrap()));
    }
}

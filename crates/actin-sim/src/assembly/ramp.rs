//! The path of a scene in time, smooth ramps from stage to stage, and the factors of its loads.

use super::{Assembly, Drive, Part};
use crate::At;
use crate::scene::{Factor, Pace, smooth};
use actin_mechanics::{ControlId, Interaction, State, Vector3};

/// A [`Drive`] whose stages take their durations one after the other; behind the last, controls
/// stay where they are.
///
/// Within a smooth stage the path parameter grows by `r(x) = x^3 (10 - 15 x + 6 x^2)`, x the share of its
/// time: velocity and acceleration of what is driven are zero at both ends.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ramp {
    drive: Drive,
    times: StageTimes,
    /// Loads that change in time, and whether the path sets their factor too.
    factors: Vec<(ControlId, Factor, bool)>,
    /// Interactions whose controls it may move.
    controlled: Vec<usize>,
}

/// Share of the time for which work is booked between the two controls whose difference gives their rate.
const RATE_OVER: f64 = 1e-3;

impl Ramp {
    /// What moves in an assembly as time goes; none where nothing does.
    pub(crate) fn of(assembly: &Assembly) -> Option<Self> {
        let drive = assembly.drive.clone();
        let loads = assembly.scene.loads.iter().zip(&assembly.loads);
        let factors: Vec<_> = loads
            .filter(|(load, _)| !load.factor().is_constant())
            .map(|(load, &control)| (control, load.factor().clone(), drive.sets(control)))
            .collect();
        let times = StageTimes::of(assembly);
        (!drive.is_still() || !factors.is_empty()).then_some(Self {
            drive,
            times,
            factors,
            controlled: controlled(assembly),
        })
    }

    /// From when on everything stays where it is (ns).
    pub(crate) fn duration(&self) -> f64 {
        let settled = self
            .factors
            .iter()
            .map(|(_, factor, _)| factor.settles_at());
        settled.fold(self.times.end, f64::max)
    }
}

/// Terms of the loads and linkers whose controls the path or time changes.
fn controlled(assembly: &Assembly) -> Vec<usize> {
    let changes = |part: Part| match part {
        Part::Load(i) => {
            let is_constant = assembly.scene.loads[i].factor().is_constant();
            !is_constant || assembly.drive.sets(assembly.loads[i])
        }
        Part::Linker(i) => {
            let anchor = assembly.linkers[i].anchor_controls();
            anchor.is_some_and(|controls| assembly.drive.moves(controls))
        }
        _ => false,
    };
    let terms = assembly.terms.iter().enumerate();
    terms
        .filter_map(|(i, term)| changes(term.part).then_some(i))
        .collect()
}

/// When the stages of a path begin, and how long they take.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct StageTimes {
    /// Begin and duration of each stage (ns), and how controls move in it.
    stages: Vec<(f64, f64, Pace)>,
    /// When the last one ends (ns).
    end: f64,
}

impl StageTimes {
    fn new(durations: impl IntoIterator<Item = (f64, Pace)>) -> Self {
        let mut end = 0.0;
        let stages = durations.into_iter().map(|(duration, pace)| {
            let begin = end;
            end += duration;
            (begin, duration, pace)
        });
        let stages = stages.collect();
        Self { stages, end }
    }

    /// Those of an assembly's path.
    pub(crate) fn of(assembly: &Assembly) -> Self {
        let stages = assembly.scene.path.iter();
        Self::new(stages.filter_map(|stage| Some((stage.duration_ns?, stage.pace))))
    }

    /// Path parameter at `time` (ns) and its rate (1/ns).
    pub(crate) fn parameter(&self, time: f64) -> (f64, f64) {
        let past = |&(begin, duration, _): &(f64, f64, Pace)| (time - begin) / duration >= 1.0;
        let stage = self.stages.partition_point(past);
        let Some(&(begin, duration, pace)) = self.stages.get(stage) else {
            return (stage as f64, 0.0);
        };
        let x = ((time - begin) / duration).max(0.0);
        let (share, rate) = match pace {
            Pace::Smooth => (smooth(x), 30.0 * (x * (1.0 - x)).powi(2) / duration),
            Pace::Steady => (x, 1.0 / duration),
        };
        (stage as f64 + share, rate)
    }
}

impl actin_mechanics::Drive for Ramp {
    fn place(&self, state: &mut State, time: f64) {
        let (u, rate) = self.times.parameter(time);
        self.drive.place_moving(state, u, rate);
        self.set_factors(state, time);
    }

    fn work_of_controls(
        &self,
        state: &mut State,
        interactions: &[Box<dyn Interaction>],
        t: f64,
    ) -> f64 {
        if self.controlled.is_empty() {
            return 0.0;
        }
        let (here, time) = (state.controls.clone(), state.time);
        let mut energy_at = |time: f64| -> f64 {
            self.drive.set_controls(state, self.times.parameter(time).0);
            self.set_factors(state, time);
            let all = self.controlled.iter();
            all.map(|&i| interactions[i].energy(state)).sum()
        };
        let apart = RATE_OVER * t;
        let gained = energy_at(time + apart) - energy_at(time - apart);
        state.controls = here;
        gained / (2.0 * RATE_OVER)
    }
}

impl Ramp {
    /// Factors of loads that change in time, on top of what the path has set.
    fn set_factors(&self, state: &mut State, time: f64) {
        for (control, factor, is_set) in &self.factors {
            let of_path = if *is_set {
                state.controls[*control]
            } else {
                1.0
            };
            state.controls[*control] = of_path * factor.at(time);
        }
    }
}

impl Assembly {
    /// Motion in time of what the scene moves: factors of loads, anchors and held ends; `None` where all of it stays.
    pub fn drive_in_time(&self) -> Option<Box<dyn actin_mechanics::Drive>> {
        Ramp::of(self).map(|ramp| Box::new(ramp) as Box<dyn actin_mechanics::Drive>)
    }

    /// Puts factors of loads, anchors and held bodies where the scene has them at that time or place of its
    /// path.
    pub fn place_controls(&self, state: &mut State, at: At) {
        match at {
            At::Path(parameter) => self.drive.place(state, parameter),
            At::Time(time_ns) => {
                if let Some(ramp) = Ramp::of(self) {
                    actin_mechanics::Drive::place(&ramp, state, time_ns);
                }
            }
        }
    }

    /// Where linker `i` begins and ends in `state` (nm, lab frame), and whether it holds.
    ///
    /// # Panics
    /// If there is no such linker.
    pub fn linker_ends(&self, i: usize, state: &State) -> ([Vector3; 2], bool) {
        let (linker, holds) = self.linker_in(i, state);
        let ends = [linker.site().position(state), linker.end_position(state)];
        (ends, holds)
    }

    /// The force with which linker `i` pulls its ends together in `state` (pN): negative where it pushes, zero where
    /// it does not hold.
    ///
    /// # Panics
    /// If there is no such linker.
    pub fn linker_pull_pn(&self, i: usize, state: &State) -> f64 {
        let (linker, holds) = self.linker_in(i, state);
        let span = linker.end_position(state) - linker.site().position(state);
        match span.try_normalize(0.0) {
            Some(along) if holds => linker.force(state).dot(&along),
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rate is the derivative of the parameter, and nothing jumps between stages.
    #[test]
    fn ramps_are_smooth() {
        let ramp = StageTimes::new([2.0, 0.5].map(|duration| (duration, Pace::Smooth)));
        assert_eq!(ramp.parameter(-1.0), (0.0, 0.0));
        assert!((ramp.parameter(1.0).0 - 0.5).abs() < 1e-15);
        assert_eq!(ramp.parameter(3.0), (2.0, 0.0));
        for time in [0.3, 1.7, 2.0, 2.1, 2.4] {
            let h = 1e-4;
            let slope = (ramp.parameter(time + h).0 - ramp.parameter(time - h).0) / (2.0 * h);
            // Third derivatives up to 60 / 0.5^3 times h^2/6.
            assert!((slope - ramp.parameter(time).1).abs() < 1e-6, "{time}");
        }
    }
}

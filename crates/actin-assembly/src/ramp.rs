//! Path of a scene in time, with smooth ramps, and time-dependent load factors.

use super::{Assembly, Drive, LinkerEvent, Part};
use crate::At;
use crate::scene::{Factor, TimeCourse, smooth};
use actin_mechanics::{ControlId, Interaction, State};

/// A [`Drive`] in time: stages follow one another with their durations. Controls are constant after
/// the last stage.
///
/// In a smooth stage the path parameter grows by `r(x) = x^3 (10 - 15 x + 6 x^2)`, `x` the elapsed
/// share of its duration. Velocity and acceleration vanish at both ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Ramp {
    drive: Drive,
    times: StageTimes,
    /// Time-dependent factors of loads and of the strain, and whether the path also sets each factor.
    factors: Vec<(ControlId, Factor, bool)>,
    /// Indices of the interactions with time-dependent controls.
    controlled: Vec<usize>,
}

/// Distance of the two controls whose difference gives their rate, over the time step of the work.
const RATE_OVER: f64 = 1e-3;

impl Ramp {
    /// Creates the prescribed motion of an assembly; `None` if all controls are constant.
    pub fn from_assembly(assembly: &Assembly) -> Option<Self> {
        let drive = assembly.drive.clone();
        let loads = assembly.scene.loads.iter().zip(&assembly.loads);
        let of_loads = loads.map(|(load, &control)| (control, load.factor()));
        let periodic = assembly.scene.periodic.as_ref();
        let strain = assembly.cell.map(|cell| cell.factor);
        let of_strain = strain.zip(periodic.map(|one| &one.factor));
        let factors: Vec<_> = of_loads
            .chain(of_strain)
            .filter(|(_, factor)| !factor.is_constant())
            .map(|(control, factor)| (control, factor.clone(), drive.sets(control)))
            .collect();
        let times = StageTimes::from_assembly(assembly);
        (!drive.is_still() || !factors.is_empty()).then_some(Self {
            drive,
            times,
            factors,
            controlled: controlled(assembly),
        })
    }

    /// Time (ns) after which all controls are constant.
    pub fn duration(&self) -> f64 {
        let settled = self
            .factors
            .iter()
            .map(|(_, factor, _)| factor.settles_at());
        settled.fold(self.times.end, f64::max)
    }
}

fn controlled(assembly: &Assembly) -> Vec<usize> {
    let changes = |part: Part| match part {
        Part::Load(i) => {
            let is_constant = assembly.scene.loads[i].factor().is_constant();
            !is_constant || assembly.drive.sets(assembly.loads[i])
        }
        Part::Linker(i) => {
            let linker = &assembly.linkers[i];
            let anchor = linker.anchor_controls();
            let is_strained = linker.image().is_some_and(|image| image.cell.strain != 0.0);
            is_strained || anchor.is_some_and(|controls| assembly.drive.moves(controls))
        }
        Part::Contacts => assembly.cell.is_some_and(|cell| cell.strain != 0.0),
        _ => false,
    };
    let terms = assembly.terms.iter().enumerate();
    terms
        .filter_map(|(i, term)| changes(term.part).then_some(i))
        .collect()
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct StageTimes {
    /// Start and duration of each stage (ns), and its pace.
    stages: Vec<(f64, f64, TimeCourse)>,
    /// End of the last stage (ns).
    end: f64,
}

impl StageTimes {
    fn new(durations: impl IntoIterator<Item = (f64, TimeCourse)>) -> Self {
        let mut end = 0.0;
        let stages = durations.into_iter().map(|(duration, pace)| {
            let begin = end;
            end += duration;
            (begin, duration, pace)
        });
        let stages = stages.collect();
        Self { stages, end }
    }

    pub(crate) fn from_assembly(assembly: &Assembly) -> Self {
        let stages = assembly.scene.path.iter();
        Self::new(stages.filter_map(|stage| Some((stage.duration_ns?, stage.pace))))
    }

    /// Path parameter at `time` (ns) and its rate (1/ns).
    pub(crate) fn parameter(&self, time: f64) -> (f64, f64) {
        let past =
            |&(begin, duration, _): &(f64, f64, TimeCourse)| (time - begin) / duration >= 1.0;
        let stage = self.stages.partition_point(past);
        let Some(&(begin, duration, pace)) = self.stages.get(stage) else {
            return (stage as f64, 0.0);
        };
        let x = ((time - begin) / duration).max(0.0);
        let (share, rate) = match pace {
            TimeCourse::Smooth => (smooth(x), 30.0 * (x * (1.0 - x)).powi(2) / duration),
            TimeCourse::Steady => (x, 1.0 / duration),
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
    /// Applies time-dependent factors to the loads, multiplied by the factors of the path.
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
    /// Returns the prescribed motion in time of loads, anchors and held ends; `None` if nothing
    /// moves.
    pub fn drive_in_time(&self) -> Option<Box<dyn actin_mechanics::Drive>> {
        Ramp::from_assembly(self).map(|ramp| Box::new(ramp) as Box<dyn actin_mechanics::Drive>)
    }

    /// Sets load factors, anchors and held bodies to their values at a time or place of the path.
    pub fn place_controls(&self, state: &mut State, at: At) {
        match at {
            At::Path(parameter) => self.drive.place(state, parameter),
            At::Time(time_ns) => {
                if let Some(ramp) = Ramp::from_assembly(self) {
                    actin_mechanics::Drive::place(&ramp, state, time_ns);
                }
            }
        }
    }

    /// Sets the controls of a state at a time or place of the path: load factors, anchors, held
    /// bodies, and linkers after the `events` up to then.
    pub fn restore_controls(&self, state: &mut State, at: At, events: &[LinkerEvent]) {
        self.place_controls(state, at);
        let (At::Time(time_ns), Some(kinetics)) = (at, &self.kinetics) else {
            return;
        };
        for event in events.iter().take_while(|event| event.time_ns <= time_ns) {
            if let Some(switching) = kinetics.linker(event.linker) {
                switching.restore(state, event);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ramps_are_smooth() {
        let ramp = StageTimes::new([2.0, 0.5].map(|duration| (duration, TimeCourse::Smooth)));
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

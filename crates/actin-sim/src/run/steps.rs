//! Number of time steps of a motion and between its records.

use super::{Estimate, composition};
use crate::codes;
use crate::scene::{Dynamics, Scene, SceneProblem, Task};
use actin_assembly::Note;
use actin_assembly::whole::to_steps;
use actin_integrate::Drag;
use std::f64::consts::SQRT_2;

const DEFAULT_RECORDS: f64 = 100.0;

/// Largest exact number of steps, 2^53.
const MOST_STEPS: f64 = 9_007_199_254_740_992.0;

/// Largest ratio of steps between records to the fewest possible, for which both interval and
/// duration are whole numbers of steps.
const MOST_EXTRA: f64 = 1.2;

/// Largest number of records after which a record and the end of the run coincide.
const MOST_PERIOD: u64 = 1000;

/// Relative tolerance for a whole quotient.
const WHOLE: f64 = 1e-9;

/// Relative round-off of a whole quotient.
const ROUND_OFF: f64 = 1e-12;

/// Relative error of the recorded drift velocity that gives a warning.
const RECORDED_DRIFT: f64 = 0.01;

/// Largest approach of contacts (nm) without a warning.
const LARGEST_APPROACH_NM: f64 = 1.0;

impl Estimate {
    /// Creates the estimate of a motion in steps of at most `largest_ns`, without force evaluations.
    /// The steps divide the duration of `dynamics` and, where this takes few additional steps, the
    /// interval of its records.
    ///
    /// # Errors
    /// If the number of steps exceeds 2^53.
    pub(super) fn in_steps(dynamics: &Dynamics, largest_ns: f64) -> Result<Self, SceneProblem> {
        let duration = dynamics.duration_ns;
        let (count, between, record_every_ns) = match dynamics.record_every_ns {
            Some(every) if every < duration => recorded_every(duration, every, largest_ns),
            every => {
                let count = at_least(duration, largest_ns);
                let length = duration / count;
                let wanted = every.unwrap_or(duration / DEFAULT_RECORDS);
                let between = (wanted / length).round().max(1.0);
                (count, between, between * length)
            }
        };
        if !(1.0..=MOST_STEPS).contains(&count) {
            return Err(uncountable(dynamics, largest_ns));
        }
        Ok(Self {
            largest_frequency_rad_per_ns: 0.0,
            stability_limit_ns: f64::INFINITY,
            time_step_ns: duration / count,
            steps: to_steps(count),
            steps_between_records: to_steps(between),
            record_every_ns,
            force_evaluations: 0,
            longest_sound_step: None,
            approach_nm: None,
        })
    }
}

fn uncountable(dynamics: &Dynamics, largest_ns: f64) -> SceneProblem {
    match dynamics.record_every_ns {
        Some(every) if every < largest_ns => SceneProblem::new(
            "task.record_every_ns",
            format!("{every:?}"),
            "requires more than 2^53 steps, which cannot be counted: no step is longer than this interval",
        ),
        _ => SceneProblem::new(
            "task.duration_ns",
            format!("{:?}", dynamics.duration_ns),
            format!(
                "requires more than 2^53 steps of {largest_ns:.4e} ns, which cannot be counted"
            ),
        ),
    }
}

/// Smallest number of steps of at most `largest` in `time`.
fn at_least(time: f64, largest: f64) -> f64 {
    (time / largest * (1.0 - ROUND_OFF)).ceil().max(1.0)
}

/// Returns the number of steps, the steps between records, and their interval. The interval is
/// `every`, or shorter by less than a step's share if no step divides both times.
fn recorded_every(duration: f64, every: f64, largest: f64) -> (f64, f64, f64) {
    let fewest = at_least(every, largest);
    if let Some(between) = between_records(duration, every, fewest) {
        return ((duration / every * between).round(), between, every);
    }
    let count = at_least(duration, every / fewest);
    (count, fewest, duration / count * fewest)
}

/// Steps between records, `fewest` or slightly more, that also divide the run; `None` if that takes
/// many more.
fn between_records(duration: f64, every: f64, fewest: f64) -> Option<f64> {
    let intervals = duration / every;
    // The duration is a whole number of steps if their number is a multiple of such a period.
    let is_period = |period: &u64| {
        let product = *period as f64 * intervals;
        (product - product.round()).abs() <= WHOLE * product
    };
    let period = (1..=MOST_PERIOD).find(is_period)? as f64;
    let between = period * (fewest / period).ceil();
    (period <= 1.0 || between <= MOST_EXTRA * fewest).then_some(between)
}

impl Estimate {
    /// Returns warnings about a time step and records that differ from the request in `task`, and
    /// about effects of strong drag on records.
    pub(crate) fn notes(&self, task: &Task) -> Vec<Note> {
        let Some(motion) = task.motion() else {
            return Vec::new();
        };
        let dynamics = motion.as_ref();
        let notes = [
            self.note_on_step(dynamics).map(Note::from),
            self.note_on_records(dynamics).map(Note::from),
            (self.note_on_drag(dynamics)).map(|text| Note::warning(codes::STRONG_DRAG, text)),
            (self.note_on_long_steps()).map(|text| Note::warning(codes::LONG_STEPS, text)),
            (self.note_on_contacts()).map(|text| Note::warning(codes::CONTACT_STEPS, text)),
        ];
        notes.into_iter().flatten().collect()
    }

    /// Ratio of the configurational temperature of the fastest mode to the bath temperature, due to
    /// the integrator.
    pub fn fastest_mode_temperature_ratio(&self, dynamics: &Dynamics) -> f64 {
        if dynamics.drag.fluid().is_some() {
            // Steps in a fluid are exact for linear modes.
            return 1.0;
        }
        let (rates, step) = (dynamics.drag.rates(), self.time_step_ns);
        let drag = Drag::new(rates.translational_per_ns, rates.rotational_per_ns);
        let (translation, rotation) = drag.unwrap_or(Drag::NONE).time_rescaling(step);
        // The mode belongs to points or frames; stronger drag brings it closer to 1.
        let theta = translation.max(rotation) * self.largest_frequency_rad_per_ns * step;
        let scheme = composition(dynamics.integrator);
        scheme.configurational_temperature(theta)
    }

    /// Returns `true` if overdamped steps use random stress: in a heat bath without bonds of
    /// monomers. Bonds shorter than their slip have no suitable stiffness.
    pub(crate) fn has_random_stress(&self) -> bool {
        let longest = self.longest_sound_step.as_ref();
        longest.is_some_and(|l| !l.has_bonds && self.exceeds(l.of_midpoints_ns))
    }

    fn exceeds(&self, ns: f64) -> bool {
        self.time_step_ns > ns * (1.0 + WHOLE)
    }

    fn note_on_long_steps(&self) -> Option<String> {
        let longest = self.longest_sound_step.as_ref()?;
        let what = if longest.has_bonds {
            "stretch and shear then exceed their thermal energy"
        } else {
            "bending modes that relax within a step are sampled anew in each step, driven motion is delayed, and \
             short waves under load have too little thermal energy"
        };
        self.exceeds(longest.ns).then(|| {
            let (step, longest) = (self.time_step_ns, longest.ns);
            format!("steps of {step:.1e} ns are longer than the default {longest:.1e} ns: {what}")
        })
    }

    fn note_on_contacts(&self) -> Option<String> {
        let approach = self
            .approach_nm
            .filter(|approach| *approach > LARGEST_APPROACH_NM)?;
        let step = self.time_step_ns;
        Some(format!(
            "in heat, contacts act late in steps of {step:.1e} ns: filaments stay at walls as if these were about {approach:.1} \
             nm farther away, and at each other as if they were {:.1} nm thinner; 1 nm at walls in steps of {:.1e} ns",
            SQRT_2 * approach,
            // The stiff length grows with `h^(1/4)`.
            step / approach.powf(8.0 / 3.0)
        ))
    }

    fn note_on_step(&self, dynamics: &Dynamics) -> Option<String> {
        let asked = dynamics.time_step_ns?;
        let step = self.time_step_ns;
        let differs = (step / asked - 1.0).abs() > WHOLE;
        let whole = match dynamics.record_every_ns {
            Some(every) if every < dynamics.duration_ns => {
                "the interval of records and the duration"
            }
            _ => "the duration",
        };
        differs.then(|| {
            format!(
                "task.time_step_ns = {asked:?}: steps of {step:.6e} ns are used, which divide {whole} \
                 evenly"
            )
        })
    }

    fn note_on_records(&self, dynamics: &Dynamics) -> Option<String> {
        let asked = dynamics.record_every_ns?;
        let (every, duration) = (self.record_every_ns, dynamics.duration_ns);
        if asked >= duration {
            return (asked > duration).then(|| {
                format!(
                    "task.record_every_ns = {asked:?}: longer than the motion, whose start and end \
                     are recorded"
                )
            });
        }
        let differs = (every / asked - 1.0).abs() > WHOLE;
        differs.then(|| {
            format!(
                "task.record_every_ns = {asked:?}: records are {every:.6} ns apart, because no step \
                 of about {:.2e} ns divides both this interval and the duration of {duration:?} ns evenly",
                self.time_step_ns
            )
        })
    }

    /// Warning about means in a heat bath that cover at most one record.
    pub(super) fn note_on_means(&self, scene: &Scene) -> Option<Note> {
        let from = scene.burn_in().filter(|_| !scene.observe.is_empty())?;
        let interval = self.steps_between_records as f64 * self.time_step_ns;
        let first = (from / interval * (1.0 - ROUND_OFF)).ceil();
        let last = (self.steps / self.steps_between_records) as f64;
        // The end is recorded as well.
        let is_beyond = !self.steps.is_multiple_of(self.steps_between_records);
        let records = (last - first + 1.0).max(0.0) + f64::from(u8::from(is_beyond));
        (records < 2.0).then(|| {
            let message = format!(
                "observe: means average {records} record(s) after burn_in_ns = {from:?} and have no error \
                 estimate: use a longer duration_ns or a shorter record_every_ns"
            );
            Note::warning(codes::FEW_RECORDS, message)
        })
    }

    fn note_on_drag(&self, dynamics: &Dynamics) -> Option<String> {
        // In a bath velocities have the correct temperature for any drag.
        if dynamics.thermal.is_some() {
            return None;
        }
        let rates = dynamics.drag.rates();
        let drag = Drag::new(rates.translational_per_ns, rates.rotational_per_ns).ok()?;
        let step = self.time_step_ns;
        let (translation, rotation) = drag.recorded_drift(step);
        let recorded = translation.min(rotation);
        (recorded < 1.0 - RECORDED_DRIFT).then(|| {
            format!(
                "drag: within a step velocities decay by exp(-{:.2}) and angular velocities by \
                 exp(-{:.2}); displacements, diffusion and states at rest are correct, relaxation over a \
                 time T has a relative error of {:.1e} ns / T, but velocities and kinetic energies are \
                 recorded just after drag and show {translation:.3} and {rotation:.3} of a steady drift",
                drag.translational() * step,
                drag.rotational() * step,
                0.5 * step
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;

    fn dynamics(task: &str) -> Dynamics {
        let text = format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 30.0)]),
                task: Dynamics({task}),
            )"
        );
        match Scene::from_ron(&text).unwrap().task {
            Task::Dynamics(dynamics) => dynamics,
            _ => unreachable!("the text above is a motion"),
        }
    }

    fn steps(task: &str, largest: f64) -> (u64, u64, f64) {
        let steps = Estimate::in_steps(&dynamics(task), largest).unwrap();
        (
            steps.steps,
            steps.steps_between_records,
            steps.record_every_ns,
        )
    }

    /// 17.9 steps of 0.0028 ns in 0.05 ns become 18.
    #[test]
    fn steps_make_up_the_interval_of_records() {
        let task = "duration_ns: 1.0, record_every_ns: 0.05";
        assert_eq!(steps(task, 0.0028), (360, 18, 0.05));
        // 33 1/3 intervals: the steps between records are a multiple of three.
        let task = "duration_ns: 1.0, record_every_ns: 0.03";
        assert_eq!(steps(task, 0.0017), (600, 18, 0.03));
        // A record at every step.
        let task = "duration_ns: 1.0, record_every_ns: 0.001";
        assert_eq!(steps(task, 0.0028), (1000, 1, 0.001));
        // Round-off does not add a step.
        let task = "duration_ns: 0.3, record_every_ns: 0.1";
        assert_eq!(steps(task, 0.1), (3, 1, 0.1));
    }

    #[test]
    fn incommensurate_intervals_are_rounded_with_a_warning() {
        let task = dynamics("duration_ns: 0.777, record_every_ns: 0.1, time_step_ns: 0.003");
        let steps = Estimate::in_steps(&task, 0.003).unwrap();
        assert_eq!((steps.steps, steps.steps_between_records), (265, 34));
        assert!((steps.record_every_ns - 0.777 / 265.0 * 34.0).abs() < 1e-12);
        let notes = texts(estimate(steps).notes(&Task::Dynamics(task)));
        assert_eq!(notes.len(), 2);
        assert!(
            notes[0].contains("steps of 2.932075e-3 ns are used"),
            "{notes:?}"
        );
        assert!(
            notes[1].contains("records are 0.099691 ns apart"),
            "{notes:?}"
        );
    }

    fn estimate(steps: Estimate) -> Estimate {
        Estimate {
            largest_frequency_rad_per_ns: 500.0,
            stability_limit_ns: 0.006,
            ..steps
        }
    }

    fn notes(task: &str) -> Vec<String> {
        let task = dynamics(task);
        let steps = Estimate::in_steps(&task, task.time_step_ns.unwrap_or(0.003)).unwrap();
        texts(estimate(steps).notes(&Task::Dynamics(task)))
    }

    fn texts(notes: Vec<Note>) -> Vec<String> {
        notes.into_iter().map(|note| note.message).collect()
    }

    #[test]
    fn deviations_from_the_request_give_warnings() {
        let report_extrapolation =
            notes("duration_ns: 1.0, record_every_ns: 0.05, time_step_ns: 0.003");
        assert_eq!(
            report_extrapolation,
            [
                "task.time_step_ns = 0.003: steps of 2.941176e-3 ns are used, which divide the interval \
              of records and the duration evenly"
            ]
        );
        assert!(notes("duration_ns: 1.0, record_every_ns: 0.05, time_step_ns: 0.0025").is_empty());
        let drag = |rate: f64| {
            notes(&format!(
                "duration_ns: 1.0, record_every_ns: 0.05,
                 drag: (translational_per_ns: {rate:?}, rotational_per_ns: 0.0)"
            ))
        };
        assert!(drag(100.0).is_empty());
        let strong = drag(1000.0);
        // x = 1000 * 0.05/17/2: b x/sinh(x).
        assert!(
            strong[0].contains("0.558 and 1.000 of a steady drift"),
            "{strong:?}"
        );
    }

    #[test]
    fn resolved_steps_stay_as_they_are() {
        for (duration, every) in [
            (1.0, 0.05),
            (0.777, 0.1),
            (20.0, 0.3),
            (1.0, 0.07),
            (3.0, 5.0),
        ] {
            for largest in [0.0028, 0.00131, 0.9, 1e-6] {
                let open = format!("duration_ns: {duration:?}, record_every_ns: {every:?}");
                let first = Estimate::in_steps(&dynamics(&open), largest).unwrap();
                let resolved = format!(
                    "duration_ns: {duration:?}, record_every_ns: {:?}",
                    first.record_every_ns
                );
                let again = Estimate::in_steps(&dynamics(&resolved), first.time_step_ns).unwrap();
                assert_eq!(again, first, "{open}, {largest}");
            }
        }
    }
}

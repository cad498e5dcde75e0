//! Linkers that break, form and step. Events occur at the ends of time steps and are logged.

use super::Assembly;
use crate::scene::{Kinetics as Rates, SceneProblem};
use actin_coupling::{Linker, SwitchedLinker};
use actin_mechanics::{ControlId, Interaction, State, StepEnd};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

/// Separates this random stream from other uses of the seed.
const PURPOSE: [u8; 8] = *b"linkers\0";

/// Largest product of rate and time step. Small products keep errors of event times and missed
/// events small.
pub(crate) const COARSEST: f64 = 0.1;

/// Kind of a linker event.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum LinkerEventKind {
    /// The linker broke.
    Broke,
    /// The linker formed.
    Formed,
    /// The linker's site moved to the next place.
    Stepped,
    /// The linker detached at the end of the filament.
    Left,
}

impl fmt::Display for LinkerEventKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Broke => "broke",
            Self::Formed => "formed",
            Self::Stepped => "stepped",
            Self::Left => "left",
        })
    }
}

/// Event of a linker at the end of a time step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LinkerEvent {
    /// Number of the step.
    pub step: u64,
    /// Time (ns).
    pub time_ns: f64,
    /// Index of the linker.
    pub linker: usize,
    /// Kind of the event.
    pub what: LinkerEventKind,
    /// Tension of the linker (pN) just before the event; for a formed linker, just after it.
    pub force_pn: f64,
    /// Arc length of the site (nm); after a step, arc length of the new place.
    pub at_nm: f64,
    /// Change of the energy (pN nm).
    pub energy_pn_nm: f64,
}

#[derive(Clone, Debug)]
struct Switching {
    index: usize,
    linker: SwitchedLinker,
    rates: Rates,
    /// Arc lengths of its places (nm).
    places_nm: Vec<f64>,
}

#[derive(Clone, Debug)]
pub(crate) struct Kinetics {
    all: Vec<Switching>,
    /// Accumulated energy change by events (pN nm).
    booked: ControlId,
    /// Largest product of rate and step so far.
    coarsest: ControlId,
}

pub(crate) type Log = Arc<Mutex<Vec<LinkerEvent>>>;

/// Process that applies the linker events of a run to its system and logs them.
#[derive(Debug)]
pub(crate) struct LinkerEventProcess {
    kinetics: Arc<Kinetics>,
    log: Log,
}

impl Kinetics {
    pub(super) fn new(state: &mut State) -> Self {
        Self {
            all: Vec::new(),
            booked: state.add_control(0.0),
            coarsest: state.add_control(0.0),
        }
    }

    pub(super) fn push(
        &mut self,
        index: usize,
        linker: SwitchedLinker,
        rates: Rates,
        places_nm: Vec<f64>,
    ) {
        self.all.push(Switching {
            index,
            linker,
            rates,
            places_nm,
        });
    }

    /// Returns linker `index` and the arc lengths of its places (nm), if its state can change.
    pub(crate) fn linker(&self, index: usize) -> Option<(&SwitchedLinker, &[f64])> {
        let switching = self.all.iter().find(|s| s.index == index)?;
        Some((&switching.linker, &switching.places_nm))
    }

    pub(crate) fn booked(&self, state: &State) -> f64 {
        state.controls[self.booked]
    }

    /// Returns the state with all linkers bound, which is the stiffest.
    pub(crate) fn all_bound(&self, state: &State) -> State {
        let mut bound = state.clone();
        for switching in &self.all {
            let place = switching.linker.place(state);
            switching.linker.bind(&mut bound, place);
        }
        bound
    }

    /// Creates the event process of a run. New events are appended to `log`.
    pub(crate) fn happenings(self: &Arc<Self>, log: &Log) -> LinkerEventProcess {
        LinkerEventProcess {
            kinetics: Arc::clone(self),
            log: Arc::clone(log),
        }
    }

    /// Applies the events at the end of a step of length `h` (ns) and passes each one to `note`.
    fn end_step(
        &self,
        state: &mut State,
        step: u64,
        h: f64,
        mut note: impl FnMut(LinkerEvent),
    ) -> bool {
        let mut changed = false;
        for switching in &self.all {
            let (happening, rate) = switching.drawn(state, step, h);
            let coarse = rate * h;
            if coarse > state.controls[self.coarsest] {
                state.controls[self.coarsest] = coarse;
            }
            let Some((what, place)) = happening else {
                continue;
            };
            let before = switching.linker.energy(state);
            let tension = switching.tension(state);
            switching.change(state, what, place);
            let energy_pn_nm = switching.linker.energy(state) - before;
            state.controls[self.booked] += energy_pn_nm;
            note(LinkerEvent {
                step,
                time_ns: step as f64 * h,
                linker: switching.index,
                what,
                force_pn: match what {
                    LinkerEventKind::Formed => switching.tension(state),
                    _ => tension,
                },
                at_nm: switching.places_nm[place],
                energy_pn_nm,
            });
            changed = true;
        }
        changed
    }
}

impl StepEnd for LinkerEventProcess {
    fn end_step(&self, state: &mut State, step: u64, h: f64) -> bool {
        let mut log = self.log.lock().unwrap_or_else(PoisonError::into_inner);
        // A repeated step, made to find the cause of a failure, replaces its earlier events.
        while log.last().is_some_and(|last| last.step >= step) {
            log.pop();
        }
        self.kinetics
            .end_step(state, step, h, |event| log.push(event))
    }
}

impl Switching {
    /// Samples the event at the end of a step. Returns its kind and the place of the site, and the
    /// sum of all rates (1/ns).
    fn drawn(&self, state: &State, step: u64, h: f64) -> (Option<(LinkerEventKind, usize)>, f64) {
        let place = self.linker.place(state);
        let happens = |rate: f64, draw: f64| draw < -(-rate * h).exp_m1();
        if !self.linker.is_bound(state) {
            let Some((nearest, rate)) = self.forming(state) else {
                return (None, 0.0);
            };
            let [draw, _] = self.uniform(step);
            return (
                happens(rate, draw).then_some((LinkerEventKind::Formed, nearest)),
                rate,
            );
        }
        let breaking = self
            .rates
            .breaks
            .map_or(0.0, |breaks| breaks.rate(self.tension(state)));
        let stepping = self
            .rates
            .steps
            .map_or(0.0, |steps| steps.rate(self.resistance(state, place)));
        let rate = breaking + stepping;
        let [draw, which] = self.uniform(step);
        if !happens(rate, draw) {
            return (None, rate);
        }
        // An infinite rate always breaks the linker.
        let happening = if breaking.is_infinite() || which * rate < breaking {
            Some((LinkerEventKind::Broke, place))
        } else if place + 1 < self.places_nm.len() {
            Some((LinkerEventKind::Stepped, place + 1))
        } else {
            let leaves = self.rates.steps.is_some_and(|steps| steps.leaves_at_end);
            leaves.then_some((LinkerEventKind::Left, place))
        };
        (happening, rate)
    }

    /// Returns the place at which the linker can form and the rate (1/ns), if a place is within
    /// reach.
    fn forming(&self, state: &State) -> Option<(usize, f64)> {
        let forms = self.rates.forms?;
        let extensions = self
            .linker
            .places()
            .iter()
            .map(|one| one.extension(state).abs());
        let by_size = |a: &(usize, f64), b: &(usize, f64)| a.1.total_cmp(&b.1);
        let (nearest, extension) = extensions.enumerate().min_by(by_size)?;
        (extension <= forms.reach_nm).then_some((nearest, forms.rate_per_ns))
    }

    /// Tension at its place (pN), whether bound or not.
    fn tension(&self, state: &State) -> f64 {
        let linker = self.linker.linker(state);
        if linker.extension(state) > 0.0 {
            linker.force(state).norm()
        } else {
            0.0
        }
    }

    /// Force (pN) against a step from `place` along the line to the next place; at the end, along
    /// the line from the previous place.
    fn resistance(&self, state: &State, place: usize) -> f64 {
        let places = self.linker.places();
        let (from, to) = if place + 1 < places.len() {
            (place, place + 1)
        } else {
            (place.saturating_sub(1), place)
        };
        let at = |k: usize| places[k].site().position(state);
        let along = (at(to) - at(from)).try_normalize(0.0);
        along.map_or(0.0, |along| -places[place].force(state).dot(&along))
    }

    fn change(&self, state: &mut State, what: LinkerEventKind, place: usize) {
        match what {
            LinkerEventKind::Broke | LinkerEventKind::Left => self.linker.release(state),
            LinkerEventKind::Formed | LinkerEventKind::Stepped => self.linker.bind(state, place),
        }
    }

    /// Returns two uniform numbers in [0, 1) for a step. They come from the `ChaCha8` stream of the
    /// step, in which each linker has separate words.
    fn uniform(&self, step: u64) -> [f64; 2] {
        const SPACING: f64 = 1.0 / (1u64 << 53) as f64;
        let mut key = [0; 32];
        key[..8].copy_from_slice(&self.rates.seed.to_le_bytes());
        key[8..16].copy_from_slice(&PURPOSE);
        let mut generator = ChaCha8Rng::from_seed(key);
        generator.set_stream(step);
        // Two numbers of two 32-bit words each.
        generator.set_word_pos(4 * self.index as u128);
        std::array::from_fn(|_| (generator.next_u64() >> 11) as f64 * SPACING)
    }
}

impl Assembly {
    /// Returns linker `i` with its site in `state`, and whether it is bound.
    pub(crate) fn linker_in<'a>(&'a self, i: usize, state: &State) -> (&'a Linker, bool) {
        let switched = self
            .kinetics
            .as_ref()
            .and_then(|kinetics| kinetics.linker(i));
        switched.map_or((&self.linkers[i], true), |(switched, _)| {
            (switched.linker(state), switched.is_bound(state))
        })
    }

    /// Returns whether linker `i` is bound in `state` and the arc length of its site (nm); `None`
    /// for permanent linkers.
    pub fn switched(&self, i: usize, state: &State) -> Option<(bool, f64)> {
        let (linker, places) = self.kinetics.as_ref()?.linker(i)?;
        Some((linker.is_bound(state), places[linker.place(state)]))
    }

    /// Refuses rates of linkers that are too fast for a time step (ns).
    pub(crate) fn check_rates(&self, step_ns: f64) -> Result<(), SceneProblem> {
        for (i, linker) in self.scene.linkers.iter().enumerate() {
            let rates = linker.kinetics.iter().flat_map(Rates::rates);
            for (name, rate) in rates {
                if rate * step_ns > COARSEST {
                    let rule = format!(
                        "is {:.2} per time step of {step_ns:.3e} ns, which delays events: must be at most \
                         {COARSEST}; shorten task.time_step_ns",
                        rate * step_ns
                    );
                    let key = format!("linkers[{i}].kinetics.{name}");
                    return Err(SceneProblem::new(key, format!("{rate:?}"), rule));
                }
            }
        }
        Ok(())
    }

    /// Warning about rates that became too fast for the time step under force.
    pub(crate) fn note_on_rates(&self, last: &State) -> Option<String> {
        let kinetics = self.kinetics.as_ref()?;
        let coarsest = last.controls[kinetics.coarsest];
        (coarsest > COARSEST).then(|| {
            format!(
                "linker rates under force reached {coarsest:.2} per time step: events are delayed by up to half a step, \
                 and each linker has at most one event per step; use a shorter time_step_ns"
            )
        })
    }
}

#[cfg(test)]
mod tests;

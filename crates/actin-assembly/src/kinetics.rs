//! Linkers that break, form and step. Events occur at the ends of time steps and are logged.

mod average;
mod pool;

use average::{ForceAverage, RecentAverage};
use pool::Pool;

use crate::scene::Kinetics as Rates;
use actin_coupling::{Hand, Site, SwitchedLinker};
use actin_mechanics::{ControlId, Interaction, State, StepEnd, Vector3};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

/// Separates this random stream from other uses of the seed.
const PURPOSE: [u8; 8] = *b"linkers\0";

/// Largest product of rate and time step. Small products keep errors of event times and missed
/// events small.
pub const COARSEST: f64 = 0.1;

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
    /// A hand of a free linker bound.
    Attached,
    /// The only bound hand of a linker let go.
    Detached,
}

impl LinkerEventKind {
    /// All kinds.
    pub const ALL: [Self; 6] = [
        Self::Broke,
        Self::Formed,
        Self::Stepped,
        Self::Left,
        Self::Attached,
        Self::Detached,
    ];
}

impl fmt::Display for LinkerEventKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Broke => "broke",
            Self::Formed => "formed",
            Self::Stepped => "stepped",
            Self::Left => "left",
            Self::Attached => "attached",
            Self::Detached => "detached",
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
    /// Averaged tension of the linker (pN) before the event; for a formed linker, its tension.
    pub force_pn: f64,
    /// Arc length of the site (nm); after a step, arc length of the new place.
    pub at_nm: f64,
    /// Change of the energy (pN nm).
    pub energy_pn_nm: f64,
    /// Index of the hand; 0 for linkers with a fixed second end.
    pub hand: usize,
    /// Index of the filament of the site.
    pub filament: usize,
}

/// Sites of a hand with their filaments and arc lengths (nm), ordered along filaments in the direction
/// of steps.
#[derive(Clone, Debug)]
pub(crate) struct SiteTable {
    pub(crate) sites: Arc<[Site]>,
    pub(crate) places: Arc<[(usize, f64)]>,
}

impl SiteTable {
    /// Next site in the direction of steps; `None` at the end of the filament.
    fn next(&self, site: usize) -> Option<usize> {
        let next = self.places.get(site + 1)?;
        (next.0 == self.places[site].0).then_some(site + 1)
    }

    /// Sites of a filament.
    fn of_filament(&self, filament: usize) -> Range<usize> {
        let first = self.places.partition_point(|place| place.0 < filament);
        let past = self.places.partition_point(|place| place.0 <= filament);
        first..past
    }

    /// Site nearest to an arc length (nm) of a filament.
    fn nearest(&self, filament: usize, at_nm: f64) -> usize {
        let distance = |site: &usize| (self.places[*site].1 - at_nm).abs();
        let own = self.of_filament(filament);
        own.min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .unwrap_or(0)
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Switching {
    index: usize,
    linker: SwitchedLinker,
    pub(crate) rates: Rates,
    table: SiteTable,
    /// Averages of the forces. The tension vector is the signed tension along x, or the force (lab frame)
    /// of linkers without a rest length.
    average: ForceAverage,
}

/// Linkers that bind, unbind or step, with the controls that hold their states.
#[derive(Clone, Debug)]
pub struct Kinetics {
    all: Vec<Switching>,
    /// Accumulated energy change by events (pN nm).
    booked: ControlId,
    /// Largest product of rate and step so far.
    pub(crate) coarsest: ControlId,
    /// Thermal energy (pN nm).
    thermal_energy: f64,
}

/// Events of a run, in order.
pub type Log = Arc<Mutex<Vec<LinkerEvent>>>;

/// Process that applies the linker events of a run to its system and logs them.
#[derive(Debug)]
struct LinkerEventProcess {
    kinetics: Arc<Kinetics>,
    log: Log,
}

impl Kinetics {
    pub(super) fn new(state: &mut State, thermal_energy: f64) -> Self {
        Self {
            all: Vec::new(),
            booked: state.add_control(0.0),
            coarsest: state.add_control(0.0),
            thermal_energy,
        }
    }

    pub(super) fn push(
        &mut self,
        index: usize,
        (linker, table): (SwitchedLinker, SiteTable),
        rates: Rates,
        state: &mut State,
    ) {
        let scale = rates.force_scale().filter(|_| rates.averaging_ns.is_none());
        let stiffness = linker.linker(state).spring().stiffness;
        let recent =
            scale.map(|scale| RecentAverage::new(state, self.thermal_energy, stiffness, scale));
        self.all.push(Switching {
            index,
            average: ForceAverage::new(state, rates.averaging_time(), recent),
            linker,
            rates,
            table,
        });
    }

    /// Returns linker `index`, if its state can change.
    pub(crate) fn linker(&self, index: usize) -> Option<&Switching> {
        let found = self.all.binary_search_by_key(&index, |s| s.index).ok()?;
        Some(&self.all[found])
    }

    /// Indices of the linkers whose rates depend on the force, with the times (ns) after which they follow it, for steps of
    /// length `h` (ns).
    pub(crate) fn delays(&self, h: f64) -> impl Iterator<Item = (usize, f64)> {
        let depends =
            |one: &&Switching| one.rates.force_scale().is_some() || one.rates.steps.is_some();
        let all = self.all.iter().filter(depends);
        all.map(move |one| {
            // Steps follow the long average.
            let delay = match one.rates.steps {
                Some(_) => one.rates.averaging_time(),
                None => one.average.delay(h),
            };
            (one.index, delay)
        })
    }

    pub(crate) fn booked(&self, state: &State) -> f64 {
        state.controls[self.booked]
    }

    /// Returns the state with all linkers bound, in which their springs are stiffest. Roaming linkers are distributed
    /// over all sites.
    pub fn all_bound(&self, state: &State) -> State {
        let mut bound = state.clone();
        for switching in &self.all {
            let sites = switching.table.sites.len();
            for (k, hand) in switching.linker.hands().enumerate() {
                let site = match switching.rates.roams {
                    Some(_) => (switching.index + k * sites / 2) % sites,
                    None => hand.site(state),
                };
                hand.bind(&mut bound, site);
            }
        }
        bound
    }

    /// Creates the event process of a run. New events are appended to `log`.
    pub fn event_process(self: &Arc<Self>, log: &Log) -> Box<dyn StepEnd> {
        Box::new(LinkerEventProcess {
            kinetics: Arc::clone(self),
            log: Arc::clone(log),
        })
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
        let mut pool = Pool::new(&self.all, state);
        for switching in &self.all {
            switching.add_to_average(state, h);
            let (event, rate) = switching.drawn(state, (step, h), &mut pool, self.thermal_energy);
            let coarse = rate * h;
            if coarse > state.controls[self.coarsest] {
                state.controls[self.coarsest] = coarse;
            }
            let Some(event) = event else {
                continue;
            };
            let before = switching.linker.energy(state);
            let tension = switching.tension(state);
            switching.apply(state, &event);
            pool.apply(switching, &event);
            let energy_pn_nm = switching.linker.energy(state) - before;
            state.controls[self.booked] += energy_pn_nm;
            let (filament, at_nm) = switching.table.places[event.site];
            note(LinkerEvent {
                step,
                time_ns: step as f64 * h,
                linker: switching.index,
                what: event.what,
                force_pn: match event.what {
                    LinkerEventKind::Formed => switching.present_tension(state),
                    _ => tension,
                },
                at_nm,
                energy_pn_nm,
                hand: event.hand,
                filament,
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

/// Event of one hand.
#[derive(Clone, Copy, Debug, PartialEq)]
struct HandEvent {
    what: LinkerEventKind,
    hand: usize,
    /// Site of the hand; after a step the new one.
    site: usize,
}

impl Switching {
    pub(crate) fn linker(&self) -> &SwitchedLinker {
        &self.linker
    }

    /// Filament and arc length (nm) of the present site of a hand.
    pub(crate) fn place(&self, hand: usize, state: &State) -> (usize, f64) {
        self.table.places[self.hand(hand).site(state)]
    }

    fn hand(&self, hand: usize) -> &Hand {
        let mut hands = self.linker.hands();
        hands.nth(hand).expect("the hand exists")
    }

    /// Applies an event that was read from a file.
    pub(crate) fn restore(&self, state: &mut State, event: &LinkerEvent) {
        let filament = match self.rates.roams {
            Some(_) => event.filament,
            None => self.table.places[0].0,
        };
        self.apply(
            state,
            &HandEvent {
                what: event.what,
                hand: event.hand,
                site: self.table.nearest(filament, event.at_nm),
            },
        );
    }

    /// Samples the event at the end of a step. Returns it and the sum of all rates (1/ns).
    fn drawn(
        &self,
        state: &State,
        (step, h): (u64, f64),
        pool: &mut Pool,
        thermal_energy: f64,
    ) -> (Option<HandEvent>, f64) {
        let choices = if self.rates.roams.is_some() {
            self.choices_of_pool(state, step, pool, thermal_energy)
        } else if self.linker.is_bound(state) {
            self.choices_of_hand(0, state, pool)
        } else {
            self.forming(state).into_iter().collect()
        };
        let rate: f64 = choices.iter().map(|(_, rate)| rate).sum();
        if choices.is_empty() {
            return (None, rate);
        }
        let [draw, which] = self.uniform(PURPOSE, step);
        if draw >= -(-rate * h).exp_m1() {
            return (None, rate);
        }
        // An infinite rate always occurs.
        let infinite = choices.iter().find(|(_, rate)| rate.is_infinite());
        let mut left = which * rate;
        let chosen = choices.iter().find(|(_, rate)| {
            left -= rate;
            left < 0.0
        });
        let chosen = infinite.or(chosen).or(choices.last());
        (chosen.and_then(|(event, _)| *event), rate)
    }

    /// Release and step of a bound hand with their rates (1/ns). A step beyond the end, or to an occupied
    /// site, has no effect unless the hand leaves at the end.
    fn choices_of_hand(
        &self,
        hand: usize,
        state: &State,
        pool: &Pool,
    ) -> Vec<(Option<HandEvent>, f64)> {
        let site = self.hand(hand).site(state);
        let is_joined = self.linker.is_bound(state);
        let event = |what, site| Some(HandEvent { what, hand, site });
        let mut choices = Vec::new();
        if let Some(breaks) = self.rates.breaks {
            let (what, tension) = if is_joined {
                (LinkerEventKind::Broke, self.tension(state))
            } else {
                (LinkerEventKind::Detached, 0.0)
            };
            choices.push((event(what, site), breaks.rate(tension)));
        }
        if let Some(steps) = self.rates.steps {
            let resistance = if is_joined {
                self.average.against(hand, state)
            } else {
                0.0
            };
            let step = match self.table.next(site) {
                Some(next) if pool.is_occupied(self, next) => None,
                Some(next) => event(LinkerEventKind::Stepped, next),
                None if steps.leaves_at_end => event(LinkerEventKind::Left, site),
                None => None,
            };
            choices.push((step, steps.rate(resistance)));
        }
        choices
    }

    /// Returns the site at which the first hand can bind and the rate (1/ns), if one is within reach.
    fn forming(&self, state: &State) -> Option<(Option<HandEvent>, f64)> {
        let forms = self.rates.forms?;
        let sites = 0..self.table.sites.len();
        let extension = |site: usize| self.linker.linker_at(&[site]).extension(state).abs();
        let extensions = sites.map(|site| (site, extension(site)));
        let (site, extension) = extensions.min_by(|a, b| a.1.total_cmp(&b.1))?;
        let event = HandEvent {
            what: LinkerEventKind::Formed,
            hand: 0,
            site,
        };
        (extension <= forms.reach_nm).then_some((Some(event), forms.rate_per_ns))
    }

    /// Averaged tension (pN); zero unless bound.
    fn tension(&self, state: &State) -> f64 {
        if !self.linker.is_bound(state) {
            return 0.0;
        }
        let (average, tension) = self.average.tension(state);
        if self.direction_of_linker(state).is_some() && average.x < 0.0 {
            0.0
        } else {
            tension
        }
    }

    /// Tension (pN) without averaging.
    fn present_tension(&self, state: &State) -> f64 {
        let linker = self.linker.linker(state);
        (linker.spring().stiffness * linker.extension(state)).max(0.0)
    }

    /// Direction from the first to the second end, for linkers with a rest length.
    fn direction_of_linker(&self, state: &State) -> Option<Vector3> {
        let linker = self.linker.linker(state);
        let d = linker.end_position(state) - linker.site().position(state);
        (linker.spring().rest_length > 0.0).then(|| d.try_normalize(0.0).unwrap_or_default())
    }

    /// Tension as in the averages, and the forces against steps of the hands.
    fn forces(&self, state: &State) -> (Vector3, [f64; 2]) {
        let force = self.linker.transmitted_force(state);
        let tension = match self.direction_of_linker(state) {
            Some(direction) => Vector3::x() * force.dot(&direction),
            None => force,
        };
        let mut resistances = [0.0; 2];
        let hands = self.linker.hands().count();
        for (hand, sign) in [1.0, -1.0].into_iter().enumerate().take(hands) {
            resistances[hand] = -sign * force.dot(&self.direction(hand, state));
        }
        (tension, resistances)
    }

    /// Direction of the next step of a hand; at the end, of the last one.
    fn direction(&self, hand: usize, state: &State) -> Vector3 {
        let site = self.hand(hand).site(state);
        let own = self.table.of_filament(self.table.places[site].0);
        let (from, to) = match self.table.next(site) {
            Some(next) => (site, next),
            None => (site.saturating_sub(1).max(own.start), site),
        };
        let at = |site: usize| self.table.sites[site].position(state);
        (at(to) - at(from)).try_normalize(0.0).unwrap_or_default()
    }

    fn add_to_average(&self, state: &mut State, h: f64) {
        if self.linker.is_bound(state) {
            let forces = self.forces(state);
            self.average.add(state, h, forces);
        }
    }

    fn apply(&self, state: &mut State, event: &HandEvent) {
        let hand = self.hand(event.hand);
        match event.what {
            LinkerEventKind::Broke | LinkerEventKind::Left | LinkerEventKind::Detached => {
                hand.release(state);
            }
            LinkerEventKind::Formed | LinkerEventKind::Attached => {
                hand.bind(state, event.site);
                self.average.begin(state);
            }
            LinkerEventKind::Stepped => hand.bind(state, event.site),
        }
    }

    /// Returns two uniform numbers in [0, 1) for a step. They come from the `ChaCha8` stream of the
    /// step, in which each linker has separate words.
    fn uniform(&self, purpose: [u8; 8], step: u64) -> [f64; 2] {
        const SPACING: f64 = 1.0 / (1u64 << 53) as f64;
        let mut key = [0; 32];
        key[..8].copy_from_slice(&self.rates.seed.to_le_bytes());
        key[8..16].copy_from_slice(&purpose);
        let mut generator = ChaCha8Rng::from_seed(key);
        generator.set_stream(step);
        // Two numbers of two 32-bit words each.
        generator.set_word_pos(4 * self.index as u128);
        std::array::from_fn(|_| (generator.next_u64() >> 11) as f64 * SPACING)
    }
}

#[cfg(test)]
mod tests;
